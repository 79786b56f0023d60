//! What the paper's tables vary: how many Newton iterations a solver call may take.

use std::fmt;
use std::str::FromStr;

/// Newton iterations one solver call may take.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Limit {
    AtMost(usize),
    ToConvergence,
}

impl Limit {
    /// As a scene file says it.
    fn in_scene(self) -> String {
        match self {
            Self::AtMost(count) => count.to_string(),
            Self::ToConvergence => "unlimited".to_owned(),
        }
    }
}

/// As the paper's tables say it.
impl fmt::Display for Limit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::AtMost(count) => write!(f, "{count}"),
            Self::ToConvergence => write!(f, "inf"),
        }
    }
}

impl FromStr for Limit {
    type Err = ();

    fn from_str(text: &str) -> Result<Self, ()> {
        match text {
            "inf" => Ok(Self::ToConvergence),
            count => count.parse().map(Self::AtMost).map_err(|_| ()),
        }
    }
}

/// A cell of table 1 or 2: the limits (N^f, N^s).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Limits {
    pub(crate) fluid: Limit,
    pub(crate) structure: Limit,
}

impl Limits {
    /// One iteration a call.
    pub(crate) const ONE: Self = Self { fluid: Limit::AtMost(1), structure: Limit::AtMost(1) };
    /// Every call to convergence.
    pub(crate) const UNLIMITED: Self = Self { fluid: Limit::ToConvergence, structure: Limit::ToConvergence };

    /// At most so many iterations a call.
    pub(crate) const fn at_most(fluid: usize, structure: usize) -> Self {
        Self { fluid: Limit::AtMost(fluid), structure: Limit::AtMost(structure) }
    }

    /// The same limits from their spelling.
    #[cfg(test)]
    pub(crate) fn of(fluid: &str, structure: &str) -> Self {
        Self { fluid: fluid.parse().expect("a limit"), structure: structure.parse().expect("a limit") }
    }
}

impl fmt::Display for Limits {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "({}, {})", self.fluid, self.structure)
    }
}

/// A row of table 3.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Adaptive {
    /// One iteration a call until the coupling criterion is met, then to convergence.
    N1Cc,
    /// Three iterations a call until then.
    N3Cc,
    /// Until the interface data changes by less than 1e-4.
    InterfaceData,
}

impl Adaptive {
    pub(crate) const ALL: [Self; 3] = [Self::N1Cc, Self::N3Cc, Self::InterfaceData];

    /// As the paper's text calls it.
    pub(crate) fn title(self) -> &'static str {
        match self {
            Self::N1Cc => "N1-CC",
            Self::N3Cc => "N3-CC",
            Self::InterfaceData => "converged interface data, 1e-4",
        }
    }
}

/// As the tables' files spell it.
impl fmt::Display for Adaptive {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::N1Cc => "n1-cc",
            Self::N3Cc => "n3-cc",
            Self::InterfaceData => "cid-1e-4",
        })
    }
}

impl FromStr for Adaptive {
    type Err = ();

    fn from_str(text: &str) -> Result<Self, ()> {
        Self::ALL.into_iter().find(|setting| setting.to_string() == text).ok_or(())
    }
}

/// A setting of any of the three tables.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Setting {
    Fixed(Limits),
    Adaptive(Adaptive),
}

impl Setting {
    /// The keys of the scene that ask for it.
    pub(crate) fn overrides(self) -> Vec<String> {
        let newton = |rest: &str| format!("coupling.newton.{rest}");
        match self {
            Self::Fixed(Limits { fluid, structure }) => vec![
                newton(&format!("fixed.fluid={}", fluid.in_scene())),
                newton(&format!("fixed.structure={}", structure.in_scene())),
            ],
            Self::Adaptive(Adaptive::N1Cc) => vec![newton("until_coupled=1")],
            Self::Adaptive(Adaptive::N3Cc) => vec![newton("until_coupled=3")],
            Self::Adaptive(Adaptive::InterfaceData) => vec![newton("converged_interface_data=1e-4")],
        }
    }
}

/// One word, `1/inf` or `n1-cc`.
impl fmt::Display for Setting {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Fixed(Limits { fluid, structure }) => write!(f, "{fluid}/{structure}"),
            Self::Adaptive(adaptive) => write!(f, "{adaptive}"),
        }
    }
}

impl FromStr for Setting {
    type Err = ();

    fn from_str(text: &str) -> Result<Self, ()> {
        match text.split_once('/') {
            Some((fluid, structure)) => {
                Ok(Self::Fixed(Limits { fluid: fluid.parse()?, structure: structure.parse()? }))
            }
            None => text.parse().map(Self::Adaptive),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_setting_is_read_as_it_is_spelled() {
        for text in ["1/inf", "inf/3", "n1-cc", "n3-cc", "cid-1e-4"] {
            assert_eq!(text.parse::<Setting>().expect("a setting").to_string(), text);
        }
        assert!("one/inf".parse::<Setting>().is_err() && "n2-cc".parse::<Setting>().is_err());
    }

    #[test]
    fn to_convergence_is_the_largest_limit() {
        assert!(Limit::AtMost(5) < Limit::ToConvergence && Limit::AtMost(1) < Limit::AtMost(2));
    }

    #[test]
    fn settings_are_keys_of_the_scene() {
        let fixed = Setting::Fixed(Limits::of("2", "inf"));
        assert_eq!(
            fixed.overrides(),
            ["coupling.newton.fixed.fluid=2", "coupling.newton.fixed.structure=unlimited"]
        );
        assert_eq!(Setting::Adaptive(Adaptive::N3Cc).overrides(), ["coupling.newton.until_coupled=3"]);
    }
}
