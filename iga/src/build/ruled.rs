//! Straight lines between two splines.

use super::BuildError;
use crate::knots::Knots;
use crate::spline::Spline;

/// The patch of the straight lines between points of `bottom` and `top` at the same parameters.
///
/// ```text
/// w x(xi, eta) = (1 - eta) w_b x_b(xi) + eta w_t x_t(xi),    w = (1 - eta) w_b + eta w_t
/// ```
///
/// with `w_b`, `w_t` the denominators of both (1 if they are not rational). The last parameter, from 0 to 1 and of degree
/// 1 with one element, is a new one. So two curves span a surface, and two surfaces a volume. Where both have the same
/// weights, the lines are run through at constant speed. (Piegl and Tiller, *The NURBS Book*, section 8.4.)
///
/// Both sides must have the same degrees and knots; [`elevate_degree`](Spline::elevate_degree) and
/// [`insert_knots`](Spline::insert_knots) bring them to it. Left of a plane curve `bottom` the patch is not mirrored.
///
/// # Errors
/// When degrees or knots differ, or the new spline would have more than three parameters.
///
/// ```
/// use partita_iga::{Side, build};
///
/// let floor = build::line([0.0, 0.0], [2.0, 0.0], 2, 1)?;
/// let vault = build::arc([1.0, 0.0], 1.0, 2.5, -1.5)?;
/// let patch = build::ruled(&floor, &vault)?;
/// assert_eq!(patch.side(Side::TOP).0, vault);
/// let ([x, y], [u, v]) = (patch.point(&[0.0, 0.5]), vault.point(&[0.0]));
/// assert!((x - 0.5 * u).abs() < 1e-15 && (y - 0.5 * v).abs() < 1e-15);
/// # Ok::<(), build::BuildError>(())
/// ```
pub fn ruled<const D: usize>(bottom: &Spline<D>, top: &Spline<D>) -> Result<Spline<D>, BuildError> {
    let most = bottom.parameters().max(top.parameters());
    if let Some(parameter) = (0..most).find(|&i| bottom.knots().get(i) != top.knots().get(i)) {
        return Err(BuildError::Unlike { parameter });
    }
    let knots = [bottom.knots(), &[Knots::uniform(1, 1)?]].concat();
    let control_points = [bottom.control_points(), top.control_points()].concat();
    let weights = [bottom.weights(), top.weights()].concat();
    Ok(Spline::rational(knots, control_points, weights)?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::build;
    use crate::spline::SplineError;

    #[test]
    fn sides_that_run_differently_are_refused() {
        let line = |degree, elements| build::line([0.0, 0.0], [1.0, 0.0], degree, elements).unwrap();
        let unlike = Err(BuildError::Unlike { parameter: 0 });
        assert_eq!(ruled(&line(1, 2), &line(1, 3)), unlike);
        assert_eq!(ruled(&line(1, 2), &line(2, 2)), unlike);
        let patch = build::rectangle([0.0; 2], [1.0; 2], [1, 1], [2, 1]).unwrap();
        assert_eq!(ruled(&line(1, 2), &patch), Err(BuildError::Unlike { parameter: 1 }));
    }

    #[test]
    fn two_points_make_a_line_and_two_volumes_too_many_parameters() {
        let point = |x| Spline::new(vec![], vec![[x]]).unwrap();
        assert_eq!(ruled(&point(1.0), &point(3.0)), build::line([1.0], [3.0], 1, 1));
        let cube = build::cuboid([0.0; 3], [1.0; 3], [1; 3], [1; 3]).unwrap();
        let many = Err(BuildError::Spline(SplineError::TooManyParameters { found: 4 }));
        assert_eq!(ruled(&cube, &cube), many);
    }
}
