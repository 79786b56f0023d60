//! The benchmark scenes on their coarsest level: a few steps, and what their probes say.
//!
//! The numbers are ours, not the literature's: they say that nothing has changed. `cargo xtask benchmark` compares finer
//! levels with the literature.

use std::fmt::Write;
use std::fs;
use std::path::Path;

use insta::assert_snapshot;
use partita::output::Clock;
use partita::scene;
use partita::session::{Options, Session};

/// Last row of the scene's probes after so many steps, six digits each.
fn probes(name: &str, steps: usize, overrides: &[&str]) -> String {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes").join(name);
    let silent = ["output.fields_every=0", "output.checkpoint_every=0"];
    let overrides: Vec<String> = silent.iter().chain(overrides).map(|&given| given.to_owned()).collect();
    let resolved = scene::load(&folder, &overrides).expect("the shipped scene is sound");
    let dir = tempfile::tempdir().expect("a folder");
    let dir = dir.path().join("run");
    let options = Options { steps: Some(steps), ..Options::default() };
    let session = Session::start(&resolved, &dir, options, Clock::start()).expect("the scene builds");
    session.finish().expect("every step converges");
    let table = fs::read_to_string(dir.join("probes.csv")).expect("probes");
    let (head, last) = (table.lines().next().expect("a head"), table.lines().last().expect("a row"));
    let mut text = String::new();
    // In the first steps nothing moves yet, and the volume defect is round-off.
    for (column, cell) in
        head.split(',').zip(last.split(',')).filter(|(column, _)| !column.ends_with("defect"))
    {
        let value: f64 = cell.parse().expect("a number");
        writeln!(text, "{column} {value:.5e}").expect("a String takes any text");
    }
    text
}

#[test]
fn lid_driven_cavity() {
    assert_snapshot!(probes("lid-driven-cavity", 2, &[]), @r"
    step 2.00000e0
    time 4.00000e-1
    flow_kinetic_energy 5.42127e-3
    horizontal_smallest_velocity_x -8.51402e-2
    horizontal_largest_velocity_x 0.00000e0
    horizontal_smallest_velocity_y -8.15682e-2
    horizontal_largest_velocity_y 6.97572e-2
    vertical_smallest_velocity_x -8.24835e-2
    vertical_largest_velocity_x 4.00000e-1
    vertical_smallest_velocity_y 0.00000e0
    vertical_largest_velocity_y 2.46533e-2
    ");
}

#[test]
fn turek_hron_cfd1() {
    assert_snapshot!(probes("turek-hron-cfd1", 1, &[]), @r"
    step 1.00000e0
    time 1.00000e0
    body_force_x 1.45683e1
    body_force_y 9.31365e-1
    inflow_flow_rate -8.13223e-2
    outflow_flow_rate 8.13223e-2
    ");
}

#[test]
fn turek_hron_csm1() {
    assert_snapshot!(probes("turek-hron-csm1", 1, &[]), @r"
    step 1.00000e0
    time 1.00000e0
    tip_displacement_x -7.01274e-3
    tip_displacement_y -6.52230e-2
    ");
}

#[test]
fn turek_hron_csm3() {
    assert_snapshot!(probes("turek-hron-csm3", 5, &[]), @r"
    step 5.00000e0
    time 2.50000e-2
    flag_kinetic_energy 5.31563e-3
    flag_strain_energy 5.24192e-4
    tip_displacement_x -4.38737e-7
    tip_displacement_y -5.11784e-4
    ");
}

#[test]
fn turek_hron_fsi1() {
    assert_snapshot!(probes("turek-hron-fsi1", 1, &[]), @r"
    step 1.00000e0
    time 1.00000e0
    body_force_x 1.45694e1
    body_force_y 7.13224e-1
    inflow_flow_rate -8.13223e-2
    outflow_flow_rate 8.13223e-2
    tip_displacement_x 2.42395e-5
    tip_displacement_y 4.99177e-4
    ");
}

#[test]
fn turek_hron_cfd3() {
    assert_snapshot!(probes("turek-hron-cfd3", 3, &[]), @r"
    step 3.00000e0
    time 7.50000e-3
    body_force_x 5.26794e-1
    body_force_y -2.53329e-3
    inflow_flow_rate -2.80945e-5
    outflow_flow_rate 2.80945e-5
    ");
}

#[test]
fn turek_hron_fsi2() {
    assert_snapshot!(probes("turek-hron-fsi2", 3, &[]), @r"
    step 3.00000e0
    time 1.50000e-2
    body_force_x 5.48069e-1
    body_force_y -2.22759e-3
    interface_work 1.86631e-6
    mesh_smallest_ratio 9.99993e-1
    mesh_worst_shape 7.21023e-1
    tip_displacement_x -4.33163e-7
    tip_displacement_y -1.12788e-9
    ");
}

#[test]
fn turek_hron_fsi3() {
    assert_snapshot!(probes("turek-hron-fsi3", 3, &[]), @r"
    step 3.00000e0
    time 6.00000e-3
    body_force_x 4.34292e-1
    body_force_y -9.20712e-4
    interface_work 2.49844e-7
    mesh_smallest_ratio 9.99999e-1
    mesh_worst_shape 7.21023e-1
    tip_displacement_x -1.41473e-7
    tip_displacement_y -8.84715e-11
    ");
}
