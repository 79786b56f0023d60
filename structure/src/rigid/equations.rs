//! What supports and hinges leave of the rigid motions of an assembly.

use super::ROUND_OFF;
use super::bodies::Body;

/// Homogeneous equations for `(t_x, t_y, omega size)` of each body, in reduced row echelon form.
pub(super) struct Equations {
    bodies: usize,
    reduced: Reduced,
}

impl Equations {
    pub(super) fn new(assembly: &[Body], points: &[[f64; 2]], held: &[bool]) -> Self {
        let columns = 3 * assembly.len();
        let mut reduced = Reduced::new(columns);
        let mut owner = std::collections::BTreeMap::new();
        for (index, body) in assembly.iter().enumerate() {
            let frame = Frame { index, centre: body.centre(points), size: body.size(points) };
            // First among themselves: three equations say what a thousand held nodes do.
            let mut supports = Reduced::new(3);
            for &node in &body.nodes {
                for c in (0..2).filter(|c| held[2 * node + c]) {
                    supports.add(frame.row(points[node], c).to_vec());
                }
            }
            for (_, row) in supports.rows {
                let mut full = vec![0.0; columns];
                full[3 * index..][..3].copy_from_slice(&row);
                reduced.add(full);
            }
            for &node in &body.nodes {
                let Some(other) = owner.insert(node, frame) else { continue };
                for c in 0..2 {
                    let mut full = vec![0.0; columns];
                    full[3 * index..][..3].copy_from_slice(&frame.row(points[node], c));
                    let of_other = Frame::row(&other, points[node], c).map(|x| -x);
                    full[3 * other.index..][..3].copy_from_slice(&of_other);
                    reduced.add(full);
                }
            }
        }
        Self { bodies: assembly.len(), reduced }
    }

    /// For each body, vectors that span what it can do.
    pub(super) fn motions(&self) -> Vec<Vec<[f64; 3]>> {
        let null = self.reduced.null_space();
        let of_body = |body: usize| {
            let mut span = Reduced::new(3);
            for vector in &null {
                span.add(vector[3 * body..][..3].to_vec());
            }
            span.rows.into_iter().map(|(_, row)| [row[0], row[1], row[2]]).collect()
        };
        (0..self.bodies).map(of_body).collect()
    }
}

/// Where a body turns, and its unit of length.
#[derive(Clone, Copy)]
struct Frame {
    index: usize,
    centre: [f64; 2],
    size: f64,
}

impl Frame {
    /// `u_c(x) = t_c + omega (e_z x (x - centre))_c`
    fn row(&self, x: [f64; 2], c: usize) -> [f64; 3] {
        let [x, y] = [0, 1].map(|i| (x[i] - self.centre[i]) / self.size);
        if c == 0 { [1.0, 0.0, -y] } else { [0.0, 1.0, x] }
    }
}

/// Rows that are 1 in their pivot column, where all others are 0.
struct Reduced {
    columns: usize,
    rows: Vec<(usize, Vec<f64>)>,
}

impl Reduced {
    fn new(columns: usize) -> Self {
        Self { columns, rows: Vec::new() }
    }

    /// Adds a row, unless it follows from those that are there.
    fn add(&mut self, mut row: Vec<f64>) {
        if self.rows.len() == self.columns {
            return;
        }
        let scale = largest(&row).map_or(0.0, |(_, x)| x.abs());
        for (pivot, known) in &self.rows {
            subtract(row[*pivot], known, &mut row);
        }
        let Some((pivot, value)) = largest(&row).filter(|(_, x)| x.abs() > ROUND_OFF * scale) else { return };
        for x in &mut row {
            *x /= value;
        }
        for (_, known) in &mut self.rows {
            subtract(known[pivot], &row, known);
        }
        self.rows.push((pivot, row));
    }

    fn null_space(&self) -> Vec<Vec<f64>> {
        let is_pivot = |column: &usize| self.rows.iter().any(|(pivot, _)| pivot == column);
        let free = (0..self.columns).filter(|column| !is_pivot(column));
        free.map(|column| {
            let mut vector = vec![0.0; self.columns];
            vector[column] = 1.0;
            for (pivot, row) in &self.rows {
                vector[*pivot] = -row[column];
            }
            vector
        })
        .collect()
    }
}

fn subtract(factor: f64, from: &[f64], row: &mut [f64]) {
    if factor != 0.0 {
        row.iter_mut().zip(from).for_each(|(x, y)| *x -= factor * y);
    }
}

fn largest(row: &[f64]) -> Option<(usize, f64)> {
    row.iter().copied().enumerate().max_by(|(_, a), (_, b)| a.abs().total_cmp(&b.abs()))
}
