//! What the prescribed velocities let in, on the mesh and by their formulas.

use partita_fluid::FluidSolver;
use partita_mesh::Facet;
use partita_numerics::gauss;

use partita_scene::schema::{Condition, Scene, VectorFormula};

/// Points on an edge at which a formula is evaluated.
const POINTS: usize = 5;
/// Times of the scene at which the largest flow is looked for.
const TIMES: usize = 200;
/// A flow below this part of what the speed along the boundary could carry is round-off.
const ROUND_OFF: f64 = 1e-12;

/// The flow through one boundary group with a prescribed velocity, on the mesh before it moves.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Inflow {
    /// The group.
    pub(super) group: String,
    /// The time at which the formula lets most fluid pass \[s\].
    pub(super) time: f64,
    /// What the nodes of the mesh let in, neighbouring conditions included \[m2/s\].
    pub(super) discrete: f64,
    /// What the formula lets in \[m2/s\].
    pub(super) exact: f64,
}

/// All of them, by the names of the groups.
pub(super) fn all(scene: &Scene, fluid: &FluidSolver<2>) -> Vec<Inflow> {
    let Some(of_scene) = &scene.fluid else { return Vec::new() };
    let velocities = of_scene.boundary.iter().filter_map(|(group, condition)| match condition {
        Condition::Velocity(formula) => Some((group, formula)),
        _ => None,
    });
    velocities.filter_map(|(group, formula)| inflow(scene, fluid, group, formula)).collect()
}

fn inflow(scene: &Scene, fluid: &FluidSolver<2>, group: &str, formula: &VectorFormula) -> Option<Inflow> {
    let mesh = fluid.mesh();
    let facets = &mesh.group(group)?.facets;
    let flow = |time| flow(formula, facets, mesh.points(), time);
    let (time, [exact, gross]) = times(scene).map(|time| (time, flow(time))).reduce(larger)?;
    let discrete = -fluid.prescribed_flow_rate(group, time)?;
    let clean = |value: f64| if value.abs() <= ROUND_OFF * gross { 0.0 } else { value };
    Some(Inflow { group: group.to_owned(), time, discrete: clean(discrete), exact: clean(-exact) })
}

/// The later of two times only where more passes then; a flow that is no number never counts as more.
fn larger(first: (f64, [f64; 2]), second: (f64, [f64; 2])) -> (f64, [f64; 2]) {
    let size = |(_, [flow, _]): &(f64, [f64; 2])| if flow.is_nan() { -1.0 } else { flow.abs() };
    if size(&second) > size(&first) * (1.0 + 1e-9) { second } else { first }
}

/// The last time of the scene, then others between, evenly spaced in steps.
fn times(scene: &Scene) -> impl Iterator<Item = f64> {
    let (step, steps) = (scene.time.step.get(), scene.time.steps.get());
    let stride = steps.div_ceil(TIMES);
    let between = (1..steps).step_by(stride);
    std::iter::once(steps).chain(between).map(move |n| n as f64 * step)
}

/// Outward flow of a formula, and the integral of its speed \[m2/s\].
fn flow(formula: &VectorFormula, facets: &[Facet<2>], points: &[[f64; 2]], time: f64) -> [f64; 2] {
    let rule = gauss::line(POINTS);
    let mut sums = [0.0; 2];
    for facet in facets {
        let [a, b] = facet.nodes.map(|node| points[node]);
        let (normal, length) = (facet.area_vector(points), facet.area(points));
        for &(s, weight) in &rule {
            let [u, v] = formula.value(&[0, 1].map(|i| (1.0 - s) * a[i] + s * b[i]), time);
            sums[0] += weight * (u * normal[0] + v * normal[1]);
            sums[1] += weight * u.hypot(v) * length;
        }
    }
    sums
}
