//! Meshes, error norms and checks that the studies share.
use partita_numerics::Field;

use partita_fluid::{BoundaryCondition, FluidSolver, VectorField};
use partita_mesh::generate::{Diagonal, RectangleMesh, rectangle};
use partita_mesh::{Mesh, simplex};
use partita_numerics::gauss;
use partita_numerics::rates::fitted_order;

/// A square or rectangle of alternating triangles: of all patterns the one whose regularity helps least.
pub(crate) fn mesh(origin: [f64; 2], size: [f64; 2], divisions: [usize; 2]) -> Mesh<2> {
    rectangle(&RectangleMesh { origin, size, divisions, pattern: Diagonal::Alternating })
        .expect("a rectangle")
}

pub(crate) fn unit_square(divisions: usize) -> Mesh<2> {
    mesh([0.0; 2], [1.0; 2], [divisions; 2])
}

/// The velocity `field` prescribed all round.
pub(crate) fn prescribed(mesh: &Mesh<2>, field: &VectorField<2>) -> Vec<(String, BoundaryCondition<2>)> {
    everywhere(mesh, &BoundaryCondition::Velocity(field.clone()))
}

/// One condition all round.
pub(crate) fn everywhere(
    mesh: &Mesh<2>,
    condition: &BoundaryCondition<2>,
) -> Vec<(String, BoundaryCondition<2>)> {
    mesh.groups().iter().map(|group| (group.name.clone(), condition.clone())).collect()
}

/// A flow at one time and place.
pub(crate) struct Exact {
    pub(crate) velocity: [f64; 2],
    /// `du_i/dx_j`.
    pub(crate) gradient: [[f64; 2]; 2],
    pub(crate) pressure: f64,
}

/// Norms of the difference from an exact flow.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Errors {
    /// L2 of the velocity.
    pub(crate) velocity: f64,
    /// L2 of its gradient: the H1 seminorm.
    pub(crate) gradient: f64,
    /// L2 of the pressure without its mean.
    pub(crate) pressure: f64,
}

/// Errors on the present mesh, by a rule that is exact for degree 4.
pub(crate) fn errors(fluid: &FluidSolver<2>, exact: impl Fn(&[f64; 2]) -> Exact) -> Errors {
    let mut squares = [0.0; 3];
    let (mut pressure_mean, mut area) = (0.0, 0.0);
    for nodes in fluid.mesh().cells() {
        let vertices: [[f64; 2]; 3] = std::array::from_fn(|a| fluid.points()[nodes[a]]);
        let (gradients, measure) = simplex::gradients(&vertices).expect("a triangle that is not flat");
        let nodal = |a: usize, c: usize| fluid.values()[3 * nodes[a] + c];
        for (barycentric, weight) in gauss::triangle(4) {
            let at = |value: &dyn Fn(usize) -> f64| (0..3).map(|a| barycentric[a] * value(a)).sum::<f64>();
            let exact = exact(&std::array::from_fn(|i| at(&|a| vertices[a][i])));
            let weight = weight * measure;
            for i in 0..2 {
                squares[0] += weight * (at(&|a| nodal(a, i)) - exact.velocity[i]).powi(2);
                for j in 0..2 {
                    let slope: f64 = (0..3).map(|a| gradients[a][j] * nodal(a, i)).sum();
                    squares[1] += weight * (slope - exact.gradient[i][j]).powi(2);
                }
            }
            let error = at(&|a| nodal(a, 2)) - exact.pressure;
            squares[2] += weight * error * error;
            pressure_mean += weight * error;
            area += weight;
        }
    }
    squares[2] -= pressure_mean * pressure_mean / area;
    let [velocity, gradient, pressure] = squares.map(f64::sqrt);
    Errors { velocity, gradient, pressure }
}

/// What is expected of one norm: its order, and a bound of the error on the finest level.
///
/// The bound is 1.25 times the error found when the study was written. An order says nothing about the factor in
/// front; the bound does.
pub(crate) struct Expected {
    pub(crate) order: f64,
    pub(crate) error: f64,
}

/// Checks the fitted order, at most `slack` below what is expected, and the error on the last level.
pub(crate) fn assert_converges(what: &str, h: &[f64], errors: &[f64], expected: &Expected, slack: f64) {
    let order = fitted_order(h, errors);
    let table: Vec<String> = errors.iter().map(|error| format!("{error:.3e}")).collect();
    println!("{what}: order {order:.2}, errors {}", table.join("  "));
    assert!(order > expected.order - slack, "{what}: order {order:.2}, errors {errors:?}");
    let finest = errors[errors.len() - 1];
    assert!(finest < expected.error, "{what}: error {finest:.3e} on the finest level");
}
