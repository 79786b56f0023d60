//! Warnings: input that is legal but hardly intended.
//!
//! `check` and the start of `run` print them. A scene accepts one by its name, with a reason (`[warnings.accept]`); with
//! `--deny-warnings` any other is an error. A warning never changes a number.

mod kind;

use std::fmt;

use serde::{Serialize, Serializer};

pub use kind::Kind;

use crate::build::Run;
use crate::scene::Resolved;

/// One warning.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Warning {
    /// What it is about.
    #[serde(rename = "name", serialize_with = "by_name")]
    pub kind: Kind,
    /// The file and line, and the key that is to blame.
    pub place: String,
    /// What is odd, with numbers and units.
    pub what: String,
    /// What to do.
    pub remedy: String,
    /// The scene's reason for accepting it.
    pub accepted: Option<String>,
}

fn by_name<S: Serializer>(kind: &Kind, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(kind.name())
}

/// On one line: place, reason, remedy, name.
impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { kind, place, what, remedy, accepted } = self;
        match accepted {
            None => write!(f, "warning: {place}: {what}; {remedy} [{}]", kind.name()),
            Some(reason) => write!(f, "accepted: {place}: {what}; {reason} [{}]", kind.name()),
        }
    }
}

/// All warnings about a scene and the run that was built from it, accepted ones included.
#[must_use]
pub fn of(resolved: &Resolved, run: &Run) -> Vec<Warning> {
    let found = Found { resolved, warnings: Vec::new() };
    let _ = run;
    found.warnings
}

/// Those that the scene does not accept.
pub fn open(warnings: &[Warning]) -> impl Iterator<Item = &Warning> {
    warnings.iter().filter(|warning| warning.accepted.is_none())
}

/// The warnings found so far.
struct Found<'a> {
    resolved: &'a Resolved,
    warnings: Vec<Warning>,
}

impl Found<'_> {
    /// Adds a warning about the key at a path, or its nearest ancestor that the scene spells out.
    #[allow(dead_code, reason = "the checks follow")]
    fn warn(&mut self, kind: Kind, path: &[&str], what: impl Into<String>, remedy: impl Into<String>) {
        let accepted = self.resolved.scene.warnings.accept.get(kind.name());
        self.warnings.push(Warning {
            kind,
            place: self.resolved.places.describe(path),
            what: what.into(),
            remedy: remedy.into(),
            accepted: accepted.map(|reason| reason.as_str().to_owned()),
        });
    }
}
