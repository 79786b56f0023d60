//! Whether a table has come out as the one that is kept.
//!
//! On one machine a run gives the same digits. Another processor rounds otherwise; an iteration that is close to its bound then
//! ends one earlier or later. Each column says how much of that is allowed, and times are in no comparison.

use crate::csv::{Csv, Row};
use crate::task::TaskError;

/// How far a number may be from the one that is kept.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Tolerance {
    /// Part of the kept number.
    pub(crate) part: f64,
    /// What is allowed in any case.
    pub(crate) least: f64,
}

/// The same text.
pub(crate) const EXACT: Tolerance = Tolerance { part: 0.0, least: 0.0 };

/// Counts of iterations on another machine. A count that rounding can move at all moves by one at least.
pub(crate) const COUNT: Tolerance = Tolerance { part: 0.02, least: 1.0 };

impl Tolerance {
    /// Whether two cells say the same.
    pub(crate) fn holds(self, kept: &str, found: &str) -> bool {
        let near = |kept: f64, found: f64| (kept - found).abs() <= (self.part * kept.abs()).max(self.least);
        kept == found || matches!((kept.parse(), found.parse()), (Ok(kept), Ok(found)) if near(kept, found))
    }
}

/// What differs, a line each. The columns of `key` name a row; `columns` are compared, all others are not.
pub(crate) fn differences(
    key: &[&str],
    columns: &[(&str, Tolerance)],
    kept: &Csv,
    found: &Csv,
) -> Result<Vec<String>, TaskError> {
    let name = |row: &Row<'_>| -> Result<String, TaskError> {
        let parts = key.iter().map(|column| row.text(column)).collect::<Result<Vec<_>, _>>()?;
        Ok(parts.join(", "))
    };
    let named = |table: &Csv| table.rows().map(|row| name(&row)).collect::<Result<Vec<String>, TaskError>>();
    let (kept_names, found_names) = (named(kept)?, named(found)?);
    let mut all = Vec::new();
    for (name, found) in found_names.iter().zip(found.rows()) {
        let Some(place) = kept_names.iter().position(|other| other == name) else {
            all.push(format!("{name}: not in the table that is kept"));
            continue;
        };
        let kept = kept.row(place);
        for (column, tolerance) in columns {
            let [before, now] = [kept.text(column)?, found.text(column)?];
            if !tolerance.holds(before, now) {
                all.push(format!("{name}: {column} {now}, before {before}"));
            }
        }
    }
    let lost = kept_names.iter().filter(|name| !found_names.contains(name));
    all.extend(lost.map(|name| format!("{name}: in the table that is kept alone")));
    Ok(all)
}

#[cfg(test)]
mod tests {
    use super::*;

    const NUMBER: Tolerance = Tolerance { part: 1e-3, least: 1e-6 };

    fn found(kept: &str, found: &str) -> Vec<String> {
        let [kept, found] =
            [kept, found].map(|rows| Csv::parse(&format!("name,word,x,n,seconds\n{rows}")).expect("a table"));
        let columns = [("word", EXACT), ("x", NUMBER), ("n", COUNT)];
        differences(&["name"], &columns, &kept, &found).expect("all columns are there")
    }

    #[test]
    fn times_may_differ_and_numbers_only_within_their_bounds() {
        assert_eq!(found("a,w,0.5,200,1\n", "a,w,0.5004,204,9\n"), Vec::<String>::new());
        assert_eq!(found("a,w,0.5,200,1\n", "a,w,0.501,200,1\n"), ["a: x 0.501, before 0.5"]);
        assert_eq!(found("a,w,0.5,200,1\n", "a,v,0.5,205,1\n").len(), 2);
        // A small count may differ by one, a small number by round-off.
        assert_eq!(found("a,w,0,7,1\n", "a,w,9e-7,8,1\n"), Vec::<String>::new());
        assert_eq!(found("a,w,0,7,1\n", "a,w,2e-6,9,1\n").len(), 2);
    }

    #[test]
    fn a_value_that_appears_or_goes_is_a_difference() {
        assert_eq!(found("a,w,,1,1\n", "a,w,,1,1\n"), Vec::<String>::new());
        assert_eq!(found("a,w,,1,1\n", "a,w,1,1,1\n"), ["a: x 1, before "]);
        assert_eq!(found("a,w,1,1,1\n", "a,w,NaN,1,1\n"), ["a: x NaN, before 1"]);
    }

    #[test]
    fn a_row_that_appears_or_goes_is_a_difference() {
        let differing = found("a,w,1,1,1\nb,w,1,1,1\n", "b,w,1,1,1\nc,w,1,1,1\n");
        assert_eq!(differing, ["c: not in the table that is kept", "a: in the table that is kept alone"]);
    }
}
