//! Random element systems and their dense counterparts.

use nalgebra::{DMatrix, DVector};
use partita_numerics::{Connectivity, DofMap, Pattern, Scatter};
use proptest::prelude::*;

/// Elements of two kinds over a few dofs, some of them prescribed, with a matrix for each element.
#[derive(Debug, Clone)]
pub(crate) struct Elements {
    pub(crate) dofs: DofMap,
    pub(crate) kinds: Vec<(Connectivity, Vec<Vec<f64>>)>,
}

/// Any such elements: a dof may be in no element, twice in one element, or prescribed.
pub(crate) fn elements() -> impl Strategy<Value = Elements> {
    (2_usize..12).prop_flat_map(|total| {
        let prescribed = prop::collection::vec(prop::bool::weighted(0.25), total);
        (prescribed, kind(total, 2), kind(total, 3))
            .prop_map(|(prescribed, a, b)| Elements { dofs: DofMap::new(&prescribed), kinds: vec![a, b] })
    })
}

fn kind(total: usize, n: usize) -> impl Strategy<Value = (Connectivity, Vec<Vec<f64>>)> {
    let element = (prop::collection::vec(0..total, n), prop::collection::vec(-1.0..1.0, n * n));
    prop::collection::vec(element, 0..8).prop_map(move |elements| {
        let (dofs, matrices): (Vec<_>, Vec<_>) = elements.into_iter().unzip();
        (Connectivity::new(n, dofs.concat()), matrices)
    })
}

impl Elements {
    /// Replaces each element matrix, given as n x n.
    pub(crate) fn map(mut self, change: impl Fn(DMatrix<f64>) -> DMatrix<f64>) -> Self {
        for (connectivity, matrices) in &mut self.kinds {
            let n = connectivity.dofs_per_element();
            for matrix in matrices {
                let changed = change(DMatrix::from_row_slice(n, n, matrix));
                *matrix = changed.transpose().as_slice().to_vec();
            }
        }
        self
    }

    /// The pattern and values through [`Pattern`] and [`Scatter`].
    pub(crate) fn assemble(&self) -> (Pattern, Vec<f64>) {
        let connectivities: Vec<_> = self.kinds.iter().map(|(connectivity, _)| connectivity).collect();
        let pattern = Pattern::new(&self.dofs, &connectivities);
        let mut values = vec![0.0; pattern.nonzeros()];
        for (connectivity, matrices) in &self.kinds {
            let scatter = Scatter::new(&pattern, &self.dofs, connectivity);
            for (e, matrix) in matrices.iter().enumerate() {
                scatter.add_matrix(e, matrix, &mut values);
            }
        }
        (pattern, values)
    }

    /// The dense matrix over all dofs, free and prescribed, entry by entry.
    pub(crate) fn dense(&self) -> DMatrix<f64> {
        let mut dense = DMatrix::zeros(self.dofs.total(), self.dofs.total());
        for (connectivity, matrices) in &self.kinds {
            for (element, matrix) in connectivity.elements().zip(matrices) {
                for (i, &row) in element.iter().enumerate() {
                    for (j, &column) in element.iter().enumerate() {
                        dense[(row, column)] += matrix[i * element.len() + j];
                    }
                }
            }
        }
        dense
    }
}

/// The dense matrix of values over a pattern.
pub(crate) fn to_dense(pattern: &Pattern, values: &[f64]) -> DMatrix<f64> {
    let mut dense = DMatrix::zeros(pattern.size(), pattern.size());
    for column in 0..pattern.size() {
        for slot in pattern.col_ptr()[column]..pattern.col_ptr()[column + 1] {
            dense[(pattern.row_idx()[slot], column)] = values[slot];
        }
    }
    dense
}

/// A vector of `n` entries between -1 and 1 that repeats nothing.
pub(crate) fn vector(n: usize) -> DVector<f64> {
    DVector::from_fn(n, |i, _| (1.0 + 3.7 * i as f64).sin())
}
