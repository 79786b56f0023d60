//! Meshes, fields and runs that the tests share.
use partita_numerics::Field;

use std::sync::Arc;

use partita_fluid::{
    BodyForce, BoundaryCondition, FluidModel, FluidSettings, FluidSolver, InitialState, TimeScheme,
    VectorField,
};
use partita_mesh::Mesh;
use partita_mesh::generate::{CuboidMesh, Diagonal, RectangleMesh, cuboid, rectangle};
use partita_numerics::newton::{self, Bound, Limit, Verdict};
use partita_numerics::time::BdfOrder;

pub(crate) const BDF1: TimeScheme = TimeScheme::Bdf(BdfOrder::One);
pub(crate) const BDF2: TimeScheme = TimeScheme::Bdf(BdfOrder::Two);

pub(crate) use partita_testing::Noise;

pub(crate) fn field<const D: usize>(
    f: impl Fn(&[f64; D], f64) -> [f64; D] + Send + Sync + 'static,
) -> VectorField<D> {
    Arc::new(f)
}

pub(crate) fn unit_square(divisions: usize) -> Mesh<2> {
    rectangle(&RectangleMesh {
        origin: [0.0; 2],
        size: [1.0; 2],
        divisions: [divisions; 2],
        pattern: Diagonal::Crossed,
    })
    .expect("a square")
}

pub(crate) fn unit_cube(divisions: usize) -> Mesh<3> {
    cuboid(&CuboidMesh { origin: [0.0; 3], size: [1.0; 3], divisions: [divisions; 3] }).expect("a cube")
}

/// Displacements of the inner nodes, `node * D + c`, each component at most `amplitude`.
pub(crate) fn inner_motion<const D: usize>(mesh: &Mesh<D>, amplitude: f64, numbers: &mut Noise) -> Vec<f64> {
    let mut inner = vec![true; mesh.points().len()];
    for facet in mesh.topology().boundary() {
        for node in facet.nodes {
            inner[node] = false;
        }
    }
    let scaled = |inner: bool, x: f64| if inner { amplitude * x } else { 0.0 };
    inner.iter().flat_map(|inner| [*inner; D]).map(|inner| scaled(inner, numbers.number())).collect()
}

/// The mesh with its inner nodes displaced at random.
pub(crate) fn perturbed<const D: usize>(mesh: &Mesh<D>, amplitude: f64, seed: u64) -> Mesh<D> {
    let motion = inner_motion(mesh, amplitude, &mut Noise::new(seed));
    let moved = |(node, point): (usize, &[f64; D])| std::array::from_fn(|c| point[c] + motion[node * D + c]);
    mesh.with_points(mesh.points().iter().enumerate().map(moved).collect()).expect("no inverted cells")
}

/// Conditions by group name.
pub(crate) fn boundary<const D: usize>(
    conditions: &[(&str, BoundaryCondition<D>)],
) -> Vec<(String, BoundaryCondition<D>)> {
    conditions.iter().map(|(group, condition)| ((*group).to_string(), condition.clone())).collect()
}

/// The same condition on all groups of a mesh.
pub(crate) fn everywhere<const D: usize>(
    mesh: &Mesh<D>,
    condition: &BoundaryCondition<D>,
) -> Vec<(String, BoundaryCondition<D>)> {
    mesh.groups().iter().map(|group| (group.name.clone(), condition.clone())).collect()
}

/// A fluid of density 1.2 and viscosity 0.05 without loads, from rest.
pub(crate) fn model<const D: usize>(boundary: Vec<(String, BoundaryCondition<D>)>) -> FluidModel<D> {
    FluidModel {
        density: 1.2,
        viscosity: 0.05,
        body_force: BodyForce::Constant([0.0; D]),
        boundary,
        initial: InitialState::Rest,
    }
}

pub(crate) fn settings(time: TimeScheme) -> FluidSettings {
    FluidSettings { time, ..FluidSettings::default() }
}

/// Newton's method beyond its bound, until round-off is all that is left.
pub(crate) fn exhaust<const D: usize>(fluid: &mut FluidSolver<D>) {
    let never = newton::Settings { bound: Bound::Relative(0.0), ..*fluid.newton_settings() };
    let report =
        newton::solve(fluid, &never, Limit::AtMost(8), |_, _| Verdict::Continue).expect("iterations");
    assert!(report.exit.relative < 1e-10, "{report:?}");
}

/// One step on a mesh that does not move.
pub(crate) fn step<const D: usize>(fluid: &mut FluidSolver<D>, time: f64, dt: f64) {
    fluid.begin_step(time, dt).expect("a step");
    fluid.advance(Limit::ToConvergence).expect("convergence");
    fluid.commit();
}

/// Largest distance of the nodal velocities from a field.
pub(crate) fn velocity_error<const D: usize>(
    fluid: &FluidSolver<D>,
    exact: impl Fn(&[f64; D]) -> [f64; D],
) -> f64 {
    let nodes = fluid.values().chunks_exact(D + 1).zip(fluid.points());
    nodes.fold(0.0, |error, (values, point)| {
        let exact = exact(point);
        (0..D).fold(error, |error: f64, c| error.max((values[c] - exact[c]).abs()))
    })
}

/// Largest distance of the nodal pressures from a field.
pub(crate) fn pressure_error<const D: usize>(
    fluid: &FluidSolver<D>,
    exact: impl Fn(&[f64; D]) -> f64,
) -> f64 {
    let nodes = fluid.values().chunks_exact(D + 1).zip(fluid.points());
    nodes.fold(0.0, |error, (values, point)| error.max((values[D] - exact(point)).abs()))
}
