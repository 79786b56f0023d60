//! `--set key.path=value`.

use partita::scene::parse;
use partita::scene::schema::{
    Acceleration, Condition, Convergence, NewtonPolicy, Predictor, Relaxation, Scene,
};

use super::SOUND;

fn with(overrides: &[&str]) -> Scene {
    let overrides: Vec<String> = overrides.iter().map(ToString::to_string).collect();
    parse("sound.toml", SOUND, &overrides).unwrap_or_else(|error| panic!("{overrides:?}: {error}"))
}

#[test]
fn an_override_replaces_a_value_and_the_last_one_wins() {
    let scene = with(&["time.steps=3", "fluid.density=1.5", "time.steps = 7", "title=Another tank"]);
    assert_eq!(scene.time.steps.get(), 7);
    assert_eq!(scene.fluid.unwrap().density.get().to_bits(), 1.5f64.to_bits());
    assert_eq!(scene.title, "Another tank");
}

#[test]
fn an_override_sets_what_the_file_leaves_out() {
    let scene = with(&["coupling.predictor=cubic", "coupling.newton.fixed.fluid=1", "output.fields_every=0"]);
    let coupling = scene.coupling.unwrap();
    assert_eq!(coupling.predictor, Predictor::Cubic);
    let NewtonPolicy::Fixed { fluid, structure } = coupling.newton else { panic!("{:?}", coupling.newton) };
    assert_eq!((fluid.get(), structure.get()), (Some(1), None));
    assert_eq!(scene.output.fields_every, 0);
}

#[test]
fn an_override_of_a_choice_takes_its_place() {
    let scene = with(&[
        "coupling.acceleration.constant.relaxation=0.5",
        "coupling.convergence=entry_residuals",
        "fluid.boundary.left.velocity=[\"4*y*(1 - y)\", 0]",
        "fluid.newton.tolerance.absolute=1e-8",
    ]);
    let coupling = scene.coupling.unwrap();
    assert_eq!(coupling.acceleration, Some(Acceleration::Constant { relaxation: relaxation(0.5) }));
    assert_eq!(coupling.convergence, Convergence::EntryResiduals);
    let fluid = scene.fluid.unwrap();
    let Condition::Velocity(inflow) = &fluid.boundary["left"] else { panic!("{:?}", fluid.boundary) };
    assert_eq!(inflow.value(&[0.0, 0.5], 0.0).map(f64::to_bits), [1.0, 0.0].map(f64::to_bits));
}

#[test]
fn a_bare_word_names_a_choice_with_its_defaults() {
    let acceleration = |overrides: &[&str]| with(overrides).coupling.unwrap().acceleration;
    assert_eq!(
        acceleration(&["coupling.acceleration=aitken"]),
        Some(Acceleration::Aitken { initial_relaxation: relaxation(0.1) })
    );
    assert_eq!(
        acceleration(&[
            "coupling.acceleration=aitken",
            "coupling.acceleration.aitken.initial_relaxation=0.3"
        ]),
        Some(Acceleration::Aitken { initial_relaxation: relaxation(0.3) })
    );
}

fn relaxation(factor: f64) -> Relaxation {
    Relaxation::new(factor).unwrap()
}
