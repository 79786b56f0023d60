//! Names for the sides of a patch.

use std::fmt;
use std::str::FromStr;

/// One of the two ends of a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum End {
    /// Where the parameter is smallest.
    Start,
    /// Where the parameter is largest.
    End,
}

/// A side of a patch: the part of its boundary where one parameter stays at one end.
///
/// | parameter | start    | end     |
/// |-----------|----------|---------|
/// | 0         | `left`   | `right` |
/// | 1         | `bottom` | `top`   |
/// | 2         | `front`  | `back`  |
///
/// ```
/// use partita_iga::{End, Side};
///
/// let side: Side = "top".parse()?;
/// assert_eq!(side, Side { parameter: 1, end: End::End });
/// assert_eq!(side.to_string(), "top");
/// # Ok::<(), partita_iga::UnknownSide>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Side {
    /// Which parameter is held.
    pub parameter: usize,
    /// At which of its ends.
    pub end: End,
}

impl Side {
    /// First parameter at its start.
    pub const LEFT: Self = Self { parameter: 0, end: End::Start };
    /// First parameter at its end.
    pub const RIGHT: Self = Self { parameter: 0, end: End::End };
    /// Second parameter at its start.
    pub const BOTTOM: Self = Self { parameter: 1, end: End::Start };
    /// Second parameter at its end.
    pub const TOP: Self = Self { parameter: 1, end: End::End };
    /// Third parameter at its start.
    pub const FRONT: Self = Self { parameter: 2, end: End::Start };
    /// Third parameter at its end.
    pub const BACK: Self = Self { parameter: 2, end: End::End };

    /// All sides, those of the first parameter first.
    pub const ALL: [Self; 6] = [Self::LEFT, Self::RIGHT, Self::BOTTOM, Self::TOP, Self::FRONT, Self::BACK];

    const NAMES: [&str; 6] = ["left", "right", "bottom", "top", "front", "back"];
}

impl fmt::Display for Side {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match Self::ALL.iter().position(|side| side == self) {
            Some(index) => f.pad(Self::NAMES[index]),
            None => write!(f, "{:?} of parameter {}", self.end, self.parameter),
        }
    }
}

impl FromStr for Side {
    type Err = UnknownSide;

    fn from_str(name: &str) -> Result<Self, Self::Err> {
        let index = Self::NAMES.iter().position(|known| *known == name);
        index.map(|index| Self::ALL[index]).ok_or_else(|| UnknownSide { name: name.to_owned() })
    }
}

/// A name that belongs to no side.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error, miette::Diagnostic)]
#[error("no side of a patch is called `{name}`")]
#[diagnostic(help("write left, right, bottom, top, front or back"))]
pub struct UnknownSide {
    /// The name as it was written.
    pub name: String,
}

#[cfg(test)]
mod tests {
    use miette::Diagnostic;

    use super::*;

    #[test]
    fn names_and_sides_are_one_to_one() {
        for side in Side::ALL {
            assert_eq!(side.to_string().parse(), Ok(side));
        }
    }

    #[test]
    fn an_unknown_name_is_repeated_with_the_names_to_choose_from() {
        let error = "upper".parse::<Side>().unwrap_err();
        assert!(error.to_string().contains("`upper`"), "{error}");
        assert!(error.help().unwrap().to_string().contains("bottom, top"));
    }
}
