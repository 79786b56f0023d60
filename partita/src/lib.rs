//! Partitioned fluid-structure interaction: fluids on moving meshes, structures that deform, and what couples them.
//!
//! A run is made of two solvers, or of anything else that takes loads and returns displacements:
//!
//! ```
//! use std::sync::Arc;
//!
//! use partita::Run;
//! use partita::fluid::BoundaryCondition::{Interface, NoSlip, Traction};
//! use partita::fluid::{FluidModel, FluidSettings, FluidSolver};
//! use partita::iga::{Side, build};
//! use partita::mesh::generate::{RectangleMesh, rectangle};
//! use partita::structure::{Law, Material, Plane, StructureModel, StructureSettings, StructureSolver};
//!
//! fn main() -> Result<(), Box<dyn std::error::Error>> {
//!     let mesh = rectangle(&RectangleMesh { size: [1.0, 0.5], divisions: [8, 4], ..Default::default() })?;
//!     let top = ("top", Traction(Arc::new(|_, t| [0.0, -100.0 * t])));
//!     let boundary = [("left", NoSlip), ("right", NoSlip), top, ("bottom", Interface)];
//!     let fluid = FluidSolver::new(mesh, FluidModel::new(1000.0, 10.0, boundary), FluidSettings::default())?;
//!     let patch = build::rectangle([0.0, -0.1], [1.0, 0.1], [2, 2], [8, 1])?;
//!     let rubber = Material::new(Law::StVenantKirchhoff, 2e6, 0.3, Plane::Strain)?;
//!     let clamped = [Side::LEFT, Side::RIGHT].into();
//!     let bottom = StructureModel { clamped, wetted: Side::TOP.into(), ..StructureModel::new(1000.0, rubber) };
//!     let structure = StructureSolver::new(patch.into(), bottom, StructureSettings::default())?;
//!     let middle = |run: &Run| run.structure().unwrap().displacement_at(&[0.5, 1.0])[1];
//!     let mut run = Run::couple(fluid, structure)?.with_steps(5, 0.01).with_probe("middle", middle);
//!     while run.step()? {
//!         println!("t = {:.2} s: {:?} m", run.clock().time, run.probe("middle").unwrap());
//!     }
//!     Ok(())
//! }
//! ```
//!
//! Or it is read from a scene file: [`scene::load`], then [`Run::of`], or a [`session`](session::Session) in a folder, which is
//! what the program `partita` runs.
//!
//! * [`Run`]: steps, probes, output, checkpoints. [`TransferMethod`] and [`coupling::CouplingSettings`] are its choices.
//! * [`Probe`], [`coupling::Participant`], [`coupling::Accelerator`] and [`structure::Constitutive`] are open: programs add
//!   their own. What these remember goes into the checkpoint as bytes of their own, so that a resumed run has the same bits.
//! * [`fluid`], [`structure`], [`mesh`], [`iga`], [`coupling`], [`scene`] and [`numerics`] are the crates it is made of.
//!
//! Nothing here prints, reads arguments or knows a terminal: who wants to see what happens gives a
//! [`Watcher`](watch::Watcher).

pub mod adapt;
pub mod build;
pub mod check;
pub mod checkpoint;
mod clock;
mod couple;
mod draw;
mod error;
mod interface;
pub mod lock;
pub mod memory;
pub mod output;
pub mod plan;
pub mod probe;
pub mod run;
pub mod session;
pub mod warning;
pub mod watch;

pub use partita_coupling as coupling;
pub use partita_fluid as fluid;
pub use partita_iga as iga;
pub use partita_mesh as mesh;
pub use partita_numerics as numerics;
pub use partita_scene as scene;
pub use partita_structure as structure;

pub use adapt::Side;
pub use couple::FieldMarch;
pub use partita_scene::schema::Transfer as TransferMethod;
pub use probe::Probe;
pub use run::{Run, RunError};
