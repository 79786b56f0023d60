//! What is measured in a cell beside its iterations.

use partita_fluid::FluidSolver;
use partita_mesh::Mesh;
use partita_numerics::Field;
use partita_structure::StructureSolver;

use partita::build::FieldMarch;

/// Kinetic energy of the fluid, kinetic and strain energy of the structure \[J, in 2D J/m\].
pub(crate) fn energy(run: &FieldMarch) -> f64 {
    let fluid = run.first().field().map_or(0.0, FluidSolver::kinetic_energy);
    let structure =
        run.second().field().map_or(0.0, |structure| structure.kinetic_energy() + structure.strain_energy());
    fluid + structure
}

/// Largest displacement of a control point or node of the structure \[m\].
pub(crate) fn largest_displacement(structure: &StructureSolver<2>) -> f64 {
    structure.values().chunks_exact(2).map(|d| d[0].hypot(d[1])).fold(0.0, f64::max)
}

/// Largest of the last half over the largest of the first half; 0/0 = 1. Nothing of fewer than four.
///
/// A body that starts to fall has an energy like t^2 and grows by 4; what a scheme adds by itself grows by a factor every
/// few steps, without end.
pub(crate) fn growth(energies: &[f64]) -> Option<f64> {
    let (first, last) = energies.split_at(energies.len() / 2);
    let most = |energies: &[f64]| energies.iter().copied().fold(0.0, f64::max);
    match (most(first), most(last)) {
        _ if energies.len() < 4 => None,
        (0.0, 0.0) => Some(1.0),
        (first, last) => Some(last / first),
    }
}

/// Node-to-node oscillation of the pressure at the nodes inside the mesh:
///
/// ```text
/// sqrt( sum_i (p_i - mean of p over the neighbours of i)^2 / sum_i (p_i - mean of p)^2 ),   0/0 = 0
/// ```
///
/// Zero for a pressure that is linear on a regular mesh, small for a smooth one, and 2 for a checkerboard.
pub(crate) fn pressure_oscillation(fluid: &FluidSolver<2>) -> f64 {
    let pressures: Vec<f64> = fluid.values().chunks_exact(3).map(|node| node[2]).collect();
    oscillation(fluid.mesh(), &pressures)
}

fn oscillation(mesh: &Mesh<2>, values: &[f64]) -> f64 {
    let mut sums = vec![0.0; values.len()];
    let mut counts = vec![0_u32; values.len()];
    for nodes in mesh.cells() {
        for (&a, &b) in nodes.iter().flat_map(|a| nodes.iter().map(move |b| (a, b))).filter(|(a, b)| a != b) {
            // An edge inside the mesh belongs to two cells, so that both ends are counted twice.
            sums[a] += values[b];
            counts[a] += 1;
        }
    }
    let mut inside = vec![true; values.len()];
    for group in mesh.groups() {
        for node in mesh.group_nodes(&group.name).unwrap_or_default() {
            inside[node] = false;
        }
    }
    let nodes = || (0..values.len()).filter(|&node| inside[node]);
    let mean = nodes().map(|node| values[node]).sum::<f64>() / nodes().count().max(1) as f64;
    let rough: f64 = nodes().map(|node| (values[node] - sums[node] / f64::from(counts[node])).powi(2)).sum();
    let whole: f64 = nodes().map(|node| (values[node] - mean).powi(2)).sum();
    if whole == 0.0 { 0.0 } else { (rough / whole).sqrt() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use partita_mesh::generate::{Diagonal, RectangleMesh, rectangle};

    #[test]
    fn energy_that_a_fall_gains_grows_by_four_and_an_instability_without_measure() {
        let fall: Vec<f64> = (1..=30).map(|n| f64::from(n * n)).collect();
        assert_eq!(growth(&fall), Some(4.0));
        let unstable: Vec<f64> = (1..=30).map(|n| 2_f64.powi(n)).collect();
        assert_eq!(growth(&unstable), Some(2_f64.powi(15)));
        assert_eq!((growth(&[0.0; 8]), growth(&[1.0; 3])), (Some(1.0), None));
    }

    #[test]
    fn a_checkerboard_oscillates_and_a_linear_pressure_does_not() {
        let mesh = rectangle(&RectangleMesh {
            origin: [0.0; 2],
            size: [1.0; 2],
            divisions: [8, 8],
            pattern: Diagonal::Crossed,
        })
        .unwrap();
        let values = |value: &dyn Fn(&[f64; 2]) -> f64| mesh.points().iter().map(value).collect::<Vec<_>>();
        let linear = oscillation(&mesh, &values(&|x| 3.0 + 2.0 * x[0] - x[1]));
        assert!(linear < 1e-12, "{linear}");
        let smooth = oscillation(&mesh, &values(&|x| (3.0 * x[0]).sin() * (2.0 * x[1]).cos()));
        assert!(smooth < 0.05, "{smooth}");
        // Corners of the squares against their centres.
        let corner = |x: &[f64; 2]| (8.0 * x[0]).fract() < 0.1 || (8.0 * x[0]).fract() > 0.9;
        let board = oscillation(&mesh, &values(&|x| if corner(x) { 1.0 } else { -1.0 }));
        assert!(board > 1.0, "{board}");
    }
}
