//! Whether the fluid's boundary is complete and its pressure determined.

use partita_mesh::generate;

use super::groups;
use crate::check::Check;
use crate::finding::Finding;
use crate::schema::{Condition, Fluid, FluidMesh, RectangleMesh, Scene};

/// Cells of a generated mesh; more would not fit any machine the program is written for.
const MOST_CELLS: f64 = 1e8;

pub(super) fn check(check: &mut Check<'_>, scene: &Scene, fluid: &Fluid) {
    if let FluidMesh::Rectangle(mesh) = &fluid.mesh {
        size(check, mesh);
        if groups::check(check, scene, fluid, &generate::RECTANGLE_SIDES, None) {
            complete(check, scene, fluid);
        }
    }
    lonely_interface(check, scene, fluid);
    needless_pin(check, fluid);
    backflow(check, fluid);
}

/// What the conditions lack once every boundary group has one: before, it may be among those that are missing.
pub(super) fn complete(check: &mut Check<'_>, scene: &Scene, fluid: &Fluid) {
    if scene.structure.is_some() {
        interface(check, fluid);
    }
    pressure(check, fluid, scene.moves_the_interface());
}

fn size(check: &mut Check<'_>, mesh: &RectangleMesh) {
    let cells = 4.0 * mesh.divisions[0].get() as f64 * mesh.divisions[1].get() as f64;
    if cells > MOST_CELLS {
        check.add(
            Finding::new(format!("the fluid's mesh would have about {cells:.0e} cells"))
                .mark_if(check.value(&["fluid", "mesh", "rectangle", "divisions"]), "too fine")
                .hint(format!("at most {MOST_CELLS:.0e} cells can be asked for")),
        );
    }
}

fn interface(check: &mut Check<'_>, fluid: &Fluid) {
    if fluid.boundary.values().any(|condition| *condition == Condition::Interface) {
        return;
    }
    check.add(
        Finding::new("no boundary group of the fluid is the interface")
            .mark_if(check.key(&["fluid", "boundary"]), "none of these is \"interface\"")
            .hint("give the condition \"interface\" to the group that touches the structure"),
    );
}

fn lonely_interface(check: &mut Check<'_>, scene: &Scene, fluid: &Fluid) {
    let marked = fluid.boundary.iter().find(|(_, condition)| **condition == Condition::Interface);
    if let (Some((group, _)), None) = (marked, &scene.structure) {
        check.add(
            Finding::new(format!("`{group}` is an interface, but the scene has no structure"))
                .mark_if(check.value(&["fluid", "boundary", group]), "with what?")
                .hint("add a [structure] and a [coupling], or give the group another condition"),
        );
    }
}

/// The term takes out energy that convection lets in.
fn backflow(check: &mut Check<'_>, fluid: &Fluid) {
    let stabilized = |condition: &Condition| match condition {
        Condition::DoNothing(outflow) | Condition::StressFree(outflow) => outflow.backflow_stabilization,
        _ => false,
    };
    let found = fluid.boundary.iter().find(|(_, condition)| stabilized(condition));
    if let (Some((group, _)), false) = (found, fluid.convection) {
        check.add(
            Finding::new(format!("`{group}` stabilizes backflow of a fluid without convection"))
                .mark_if(check.value(&["fluid", "boundary", group]), "stabilized here")
                .mark_if(check.value(&["fluid", "convection"]), "switched off here")
                .hint("fluid that flows back then brings no momentum: leave out `backflow_stabilization`"),
        );
    }
}

/// The group through which the fluid may leave, if there is one.
fn opening(fluid: &Fluid) -> Option<&String> {
    fluid.boundary.iter().find(|(_, condition)| is_open(condition)).map(|(group, _)| group)
}

/// An opening fixes the level of the pressure.
fn needless_pin(check: &mut Check<'_>, fluid: &Fluid) {
    if let (Some(group), Some(_)) = (opening(fluid), &fluid.pressure_pin) {
        check.add(
            Finding::new("the pressure is fixed twice")
                .mark_if(check.key(&["fluid", "pressure_pin"]), "once here")
                .mark_if(check.key(&["fluid", "boundary", group]), "once here")
                .hint("leave out `pressure_pin`; it is for a fluid without any outflow"),
        );
    }
}

/// An incompressible fluid needs one place where its pressure is known.
fn pressure(check: &mut Check<'_>, fluid: &Fluid, is_elastic: bool) {
    match (opening(fluid), &fluid.pressure_pin) {
        (None, _) if is_elastic => check.add(
            Finding::new("the fluid is enclosed, and an elastic structure moves its boundary")
                .mark_if(check.key(&["fluid", "boundary"]), "every group prescribes the velocity")
                .hint(
                    "an incompressible fluid keeps its volume, which the iterates of a structure do not: \
                     make one group \"stress_free\" or \"do_nothing\"",
                ),
        ),
        (None, None) => check.add(
            Finding::new("the fluid is enclosed: its pressure is known only up to a constant")
                .mark_if(check.key(&["fluid", "boundary"]), "every group prescribes the velocity")
                .hint("set `fluid.pressure_pin = { point = [0, 0], value = 0 }`, or make one group \"stress_free\""),
        ),
        _ => {}
    }
}

fn is_open(condition: &Condition) -> bool {
    matches!(condition, Condition::Traction(_) | Condition::DoNothing(_) | Condition::StressFree(_))
}
