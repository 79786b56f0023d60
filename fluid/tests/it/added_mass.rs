//! The added mass of an inviscid fluid against exact solutions.

use partita_fluid::{BodyForce, BoundaryCondition, FluidModel, FluidSettings, FluidSolver, InitialState};

use super::common::{boundary, unit_square};

/// A square basin of water, open at the top, on an interface.
fn basin(divisions: usize) -> FluidSolver<2> {
    let model = FluidModel {
        density: 1000.0,
        viscosity: 1.0,
        body_force: BodyForce::Constant([0.0; 2]),
        boundary: boundary(&[
            ("left", BoundaryCondition::Slip),
            ("right", BoundaryCondition::Slip),
            ("top", BoundaryCondition::StressFree { backflow: false }),
            ("bottom", BoundaryCondition::Interface),
        ]),
        initial: InitialState::Rest,
    };
    FluidSolver::new(unit_square(divisions), model, FluidSettings::default()).expect("a basin")
}

fn added_mass(divisions: usize, motion: impl Fn(f64) -> [f64; 2]) -> f64 {
    let basin = basin(divisions);
    let nodes = basin.interface_nodes().iter();
    let phi: Vec<f64> = nodes.flat_map(|&node| motion(basin.mesh().points()[node][0])).collect();
    basin.added_mass(&phi).expect("the top is open")
}

#[test]
fn a_piston_lifts_all_the_water() {
    assert!((added_mass(3, |_| [0.0, 1.0]) / 1000.0 - 1.0).abs() < 1e-12);
    assert!((added_mass(3, |_| [7.0, 2.0]) / 4000.0 - 1.0).abs() < 1e-12, "sliding along it moves none");
}

/// phi = cos(k x): p = rho cos(k x) sinh(k (1 - y)) / (k cosh k), so that m = rho tanh(k) / (2 k).
#[test]
fn a_wave_moves_a_layer_and_the_error_is_of_second_order() {
    let k = std::f64::consts::PI;
    let exact = 1000.0 * k.tanh() / (2.0 * k);
    let error = |divisions| (added_mass(divisions, |x| [0.0, (k * x).cos()]) / exact - 1.0).abs();
    let (coarse, fine) = (error(8), error(16));
    assert!(fine < 0.02 && (coarse / fine).log2() > 1.8, "{coarse} {fine}");
}

#[test]
fn a_fluid_that_cannot_give_way_has_none() {
    let mut model = FluidModel {
        density: 1.0,
        viscosity: 1.0,
        body_force: BodyForce::Constant([0.0; 2]),
        boundary: boundary(&[
            ("left", BoundaryCondition::NoSlip),
            ("right", BoundaryCondition::NoSlip),
            ("top", BoundaryCondition::NoSlip),
            ("bottom", BoundaryCondition::RigidInterface),
        ]),
        initial: InitialState::Rest,
    };
    let pin = Some(partita_fluid::PressurePin { node: 0, pressure: 0.0 });
    let settings = FluidSettings { pressure_pin: pin, ..FluidSettings::default() };
    let closed = FluidSolver::new(unit_square(2), model.clone(), settings).expect("a closed box");
    assert!(closed.added_mass(&[0.0, 1.0].repeat(3)).is_err());
    model.boundary[2].1 = BoundaryCondition::StressFree { backflow: false };
    let open = FluidSolver::new(unit_square(2), model, FluidSettings::default()).expect("an open box");
    assert!(open.added_mass(&[0.0, 1.0].repeat(3)).is_ok());
}
