//! Whether every name of a boundary group is one of the mesh's, and every group has its condition.

use crate::check::Check;
use crate::finding::Finding;
use crate::schema::{Condition, Fluid, FluidMesh, Probe, Scene};
use crate::shapes::Content;
use crate::spelling::nearest;

/// The boundary groups that a mesh has, and the file it was read from.
#[derive(Clone, Copy)]
struct Known<'a> {
    groups: &'a [&'a str],
    file: Option<&'a Content>,
}

/// Conditions, sliding groups and probes against the boundary groups of the mesh; tells whether the conditions are those of
/// all groups and no others.
pub(super) fn check(
    check: &mut Check<'_>,
    scene: &Scene,
    fluid: &Fluid,
    groups: &[&str],
    file: Option<&Content>,
) -> bool {
    let known = Known { groups, file };
    let complete = conditions(check, fluid, known);
    slides(check, fluid, known);
    if let FluidMesh::Gmsh(mesh) = &fluid.mesh {
        for group in mesh.circles.keys() {
            known.check(check, group, &["fluid", "mesh", "gmsh", "circles", group]);
        }
    }
    for (name, probe) in &scene.output.probes {
        let (key, named) = match probe {
            Probe::FluidForce(named) => ("fluid_force", named),
            Probe::FluidFlowRate(named) => ("fluid_flow_rate", named),
            _ => continue,
        };
        for group in named.names() {
            known.check(check, group, &["output", "probes", name, key]);
        }
    }
    complete
}

/// Every group has one condition, every condition has its group.
fn conditions(check: &mut Check<'_>, fluid: &Fluid, known: Known<'_>) -> bool {
    let without = |group: &&&str| !fluid.boundary.contains_key(**group);
    let open: Vec<&str> = known.groups.iter().filter(without).copied().collect();
    let mut misspelled = Vec::new();
    let strangers: Vec<&String> =
        fluid.boundary.keys().filter(|group| !known.groups.contains(&group.as_str())).collect();
    for group in &strangers {
        let near = nearest(group, open.iter().copied());
        misspelled.extend(near);
        let place = check.key(&["fluid", "boundary", group]);
        check.add(known.unknown(group, near).mark_if(place, "unknown group"));
    }
    let left: Vec<&str> = open.iter().copied().filter(|group| !misspelled.contains(group)).collect();
    without_condition(check, &left);
    open.is_empty() && strangers.is_empty()
}

/// All groups without a condition at once, with lines that can be copied.
fn without_condition(check: &mut Check<'_>, groups: &[&str]) {
    let place = check.key(&["fluid", "boundary"]);
    let finding = match groups {
        [] => return,
        [group] => Finding::new(format!("boundary group `{group}` has no condition"))
            .mark_if(place, format!("nothing about `{group}` here"))
            .hint(format!(
                "without one the equations are not closed: add `{} = \"no_slip\"` or another condition{}",
                quoted(group),
                home(check)
            )),
        [first, ..] => {
            let names: Vec<String> = groups.iter().map(|group| format!("`{group}`")).collect();
            Finding::new(format!(
                "{} boundary groups have no condition: {}",
                groups.len(),
                names.join(", ")
            ))
            .mark_if(place, "nothing about these here")
            .hint(format!(
                "without one for each the equations are not closed: add lines such as `{} = \"no_slip\"`{}",
                quoted(first),
                home(check)
            ))
        }
    };
    check.add(finding);
}

/// Where the lines go, if there is no such table yet.
fn home(check: &Check<'_>) -> &'static str {
    // A table that is not there is answered with the one that should hold it.
    if check.key(&["fluid", "boundary"]) == check.key(&["fluid"]) {
        " under a heading `[fluid.boundary]`"
    } else {
        ""
    }
}

fn slides(check: &mut Check<'_>, fluid: &Fluid, known: Known<'_>) {
    for group in &fluid.mesh_motion.slide {
        known.check(check, group, &["fluid", "mesh_motion", "slide"]);
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

impl Known<'_> {
    /// A boundary group that is named must be in the mesh.
    fn check(self, check: &mut Check<'_>, group: &str, path: &[&str]) {
        if !self.groups.contains(&group) {
            let near = nearest(group, self.groups.iter().copied());
            let place = check.value(path);
            check.add(self.unknown(group, near).mark_if(place, "unknown group"));
        }
    }

    fn unknown(self, group: &str, near: Option<&str>) -> Finding {
        if let Some(finding) = self.file.and_then(|file| file.elsewhere(group, self.groups)) {
            return finding;
        }
        Finding::new(format!("the mesh has no boundary group `{group}`")).hint(match near {
            Some(near) => format!("did you mean `{near}`?"),
            None => format!("groups of the mesh: {}", self.groups.join(", ")),
        })
    }
}

/// A group's name as a key of TOML.
fn quoted(group: &str) -> String {
    crate::write::key(group)
}
