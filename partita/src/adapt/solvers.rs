//! The primitives of the two solvers under the adapter's names; both spell them alike.

use std::convert::identity;

use partita_coupling::WorkDetails;
use partita_fluid::{FluidError, FluidSolver, FluidState};
use partita_mesh::motion::MeshMotion;
use partita_numerics::newton::{self, KeptTangent};
use partita_numerics::phases::PhaseSeconds;
use partita_structure::{StructureError, StructureSolver, StructureState};

use super::backflow;
use super::field::{Field, Suspect};

macro_rules! field {
    ($solver:ty, $state:ty, $error:ty, $name:literal, $result:expr, $verify:expr, $work:expr, $suspect:expr, $resolution:expr, $of_output:expr) => {
        impl Field for $solver {
            type State = $state;
            const NAME: &'static str = $name;

            fn begin_step(&mut self, time: f64, dt: f64) -> Result<(), $error> {
                $result(Self::begin_step(self, time, dt))
            }
            fn impose(&mut self, input: &[f64]) -> Result<(), $error> {
                $result(Self::impose(self, input))
            }
            fn verify(&mut self) -> Result<(), $error> {
                $verify(self)
            }
            fn worst_equation(&self) -> Option<String> {
                Self::worst_equation(self).map(|worst| worst.to_string())
            }
            fn suspect(&self) -> Option<Suspect> {
                $suspect(self)
            }
            fn output(&self, output: &mut [f64]) {
                Self::output(self, output);
            }
            fn commit(&mut self) {
                Self::commit(self);
            }
            fn rewind(&mut self) {
                Self::rewind(self);
            }
            fn state(&self) -> $state {
                Self::state(self).clone()
            }
            fn restore(&mut self, state: &$state) -> Result<(), $error> {
                Self::restore(self, state)
            }
            fn most_kept(&self) -> usize {
                if self.keeps_factor() { self.tangent().1.len() } else { 0 }
            }
            fn kept_tangent(&self) -> Option<KeptTangent> {
                Self::kept_tangent(self)
            }
            fn restore_tangent(&mut self, kept: &KeptTangent) -> Result<(), $error> {
                Self::restore_tangent(self, kept)
            }
            fn values(&self) -> &[f64] {
                Self::values(self)
            }
            fn part_count(&self) -> usize {
                self.parts().len()
            }
            fn part(&self, index: usize) -> (&'static str, &[usize]) {
                let part = &self.parts()[index];
                (part.name, &part.dofs)
            }
            fn resolution(&self, part: usize) -> f64 {
                $resolution(self, part)
            }
            fn output_resolution(&self) -> f64 {
                $of_output(self)
            }
            fn newton(&self) -> &newton::Settings {
                self.newton_settings()
            }
            fn work(&self) -> WorkDetails {
                $work(self)
            }
            fn phases(&self) -> PhaseSeconds {
                Self::phases(self)
            }
        }
    };
}

field!(
    FluidSolver<2>,
    FluidState,
    FluidError,
    "fluid",
    identity,
    |_: &mut Self| Ok(()),
    fluid_work,
    backflow::suspect,
    // Velocity comes first.
    |fluid: &Self, part| if part == 0 { fluid.velocity_resolution() } else { fluid.pressure_resolution() },
    // Nothing is judged by a change of the load.
    |_: &Self| 0.0
);
// No interface data can break a structure before its equations are solved.
field!(
    StructureSolver<2>,
    StructureState,
    StructureError,
    "structure",
    Ok,
    Self::check_orientation,
    structure_work,
    |_: &Self| None,
    |structure: &Self, _| structure.resolution(),
    Self::resolution
);

fn fluid_work(fluid: &FluidSolver<2>) -> WorkDetails {
    let motion = fluid.mesh_motion();
    WorkDetails {
        fallbacks: fluid.fallbacks(),
        mesh_factorizations: motion.map_or(0, MeshMotion::factorizations),
        mesh_solves: motion.map_or(0, MeshMotion::solves),
        ..WorkDetails::default()
    }
}

/// A tangent that is not positive definite is factored twice.
fn structure_work(structure: &StructureSolver<2>) -> WorkDetails {
    WorkDetails { fallbacks: structure.indefinite_tangents(), ..WorkDetails::default() }
}
