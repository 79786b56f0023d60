//! What a fluid refuses, and what it says.
use partita_numerics::Field;

use partita_fluid::{
    BoundaryCondition, FluidError, FluidModel, FluidSettings, FluidSolver, PressurePin, TimeScheme,
};
use partita_mesh::{CellKind, Cells, Mesh};
use partita_testing::with_hint;

use crate::common::*;

fn open() -> Vec<(String, BoundaryCondition<2>)> {
    boundary(&[
        ("left", BoundaryCondition::NoSlip),
        ("right", BoundaryCondition::NoSlip),
        ("bottom", BoundaryCondition::Interface),
        ("top", BoundaryCondition::StressFree { backflow: false }),
    ])
}

fn with(group: usize, condition: BoundaryCondition<2>) -> FluidModel<2> {
    let mut conditions = open();
    conditions[group].1 = condition;
    model(conditions)
}

fn refused(model: FluidModel<2>, settings: FluidSettings) -> FluidError {
    FluidSolver::new(unit_square(2), model, settings).err().expect("a refusal")
}

#[test]
fn properties_out_of_range_are_refused() {
    let water = model(open());
    let error = refused(FluidModel { density: -1.0, ..water.clone() }, settings(BDF1));
    insta::assert_snapshot!(with_hint(&error), @r"
    fluid: density -1 kg/m^3 is out of range
    hint: it is positive and finite
    ");
    let inviscid = FluidModel { viscosity: 0.0, ..water.clone() };
    assert!(FluidSolver::new(unit_square(2), inviscid.clone(), settings(BDF1)).is_ok());
    insta::assert_snapshot!(with_hint(&refused(inviscid, settings(TimeScheme::Steady))), @r"
    fluid: viscosity 0 Pa s is out of range
    hint: it is positive and finite; zero only in unsteady flow
    ");
    let nan = FluidModel { viscosity: f64::NAN, ..water.clone() };
    assert!(matches!(refused(nan, settings(BDF1)), FluidError::Property { .. }));
    let constant = FluidSettings { inverse_constant: 0.0, ..settings(BDF1) };
    assert!(matches!(refused(water.clone(), constant), FluidError::Property { .. }));
    let negative = FluidSettings { grad_div: -0.1, ..settings(BDF1) };
    assert!(matches!(refused(water, negative), FluidError::Property { .. }));
}

#[test]
fn groups_and_conditions_must_match() {
    let mut unknown = model(open());
    unknown.boundary[0].0 = "lift".into();
    insta::assert_snapshot!(with_hint(&refused(unknown, settings(BDF1))), @r"
    fluid: the mesh has no boundary group `lift`
    hint: its groups are left, right, bottom, top
    ");
    let mut missing = model(open());
    missing.boundary.remove(1);
    insta::assert_snapshot!(with_hint(&refused(missing, settings(BDF1))), @r"
    fluid: boundary group `right` has no condition
    hint: give it one; a boundary where the fluid may leave without stress is `StressFree`
    ");
    let mut twice = model(open());
    twice.boundary.push(("left".into(), BoundaryCondition::Slip));
    insta::assert_snapshot!(with_hint(&refused(twice, settings(BDF1))), @r"
    fluid: boundary group `left` has two conditions
    hint: remove one of them
    ");
    let points = vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
    let cells = Cells::new(CellKind::Triangle3, vec![0, 1, 2]);
    let mesh = Mesh::new(points, cells, vec![("foot".into(), vec![[0, 1]])]).expect("a mesh");
    let error = FluidSolver::new(mesh, model(boundary(&[("foot", BoundaryCondition::Slip)])), settings(BDF1));
    insta::assert_snapshot!(with_hint(&error.err().expect("a refusal")), @r"
    fluid: 2 boundary facets belong to no group, the first at (0.5, 0.5) m
    hint: every boundary facet needs a group and each group a condition
    ");
}

#[test]
fn pressure_needs_a_level_but_only_one() {
    let closed = with(2, BoundaryCondition::Slip);
    let mut closed = closed;
    closed.boundary[3].1 = BoundaryCondition::NoSlip;
    insta::assert_snapshot!(with_hint(&refused(closed.clone(), settings(BDF1))), @r"
    fluid: every boundary prescribes the normal velocity, so pressure is known only up to a constant
    hint: pin the pressure of one node, or make one boundary an outflow or a traction
    ");
    let pinned =
        |node| FluidSettings { pressure_pin: Some(PressurePin { node, pressure: 0.0 }), ..settings(BDF1) };
    assert!(FluidSolver::new(unit_square(2), closed.clone(), pinned(0)).is_ok());
    insta::assert_snapshot!(with_hint(&refused(closed, pinned(13))), @r"
    fluid: pressure pin at node 13, but there are only 13 nodes (counted from 0)
    hint: 0 will do
    ");
    insta::assert_snapshot!(with_hint(&refused(model(open()), pinned(0))), @r"
    fluid: a pressure pin is given, but boundary group `top` already fixes the level of pressure
    hint: remove the pin
    ");
    let moving = with(3, BoundaryCondition::Slip);
    insta::assert_snapshot!(with_hint(&refused(moving.clone(), settings(BDF1))), @r"
    fluid: boundary group `bottom` moves with a structure, and every boundary prescribes the normal velocity: an incompressible fluid admits only motions that keep its volume, and the iterates of an elastic structure do not
    hint: make one boundary an outflow or a traction
    ");
    assert!(matches!(refused(moving, pinned(0)), FluidError::ClosedAndMoving { .. }));
    let mut driven = with(2, BoundaryCondition::WallMotion(field(|_, t| [0.0, t])));
    driven.boundary[3].1 = BoundaryCondition::NoSlip;
    assert!(matches!(refused(driven.clone(), settings(BDF1)), FluidError::PressureLevel));
    assert!(FluidSolver::new(unit_square(2), driven, pinned(0)).is_ok(), "each step looks at the volume");
}

#[test]
fn closed_domain_must_keep_its_volume() {
    let mut conditions = open();
    conditions[2].1 = BoundaryCondition::NoSlip;
    conditions[3].1 = BoundaryCondition::NoSlip;
    conditions[0].1 = BoundaryCondition::Velocity(field(|x: &[f64; 2], t| [t * x[1] * (1.0 - x[1]), 0.0]));
    let settings = FluidSettings { pressure_pin: Some(PressurePin::default()), ..settings(BDF1) };
    let mut fluid = FluidSolver::new(unit_square(2), model(conditions), settings).expect("a fluid");
    insta::assert_snapshot!(with_hint(&fluid.begin_step(0.5, 0.5).expect_err("a refusal")), @r"
    t = 0.5 s, fluid: prescribed velocities carry a net -6.250e-2 m^2/s out of a closed domain (6.250e-2 m^2/s pass its boundary)
    hint: make one boundary an outflow or a traction, or balance inflow and outflow edge by edge
    ");
}

#[test]
fn mesh_slides_only_along_straight_walls_that_do_not_move() {
    let slide = |group: &str| FluidSettings { mesh_slide: vec![group.into()], ..settings(BDF1) };
    insta::assert_snapshot!(with_hint(&refused(model(open()), slide("bottom"))), @r"
    fluid: boundary group `bottom` moves, its mesh nodes cannot slide
    hint: let the mesh slide along the walls beside it
    ");
    insta::assert_snapshot!(with_hint(&refused(model(open()), slide("lift"))), @r"
    fluid: mesh motion: there is no boundary group `lift` to slide along
    hint: the groups are left, right, bottom, top
    ");
    let straight = unit_square(2);
    let skewed = straight.points().iter().map(|x| [x[0] + 0.2 * x[1], x[1]]).collect();
    let mesh = straight.with_points(skewed).expect("a mesh");
    let error = FluidSolver::new(mesh, model(open()), slide("left")).err().expect("a refusal");
    insta::assert_snapshot!(with_hint(&error), @r"
    fluid: mesh motion: nodes cannot slide along group `left`, its facet at (0.05, 0.25) m is not normal to an axis
    hint: only straight boundaries along x, y or z can slide
    ");
}

#[test]
fn data_that_is_not_finite_is_refused_where_it_is() {
    let settings = || FluidSettings { mesh_slide: vec!["left".into()], ..settings(BDF1) };
    let inflow = with(0, BoundaryCondition::Velocity(field(|x: &[f64; 2], _| [1.0 / (x[1] - 0.5), 0.0])));
    let mut fluid = FluidSolver::new(unit_square(2), inflow, settings()).expect("a fluid");
    insta::assert_snapshot!(with_hint(&fluid.begin_step(0.5, 0.5).expect_err("a refusal")), @r"
    t = 0.5 s, fluid: the prescribed velocity at node 3, (0, 0.5) m, is not finite
    hint: check its expression there
    ");
    let mut fluid = FluidSolver::new(unit_square(2), model(open()), settings()).expect("a fluid");
    insta::assert_snapshot!(with_hint(&fluid.begin_step(0.5, 0.0).expect_err("a refusal")), @r"
    fluid: time step 0 s to t = 0.5 s
    hint: time steps are positive and finite
    ");
    fluid.begin_step(0.5, 0.5).expect("a step");
    insta::assert_snapshot!(with_hint(&fluid.impose(&[0.0, f64::NAN, 0.0, 0.0, 0.0, 0.0]).expect_err("a refusal")), @r"
    t = 0.5 s, fluid: mesh motion: the prescribed displacement of node 0 at (0, 0) m is not finite
    hint: the solver that moves this boundary has diverged
    ");
    insta::assert_snapshot!(with_hint(&fluid.impose(&[0.0, 1.5, 0.0, 1.5, 0.0, 1.5]).expect_err("a refusal")), @r"
    t = 0.5 s, fluid: mesh motion: cell 0 at (0.253169, 1.4625) m is inverted, measure -2.813e-2 m^2
    hint: smaller time steps, incremental mesh motion, or another stiffening
    ");
    // A call that failed leaves a step that can be given up and redone.
    fluid.rewind();
    fluid.begin_step(0.5, 0.5).expect("a step");
}

#[test]
#[should_panic(expected = "begin_step comes first")]
fn imposing_outside_a_step_is_a_developers_error() {
    let mut fluid = FluidSolver::new(unit_square(2), model(open()), settings(BDF1)).expect("a fluid");
    let _ = fluid.impose(&[0.0; 6]);
}
