//! Loads on the nodes of a mesh become loads on the control points of a curved patch, at any two resolutions.
//!
//! Run with `cargo run -p partita-iga --example transfer`.

use partita_iga::{Side, build, transfer};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!(
        "{:>8}  {:>5}  {:>12}  {:>12}  {:>12}",
        "elements", "nodes", "force error", "moment error", "work error"
    );
    for (elements, nodes) in [(1, 50), (4, 9), (20, 21), (50, 4)] {
        let patch = build::quarter_annulus(1.0, 1.2)?.subdivide(1, elements)?;
        let (wetted, _) = patch.side(Side::RIGHT);
        let positions: Vec<_> =
            (0..nodes).map(|i| wetted.point(&[f64::from(i) / f64::from(nodes - 1)])).collect();
        let loads: Vec<_> = positions.iter().map(|[x, y]| [x * x, 0.3 - y]).collect();

        // H, and F = H^T f.
        let rows = transfer::rows(&patch, &[Side::RIGHT], &positions, 1e-9)?;
        let mut forces = vec![[0.0; 2]; patch.control_points().len()];
        transfer::add_to_control_points(&rows, &loads, &mut forces);

        // A displacement of the patch, and d = H D.
        let displacement: Vec<_> = patch.control_points().iter().map(|[x, y]| [0.1 * y * y, x - y]).collect();
        let mut at_nodes = vec![[0.0; 2]; positions.len()];
        transfer::to_points(&rows, &displacement, &mut at_nodes);

        let force = (0..2).map(|c| (sum(&loads, c) - sum(&forces, c)).abs()).fold(0.0, f64::max);
        let moment = (moment(&positions, &loads) - moment(patch.control_points(), &forces)).abs();
        let work = (dot(&loads, &at_nodes) - dot(&forces, &displacement)).abs();
        println!("{elements:>8}  {nodes:>5}  {force:>12.1e}  {moment:>12.1e}  {work:>12.1e}");
    }
    Ok(())
}

fn sum(vectors: &[[f64; 2]], component: usize) -> f64 {
    vectors.iter().map(|vector| vector[component]).sum()
}

fn dot(a: &[[f64; 2]], b: &[[f64; 2]]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a[0] * b[0] + a[1] * b[1]).sum()
}

fn moment(positions: &[[f64; 2]], forces: &[[f64; 2]]) -> f64 {
    positions.iter().zip(forces).map(|(x, f)| x[0] * f[1] - x[1] * f[0]).sum()
}
