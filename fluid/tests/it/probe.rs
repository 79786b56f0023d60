//! Energy, flow rates and the balance of volume.
use partita_numerics::Field;

use partita_fluid::{BoundaryCondition, FluidModel, FluidSolver, InitialState, TimeScheme};

use crate::common::*;

/// Linear flow through a distorted box, as its initial state.
fn stream<const D: usize>(mesh: partita_mesh::Mesh<D>, u: fn(&[f64; D]) -> [f64; D]) -> FluidSolver<D> {
    let velocity = BoundaryCondition::Velocity(field(move |x, _| u(x)));
    let mut conditions = everywhere(&mesh, &velocity);
    conditions.iter_mut().find(|(group, _)| group == "right").expect("a right side").1 =
        BoundaryCondition::StressFree { backflow: false };
    let initial = InitialState::Velocity(field(move |x, _| u(x)));
    let model = FluidModel { initial, ..model(conditions) };
    FluidSolver::new(mesh, model, settings(BDF1)).expect("a fluid")
}

#[test]
fn kinetic_energy_of_a_linear_flow_is_exact() {
    // rho/2 of the integrals of (1 + x)^2 + (2 y)^2, and of (1 + x)^2 + (2 z)^2: the same number.
    let exact = 0.5 * 1.2 * (7.0 / 3.0 + 4.0 / 3.0);
    let plane = stream(perturbed(&unit_square(4), 0.03, 12), |x| [1.0 + x[0], 2.0 * x[1]]);
    assert!((plane.kinetic_energy() - exact).abs() < 1e-14, "{}", plane.kinetic_energy());
    let space = stream(perturbed(&unit_cube(3), 0.03, 13), |x| [1.0 + x[0], 0.0, 2.0 * x[2]]);
    assert!((space.kinetic_energy() - exact).abs() < 1e-14, "{}", space.kinetic_energy());
}

#[test]
fn flow_rates_are_the_fluxes_through_the_sides() {
    let plane = stream(perturbed(&unit_square(4), 0.03, 12), |x| [1.0 + x[0], 0.5 - x[1]]);
    let rate = |group: &str| plane.flow_rate(group).expect("a group");
    for (group, expected) in [("left", -1.0), ("right", 2.0), ("bottom", -0.5), ("top", -0.5)] {
        assert!((rate(group) - expected).abs() < 1e-14, "{group}: {}", rate(group));
    }
    assert!(plane.flow_rate("nowhere").is_none());
    let space = stream(unit_cube(2), |x| [1.0 + x[0], 0.0, -x[2]]);
    let rate = space.flow_rate("right").expect("a group");
    assert!((rate - 2.0).abs() < 1e-14, "{rate}");
}

/// A piston pushes fluid out at the top; through the piston itself nothing flows. What the boundary sweeps and
/// what passes it make up the change of volume, but for the defect.
#[test]
fn nothing_flows_through_a_wall_that_moves_and_the_rest_leaves() {
    for time in [BDF1, BDF2] {
        let model = model(boundary(&[
            ("left", BoundaryCondition::Slip),
            ("right", BoundaryCondition::Slip),
            ("bottom", BoundaryCondition::Interface),
            ("top", BoundaryCondition::StressFree { backflow: false }),
        ]));
        let mut fluid = FluidSolver::new(unit_square(6), model, settings(time)).expect("a fluid");
        let area = |fluid: &FluidSolver<2>| -> f64 {
            let cells = fluid.mesh().cells();
            cells
                .iter()
                .map(|n| partita_mesh::simplex::measure(&[0, 1, 2].map(|a| fluid.points()[n[a]])))
                .sum()
        };
        let mut areas = vec![area(&fluid)];
        let mut last_rise = vec![0.0; 2 * fluid.interface_nodes().len()];
        assert_eq!(fluid.volume_defect(), 0.0);
        for k in 1..4 {
            let (t, dt) = (0.1 * f64::from(k), 0.1);
            fluid.begin_step(t, dt).expect("a step");
            let bump = |node: &usize| {
                let x = fluid.mesh().points()[*node][0];
                let bubble = 3.0 * t * t * x * (1.0 - x);
                [2.0 * bubble * x, 1.5 * bubble * (1.0 - x)]
            };
            let rise: Vec<f64> = fluid.interface_nodes().iter().flat_map(bump).collect();
            fluid.impose(&rise).expect("a motion");
            exhaust(&mut fluid);
            areas.push(area(&fluid));
            let during = fluid.volume_defect();
            let mut force = vec![0.0; rise.len()];
            fluid.output(&mut force);
            let work: f64 = (0..rise.len()).map(|i| force[i] * (rise[i] - last_rise[i])).sum();
            assert!(work.abs() > 1e-6, "this motion takes work: {work:e}");
            assert!((fluid.interface_work() - work).abs() < 1e-14 * work.abs());
            last_rise = rise;
            fluid.commit();
            assert!((fluid.interface_work() - work).abs() < 1e-14 * work.abs(), "it stays to be read");
            assert_eq!(fluid.volume_defect(), during, "the defect of the accepted step stays to be read");
            let rate = |group: &str| fluid.flow_rate(group).expect("a group");
            for wall in ["left", "right", "bottom"] {
                assert!(rate(wall).abs() < 1e-12, "{wall}: {}", rate(wall));
            }
            let now = areas.len() - 1;
            let second = time == BDF2 && k > 1;
            let swept = if second {
                (1.5 * areas[now] - 2.0 * areas[now - 1] + 0.5 * areas[now - 2]) / dt
            } else {
                (areas[now] - areas[now - 1]) / dt
            };
            // div u = 0 holds for the sum of all continuity rows, so the flux of u is zero to round-off.
            assert!(during.abs() > 1e-6, "this motion has a defect: {during:e}");
            assert!((rate("top") + swept - during).abs() < 1e-12, "{} {swept} {during}", rate("top"));
        }
        fluid.begin_step(0.4, 0.1).expect("a step");
        fluid.rewind();
        assert!(fluid.volume_defect().abs() > 1e-6, "a step given up changes nothing");
    }
}

#[test]
fn steady_flow_has_no_volume_defect() {
    let mut fluid = FluidSolver::new(
        unit_square(2),
        model(boundary(&[
            ("left", BoundaryCondition::NoSlip),
            ("right", BoundaryCondition::NoSlip),
            ("bottom", BoundaryCondition::Interface),
            ("top", BoundaryCondition::StressFree { backflow: false }),
        ])),
        settings(TimeScheme::Steady),
    )
    .expect("a fluid");
    fluid.begin_step(1.0, 1.0).expect("a step");
    let rise: Vec<f64> = fluid.interface_nodes().iter().flat_map(|_| [0.0, 0.1]).collect();
    fluid.impose(&rise).expect("a motion");
    assert_eq!(fluid.volume_defect(), 0.0);
}

#[test]
fn forces_on_groups_that_meet_add_up() {
    let model = model(boundary(&[
        ("left", BoundaryCondition::NoSlip),
        ("right", BoundaryCondition::NoSlip),
        ("bottom", BoundaryCondition::NoSlip),
        ("top", BoundaryCondition::StressFree { backflow: false }),
    ]));
    let model = FluidModel { body_force: partita_fluid::BodyForce::Constant([0.0, -10.0]), ..model };
    let density = model.density;
    let mut fluid = FluidSolver::new(unit_square(4), model, settings(BDF1)).expect("a fluid");
    fluid.begin_step(0.1, 0.1).expect("a step");
    exhaust(&mut fluid);
    // The walls and the bottom carry the weight of all the water, whatever the corners share.
    let [side, down] = fluid.force_on_all(&["left", "bottom", "right"]).expect("groups");
    assert!(side.abs() < 1e-10 && (down + 10.0 * density).abs() < 1e-10, "{side} {down}");
    // Each side of a corner has its own part: the bottom carries the water, the walls none of it.
    let parts = ["left", "bottom", "right"].map(|group| fluid.force_on(group).expect("a group")[1]);
    assert!((parts[1] - down).abs() < 1e-10 && parts[0].abs() < 1e-10 && parts[2].abs() < 1e-10, "{parts:?}");
    assert_eq!(fluid.force_on_all(&["left", "left"]), fluid.force_on("left"));
    assert!(fluid.force_on_all(&["left", "nowhere"]).is_none());
}
