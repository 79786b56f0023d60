//! What the rows of the transfer keep, and what they refuse.

use partita_iga::transfer::{Row, TransferError, add_to_control_points, rows, to_points};
use partita_iga::{Side, Spline, build};
use partita_testing::with_hint;
use proptest::prelude::*;

use crate::support::{distance, noise, splines};

/// A curved patch whose weights differ everywhere, so that nothing holds by symmetry.
fn curved_patch(elements: usize) -> Spline<2> {
    let ring = build::quarter_annulus(1.0, 1.6).unwrap().elevate_degree(0, 1).subdivide(1, elements).unwrap();
    let mut noise = noise(7);
    let weights = ring.weights().iter().map(|w| w * (1.0 + 0.3 * noise())).collect();
    Spline::rational(ring.knots().to_vec(), ring.control_points().to_vec(), weights).unwrap()
}

const SIDES: [Side; 3] = [Side::RIGHT, Side::TOP, Side::BOTTOM];

/// Points on the three sides, corners included, with spacings unlike those of the knots.
fn points_on(patch: &Spline<2>, n: u32) -> Vec<[f64; 2]> {
    let place = |side: Side, share: f64| patch.side(side).0.point(&[share]);
    let mut points = Vec::new();
    for side in SIDES {
        points.extend((0..=n).map(|i| place(side, (f64::from(i) / f64::from(n)).powf(1.3))));
    }
    points
}

fn random(count: usize, seed: u64) -> Vec<[f64; 2]> {
    let mut noise = noise(seed);
    (0..count).map(|_| [noise(), noise()]).collect()
}

fn dot(a: &[[f64; 2]], b: &[[f64; 2]]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a[0] * b[0] + a[1] * b[1]).sum()
}

fn norm(a: &[[f64; 2]]) -> f64 {
    dot(a, a).sqrt()
}

fn total(forces: &[[f64; 2]]) -> [f64; 2] {
    forces.iter().fold([0.0; 2], |sum, force| [sum[0] + force[0], sum[1] + force[1]])
}

fn moment(points: &[[f64; 2]], forces: &[[f64; 2]]) -> f64 {
    points.iter().zip(forces).map(|(x, f)| x[0] * f[1] - x[1] * f[0]).sum()
}

fn forces_on_control_points(patch: &Spline<2>, rows: &[Row], forces: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut control = vec![[0.0; 2]; patch.control_points().len()];
    add_to_control_points(rows, forces, &mut control);
    control
}

/// Elements of the patch and points a side, from one much finer than the other to the reverse.
const RESOLUTIONS: [(usize, u32); 4] = [(1, 40), (4, 7), (16, 5), (40, 2)];

#[test]
fn transfer_conserves_total_force() {
    for (elements, n) in RESOLUTIONS {
        let patch = curved_patch(elements);
        let mut points = points_on(&patch, n);
        points
            .iter_mut()
            .zip(random(1000, 3))
            .for_each(|(x, noise)| *x = [x[0] + 0.01 * noise[0], x[1] + 0.01 * noise[1]]);
        let rows = rows(&patch, &SIDES, &points, 0.02).unwrap();
        let forces = random(points.len(), 1);
        let (before, after) = (total(&forces), total(&forces_on_control_points(&patch, &rows, &forces)));
        assert!(distance(&before, &after) < 1e-13 * norm(&forces), "{elements} elements, {n} points");
    }
}

#[test]
fn transfer_conserves_virtual_work() {
    for (elements, n) in RESOLUTIONS {
        let patch = curved_patch(elements);
        let points = points_on(&patch, n);
        let rows = rows(&patch, &SIDES, &points, 1e-10).unwrap();
        let (forces, displacement) = (random(points.len(), 1), random(patch.control_points().len(), 2));
        let mut at_points = vec![[0.0; 2]; points.len()];
        to_points(&rows, &displacement, &mut at_points);
        let outside = dot(&forces, &at_points);
        let inside = dot(&forces_on_control_points(&patch, &rows, &forces), &displacement);
        assert!((outside - inside).abs() < 1e-13 * norm(&forces) * norm(&displacement));
    }
}

#[test]
fn transfer_reproduces_the_place_of_points_on_the_patch_and_so_conserves_moments() {
    for (elements, n) in RESOLUTIONS {
        let patch = curved_patch(elements);
        let points = points_on(&patch, n);
        let rows = rows(&patch, &SIDES, &points, 1e-10).unwrap();
        let mut places = vec![[f64::NAN; 2]; points.len()];
        to_points(&rows, patch.control_points(), &mut places);
        for (place, point) in places.iter().zip(&points) {
            assert!(distance(place, point) < 1e-14);
        }
        let forces = random(points.len(), 1);
        let (before, after) = (
            moment(&points, &forces),
            moment(patch.control_points(), &forces_on_control_points(&patch, &rows, &forces)),
        );
        assert!((before - after).abs() < 1e-13 * norm(&forces) * norm(&points));
    }
}

#[test]
fn rigid_motions_of_the_patch_move_all_points_rigidly() {
    let patch = curved_patch(5);
    let points = points_on(&patch, 9);
    let rows = rows(&patch, &SIDES, &points, 1e-10).unwrap();
    let turn = |[x, y]: [f64; 2]| [0.2 - 0.1 * x - 0.7 * y, -0.3 + 0.7 * x - 0.1 * y];
    let displacement: Vec<_> = patch.control_points().iter().map(|x| turn(*x)).collect();
    let mut moved = vec![[0.0; 2]; points.len()];
    to_points(&rows, &displacement, &mut moved);
    for (moved, point) in moved.iter().zip(points) {
        assert!(distance(moved, &turn(point)) < 1e-14);
    }
}

proptest! {
    #[test]
    fn rows_at_the_corners_of_any_patch_are_exact(patch in splines::<3>(2)) {
        let n = patch.knots()[0].basis_count();
        let count = patch.control_points().len();
        let sides: Vec<Side> = patch.sides().collect();
        for corner in [0, n - 1, count - n, count - 1] {
            let position = patch.control_points()[corner];
            let row = rows(&patch, &sides, &[position], 1e-12).unwrap().remove(0);
            prop_assert_eq!((row.weights, row.distance), (vec![(corner, 1.0)], 0.0));
        }
    }

}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]

    #[test]
    fn rows_sum_to_one_and_are_not_negative(volume in splines::<3>(3), points in prop::collection::vec([-1.0..1.0, -1.0..1.0, -1.0..1.0], 1..5)) {
        let sides: Vec<Side> = volume.sides().collect();
        for row in rows(&volume, &sides, &points, 10.0).unwrap() {
            prop_assert!((row.weights.iter().map(|(_, weight)| weight).sum::<f64>() - 1.0).abs() < 1e-14);
            prop_assert!(row.weights.iter().all(|(_, weight)| *weight > 0.0));
            prop_assert!(row.weights.is_sorted_by(|(a, _), (b, _)| a < b));
            let (face, indices) = volume.side(row.side);
            prop_assert!(row.weights.iter().all(|(a, _)| indices.contains(a)));
            prop_assert_eq!(row.xi.len(), face.parameters());
        }
    }
}

#[test]
fn a_corner_that_is_missed_by_round_off_is_the_corner() {
    let plate = build::rectangle([0.0, 0.0], [0.35, 0.02], [3, 2], [35, 2]).unwrap();
    let corner = plate.control_points().len() - 1;
    for (dx, dy) in [(0.0, 0.0), (1e-15, 0.0), (-3e-15, 1e-15), (2e-15, -2e-15), (-1e-14, -1e-14)] {
        for sides in [[Side::TOP, Side::RIGHT], [Side::RIGHT, Side::TOP]] {
            let row = rows(&plate, &sides, &[[0.35 + dx, 0.02 + dy]], 1e-10).unwrap().remove(0);
            assert_eq!(row.weights, [(corner, 1.0)]);
        }
    }
}

#[test]
fn several_sides_share_the_control_point_at_their_corner() {
    let plate = build::rectangle([0.0, 0.0], [2.0, 1.0], [2, 2], [2, 1]).unwrap();
    let points = [[1.9, 1.0], [2.0, 1.0], [2.0, 0.9]];
    let rows = rows(&plate, &[Side::TOP, Side::RIGHT], &points, 1e-12).unwrap();
    let corner = plate.control_points().len() - 1;
    assert_eq!(rows.iter().map(|row| row.side).collect::<Vec<_>>(), [Side::TOP, Side::TOP, Side::RIGHT]);
    assert!(rows.iter().all(|row| row.weights.iter().filter(|(a, _)| *a == corner).count() == 1));
}

#[test]
fn the_nearest_side_wins() {
    let plate = build::rectangle([0.0, 0.0], [2.0, 1.0], [1, 1], [2, 2]).unwrap();
    let sides: Vec<Side> = plate.sides().collect();
    let points = [[0.1, 0.5], [1.95, 0.4], [1.0, 0.1], [1.0, 0.8]];
    let rows = rows(&plate, &sides, &points, 0.3).unwrap();
    assert_eq!(
        rows.iter().map(|row| row.side).collect::<Vec<_>>(),
        [Side::LEFT, Side::RIGHT, Side::BOTTOM, Side::TOP]
    );
    assert!((rows[3].distance - 0.2).abs() < 1e-15);
    assert!((rows[3].xi[0] - 0.5).abs() < 1e-15);
}

#[test]
fn faces_of_a_volume_conserve_force_and_moment_too() {
    let cuboid = build::cuboid([0.0; 3], [1.0, 2.0, 0.5], [2, 3, 1], [3, 2, 1]).unwrap();
    let points = [[0.2, 0.3, 0.5], [1.0, 1.7, 0.2], [0.77, 2.0, 0.5], [1.0, 2.0, 0.5]];
    let rows = rows(&cuboid, &[Side::BACK, Side::RIGHT], &points, 1e-12).unwrap();
    let mut places = [[0.0; 3]; 4];
    to_points(&rows, cuboid.control_points(), &mut places);
    for (place, point) in places.iter().zip(&points) {
        assert!(distance(place, point) < 1e-14);
    }
}

#[test]
fn a_point_beyond_the_tolerance_is_named_with_its_place_and_distance() {
    let plate = build::rectangle([0.0, 0.0], [2.0, 1.0], [2, 1], [4, 1]).unwrap();
    let points = [[0.5, 1.0], [1.5, 1.25], [1.0, 3.0]];
    let error = rows(&plate, &[Side::TOP], &points, 1e-3).unwrap_err();
    insta::assert_snapshot!(with_hint(&error), @r"
    point 1 at [1.5, 1.25] lies 0.25 away from the nearest side `top`, which is more than the tolerance of 0.001 (lengths in the unit of the patch)
    hint: check that points and patch show the same shape, in the same place and unit; if they do, raise the tolerance above 0.25
    ");
}

#[test]
fn what_cannot_be_projected_is_refused() {
    let plate = build::rectangle([0.0, 0.0], [2.0, 1.0], [2, 1], [4, 1]).unwrap();
    assert_eq!(rows(&plate, &[], &[[0.0, 0.0]], 1.0), Err(TransferError::NoSides));
    let missing = rows(&plate, &[Side::TOP, Side::FRONT], &[[0.0, 0.0]], 1.0);
    assert_eq!(missing, Err(TransferError::NoSuchSide { side: Side::FRONT, parameters: 2 }));
    let nan = rows(&plate, &[Side::TOP], &[[0.0, 1.0], [f64::NAN, 1.0]], 1.0);
    assert!(matches!(nan, Err(TransferError::NotFinite { index: 1, .. })));
    let tolerance = rows(&plate, &[Side::TOP], &[[0.0, 1.0]], f64::NAN);
    assert!(matches!(tolerance, Err(TransferError::TooFar { index: 0, .. })));
}
