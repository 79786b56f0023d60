//! Walls that jump.

use partita_mesh::{Mesh, Place};

use super::scales::{extents, most, points_of, size, speeds};
use super::{Found, Kind};
use partita_scene::formulas::times;
use partita_scene::schema::{Condition, Fluid, Initial, VectorFormula};

/// Displacement at t = 0 that still counts as none, as part of the mesh's extent.
const NONE: f64 = 1e-9;
/// Speed over the first step, as part of the largest, that still counts as a start from rest.
const SLOW: f64 = 0.5;

pub(super) fn check(found: &mut Found<'_>, fluid: &Fluid, mesh: &Mesh<2>) {
    let times = times(&found.resolved.scene.time);
    for (group, condition) in &fluid.boundary {
        let Condition::WallMotion(formula) = condition else { continue };
        let points = points_of(mesh, group);
        let path = ["fluid", "boundary", group.as_str()];
        if let Some((point, jump)) = displaced(formula, &points, mesh) {
            found.warn(
                Kind::MotionJump,
                &path,
                format!(
                    "the wall is displaced by {jump:.3e} m at t = 0, at {}, and jumps there within the first step",
                    Place::from(point)
                ),
                "let the motion start from zero",
            );
        } else if fluid.initial == Initial::Rest {
            let speeds = speeds(formula, &points, &times);
            let (first, largest) = (speeds.first().copied().unwrap_or_default(), most(speeds.clone()));
            if first > SLOW * largest && speeds.len() > 1 {
                found.warn(
                    Kind::MotionJump,
                    &path,
                    format!("the wall starts at once with {first:.3e} m/s in a fluid at rest"),
                    "let its velocity grow from zero, or give the fluid an initial velocity",
                );
            }
        }
    }
}

/// The first point that does not start where the mesh has it, and how far it is away `[m]`.
fn displaced(formula: &VectorFormula, points: &[[f64; 2]], mesh: &Mesh<2>) -> Option<([f64; 2], f64)> {
    let limit = NONE * size(extents(mesh.points()));
    let jump = |point: &[f64; 2]| (*point, size(formula.value(point, 0.0)));
    points.iter().map(jump).find(|(_, jump)| *jump > limit)
}
