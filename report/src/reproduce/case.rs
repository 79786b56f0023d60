//! The two cases of the paper.

use std::fmt;
use std::str::FromStr;

use super::setting::{Limit, Limits};

/// One of the paper's two cases.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Case {
    /// The tank with the elastic bottom, table 1.
    Tank,
    /// The elastic beam in the channel, table 2.
    Beam,
}

impl Case {
    pub(crate) const ALL: [Self; 2] = [Self::Tank, Self::Beam];

    /// The folder of its scene in `scenes/`.
    pub(crate) fn scene(self) -> &'static str {
        match self {
            Self::Tank => "elastic-bottom",
            Self::Beam => "beam-in-channel",
        }
    }

    /// Short, for sentences.
    pub(crate) fn short(self) -> &'static str {
        match self {
            Self::Tank => "tank",
            Self::Beam => "beam",
        }
    }

    /// The paper's table of (N^f, N^s) for this case.
    pub(crate) fn table(self) -> u8 {
        match self {
            Self::Tank => 1,
            Self::Beam => 2,
        }
    }

    /// The settings of that table, row by row.
    pub(crate) fn grid(self) -> Vec<Limits> {
        let structure: &[usize] = match self {
            Self::Tank => &[1, 2, 3, 4, 5],
            Self::Beam => &[1, 2, 3],
        };
        product(&[1, 2, 3, 4, 5], structure)
    }

    /// The fluid's density in the scene \[kg/m3\].
    pub(crate) fn fluid_density(self) -> f64 {
        match self {
            Self::Tank => 1000.0,
            Self::Beam => 1.0,
        }
    }
}

/// All pairs of these limits, "to convergence" added to both.
pub(crate) fn product(fluid: &[usize], structure: &[usize]) -> Vec<Limits> {
    let limits = |counts: &[usize]| -> Vec<Limit> {
        counts.iter().map(|&count| Limit::AtMost(count)).chain([Limit::ToConvergence]).collect()
    };
    let structure = limits(structure);
    limits(fluid)
        .into_iter()
        .flat_map(|fluid| structure.iter().map(move |&structure| Limits { fluid, structure }))
        .collect()
}

/// As the tables' files spell it.
impl fmt::Display for Case {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Tank => "elastic_bottom",
            Self::Beam => "beam_in_channel",
        })
    }
}

impl FromStr for Case {
    type Err = ();

    fn from_str(text: &str) -> Result<Self, ()> {
        Self::ALL.into_iter().find(|case| case.to_string() == text).ok_or(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tables_have_as_many_cells_as_the_paper_s() {
        assert_eq!(Case::ALL.map(|case| case.grid().len()), [36, 24]);
        assert_eq!(Case::Beam.grid()[4], Limits::of("2", "1"));
    }
}
