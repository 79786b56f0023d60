//! The search space of `paper/inference.md`.

use std::path::Path;

use crate::reproduce::case::Case;
use crate::stretch;
use crate::task::TaskError;

/// One value of something that is searched.
#[derive(Debug, Clone)]
pub(crate) struct Choice {
    /// As the results call it.
    pub(crate) label: String,
    /// Keys of the scene.
    pub(crate) keys: Vec<String>,
}

impl Choice {
    fn new(label: impl Into<String>, keys: &[&str]) -> Self {
        Self { label: label.into(), keys: keys.iter().map(|&key| key.to_owned()).collect() }
    }
}

/// A point of the search space.
#[derive(Debug, Clone)]
pub(crate) struct Configuration {
    case: Case,
    choices: Vec<Choice>,
}

impl Configuration {
    /// The scene as it was when the search was written down. It stays the start of the search, whatever the scene takes
    /// over from it.
    pub(crate) fn start(case: Case) -> Self {
        Self { case, choices: Vec::new() }
    }

    pub(crate) fn label(&self) -> String {
        self.choices.iter().map(|choice| choice.label.as_str()).collect::<Vec<_>>().join("; ")
    }

    pub(crate) fn keys(&self) -> Vec<String> {
        let start = start_keys(self.case).into_iter().map(str::to_owned);
        start.chain(self.choices.iter().flat_map(|choice| choice.keys.clone())).collect()
    }

    pub(crate) fn with(&self, choice: &Choice) -> Self {
        let mut choices = self.choices.clone();
        choices.push(choice.clone());
        Self { case: self.case, choices }
    }
}

/// What the scene has taken over from the search since, as it was before. A later key replaces an earlier one.
fn start_keys(case: Case) -> Vec<&'static str> {
    match case {
        Case::Tank => Vec::new(),
        Case::Beam => vec![
            "structure.material.saint_venant_kirchhoff.young_modulus=2.8e7",
            "fluid.boundary.inflow={ velocity = [\"2.5*y*(4 - y)\", 0] }",
            "fluid.newton.tolerance.absolute=3e-7",
            "structure.newton.tolerance.absolute=3e-7",
        ],
    }
}

/// The bottom of the tank or the beam with this thickness \[m\]; meshes go to `folder`.
pub(crate) fn thickness(root: &Path, folder: &Path, case: Case, value: f64) -> Result<Choice, TaskError> {
    let key = |name: &str, [x, y]: [f64; 2]| format!("structure.geometry.rectangle.{name}=[{x:.3},{y:.3}]");
    let keys = match case {
        Case::Tank => vec![key("origin", [0.0, -value]), key("size", [1.0, value])],
        Case::Beam => {
            let mesh = stretch::channel(root, folder, value)?;
            vec![
                key("origin", [3.0 - value / 2.0, 0.0]),
                key("size", [value, 1.0]),
                format!("fluid.mesh.gmsh.file=\"{}\"", mesh.display()),
            ]
        }
    };
    Ok(Choice { label: format!("h {value}"), keys })
}

pub(crate) fn young(value: f64) -> Choice {
    let key = format!("structure.material.saint_venant_kirchhoff.young_modulus={value:e}");
    Choice { label: format!("E {value:e}"), keys: vec![key] }
}

pub(crate) fn viscosity(value: f64) -> Choice {
    Choice { label: format!("mu {value}"), keys: vec![format!("fluid.viscosity={value:?}")] }
}

/// All combinations of one choice of each factor.
fn product(case: Case, factors: &[Vec<Choice>]) -> Vec<Configuration> {
    let start = vec![Configuration::start(case)];
    factors.iter().fold(start, |configurations, factor| {
        configurations.iter().flat_map(|old| factor.iter().map(|choice| old.with(choice))).collect()
    })
}

/// An inflow of the beam's channel that rises linearly over so many seconds.
fn rising_inflow(seconds: f64) -> Choice {
    let profile = format!("2.5*y*(4 - y)*min(t/{seconds}, 1)");
    let key = format!("fluid.boundary.inflow={{ velocity = [\"{profile}\", 0] }}");
    Choice { label: format!("inflow rising {seconds} s"), keys: vec![key] }
}

/// The third stage, for the beam alone.
pub(crate) fn refined(case: Case) -> Vec<Configuration> {
    let bound = |field: &str, value: f64| {
        let key = format!("{field}.newton.tolerance.absolute={value:e}");
        Choice { label: format!("{field} bound {value:e}"), keys: vec![key] }
    };
    match case {
        Case::Tank => Vec::new(),
        Case::Beam => product(
            case,
            &[
                [2.0e7, 2.4e7, 2.8e7].map(young).to_vec(),
                [0.05, 0.1].map(rising_inflow).to_vec(),
                [3e-7, 6e-7, 1.5e-6].map(|value| bound("structure", value)).to_vec(),
                [1e-7, 3e-7].map(|value| bound("fluid", value)).to_vec(),
            ],
        ),
    }
}

/// The grid of the first stage.
pub(crate) fn grid(root: &Path, folder: &Path, case: Case) -> Result<Vec<Configuration>, TaskError> {
    let thick = |values: [f64; 3]| -> Result<Vec<Choice>, TaskError> {
        values.into_iter().map(|value| thickness(root, folder, case, value)).collect()
    };
    let factors: Vec<Vec<Choice>> = match case {
        Case::Tank => vec![
            thick([0.02, 0.05, 0.1])?,
            [1e6, 2.5e6, 5e6, 1e7].map(young).to_vec(),
            [100.0, 200.0, 400.0].map(viscosity).to_vec(),
        ],
        Case::Beam => vec![
            thick([0.05, 0.06, 0.08])?,
            [1.4e7, 2.8e7, 5.6e7].map(young).to_vec(),
            [0.5, 1.0].map(viscosity).to_vec(),
            vec![Choice::new("full inflow", &[]), rising_inflow(0.1)],
        ],
    };
    Ok(product(case, &factors))
}

/// The variations of the second stage.
pub(crate) fn variations(case: Case) -> Vec<Choice> {
    let radius = |value: f64| {
        let key = format!("structure.time_scheme.generalized_alpha.spectral_radius={value:?}");
        Choice { label: format!("spectral radius {value}"), keys: vec![key] }
    };
    let bounds = |fluid: f64, structure: f64| {
        let key = |field: &str, value: f64| format!("{field}.newton.tolerance.absolute={value:e}");
        Choice {
            label: format!("bounds {fluid:e}, {structure:e}"),
            keys: vec![key("fluid", fluid), key("structure", structure)],
        }
    };
    let imvls =
        |label: &str, key: &str| Choice::new(label, &[&format!("coupling.acceleration.iqn_imvls.{key}")]);
    let mut choices = vec![
        Choice::new("tangent frozen_tau", &["fluid.tangent=frozen_tau"]),
        Choice::new("tangent full", &["fluid.tangent=full"]),
        Choice::new("fluid checks before", &["fluid.newton.check=before"]),
    ];
    let bound = match case {
        Case::Tank => 5e-9,
        Case::Beam => 3e-7,
    };
    choices.extend([
        bounds(bound / 5.0, bound / 5.0),
        bounds(bound * 5.0, bound * 5.0),
        bounds(bound, bound * 5.0),
        bounds(bound, bound * 25.0),
    ]);
    match case {
        Case::Tank => choices.extend([
            Choice::new("constant predictor", &["coupling.predictor=constant"]),
            radius(0.5),
            radius(0.8),
            imvls("history 1", "history_steps=1"),
            imvls("history 5", "history_steps=5"),
            imvls("filter 1e-2", "filter.qr3=1e-2"),
            imvls("first iteration with history", "relax_first_iteration=false"),
        ]),
        Case::Beam => choices.extend([
            Choice::new("linear predictor", &["coupling.predictor=linear"]),
            radius(0.0),
            radius(0.8),
            radius(1.0),
        ]),
    }
    choices
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::task::workspace_root;

    #[test]
    fn both_grids_have_thirty_six_points() {
        let folder = tempfile::tempdir().expect("a folder");
        for case in Case::ALL {
            let grid = grid(workspace_root(), folder.path(), case).expect("the scene's mesh is there");
            let mut labels: Vec<String> = grid.iter().map(Configuration::label).collect();
            labels.dedup();
            assert_eq!(labels.len(), 36);
        }
    }
}
