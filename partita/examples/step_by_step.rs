//! The library without the program: builds the tank from its scene and steps it, looking at every coupling iteration.
//!
//! ```sh
//! cargo run --release -p partita --example step_by_step
//! ```

use std::error::Error;
use std::path::Path;

use partita::{build, scene};
use partita_coupling::{IterationRecord, Observer, StepRecord};

/// Prints a line a coupling iteration.
struct Lines;

impl Observer for Lines {
    fn iteration(&mut self, record: &IterationRecord) {
        let [fluid, structure] = &record.fields;
        println!(
            "  {:>2}  |r| = {:.3e} m  change {:.1e}  Newton {} + {}",
            record.iteration,
            record.residual,
            record.largest_change(),
            fluid.newton,
            structure.newton
        );
    }

    fn step_finished(&mut self, record: &StepRecord) {
        println!("step {} (t = {} s): {} coupling iterations", record.step, record.time, record.iterations);
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes/elastic-bottom");
    let overrides: Vec<String> = std::env::args().skip(1).collect();
    let tank = scene::load(&folder, &overrides)?;
    let mut run = build::march(&tank)?;
    for _ in 0..5 {
        run.step(tank.scene.time.step.get(), &mut Lines)?;
        if let Some(structure) = run.second().field() {
            println!("    middle of the bottom: {:.6e} m", structure.displacement_at(&[0.5, 1.0])[1]);
        }
    }
    Ok(())
}
