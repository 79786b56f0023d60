//! Partitioned fluid-structure interaction from a scene file: what the program `partita` is made of, without a terminal.

pub mod adapt;
pub mod build;
pub mod check;
pub mod checkpoint;
mod draw;
pub mod expression;
mod file_kind;
mod lock;
pub mod memory;
mod nearest;
pub mod output;
pub mod plan;
mod probe;
pub mod scene;
pub mod session;
pub mod stability;
pub mod study;
pub mod warning;
pub mod watch;
