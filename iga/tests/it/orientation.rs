//! Patches that are mirrored, folded or flat are refused, at their place.

use miette::Diagnostic;
use partita_iga::orientation::{self, OrientationError};
use partita_iga::{Spline, build};
use proptest::prelude::*;

fn moved(patch: &Spline<2>, index: usize, to: [f64; 2]) -> Spline<2> {
    let mut points = patch.control_points().to_vec();
    points[index] = to;
    patch.with_control_points(points).unwrap()
}

fn plate() -> Spline<2> {
    build::rectangle([0.0, 0.0], [4.0, 1.0], [2, 2], [4, 2]).unwrap()
}

#[test]
fn a_rectangle_of_any_shape_and_unit_is_perfect() {
    for scale in [1e-9, 1.0, 1e9] {
        let plate = build::rectangle([5.0 * scale, 0.0], [scale, 1e-4 * scale], [2, 3], [3, 2]).unwrap();
        let worst = orientation::check(&plate).unwrap();
        assert!((worst.value - 1.0).abs() < 1e-9, "{scale}: {worst:?}");
    }
}

#[test]
fn a_shear_has_the_sine_of_its_angle() {
    let plate = plate();
    let sheared = plate.control_points().iter().map(|[x, y]| [x + y, *y]).collect();
    let worst = orientation::check(&plate.with_control_points(sheared).unwrap()).unwrap();
    assert!((worst.value - 0.5_f64.sqrt()).abs() < 1e-14, "{worst:?}");
}

#[test]
fn a_mirrored_patch_is_told_from_a_folded_one() {
    let plate = plate();
    let mirrored = plate.control_points().iter().map(|[x, y]| [-x, *y]).collect();
    let mirrored = orientation::check(&plate.with_control_points(mirrored).unwrap());
    assert!(matches!(mirrored, Err(OrientationError::Mirrored { .. })), "{mirrored:?}");

    // Control point (2, 3) of 6 x 4, at the top, pushed below the bottom.
    let error = orientation::check(&moved(&plate, 3 * 6 + 2, [1.5, -2.0])).unwrap_err();
    let OrientationError::Folded { at, scaled_jacobian } = &error else { panic!("{error:?}") };
    assert!(*scaled_jacobian < -0.1);
    // It acts on the elements 0 to 2 of the upper row.
    assert!((4..7).contains(&at.element), "{at:?}");
    assert!((0.5..1.0).contains(&at.parameters[1]) && at.parameters[0] < 0.75, "{at:?}");
    let message = error.to_string();
    assert!(message.contains(&format!("element {} at", at.element)) && error.help().is_some(), "{message}");
}

#[test]
fn a_patch_without_area_is_degenerate() {
    let plate = plate();
    let flat = plate.control_points().iter().map(|[x, y]| [x + 3.0 * y, 0.1 * (x + 3.0 * y)]).collect();
    let flat = orientation::check(&plate.with_control_points(flat).unwrap());
    assert!(matches!(flat, Err(OrientationError::Degenerate { .. })), "{flat:?}");
    let point = orientation::check(&plate.with_control_points(vec![[1.0, 2.0]; 24]).unwrap());
    assert!(matches!(point, Err(OrientationError::Degenerate { .. })), "{point:?}");
}

#[test]
fn a_side_that_is_a_point_is_no_fault() {
    let arc = build::arc([0.0, 0.0], 1.0, 0.0, 2.0).unwrap();
    let center = arc.with_control_points(vec![[0.0, 0.0]; arc.control_points().len()]).unwrap();
    let slice = build::ruled(&arc, &center).unwrap();
    assert!(orientation::check(&slice).unwrap().value > 0.8);
}

#[test]
fn a_volume_is_checked_and_a_surface_in_space_is_none() {
    let cube = build::cuboid([0.0; 3], [1.0, 2.0, 3.0], [1, 2, 2], [2, 1, 2]).unwrap();
    assert!((orientation::check(&cube).unwrap().value - 1.0).abs() < 1e-14);
    let swapped = cube.control_points().iter().map(|&[x, y, z]| [y, x, z]).collect();
    let swapped = orientation::check(&cube.with_control_points(swapped).unwrap());
    assert!(matches!(swapped, Err(OrientationError::Mirrored { .. })));
    let side = cube.side(partita_iga::Side::TOP).0;
    assert_eq!(orientation::check(&side), Err(OrientationError::Parameters { found: 2, dimension: 3 }));
}

proptest! {
    /// Any patch, however absurd its control points, gets an answer.
    #[test]
    fn any_patch_gets_an_answer(patch in crate::support::splines::<2>(2), huge in -1e308..1e308) {
        let _ = orientation::check(&patch);
        let _ = orientation::check(&moved(&patch, 0, [huge, -huge]));
    }
}
