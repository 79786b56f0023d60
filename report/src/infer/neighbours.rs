//! The scenes' values, and values beside them.

use std::path::Path;

use crate::channel_mesh;
use crate::reproduce::case::Case;
use crate::task::TaskError;

/// Other values for some keys of a scene.
#[derive(Debug, Clone)]
pub(crate) struct Choice {
    /// As the results call it.
    pub(crate) label: String,
    /// Keys of the scene.
    pub(crate) keys: Vec<String>,
}

impl Choice {
    pub(crate) fn new(label: impl Into<String>, keys: &[&str]) -> Self {
        Self { label: label.into(), keys: keys.iter().map(|&key| key.to_owned()).collect() }
    }
}

/// The bottom of the tank or the beam with this thickness \[m\]; meshes go to `folder`.
pub(crate) fn thickness(root: &Path, folder: &Path, case: Case, value: f64) -> Result<Choice, TaskError> {
    let key = |name: &str, [x, y]: [f64; 2]| format!("structure.geometry.rectangle.{name}=[{x:.3},{y:.3}]");
    let keys = match case {
        Case::Tank => vec![key("origin", [0.0, -value]), key("size", [1.0, value])],
        Case::Beam => {
            let mesh = channel_mesh::with_beam(root, folder, value)?;
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

fn bound(field: &str, value: f64) -> Choice {
    let key = format!("{field}.newton.tolerance.absolute={value:e}");
    Choice { label: format!("{field} bound {value:e}"), keys: vec![key] }
}

fn radius(value: f64) -> Choice {
    let key = format!("structure.time_scheme.generalized_alpha.spectral_radius={value:?}");
    Choice { label: format!("spectral radius {value}"), keys: vec![key] }
}

fn peak(metres_per_second: f64) -> Choice {
    let factor = metres_per_second / 4.0;
    let profile = format!("{factor}*y*(4 - y)*min(t/0.1, 1)");
    let key = format!("fluid.boundary.inflow={{ velocity = [\"{profile}\", 0] }}");
    Choice { label: format!("peak {metres_per_second} m/s"), keys: vec![key] }
}

/// The scene, and scenes in which one thing is different.
pub(super) fn all(root: &Path, folder: &Path, case: Case) -> Result<Vec<Choice>, TaskError> {
    let thickness = |value: f64| thickness(root, folder, case, value);
    let mut choices = vec![Choice::new("the scene", &[])];
    match case {
        Case::Tank => {
            choices.extend([thickness(0.063)?, thickness(0.077)?]);
            choices.extend([1.62e6, 1.98e6].map(young));
            choices.extend([50.0, 200.0].map(viscosity));
            choices.extend([2.5e-9, 1e-8].map(|value| bound("fluid", value)));
            choices.extend([5e-9, 2e-8].map(|value| bound("structure", value)));
            choices.extend(tank_meshes());
            choices.extend([0.5, 0.8].map(radius));
            choices.extend(tank_couplings());
        }
        Case::Beam => {
            choices.extend([thickness(0.054)?, thickness(0.066)?]);
            choices.extend([1.98e7, 2.42e7].map(young));
            choices.extend([0.5, 2.0].map(viscosity));
            choices.extend([4.5, 5.5].map(peak));
            choices.extend([1.5e-8, 6e-8].map(|value| bound("fluid", value)));
            choices.extend([7.5e-7, 3e-6].map(|value| bound("structure", value)));
            choices.extend(beam_meshes());
            choices.extend([0.8, 1.0].map(radius));
            choices.push(Choice::new("linear predictor", &["coupling.predictor=linear"]));
        }
    }
    Ok(choices)
}

fn tank_meshes() -> [Choice; 5] {
    let slip = ["fluid.boundary.left=slip", "fluid.boundary.right=slip"];
    [
        Choice::new("fluid 8 x 8", &["fluid.mesh.rectangle.divisions=[8,8]"]),
        Choice::new("fluid 12 x 12", &["fluid.mesh.rectangle.divisions=[12,12]"]),
        Choice::new("structure 40 elements", &["structure.geometry.rectangle.elements=[40,1]"]),
        Choice::new("structure 80 elements", &["structure.geometry.rectangle.elements=[80,1]"]),
        Choice::new("slip walls", &slip),
    ]
}

fn tank_couplings() -> [Choice; 5] {
    let imvls = |label: &str, key: &str| {
        let key = format!("coupling.acceleration.iqn_imvls.{key}");
        Choice { label: label.to_owned(), keys: vec![key] }
    };
    [
        Choice::new("linear predictor", &["coupling.predictor=linear"]),
        imvls("first iteration relaxed", "relax_first_iteration=true"),
        imvls("filter 1e-1", "filter.qr3=1e-1"),
        imvls("history 1", "history_steps=1"),
        imvls("history 5", "history_steps=5"),
    ]
}

fn beam_meshes() -> [Choice; 3] {
    let slip = ["fluid.boundary.ceiling=slip", "fluid.boundary.floor=slip"];
    [
        Choice::new("structure 40 elements", &["structure.geometry.rectangle.elements=[1,40]"]),
        Choice::new("structure 80 elements", &["structure.geometry.rectangle.elements=[1,80]"]),
        Choice::new("slip walls", &slip),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::task::workspace_root;

    #[test]
    fn every_neighbour_differs_from_the_scene_and_from_the_others() {
        let folder = tempfile::tempdir().expect("a folder");
        for case in Case::ALL {
            let choices = all(workspace_root(), folder.path(), case).expect("the scene's mesh is there");
            assert!(choices[0].keys.is_empty() && choices[1..].iter().all(|choice| !choice.keys.is_empty()));
            let mut labels: Vec<&str> = choices.iter().map(|choice| choice.label.as_str()).collect();
            labels.sort_unstable();
            labels.dedup();
            assert_eq!(labels.len(), choices.len());
        }
    }
}
