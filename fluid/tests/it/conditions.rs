//! Boundary conditions: precedence at corners, walls in any direction, developed outflow.
use partita_numerics::Field;

use partita_fluid::{BodyForce, BoundaryCondition, FluidModel, FluidSettings, FluidSolver, TimeScheme};
use partita_mesh::Mesh;
use partita_mesh::generate::{Diagonal, RectangleMesh, rectangle};
use partita_numerics::newton::Limit;

use crate::common::*;

fn node_at(mesh: &Mesh<2>, place: [f64; 2]) -> usize {
    let near = |x: &[f64; 2]| (x[0] - place[0]).hypot(x[1] - place[1]) < 1e-9;
    mesh.points().iter().position(near).expect("a node there")
}

fn velocity_at(fluid: &FluidSolver<2>, place: [f64; 2]) -> [f64; 2] {
    let node = node_at(fluid.mesh(), place);
    [fluid.values()[3 * node], fluid.values()[3 * node + 1]]
}

/// Two conditions meet in a corner, listed in both orders; `walls` wins over `inflow`.
fn at_corner(left: &BoundaryCondition<2>, bottom: &BoundaryCondition<2>, left_first: bool) -> [f64; 2] {
    let mut conditions = vec![
        ("left", left.clone()),
        ("bottom", bottom.clone()),
        ("right", BoundaryCondition::DoNothing { backflow: false }),
        ("top", BoundaryCondition::Slip),
    ];
    if !left_first {
        conditions.swap(0, 1);
    }
    let mut fluid =
        FluidSolver::new(unit_square(2), model(boundary(&conditions)), settings(BDF1)).expect("a fluid");
    fluid.begin_step(0.1, 0.1).expect("a step");
    let moved = vec![0.01; fluid.interface_nodes().len() * 2];
    fluid.impose(&moved).expect("a motion");
    velocity_at(&fluid, [0.0, 0.0])
}

#[test]
fn walls_and_interfaces_win_over_inflow_at_their_corner() {
    let inflow = BoundaryCondition::Velocity(field(|_, _| [1.0, 0.5]));
    let wall = BoundaryCondition::WallMotion(field(|_, _| [0.02, 0.03]));
    for left_first in [true, false] {
        let corner = |left, bottom| at_corner(left, bottom, left_first).map(|u| (u * 1e9).round() / 1e9);
        assert_eq!(corner(&inflow, &BoundaryCondition::NoSlip), [0.0, 0.0]);
        assert_eq!(corner(&inflow, &BoundaryCondition::Interface), [0.1, 0.1]);
        assert_eq!(corner(&inflow, &wall), [0.2, 0.3]);
        assert_eq!(corner(&wall, &BoundaryCondition::Interface), [0.1, 0.1]);
        assert_eq!(corner(&inflow, &BoundaryCondition::Slip), [1.0, 0.5]);
        assert_eq!(corner(&inflow, &BoundaryCondition::StressFree { backflow: true }), [1.0, 0.5]);
    }
}

#[test]
fn first_of_equals_wins_at_a_corner() {
    let inflow = |u: f64| BoundaryCondition::Velocity(field(move |_, _| [u, 0.0]));
    assert_eq!(at_corner(&inflow(1.0), &inflow(2.0), true), [1.0, 0.0]);
    assert_eq!(at_corner(&inflow(1.0), &inflow(2.0), false), [2.0, 0.0]);
}

/// A channel with a slip wall on one side, in a frame turned by `angle`.
fn turned_channel(angle: f64) -> FluidSolver<2> {
    let (sin, cos) = angle.sin_cos();
    let turn = move |x: [f64; 2]| [cos * x[0] - sin * x[1], sin * x[0] + cos * x[1]];
    let back = move |x: &[f64; 2]| [cos * x[0] + sin * x[1], cos * x[1] - sin * x[0]];
    let straight = rectangle(&RectangleMesh {
        origin: [0.0; 2],
        size: [2.0, 1.0],
        divisions: [6, 4],
        pattern: Diagonal::Alternating,
    })
    .expect("a channel");
    let mesh =
        straight.with_points(straight.points().iter().map(|x| turn(*x)).collect()).expect("a turned mesh");
    let inflow = field(move |x: &[f64; 2], t| {
        let y = back(x)[1];
        turn([(1.0 + t) * (1.0 + y), 0.3 * y * (1.0 - y)])
    });
    let model = FluidModel {
        body_force: BodyForce::Constant(turn([0.4, -1.0])),
        ..model(boundary(&[
            ("left", BoundaryCondition::Velocity(inflow)),
            ("right", BoundaryCondition::DoNothing { backflow: true }),
            ("bottom", BoundaryCondition::Slip),
            ("top", BoundaryCondition::Slip),
        ]))
    };
    FluidSolver::new(mesh, model, settings(BDF2)).expect("a fluid")
}

#[test]
fn slip_walls_do_not_know_the_axes() {
    let (mut straight, mut turned) = (turned_channel(0.0), turned_channel(0.6));
    let (sin, cos) = 0.6_f64.sin_cos();
    for k in 1..4 {
        let t = 0.2 * f64::from(k);
        for fluid in [&mut straight, &mut turned] {
            fluid.begin_step(t, 0.2).expect("a step");
        }
        let iterations = [&mut straight, &mut turned].map(|fluid| {
            let report = fluid.advance(Limit::ToConvergence).expect("convergence");
            (report.iterations, report.entry.relative)
        });
        assert_eq!(iterations[0].0, iterations[1].0);
        assert!((iterations[0].1 / iterations[1].1 - 1.0).abs() < 1e-10, "{iterations:?}");
        straight.commit();
        turned.commit();
    }
    for (one, other) in straight.values().chunks_exact(3).zip(turned.values().chunks_exact(3)) {
        let expected = [cos * one[0] - sin * one[1], sin * one[0] + cos * one[1], one[2]];
        for c in 0..3 {
            assert!((expected[c] - other[c]).abs() < 1e-8, "{expected:?} and {other:?}");
        }
    }
    let force = straight.force_on("bottom").expect("a group");
    let other = turned.force_on("bottom").expect("a group");
    assert!((cos * force[0] - sin * force[1] - other[0]).abs() < 1e-8);
    // Both list all velocities of the inclined walls, or the normal ones are left out.
    let velocities = |fluid: &FluidSolver<2>| fluid.parts()[0].dofs.len();
    assert!(velocities(&turned) > velocities(&straight));
}

/// Newton's convergence on an inclined wall shows whether matrix and residual are turned alike.
#[test]
fn newton_converges_quadratically_with_inclined_slip_walls() {
    let mut fluid = turned_channel(0.6);
    fluid.begin_step(0.5, 0.5).expect("a step");
    let report = fluid.advance(Limit::ToConvergence).expect("convergence");
    assert!(report.iterations <= 6, "{report:?}");
}

/// A wedge of slip walls that narrows: no fluid passes the walls, node by node of the consistent normals.
#[test]
fn nothing_flows_through_slip_walls_that_curve() {
    let straight = unit_square(6);
    let bent = |x: &[f64; 2]| [x[0], x[1] * (1.0 - 0.3 * x[0] * x[0])];
    let mesh = straight.with_points(straight.points().iter().map(bent).collect()).expect("a nozzle");
    let model = model(boundary(&[
        ("left", BoundaryCondition::Velocity(field(|_, _| [1.0, 0.0]))),
        ("right", BoundaryCondition::DoNothing { backflow: false }),
        ("bottom", BoundaryCondition::Slip),
        ("top", BoundaryCondition::Slip),
    ]));
    let mut fluid = FluidSolver::new(mesh, model, settings(TimeScheme::Steady)).expect("a fluid");
    step(&mut fluid, 1.0, 1.0);
    let flux = |group: &str| -> f64 {
        let facets = &fluid.mesh().group(group).expect("a group").facets;
        let through = |facet: &partita_mesh::Facet<2>| {
            let s = facet.area_vector(fluid.mesh().points());
            let at = |node: usize| s[0] * fluid.values()[3 * node] + s[1] * fluid.values()[3 * node + 1];
            facet.nodes.iter().map(|node| at(*node)).sum::<f64>() / 2.0
        };
        facets.iter().map(through).sum()
    };
    assert!((flux("left") + 1.0).abs() < 1e-14);
    // What passes the ends of the wall belongs to the inflow's horizontal velocity at the corner.
    assert!(flux("top").abs() < 5e-3, "{}", flux("top"));
    assert!((flux("right") - 1.0).abs() < 5e-3, "{}", flux("right"));
}

/// Developed channel flow with do-nothing at the end leaves as it came in; the stress-free condition bends it.
#[test]
fn developed_flow_leaves_undisturbed_only_with_do_nothing() {
    let profile = |x: &[f64; 2]| [4.0 * x[1] * (1.0 - x[1]), 0.0];
    let sideways = |outflow: BoundaryCondition<2>| {
        let model = model(boundary(&[
            ("left", BoundaryCondition::Velocity(field(move |x, _| profile(x)))),
            ("right", outflow),
            ("bottom", BoundaryCondition::NoSlip),
            ("top", BoundaryCondition::NoSlip),
        ]));
        let mut fluid =
            FluidSolver::new(unit_square(16), model, settings(TimeScheme::Steady)).expect("a fluid");
        step(&mut fluid, 1.0, 1.0);
        velocity_error(&fluid, profile)
    };
    let do_nothing = sideways(BoundaryCondition::DoNothing { backflow: false });
    let stress_free = sideways(BoundaryCondition::StressFree { backflow: false });
    assert!(do_nothing < 0.01, "{do_nothing}");
    assert!(stress_free > 0.1, "{stress_free}");
}

/// The mesh slides along the side walls of a tank whose bottom rises; a wall at rest stays at rest.
#[test]
fn mesh_slides_along_walls_without_dragging_the_fluid() {
    let model = model(boundary(&[
        ("left", BoundaryCondition::NoSlip),
        ("right", BoundaryCondition::Slip),
        ("bottom", BoundaryCondition::Interface),
        ("top", BoundaryCondition::StressFree { backflow: false }),
    ]));
    let slide = ["left", "right"].map(String::from).to_vec();
    let settings = FluidSettings { mesh_slide: slide, ..settings(BDF1) };
    let mut fluid = FluidSolver::new(unit_square(4), model, settings).expect("a fluid");
    fluid.begin_step(0.1, 0.1).expect("a step");
    let rise: Vec<f64> = fluid.interface_nodes().iter().flat_map(|_| [0.0, 0.2]).collect();
    fluid.impose(&rise).expect("a motion");
    let middle = node_at(fluid.mesh(), [0.0, 0.5]);
    let displacement = &fluid.displacement()[2 * middle..2 * middle + 2];
    assert!(displacement[0] == 0.0 && displacement[1] > 0.05, "{displacement:?}");
    assert!(fluid.mesh_velocity()[2 * middle + 1] > 0.5);
    fluid.advance(Limit::ToConvergence).expect("convergence");
    assert_eq!(velocity_at(&fluid, [0.0, 0.5]), [0.0, 0.0]);
    assert_eq!(velocity_at(&fluid, [0.0, 0.0]), [0.0, 2.0]);
    assert!(fluid.mesh_quality().expect("a moving mesh").smallest_ratio > 0.5);
}
