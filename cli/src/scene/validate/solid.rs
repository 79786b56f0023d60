//! Whether the structure's mesh has the parts that the scene names, and its points lie where the scene looks.

use partita_mesh::Place;
use partita_structure::Space;

use super::{Check, structure};
use crate::build;
use crate::scene::finding::Finding;
use crate::scene::schema::{Probe, Real, Scene, Structure};
use crate::scene::shapes::Content;

/// The structure's space against what the scene says about it.
pub(super) fn check(
    check: &mut Check<'_>,
    scene: &Scene,
    of_scene: &Structure,
    space: &Space<2>,
    file: Option<&Content>,
) {
    if let Space::Lagrange(mesh) = space {
        let names: Vec<&str> = mesh.groups().iter().map(|group| group.name.as_str()).collect();
        structure::known_parts(check, of_scene, "mesh", &names, file);
        if scene.fluid.is_some() && of_scene.wetted.is_empty() {
            check.add(
                Finding::new("no group of the structure touches the fluid")
                    .mark_if(check.key(&["structure"]), "`wetted` is missing or empty")
                    .hint(format!(
                        "name those that do in `wetted`; groups of the mesh: {}",
                        names.join(", ")
                    )),
            );
        }
    }
    for (name, probe) in &scene.output.probes {
        match (probe, space) {
            (Probe::StructurePoint(point), _) => {
                let point = point.map(Real::get);
                if build::place_in(space, point).is_none() {
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
