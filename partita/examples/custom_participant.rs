//! A participant of one's own: the bottom of the tank is a rigid piston on a spring, `m y'' + k y = F`, in implicit Euler steps.

mod tank;

use partita::Run;
use partita::coupling::{Block, Change, Effort, MatrixTransfer, NewtonLimit, Participant};
use partita::coupling::{ParticipantError, Quantity, SetupError, Step, state};

/// Mass `[kg/m]` and stiffness `[N/m^2]` per depth, step `[s]`, height and velocity at both its ends, interface.
struct Piston(f64, f64, f64, [[f64; 2]; 2], [Block; 2]);

#[rustfmt::skip]
impl Participant for Piston {
    fn name(&self) -> &'static str { "piston" }
    fn input(&self) -> &[Block] { &self.4[..1] }
    fn output(&self) -> &[Block] { &self.4[1..] }
    fn begin_step(&mut self, step: &Step) -> Result<(), ParticipantError> { self.2 = step.dt; Ok(()) }
    fn advance(&mut self, force: &[f64], _: NewtonLimit, out: &mut [f64]) -> Result<Effort, ParticipantError> {
        let Self(mass, stiffness, dt, [[y_0, v_0], [last, _]], _) = *self;
        let y = (force[1] + mass / dt * (v_0 + y_0 / dt)) / (mass / dt / dt + stiffness);
        self.3[1] = [y, (y - y_0) / dt];
        out.copy_from_slice(&[0.0, y]);
        let changes = vec![Change::new("height", (y - last).abs() / y.abs().max(f64::MIN_POSITIVE))];
        Ok(Effort { converged: true, changes, ..Effort::default() })
    }
    fn commit(&mut self) { self.3[0] = self.3[1]; }
    fn rewind(&mut self) { self.3[1] = self.3[0]; }
    fn save(&self) -> Vec<u8> { state::encode(&self.3) }
    fn restore(&mut self, bytes: &[u8]) -> Result<(), SetupError> { self.3 = state::decode("piston", bytes)?; Ok(()) }
}

pub(crate) fn build() -> Result<Run, Box<dyn std::error::Error>> {
    let fluid = tank::fluid()?;
    let rigid = MatrixTransfer::from_rows(1, 2, &vec![vec![(0, 1.0)]; fluid.interface_nodes().len()])?;
    let blocks = [Quantity::Force, Quantity::Displacement].map(|what| Block::new("bottom", what, 2, 1));
    Ok(Run::couple_by(fluid, Box::new(Piston(900.0, 2e5, 0.0, [[0.0; 2]; 2], blocks)), rigid)?
        .with_steps(8, 0.01))
}

pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut run = build()?;
    while run.step()? {}
    println!("the piston is at {:.6} m", run.march().interface().x_tilde[1]);
    Ok(())
}
