//! C1, C3, C4: what the limits do to the number of coupling iterations.

use super::Verdict;
use crate::reproduce::counts::{Counts, Grid};
use crate::reproduce::facts::Facts;
use crate::reproduce::setting::Limit;

/// C1: N^f = inf stays at least this part below N^f = 1.
const SAVING: f64 = 0.15;
/// C4: coupling iterations of a row vary at most by this part.
const VARIATION: f64 = 0.01;

/// C1.
pub(super) fn fluid_iterations_save_coupling(facts: &Facts) -> Verdict {
    let Some(columns) = columns(&facts.grid) else { return Verdict::run_failed() };
    let mut least = (f64::INFINITY, Limit::ToConvergence);
    for (structure, column) in columns {
        if let Some(above) = above_first(&column) {
            return Verdict::new(false, format!("N^s = {structure}: {above}"));
        }
        let (one, unlimited) = ends(&column);
        let saving = 1.0 - unlimited / one;
        if saving < least.0 {
            least = (saving, structure);
        }
    }
    let (saving, structure) = least;
    Verdict::new(
        saving >= SAVING,
        format!("N^f = inf saves at least {:.0} % (at N^s = {structure})", 100.0 * saving),
    )
}

/// C3.
pub(super) fn structure_iterations_save_coupling(facts: &Facts) -> Verdict {
    let Some(rows) = rows(&facts.grid) else { return Verdict::run_failed() };
    let above: Vec<String> = rows
        .iter()
        .filter_map(|(fluid, row)| Some(format!("N^f = {fluid}: {}", above_first(row)?)))
        .collect();
    if above.is_empty() {
        Verdict::new(true, format!("N^s = 1 is the maximum of all {} rows", rows.len()))
    } else {
        Verdict::new(false, above.join(", "))
    }
}

/// C4.
pub(super) fn structure_iterations_do_not_matter(facts: &Facts) -> Verdict {
    let Some(rows) = rows(&facts.grid) else { return Verdict::run_failed() };
    let variations = rows.iter().map(|(fluid, row)| {
        let couplings = || row.iter().map(|(_, counts)| counts.coupling as f64);
        let (least, most) = (couplings().fold(f64::INFINITY, f64::min), couplings().fold(0.0, f64::max));
        (most / least - 1.0, *fluid)
    });
    let (variation, fluid) = variations.max_by(|a, b| a.0.total_cmp(&b.0)).expect("a table has rows");
    Verdict::new(
        variation <= VARIATION,
        format!("they vary by at most {:.1} % (at N^f = {fluid})", 100.0 * variation),
    )
}

type Line = Vec<(Limit, Counts)>;

fn columns(grid: &Grid) -> Option<Vec<(Limit, Line)>> {
    grid.structure_limits().into_iter().map(|limit| Some((limit, grid.column(limit)?))).collect()
}

fn rows(grid: &Grid) -> Option<Vec<(Limit, Line)>> {
    grid.fluid_limits().into_iter().map(|limit| Some((limit, grid.row(limit)?))).collect()
}

/// What of a line lies above its first value, if something does.
fn above_first(line: &Line) -> Option<String> {
    let first = line.first().expect("a table has cells").1.coupling;
    let above = line.iter().find(|(_, counts)| counts.coupling > first)?;
    Some(format!("{} at {} exceeds {first} at 1", above.1.coupling, above.0))
}

/// The first and the last value of a line.
fn ends(line: &Line) -> (f64, f64) {
    let at = |counts: &Counts| counts.coupling as f64;
    (at(&line.first().expect("a table has cells").1), at(&line.last().expect("a table has cells").1))
}

#[cfg(test)]
mod tests {
    use super::super::samples::{cell, fail, published};
    use super::*;

    #[test]
    fn c1_fails_when_a_column_rises_or_saves_too_little() {
        let [tank, beam] = published();
        assert_eq!(fluid_iterations_save_coupling(&tank).holds, Some(true));
        assert_eq!(
            fluid_iterations_save_coupling(&beam).evidence,
            "N^f = inf saves at least 34 % (at N^s = 1)"
        );

        let mut rising = tank.clone();
        cell(&mut rising, "3", "2", |counts| counts.coupling = 568);
        let verdict = fluid_iterations_save_coupling(&rising);
        assert_eq!(
            (verdict.holds, verdict.evidence.as_str()),
            (Some(false), "N^s = 2: 568 at 3 exceeds 567 at 1")
        );

        let mut flat = beam;
        cell(&mut flat, "inf", "3", |counts| counts.coupling = 921);
        assert_eq!(fluid_iterations_save_coupling(&flat).holds, Some(false));
        cell(&mut flat, "inf", "3", |counts| counts.coupling = 920);
        assert_eq!(fluid_iterations_save_coupling(&flat).holds, Some(true));
    }

    #[test]
    fn c3_fails_when_a_row_rises() {
        let [mut tank, beam] = published();
        assert_eq!(structure_iterations_save_coupling(&tank).holds, Some(true));
        assert_eq!(structure_iterations_save_coupling(&beam).holds, Some(true));
        cell(&mut tank, "4", "inf", |counts| counts.coupling = 408);
        let verdict = structure_iterations_save_coupling(&tank);
        assert_eq!(
            (verdict.holds, verdict.evidence.as_str()),
            (Some(false), "N^f = 4: 408 at inf exceeds 407 at 1")
        );
    }

    #[test]
    fn c4_fails_when_a_row_varies() {
        let [tank, mut beam] = published();
        assert_eq!(structure_iterations_do_not_matter(&tank).holds, Some(false));
        assert_eq!(structure_iterations_do_not_matter(&beam).holds, Some(true));
        cell(&mut beam, "3", "2", |counts| counts.coupling = 729);
        let verdict = structure_iterations_do_not_matter(&beam);
        assert_eq!(
            (verdict.holds, verdict.evidence.as_str()),
            (Some(false), "they vary by at most 1.1 % (at N^f = 3)")
        );
    }

    #[test]
    fn a_run_that_fails_bears_nothing_out() {
        let [mut tank, _] = published();
        fail(&mut tank, "5", "5");
        for judge in [
            fluid_iterations_save_coupling,
            structure_iterations_save_coupling,
            structure_iterations_do_not_matter,
        ] {
            assert_eq!(judge(&tank).holds, Some(false));
        }
    }
}
