//! Pattern and scatter against entries added one by one.

use partita_numerics::{Connectivity, DofMap, Pattern, Scatter, scatter};
use proptest::prelude::*;

use crate::random::{Elements, elements, to_dense, vector};

/// The rows and columns of the free dofs.
fn free_part(elements: &Elements) -> nalgebra::DMatrix<f64> {
    elements.dense().select_rows(elements.dofs.free()).select_columns(elements.dofs.free())
}

proptest! {
    #[test]
    fn assembled_matrix_is_the_free_part_of_the_dense_one(elements in elements()) {
        let (pattern, values) = elements.assemble();
        let difference = to_dense(&pattern, &values) - free_part(&elements);
        prop_assert!(difference.amax() < 1e-14);
    }

    #[test]
    fn pattern_is_sorted_symmetric_and_as_small_as_it_can_be(elements in elements()) {
        let ones = elements.map(|matrix| matrix.map(|_| 1.0));
        let (pattern, _) = ones.assemble();
        let dense = free_part(&ones);
        prop_assert_eq!(pattern.size(), ones.dofs.free_count());
        prop_assert_eq!(pattern.nonzeros(), pattern.row_idx().len());
        for column in 0..pattern.size() {
            let rows = &pattern.row_idx()[pattern.col_ptr()[column]..pattern.col_ptr()[column + 1]];
            prop_assert!(rows.is_sorted_by(|a, b| a < b));
            for row in 0..pattern.size() {
                let slot = pattern.slot(row, column);
                prop_assert_eq!(slot.is_some(), dense[(row, column)] != 0.0 || row == column);
                prop_assert_eq!(slot.is_some(), pattern.slot(column, row).is_some());
                prop_assert!(slot.is_none_or(|slot| pattern.row_idx()[slot] == row));
            }
        }
    }

    #[test]
    fn multiply_is_the_dense_product(elements in elements()) {
        let (pattern, values) = elements.assemble();
        let x = vector(pattern.size());
        let mut y = vec![f64::NAN; pattern.size()];
        pattern.multiply(&values, x.as_slice(), &mut y);
        let difference = to_dense(&pattern, &values) * x - nalgebra::DVector::from_vec(y);
        prop_assert!(difference.amax() < 1e-13);
    }

    #[test]
    fn vectors_are_added_on_all_dofs(elements in elements()) {
        let mut full = vec![0.0; elements.dofs.total()];
        let mut expected = full.clone();
        for (connectivity, matrices) in &elements.kinds {
            let n = connectivity.dofs_per_element();
            for (e, matrix) in matrices.iter().enumerate() {
                scatter::add_vector(connectivity, e, &matrix[..n], &mut full);
                for i in 0..n {
                    expected[connectivity.element(e)[i]] += matrix[i];
                }
            }
        }
        prop_assert_eq!(full, expected);
    }
}

#[test]
fn residual_of_prescribed_rows_is_the_reaction() {
    // A bar of two elements, pulled at its free end and held at the other.
    let bars = Connectivity::new(2, vec![0, 1, 1, 2]);
    let displacement = [0.0, 1.0, 2.0];
    let mut residual = [0.0; 3];
    for bar in 0..bars.len() {
        let mut d = [0.0; 2];
        bars.gather(bar, &displacement, &mut d);
        scatter::add_vector(&bars, bar, &[d[0] - d[1], d[1] - d[0]], &mut residual);
    }
    let expected: [f64; 3] = [-1.0, 0.0, 1.0];
    assert!(residual.iter().zip(expected).all(|(r, e)| (r - e).abs() < 1e-15));
}

#[test]
#[should_panic(expected = "the pattern was built without this connectivity")]
fn scatter_refuses_a_foreign_pattern() {
    let dofs = DofMap::new(&[false; 3]);
    let pattern = Pattern::new(&dofs, &[&Connectivity::new(2, vec![0, 1])]);
    let _ = Scatter::new(&pattern, &dofs, &Connectivity::new(2, vec![1, 2]));
}
