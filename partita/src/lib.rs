//! Partitioned fluid-structure interaction, as a library.

pub mod adapt;
pub mod build;
pub mod check;
pub mod checkpoint;
mod clock;
mod couple;
mod draw;
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
