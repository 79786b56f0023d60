//! A step of mesh motion allocates nothing.

use allocation_counter::measure;
use partita_mesh::generate::Diagonal;
use partita_mesh::motion::prescribed_dofs;
use partita_mesh::{Mesh, MeshMotion, MotionMode, MotionSettings};

use crate::boxes::{field, unit_cube, unit_square};

fn check<const D: usize>(mesh: &Mesh<D>) {
    let prescribed = prescribed_dofs(mesh, &[]).expect("no sliding");
    for mode in [MotionMode::Reference, MotionMode::Incremental] {
        let settings = MotionSettings { mode, ..MotionSettings::default() };
        let mut motion = MeshMotion::new(mesh, settings, &prescribed).expect("a held mesh");
        let mut displacement = field(mesh, |x| x.map(|x| 0.1 * x * x));
        let committed = vec![0.0; displacement.len()];
        let info = measure(|| {
            motion.begin_step(&committed).expect("valid");
            motion.displace(&committed, &mut displacement).expect("valid");
            motion.check(&displacement).expect("valid");
        });
        assert_eq!(info.count_total, 0, "allocations of a step in {mode:?} mode");
    }
}

#[test]
fn a_step_of_mesh_motion_allocates_nothing() {
    check(&unit_square(8, Diagonal::Crossed));
    check(&unit_cube(4));
}
