//! The assembled tangent against differences of the assembled residual.
use partita_numerics::Field;

use partita_fluid::{BoundaryCondition, FluidSettings, FluidSolver, PressurePin, TimeScheme};
use partita_mesh::Mesh;
use partita_numerics::newton::Problem;

use crate::common::*;

/// Flow through a box with every kind of boundary, in the middle of a run on a mesh that moves at random.
fn plane(time: TimeScheme, outflow: BoundaryCondition<2>) -> FluidSolver<2> {
    let mesh = perturbed(&unit_square(3), 0.04, 7);
    let mut model = model(boundary(&[
        ("left", BoundaryCondition::Velocity(field(|x: &[f64; 2], t| [1.0 + t + x[1], 0.3 * x[0]]))),
        ("bottom", BoundaryCondition::Interface),
        ("right", outflow),
        ("top", BoundaryCondition::Traction(field(|x: &[f64; 2], t| [x[0], 2.0 - t]))),
    ]));
    model.body_force = partita_fluid::BodyForce::Field(field(|x: &[f64; 2], t| [x[1] * t, x[0]]));
    FluidSolver::new(mesh, model, settings(time)).expect("a fluid")
}

fn space(time: TimeScheme) -> FluidSolver<3> {
    let mesh = perturbed(&unit_cube(2), 0.05, 8);
    let model = model(boundary(&[
        ("left", BoundaryCondition::Velocity(field(|x: &[f64; 3], _| [x[1], 0.2, -x[2]]))),
        ("right", BoundaryCondition::DoNothing { backflow: true }),
        ("bottom", BoundaryCondition::Interface),
        ("top", BoundaryCondition::StressFree { backflow: true }),
        ("front", BoundaryCondition::Slip),
        ("back", BoundaryCondition::Traction(field(|x: &[f64; 3], _| [1.0, x[0], x[1]]))),
    ]));
    FluidSolver::new(mesh, model, settings(time)).expect("a fluid")
}

/// Two committed steps and a third one begun, with random iterates and motions.
fn in_motion<const D: usize>(mut fluid: FluidSolver<D>, amplitude: f64) -> FluidSolver<D> {
    let mut numbers = Noise::new(9);
    for (k, dt) in [0.1, 0.07, 0.12].into_iter().enumerate() {
        fluid.begin_step(0.1 * (k + 1) as f64, dt).expect("a step");
        let mesh: Mesh<D> = fluid.mesh().clone();
        let mut motion: Vec<f64> =
            (0..mesh.points().len() * D).map(|_| amplitude * numbers.number()).collect();
        for node in mesh.group_nodes("front").unwrap_or_default() {
            motion[node * D + D - 1] = 0.0; // an inclined slip wall would turn the equations of its nodes
        }
        fluid.impose_mesh(&motion).expect("no inverted cells");
        let values: Vec<f64> = fluid.values().iter().map(|_| numbers.number()).collect();
        fluid.set_values(&values).expect("finite values");
        if k < 2 {
            fluid.commit();
        }
    }
    fluid
}

/// Free dofs in the order of the equations; holds where no wall is inclined.
fn free_dofs<const D: usize>(fluid: &FluidSolver<D>) -> Vec<usize> {
    let mut dofs: Vec<usize> = fluid.parts().iter().flat_map(|part| part.dofs.clone()).collect();
    dofs.sort_unstable();
    dofs
}

/// K x against the central difference of R along x, each block relative to its own size.
fn defect<const D: usize>(fluid: &mut FluidSolver<D>) -> f64 {
    let free = free_dofs(fluid);
    let mut numbers = Noise::new(10);
    let mut worst = 0.0_f64;
    for _ in 0..5 {
        let direction: Vec<f64> = free.iter().map(|_| numbers.number()).collect();
        fluid.assemble(true).expect("an assembly");
        let (pattern, values) = fluid.tangent();
        let mut product = vec![0.0; free.len()];
        pattern.multiply(values, &direction, &mut product);
        let iterate = fluid.values().to_vec();
        let mut residual_at = |step: f64| {
            let mut moved = iterate.clone();
            for (dof, along) in free.iter().zip(&direction) {
                moved[*dof] += step * along;
            }
            fluid.set_values(&moved).expect("finite values");
            fluid.assemble(false).expect("an assembly");
            fluid.residual().to_vec()
        };
        let step = 1e-6;
        let (plus, minus) = (residual_at(step), residual_at(-step));
        fluid.set_values(&iterate).expect("finite values");
        for pressure_rows in [false, true] {
            let (mut error, mut size) = (0.0_f64, 0.0_f64);
            for (equation, &dof) in free.iter().enumerate() {
                if (dof % (D + 1) == D) == pressure_rows {
                    let differenced = (plus[dof] - minus[dof]) / (2.0 * step);
                    error = error.max((product[equation] - differenced).abs());
                    size = size.max(differenced.abs());
                }
            }
            worst = worst.max(error / size);
        }
    }
    worst
}

#[test]
fn tangent_is_derivative_of_residual() {
    for time in [TimeScheme::Steady, BDF1, BDF2] {
        for outflow in [
            BoundaryCondition::DoNothing { backflow: true },
            BoundaryCondition::DoNothing { backflow: false },
            BoundaryCondition::StressFree { backflow: true },
            BoundaryCondition::StressFree { backflow: false },
        ] {
            let mut fluid = in_motion(plane(time, outflow.clone()), 0.02);
            let defect = defect(&mut fluid);
            assert!(defect < 1e-6, "{time:?}, {outflow:?}: {defect:.1e}");
        }
        let defect = defect(&mut in_motion(space(time), 0.02));
        assert!(defect < 1e-6, "{time:?} in space: {defect:.1e}");
    }
}

#[test]
fn tangent_of_a_closed_domain_is_derivative_of_residual() {
    let mesh = perturbed(&unit_square(3), 0.04, 7);
    let lid = field(|_: &[f64; 2], _| [1.0, 0.0]);
    let model = model(boundary(&[
        ("left", BoundaryCondition::NoSlip),
        ("right", BoundaryCondition::NoSlip),
        ("bottom", BoundaryCondition::Slip),
        ("top", BoundaryCondition::Velocity(lid)),
    ]));
    let pin = Some(PressurePin { node: 5, pressure: 2.0 });
    let settings = FluidSettings { pressure_pin: pin, ..settings(BDF1) };
    let mut fluid = FluidSolver::new(mesh, model, settings).expect("a fluid");
    let mut numbers = Noise::new(11);
    fluid.begin_step(0.1, 0.1).expect("a step");
    let values: Vec<f64> = fluid.values().iter().map(|_| numbers.number()).collect();
    fluid.set_values(&values).expect("finite values");
    assert_eq!(fluid.values()[5 * 3 + 2], 2.0);
    let defect = defect(&mut fluid);
    assert!(defect < 1e-6, "{defect:.1e}");
}
