//! The tangents of the fluid under the factorization made for them.
use partita_numerics::Field;

use partita_fluid::{BodyForce, BoundaryCondition, FluidModel, FluidSettings, FluidSolver, InitialState};
use partita_mesh::Mesh;
use partita_mesh::generate::{Diagonal, RectangleMesh, rectangle};
use partita_numerics::newton::{Limit, Problem};
use partita_numerics::{Connectivity, DofMap, Factor, Method, Pattern, Scatter};

use crate::common::{Noise, boundary, field, unit_square};

/// A channel of length one, `aspect` times as long as high: so stretched are its elements.
fn channel(aspect: f64) -> Mesh<2> {
    let size = [1.0, 1.0 / aspect];
    rectangle(&RectangleMesh { origin: [0.0; 2], size, divisions: [14; 2], pattern: Diagonal::Crossed })
        .expect("a box")
}

/// An uneven flow in the channel, with its tangent assembled.
fn flow(aspect: f64, reynolds: f64, dt: f64) -> FluidSolver<2> {
    let mesh = channel(aspect);
    let model = FluidModel {
        density: 1.0,
        viscosity: 1.0 / reynolds,
        body_force: BodyForce::Constant([0.0; 2]),
        boundary: boundary(&[
            ("left", BoundaryCondition::Velocity(field(|_: &[f64; 2], _| [1.0, 0.0]))),
            ("right", BoundaryCondition::StressFree { backflow: false }),
            ("bottom", BoundaryCondition::NoSlip),
            ("top", BoundaryCondition::Slip),
        ]),
        initial: InitialState::Velocity(field(|x: &[f64; 2], _| {
            [1.0 + (7.0 * x[0]).sin(), (9.0 * x[0]).cos()]
        })),
    };
    let mut fluid = FluidSolver::new(mesh, model, FluidSettings::default()).expect("a fluid");
    fluid.begin_step(dt, dt).expect("a step");
    fluid.assemble(true).expect("an assembly");
    fluid
}

/// The same matrix with its equations renumbered at random.
fn shuffled(pattern: &Pattern, values: &[f64]) -> (Pattern, Vec<f64>) {
    let mut numbers = Noise::new(11);
    let keys: Vec<f64> = (0..pattern.size()).map(|_| numbers.number()).collect();
    let mut name: Vec<usize> = (0..pattern.size()).collect();
    name.sort_by(|&a, &b| keys[a].total_cmp(&keys[b]));
    let entries = (0..pattern.size()).flat_map(|column| {
        (pattern.col_ptr()[column]..pattern.col_ptr()[column + 1])
            .map(move |slot| (pattern.row_idx()[slot], column, slot))
    });
    let pairs = Connectivity::new(
        2,
        entries.clone().flat_map(|(row, column, _)| [name[row], name[column]]).collect(),
    );
    let dofs = DofMap::new(&vec![false; pattern.size()]);
    let renamed = Pattern::new(&dofs, &[&pairs]);
    let scatter = Scatter::new(&renamed, &dofs, &pairs);
    let mut renamed_values = vec![0.0; renamed.nonzeros()];
    for (pair, (_, _, slot)) in entries.enumerate() {
        scatter.add_matrix(pair, &[0.0, values[slot], 0.0, 0.0], &mut renamed_values);
    }
    (renamed, renamed_values)
}

/// max `|b - A x|_i / (|A| |x| + |b|)_i` before and after one step of iterative refinement.
fn backward_errors(pattern: &Pattern, values: &[f64], factor: &mut Factor) -> [f64; 2] {
    let mut numbers = Noise::new(3);
    let rhs: Vec<f64> = (0..pattern.size()).map(|_| numbers.number()).collect();
    let sizes: Vec<f64> = values.iter().map(|value| value.abs()).collect();
    let (mut x, mut residual) = (vec![0.0; rhs.len()], rhs.clone());
    [(); 2].map(|()| {
        factor.solve(&mut residual);
        x.iter_mut().zip(&residual).for_each(|(x, correction)| *x += correction);
        pattern.multiply(values, &x, &mut residual);
        residual.iter_mut().zip(&rhs).for_each(|(r, b)| *r = b - *r);
        let mut scale = vec![0.0; rhs.len()];
        pattern.multiply(&sizes, &x.iter().map(|x| x.abs()).collect::<Vec<_>>(), &mut scale);
        let rows = residual.iter().zip(&scale).zip(&rhs);
        rows.fold(0.0, |error: f64, ((r, scale), b)| error.max(r.abs() / (scale + b.abs())))
    })
}

#[test]
fn tangents_of_all_flows_are_factored_to_round_off_without_fallback() {
    for aspect in [1.0, 30.0, 1000.0] {
        for reynolds in [1e-2, 1.0, 1e2, 1e4, 1e6] {
            for dt in [1e-6, 1e-3, 1.0, 1e3, 1e6] {
                let fluid = flow(aspect, reynolds, dt);
                let (pattern, values) = fluid.tangent();
                for (pattern, values) in [(pattern.clone(), values.to_vec()), shuffled(pattern, values)] {
                    let mut factor = Factor::new(Method::NodeBlockLu, &pattern).expect("memory suffices");
                    factor.refactor(&values).expect("a regular tangent");
                    let [first, refined] = backward_errors(&pattern, &values, &mut factor);
                    let place = format!("aspect {aspect}, Re {reynolds}, dt {dt}");
                    assert!(refined < 1e-14, "{place}: {first:e}, refined {refined:e}");
                    assert_eq!(factor.fallbacks(), 0, "{place}: {first:e}, refined {refined:e}");
                }
            }
        }
    }
}

#[test]
fn threads_change_no_bit_of_a_step() {
    let bits = |threads| {
        let model = FluidModel {
            density: 1.0,
            viscosity: 1e-3,
            body_force: BodyForce::Constant([0.0; 2]),
            boundary: boundary(&[
                ("left", BoundaryCondition::Velocity(field(|x: &[f64; 2], _| [x[1] * (1.0 - x[1]), 0.0]))),
                ("right", BoundaryCondition::StressFree { backflow: false }),
                ("bottom", BoundaryCondition::NoSlip),
                ("top", BoundaryCondition::NoSlip),
            ]),
            initial: InitialState::Rest,
        };
        let settings = FluidSettings { threads, ..FluidSettings::default() };
        let mut fluid = FluidSolver::new(unit_square(43), model, settings).expect("a fluid");
        assert!(fluid.tangent().0.size() > 10_000, "too small for a second thread");
        fluid.begin_step(0.1, 0.1).expect("a step");
        fluid.advance(Limit::AtMost(2)).expect("two iterations");
        fluid.values().iter().map(|value| value.to_bits()).collect::<Vec<_>>()
    };
    assert!(bits(1) == bits(2), "two threads change the flow");
}
