//! Ready-made shapes are what they are called.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use partita_iga::build::{self, BuildError};
use partita_iga::{BasisValues, Derivatives, Side, Spline};
use proptest::prelude::*;

use crate::support::distance;

fn largest_defect(curve: &Spline<2>, defect: impl Fn([f64; 2]) -> f64) -> f64 {
    (0..=1000).map(|i| defect(curve.point(&[f64::from(i) / 1000.0])).abs()).fold(0.0, f64::max)
}

#[test]
fn a_circle_is_round_and_closed() {
    let circle = build::circle([1.0, -2.0], 3.0).unwrap();
    assert!(largest_defect(&circle, |[x, y]| (x - 1.0).hypot(y + 2.0) - 3.0) < 2e-15);
    assert_eq!(circle.point(&[0.0]), circle.point(&[1.0]));
    assert!(distance(&circle.point(&[0.5]), &[-2.0, -2.0]) < 1e-15);
}

#[test]
fn a_full_arc_is_the_circle() {
    let (arc, circle) =
        (build::arc([0.5, 0.0], 2.0, 0.0, TAU).unwrap(), build::circle([0.5, 0.0], 2.0).unwrap());
    assert_eq!(arc.knots(), circle.knots());
    for i in 0..=100 {
        let xi = f64::from(i) / 100.0;
        assert!(distance(&arc.point(&[xi]), &circle.point(&[xi])) < 4e-15);
    }
}

proptest! {
    #[test]
    fn an_arc_is_round_and_ends_where_it_should(radius in 0.1..10.0, start in -PI..PI, sweep in -TAU..TAU) {
        prop_assume!(sweep.abs() > 1e-3);
        let arc = build::arc([0.0, 0.0], radius, start, sweep).unwrap();
        prop_assert!(largest_defect(&arc, |[x, y]| x.hypot(y) / radius - 1.0) < 1e-14);
        let on_circle = |angle: f64| [radius * angle.cos(), radius * angle.sin()];
        prop_assert!(distance(&arc.point(&[0.0]), &on_circle(start)) < 1e-14 * radius);
        prop_assert!(distance(&arc.point(&[0.5]), &on_circle(start + 0.5 * sweep)) < 1e-14 * radius);
        prop_assert!(distance(&arc.point(&[1.0]), &on_circle(start + sweep)) < 1e-14 * radius);
        prop_assert!(arc.element_count() as f64 <= 1.0 + sweep.abs() / FRAC_PI_2);
    }
}

#[test]
fn a_quarter_annulus_is_round_between_its_radii_and_oriented() {
    let ring = build::quarter_annulus(1.0, 1.8).unwrap().elevate_degree(0, 1).subdivide(1, 4).unwrap();
    let mut basis = BasisValues::new(&ring);
    for (i, j) in (0..=20).flat_map(|i| (0..=20).map(move |j| (i, j))) {
        let xi = [f64::from(i) / 20.0, f64::from(j) / 20.0];
        ring.basis(&xi, Derivatives::First, &mut basis);
        let [x, y] = basis.value_of(ring.control_points());
        assert!((x.hypot(y) - (1.0 + 0.8 * xi[0])).abs() < 1e-15 * 4.0);
        let [outwards, around, _] = basis.first_of(ring.control_points());
        assert!(outwards[0] * around[1] - outwards[1] * around[0] > 0.0);
    }
    let (bottom, _) = ring.side(Side::BOTTOM);
    assert_eq!((bottom.point(&[0.0]), bottom.point(&[1.0])), ([1.0, 0.0], [1.8, 0.0]));
}

#[test]
fn a_cuboid_is_an_affine_map_of_any_degree() {
    let cuboid = build::cuboid([1.0, 2.0, 3.0], [2.0, 0.5, 0.1], [3, 2, 1], [4, 3, 2]).unwrap();
    assert_eq!(cuboid.control_points().len(), 7 * 5 * 3);
    for xi in [[0.0, 0.0, 0.0], [0.3, 0.9, 0.2], [1.0, 0.5, 1.0]] {
        let expected = [1.0 + 2.0 * xi[0], 2.0 + 0.5 * xi[1], 3.0 + 0.1 * xi[2]];
        assert!(distance(&cuboid.point(&xi), &expected) < 2e-15);
    }
}

#[test]
fn a_line_runs_at_constant_speed_between_its_exact_ends() {
    let line = build::line([0.1, 0.7, 0.3], [0.7, 0.1, 0.2], 3, 5).unwrap();
    assert_eq!((line.point(&[0.0]), line.point(&[1.0])), ([0.1, 0.7, 0.3], [0.7, 0.1, 0.2]));
    for xi in [0.0, 0.21, 0.8, 1.0] {
        assert!(distance(&line.tangent(&[xi], 0), &[0.6, -0.6, -0.1]) < 1e-14);
    }
}

#[test]
fn impossible_shapes_are_refused() {
    assert_eq!(build::circle([0.0; 2], -1.0), Err(BuildError::Extent { extent: -1.0 }));
    assert_eq!(build::arc([0.0; 2], 1.0, 0.0, 7.0), Err(BuildError::Sweep { sweep: 7.0 }));
    assert_eq!(build::arc([0.0; 2], 1.0, 0.0, 0.0), Err(BuildError::Sweep { sweep: 0.0 }));
    assert_eq!(build::quarter_annulus(2.0, 2.0), Err(BuildError::Extent { extent: 0.0 }));
    assert_eq!(
        build::rectangle([0.0; 2], [1.0, 0.0], [1, 1], [1, 1]),
        Err(BuildError::Extent { extent: 0.0 })
    );
    assert!(matches!(build::rectangle([0.0; 2], [1.0; 2], [0, 1], [1, 1]), Err(BuildError::Knots(_))));
    assert!(matches!(build::line([f64::NAN], [1.0], 1, 1), Err(BuildError::Spline(_))));
}
