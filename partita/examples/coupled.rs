//! A coupled run without a scene: a tank whose elastic bottom gives way under a growing pressure.

use std::sync::Arc;

use partita::Run;
use partita::fluid::BoundaryCondition::{Interface, NoSlip, Traction};
use partita::fluid::{FluidModel, FluidSettings, FluidSolver};
use partita::iga::{Side, build};
use partita::mesh::generate::{RectangleMesh, rectangle};
use partita::structure::{Law, Material, Plane, StructureModel, StructureSettings, StructureSolver};

pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mesh = rectangle(&RectangleMesh { size: [1.0, 0.5], divisions: [8, 4], ..Default::default() })?;
    let top = ("top", Traction(Arc::new(|_, t| [0.0, -100.0 * t])));
    let boundary = [("left", NoSlip), ("right", NoSlip), top, ("bottom", Interface)];
    let fluid = FluidSolver::new(mesh, FluidModel::new(1000.0, 10.0, boundary), FluidSettings::default())?;
    let patch = build::rectangle([0.0, -0.1], [1.0, 0.1], [2, 2], [8, 1])?;
    let rubber = Material::new(Law::StVenantKirchhoff, 2e6, 0.3, Plane::Strain)?;
    let clamped = [Side::LEFT, Side::RIGHT].into();
    let bottom = StructureModel { clamped, wetted: Side::TOP.into(), ..StructureModel::new(1000.0, rubber) };
    let structure = StructureSolver::new(patch.into(), bottom, StructureSettings::default())?;
    let middle = |run: &Run| run.structure().unwrap().displacement_at(&[0.5, 1.0])[1];
    let mut run = Run::couple(fluid, structure)?.with_steps(5, 0.01).with_probe("middle", middle);
    while run.step()? {
        println!("t = {:.2} s: {:?} m", run.clock().time, run.probe("middle").unwrap());
    }
    Ok(())
}
