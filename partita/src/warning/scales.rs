//! The sizes that a scene sets before anything is solved: velocities, pressures, lengths.

use partita_fluid::FluidSolver;
use partita_mesh::{Mesh, quality};

use crate::build::FieldMarch;
use partita_scene::Resolved;
use partita_scene::formulas::times;
use partita_scene::schema::{Condition, Fluid, Initial, VectorFormula};

/// What is known about a flow before it is solved.
pub(super) struct FlowScales {
    /// Largest prescribed velocity `[m/s]`, of boundaries, walls and the initial state.
    pub(super) velocity: f64,
    /// Largest pressure that gravity, traction and velocity make `[Pa]`.
    pub(super) pressure: f64,
    /// Smaller extent of the mesh `[m]`.
    pub(super) length: f64,
    /// Size of a cell of mean area: the leg of a right triangle `[m]`.
    pub(super) cell: f64,
}

impl FlowScales {
    /// `None` for a scene without a fluid.
    pub(super) fn of(resolved: &Resolved, run: &FieldMarch) -> Option<Self> {
        let (scene, solver) = (resolved.scene.fluid.as_ref()?, run.first().field()?);
        let times = times(&resolved.scene.time);
        Some(Self::of_fluid(scene, solver, &times))
    }

    fn of_fluid(scene: &Fluid, solver: &FluidSolver<2>, times: &[f64]) -> Self {
        let mesh = solver.mesh();
        let [width, height] = extents(mesh.points());
        let length = width.min(height);
        let velocity = velocity(scene, mesh, times);
        let (density, viscosity) = (scene.density.get(), scene.viscosity.get());
        let force = times.iter().map(|&time| {
            let [x, y] = largest(&scene.body_force, mesh.points(), time);
            density * (x * width + y * height)
        });
        let traction = scene.boundary.iter().filter_map(|(group, condition)| match condition {
            Condition::Traction(formula) => Some((group, formula)),
            _ => None,
        });
        let traction = traction.flat_map(|(group, formula)| {
            let points = points_of(mesh, group);
            times.iter().map(move |&time| size(largest(formula, &points, time))).collect::<Vec<_>>()
        });
        let cells = mesh.cells().len() as f64;
        let area = quality::summary(mesh.points(), mesh.cells()).total_measure;
        Self {
            velocity,
            pressure: most(force)
                + most(traction)
                + density * velocity * velocity
                + viscosity * velocity / length,
            length,
            cell: (2.0 * area / cells).sqrt(),
        }
    }
}

fn velocity(scene: &Fluid, mesh: &Mesh<2>, times: &[f64]) -> f64 {
    let initial = match &scene.initial {
        Initial::Rest => 0.0,
        Initial::Velocity(formula) => size(largest(formula, mesh.points(), 0.0)),
    };
    let prescribed = scene.boundary.iter().map(|(group, condition)| match condition {
        Condition::Velocity(formula) => {
            let points = points_of(mesh, group);
            most(times.iter().map(|&time| size(largest(formula, &points, time))))
        }
        Condition::WallMotion(formula) => most(speeds(formula, &points_of(mesh, group), times)),
        _ => 0.0,
    });
    most(prescribed).max(initial)
}

/// Largest speed of a moving wall `[m/s]` between each of the times and the one a step before, about.
pub(super) fn speeds(formula: &VectorFormula, points: &[[f64; 2]], times: &[f64]) -> Vec<f64> {
    let dt = times.first().copied().unwrap_or(1.0);
    let speed = |time: f64| {
        most(points.iter().map(|point| {
            let (now, before) = (formula.value(point, time), formula.value(point, time - dt));
            size([now[0] - before[0], now[1] - before[1]]) / dt
        }))
    };
    times.iter().map(|&time| speed(time)).collect()
}

/// Nodes of a boundary group `[m]`.
pub(super) fn points_of(mesh: &Mesh<2>, group: &str) -> Vec<[f64; 2]> {
    let nodes = mesh.group_nodes(group).unwrap_or_default();
    nodes.into_iter().map(|node| mesh.points()[node]).collect()
}

/// Largest finite size of each component over some points.
pub(super) fn largest(formula: &VectorFormula, points: &[[f64; 2]], time: f64) -> [f64; 2] {
    let one = [[0.0; 2]];
    let points = if formula.uses_position() { points } else { &one[..] };
    let mut most = [0.0_f64; 2];
    for point in points {
        let value = formula.value(point, time);
        for c in 0..2 {
            if value[c].is_finite() {
                most[c] = most[c].max(value[c].abs());
            }
        }
    }
    most
}

/// Length of a vector.
pub(super) fn size([x, y]: [f64; 2]) -> f64 {
    x.hypot(y)
}

/// Largest finite value, 0 of none.
pub(super) fn most(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().filter(|value| value.is_finite()).fold(0.0, f64::max)
}

/// Width and height of the bounding box `[m]`.
pub(super) fn extents(points: &[[f64; 2]]) -> [f64; 2] {
    [0, 1].map(|c| {
        let [low, high] = points.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], point| {
            [low.min(point[c]), high.max(point[c])]
        });
        high - low
    })
}
