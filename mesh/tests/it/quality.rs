//! The shape quality is 1 for regular simplices only and does not depend on size, place or numbering.

use approx::assert_relative_eq;
use partita_mesh::generate::Diagonal;
use partita_mesh::quality::{shape_quality, summary};
use proptest::prelude::*;

use crate::boxes::{unit_cube, unit_square};

#[test]
fn regular_simplices_have_quality_one() {
    let triangle = [[0.0, 0.0], [1.0, 0.0], [0.5, 0.75_f64.sqrt()]];
    assert_relative_eq!(shape_quality(&triangle), 1.0, max_relative = 1e-14);
    let tetrahedron = [[1.0, 1.0, 1.0], [-1.0, 1.0, -1.0], [1.0, -1.0, -1.0], [-1.0, -1.0, 1.0]];
    assert_relative_eq!(shape_quality(&tetrahedron), 1.0, max_relative = 1e-14);
}

#[test]
fn quality_has_its_values_by_hand() {
    // 4 sqrt(3) area / sum l^2.
    let right = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
    assert_relative_eq!(shape_quality(&right), 0.75_f64.sqrt(), max_relative = 1e-14);
    // 12 (3 volume)^(2/3) / sum l^2.
    let corner = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    assert_relative_eq!(shape_quality(&corner), 12.0 / 9.0 * 0.5_f64.powf(2.0 / 3.0), max_relative = 1e-14);
}

#[test]
fn flat_and_inverted_simplices_are_not_positive() {
    assert_relative_eq!(shape_quality(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]]), 0.0);
    assert!(shape_quality(&[[0.0, 0.0], [0.0, 1.0], [1.0, 0.0]]) < 0.0);
}

#[test]
fn summary_finds_the_worst_cells() {
    let mesh = unit_square(2, Diagonal::Crossed);
    // The centre node of the first square moves towards its lower edge.
    let mut points = mesh.points().to_vec();
    points[9] = [0.25, 0.05];
    let summary = summary(&points, mesh.cells());
    assert_eq!((summary.smallest_cell, summary.worst_cell), (0, 0));
    assert_relative_eq!(summary.smallest_measure, 0.5 * 0.5 * 0.05, max_relative = 1e-13);
    assert_relative_eq!(summary.total_measure, 1.0, max_relative = 1e-13);
    assert!(summary.worst_quality < summary.mean_quality);
}

#[test]
fn kuhn_tetrahedra_are_all_alike() {
    let mesh = unit_cube(2);
    let summary = summary(mesh.points(), mesh.cells());
    assert_relative_eq!(summary.smallest_measure, 1.0 / 48.0, max_relative = 1e-13);
    assert_relative_eq!(summary.worst_quality, summary.mean_quality, max_relative = 1e-13);
    // Edges squared of one in the unit cube: 1 + 1 + 1 + 2 + 2 + 3 = 10.
    assert_relative_eq!(summary.mean_quality, 1.2 * 0.5_f64.powf(2.0 / 3.0), max_relative = 1e-13);
}

proptest! {
    #[test]
    fn quality_is_invariant_and_at_most_one(
        vertices in prop::array::uniform4(prop::array::uniform3(-1.0..1.0)),
        scale in 1e-3..1e3, shift in -10.0..10.0, angle in 0.0..6.0_f64,
    ) {
        let quality = shape_quality(&vertices);
        prop_assume!(quality.abs() > 1e-2);
        prop_assert!(quality <= 1.0 + 1e-14);
        let (sin, cos) = angle.sin_cos();
        let moved = vertices.map(|[x, y, z]| {
            [scale * (cos * x - sin * y) + shift, scale * (sin * x + cos * y), scale * z - shift]
        });
        prop_assert!((shape_quality(&moved) - quality).abs() < 1e-7);
        let [a, b, c, d] = vertices;
        prop_assert!((shape_quality(&[b, c, a, d]) - quality).abs() < 1e-12);
        prop_assert!((shape_quality(&[b, a, c, d]) + quality).abs() < 1e-12);
    }
}
