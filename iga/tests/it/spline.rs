//! The tensor-product spline: sides, elements, bounds, validation.

use partita_iga::{BasisValues, Derivatives, End, Knots, Side, Spline, SplineError, build};
use proptest::prelude::*;

use crate::support::{distance, parameters_at, splines, splines_with_parameters};

proptest! {
    #[test]
    fn a_side_is_the_edge_of_its_patch((volume, xi) in splines_with_parameters::<3>(3)) {
        for side in volume.sides() {
            let (face, indices) = volume.side(side);
            let mut on_face = xi.clone();
            on_face.remove(side.parameter);
            let mut on_volume = xi.clone();
            on_volume[side.parameter] = volume.knots()[side.parameter].end(side.end);

            prop_assert_eq!(face.parameters(), 2);
            prop_assert!(distance(&face.point(&on_face), &volume.point(&on_volume)) < 1e-14);
            prop_assert!(indices.is_sorted());
            for (a, &parent) in indices.iter().enumerate() {
                prop_assert_eq!(face.control_points()[a], volume.control_points()[parent]);
                prop_assert_eq!(face.weights()[a], volume.weights()[parent]);
            }
        }
    }

    #[test]
    fn a_patch_reaches_the_control_points_at_its_corners_to_the_last_bit(spline in splines::<2>(2)) {
        let [n, count] = [spline.knots()[0].basis_count(), spline.control_points().len()];
        let corners = [([0.0, 0.0], 0), ([1.0, 0.0], n - 1), ([0.0, 1.0], count - n), ([1.0, 1.0], count - 1)];
        for (shares, corner) in corners {
            prop_assert_eq!(spline.point(&parameters_at(&spline, &shares)), spline.control_points()[corner]);
        }
    }

    #[test]
    fn a_spline_lies_in_its_bounding_box((surface, xi) in splines_with_parameters::<3>(2)) {
        let [low, high] = surface.bounding_box();
        for (c, x) in surface.point(&xi).into_iter().enumerate() {
            prop_assert!(low[c] - 1e-14 <= x && x <= high[c] + 1e-14);
        }
    }

    #[test]
    fn elements_tile_the_parameter_space_and_know_their_control_points(volume in splines::<3>(3)) {
        let size: f64 = volume.knots().iter().map(|knots| knots.domain()[1] - knots.domain()[0]).product();
        prop_assert!((volume.elements().map(|e| e.measure()).sum::<f64>() - size).abs() < 1e-13 * size);

        let mut basis = BasisValues::new(&volume);
        for (index, element) in volume.elements().enumerate() {
            let xi = element.at([0.3, 0.5, 0.9]);
            volume.basis(&xi, Derivatives::None, &mut basis);
            prop_assert_eq!(element.index(), index);
            prop_assert_eq!(basis.active(), volume.active_on(index));
            prop_assert_eq!(basis.active(), volume.active(&xi));
            prop_assert_eq!(basis.active().len(), volume.active_count());
        }
    }

    #[test]
    fn both_elements_at_a_knot_see_the_same_point(curve in splines::<2>(1)) {
        let mut basis = BasisValues::new(&curve);
        for e in 1..curve.element_count() {
            let [xi, _] = curve.knots()[0].element(e);
            let mut seen_from = |element| {
                curve.basis_on(element, &[xi], Derivatives::None, &mut basis);
                basis.value_of(curve.control_points())
            };
            prop_assert!(distance(&seen_from(e - 1), &seen_from(e)) < 1e-14);
        }
    }
}

#[test]
fn points_of_the_unit_cube_become_points_of_the_element_exact_at_its_ends() {
    let knots = Knots::new(1, vec![0.1, 0.1, 0.3, 0.7, 0.7]).unwrap();
    let curve = Spline::new(vec![knots], vec![[0.0], [1.0], [2.0]]).unwrap();
    assert_eq!(curve.elements().count(), 2);
    for element in curve.elements() {
        let [start, end] = element.ranges()[0];
        assert_eq!((element.at([0.0]), element.at([1.0])), ([start], [end]));
        assert!((element.at([0.25])[0] - (start + 0.25 * (end - start))).abs() < 1e-16);
    }
}

#[test]
fn elements_and_control_points_run_along_the_first_parameter_first() {
    let patch = build::rectangle([0.0, 0.0], [3.0, 2.0], [1, 1], [3, 2]).unwrap();
    assert_eq!(patch.element(1).ranges(), [[1.0 / 3.0, 2.0 / 3.0], [0.0, 0.5]]);
    assert_eq!(patch.active_on(1), [1, 2, 5, 6]);
    assert_eq!(patch.active_on(3), [4, 5, 8, 9]);
    assert_eq!(patch.control_points()[6], [2.0, 1.0]);
}

#[test]
fn the_side_of_a_curve_is_a_point() {
    let curve = build::line([1.0, 2.0], [3.0, 5.0], 2, 3).unwrap();
    let (end, index) = curve.side(Side::RIGHT);
    assert_eq!((end.parameters(), end.element_count(), index), (0, 1, vec![4]));
    assert_eq!(end.point(&[]), [3.0, 5.0]);
}

#[test]
fn sides_of_a_surface_are_named() {
    let patch = build::rectangle([0.0, 0.0], [2.0, 1.0], [1, 1], [1, 1]).unwrap();
    let names: Vec<_> = patch.sides().map(|side| side.to_string()).collect();
    assert_eq!(names, ["left", "right", "bottom", "top"]);
    assert_eq!(patch.side(Side { parameter: 1, end: End::End }).1, [2, 3]);
    assert!(!patch.has_side(Side::FRONT));
}

#[test]
#[should_panic(expected = "a spline of 2 parameters has no side `back`")]
fn a_side_that_is_not_there_is_refused() {
    let patch = build::rectangle([0.0, 0.0], [2.0, 1.0], [1, 1], [1, 1]).unwrap();
    let _ = patch.side(Side::BACK);
}

#[test]
fn moved_control_points_move_the_spline() {
    let patch = build::rectangle([0.0, 0.0], [2.0, 1.0], [2, 1], [2, 1]).unwrap();
    let sheared = patch.control_points().iter().map(|[x, y]| [x + 0.5 * y, *y]).collect();
    let moved = patch.with_control_points(sheared).unwrap();
    assert!(distance(&moved.point(&[0.25, 1.0]), &[1.0, 1.0]) < 1e-15);
}

#[test]
fn malformed_data_are_refused_with_the_place() {
    let linear = || Knots::uniform(1, 1).unwrap();
    let one = |points, weights| Spline::<1>::rational(vec![linear()], points, weights).unwrap_err();
    assert_eq!(
        one(vec![[0.0]], vec![1.0]),
        SplineError::ControlPoints { found: 1, needed: 2, shape: vec![2] }
    );
    assert_eq!(one(vec![[0.0], [1.0]], vec![1.0]), SplineError::Weights { found: 1, needed: 2 });
    assert_eq!(one(vec![[0.0], [f64::INFINITY]], vec![1.0; 2]), SplineError::NotFinite { index: 1 });
    assert_eq!(one(vec![[0.0], [1.0]], vec![1.0, 0.0]), SplineError::Weight { index: 1, value: 0.0 });
    assert!(matches!(one(vec![[0.0], [1.0]], vec![f64::NAN, 1.0]), SplineError::Weight { index: 0, .. }));
    let four = Spline::new(vec![linear(); 4], vec![[0.0]; 16]);
    assert_eq!(four, Err(SplineError::TooManyParameters { found: 4 }));
}
