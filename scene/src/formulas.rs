//! Formulas where a run will evaluate them: the first value that is not finite.

use partita_mesh::{Mesh, Place, simplex};
use partita_numerics::time::shown;

use super::schema::{Condition, Fluid, Initial, Probe, Scene, Time, VectorFormula};
use super::shapes::Shapes;
use crate::models;

/// Times between the first and the last step at which formulas are sampled.
const SAMPLES: usize = 40;

/// Times `[s]` of a run at which its formulas are looked at: the first three steps, the last one, and samples between, all on
/// the grid of its steps.
#[must_use]
pub fn times(time: &Time) -> Vec<f64> {
    let (steps, dt) = (time.steps.get(), time.step.get());
    let between = (1..SAMPLES).map(|k| k * (steps / SAMPLES));
    let mut indices: Vec<usize> = [1, 2, 3].into_iter().chain(between).chain([steps]).collect();
    indices.retain(|index| (1..=steps).contains(index));
    indices.sort_unstable();
    indices.dedup();
    indices.into_iter().map(|index| index as f64 * dt).collect()
}

/// A value that is not finite.
#[derive(Debug, Clone, PartialEq)]
pub struct Fault {
    /// The key of the formula.
    pub path: Vec<String>,
    /// What it is, where and when: `the velocity is inf at (0, 0) m, t = 0.1 s`.
    pub what: String,
}

/// A formula, and the points `[m]` where it is evaluated.
struct Use<'a> {
    path: Vec<String>,
    what: &'static str,
    formula: &'a VectorFormula,
    points: Vec<[f64; 2]>,
}

/// The first fault of each formula that a run evaluates at the end of its steps, at these times.
#[must_use]
pub fn faults(scene: &Scene, shapes: &Shapes, times: &[f64]) -> Vec<Fault> {
    let mut uses = Vec::new();
    if let (Some(fluid), Some(mesh)) = (&scene.fluid, &shapes.fluid) {
        of_fluid(fluid, mesh, scene.moves_the_interface(), &mut uses);
        of_probes(scene, mesh, &mut uses);
    }
    if let Some(structure) = &scene.structure {
        let path = vec!["structure".to_owned(), "body_force".to_owned()];
        uses.push(Use { path, what: "body force", formula: &structure.body_force, points: vec![[0.0; 2]] });
    }
    uses.iter().filter_map(|used| used.fault(times)).collect()
}

/// The fault of the initial velocity, which is evaluated at t = 0 alone.
pub fn initial_fault(scene: &Scene, shapes: &Shapes) -> Option<Fault> {
    let (fluid, mesh) = (scene.fluid.as_ref()?, shapes.fluid.as_ref()?);
    let Initial::Velocity(formula) = &fluid.initial else { return None };
    let path = ["fluid", "initial", "velocity"].map(str::to_owned).to_vec();
    Use { path, what: "initial velocity", formula, points: mesh.points().to_vec() }.fault(&[0.0])
}

fn of_fluid<'a>(fluid: &'a Fluid, mesh: &Mesh<2>, moves: bool, uses: &mut Vec<Use<'a>>) {
    let path = ["fluid", "body_force"].map(str::to_owned).to_vec();
    uses.push(Use { path, what: "body force", formula: &fluid.body_force, points: mesh.points().to_vec() });
    let holders = models::holders(fluid, mesh, moves);
    for (index, (group, condition)) in fluid.boundary.iter().enumerate() {
        let nodes = mesh.group_nodes(group).unwrap_or_default().into_iter();
        // A node between two groups belongs to the condition that wins there; a traction acts on whole edges.
        let held = |node: &usize| holders[*node] == Some(index);
        let (key, what, formula, nodes): (_, _, _, Vec<usize>) = match condition {
            Condition::Velocity(formula) => ("velocity", "velocity", formula, nodes.filter(held).collect()),
            Condition::WallMotion(formula) => {
                ("wall_motion", "displacement", formula, nodes.filter(held).collect())
            }
            Condition::Traction(formula) => ("traction", "traction", formula, nodes.collect()),
            _ => continue,
        };
        let path = ["fluid", "boundary", group, key].map(str::to_owned).to_vec();
        let points = nodes.into_iter().map(|node| mesh.points()[node]).collect();
        uses.push(Use { path, what, formula, points });
    }
}

/// Exact solutions are integrated; the centres of the cells stand for the points inside them.
fn of_probes<'a>(scene: &'a Scene, mesh: &Mesh<2>, uses: &mut Vec<Use<'a>>) {
    for (name, probe) in &scene.output.probes {
        let Probe::FluidError(known) = probe else { continue };
        let centre =
            |cell: &[usize]| simplex::centroid(&simplex::vertices(mesh.points(), cell)[..cell.len()]);
        let points: Vec<[f64; 2]> = mesh.cells().iter().map(centre).collect();
        let path = ["output", "probes", name, "fluid_error"].map(str::to_owned).to_vec();
        uses.push(Use { path, what: "exact velocity", formula: &known.velocity, points });
    }
}

impl Use<'_> {
    fn fault(&self, times: &[f64]) -> Option<Fault> {
        let one = self.points.get(..1).unwrap_or_default();
        let points = if self.formula.uses_position() { &self.points[..] } else { one };
        times.iter().find_map(|&time| {
            points.iter().find_map(|point| {
                let value = self.formula.value(point, time);
                let value = value.into_iter().find(|component| !component.is_finite())?;
                let what =
                    format!("the {} is {value} at {}, t = {} s", self.what, Place::from(*point), shown(time));
                Some(Fault { path: self.path.clone(), what })
            })
        })
    }
}
