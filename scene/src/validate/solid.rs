//! Whether the structure's mesh has the parts that the scene names, and its points lie where the scene looks.

use partita_mesh::Place;
use partita_structure::{Patch, Space, rigid};

use super::structure;
use crate::check::Check;
use crate::finding::Finding;
use crate::free::{HOLD, MOST_PIECES, in_words};
use crate::models;
use crate::schema::{Probe, Real, Scene, Structure, StructureTimeScheme};
use crate::shapes::Content;

/// Sides that a seam joins are inside of the structure.
fn joined(check: &mut Check<'_>, of_scene: &Structure, patch: &Patch<2>) {
    for (place, name) in structure::named_parts(check, of_scene) {
        let Some(partner) = models::side(name).and_then(|side| patch.seams().partner(side)) else { continue };
        check.add(
            Finding::new(format!(
                "the structure closes on itself: its sides `{name}` and `{partner}` are joined"
            ))
            .mark_if(place, "no side of its boundary")
            .mark_if(check.value(&["structure", "geometry"]), "both sides are the same line")
            .hint(format!("name other sides, or leave a gap between `{name}` and `{partner}`")),
        );
    }
}

/// Without inertia every rigid motion must be held, or the equations have no solution.
fn unheld(check: &mut Check<'_>, of_scene: &Structure, space: &Space<2>) {
    let (clamped, held) = models::supports(space, of_scene);
    if clamped.is_empty() && held.is_empty() {
        return;
    }
    let Ok(held) = space.held_dofs(&clamped, &held) else { return };
    for piece in rigid::free_pieces(space, &held).iter().take(MOST_PIECES) {
        check.add(
            Finding::new(format!("a quasi-static structure is not held: {}", in_words(piece)))
                .mark_if(check.value(&["structure", "time_scheme"]), "no inertia holds it")
                .mark_if(check.value(&["structure", "geometry"]), "of this")
                .hint(HOLD),
        );
    }
}

/// A coupled mesh that names no group that the fluid touches.
fn not_wetted(check: &mut Check<'_>, names: &[&str]) {
    check.add(
        Finding::new("no group of the structure touches the fluid")
            .mark_if(check.key(&["structure"]), "`wetted` is missing or empty")
            .hint(format!("name those that do in `wetted`; groups of the mesh: {}", names.join(", "))),
    );
}

/// The structure's space against what the scene says about it.
pub(super) fn check(
    check: &mut Check<'_>,
    scene: &Scene,
    of_scene: &Structure,
    space: &Space<2>,
    file: Option<&Content>,
) {
    match space {
        Space::Lagrange(mesh) => {
            let names: Vec<&str> = mesh.groups().iter().map(|group| group.name.as_str()).collect();
            structure::known_parts(check, of_scene, "mesh", &names, file);
            if scene.fluid.is_some() && of_scene.wetted.is_empty() {
                not_wetted(check, &names);
            }
        }
        Space::Patch(patch) => joined(check, of_scene, patch),
    }
    if of_scene.time_scheme == StructureTimeScheme::QuasiStatic {
        unheld(check, of_scene, space);
    }
    for (name, probe) in &scene.output.probes {
        match (probe, space) {
            (Probe::StructurePoint(point), _) => {
                let point = point.map(Real::get);
                if models::place_in(space, point).is_none() {
                    check.add(
                        Finding::new(format!("probe `{name}` lies outside the structure"))
                            .mark_if(
                                check.value(&["output", "probes", name, "structure_point"]),
                                format!("nothing at {}", Place::from(point)),
                            )
                            .hint("give a point [m] of the undeformed structure"),
                    );
                }
            }
            (Probe::StructureDisplacement(_), Space::Lagrange(_)) => check.add(
                Finding::new(format!("probe `{name}` gives spline parameters, but the structure is a mesh"))
                    .mark_if(
                        check.value(&["output", "probes", name, "structure_displacement"]),
                        "a mesh has no parameters",
                    )
                    .hint("give the point itself [m]: `structure_point = [x, y]`"),
            ),
            _ => {}
        }
    }
}
