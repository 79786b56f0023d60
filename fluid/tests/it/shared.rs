//! Forces at nodes that boundaries of several kinds share.
use partita_numerics::Field;

use partita_fluid::{
    BodyForce, BoundaryCondition, FluidModel, FluidSettings, FluidSolver, PressurePin, TimeScheme,
};
use partita_mesh::Mesh;
use partita_mesh::generate::{Diagonal, RectangleMesh, rectangle};
use partita_numerics::newton::Problem;

use crate::common::*;

const OPEN: BoundaryCondition<2> = BoundaryCondition::StressFree { backflow: false };
const VISCOSITY: f64 = 0.05;

/// Integral of `p n - mu (grad u + grad u^T) n` over a group, of a linear p and a constant gradient.
fn exact_force<const D: usize>(
    mesh: &Mesh<D>,
    group: &str,
    pressure: impl Fn(&[f64; D]) -> f64,
    gradient: &[[f64; D]; D],
) -> [f64; D] {
    let mut total = [0.0; D];
    for facet in &mesh.group(group).expect("a group").facets {
        let s = facet.area_vector(mesh.points());
        let p = pressure(&facet.centroid(mesh.points()));
        for i in 0..D {
            let viscous: f64 = (0..D).map(|j| (gradient[i][j] + gradient[j][i]) * s[j]).sum();
            total[i] += p * s[i] - VISCOSITY * viscous;
        }
    }
    total
}

#[track_caller]
fn assert_near<const D: usize>(what: &str, found: [f64; D], expected: [f64; D], tolerance: f64) {
    for c in 0..D {
        assert!((found[c] - expected[c]).abs() < tolerance, "{what}: {found:?}, not {expected:?}");
    }
}

/// A linear flow in a box whose sides all prescribe it.
fn linear_flow<const D: usize>(mesh: &Mesh<D>, gradient: [[f64; D]; D]) {
    let pressure = |x: &[f64; D]| 2.0 - 3.0 * x[0] + 5.0 * x[D - 1];
    let velocity =
        move |x: &[f64; D]| std::array::from_fn(|i| 0.1 + (0..D).map(|j| gradient[i][j] * x[j]).sum::<f64>());
    let given = BoundaryCondition::Velocity(field(move |x, _| velocity(x)));
    let mut model = model(everywhere(mesh, &given));
    model.body_force = BodyForce::Field(field(move |x, _| {
        let u: [f64; D] = velocity(x);
        let mut slope = [0.0; D];
        (slope[0], slope[D - 1]) = (-3.0, 5.0);
        std::array::from_fn(|i| (0..D).map(|j| gradient[i][j] * u[j]).sum::<f64>() + slope[i] / 1.2)
    }));
    let pin = PressurePin { node: 0, pressure: pressure(&mesh.points()[0]) };
    let settings = FluidSettings { pressure_pin: Some(pin), ..settings(TimeScheme::Steady) };
    let mut fluid = FluidSolver::new(mesh.clone(), model, settings).expect("a fluid");
    fluid.begin_step(1.0, 1.0).expect("a step");
    exhaust(&mut fluid);
    for group in mesh.groups() {
        let expected = exact_force(mesh, &group.name, pressure, &gradient);
        assert_near(&group.name, fluid.force_on(&group.name).expect("a group"), expected, 1e-10);
    }
}

#[test]
fn the_force_of_a_linear_flow_is_exact_on_every_side_of_a_box() {
    linear_flow(&perturbed(&unit_square(4), 0.04, 1), [[0.7, 1.1], [0.4, -0.7]]);
    linear_flow(&perturbed(&unit_cube(3), 0.03, 2), [[0.7, 1.1, 0.3], [0.4, -0.2, 0.9], [-0.6, 0.8, -0.5]]);
}

/// A box of water at rest, turned by an angle, so that its slip walls are inclined.
fn turned_box(angle: f64, sides: &[(&str, BoundaryCondition<2>)]) -> FluidSolver<2> {
    let (sin, cos) = angle.sin_cos();
    let turn = |x: &[f64; 2]| [cos * x[0] - sin * x[1], sin * x[0] + cos * x[1]];
    let straight = perturbed(&unit_square(4), 0.04, 3);
    let mesh = straight.with_points(straight.points().iter().map(turn).collect()).expect("a turned mesh");
    let model = FluidModel { body_force: BodyForce::Constant(turn(&[0.0, -10.0])), ..model(boundary(sides)) };
    let mut fluid = FluidSolver::new(mesh, model, settings(BDF2)).expect("a fluid");
    for k in 1..3 {
        fluid.begin_step(0.1 * f64::from(k), 0.1).expect("a step");
        exhaust(&mut fluid);
        fluid.commit();
    }
    fluid
}

#[test]
fn water_at_rest_pushes_every_wall_along_its_normal() {
    let (wall, slip) = (BoundaryCondition::NoSlip, BoundaryCondition::Slip);
    let moving = BoundaryCondition::WallMotion(field(|_, _| [0.0; 2]));
    let inflow = BoundaryCondition::Velocity(field(|_, _| [0.0; 2]));
    let bottoms =
        [BoundaryCondition::Interface, BoundaryCondition::RigidInterface, wall.clone(), slip.clone()];
    for angle in [0.0, 0.6, 2.0] {
        for bottom in &bottoms {
            for left in [&wall, &slip, &moving, &inflow] {
                let right = if matches!(bottom, BoundaryCondition::Slip) { &slip } else { &wall };
                let sides = [
                    ("left", left.clone()),
                    ("right", right.clone()),
                    ("bottom", bottom.clone()),
                    ("top", OPEN),
                ];
                let fluid = turned_box(angle, &sides);
                let (sin, cos) = f64::sin_cos(angle);
                let depth = |x: &[f64; 2]| 12.0 * (1.0 - (cos * x[1] - sin * x[0]));
                for (group, condition) in &sides {
                    let expected = match *group {
                        "top" => [0.0; 2],
                        group => exact_force(fluid.mesh(), group, depth, &[[0.0; 2]; 2]),
                    };
                    let what = format!("{condition:?} {group} beside {left:?}, turned by {angle}");
                    assert_near(&what, fluid.force_on(group).expect("a group"), expected, 1e-9);
                }
                let mut load = vec![0.0; 2 * fluid.interface_nodes().len()];
                fluid.output(&mut load);
                for (node, force) in fluid.interface_nodes().iter().zip(load.chunks_exact(2)) {
                    let edges = fluid.mesh().group("bottom").expect("a group").facets.iter();
                    let share: f64 = edges
                        .filter(|edge| edge.nodes.contains(node))
                        .map(|edge| 0.5 * edge.area(fluid.mesh().points()))
                        .sum();
                    assert_near(
                        "load",
                        [force[0], force[1]],
                        [12.0 * share * sin, -12.0 * share * cos],
                        1e-9,
                    );
                }
            }
        }
    }
}

/// A flow in a box with inflow, outflow and two walls, in the middle of a step.
fn flow<const D: usize>(mesh: Mesh<D>, sides: &[(&str, BoundaryCondition<D>)]) -> FluidSolver<D> {
    let mut gravity = [0.0; D];
    gravity[1] = -3.0;
    let model = FluidModel { body_force: BodyForce::Constant(gravity), ..model(boundary(sides)) };
    let mut fluid = FluidSolver::new(mesh, model, settings(BDF1)).expect("a fluid");
    fluid.begin_step(0.1, 0.1).expect("a step");
    exhaust(&mut fluid);
    fluid
}

fn inflow<const D: usize>() -> BoundaryCondition<D> {
    BoundaryCondition::Velocity(field(|x: &[f64; D], _| {
        let mut u = [0.0; D];
        u[0] = 1.0 + x[1];
        u
    }))
}

fn forces_add_up<const D: usize>(mesh: &Mesh<D>, sides: &[(&str, BoundaryCondition<D>)]) {
    let fluid = flow(mesh.clone(), sides);
    let names: Vec<&str> = sides.iter().map(|(name, _)| *name).collect();
    let add = |x: [f64; D], y: [f64; D]| std::array::from_fn(|c| x[c] + y[c]);
    let on = |groups: &[&str]| fluid.force_on_all(groups).expect("groups");
    for (k, first) in names.iter().enumerate() {
        for second in &names[..k] {
            let apart = add(on(&[first]), on(&[second]));
            assert_near(&format!("{first} and {second}"), on(&[first, second]), apart, 1e-12);
        }
    }
    let held = sides.iter().filter(|(_, kind)| !matches!(kind, BoundaryCondition::StressFree { .. }));
    let mut nodes: Vec<usize> = held.flat_map(|(name, _)| mesh.group_nodes(name).expect("a group")).collect();
    nodes.sort_unstable();
    nodes.dedup();
    let mut total = [0.0_f64; D];
    for node in nodes {
        for c in 0..D {
            total[c] -= fluid.residual()[node * (D + 1) + c];
        }
    }
    assert!(total.iter().any(|x| x.abs() > 0.1), "{total:?}");
    assert_near("all", on(&names), total, 1e-12);
    let summed = names.iter().map(|name| on(&[name])).fold([0.0; D], add);
    assert_near("sum", summed, total, 1e-12);
    for (name, condition) in sides {
        match condition {
            BoundaryCondition::StressFree { .. } => assert_eq!(on(&[name]), [0.0; D], "{name}"),
            // Slip walls, all of them plane here, hold no force along them, at their corners either.
            BoundaryCondition::Slip => {
                let normal = mesh.group(name).expect("a group").facets[0].normal(mesh.points());
                let force = on(&[name]);
                let along: f64 = (0..D).map(|c| force[c] * normal[c]).sum();
                assert_near(name, force, normal.map(|n| along * n), 1e-8);
            }
            _ => {}
        }
    }
}

#[test]
fn forces_on_groups_add_up_to_the_reaction_of_all() {
    let (wall, slip) = (BoundaryCondition::NoSlip, BoundaryCondition::Slip);
    let skew = |x: &[f64; 2]| [x[0] + 0.4 * x[1], x[1] - 0.2 * x[0]];
    let straight = perturbed(&unit_square(5), 0.03, 6);
    let mesh = straight.with_points(straight.points().iter().map(skew).collect()).expect("a skewed mesh");
    for bottom in [&wall, &slip, &BoundaryCondition::Interface] {
        let sides = [("left", inflow()), ("right", OPEN), ("bottom", bottom.clone()), ("top", slip.clone())];
        forces_add_up(&mesh, &sides);
    }
    // Two and three slip walls that meet.
    forces_add_up(&mesh, &[("left", OPEN), ("right", slip.clone()), ("bottom", slip.clone()), ("top", slip)]);
}

#[test]
fn forces_on_three_groups_of_a_corner_add_up() {
    let (wall, slip) = (BoundaryCondition::NoSlip, BoundaryCondition::Slip);
    let skew = |x: &[f64; 3]| [x[0] + 0.3 * x[1], x[1] - 0.2 * x[0] + 0.1 * x[2], x[2] + 0.2 * x[1]];
    let straight = perturbed(&unit_cube(3), 0.02, 6);
    let mesh = straight.with_points(straight.points().iter().map(skew).collect()).expect("a skewed mesh");
    for (bottom, back) in
        [(&wall, &slip), (&slip, &slip), (&BoundaryCondition::Interface, &wall), (&slip, &wall)]
    {
        let sides = [
            ("left", inflow()),
            ("right", BoundaryCondition::StressFree { backflow: false }),
            ("bottom", bottom.clone()),
            ("top", slip.clone()),
            ("front", slip.clone()),
            ("back", back.clone()),
        ];
        forces_add_up(&mesh, &sides);
    }
}

#[test]
fn interfaces_that_meet_share_the_whole_residual_of_their_corner() {
    let sides = [
        ("left", BoundaryCondition::Interface),
        ("bottom", BoundaryCondition::RigidInterface),
        ("right", BoundaryCondition::NoSlip),
        ("top", OPEN),
    ];
    let fluid = flow(unit_square(4), &sides);
    let mut load = vec![0.0; 2 * fluid.interface_nodes().len()];
    fluid.output(&mut load);
    let mut ends = 0;
    for (node, load) in fluid.interface_nodes().iter().zip(load.chunks_exact(2)) {
        let whole = [-fluid.residual()[3 * node], -fluid.residual()[3 * node + 1]];
        let is_end = fluid.mesh().points()[*node] == [1.0, 0.0];
        assert_eq!(load == whole, !is_end, "node {node}: {load:?} and {whole:?}");
        ends += usize::from(is_end);
    }
    assert_eq!(ends, 1);
    let total = fluid.force_on_all(&["left", "bottom"]).expect("groups");
    let summed = |c: usize| load.iter().skip(c).step_by(2).sum::<f64>();
    assert_near("total", [summed(0), summed(1)], total, 1e-13);
}

/// One iterate after another: the parts belong to the assembly, not to what came after it.
#[test]
fn forces_are_those_of_the_last_assembly() {
    let sides = [
        ("left", BoundaryCondition::NoSlip),
        ("right", OPEN),
        ("bottom", BoundaryCondition::Interface),
        ("top", inflow()),
    ];
    let mut fluid = flow(unit_square(4), &sides);
    let before = ["left", "bottom", "top"].map(|group| fluid.force_on(group));
    let rise: Vec<f64> = fluid.interface_nodes().iter().flat_map(|_| [0.0, 0.01]).collect();
    fluid.impose(&rise).expect("a motion");
    assert_eq!(["left", "bottom", "top"].map(|group| fluid.force_on(group)), before);
    fluid.assemble(false).expect("an assembly");
    assert_ne!(["left", "bottom", "top"].map(|group| fluid.force_on(group)), before);
}

#[test]
fn a_gentle_bend_between_slip_walls_holds_its_normal() {
    // Two slip groups in the bottom of a channel with a bend of 20 degrees: one normal at the node between them.
    let straight = rectangle(&RectangleMesh {
        origin: [0.0; 2],
        size: [2.0, 1.0],
        divisions: [8, 4],
        pattern: Diagonal::Crossed,
    })
    .expect("a channel");
    let bend = |x: &[f64; 2]| [x[0], x[1] + 0.36 * (x[0] - 1.0).max(0.0) * (1.0 - x[1])];
    let points: Vec<[f64; 2]> = straight.points().iter().map(bend).collect();
    let mut groups = Vec::new();
    for group in straight.groups() {
        let facets = |keep: &dyn Fn(f64) -> bool| -> Vec<[usize; 2]> {
            let at = |nodes: &[usize; 2]| 0.5 * (points[nodes[0]][0] + points[nodes[1]][0]);
            group.facets.iter().map(|facet| facet.nodes).filter(|nodes| keep(at(nodes))).collect()
        };
        if group.name == "bottom" {
            groups.push(("level".to_owned(), facets(&|x| x < 1.0)));
            groups.push(("slope".to_owned(), facets(&|x| x > 1.0)));
        } else {
            groups.push((group.name.clone(), facets(&|_| true)));
        }
    }
    let mesh = Mesh::new(points.clone(), straight.cells().clone(), groups).expect("a bent channel");
    let slip = BoundaryCondition::Slip;
    // A constant pressure: that of a heavy fluid varies over the facets at the bend, and pushes it along.
    let pressed = BoundaryCondition::Traction(field(|_, _| [0.0, -7.0]));
    let sides = [
        ("left", slip.clone()),
        ("right", slip.clone()),
        ("level", slip.clone()),
        ("slope", slip),
        ("top", pressed),
    ];
    let mut fluid = FluidSolver::new(mesh, model(boundary(&sides)), settings(BDF1)).expect("a fluid");
    fluid.begin_step(0.1, 0.1).expect("a step");
    exhaust(&mut fluid);
    for group in ["left", "right", "level", "slope"] {
        let expected = exact_force(fluid.mesh(), group, |_| 7.0, &[[0.0; 2]; 2]);
        assert_near(group, fluid.force_on(group).expect("a group"), expected, 1e-9);
    }
    assert_eq!(fluid.force_on("top"), Some([0.0; 2]));
}
