//! Conservation by matrix transfers of any shape.

use partita_coupling::conformance::check_transfer;
use partita_coupling::{IdentityTransfer, MatrixTransfer};
use proptest::prelude::*;

/// Rows of positive weights that sum to one.
fn partition_of_unity(points: usize) -> impl Strategy<Value = Vec<Vec<(usize, f64)>>> {
    let row = prop::collection::vec((0..points, 0.01_f64..1.0), 1..5).prop_map(|row| {
        let sum: f64 = row.iter().map(|(_, weight)| weight).sum();
        row.into_iter().map(|(point, weight)| (point, weight / sum)).collect::<Vec<_>>()
    });
    prop::collection::vec(row, 1..20)
}

proptest! {
    #[test]
    fn matrix_transfer_keeps_virtual_work_and_total_force(
        (points, rows) in (1_usize..10).prop_flat_map(|points| (Just(points), partition_of_unity(points))),
        components in 1_usize..4,
    ) {
        let transfer = MatrixTransfer::from_rows(points, components, &rows).unwrap();
        check_transfer(&transfer, components, 1e-13).unwrap();
    }
}

#[test]
fn identity_is_a_conforming_transfer() {
    check_transfer(&IdentityTransfer::new(12), 3, 0.0).unwrap();
}

#[test]
fn basis_that_vanishes_at_the_last_knot_is_noticed() {
    let rows = [vec![(0, 1.0)], vec![(0, 0.5), (1, 0.5)], vec![(1, 0.0)]];
    let transfer = MatrixTransfer::from_rows(2, 2, &rows).unwrap();
    let violation = check_transfer(&transfer, 2, 1e-12).unwrap_err();
    assert_eq!(
        violation.to_string(),
        "transfer: a unit translation in component 0 moves component 0 of point 2 by 0e0"
    );
}

#[test]
fn rows_that_make_no_sense_are_refused() {
    let empty = MatrixTransfer::from_rows(2, 1, &[vec![(0, 1.0)], vec![]]).unwrap_err();
    assert_eq!(empty.to_string(), "transfer row 1: no weight at all");
    let outside = MatrixTransfer::from_rows(2, 1, &[vec![(2, 1.0)]]).unwrap_err();
    assert_eq!(outside.to_string(), "transfer row 0: point 2 does not exist, there are 2");
    assert!(MatrixTransfer::from_rows(2, 1, &[vec![(1, f64::NAN)]]).is_err());
}
