//! The fields of a run as a viewer shows them: in the deformed state.
use partita_numerics::Field;

use partita_fluid::FluidSolver;
use partita_iga::Spline;
use partita_mesh::vtu::Array;
use partita_mesh::{Cells, SolidMesh};
use partita_structure::{Space, StructureSolver};

use crate::build::FieldMarch;
use crate::output::fields::{Series, Snapshot, Tessellation};
use crate::output::space::Estimate;
use crate::output::{OutputError, RunWriter};

/// Draws both fields; the lines of a patch are cut once, the cells of a mesh are drawn as they are.
#[derive(Debug)]
pub(crate) struct Drawing {
    patch: Option<Tessellation>,
}

impl Drawing {
    /// A drawing of `run` with each spline element cut into `subdivisions` parts along each side.
    #[must_use]
    pub(crate) fn new(run: &FieldMarch, subdivisions: usize) -> Self {
        let patch = run.second().field().and_then(|structure| match structure.space() {
            Space::Patch(patch) => Some(patch.spline()),
            Space::Lagrange(_) => None,
        });
        let tessellate = |spline: &Spline<2>| {
            let breakpoints = [0, 1].map(|parameter| breakpoints(spline, parameter));
            Tessellation::new([&breakpoints[0], &breakpoints[1]], subdivisions)
        };
        Self { patch: patch.map(tessellate) }
    }

    /// Adds `files` drawings of `run` to what it will write.
    #[must_use]
    pub(crate) fn add_to(&self, mut estimate: Estimate, run: &FieldMarch, files: usize) -> Estimate {
        if let Some(fluid) = run.first().field() {
            // Velocity and pressure; where the mesh moves, points, displacement and mesh velocity too.
            let numbers = if fluid.mesh_quality().is_some() { 9 } else { 3 };
            let mesh = fluid.mesh();
            estimate = estimate.with_fields(files, mesh.points().len(), numbers, mesh.cells().len());
        }
        if let Some(structure) = run.second().field() {
            let (points, cells) = match (structure.space(), &self.patch) {
                (Space::Lagrange(mesh), _) => (mesh.points().len(), mesh.cells().len()),
                (_, patch) => patch.as_ref().map_or((0, 0), |t| (t.parameters().len(), t.cells().len())),
            };
            // Points, displacement and velocity.
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
        run: &FieldMarch,
        writer: &mut RunWriter,
        step: usize,
        time: f64,
    ) -> Result<(), OutputError> {
        if let Some(fluid) = run.first().field() {
            write_fluid(fluid, writer, step, time)?;
        }
        if let Some(structure) = run.second().field() {
            match (structure.space(), &self.patch) {
                (Space::Patch(patch), Some(tessellation)) => {
                    write_patch(structure, patch.spline(), tessellation, writer, step, time)?;
                }
                (Space::Patch(_), None) => unreachable!("a patch is cut when the drawing is made"),
                (Space::Lagrange(mesh), _) => write_solid(structure, mesh, writer, step, time)?,
            }
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
        Array { name: "velocity [m/s]", components: 2, values: &velocity },
        Array { name: "pressure [Pa]", components: 1, values: &pressure },
        Array { name: "displacement [m]", components: 2, values: fluid.displacement() },
        Array { name: "mesh velocity [m/s]", components: 2, values: fluid.mesh_velocity() },
    ];
    let snapshot = Snapshot {
        points: fluid.points(),
        cells: fluid.mesh().cells(),
        point_data: &point_data,
        cell_data: &[],
    };
    writer.fields(Series::Fluid, step, time, &snapshot)
}

fn write_patch(
    structure: &StructureSolver<2>,
    spline: &Spline<2>,
    tessellation: &Tessellation,
    writer: &mut RunWriter,
    step: usize,
    time: f64,
) -> Result<(), OutputError> {
    let (mut points, mut displacement, mut velocity) = (Vec::new(), Vec::new(), Vec::new());
    for xi in tessellation.parameters() {
        points.push(spline.point(xi));
        displacement.extend(structure.displacement_at(xi));
        velocity.extend(structure.velocity_at(xi));
    }
    write_deformed(tessellation.cells(), points, &displacement, &velocity, writer, step, time)
}

fn write_solid(
    structure: &StructureSolver<2>,
    mesh: &SolidMesh<2>,
    writer: &mut RunWriter,
    step: usize,
    time: f64,
) -> Result<(), OutputError> {
    let state = structure.state();
    let [displacement, velocity] = [&state.displacement, &state.velocity];
    write_deformed(mesh.cells(), mesh.points().to_vec(), displacement, velocity, writer, step, time)
}

/// Writes a structure whose undeformed points are `points`.
fn write_deformed(
    cells: &Cells,
    mut points: Vec<[f64; 2]>,
    displacement: &[f64],
    velocity: &[f64],
    writer: &mut RunWriter,
    step: usize,
    time: f64,
) -> Result<(), OutputError> {
    for (x, d) in points.as_flattened_mut().iter_mut().zip(displacement) {
        *x += d;
    }
    let point_data = [
        Array { name: "displacement [m]", components: 2, values: displacement },
        Array { name: "velocity [m/s]", components: 2, values: velocity },
    ];
    let snapshot = Snapshot { points: &points, cells, point_data: &point_data, cell_data: &[] };
    writer.fields(Series::Structure, step, time, &snapshot)
}

/// Ends of the elements along one parameter, rising.
fn breakpoints(spline: &Spline<2>, parameter: usize) -> Vec<f64> {
    spline.knots()[parameter].breaks().map(|(xi, _)| xi).collect()
}
