//! Points in messages.

use std::fmt;

/// A point in space as messages show it: `(0.25, 0.5) m`.
#[derive(Debug, Clone, PartialEq)]
pub struct Place(pub Vec<f64>);

impl<const D: usize> From<[f64; D]> for Place {
    fn from(point: [f64; D]) -> Self {
        Self(point.to_vec())
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("(")?;
        for (i, x) in self.0.iter().enumerate() {
            let separator = if i == 0 { "" } else { ", " };
            f.write_str(separator)?;
            write_rounded(f, *x)?;
        }
        f.write_str(") m")
    }
}

/// Six significant digits, without trailing zeros; powers of ten where decimals would be long.
fn write_rounded(f: &mut fmt::Formatter<'_>, x: f64) -> fmt::Result {
    let rounded: f64 = format!("{x:.5e}").parse().expect("a printed number is a number");
    if rounded == 0.0 || (1e-3..1e6).contains(&rounded.abs()) {
        write!(f, "{rounded}")
    } else {
        write!(f, "{rounded:e}")
    }
}
