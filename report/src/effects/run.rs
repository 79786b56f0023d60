//! The runs behind the rows.

use partita::output::Summary;
use partita::plan::{Plan, Runs as How};
use partita::scene::schema::Scene;

use super::family::{self, Member, WHOLE};
use super::row::Row;
use crate::run::{Run, solving};
use crate::runs::Runs;
use crate::task::TaskError;

/// The effects of physics among those of `partita plan`, in the order of the page.
const PHYSICS: [&str; 8] = [
    "fluid",
    "fluid inertia",
    "convection",
    "mesh motion",
    "structure",
    "structural inertia",
    "geometric nonlinearity",
    "coupling",
];

/// A finished run.
struct Outcome {
    effects: String,
    summary: Summary,
    /// Displacement of the tip at every step; zero where the beam is rigid.
    tip: Vec<[f64; 2]>,
    load: Vec<[f64; 2]>,
}

/// Runs all members, one after the other so that each has the machine to itself.
pub(super) fn family(runs: &Runs) -> Result<Vec<Row>, TaskError> {
    let members = family::all();
    let outcomes = members.iter().map(|member| outcome(runs, member)).collect::<Result<Vec<_>, _>>()?;
    let whole = members.iter().position(|member| member.name == WHOLE).expect("it is a member");
    Ok(members
        .iter()
        .zip(&outcomes)
        .map(|(member, outcome)| row(member, outcome, &outcomes[whole]))
        .collect())
}

fn row(member: &Member, Outcome { effects, summary, tip, load }: &Outcome, whole: &Outcome) -> Row {
    let fields = [&summary.fluid, &summary.structure];
    Row {
        name: member.name.to_owned(),
        effects: effects.clone(),
        seconds_per_step: format!("{:.5}", solving(&summary.seconds) / summary.steps.max(1) as f64),
        factorizations: fields
            .iter()
            .map(|field| field.factorizations + field.details.mesh_factorizations)
            .sum(),
        assemblies: fields.iter().map(|field| field.assemblies).sum(),
        error: format!("{:.3e}", distance(tip, &whole.tip)),
        load_error: format!("{:.3e}", distance(load, &whole.load)),
    }
}

/// `max |a - b| / max |b|` over the steps.
fn distance(a: &[[f64; 2]], b: &[[f64; 2]]) -> f64 {
    let largest = |vectors: &mut dyn Iterator<Item = [f64; 2]>| {
        vectors.fold(0.0, |largest: f64, [x, y]| largest.max(x.hypot(y)))
    };
    let apart = largest(&mut a.iter().zip(b).map(|(a, b)| [a[0] - b[0], a[1] - b[1]]));
    apart / largest(&mut b.iter().copied())
}

fn outcome(runs: &Runs, member: &Member) -> Result<Outcome, TaskError> {
    eprintln!("{}", member.name);
    let run = Run::new(member.name, member.scene.file()).with(member.scene.settings()).with(member.set);
    let effects = effects(&run.resolved(&runs.root)?.scene);
    let outcome = runs.one(&run)?;
    let probes = outcome.probes()?;
    let load = probes.vectors(["load_force_x", "load_force_y"])?;
    // A rigid beam has no tip to ask for: it stays where it is.
    let tip = if probes.header().iter().any(|name| name == "tip_displacement_x") {
        probes.vectors(["tip_displacement_x", "tip_displacement_y"])?
    } else {
        vec![[0.0; 2]; load.len()]
    };
    Ok(Outcome { effects, summary: outcome.summary, tip, load })
}

/// The effects that run.
fn effects(scene: &Scene) -> String {
    let plan = Plan::of(scene);
    let running = |name: &&str| match plan.runs(name)? {
        How::No => None,
        How::Yes => Some((*name).to_owned()),
        how => Some(format!("{name} {how}")),
    };
    PHYSICS.iter().filter_map(running).collect::<Vec<_>>().join(" + ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::task::workspace_root;

    #[test]
    fn every_effect_of_the_page_is_one_that_a_scene_can_have() {
        let run = Run::new("whole", family::Scene::Elastic.file());
        let scene = run.resolved(workspace_root()).expect("the shipped scene").scene;
        let plan = Plan::of(&scene);
        assert!(PHYSICS.iter().all(|name| plan.runs(name).is_some()));
        assert_eq!(
            effects(&scene),
            "fluid + fluid inertia + convection + mesh motion + structure + structural inertia + geometric nonlinearity + coupling two way"
        );
    }

    #[test]
    fn distances_are_relative_to_the_largest() {
        let (a, b) = ([[0.0, 0.0], [3.0, 0.0]], [[0.0, 0.0], [3.0, 4.0]]);
        assert!((distance(&a, &b) - 0.8).abs() < 1e-15);
        assert!((distance(&[[0.0; 2]; 2], &b) - 1.0).abs() < 1e-15);
    }
}
