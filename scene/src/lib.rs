//! Scene files: read, checked, explained.
//!
//! [`load`] reads a file and the overrides of the command line into a [`Scene`](schema::Scene) whose values are in range and
//! fit together, or returns a [`SceneError`] that shows the line, the place and how to mend it.

mod check;
mod diagnose;
mod document;
pub mod expression;
pub mod file_kind;
mod finding;
pub mod formulas;
pub mod free;
pub mod models;
mod overrides;
mod places;
pub mod reference;
mod repair;
mod resolve;
pub mod schema;
mod shapes;
mod sources;
pub mod spelling;
mod translate;
mod validate;
pub mod warning;
mod write;

pub use diagnose::{Problem, SceneError};
pub use places::Places;
pub use resolve::{Resolved, SCENE_FILE, load, parse, read_in};
pub use shapes::Shapes;
pub use shapes::{Content, INPUT_FILES, INPUT_FOLDER, Input, Role};
pub use write::to_toml;
pub use write::words;
