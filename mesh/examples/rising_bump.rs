//! A square of triangles follows a bump that rises from its bottom, and is written for a viewer.
//!
//! ```text
//! cargo run -p partita-mesh --example rising_bump -- FOLDER
//! ```

use std::f64::consts::PI;
use std::path::PathBuf;

use partita_mesh::generate::{Diagonal, RectangleMesh, rectangle};
use partita_mesh::motion::prescribed_dofs;
use partita_mesh::quality::shape_quality;
use partita_mesh::vtu::{Array, PvdCollection, save_vtu};
use partita_mesh::{MeshMotion, MotionMode, MotionSettings, simplex};

const STEPS: u32 = 20;
const HEIGHT: f64 = 0.6;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = PathBuf::from(std::env::args().nth(1).ok_or("usage: rising_bump FOLDER")?);
    let mesh = rectangle(&RectangleMesh {
        origin: [0.0, 0.0],
        size: [1.0, 1.0],
        divisions: [20, 20],
        pattern: Diagonal::Crossed,
    })?;
    let bottom = mesh.group_nodes("bottom").expect("every rectangle has a bottom");
    let prescribed = prescribed_dofs(&mesh, &["left", "right"])?;
    let settings = MotionSettings { mode: MotionMode::Incremental, ..MotionSettings::default() };
    let mut motion = MeshMotion::new(&mesh, settings, &prescribed)?;

    let mut committed = vec![0.0; 2 * mesh.points().len()];
    let mut trial = committed.clone();
    let mut collection = PvdCollection::create(&folder.join("bump.pvd"))?;
    for step in 1..=STEPS {
        let time = f64::from(step) / f64::from(STEPS);
        motion.begin_step(&committed)?;
        for &node in &bottom {
            trial[2 * node + 1] = HEIGHT * time * (PI * mesh.points()[node][0]).sin().powi(2);
        }
        motion.displace(&committed, &mut trial)?;
        let quality = motion.check(&trial)?;
        committed.copy_from_slice(&trial);
        println!("t = {time:.2} s: smallest quality {:.3}", quality.smallest_quality);

        let moved: Vec<[f64; 2]> = mesh
            .points()
            .iter()
            .zip(committed.chunks_exact(2))
            .map(|(point, displacement)| [point[0] + displacement[0], point[1] + displacement[1]])
            .collect();
        let shapes: Vec<f64> =
            mesh.cells().iter().map(|nodes| shape_quality(&simplex::vertices(&moved, nodes))).collect();
        let name = format!("bump-{step:04}.vtu");
        let displacement = Array { name: "displacement [m]", components: 2, values: &committed };
        let quality = Array { name: "quality", components: 1, values: &shapes };
        save_vtu(&folder.join(&name), &moved, mesh.cells(), &[displacement], &[quality])?;
        collection.push(time, &name)?;
    }
    Ok(())
}
