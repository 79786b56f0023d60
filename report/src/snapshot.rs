//! Drawings of the deformed state at the moment that the paper shows, from the fields that a run writes.

use partita_charts::field::{Grid, Scale, deformed};
use partita_mesh::vtu::{VtuArray, VtuFile};

use crate::report::File;
use crate::reproduce::case::Case;
use crate::run::{Run, Stop};
use crate::runs::Runs;
use crate::task::TaskError;

/// Where a drawing stands, seen from the pages.
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

/// Runs both cases up to the moment the paper shows, and draws them.
pub(crate) fn all(runs: &Runs) -> Result<Vec<File>, TaskError> {
    let draw = |case: Case| {
        let step = step(case);
        let run = Run::new(format!("{} snapshot", case.short()), format!("scenes/{}", case.scene()))
            .with(&[format!("output.fields_every={step}")])
            .ending(Stop::After(step));
        let out = runs.one(&run)?.out;
        let read = |field: &str| {
            let path = out.join(format!("fields/{field}-{step:06}.vtu"));
            VtuFile::load(&path).map_err(|error| TaskError::Failed(error.to_string()))
        };
        Ok((format!("docs/{}", path(case)), drawn(case, &read("fluid")?, &read("structure")?)?))
    };
    Case::ALL.into_iter().map(draw).collect()
}

/// The tank shows its pressure, the beam the speed of the flow.
fn drawn(case: Case, fluid: &VtuFile, structure: &VtuFile) -> Result<String, TaskError> {
    let (name, unit, values) = match case {
        Case::Tank => ("pressure", "Pa", array(fluid, "pressure [Pa]")?.values.clone()),
        Case::Beam => ("speed", "m/s", lengths(array(fluid, "velocity [m/s]")?)),
    };
    let scale = Scale::new(name, unit, values);
    let title = format!("{} at t = {} s, {name}", case.scene(), time(case));
    Ok(deformed(&title, &grid(fluid)?, &grid(structure)?, &scale))
}

fn array<'a>(file: &'a VtuFile, name: &str) -> Result<&'a VtuArray, TaskError> {
    file.arrays.get(name).ok_or_else(|| TaskError::Failed(format!("the fields hold no `{name}`")))
}

/// The length of a vector field at each point.
fn lengths(field: &VtuArray) -> Vec<f64> {
    let vectors = field.values.chunks_exact(field.components);
    vectors.map(|vector| vector.iter().map(|x| x * x).sum::<f64>().sqrt()).collect()
}

/// Points and cells in the plane.
fn grid(file: &VtuFile) -> Result<Grid, TaskError> {
    let points = array(file, "Points")?;
    let points: Vec<[f64; 2]> =
        points.values.chunks_exact(points.components).map(|point| [point[0], point[1]]).collect();
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "VTU holds indices here")]
    let indices = |name: &str| -> Result<Vec<usize>, TaskError> {
        Ok(array(file, name)?.values.iter().map(|&index| index as usize).collect())
    };
    let (corners, mut start) = (indices("connectivity")?, 0);
    let mut cells = Vec::new();
    for end in indices("offsets")? {
        let cell = corners.get(start..end).filter(|cell| cell.iter().all(|&corner| corner < points.len()));
        let cell = cell.ok_or_else(|| TaskError::Failed("a cell of the fields names no point".to_owned()))?;
        cells.push(cell.to_vec());
        start = end;
    }
    Ok(Grid { points, cells })
}

#[cfg(test)]
mod tests {
    use super::*;
    use partita_mesh::vtu::{Array, Encoding, write_vtu};
    use partita_mesh::{CellKind, Cells};

    /// A unit square in two triangles.
    fn square() -> VtuFile {
        let points = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let cells = Cells::new(CellKind::Triangle3, vec![0, 1, 2, 0, 2, 3]);
        let velocity = [3.0, 4.0, 0.0, 0.0, 0.0, -1.0, 0.0, 2.0];
        let velocity = Array { name: "velocity [m/s]", components: 2, values: &velocity };
        let mut file = Vec::new();
        write_vtu(&mut file, &points, &cells, &[velocity], &[], Encoding::Compressed).expect("memory");
        VtuFile::parse(&String::from_utf8(file).expect("XML is text")).expect("a grid")
    }

    #[test]
    fn points_cells_and_speeds_are_read() {
        let mut file = square();
        let read = grid(&file).expect("a grid");
        assert_eq!(read.points, [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
        assert_eq!(read.cells, [[0, 1, 2], [0, 2, 3]]);
        assert_eq!(lengths(array(&file, "velocity [m/s]").expect("it is there")), [5.0, 0.0, 1.0, 2.0]);
        assert!(array(&file, "temperature").is_err());
        file.arrays.get_mut("connectivity").expect("cells have corners").values[5] = 4.0;
        assert!(grid(&file).is_err(), "a corner that is no point");
    }
}
