//! The tangent against finite differences of the residual.
use partita_numerics::Field;

use partita_iga::{Side, Spline};
use partita_numerics::newton::Problem;
use partita_structure::{Law, Material, Plane, Rayleigh, StructureSettings, StructureSolver, TimeScheme};

use crate::common::{
    Weights, bare, dense_tangent, distorted_cube, distorted_square, dynamic, largest, noise, quasi_static,
    solver, stepped_by,
};

fn settings() -> Vec<StructureSettings> {
    let damped =
        |settings| StructureSettings { rayleigh: Some(Rayleigh { mass: 0.4, stiffness: 0.03 }), ..settings };
    let newmark = stepped_by(TimeScheme::AVERAGE_ACCELERATION);
    vec![quasi_static(), dynamic(0.3), damped(quasi_static()), damped(dynamic(0.8)), damped(newmark)]
}

/// A solver in the middle of a step, away from rest and from the start of the step.
fn in_motion<const D: usize>(
    patch: Spline<D>,
    material: Material,
    settings: StructureSettings,
) -> StructureSolver<D> {
    let mut model = bare(material);
    model.density = 2.5;
    model.clamped = [Side::LEFT].into();
    let mut solver = solver(patch, model, settings);
    let mut state = solver.state().clone();
    let dofs = state.displacement.len();
    let free = &solver.parts()[0].dofs;
    for (field, seed) in [&mut state.displacement, &mut state.velocity, &mut state.acceleration]
        .into_iter()
        .zip([1.0, 2.0, 3.0])
    {
        let noise = noise(dofs, seed);
        for &dof in free {
            field[dof] = 0.05 * noise[dof];
        }
    }
    solver.restore(&state).unwrap();
    solver.begin_step(0.2, 0.2).expect("a step");
    let guess: Vec<f64> = noise(dofs, 4.0).into_iter().map(|x| 0.08 * x).collect();
    solver.guess(&guess);
    solver
}

fn check<const D: usize>(patch: &Spline<D>, material: Material, settings: StructureSettings) {
    let mut solver = in_motion(patch.clone(), material, settings);
    solver.assemble(true).unwrap();
    let tangent = dense_tangent(&solver);
    let scale = tangent.iter().map(|row| largest(row)).fold(0.0, f64::max);
    let free = solver.parts()[0].dofs.clone();
    let at = solver.values().to_vec();
    let step = 1e-5;
    for (column, &dof) in free.iter().enumerate() {
        let mut residual = |step: f64| {
            let mut moved = at.clone();
            moved[dof] += step;
            solver.guess(&moved);
            solver.assemble(false).unwrap();
            solver.residual().to_vec()
        };
        let (ahead, behind) = (residual(step), residual(-step));
        for (row, &force) in free.iter().enumerate() {
            let slope = (ahead[force] - behind[force]) / (2.0 * step);
            let error = (tangent[row][column] - slope).abs() / scale;
            assert!(error < 1e-6, "{material:?} {settings:?} ({row}, {column}): error {error:e}");
        }
    }
    for (row, entries) in tangent.iter().enumerate() {
        for column in 0..row {
            let mirrored = tangent[column][row];
            assert_eq!(entries[column].to_bits(), mirrored.to_bits(), "symmetry at ({row}, {column})");
        }
    }
}

#[test]
fn tangent_is_derivative_of_residual_and_symmetric_in_the_plane() {
    for law in [Law::LinearElastic, Law::StVenantKirchhoff, Law::NeoHookean] {
        for plane in [Plane::Strain, Plane::Stress] {
            let material = Material::new(law, 7.0, 0.3, plane).unwrap();
            for settings in settings() {
                check(&distorted_square(Weights::Unequal), material, settings);
            }
        }
    }
}

#[test]
fn tangent_is_derivative_of_residual_and_symmetric_in_space() {
    for law in [Law::LinearElastic, Law::StVenantKirchhoff, Law::NeoHookean] {
        let material = Material::new(law, 7.0, 0.3, Plane::Strain).unwrap();
        for settings in settings() {
            check(&distorted_cube(Weights::Unequal), material, settings);
        }
    }
}
