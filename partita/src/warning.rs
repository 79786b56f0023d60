//! Warnings: input that is legal but hardly intended.
//!
//! `check` and the start of `run` print them. A scene accepts one by its name, with a reason (`[warnings.accept]`); with
//! `--deny-warnings` any other is an error. A warning never changes a number.

mod added_mass;
mod flow;
mod formulas;
mod interface;
mod motion;
mod scales;
mod structure;
mod support;
mod tolerances;

use std::fmt;

use serde::{Serialize, Serializer};

pub use partita_scene::warning::Kind;

use crate::build::FieldMarch;
use partita_scene::Resolved;
use scales::FlowScales;

/// One warning.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Warning {
    /// What it is about.
    #[serde(rename = "name", serialize_with = "by_name")]
    pub kind: Kind,
    /// The file and line, and the key that is to blame.
    pub place: String,
    /// What is odd, with numbers and units.
    pub what: String,
    /// What to do.
    pub remedy: String,
    /// The scene's reason for accepting it.
    pub accepted: Option<String>,
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "as serde calls it")]
fn by_name<S: Serializer>(kind: &Kind, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(kind.name())
}

/// On one line: place, reason, remedy, name.
impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { kind, place, what, remedy, accepted } = self;
        match accepted {
            None => write!(f, "warning: {place}: {what}; {remedy} [{}]", kind.name()),
            Some(reason) => write!(f, "accepted: {place}: {what}; {reason} [{}]", kind.name()),
        }
    }
}

/// All warnings about a scene and the run that was built from it, accepted ones included.
#[must_use]
pub fn of(resolved: &Resolved, run: &FieldMarch) -> Vec<Warning> {
    let mut found = Found { resolved, warnings: Vec::new() };
    let flow = FlowScales::of(resolved, run);
    if let (Some(fluid), Some(solver), Some(flow)) = (&resolved.scene.fluid, run.first().field(), &flow) {
        flow::check(&mut found, fluid, flow);
        motion::check(&mut found, fluid, solver.mesh());
        tolerances::newton(&mut found, "fluid", &fluid.newton, flow.pressure * flow.length);
    }
    if let (Some(structure), Some(solver)) = (&resolved.scene.structure, run.second().field()) {
        let pressure = structure::pressure(&found, structure, solver, flow.as_ref());
        let extent = scales::size(scales::extents(solver.space().points()));
        structure::modulus(&mut found, structure, pressure);
        support::pieces(&mut found, structure, solver);
        support::gap(&mut found, solver);
        tolerances::newton(&mut found, "structure", &structure.newton, pressure * extent);
        if let Some(coupling) = &resolved.scene.coupling {
            tolerances::coupling(&mut found, coupling, extent);
        }
    }
    if let (Some(fluid), Some(of_fluid), Some(of_structure)) =
        (&resolved.scene.fluid, run.first().field(), run.second().field())
    {
        if let Some(coupling) = &resolved.scene.coupling {
            interface::check(&mut found, coupling, of_fluid, of_structure);
        }
        if resolved.scene.moves_the_interface() {
            support::corners(&mut found, fluid, of_fluid, of_structure);
        }
    }
    in_time(&mut found, run);
    formulas::check(&mut found);
    found.warnings
}

/// What the first vibration of the structure tells of the step and of the coupling.
fn in_time(found: &mut Found<'_>, run: &FieldMarch) {
    let scene = &found.resolved.scene;
    let (Some(structure), Some(solver)) = (&scene.structure, run.second().field()) else { return };
    if scene.fluid.is_some() && scene.moves_the_interface() {
        structure::damping(found, structure);
    }
    let Some(mode) = solver.first_mode() else { return };
    structure::step(found, mode.period());
    if let (Some(fluid), Some(coupling), Some(of_fluid)) =
        (&scene.fluid, &scene.coupling, run.first().field())
        && let Some(scheme) = added_mass::scheme(fluid)
        && let Some(ratio) = added_mass::ratio(found, (of_fluid, solver), scheme, coupling, &mode)
    {
        added_mass::check(found, coupling, ratio);
    }
}

/// Those that the scene does not accept.
pub fn open(warnings: &[Warning]) -> impl Iterator<Item = &Warning> {
    warnings.iter().filter(|warning| warning.accepted.is_none())
}

/// The warnings found so far.
struct Found<'a> {
    resolved: &'a Resolved,
    warnings: Vec<Warning>,
}

impl Found<'_> {
    /// Adds a warning about the key at a path, or its nearest ancestor that the scene spells out.
    fn warn(&mut self, kind: Kind, path: &[&str], what: impl Into<String>, remedy: impl Into<String>) {
        let accepted = self.resolved.scene.warnings.accept.get(kind.name());
        self.warnings.push(Warning {
            kind,
            place: self.resolved.places.describe(path),
            what: what.into(),
            remedy: remedy.into(),
            accepted: accepted.map(|reason| reason.as_str().to_owned()),
        });
    }
}
