//! Numbers with a range: a value outside it cannot be built, so nothing downstream checks again.

use std::fmt;

use partita_coupling::StepSizes;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// A number outside the range its place in a scene allows.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("{} is not {expected}", plain(*.value))]
pub struct OutOfRange {
    /// The number as it was given.
    pub value: f64,
    /// What the place allows, such as `a number above zero`.
    pub expected: &'static str,
}

/// A number in the shortest form that gives the same bits: 0.01, 1000, 1e300.
#[must_use]
pub fn plain(number: f64) -> String {
    let moderate = number == 0.0 || (1e-4..1e7).contains(&number.abs()) || !number.is_finite();
    if moderate { format!("{number}") } else { format!("{number:e}") }
}

macro_rules! ranged {
    ($(#[$doc:meta])* $name:ident, $expected:literal, |$x:ident| $holds:expr) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq, PartialOrd, Serialize, Deserialize, JsonSchema)]
        #[serde(try_from = "f64", into = "f64")]
        pub struct $name(f64);

        impl $name {
            /// Checks the range.
            ///
            /// # Errors
            ///
            /// [`OutOfRange`] for a number outside it, not-a-number included.
            pub fn new(value: f64) -> Result<Self, OutOfRange> {
                let $x = value;
                if $holds {
                    Ok(Self(value))
                } else {
                    Err(OutOfRange { value, expected: $expected })
                }
            }

            /// The plain number.
            #[must_use]
            pub const fn get(self) -> f64 {
                self.0
            }
        }

        impl TryFrom<f64> for $name {
            type Error = OutOfRange;
            fn try_from(value: f64) -> Result<Self, OutOfRange> {
                Self::new(value)
            }
        }

        impl From<$name> for f64 {
            fn from(number: $name) -> Self {
                number.0
            }
        }

        impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.pad(&plain(self.0))
            }
        }
    };
}

ranged!(
    /// Any finite number.
    Real, "a finite number", |x| x.is_finite()
);
ranged!(
    /// A finite number above zero.
    Positive, "a number above zero", |x| x.is_finite() && x > 0.0
);
ranged!(
    /// A finite number, zero or above.
    NonNegative, "zero or a number above it", |x| x.is_finite() && x >= 0.0
);
ranged!(
    /// A number above 0 and below 1.
    Fraction, "a number above 0 and below 1", |x| x > 0.0 && x < 1.0
);
ranged!(
    /// A parameter of a spline: 0 to 1.
    Parameter, "a spline parameter, from 0 to 1", |x| (0.0..=1.0).contains(&x)
);
ranged!(
    /// A relaxation factor: above 0, below 2.
    Relaxation, "a relaxation factor, above 0 and below 2", |x| x > 0.0 && x < 2.0
);
ranged!(
    /// A Poisson ratio: above -1, below 0.5.
    PoissonRatio, "a Poisson ratio, above -1 and below 0.5", |x| x > -1.0 && x < 0.5
);
ranged!(
    /// The spectral radius at infinite frequency: 0 to 1.
    SpectralRadius, "a spectral radius, from 0 to 1", |x| (0.0..=1.0).contains(&x)
);

/// How often a step may be halved: 1 to [`StepSizes::MOST`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(try_from = "i64", into = "u32")]
#[schemars(description = format!("How often a step may be halved: 1 to {}.", StepSizes::MOST))]
pub struct Halvings(u32);

impl Halvings {
    /// Checks the range.
    ///
    /// # Errors
    ///
    /// A sentence for a number outside it.
    pub fn new(value: i64) -> Result<Self, String> {
        match u32::try_from(value) {
            Ok(halvings @ 1..=StepSizes::MOST) => Ok(Self(halvings)),
            _ => Err(format!("{value} is not a number of halvings, from 1 to {}", StepSizes::MOST)),
        }
    }

    /// The plain number.
    #[must_use]
    pub const fn get(self) -> u32 {
        self.0
    }
}

impl TryFrom<i64> for Halvings {
    type Error = String;
    fn try_from(value: i64) -> Result<Self, String> {
        Self::new(value)
    }
}

impl From<Halvings> for u32 {
    fn from(halvings: Halvings) -> Self {
        halvings.0
    }
}

/// A count of at least one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema)]
#[serde(try_from = "i64", into = "usize")]
pub struct Count(usize);

/// A number that is no count of at least one.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum NotACount {
    /// Zero or below.
    #[error("{0} is not a count of at least 1")]
    TooSmall(i64),
    /// Beyond [`Count::MAX`].
    #[error("{0} is beyond the largest count, {max}", max = Count::MAX)]
    TooLarge(i64),
}

impl Count {
    /// The largest count a scene may ask for: what 32 bits hold.
    pub const MAX: usize = u32::MAX as usize;

    /// Checks the range.
    ///
    /// # Errors
    ///
    /// [`NotACount`] for zero, a negative number or more than [`Count::MAX`].
    pub fn new(value: i64) -> Result<Self, NotACount> {
        match usize::try_from(value) {
            Ok(count @ 1..=Self::MAX) => Ok(Self(count)),
            Ok(1..) => Err(NotACount::TooLarge(value)),
            _ => Err(NotACount::TooSmall(value)),
        }
    }

    /// The plain count.
    #[must_use]
    pub const fn get(self) -> usize {
        self.0
    }

    /// A count known when the program is written.
    pub(crate) const fn literal(value: usize) -> Self {
        assert!(value > 0, "a count is at least one");
        Self(value)
    }
}

impl TryFrom<i64> for Count {
    type Error = NotACount;
    fn try_from(value: i64) -> Result<Self, NotACount> {
        Self::new(value)
    }
}

impl From<Count> for usize {
    fn from(count: Count) -> Self {
        count.0
    }
}

impl fmt::Display for Count {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}
