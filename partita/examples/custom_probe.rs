//! A probe of one's own that remembers: the largest kinetic energy so far, and when it was reached.

mod tank;

use partita::coupling::{SetupError, state};
use partita::fluid::FluidSolver;
use partita::{Probe, Run};

/// The energy `[J/m]` and the time `[s]`.
#[derive(Default)]
struct Peak([f64; 2]);

impl Probe for Peak {
    fn columns(&self) -> Vec<String> {
        vec!["energy".to_owned(), "time".to_owned()]
    }
    fn values(&mut self, run: &Run) -> Vec<f64> {
        let energy = run.fluid().map_or(0.0, FluidSolver::kinetic_energy);
        if energy > self.0[0] {
            self.0 = [energy, run.clock().time];
        }
        self.0.to_vec()
    }
    fn save(&self) -> Vec<u8> {
        state::encode(&self.0)
    }
    fn restore(&mut self, bytes: &[u8]) -> Result<(), SetupError> {
        self.0 = state::decode("peak", bytes)?;
        Ok(())
    }
}

pub(crate) fn build() -> Result<Run, Box<dyn std::error::Error>> {
    let run = Run::couple(tank::fluid()?, tank::structure(tank::rubber())?)?;
    Ok(run.with_steps(8, 0.01).with_probe("peak", Peak::default()))
}

pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut run = build()?;
    while run.step()? {}
    println!("largest kinetic energy, and when: {:?}", run.probe("peak"));
    Ok(())
}
