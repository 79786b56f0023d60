//! A thin QR factorization that follows the columns of a least-squares problem as they come and go.

use crate::vector::{add_scaled, dot, norm};

/// A column whose part outside the span of the others is smaller than this, relative to its length, is
/// round-off and cannot extend the factorization.
const ROUND_OFF: f64 = 64.0 * f64::EPSILON;

/// `V = Q R` with orthonormal `Q` (n x k) and upper triangular `R` (k x k).
///
/// Inserting at the front, removing anywhere and appending cost `O(n k)`: Gram-Schmidt twice, then
/// Givens rotations (Daniel, Gragg, Kaufman and Stewart 1976).
#[derive(Debug, Clone, Default)]
pub(crate) struct Qr {
    /// Columns of `Q`.
    q: Vec<Vec<f64>>,
    /// Columns of `R`; column `j` has `j + 1` entries.
    r: Vec<Vec<f64>>,
}

/// The column lies in the span of the others; what sticks out, relative to its length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Dependent(pub(crate) f64);

impl Qr {
    pub(crate) fn len(&self) -> usize {
        self.q.len()
    }

    pub(crate) fn clear(&mut self) {
        self.q.clear();
        self.r.clear();
    }

    /// The columns of `Q`.
    pub(crate) fn q(&self) -> &[Vec<f64>] {
        &self.q
    }

    /// Column `j` of `R` down to its diagonal.
    pub(crate) fn r(&self, j: usize) -> &[f64] {
        &self.r[j]
    }

    /// `|R_jj|`.
    pub(crate) fn diagonal(&self, j: usize) -> f64 {
        self.r[j][j].abs()
    }

    /// Appends the column `v` unless less than `limit` of it is independent of the others.
    pub(crate) fn push_back(&mut self, v: &[f64], limit: f64) -> Result<(), Dependent> {
        let (q, mut coefficients, rest) = self.orthogonalize(v)?;
        if rest < limit {
            return Err(Dependent(rest));
        }
        coefficients.push(rest * norm(v));
        self.q.push(q);
        self.r.push(coefficients);
        Ok(())
    }

    /// Inserts the column `v` before all others.
    pub(crate) fn push_front(&mut self, v: &[f64]) -> Result<(), Dependent> {
        let (q, mut front, rest) = self.orthogonalize(v)?;
        let others = self.len();
        front.push(rest * norm(v));
        self.q.push(q);
        for column in &mut self.r {
            column.push(0.0);
        }
        for row in (0..others).rev() {
            let rotation = Rotation::eliminating(front[row], front[row + 1]);
            rotation.apply_to(&mut front, row);
            for column in &mut self.r[row..] {
                rotation.apply_to(column, row);
            }
            rotation.apply_to_columns(&mut self.q, row);
        }
        front.truncate(1);
        self.r.insert(0, front);
        Ok(())
    }

    /// Removes column `j`.
    pub(crate) fn remove(&mut self, j: usize) {
        self.r.remove(j);
        for row in j..self.r.len() {
            let rotation = Rotation::eliminating(self.r[row][row], self.r[row][row + 1]);
            for column in &mut self.r[row..] {
                rotation.apply_to(column, row);
            }
            rotation.apply_to_columns(&mut self.q, row);
            self.r[row].truncate(row + 1);
        }
        self.q.pop();
    }

    /// The least-squares solution `c` of `min |V c - b|`: `R c = Q^T b`.
    pub(crate) fn solve(&self, b: &[f64], c: &mut Vec<f64>) {
        c.clear();
        c.extend(self.q.iter().map(|q| dot(q, b)));
        for j in (0..self.len()).rev() {
            c[j] /= self.r[j][j];
            for i in 0..j {
                c[i] -= self.r[j][i] * c[j];
            }
        }
    }

    /// The unit vector of `v` outside the span of `Q`, the coefficients of `v` in `Q`, and the length of the
    /// outside part relative to `|v|`. Classical Gram-Schmidt, twice.
    fn orthogonalize(&self, v: &[f64]) -> Result<(Vec<f64>, Vec<f64>, f64), Dependent> {
        let length = norm(v);
        if self.len() == v.len() || length == 0.0 {
            return Err(Dependent(0.0));
        }
        let mut outside = v.to_vec();
        let mut coefficients = vec![0.0; self.len()];
        for _ in 0..2 {
            for (q, coefficient) in self.q.iter().zip(&mut coefficients) {
                let projection = dot(q, &outside);
                add_scaled(-projection, q, &mut outside);
                *coefficient += projection;
            }
        }
        let rest = norm(&outside);
        if rest <= ROUND_OFF * length {
            return Err(Dependent(rest / length));
        }
        for value in &mut outside {
            *value /= rest;
        }
        Ok((outside, coefficients, rest / length))
    }
}

/// A rotation of two neighbouring rows.
#[derive(Clone, Copy)]
struct Rotation {
    cosine: f64,
    sine: f64,
}

impl Rotation {
    /// The rotation that turns `(a, b)` into `(|(a, b)|, 0)`.
    fn eliminating(a: f64, b: f64) -> Self {
        let length = a.hypot(b);
        if length == 0.0 {
            return Self { cosine: 1.0, sine: 0.0 };
        }
        Self { cosine: a / length, sine: b / length }
    }

    fn apply_to(self, column: &mut [f64], row: usize) {
        let (a, b) = (column[row], column[row + 1]);
        column[row] = self.cosine * a + self.sine * b;
        column[row + 1] = self.cosine * b - self.sine * a;
    }

    fn apply_to_columns(self, q: &mut [Vec<f64>], column: usize) {
        let (left, right) = q.split_at_mut(column + 1);
        for (a, b) in left[column].iter_mut().zip(&mut right[0]) {
            (*a, *b) = (self.cosine * *a + self.sine * *b, self.cosine * *b - self.sine * *a);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fixed numbers without structure.
    fn columns(rows: usize, count: usize) -> Vec<Vec<f64>> {
        let entry = |i: usize, j: usize| (0.7 * (i * i) as f64 + 1.3 * (i * j) as f64 + 0.4).sin();
        (0..count).map(|j| (0..rows).map(|i| entry(i, j)).collect()).collect()
    }

    fn assert_factors(qr: &Qr, columns: &[&Vec<f64>]) {
        assert_eq!(qr.len(), columns.len());
        for (i, a) in qr.q.iter().enumerate() {
            for (j, b) in qr.q.iter().enumerate() {
                let expected = if i == j { 1.0 } else { 0.0 };
                assert!((dot(a, b) - expected).abs() < 1e-13, "Q is not orthonormal at {i}, {j}");
            }
        }
        for (j, column) in columns.iter().enumerate() {
            let mut rest = (*column).clone();
            assert_eq!(qr.r(j).len(), j + 1);
            for (coefficient, q) in qr.r(j).iter().zip(&qr.q) {
                add_scaled(-coefficient, q, &mut rest);
            }
            assert!(norm(&rest) < 1e-13, "column {j} is not Q R");
        }
    }

    #[test]
    fn appending_inserting_and_removing_keep_the_factorization() {
        let v = columns(9, 5);
        let mut qr = Qr::default();
        qr.push_back(&v[2], 0.0).unwrap();
        qr.push_back(&v[3], 0.0).unwrap();
        qr.push_front(&v[1]).unwrap();
        qr.push_front(&v[0]).unwrap();
        qr.push_back(&v[4], 0.0).unwrap();
        assert_factors(&qr, &[&v[0], &v[1], &v[2], &v[3], &v[4]]);
        qr.remove(1);
        assert_factors(&qr, &[&v[0], &v[2], &v[3], &v[4]]);
        qr.remove(0);
        assert_factors(&qr, &[&v[2], &v[3], &v[4]]);
        qr.remove(2);
        assert_factors(&qr, &[&v[2], &v[3]]);
    }

    #[test]
    fn solve_is_the_least_squares_solution() {
        let v = columns(7, 3);
        let mut qr = Qr::default();
        for column in v.iter().rev() {
            qr.push_front(column).unwrap();
        }
        let b: Vec<f64> = (0..7).map(|i| f64::from(i).cos()).collect();
        let mut c = Vec::new();
        qr.solve(&b, &mut c);
        let mut residual = b;
        for (factor, column) in c.iter().zip(&v) {
            add_scaled(-factor, column, &mut residual);
        }
        for column in &v {
            assert!(dot(column, &residual).abs() < 1e-13, "the residual must be normal to all columns");
        }
    }

    #[test]
    fn dependent_columns_are_refused() {
        let v = columns(6, 2);
        let mut qr = Qr::default();
        qr.push_back(&v[0], 0.0).unwrap();
        qr.push_back(&v[1], 0.0).unwrap();
        let mut sum = v[0].clone();
        add_scaled(-3.0, &v[1], &mut sum);
        assert!(qr.push_front(&sum).is_err());
        let kick = &columns(6, 3)[2];
        add_scaled(1e-4, kick, &mut sum);
        let Err(Dependent(rest)) = qr.push_back(&sum, 1e-2) else { panic!("below the limit") };
        assert!(rest > 0.0 && rest < 1e-3);
        assert_factors(&qr, &[&v[0], &v[1]]);
        assert!(qr.push_back(&[0.0; 6], 0.0).is_err());
    }

    #[test]
    fn nearly_dependent_columns_still_get_an_orthonormal_basis() {
        let v = columns(8, 4);
        let mut close = v[0].clone();
        add_scaled(1e-9, &v[1], &mut close);
        let mut closer = v[2].clone();
        add_scaled(1e-10, &v[3], &mut closer);
        let mut qr = Qr::default();
        for column in [&close, &v[0], &closer, &v[2]] {
            qr.push_front(column).unwrap();
        }
        assert_factors(&qr, &[&v[2], &closer, &v[0], &close]);
    }

    #[test]
    fn no_column_fits_beside_a_full_basis() {
        let v = columns(2, 3);
        let mut qr = Qr::default();
        qr.push_back(&v[0], 0.0).unwrap();
        qr.push_back(&v[1], 0.0).unwrap();
        assert_eq!(qr.push_back(&v[2], 0.0), Err(Dependent(0.0)));
    }
}
