//! The step in progress: its iterate and its mesh.

use partita_mesh::Place;
use partita_mesh::motion::MotionError;
use partita_mesh::{Mesh, simplex};
use partita_numerics::time::Bdf;

use crate::kernel::Flow;
use crate::state::FluidState;

/// Everything that a step changes before it is committed.
pub(crate) struct Trial<const D: usize> {
    /// `t_{n+1}` `[s]` and its distance from `t_n`; nothing outside a step.
    pub(crate) step: Option<(f64, f64)>,
    /// `D_t`; nothing in steady flow.
    pub(crate) bdf: Option<Bdf>,
    pub(crate) flow: Flow,
    /// u and p, `node * (D + 1) + c`.
    pub(crate) values: Vec<f64>,
    /// `c_1 u^n + c_2 u^{n-1}`, `node * D + c`.
    pub(crate) history: Vec<f64>,
    /// b, `node * D + c`.
    pub(crate) body_force: Vec<f64>,
    /// From the reference mesh, `node * D + c`.
    pub(crate) displacement: Vec<f64>,
    /// w, `node * D + c`.
    pub(crate) mesh_velocity: Vec<f64>,
    /// w of the committed step, for whoever draws it after a step was given up; no equation reads it.
    pub(crate) committed_mesh_velocity: Vec<f64>,
    /// The moved mesh.
    pub(crate) points: Vec<[f64; D]>,
}

impl<const D: usize> Trial<D> {
    pub(crate) fn new(mesh: &Mesh<D>, flow: Flow, committed: &FluidState) -> Self {
        let zero = vec![0.0; mesh.points().len() * D];
        Self {
            step: None,
            bdf: None,
            flow,
            values: committed.values.clone(),
            history: zero.clone(),
            body_force: zero.clone(),
            displacement: zero.clone(),
            mesh_velocity: zero.clone(),
            committed_mesh_velocity: zero,
            points: mesh.points().to_vec(),
        }
    }

    /// Back to the committed state, outside any step.
    pub(crate) fn reset(&mut self, mesh: &Mesh<D>, committed: &FluidState) {
        self.step = None;
        self.values.copy_from_slice(&committed.values);
        self.displacement.copy_from_slice(&committed.displacement);
        self.mesh_velocity.copy_from_slice(&self.committed_mesh_velocity);
        self.move_points(mesh);
    }

    /// Starts a step at the committed state.
    pub(crate) fn begin(
        &mut self,
        mesh: &Mesh<D>,
        committed: &FluidState,
        step: (f64, f64),
        bdf: Option<Bdf>,
    ) {
        self.reset(mesh, committed);
        self.step = Some(step);
        self.bdf = bdf;
        let [c0, c1, c2] = bdf.map_or([0.0; 3], |bdf| bdf.c);
        self.flow.rate = c0;
        self.flow.four_over_dt_squared = bdf.map_or(0.0, |bdf| 4.0 / (bdf.dt * bdf.dt));
        let nodes = committed.values.chunks_exact(D + 1).zip(committed.previous_values.chunks_exact(D + 1));
        for (history, (u, u_previous)) in self.history.chunks_exact_mut(D).zip(nodes) {
            for c in 0..D {
                history[c] = c1 * u[c] + c2 * u_previous[c];
            }
        }
    }

    /// Points and w from the displacement.
    pub(crate) fn follow(&mut self, mesh: &Mesh<D>, committed: &FluidState) -> Result<(), MotionError> {
        self.move_points(mesh);
        match self.bdf {
            None => self.mesh_velocity.fill(0.0),
            Some(bdf) => {
                for (i, w) in self.mesh_velocity.iter_mut().enumerate() {
                    let (current, previous) = (committed.displacement[i], committed.previous_displacement[i]);
                    *w = bdf.derivative(self.displacement[i], current, previous);
                }
            }
        }
        check_measures(mesh, &self.points)
    }

    fn move_points(&mut self, mesh: &Mesh<D>) {
        let displacements = self.displacement.chunks_exact(D);
        for ((point, reference), displacement) in self.points.iter_mut().zip(mesh.points()).zip(displacements)
        {
            *point = std::array::from_fn(|c| reference[c] + displacement[c]);
        }
    }
}

/// An inverted cell is an error that names it.
fn check_measures<const D: usize>(mesh: &Mesh<D>, points: &[[f64; D]]) -> Result<(), MotionError> {
    for (cell, nodes) in mesh.cells().iter().enumerate() {
        let vertices = simplex::vertices(points, nodes);
        let measure = simplex::measure(&vertices);
        if measure.is_nan() || measure <= 0.0 {
            let centroid = Place::from(simplex::centroid(&vertices[..=D]));
            return Err(MotionError::Inverted { cell, centroid, measure });
        }
    }
    Ok(())
}

/// Area or volume of the mesh under a displacement `[m^D]`.
pub(crate) fn volume<const D: usize>(mesh: &Mesh<D>, displacement: &[f64]) -> f64 {
    let measure = |nodes: &[usize]| {
        let mut vertices = simplex::vertices(mesh.points(), nodes);
        for (vertex, &node) in vertices.iter_mut().zip(nodes) {
            for c in 0..D {
                vertex[c] += displacement[node * D + c];
            }
        }
        simplex::measure(&vertices)
    };
    mesh.cells().iter().map(measure).sum()
}
