//! Where the equations of a field are satisfied worst.

use std::fmt;

use crate::Place;

/// The equation of a node that misses its balance most.
#[derive(Debug, Clone, PartialEq)]
pub struct LargestResidual {
    /// The node.
    pub node: usize,
    /// Where it is.
    pub place: Place,
    /// `momentum in x`, `continuity`, `force in y` or the like.
    pub equation: &'static str,
    /// Its residual, in the unit of the equation.
    pub residual: f64,
    /// What the field calls a node: `node`, `control point`.
    pub noun: &'static str,
    /// Whether `place` is that of the undeformed field.
    pub undeformed: bool,
}

impl fmt::Display for LargestResidual {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { node, place, equation, noun, undeformed, .. } = self;
        let undeformed = if *undeformed { "undeformed at " } else { "" };
        write!(f, "{equation} at {noun} {node}, {undeformed}{place}")
    }
}
