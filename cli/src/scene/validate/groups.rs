//! Whether every name of a boundary group is one of the mesh's, and every group has its condition.

use super::Check;
use crate::nearest::nearest;
use crate::scene::finding::Finding;
use crate::scene::schema::{Condition, Fluid, FluidMesh, Probe, Scene};

/// Conditions, sliding groups and probes against the boundary groups of the mesh.
pub(super) fn check(check: &mut Check<'_>, scene: &Scene, fluid: &Fluid, groups: &[&str]) {
    conditions(check, fluid, groups);
    slides(check, fluid, groups);
    if let FluidMesh::Gmsh(mesh) = &fluid.mesh {
        for group in mesh.circles.keys() {
            known_group(check, groups, group, &["fluid", "mesh", "gmsh", "circles", group]);
        }
    }
    for (name, probe) in &scene.output.probes {
        let (key, named) = match probe {
            Probe::FluidForce(named) => ("fluid_force", named),
            Probe::FluidFlowRate(named) => ("fluid_flow_rate", named),
            _ => continue,
        };
        for group in named.names() {
            known_group(check, groups, group, &["output", "probes", name, key]);
        }
    }
}

/// Every group has one condition, every condition has its group.
fn conditions(check: &mut Check<'_>, fluid: &Fluid, groups: &[&str]) {
    let open: Vec<&str> =
        groups.iter().copied().filter(|group| !fluid.boundary.contains_key(*group)).collect();
    let mut misspelled = Vec::new();
    for group in fluid.boundary.keys().filter(|group| !groups.contains(&group.as_str())) {
        let near = nearest(group, open.iter().copied());
        misspelled.extend(near);
        let place = check.key(&["fluid", "boundary", group]);
        check.add(unknown(group, near, groups).mark_if(place, "unknown group"));
    }
    for group in open.iter().filter(|group| !misspelled.contains(group)) {
        check.add(
            Finding::new(format!("boundary group `{group}` has no condition"))
                .mark_if(check.key(&["fluid", "boundary"]), format!("nothing about `{group}` here"))
                .hint(format!(
                    "without one the equations are not closed: add `{} = \"no_slip\"` or another condition",
                    quoted(group)
                )),
        );
    }
}

fn slides(check: &mut Check<'_>, fluid: &Fluid, groups: &[&str]) {
    for group in &fluid.mesh_motion.slide {
        known_group(check, groups, group, &["fluid", "mesh_motion", "slide"]);
        if matches!(fluid.boundary.get(group), Some(Condition::Interface | Condition::WallMotion(_))) {
            check.add(
                Finding::new(format!("mesh nodes cannot slide along `{group}`, which moves itself"))
                    .mark_if(check.value(&["fluid", "mesh_motion", "slide"]), "slides here")
                    .mark_if(check.value(&["fluid", "boundary", group]), "prescribes the motion")
                    .hint(format!("take `{group}` out of `slide`")),
            );
        }
    }
}

/// A boundary group that is named must be in the mesh.
fn known_group(check: &mut Check<'_>, groups: &[&str], group: &str, path: &[&str]) {
    if !groups.contains(&group) {
        let near = nearest(group, groups.iter().copied());
        let place = check.value(path);
        check.add(unknown(group, near, groups).mark_if(place, "unknown group"));
    }
}

fn unknown(group: &str, near: Option<&str>, groups: &[&str]) -> Finding {
    Finding::new(format!("the mesh has no boundary group `{group}`")).hint(match near {
        Some(near) => format!("did you mean `{near}`?"),
        None => format!("groups of the mesh: {}", groups.join(", ")),
    })
}

/// A group's name as a key of TOML.
fn quoted(group: &str) -> String {
    crate::scene::write::key(group)
}
