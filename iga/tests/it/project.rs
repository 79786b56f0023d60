//! Closest points.

use partita_iga::project::{Projector, closest_point};
use partita_iga::{Knots, Side, Spline, build};
use proptest::prelude::*;

use crate::support::{distance, parameters_at, splines, splines_with_parameters};

/// Smallest distance over `n` samples along each parameter.
fn brute_force<const D: usize>(spline: &Spline<D>, point: &[f64; D], n: usize) -> f64 {
    let total = n.pow(u32::try_from(spline.parameters()).unwrap());
    let samples = (0..total).map(|index| {
        let shares: Vec<f64> = (0..spline.parameters())
            .map(|i| (index / n.pow(u32::try_from(i).unwrap()) % n) as f64 / (n - 1) as f64)
            .collect();
        distance(&spline.point(&parameters_at(spline, &shares)), point)
    });
    samples.fold(f64::INFINITY, f64::min)
}

proptest! {
    #[test]
    fn no_point_of_a_curve_is_closer(curve in splines::<2>(1), point in [-2.0..2.0, -2.0..2.0]) {
        let projection = closest_point(&curve, &point);
        prop_assert!(projection.distance <= brute_force(&curve, &point, 2000) + 1e-12);
        prop_assert!((distance(&projection.point, &point) - projection.distance).abs() < 1e-15);
        prop_assert!(distance(&curve.point(&projection.xi), &projection.point) < 1e-14);
    }

    #[test]
    fn the_way_to_an_inner_closest_point_is_normal_to_the_curve(curve in splines::<2>(1), point in [-2.0..2.0, -2.0..2.0]) {
        let projection = closest_point(&curve, &point);
        let at_knot = curve.knots()[0].breaks().any(|(knot, _)| (knot - projection.xi[0]).abs() < 1e-6);
        if !at_knot {
            let tangent = curve.tangent(&projection.xi, 0);
            let along: f64 = (0..2).map(|c| tangent[c] * (projection.point[c] - point[c])).sum();
            let speed = |share: f64| distance(&curve.tangent(&parameters_at(&curve, &[share]), 0), &[0.0; 2]);
            let fastest = (0..=100).map(|i| speed(0.01 * f64::from(i))).fold(0.0, f64::max);
            prop_assert!(along.abs() < 1e-13 * fastest, "{along}");
        }
    }

    #[test]
    fn a_point_of_a_curve_is_its_own_closest_point((curve, xi) in splines_with_parameters::<3>(1)) {
        let point = curve.point(&xi);
        let projection = closest_point(&curve, &point);
        prop_assert!(projection.distance < 1e-14);
        let again = closest_point(&curve, &projection.point);
        prop_assert!(distance(&again.point, &projection.point) < 1e-14);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn no_point_of_a_surface_is_closer(surface in splines::<3>(2), point in [-2.0..2.0, -2.0..2.0, -2.0..2.0]) {
        let projection = closest_point(&surface, &point);
        prop_assert!(projection.distance <= brute_force(&surface, &point, 100) + 1e-12);
        prop_assert!(distance(&surface.point(&projection.xi), &projection.point) < 1e-14);
    }

    #[test]
    fn a_point_of_a_surface_is_its_own_closest_point((surface, xi) in splines_with_parameters::<3>(2)) {
        let projection = closest_point(&surface, &surface.point(&xi));
        prop_assert!(projection.distance < 1e-12, "{}", projection.distance);
    }
}

#[test]
fn the_closest_point_of_a_circle_is_on_the_ray_from_its_center() {
    let circle = build::circle([1.0, 2.0], 1.5).unwrap();
    let mut projector = Projector::new(&circle);
    for (radius, angle) in [(0.1, 0.3), (1.0, 2.0), (1.5, 4.0), (3.0, 5.5), (1e3, 1.1), (1e6, 3.3)] {
        let on_ray = |r: f64| [1.0 + r * f64::cos(angle), 2.0 + r * f64::sin(angle)];
        let projection = projector.closest_point(&on_ray(radius));
        assert!((projection.distance - (radius - 1.5).abs()).abs() < 1e-15 * (4.0 + radius));
        assert!(distance(&projection.point, &on_ray(1.5)) < 1e-13, "from radius {radius}");
    }
    assert!((projector.closest_point(&[1.0, 2.0]).distance - 1.5).abs() < 1e-15);
}

/// The parameter of a projection to a straight line is known; Newton must find all its digits.
#[test]
fn parameters_are_exact_to_round_off() {
    let line = build::line([0.0, 0.0], [2.0, 0.0], 3, 7).unwrap();
    let mut projector = Projector::new(&line);
    for i in 0..=100 {
        let x = 0.02 * f64::from(i);
        for y in [0.0, 1e-3, -5.0] {
            let xi = projector.closest_point(&[x, y]).xi[0];
            assert!((xi - 0.5 * x).abs() < 2e-15, "({x}, {y}): {xi}");
        }
    }
}

#[test]
fn ends_are_exact_to_the_last_bit() {
    let knots = Knots::new(3, [[0.1; 4].as_slice(), &[0.25, 0.4], &[0.7; 4]].concat()).unwrap();
    let points = vec![[0.1, 0.1], [0.3, 0.4], [0.7, 0.2], [0.9, 0.3], [1.0, 0.9], [1.1, 0.95]];
    let curve = Spline::rational(vec![knots], points, vec![1.0, 2.0, 0.5, 1.5, 1.0, 0.7]).unwrap();
    let mut projector = Projector::new(&curve);
    for (end, place, outwards) in [(0.1, [0.1, 0.1], [-0.2, -0.3]), (0.7, [1.1, 0.95], [0.1, 0.05])] {
        let normal = [-outwards[1], outwards[0]];
        for (out, aside) in
            [(0.0, 0.0), (1.0, 0.0), (1e-12, 0.0), (-1e-13, 0.0), (0.0, 0.1), (0.0, -0.1), (1e-13, 1.0)]
        {
            let point = [0, 1].map(|c| place[c] + out * outwards[c] + aside * normal[c]);
            assert_eq!(projector.closest_point(&point).xi, [end], "{out} outwards, {aside} aside");
        }
        // A node that really lies inside stays inside.
        let inside = [0, 1].map(|c| place[c] - 1e-7 * outwards[c]);
        assert!((projector.closest_point(&inside).xi[0] - end).abs() > 1e-9);
    }
}

/// Only ends of the spline hold points that miss them by little; a knot inside is a place like any other.
#[test]
fn next_to_an_inner_knot_no_digit_is_lost() {
    let line = build::line([0.0, 0.0], [1.0, 0.0], 2, 2).unwrap();
    for offset in [-3e-11, -1e-13, 0.0, 1e-13, 3e-11] {
        let xi = closest_point(&line, &[0.5 + offset, 0.0]).xi[0];
        assert!((xi - 0.5 - offset).abs() < 2e-16, "{offset}: {}", xi - 0.5);
    }
}

#[test]
fn a_kink_is_the_closest_point_of_what_lies_before_it() {
    let knots = Knots::new(2, vec![0.0, 0.0, 0.0, 0.5, 0.5, 1.0, 1.0, 1.0]).unwrap();
    let roof =
        Spline::new(vec![knots], vec![[-1.0, 0.0], [-0.5, 0.5], [0.0, 1.0], [0.5, 0.5], [1.0, 0.0]]).unwrap();
    let projection = closest_point(&roof, &[0.05, 1.5]);
    assert_eq!((projection.xi.as_slice(), projection.point), ([0.5].as_slice(), [0.0, 1.0]));
}

#[test]
fn the_nearer_of_two_arms_wins() {
    // A hairpin: from any point between the arms both have a local minimum.
    let knots = Knots::uniform(2, 4).unwrap();
    let points = vec![[0.0, 0.0], [1.0, 0.0], [2.0, 0.05], [2.0, 0.15], [1.0, 0.2], [0.0, 0.2]];
    let hairpin = Spline::new(vec![knots], points).unwrap();
    let mut projector = Projector::new(&hairpin);
    assert!(projector.closest_point(&[0.4, 0.099]).xi[0] < 0.5);
    assert!(projector.closest_point(&[0.4, 0.101]).xi[0] > 0.5);
}

#[test]
fn inside_a_patch_projection_inverts_the_map() {
    let ring = build::quarter_annulus(1.0, 2.0).unwrap().elevate_degree(0, 1).subdivide(1, 3).unwrap();
    let mut projector = Projector::new(&ring);
    for (i, j) in (0..=10).flat_map(|i| (0..=10).map(move |j| (i, j))) {
        let xi = [f64::from(i) / 10.0, f64::from(j) / 10.0];
        let found = projector.closest_point(&ring.point(&xi));
        assert!(found.distance < 1e-15, "{xi:?}");
        assert!((found.xi[0] - xi[0]).abs() < 1e-14 && (found.xi[1] - xi[1]).abs() < 1e-14, "{xi:?}");
    }
}

#[test]
fn a_volume_is_closest_at_a_face_an_edge_or_a_corner() {
    let cuboid = build::cuboid([0.0; 3], [1.0, 2.0, 3.0], [2, 1, 2], [2, 2, 1]).unwrap();
    let mut projector = Projector::new(&cuboid);
    let face = projector.closest_point(&[0.3, 1.0, 4.0]);
    assert!((face.xi[0] - 0.3).abs() < 1e-14 && (face.xi[1] - 0.5).abs() < 1e-14 && face.xi[2] == 1.0);
    let edge = projector.closest_point(&[-1.0, 1.5, 4.0]);
    assert!(edge.xi[0] == 0.0 && (edge.xi[1] - 0.75).abs() < 1e-14 && edge.xi[2] == 1.0);
    assert_eq!(projector.closest_point(&[-1.0, 3.0, -1.0]).xi, [0.0, 1.0, 0.0]);
}

#[test]
fn a_surface_that_collapses_to_a_pole_is_no_obstacle() {
    // A disc sector: the inner side is one point.
    let knots = vec![Knots::uniform(1, 1).unwrap(), Knots::uniform(2, 1).unwrap()];
    let points = vec![[0.0, 0.0], [1.0, 0.0], [0.0, 0.0], [1.0, 1.0], [0.0, 0.0], [0.0, 1.0]];
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let sector = Spline::rational(knots, points, vec![1.0, 1.0, half, half, 1.0, 1.0]).unwrap();
    let mut projector = Projector::new(&sector);
    assert_eq!(projector.closest_point(&[-1.0, -1.0]).point, [0.0, 0.0]);
    assert!(projector.closest_point(&[0.3, 0.2]).distance < 1e-15);
    assert!((projector.closest_point(&[3.0, 4.0]).distance - 4.0).abs() < 1e-14);
}

#[test]
fn an_element_without_a_number_inside_is_no_obstacle() {
    let [a, b] = [0.5, 0.5 + 0.5 * f64::EPSILON];
    let knots = Knots::new(2, vec![0.0, 0.0, 0.0, a, a, b, b, 1.0, 1.0, 1.0]).unwrap();
    let points = vec![[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 0.5], [2.0, 1.0], [1.0, 1.0], [0.0, 1.0]];
    let curve = Spline::new(vec![knots], points).unwrap();
    assert!((closest_point(&curve, &[3.0, 0.5]).distance - 1.25f64.sqrt()).abs() < 1e-15);
}

#[test]
fn the_end_of_a_curve_is_a_point_like_any_other_side() {
    let (tip, _) = build::line([0.0, 0.0], [3.0, 0.0], 2, 2).unwrap().side(Side::RIGHT);
    let projection = closest_point(&tip, &[3.0, 4.0]);
    assert_eq!((projection.xi.len(), projection.distance), (0, 4.0));
}

#[test]
#[should_panic(expected = "not finite")]
fn a_point_that_is_not_finite_is_refused() {
    let _ = closest_point(&build::circle([0.0; 2], 1.0).unwrap(), &[f64::NAN, 0.0]);
}
