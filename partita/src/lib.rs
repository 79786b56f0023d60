//! Partitioned fluid-structure interaction from a scene file: what the program `partita` is made of, without a terminal.

pub mod adapt;
pub mod build;
pub mod check;
pub mod checkpoint;
mod clock;
mod draw;
pub mod lock;
pub mod memory;
pub mod output;
pub mod plan;
pub mod probe;
pub mod session;
pub mod warning;
pub mod watch;

pub use partita_scene as scene;
