//! A coupled run without a scene: a tank whose elastic bottom gives way under the weight of the water.

use partita::fluid::BoundaryCondition::{Interface, NoSlip, StressFree};
use partita::fluid::{BodyForce, FluidModel, FluidSettings, FluidSolver};
use partita::iga::{Side, build};
use partita::mesh::generate::{RectangleMesh, rectangle};
use partita::structure::{Law, Material, Plane, StructureModel, StructureSettings, StructureSolver};

pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mesh = rectangle(&RectangleMesh { size: [1.0, 0.5], divisions: [8, 4], ..Default::default() })?;
    let top = ("top", StressFree { backflow: false });
    let boundary = [("left", NoSlip), ("right", NoSlip), top, ("bottom", Interface)];
    let body_force = BodyForce::Constant([0.0, -9.81]);
    let water = FluidModel { body_force, ..FluidModel::new(1000.0, 10.0, boundary) };
    let fluid = FluidSolver::new(mesh, water, FluidSettings::default())?;
    let patch = build::rectangle([0.0, -0.1], [1.0, 0.1], [2, 2], [8, 1])?;
    let bottom = StructureModel::new(1000.0, Material::new(Law::StVenantKirchhoff, 2e6, 0.3, Plane::Strain)?);
    let bottom =
        StructureModel { clamped: [Side::LEFT, Side::RIGHT].into(), wetted: Side::TOP.into(), ..bottom };
    let structure = StructureSolver::new(patch.into(), bottom, StructureSettings::default())?;
    let mut run = partita::Run::couple(fluid, structure)?.with_steps(5, 0.01);
    while run.step()? {
        let middle = run.structure().expect("it has one").displacement_at(&[0.5, 1.0]);
        println!("t = {:.2} s: the middle of the bottom is at {:.6} m", run.clock().time, middle[1]);
    }
    Ok(())
}
