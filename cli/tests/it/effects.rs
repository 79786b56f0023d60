//! What runs costs, and what does not run costs nothing: counts of assemblies, factorizations and solves.
use partita_numerics::Field;

use std::path::Path;

use partita::build::{self, FieldMarch};
use partita::output::Totals;
use partita::plan::{Plan, Runs};
use partita::scene::schema::Condition;
use partita::scene::{self, Resolved, read_in};
use partita_coupling::record::StepRecord;
use partita_structure::StructureSolver;

fn tank(overrides: &[&str]) -> Resolved {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes/elastic-bottom");
    let overrides: Vec<String> = overrides.iter().map(|&given| given.to_owned()).collect();
    scene::load(&folder, &overrides).expect("the scene is sound")
}

/// The first steps of a scene.
fn steps(scene: &Resolved, count: usize) -> Vec<StepRecord> {
    let mut run = build::march(scene).expect("the scene builds");
    (0..count).map(|_| run.step(scene.scene.time.step.get(), &mut ()).expect("the step converges")).collect()
}

fn totals(steps: &[StepRecord]) -> Totals {
    let mut totals = Totals::default();
    for step in steps {
        totals.add(step);
    }
    totals
}

#[test]
fn the_work_of_each_field_is_counted() {
    let steps = steps(&tank(&[]), 3);
    let Totals { fluid, structure, coupling_iterations, .. } = totals(&steps);
    assert_eq!((fluid.calls, structure.calls), (coupling_iterations, coupling_iterations));
    for field in [fluid, structure] {
        assert_eq!((field.factorizations, field.solves), (field.newton, field.newton));
        assert_eq!(
            field.assemblies,
            field.newton + field.calls,
            "a residual at entry and one after each solve"
        );
        assert!((field.factorizations..=field.assemblies).contains(&field.details.tangents));
        assert_eq!(field.details.fallbacks, 0);
    }
    assert_eq!((fluid.details.mesh_factorizations, fluid.details.mesh_solves), (0, fluid.calls));
    assert_eq!((structure.details.mesh_factorizations, structure.details.mesh_solves), (0, 0));
}

#[test]
fn an_incremental_mesh_motion_is_factored_once_a_step() {
    let steps = steps(&tank(&["fluid.mesh_motion.mode=incremental"]), 2);
    assert!(steps.iter().all(|step| step.fields[0].details.mesh_factorizations == 1));
    assert!(steps.iter().all(|step| step.fields[0].details.mesh_solves == step.iterations));
}

/// Displacements of the interface after the last step.
fn after(scene: &Resolved, count: usize) -> (Vec<StepRecord>, Vec<f64>) {
    let mut run = build::march(scene).expect("the scene builds");
    let mut step = || run.step(scene.scene.time.step.get(), &mut ()).expect("the step converges");
    let steps = (0..count).map(|_| step()).collect();
    (steps, run.interface().x_tilde.clone())
}

/// |a - b| / |b|
fn distance(a: &[f64], b: &[f64]) -> f64 {
    let norm = |entries: &mut dyn Iterator<Item = f64>| entries.map(|x| x * x).sum::<f64>().sqrt();
    norm(&mut a.iter().zip(b).map(|(a, b)| a - b)) / norm(&mut b.iter().copied())
}

#[test]
fn reused_factors_are_fewer_and_lead_to_the_same_answer() {
    let tight = "coupling.convergence={changes=1e-8}";
    let (plain, expected) = after(&tank(&[tight]), 4);
    let reuse = ["fluid.newton.reuse_factor=0.5", "structure.newton.reuse_factor=0.5", tight];
    let (reused, found) = after(&tank(&reuse), 4);
    assert!(distance(&found, &expected) < 1e-7, "{:e}", distance(&found, &expected));
    let (plain, reused) = (totals(&plain), totals(&reused));
    for (plain, reused) in [(plain.fluid, reused.fluid), (plain.structure, reused.structure)] {
        assert!(4 * reused.factorizations < plain.factorizations, "{reused:?} for {plain:?}");
        assert_eq!(reused.solves, reused.newton);
        assert_eq!(reused.details.tangents, reused.factorizations);
        assert!(reused.newton > plain.newton, "linear convergence takes more of them");
    }
}

/// A channel with a hump in its inflow, 5 steps.
const CHANNEL: &str = r#"title = "Channel"

[time]
step = 0.1
steps = 5

[fluid]
density = 1.0
viscosity = 0.1
mesh = { rectangle = { size = [2.0, 1.0], divisions = [8, 4] } }

[fluid.boundary]
left = { velocity = ["y * (1 - y) * (1 + t)", "0"] }
right = "do_nothing"
top = "no_slip"
bottom = "no_slip"
"#;

fn channel(overrides: &[&str]) -> Resolved {
    let overrides: Vec<String> = overrides.iter().map(|&given| given.to_owned()).collect();
    read_in("".as_ref(), "scene.toml", CHANNEL, &overrides).expect("the scene is sound")
}

fn run_of(scene: &Resolved) -> FieldMarch {
    build::march(scene).expect("the scene builds")
}

const STOKES: &str = "fluid.convection=false";
const ONE_WAY: &str = "coupling.direction=one_way";
const LINEAR: &str = "structure.material={linear_elastic={young_modulus=5e6,poisson_ratio=0.3}}";

#[test]
fn a_stokes_flow_solves_once_a_step_and_factors_once() {
    for scheme in ["bdf1", "steady"] {
        let scheme = format!("fluid.time_scheme={scheme}");
        let steps = steps(&channel(&[STOKES, &scheme]), 5);
        let Totals { fluid, structure, .. } = totals(&steps);
        assert_eq!((fluid.solves, fluid.factorizations), (5, 1));
        assert_eq!((fluid.assemblies, fluid.details.tangents), (10, 1), "a residual before and after");
        assert_eq!((fluid.details.mesh_factorizations, fluid.details.mesh_solves), (0, 0));
        assert_eq!((structure.assemblies, structure.solves), (0, 0));
    }
    // The first step of BDF2 has other coefficients.
    let Totals { fluid, .. } = totals(&steps(&channel(&[STOKES, "fluid.time_scheme=bdf2"]), 5));
    assert_eq!((fluid.solves, fluid.factorizations), (5, 2));
    let Totals { fluid, .. } = totals(&steps(&channel(&[]), 5));
    assert!(fluid.factorizations == fluid.solves && fluid.solves > 10, "{fluid:?}");
}

#[test]
fn what_a_scene_leaves_out_is_not_built() {
    let rigid = run_of(&channel(&[]));
    assert!(rigid.second().field().is_none(), "no structure");
    assert!(rigid.first().field().is_some_and(|fluid| fluid.mesh_motion().is_none()), "no mesh motion");
    let one_way = run_of(&tank(&[ONE_WAY]));
    assert!(one_way.first().field().is_some_and(|fluid| fluid.mesh_motion().is_none()));
    assert!(one_way.interface().x.is_empty() && one_way.interface().displacement.is_empty());
    let two_way = run_of(&tank(&[]));
    assert!(two_way.first().field().is_some_and(|fluid| fluid.mesh_motion().is_some()));
    assert!(!two_way.interface().x.is_empty());
}

#[test]
fn a_stokes_flow_in_a_moving_domain_solves_and_factors_once_a_call() {
    let Totals { fluid, .. } = totals(&steps(&tank(&[STOKES, "fluid.newton={}"]), 3));
    assert_eq!((fluid.solves, fluid.factorizations), (fluid.newton, fluid.newton));
    assert!(fluid.newton <= fluid.calls, "a call that enters converged solves nothing: {fluid:?}");
    assert!(fluid.assemblies <= 2 * fluid.calls);
}

#[test]
fn a_linear_structure_factors_once_in_a_coupled_run() {
    let Totals { structure, .. } = totals(&steps(&tank(&[LINEAR, "structure.newton={}"]), 3));
    assert_eq!((structure.factorizations, structure.details.tangents), (1, 1));
    assert!(structure.solves <= structure.calls && structure.solves > 3);
}

#[test]
fn one_way_coupling_calls_each_field_once_a_step() {
    let scene = tank(&[ONE_WAY, STOKES, LINEAR, "fluid.newton={}", "structure.newton={}"]);
    let steps = steps(&scene, 4);
    assert!(steps.iter().all(|step| step.converged && step.iterations == 1));
    let Totals { fluid, structure, .. } = totals(&steps);
    assert_eq!((fluid.calls, structure.calls), (4, 4));
    assert_eq!((fluid.factorizations, structure.factorizations), (1, 1));
    assert_eq!(fluid.details.mesh_solves, 0);
    let nonlinear = totals(&self::steps(&tank(&[ONE_WAY]), 4));
    assert_eq!((nonlinear.fluid.calls, nonlinear.structure.calls), (4, 4));
}

#[test]
fn one_way_coupling_is_the_limit_of_a_stiff_structure() {
    let stiff = |overrides: &[&str]| {
        let stiff = "structure.material.saint_venant_kirchhoff.young_modulus=1e14";
        let tolerances =
            ["fluid.newton={tolerance={relative=1e-10}}", "structure.newton={tolerance={relative=1e-7}}"];
        let scene =
            tank(&[&[stiff, "structure.time_scheme=quasi_static"], &tolerances[..], overrides].concat());
        let mut run = run_of(&scene);
        for _ in 0..3 {
            run.step(scene.scene.time.step.get(), &mut ()).expect("the step converges");
        }
        run.second().field().expect("a structure").values().to_vec()
    };
    let (one_way, two_way) = (stiff(&[ONE_WAY]), stiff(&[]));
    assert!(distance(&one_way, &two_way) < 1e-5, "{:e}", distance(&one_way, &two_way));
    let yielding = |overrides: &[&str]| after(&tank(overrides), 3).1;
    assert!(yielding(&[ONE_WAY]).is_empty(), "nothing comes back");
}

#[test]
fn the_plan_says_what_runs() {
    let plan = |scene: &Resolved| Plan::of(&scene.scene);
    let tank_plan = plan(&tank(&[ONE_WAY, STOKES, LINEAR, "structure.time_scheme=quasi_static"]));
    insta::assert_snapshot!(tank_plan.table().to_plain(), @r"
    effect                    runs     why
    ------------------------  -------  -------------------------------------------------------------------------------
    fluid                     yes      [fluid]
    fluid inertia             yes      fluid.time_scheme is bdf1
    convection                no       fluid.convection is false: one solve a step, one factorization a run
    mesh motion               no       the interface stands still
    gravity on the fluid      yes      fluid.body_force is [0.0, -9.81]
    structure                 yes      [structure]
    structural inertia        no       structure.time_scheme is quasi_static: no mass matrix
    geometric nonlinearity    no       structure.material is linear_elastic: one solve a call, one factorization a run
    gravity on the structure  no       structure.body_force is zero
    coupling                  one way  coupling.direction is one_way: one call of each field a step, fluid first
    output of fields          yes      output.fields_every is 10
    checkpoints               yes      output.checkpoint_every is 10
    probes                    yes      load, middle
    ");
    let channel_plan = plan(&channel(&["output.fields_every=0"]));
    insta::assert_snapshot!(channel_plan.table().to_plain(), @r"
    effect                    runs  why
    ------------------------  ----  -----------------------------------------------------------------------
    fluid                     yes   [fluid]
    fluid inertia             yes   fluid.time_scheme is bdf1
    convection                yes   fluid.convection is true: a nonlinear system, solved by Newton's method
    mesh motion               no    no boundary moves
    gravity on the fluid      no    fluid.body_force is zero
    structure                 no    no [structure]: all walls are rigid, or move as the scene says
    structural inertia        no    no structure
    geometric nonlinearity    no    no structure
    gravity on the structure  no    no structure
    coupling                  no    a fluid alone
    output of fields          no    output.fields_every is 0
    checkpoints               yes   output.checkpoint_every is 10
    probes                    no    no output.probes
    ");
    assert_eq!(plan(&tank(&[])).runs("coupling"), Some(Runs::TwoWay));
    assert_eq!(plan(&tank(&[])).runs("mesh motion"), Some(Runs::Yes));
}

#[test]
fn the_rigid_beam_is_the_beam_without_its_structure() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes/beam-in-channel");
    let load = |name: &str| scene::load(&folder.join(name), &[]).expect("the shipped scene is sound").scene;
    let (rigid, beam) = (load("rigid.toml"), load("scene.toml"));
    let (of_rigid, of_beam) = (rigid.fluid.expect("a fluid"), beam.fluid.expect("a fluid"));
    assert_eq!(rigid.time, beam.time);
    assert_eq!((of_rigid.density, of_rigid.viscosity), (of_beam.density, of_beam.viscosity));
    assert_eq!(of_rigid.mesh, of_beam.mesh);
    for (group, condition) in &of_beam.boundary {
        let expected = if *condition == Condition::Interface { &Condition::NoSlip } else { condition };
        assert_eq!(&of_rigid.boundary[group], expected, "{group}");
    }
}

/// The plan is read off the scene, the run is built from it: they must not say different things.
#[test]
fn the_plan_agrees_with_what_is_built() {
    let scenes = [
        tank(&[]),
        tank(&[ONE_WAY]),
        tank(&[STOKES]),
        tank(&[LINEAR]),
        channel(&[]),
        channel(&[STOKES]),
        channel(&["fluid.boundary.top={wall_motion=[\"0.1 * t\", \"0\"]}"]),
    ];
    for scene in &scenes {
        let (plan, run) = (Plan::of(&scene.scene), run_of(scene));
        let runs = |name| plan.runs(name).expect(name) != Runs::No;
        let fluid = run.first().field().expect("each has a fluid");
        assert_eq!(runs("mesh motion"), fluid.mesh_motion().is_some());
        assert_eq!(runs("convection"), !fluid.is_linear());
        assert_eq!(runs("structure"), run.second().field().is_some());
        let linear = run.second().field().is_none_or(StructureSolver::is_linear);
        assert_eq!(runs("geometric nonlinearity"), !linear);
    }
}
