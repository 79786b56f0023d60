//! The published facts, and ways to spoil them.

use crate::reproduce::counts::Counts;
use crate::reproduce::facts::Facts;
use crate::reproduce::published::Published;
use crate::reproduce::setting::{Adaptive, Limits};
use crate::task::workspace_root;

/// Those of the tank and of the beam.
pub(crate) fn published() -> [Facts; 2] {
    Published::read(workspace_root()).expect("the files are there").facts
}

/// Changes a cell of the grid.
pub(crate) fn cell(facts: &mut Facts, fluid: &str, structure: &str, change: impl Fn(&mut Counts)) {
    let cell = facts.grid.cells.get_mut(&Limits::of(fluid, structure)).expect("a cell of the table");
    change(cell.as_mut().expect("the published tables are complete"));
}

/// Takes a cell of the grid away, as a run does that fails.
pub(crate) fn fail(facts: &mut Facts, fluid: &str, structure: &str) {
    facts.grid.cells.insert(Limits::of(fluid, structure), None);
}

/// Changes a row of table 3.
pub(crate) fn adaptive(facts: &mut Facts, setting: Adaptive, change: impl Fn(&mut Counts)) {
    let counts = facts.adaptive.get_mut(&setting).expect("a row of the table");
    change(counts.as_mut().expect("the published tables are complete"));
}
