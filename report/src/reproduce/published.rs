//! The paper's own numbers.

use std::collections::BTreeMap;
use std::path::Path;

use super::case::Case;
use super::counts::{Counts, Grid};
use super::facts::{Facts, Relaxation};
use super::setting::{Adaptive, Limits};
use crate::csv::{Csv, Row};
use crate::task::TaskError;

/// A cell whose printed counts contradict each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Misprint {
    pub(crate) limits: Limits,
    /// The structural count as printed.
    pub(crate) printed: usize,
    /// Total less fluid.
    pub(crate) derived: usize,
}

/// What the paper says about both cases.
pub(crate) struct Published {
    pub(crate) facts: [Facts; 2],
    /// Those of tables 1 and 2.
    pub(crate) misprints: [Vec<Misprint>; 2],
}

impl Published {
    /// Reads `paper/published`.
    pub(crate) fn read(root: &Path) -> Result<Self, TaskError> {
        let folder = root.join("paper/published");
        let third = Csv::read(&folder.join("table3.csv"))?;
        let mut misprints = [Vec::new(), Vec::new()];
        let mut facts = Vec::new();
        for (case, misprints) in Case::ALL.into_iter().zip(&mut misprints) {
            let table = Csv::read(&folder.join(format!("table{}.csv", case.table())))?;
            let (grid, found) = grid(&table)?;
            *misprints = found;
            facts.push(Facts { adaptive: adaptive(&third, case)?, ..stated(case, grid) });
        }
        let facts = facts.try_into().expect("one a case");
        Ok(Self { facts, misprints })
    }

    pub(crate) fn of(&self, case: Case) -> &Facts {
        &self.facts[case as usize]
    }
}

/// The grid, and what the paper's text says beside the tables: that the tank is bound by added mass and the beam
/// converges with a constant factor of 0.8 (sections 3.2 and 3.3), and that no structural call of the beam took more
/// than three iterations. It measures no times.
fn stated(case: Case, grid: Grid) -> Facts {
    Facts {
        case,
        grid,
        adaptive: BTreeMap::new(),
        relaxation: Some(match case {
            Case::Tank => Relaxation::Fails { step: None },
            Case::Beam => Relaxation::Converges,
        }),
        longest_structure_call: match case {
            Case::Tank => None,
            Case::Beam => Some(3),
        },
        costs: Vec::new(),
    }
}

fn grid(table: &Csv) -> Result<(Grid, Vec<Misprint>), TaskError> {
    let mut grid = Grid::default();
    let mut misprints = Vec::new();
    for row in table.rows() {
        let limits = Limits { fluid: row.value("n_f")?, structure: row.value("n_s")? };
        let (counts, printed) = counts(row)?;
        if printed != counts.structure {
            misprints.push(Misprint { limits, printed, derived: counts.structure });
        }
        grid.cells.insert(limits, Some(counts));
    }
    Ok((grid, misprints))
}

/// The counts of a row with the structural one derived, and that one as printed.
fn counts(row: Row<'_>) -> Result<(Counts, usize), TaskError> {
    let (total, fluid): (usize, usize) = (row.value("newton_total")?, row.value("newton_fluid")?);
    let counts = Counts { coupling: row.value("coupling")?, fluid, structure: total - fluid };
    Ok((counts, row.value("newton_structure")?))
}

fn adaptive(table: &Csv, case: Case) -> Result<BTreeMap<Adaptive, Option<Counts>>, TaskError> {
    let mut found = BTreeMap::new();
    for row in table.rows() {
        if row.value::<Case>("case")? == case {
            found.insert(row.value("setting")?, Some(counts(row)?.0));
        }
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::task::workspace_root;

    #[test]
    fn the_printed_tables_contradict_themselves_in_seven_cells() {
        let published = Published::read(workspace_root()).expect("the files are there");
        let [tank, beam] = &published.misprints;
        let found: Vec<(String, usize, usize)> =
            tank.iter().map(|m| (m.limits.to_string(), m.printed, m.derived)).collect();
        let expected = [
            ("(1, 1)", 567, 549),
            ("(1, 2)", 549, 749),
            ("(1, 3)", 549, 916),
            ("(1, 4)", 549, 1017),
            ("(1, 5)", 549, 973),
            ("(1, inf)", 549, 973),
            ("(inf, 2)", 589, 598),
        ];
        assert_eq!(found, expected.map(|(limits, printed, derived)| (limits.to_owned(), printed, derived)));
        assert_eq!(*beam, []);
    }

    #[test]
    fn the_published_tables_are_complete() {
        let published = Published::read(workspace_root()).expect("the files are there");
        for case in Case::ALL {
            let facts = published.of(case);
            let cells: Vec<Limits> = facts.grid.cells.keys().copied().collect();
            assert_eq!(cells, case.grid());
            assert!(Adaptive::ALL.iter().all(|setting| facts.adaptive[setting].is_some()));
        }
    }
}
