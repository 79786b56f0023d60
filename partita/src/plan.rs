//! Which effects of a scene run, which do not, and why: read off the scene, before anything is built.
//!
//! What is off is neither allocated, assembled nor solved; the tests of this crate count.

use std::fmt;

use crate::output::table::Table;
use partita_scene::schema::{
    Condition, Direction, Fluid, FluidTimeScheme, Material, MotionMode, Output, Scene, Structure,
    StructureTimeScheme, VectorFormula,
};
use partita_scene::words;

/// One effect, and what a scene says about it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Effect {
    /// Its name.
    pub name: &'static str,
    /// Whether it runs.
    pub runs: Runs,
    /// What in the scene decides that, and what follows.
    pub why: String,
}

/// Whether an effect runs, and how.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Runs {
    /// It does not.
    No,
    /// It does.
    Yes,
    /// Loads go to the structure.
    OneWay,
    /// Loads go to the structure, displacements to the fluid.
    TwoWay,
}

impl fmt::Display for Runs {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::No => "no",
            Self::Yes => "yes",
            Self::OneWay => "one way",
            Self::TwoWay => "two way",
        })
    }
}

/// The effects of a scene, always the same ones in the same order.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Plan {
    /// The effects.
    pub effects: Vec<Effect>,
}

impl Plan {
    /// Reads the plan off a scene.
    #[must_use]
    pub fn of(scene: &Scene) -> Self {
        let mut plan = Self { effects: Vec::new() };
        plan.fluid(scene);
        plan.structure(scene);
        plan.coupling(scene);
        plan.output(&scene.output);
        plan
    }

    /// Whether the effect of this name runs.
    #[must_use]
    pub fn runs(&self, name: &str) -> Option<Runs> {
        self.effects.iter().find(|effect| effect.name == name).map(|effect| effect.runs)
    }

    /// A table: effect, whether it runs, why.
    #[must_use]
    pub fn table(&self) -> Table {
        let mut table = Table::new(["effect", "runs", "why"]);
        for Effect { name, runs, why } in &self.effects {
            table.push([(*name).into(), runs.to_string().into(), why.clone().into()]);
        }
        table
    }

    fn add(&mut self, name: &'static str, runs: bool, why: impl Into<String>) {
        let runs = if runs { Runs::Yes } else { Runs::No };
        self.effects.push(Effect { name, runs, why: why.into() });
    }

    fn fluid(&mut self, scene: &Scene) {
        let Some(fluid) = &scene.fluid else {
            self.add("fluid", false, "no [fluid]");
            for name in ["fluid inertia", "convection", "mesh motion", "gravity on the fluid"] {
                self.add(name, false, "no fluid");
            }
            return;
        };
        self.add("fluid", true, "[fluid]");
        let steady = fluid.time_scheme == FluidTimeScheme::Steady;
        let scheme = words(&fluid.time_scheme);
        let follows = if steady { ": every step is a steady state" } else { "" };
        self.add("fluid inertia", !steady, format!("fluid.time_scheme is {scheme}{follows}"));
        self.add("convection", fluid.convection, convection(scene, fluid));
        let (moves, why) = mesh_motion(scene, fluid);
        self.add("mesh motion", moves, why);
        self.force("gravity on the fluid", "fluid.body_force", &fluid.body_force);
    }

    fn structure(&mut self, scene: &Scene) {
        let Some(structure) = &scene.structure else {
            self.add("structure", false, "no [structure]: all walls are rigid, or move as the scene says");
            for name in ["structural inertia", "geometric nonlinearity", "gravity on the structure"] {
                self.add(name, false, "no structure");
            }
            return;
        };
        self.add("structure", true, "[structure]");
        self.add("structural inertia", has_inertia(structure), inertia(structure));
        let linear = matches!(structure.material, Material::LinearElastic(_));
        let why = match structure.material {
            Material::LinearElastic(_) => {
                "structure.material is linear_elastic: one solve a call, one factorization a run"
            }
            Material::SaintVenantKirchhoff(_) => "structure.material is saint_venant_kirchhoff",
            Material::NeoHookean(_) => "structure.material is neo_hookean, nonlinear by itself, too",
        };
        self.add("geometric nonlinearity", !linear, why);
        self.force("gravity on the structure", "structure.body_force", &structure.body_force);
    }

    fn coupling(&mut self, scene: &Scene) {
        let (runs, why) = match &scene.coupling {
            _ if scene.fluid.is_none() => (Runs::No, "a structure alone".to_owned()),
            _ if scene.structure.is_none() => (Runs::No, "a fluid alone".to_owned()),
            None => (Runs::No, "no [coupling]".to_owned()),
            Some(coupling) => match coupling.direction {
                Direction::OneWay => (
                    Runs::OneWay,
                    "coupling.direction is one_way: one call of each field a step, fluid first".to_owned(),
                ),
                Direction::TwoWay => {
                    let acceleration = coupling.acceleration.map_or_else(|| "none".to_owned(), |a| words(&a));
                    let name = acceleration.split([' ', ',']).next().unwrap_or_default();
                    (Runs::TwoWay, format!("[coupling]: iterations with acceleration {name}"))
                }
            },
        };
        self.effects.push(Effect { name: "coupling", runs, why });
    }

    fn output(&mut self, output: &Output) {
        let every = output.fields_every;
        let why = if every == 0 {
            "output.fields_every is 0".to_owned()
        } else {
            format!("output.fields_every is {every}")
        };
        self.add("output of fields", every > 0, why);
        let every = output.checkpoint_every;
        self.add("checkpoints", every > 0, format!("output.checkpoint_every is {every}"));
        let probes: Vec<&str> = output.probes.keys().map(String::as_str).collect();
        let why = if probes.is_empty() { "no output.probes".to_owned() } else { probes.join(", ") };
        self.add("probes", !probes.is_empty(), why);
    }

    fn force(&mut self, name: &'static str, key: &str, force: &VectorFormula) {
        let is_zero = force.constant() == Some([0.0; 2]);
        let why = if is_zero { format!("{key} is zero") } else { format!("{key} is {}", words(force)) };
        self.add(name, !is_zero, why);
    }
}

fn has_inertia(structure: &Structure) -> bool {
    structure.time_scheme != StructureTimeScheme::QuasiStatic
}

fn inertia(structure: &Structure) -> String {
    match structure.time_scheme {
        StructureTimeScheme::GeneralizedAlpha { .. } => {
            "structure.time_scheme is generalized_alpha".to_owned()
        }
        StructureTimeScheme::Newmark { .. } => "structure.time_scheme is newmark".to_owned(),
        StructureTimeScheme::QuasiStatic if structure.rayleigh_damping.is_some() => {
            "structure.time_scheme is quasi_static; the mass matrix serves Rayleigh damping".to_owned()
        }
        StructureTimeScheme::QuasiStatic => {
            "structure.time_scheme is quasi_static: no mass matrix".to_owned()
        }
    }
}

/// Why the fluid convects or not, and what that does to its equations.
fn convection(scene: &Scene, fluid: &Fluid) -> String {
    if fluid.convection {
        "fluid.convection is true: a nonlinear system, solved by Newton's method".to_owned()
    } else if mesh_motion(scene, fluid).0 {
        "fluid.convection is false: one solve a call; the mesh moves, so each call factors".to_owned()
    } else {
        "fluid.convection is false: one solve a step, one factorization a run".to_owned()
    }
}

/// Whether a boundary moves, and which.
fn mesh_motion(scene: &Scene, fluid: &Fluid) -> (bool, String) {
    let moving = fluid.boundary.iter().find(|(_, condition)| match condition {
        Condition::WallMotion(_) => true,
        Condition::Interface => scene.moves_the_interface(),
        _ => false,
    });
    let Some((group, _)) = moving else {
        let has_interface = fluid.boundary.values().any(|condition| *condition == Condition::Interface);
        let why = if has_interface { "the interface stands still" } else { "no boundary moves" };
        return (false, why.to_owned());
    };
    let factored = match fluid.mesh_motion.mode {
        MotionMode::Reference => "once a run",
        MotionMode::Incremental => "once a step",
    };
    (true, format!("boundary `{group}` moves; the matrix of the mesh is factored {factored}"))
}
