//! Pictures of the deformed state, drawn from the fields that a run writes.

mod draw;
mod vtu;

use std::path::Path;

use crate::reproduce::case::Case;
use crate::reproduce::workshop::Workshop;
use crate::task::{self, TaskError};
use draw::Scale;
use vtu::Piece;

/// Where a picture stands, seen from the pages.
pub(crate) fn path(case: Case) -> String {
    format!("figures/{}-snapshot.svg", case.scene())
}

/// The step whose end the paper shows: t = 0.2 s in the tank, t = 0.25 s at the beam.
fn step(case: Case) -> usize {
    match case {
        Case::Tank => 20,
        Case::Beam => 50,
    }
}

/// The end of that step \[s\].
fn time(case: Case) -> f64 {
    match case {
        Case::Tank => 0.2,
        Case::Beam => 0.25,
    }
}

/// Runs both cases up to the moment the paper shows and draws it.
pub(crate) fn write_all(root: &Path, workshop: &Workshop<'_>) -> Result<(), TaskError> {
    for case in Case::ALL {
        let step = step(case);
        let arguments = [
            format!("scenes/{}", case.scene()),
            "--set".to_owned(),
            format!("output.fields_every={step}"),
            "--steps".to_owned(),
            step.to_string(),
        ];
        let folder = workshop.run_with_files(case.scene(), &arguments)?;
        let piece = |field: &str| Piece::read(&folder.join(format!("fields/{field}-{step:06}.vtu")));
        let text = draw(case, &piece("fluid")?, &piece("structure")?)?;
        task::write(&root.join("docs").join(path(case)), &text)?;
    }
    Ok(())
}

/// The tank shows its pressure, the beam the speed of the flow.
fn draw(case: Case, fluid: &Piece, structure: &Piece) -> Result<String, TaskError> {
    let (name, unit, values) = match case {
        Case::Tank => ("pressure", "Pa", fluid.scalars("pressure [Pa]")?.to_vec()),
        Case::Beam => ("speed", "m/s", fluid.lengths("velocity [m/s]")?),
    };
    let scale = Scale::new(name, unit, values);
    let title = format!("{} at t = {} s, {name}", case.scene(), time(case));
    Ok(draw::deformed(&title, fluid, structure, &scale))
}
