//! The parts of a small tank with an elastic bottom, for the examples that exchange one of them.
#![allow(dead_code, reason = "each example takes what it needs")]

use std::error::Error;

use partita::fluid::BoundaryCondition::{Interface, NoSlip, StressFree};
use partita::fluid::{BodyForce, FluidModel, FluidSettings, FluidSolver};
use partita::iga::{Side, build};
use partita::mesh::generate::{RectangleMesh, rectangle};
use partita::structure::{
    AnyMaterial, Law, Material, Plane, StructureModel, StructureSettings, StructureSolver,
};

/// Water on an interface at its bottom, open at its top.
pub(crate) fn fluid() -> Result<FluidSolver<2>, Box<dyn Error>> {
    let mesh = rectangle(&RectangleMesh { size: [1.0, 0.5], divisions: [8, 4], ..Default::default() })?;
    let top = ("top", StressFree { backflow: false });
    let boundary = [("left", NoSlip), ("right", NoSlip), top, ("bottom", Interface)];
    let body_force = BodyForce::Constant([0.0, -9.81]);
    let water = FluidModel { body_force, ..FluidModel::new(1000.0, 10.0, boundary) };
    Ok(FluidSolver::new(mesh, water, FluidSettings::default())?)
}

/// The bottom, of any material.
pub(crate) fn structure(material: impl Into<AnyMaterial<2>>) -> Result<StructureSolver<2>, Box<dyn Error>> {
    let patch = build::rectangle([0.0, -0.1], [1.0, 0.1], [2, 2], [8, 1])?;
    let bottom = StructureModel::new(1000.0, material);
    let bottom =
        StructureModel { clamped: [Side::LEFT, Side::RIGHT].into(), wetted: Side::TOP.into(), ..bottom };
    Ok(StructureSolver::new(patch.into(), bottom, StructureSettings::default())?)
}

/// A soft material for it.
pub(crate) fn rubber() -> Material {
    Material::new(Law::StVenantKirchhoff, 2e6, 0.3, Plane::Strain).expect("sound constants")
}
