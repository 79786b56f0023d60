//! One row of `docs/data/damping.csv`.

use std::fmt;
use std::str::FromStr;

use crate::csv::{self, Csv};
use crate::task::TaskError;

/// Which run of a case.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Radius {
    /// With coarse steps and this radius.
    Given(f64),
    /// With coarse steps and no radius in the scene.
    Default,
    /// With fine steps; its errors are the distance from the same run with the other radius.
    Reference,
}

/// The runs of a case, in the order of the page.
pub(super) const RADII: [Radius; 8] = [
    Radius::Given(1.0),
    Radius::Given(0.9),
    Radius::Given(0.8),
    Radius::Given(0.5),
    Radius::Given(0.2),
    Radius::Given(0.0),
    Radius::Default,
    Radius::Reference,
];

/// What one run came to.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Row {
    pub(super) case: String,
    pub(super) radius: Radius,
    /// The radius that the run had.
    pub(super) value: f64,
    /// Mean absolute second difference of the force \[N/m\].
    pub(super) second_difference: Option<f64>,
    pub(super) displacement_error: f64,
    pub(super) force_error: Option<f64>,
}

const COLUMNS: [&str; 6] =
    ["case", "run", "spectral_radius", "second_difference", "displacement_error", "force_error"];

pub(super) fn to_csv(rows: &[Row]) -> Csv {
    let mut table = Csv::new(COLUMNS);
    let number = |value: f64| format!("{value:.3e}");
    for row in rows {
        table.push(vec![
            row.case.clone(),
            row.radius.to_string(),
            row.value.to_string(),
            row.second_difference.map_or_else(String::new, number),
            number(row.displacement_error),
            row.force_error.map_or_else(String::new, number),
        ]);
    }
    table
}

impl Row {
    pub(super) fn read(row: &csv::Row<'_>) -> Result<Self, TaskError> {
        Ok(Self {
            case: row.text("case")?.to_owned(),
            radius: row.value("run")?,
            value: row.value("spectral_radius")?,
            second_difference: row.optional("second_difference")?,
            displacement_error: row.value("displacement_error")?,
            force_error: row.optional("force_error")?,
        })
    }
}

impl fmt::Display for Radius {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Given(value) => value.fmt(f),
            Self::Default => f.write_str("default"),
            Self::Reference => f.write_str("reference"),
        }
    }
}

impl FromStr for Radius {
    type Err = std::num::ParseFloatError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        match text {
            "default" => Ok(Self::Default),
            "reference" => Ok(Self::Reference),
            number => number.parse().map(Self::Given),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_run_is_read_as_it_was_written() {
        for radius in RADII {
            assert_eq!(radius.to_string().parse(), Ok(radius));
        }
        assert!("half".parse::<Radius>().is_err());
    }
}
