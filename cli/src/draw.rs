//! The fields of a run as a viewer shows them: in the deformed state.

use partita_fluid::FluidSolver;
use partita_iga::Spline;
use partita_mesh::vtu::Field;
use partita_structure::StructureSolver;

use crate::build::Run;
use crate::output::fields::{Series, Snapshot, Tessellation};
use crate::output::space::Estimate;
use crate::output::{OutputError, RunWriter};

/// Draws both fields; the lines of the structure's drawing are cut once.
#[derive(Debug)]
pub(crate) struct Drawing {
    structure: Option<Tessellation>,
}

impl Drawing {
    /// A drawing of `run` with each spline element cut into `subdivisions` parts along each side.
    #[must_use]
    pub(crate) fn new(run: &Run, subdivisions: usize) -> Self {
        let tessellate = |structure: &StructureSolver<2>| {
            let breakpoints = [0, 1].map(|parameter| breakpoints(structure.spline(), parameter));
            Tessellation::new([&breakpoints[0], &breakpoints[1]], subdivisions)
        };
        Self { structure: run.second().field().map(tessellate) }
    }

    /// Adds `files` drawings of `run` to what it will write.
    #[must_use]
    pub(crate) fn add_to(&self, mut estimate: Estimate, run: &Run, files: usize) -> Estimate {
        if let Some(fluid) = run.first().field() {
            // Velocity and pressure; where the mesh moves, points, displacement and mesh velocity too.
            let numbers = if fluid.mesh_quality().is_some() { 9 } else { 3 };
            let mesh = fluid.mesh();
            estimate = estimate.with_fields(files, mesh.points().len(), numbers, mesh.cells().len());
        }
        if let Some(tessellation) = &self.structure {
            // Points, displacement and velocity.
            let (points, cells) = (tessellation.parameters().len(), tessellation.cells().len());
            estimate = estimate.with_fields(files, points, 6, cells);
        }
        estimate
    }

    /// Writes the fields at the end of step `step`, at `time` \[s\].
    ///
    /// # Errors
    /// What the system refuses.
    pub(crate) fn write(
        &self,
        run: &Run,
        writer: &mut RunWriter,
        step: usize,
        time: f64,
    ) -> Result<(), OutputError> {
        if let Some(fluid) = run.first().field() {
            write_fluid(fluid, writer, step, time)?;
        }
        if let (Some(structure), Some(tessellation)) = (run.second().field(), &self.structure) {
            write_structure(structure, tessellation, writer, step, time)?;
        }
        Ok(())
    }
}

fn write_fluid(
    fluid: &FluidSolver<2>,
    writer: &mut RunWriter,
    step: usize,
    time: f64,
) -> Result<(), OutputError> {
    let (nodes, _) = fluid.values().as_chunks::<3>();
    let velocity: Vec<f64> = nodes.iter().flat_map(|&[u, v, _]| [u, v]).collect();
    let pressure: Vec<f64> = nodes.iter().map(|&[_, _, p]| p).collect();
    let point_data = [
        Field { name: "velocity [m/s]", components: 2, values: &velocity },
        Field { name: "pressure [Pa]", components: 1, values: &pressure },
        Field { name: "displacement [m]", components: 2, values: fluid.displacement() },
        Field { name: "mesh velocity [m/s]", components: 2, values: fluid.mesh_velocity() },
    ];
    let snapshot = Snapshot {
        points: fluid.points(),
        cells: fluid.mesh().cells(),
        point_data: &point_data,
        cell_data: &[],
    };
    writer.fields(Series::Fluid, step, time, &snapshot)
}

fn write_structure(
    structure: &StructureSolver<2>,
    tessellation: &Tessellation,
    writer: &mut RunWriter,
    step: usize,
    time: f64,
) -> Result<(), OutputError> {
    let (mut points, mut displacement, mut velocity) = (Vec::new(), Vec::new(), Vec::new());
    for xi in tessellation.parameters() {
        let (x, d, v) =
            (structure.spline().point(xi), structure.displacement_at(xi), structure.velocity_at(xi));
        points.push([x[0] + d[0], x[1] + d[1]]);
        displacement.extend(d);
        velocity.extend(v);
    }
    let point_data = [
        Field { name: "displacement [m]", components: 2, values: &displacement },
        Field { name: "velocity [m/s]", components: 2, values: &velocity },
    ];
    let snapshot =
        Snapshot { points: &points, cells: tessellation.cells(), point_data: &point_data, cell_data: &[] };
    writer.fields(Series::Structure, step, time, &snapshot)
}

/// Ends of the elements along one parameter, rising.
fn breakpoints(spline: &Spline<2>, parameter: usize) -> Vec<f64> {
    spline.knots()[parameter].breaks().map(|(xi, _)| xi).collect()
}
