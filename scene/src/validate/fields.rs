//! Which fields are there, how they are coupled, and what is asked of them.

use crate::check::Check;
use crate::finding::Finding;
use crate::schema::{Direction, Fluid, FluidTimeScheme, Probe, Scene, Structure, StructureTimeScheme};

pub(super) fn check(check: &mut Check<'_>, scene: &Scene) {
    match (&scene.fluid, &scene.structure) {
        (None, None) => check.add(
            Finding::new("the scene has neither a fluid nor a structure")
                .mark_if(check.key(&["title"]), "nothing to solve in this scene")
                .hint("add a [fluid], a [structure], or both and a [coupling]"),
        ),
        (Some(fluid), Some(structure)) => {
            needs_coupling(check, scene);
            if scene.moves_the_interface() {
                needs_acceleration(check, scene);
                steadiness(check, fluid, structure);
            }
        }
        _ if scene.coupling.is_some() => {
            let (there, missing) =
                if scene.fluid.is_some() { ("fluid", "structure") } else { ("structure", "fluid") };
            check.add(
                Finding::new(format!("[coupling] needs a [{missing}] beside the [{there}]"))
                    .mark_if(check.key(&["coupling"]), format!("couples the {there} with what?"))
                    .hint(format!("add a [{missing}], or leave out [coupling] to run the {there} alone")),
            );
        }
        _ => {}
    }
    for (name, probe) in &scene.output.probes {
        check_probe(check, scene, name, probe);
    }
}

fn needs_coupling(check: &mut Check<'_>, scene: &Scene) {
    if scene.coupling.is_none() {
        check.add(
            Finding::new("the scene has a fluid and a structure but no [coupling]")
                .mark_if(check.key(&["structure"]), "how does this meet the fluid?")
                .hint("add a table [coupling] with an acceleration, such as `acceleration = \"iqn_imvls\"`"),
        );
    }
}

fn needs_acceleration(check: &mut Check<'_>, scene: &Scene) {
    if scene.coupling.as_ref().is_some_and(|coupling| coupling.acceleration.is_none()) {
        check.add(
            Finding::new("[coupling] has no acceleration")
                .mark_if(check.key(&["coupling"]), "how does the next displacement come from the last?")
                .hint(
                    "add one, such as `acceleration = \"iqn_imvls\"`, or take `direction = \"one_way\"`, \
                     where nothing comes back to the fluid",
                ),
        );
    }
}

fn steadiness(check: &mut Check<'_>, fluid: &Fluid, structure: &Structure) {
    let steady = fluid.time_scheme == FluidTimeScheme::Steady;
    let quasi_static = structure.time_scheme == StructureTimeScheme::QuasiStatic;
    if steady && !quasi_static {
        check.add(
            Finding::new("a steady fluid is coupled with a structure that has inertia")
                .mark_if(check.value(&["fluid", "time_scheme"]), "no time derivative here")
                .mark_if(check.key(&["structure", "time_scheme"]), "but here")
                .hint("a steady fluid knows no wall velocity: take `structure.time_scheme = \"quasi_static\"`, or `fluid.time_scheme = \"bdf1\"`"),
        );
    }
}

fn check_probe(check: &mut Check<'_>, scene: &Scene, name: &str, probe: &Probe) {
    let (fluid, structure) = (scene.fluid.is_some(), scene.structure.is_some());
    let missing = match probe {
        Probe::StructurePoint(_) | Probe::StructureDisplacement(_) | Probe::StructureEnergy => {
            (!structure).then_some("structure")
        }
        Probe::FluidForce(_)
        | Probe::FluidValue(_)
        | Probe::FluidExtremes(_)
        | Probe::FluidError(_)
        | Probe::FluidFlowRate(_)
        | Probe::FluidEnergy
        | Probe::VolumeDefect
        | Probe::MeshQuality => (!fluid).then_some("fluid"),
        Probe::InterfaceWork if !fluid => Some("fluid"),
        Probe::InterfaceWork => (!structure).then_some("structure"),
    };
    if let (Probe::InterfaceWork, Some(Direction::OneWay)) =
        (probe, scene.coupling.as_ref().map(|c| c.direction))
    {
        check.add(
            Finding::new(format!("probe `{name}` needs a coupling in both directions"))
                .mark_if(check.value(&["output", "probes", name]), "the interface stands still for the fluid")
                .mark_if(check.value(&["coupling", "direction"]), "one way here")
                .hint("leave the probe out, or take `direction = \"two_way\"`"),
        );
    }
    if let Some(field) = missing {
        check.add(
            Finding::new(format!("probe `{name}` needs a {field}"))
                .mark_if(check.value(&["output", "probes", name]), format!("the scene has no [{field}]"))
                .hint(format!("leave the probe out, or add a [{field}]")),
        );
    }
}
