//! The elastic flag of Turek and Hron (2006) under its own weight: CSM1 and CSM3, values of the Featflow pages.
use partita_numerics::Field;

use partita_iga::{Knots, Side, Spline, build};
use partita_mesh::gmsh::GmshFile;
use partita_numerics::newton::Bound;
use partita_structure::{BodyForce, Boundary, StructureModel, StructureSettings, StructureSolver};

use crate::common::{bare, dynamic, on_mesh, quasi_static, settle, solver, svk};

/// 0.35 m x 0.02 m behind a cylinder of radius 0.05 m at (0.2, 0.2): its left side is the arc of the cylinder, exactly.
///
/// knots `along` the flag, between 0 and 1; `rows` of elements across it.
fn flag(degree: usize, along: &[f64], rows: usize) -> Spline<2> {
    let half: f64 = (0.01_f64 / 0.05).asin();
    let arc = build::arc([0.2, 0.2], 0.05, -half, 2.0 * half).unwrap();
    let (mut points, mut weights) = (vec![], vec![]);
    for ((&point, &weight), y) in arc.control_points().iter().zip(arc.weights()).zip([0.19, 0.2, 0.21]) {
        points.extend([point, [0.6, y]]);
        weights.extend([weight; 2]);
    }
    let knots = vec![Knots::uniform(1, 1).unwrap(), Knots::uniform(2, 1).unwrap()];
    let patch = Spline::rational(knots, points, weights).unwrap();
    let patch = patch.elevate_degree(0, degree - 1).elevate_degree(1, degree - 2);
    patch.insert_knots(0, along).unwrap().subdivide(1, rows).unwrap()
}

fn under_gravity(patch: Spline<2>, settings: StructureSettings) -> StructureSolver<2> {
    solver(patch, heavy(Side::LEFT.into()), settings)
}

fn heavy(clamped: Boundary) -> StructureModel<2> {
    StructureModel {
        density: 1000.0,
        clamped,
        body_force: BodyForce::Constant([0.0, -2.0 * 1000.0]),
        ..bare(svk(1.4e6, 0.4))
    }
}

/// Displacement of the end of the flag [mm].
fn tip(solver: &StructureSolver<2>) -> [f64; 2] {
    solver.displacement_at(&[1.0, 0.5]).map(|d| 1e3 * d)
}

#[test]
fn csm1_static_deflection() {
    // Graded towards the clamp, where the stress is singular at both corners.
    let along = [0.002, 0.005, 0.01, 0.02, 0.04, 0.07, 0.1, 0.15, 0.2, 0.3, 0.4, 0.55, 0.7, 0.85];
    let mut solver = under_gravity(flag(3, &along, 6), quasi_static());
    settle(&mut solver);
    let [x, y] = tip(&solver);
    println!("CSM1: ({x:.4}, {y:.3}) mm, reference (-7.187, -66.10)");
    assert!((x / -7.187 - 1.0).abs() < 1e-3, "{x}");
    assert!((y / -66.10 - 1.0).abs() < 1e-3, "{y}");
}

#[test]
fn csm1_static_deflection_on_meshes_of_gmsh() {
    let triangles: &[u8] = include_bytes!("../data/flag-triangles.msh");
    let quadrilaterals: &[u8] = include_bytes!("../data/flag-quadrilaterals.msh");
    for file in [triangles, quadrilaterals] {
        let mesh = GmshFile::parse(file).unwrap().into_solid_mesh().unwrap();
        let kind = mesh.cells().kind;
        let mut solver = on_mesh(mesh, heavy("cylinder".into()), quasi_static());
        settle(&mut solver);
        let [x, y] = solver.displacement_at(&[0.6, 0.2]).map(|d| 1e3 * d);
        println!("CSM1, {kind:?}, {} unknowns: ({x:.4}, {y:.3}) mm", solver.parts()[0].dofs.len());
        assert!((x / -7.187 - 1.0).abs() < 2e-3, "{kind:?}: {x}");
        assert!((y / -66.10 - 1.0).abs() < 2e-3, "{kind:?}: {y}");
    }
}

#[test]
fn csm3_first_swing() {
    let mut settings = dynamic(1.0);
    settings.newton.bound = Bound::Relative(1e-8);
    let mut solver = under_gravity(flag(3, &[0.05, 0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 0.9], 2), settings);
    solver.start_from_equilibrium(0.0).unwrap();
    let dt = 0.01;
    let (mut lowest, mut previous, mut period) = ([0.0_f64; 2], 0.0, None);
    for step in 1..=105 {
        let time = dt * f64::from(step);
        solver.step_alone(time, dt).unwrap();
        let now = tip(&solver);
        (0..2).for_each(|i| lowest[i] = lowest[i].min(now[i]));
        // The velocity of the tip vanishes again at the top of the swing.
        let rate = solver.velocity_at(&[1.0, 0.5])[1];
        if previous > 0.0 && rate <= 0.0 && time > 0.6 {
            period.get_or_insert(time - dt * rate / (rate - previous));
        }
        previous = rate;
    }
    let period = period.expect("the flag swings back");
    println!("CSM3: lowest {lowest:.2?} mm, frequency {:.4} 1/s", 1.0 / period);
    // Reference: u_x = -14.305 +- 14.305, u_y = -63.607 +- 65.160 mm, 1.0995 1/s; higher modes ride on the swing.
    assert!((lowest[0] / -28.61 - 1.0).abs() < 0.02, "{lowest:?}");
    assert!((lowest[1] / -128.77 - 1.0).abs() < 0.01, "{lowest:?}");
    assert!((1.0 / period / 1.0995 - 1.0).abs() < 0.02, "{period}");
}
