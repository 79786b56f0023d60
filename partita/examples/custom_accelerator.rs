//! An accelerator of one's own: relaxation by Barzilai and Borwein's factor `|dx|^2 / |dx . dr|`, kept from step to step.

mod tank;

use partita::Run;
use partita::coupling::{Accelerator, Answer, DroppedColumn, Proposal, SetupError, state};

/// The factor now and at the end of the last step, and the residual before.
struct BarzilaiBorwein(f64, f64, Vec<f64>);

#[rustfmt::skip]
impl Accelerator for BarzilaiBorwein {
    fn name(&self) -> &'static str { "barzilai_borwein" }
    fn propose(&mut self, x: &mut [f64], r: &[f64], _: Answer) -> Proposal {
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let before = std::mem::replace(&mut self.2, r.to_vec());
        let curvature = (dot(&before, r) - dot(&before, &before)).abs();
        if curvature > 0.0 { self.0 *= dot(&before, &before) / curvature; }
        x.iter_mut().zip(r).for_each(|(x, r)| *x += self.0 * r);
        Proposal::relaxation(self.0)
    }
    fn step_converged(&mut self, _: &[f64], _: &[f64], _: Answer) -> Vec<DroppedColumn> {
        self.1 = self.0;
        self.2.clear();
        Vec::new()
    }
    fn step_failed(&mut self) { self.0 = self.1; self.2.clear(); }
    fn save(&self) -> Vec<u8> { state::encode(&self.1) }
    fn restore(&mut self, bytes: &[u8]) -> Result<(), SetupError> {
        self.1 = state::decode(self.name(), bytes)?;
        self.step_failed();
        Ok(())
    }
}

pub(crate) fn build() -> Result<Run, Box<dyn std::error::Error>> {
    let run = Run::couple(tank::fluid()?, tank::structure(tank::rubber())?)?;
    Ok(run.with_accelerator(BarzilaiBorwein(0.1, 0.1, Vec::new())).with_steps(8, 0.01))
}

pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut run = build()?;
    while run.step()? {}
    println!("the last step took {} iterations", run.march().history().iterations.len());
    Ok(())
}
