//! Scene files: read, checked, explained.
//!
//! [`load`] reads a file and the overrides of the command line into a [`Scene`](schema::Scene) whose values are in range and
//! fit together, or returns a [`SceneError`] that shows the line, the place and how to mend it.

mod diagnose;
mod document;
mod finding;
pub(crate) mod formulas;
pub(crate) mod free;
mod overrides;
mod places;
pub mod reference;
mod repair;
mod resolve;
pub mod schema;
mod shapes;
mod translate;
mod validate;
mod write;

pub use diagnose::{Problem, SceneError};
pub use places::Places;
pub use resolve::{Resolved, SCENE_FILE, load, parse, read_in};
pub use shapes::Shapes;
pub(crate) use shapes::{Content, INPUT_FILES, INPUT_FOLDER, Input, Role};
pub use write::to_toml;
pub(crate) use write::words;
