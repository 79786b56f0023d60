//! Curved beams and strips: round, of constant thickness, smooth where they are said to be.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_3, PI, TAU};

use partita_iga::build::{self, Alignment, BuildError};
use partita_iga::{BasisValues, Derivatives, KnotError, Knots, Spline, fit, orientation};
use proptest::prelude::*;

use crate::support::distance;

/// Points of the parameter domain, its ends included.
fn shares(count: usize) -> impl Iterator<Item = f64> {
    (0..=count).map(move |i| i as f64 / count as f64)
}

/// Area by the Gauss rule with 2 points in each direction of `parts` equal cells an element.
fn area(patch: &Spline<2>, parts: usize) -> f64 {
    let fine = patch.subdivide(0, parts).unwrap().subdivide(1, parts).unwrap();
    let gauss = [0.5 - 0.5 / 3_f64.sqrt(), 0.5 + 0.5 / 3_f64.sqrt()];
    let mut basis = BasisValues::new(&fine);
    let mut area = 0.0;
    for element in fine.elements() {
        for unit in gauss.into_iter().flat_map(|u| gauss.map(|v| [u, v])) {
            fine.basis(&element.at(unit), Derivatives::First, &mut basis);
            let [x, y, _] = basis.first_of(fine.control_points());
            area += 0.25 * element.measure() * (x[0] * y[1] - x[1] * y[0]);
        }
    }
    area
}

#[test]
fn a_sector_is_round_at_every_depth_and_spans_its_angle() {
    for (sweep, elements, degree) in [(0.3, 1, 2), (-2.0, 7, 3), (PI, 2, 2), (-4.0, 5, 4), (TAU, 11, 2)] {
        let sector = build::annular_sector([1.0, -2.0], [0.8, 1.2], 0.4, sweep, [degree, 2], [elements, 3]);
        let sector = sector.unwrap();
        assert_eq!(sector.element_count(), 3 * elements);
        let degrees: Vec<usize> = sector.knots().iter().map(Knots::degree).collect();
        assert_eq!(degrees, [degree, 2]);
        for (xi, eta) in shares(50).flat_map(|xi| shares(4).map(move |eta| (xi, eta))) {
            let [x, y] = sector.point(&[xi, eta]);
            let radius = if sweep > 0.0 { 1.2 - 0.4 * eta } else { 0.8 + 0.4 * eta };
            assert!(((x - 1.0).hypot(y + 2.0) - radius).abs() < 1e-14, "sweep {sweep} at {xi}, {eta}");
        }
        let end = |angle: f64| [1.0 + angle.cos(), -2.0 + angle.sin()];
        assert!(distance(&sector.point(&[0.0, 0.5]), &end(0.4)) < 1e-14);
        assert!(distance(&sector.point(&[1.0, 0.5]), &end(0.4 + sweep)) < 1e-14);
        assert!(orientation::check(&sector).unwrap().value > 0.999_999);
    }
}

#[test]
fn the_area_of_a_sector_converges_to_its_own() {
    let sector = build::annular_sector([0.0; 2], [1.0, 1.5], 0.2, 2.5, [2, 1], [3, 1]).unwrap();
    let exact = 0.5 * 2.5 * (1.5 * 1.5 - 1.0);
    let error = |parts| (area(&sector, parts) - exact).abs();
    let order = (error(8) / error(16)).log2();
    assert!((order - 4.0).abs() < 0.1, "order {order}");
    // Two steps of Richardson's extrapolation from order 4.
    let [a, b, c] = [8, 16, 32].map(|parts| area(&sector, parts));
    let [ab, bc] = [(16.0 * b - a) / 15.0, (16.0 * c - b) / 15.0];
    assert!(((64.0 * bc - ab) / 63.0 - exact).abs() < 1e-12);
}

proptest! {
    #[test]
    fn a_sector_has_the_elements_asked_for_and_equal_shares(
        sweep in 0.01..=TAU, clockwise in any::<bool>(), elements in 3_usize..40, degree in 2_usize..5,
    ) {
        let sweep = if clockwise { -sweep } else { sweep };
        let sector = build::annular_sector([0.0; 2], [1.0, 1.1], 0.0, sweep, [degree, 1], [elements, 1]).unwrap();
        let knots = &sector.knots()[0];
        prop_assert_eq!(knots.element_count(), elements);
        for (e, [start, _]) in (0..elements).map(|e| (e, knots.element(e))) {
            prop_assert_eq!(start, e as f64 / elements as f64);
            let [x, y] = sector.point(&[start, 0.0]);
            let angle = y.atan2(x).rem_euclid(TAU);
            let share = if clockwise { (TAU - angle).rem_euclid(TAU) } else { angle } / sweep.abs();
            // Inside a piece of 120 degrees the parameter runs up to a third faster than at its ends.
            prop_assert!((share - start).abs() < 0.02, "{} instead of {}", share, start);
            let smooth = knots.multiplicity(start) == if e == 0 { degree + 1 } else { 1 };
            prop_assert!(smooth || knots.multiplicity(start) == degree, "a joint is continuous");
        }
        let joints = knots.breaks().filter(|(_, multiplicity)| *multiplicity > 1).count() - 2;
        prop_assert!(sweep.abs() > 2.0 * FRAC_PI_3 || joints == 0, "a short arc is one piece");
    }
}

#[test]
fn impossible_sectors_are_refused() {
    let sector =
        |radii, sweep, degree, elements| build::annular_sector([0.0; 2], radii, 0.0, sweep, degree, elements);
    let ring = [1.0, 1.2];
    assert_eq!(sector([1.0, 1.0], 1.0, [2, 1], [1, 1]), Err(BuildError::Extent { extent: 0.0 }));
    assert_eq!(sector([-1.0, 1.0], 1.0, [2, 1], [1, 1]), Err(BuildError::Extent { extent: -1.0 }));
    assert_eq!(sector(ring, 0.0, [2, 1], [1, 1]), Err(BuildError::Sweep { sweep: 0.0 }));
    assert_eq!(sector(ring, 1.0, [1, 1], [1, 1]), Err(BuildError::ArcDegree { degree: 1 }));
    assert_eq!(sector(ring, 1.0, [2, 0], [1, 1]), Err(BuildError::Knots(KnotError::DegreeZero)));
    assert_eq!(sector(ring, 1.0, [2, 1], [1, 0]), Err(BuildError::Knots(KnotError::NoElements)));
    assert_eq!(sector(ring, 1.0, [2, 1], [0, 1]), Err(BuildError::TooFewElements { found: 0, needed: 1 }));
    assert_eq!(sector(ring, PI, [2, 1], [1, 1]), Err(BuildError::TooFewElements { found: 1, needed: 2 }));
    assert_eq!(sector(ring, TAU, [2, 1], [2, 1]), Err(BuildError::TooFewElements { found: 2, needed: 3 }));
    assert!(sector(ring, TAU, [2, 1], [3, 1]).is_ok());
    assert!(sector(ring, 2.0 * FRAC_PI_3, [2, 1], [1, 1]).is_ok());
}

/// A curve through points of a wave.
fn wave(degree: usize, points: usize) -> (Spline<2>, Vec<[f64; 2]>, Vec<f64>) {
    let points: Vec<[f64; 2]> = shares(points - 1).map(|t| [3.0 * t, 0.4 * (4.0 * t).sin()]).collect();
    let (curve, parameters) = fit::through(&points, degree).unwrap();
    (curve, points, parameters)
}

#[test]
fn a_strip_of_the_curves_degree_passes_through_its_points() {
    for (alignment, eta) in [(Alignment::Bottom, 0.0), (Alignment::Middle, 0.5), (Alignment::Top, 1.0)] {
        for degree in 1..=3 {
            let (curve, points, parameters) = wave(degree.max(2), 9);
            let strip = build::strip(&curve, 0.05, alignment, [degree.max(2), 2], [17, 2]).unwrap();
            for (point, xi) in points.iter().zip(parameters) {
                assert!(distance(&strip.point(&[xi, eta]), point) < 1e-14, "degree {degree}, {alignment:?}");
            }
        }
    }
}

/// Largest deviation of the sides from the offsets of the curve, and of the thickness from what was asked for.
fn defects(curve: &Spline<2>, strip: &Spline<2>, thickness: f64, alignment: Alignment) -> [f64; 2] {
    let [a, b] = match alignment {
        Alignment::Bottom => [0.0, thickness],
        Alignment::Middle => [-0.5 * thickness, 0.5 * thickness],
        Alignment::Top => [-thickness, 0.0],
    };
    let mut worst = [0.0_f64; 2];
    let along = &strip.knots()[0];
    let places = (0..along.element_count()).flat_map(|e| {
        let [start, end] = along.element(e);
        shares(8).map(move |share| (1.0 - share) * start + share * end)
    });
    for xi in places {
        let ([x, y], [u, v]) = (curve.point(&[xi]), curve.tangent(&[xi], 0));
        let speed = u.hypot(v);
        let offset = |by: f64| [x - by * v / speed, y + by * u / speed];
        let (bottom, top) = (strip.point(&[xi, 0.0]), strip.point(&[xi, 1.0]));
        worst[0] = worst[0].max(distance(&bottom, &offset(a))).max(distance(&top, &offset(b)));
        worst[1] = worst[1].max((distance(&bottom, &top) - thickness).abs());
    }
    worst
}

#[test]
fn sides_and_thickness_converge_with_one_order_more_than_the_degree() {
    for (curve_degree, degree) in [(3, 1), (3, 2), (3, 3), (2, 2), (2, 3), (4, 3)] {
        for alignment in [Alignment::Bottom, Alignment::Middle, Alignment::Top] {
            let (curve, ..) = wave(curve_degree, 6);
            let spans = curve.element_count();
            let defects = |parts: usize| {
                let strip = build::strip(&curve, 0.1, alignment, [degree, 1], [parts * spans, 1]).unwrap();
                defects(&curve, &strip, 0.1, alignment)
            };
            let (coarse, fine) = (defects(64), defects(128));
            for (coarse, fine) in coarse.into_iter().zip(fine) {
                let order = (coarse / fine).log2();
                assert!(
                    order > degree as f64 + 0.75,
                    "degree {degree} of {curve_degree}, {alignment:?}: {order}"
                );
            }
        }
    }
}

#[test]
fn a_strip_along_a_curve_of_one_degree_more_is_as_smooth_as_its_degree_allows() {
    let (curve, ..) = wave(3, 9);
    let strip = build::strip(&curve, 0.1, Alignment::Middle, [2, 2], [20, 2]).unwrap();
    for knots in strip.knots() {
        assert!(knots.breaks().all(|(xi, multiplicity)| multiplicity == 1 || knots.domain().contains(&xi)));
    }
    assert_eq!(strip.knots().iter().map(Knots::element_count).collect::<Vec<_>>(), [20, 2]);
}

#[test]
fn a_strip_along_an_arc_is_its_sector() {
    let arc = build::arc([0.0; 2], 1.0, PI, -FRAC_PI_2).unwrap();
    let error = |elements: usize| {
        let strip = build::strip(&arc, 0.2, Alignment::Middle, [3, 1], [elements, 1]).unwrap();
        let sector =
            build::annular_sector([0.0; 2], [0.9, 1.1], PI, -FRAC_PI_2, [3, 1], [elements, 1]).unwrap();
        assert_eq!(strip.knots(), sector.knots());
        let miss = |xi: f64| {
            [0.0, 0.5, 1.0].map(|eta| distance(&strip.point(&[xi, eta]), &sector.point(&[xi, eta])))
        };
        shares(997).flat_map(miss).fold(0.0, f64::max)
    };
    let (coarse, fine) = (error(40), error(80));
    assert!(coarse < 1e-7 && ((coarse / fine).log2() - 4.0).abs() < 0.1, "{coarse} {fine}");
}

#[test]
fn a_strip_thicker_than_the_bend_is_refused_at_its_place() {
    let arc = build::arc([2.0, 0.0], 0.5, PI, -PI).unwrap();
    let strip = |thickness, alignment| build::strip(&arc, thickness, alignment, [2, 1], [8, 1]);
    // To the left of this clockwise arc is outside.
    assert!(strip(3.0, Alignment::Bottom).is_ok());
    assert!(strip(0.49, Alignment::Top).is_ok() && strip(0.98, Alignment::Middle).is_ok());
    for (thickness, alignment) in [(0.51, Alignment::Top), (1.02, Alignment::Middle)] {
        let error = strip(thickness, alignment).unwrap_err();
        let BuildError::Folded { radius, place, .. } = error else { panic!("{error:?}") };
        assert!((radius - 0.5).abs() < 1e-12 && ((place[0] - 2.0).hypot(place[1]) - 0.5).abs() < 1e-12);
    }
    // Only the bends of a wave are sharp: at its crest and trough.
    let (curve, ..) = wave(3, 12);
    let error = build::strip(&curve, 3.2, Alignment::Middle, [3, 1], [40, 1]).unwrap_err();
    let BuildError::Folded { place: [x, _], radius, .. } = error else { panic!("{error:?}") };
    assert!(radius < 1.6, "{error}");
    assert!((x / 3.0 * 4.0 - FRAC_PI_2).abs().min((x / 3.0 * 4.0 - 3.0 * FRAC_PI_2).abs()) < 0.3, "{error}");
}

#[test]
fn few_elements_neither_hide_a_sharp_bend_nor_fold_by_themselves() {
    let bezier = |points: &[[f64; 2]]| {
        let knots = Knots::uniform(points.len() - 1, 1).unwrap();
        Spline::new(vec![knots], points.to_vec()).unwrap()
    };
    // Radius 1/4 at the tip. One linear element would cut the tip off.
    let tip = bezier(&[[0.0, 0.0], [1.0, 4.0], [2.0, 0.0]]);
    for elements in [1, 30] {
        let error = build::strip(&tip, 0.251, Alignment::Top, [1, 1], [elements, 1]).unwrap_err();
        let BuildError::Folded { radius, place, .. } = error else { panic!("{error:?}") };
        assert!((radius - 0.25).abs() < 1e-12 && distance(&place, &[1.0, 2.0]) < 1e-6, "{radius}, {place:?}");
        assert!(build::strip(&tip, 0.249, Alignment::Top, [1, 1], [elements, 1]).is_ok());
    }
    // A hairpin of radius 0.19 and more: the chord of one linear element runs across its own thickness.
    let hairpin = bezier(&[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]]);
    let strip = |elements| build::strip(&hairpin, 0.2, Alignment::Middle, [1, 1], [elements, 1]);
    assert!(matches!(strip(1), Err(BuildError::Folded { .. })));
    assert!(strip(20).is_ok());
}

#[test]
fn curves_without_a_direction_are_refused() {
    let strip = |curve: &Spline<2>| build::strip(curve, 0.01, Alignment::Middle, [2, 1], [10, 1]);
    let corner =
        Spline::new(vec![Knots::uniform(1, 2).unwrap()], vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]).unwrap();
    let expected = BuildError::NoDirection { parameter: 0.5, place: [1.0, 0.0] };
    assert_eq!(strip(&corner), Err(expected));
    let standing =
        Spline::new(vec![Knots::uniform(2, 1).unwrap()], vec![[0.0, 0.0], [0.0, 0.0], [1.0, 0.0]]).unwrap();
    assert_eq!(strip(&standing), Err(BuildError::NoDirection { parameter: 0.0, place: [0.0, 0.0] }));
    let point = Spline::new(vec![Knots::uniform(1, 1).unwrap()], vec![[3.0, 4.0]; 2]).unwrap();
    assert_eq!(strip(&point), Err(BuildError::NoDirection { parameter: 0.0, place: [3.0, 4.0] }));
}

#[test]
fn impossible_strips_are_refused() {
    let (curve, ..) = wave(3, 9);
    let strip =
        |thickness, degree, elements| build::strip(&curve, thickness, Alignment::Top, degree, elements);
    assert_eq!(strip(0.0, [2, 1], [9, 1]), Err(BuildError::Extent { extent: 0.0 }));
    assert_eq!(strip(0.1, [2, 1], [5, 1]), Err(BuildError::TooFewElements { found: 5, needed: 6 }));
    assert_eq!(strip(0.1, [0, 1], [9, 1]), Err(BuildError::Knots(KnotError::DegreeZero)));
    assert_eq!(strip(0.1, [2, 0], [9, 1]), Err(BuildError::Knots(KnotError::DegreeZero)));
    assert_eq!(strip(0.1, [2, 1], [9, 0]), Err(BuildError::Knots(KnotError::NoElements)));
    let patch = build::rectangle([0.0; 2], [1.0; 2], [1, 1], [1, 1]).unwrap();
    let refused = build::strip(&patch, 0.1, Alignment::Top, [1, 1], [1, 1]);
    assert_eq!(refused, Err(BuildError::NotACurve { parameters: 2 }));
}
