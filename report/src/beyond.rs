//! Tables 1 and 2 once more with quadratic convergence: a full Newton tangent, and the residual checked before each
//! solve.

mod page;

use std::path::Path;

use partita::output::Seconds;

use crate::csv::Csv;
use crate::kept::{self, COUNT};
use crate::options::Abilities;
use crate::report::{File, Found, Report};
use crate::reproduce::case::Case;
use crate::reproduce::counts::Counts;
use crate::reproduce::facts::{Cost, Facts};
use crate::reproduce::results;
use crate::reproduce::setting::{Adaptive, Setting};
use crate::reproduce::study::{Study, carry_out_all};
use crate::runs::Runs;
use crate::sensitivity::variants;
use crate::task::TaskError;

const RESULTS: &str = "beyond.csv";

/// How the fluid converges.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Convergence {
    /// As the scenes do, after the paper: Picard tangent, residual judged after the solve.
    Linear,
    /// Full tangent, residual judged before the solve.
    Quadratic,
}

impl Convergence {
    const BOTH: [Self; 2] = [Self::Linear, Self::Quadratic];

    fn keys(self) -> Vec<String> {
        match self {
            Self::Linear => Vec::new(),
            Self::Quadratic => {
                ["fluid.tangent=full", "fluid.newton.check=before"].map(str::to_owned).to_vec()
            }
        }
    }

    fn word(self) -> &'static str {
        match self {
            Self::Linear => "linear",
            Self::Quadratic => "quadratic",
        }
    }
}

/// The facts of a variant of a case.
struct Variant {
    case: Case,
    label: String,
    /// With linear and with quadratic convergence.
    facts: [Facts; 2],
}

/// Tables 1 and 2 with both.
pub(crate) struct Beyond;

impl Report for Beyond {
    fn abilities(&self) -> Abilities {
        Abilities::of("beyond")
    }

    fn found(&self, runs: Runs) -> Result<Found, TaskError> {
        let mut table = Csv::new(COLUMNS);
        for case in Case::ALL {
            let mut cases = Vec::new();
            let mut studies = Vec::new();
            let variants = variants(&runs.root, &runs.supplies(), case)?;
            for (index, variant) in variants.into_iter().enumerate() {
                for convergence in Convergence::BOTH {
                    let keys = [variant.keys.clone(), convergence.keys()].concat();
                    let small = Study { relaxation: false, ..Study::small(case, keys) };
                    // The scene itself at all settings of the paper.
                    studies.push(if index == 0 { Study { limits: case.grid(), ..small } } else { small });
                    cases.push((variant.label.clone(), convergence));
                }
            }
            for ((label, convergence), facts) in cases.iter().zip(&carry_out_all(&runs, &studies)?) {
                for row in rows(label, *convergence, facts) {
                    table.push(row);
                }
            }
        }
        Ok(Found { tables: vec![results::table(RESULTS, table, differences)], files: Vec::new() })
    }

    fn pages(&self, root: &Path) -> Result<Vec<File>, TaskError> {
        page::files(root)
    }
}

fn differences(kept: &Csv, found: &Csv) -> Result<Vec<String>, TaskError> {
    let columns = ["coupling", "newton_fluid", "newton_structure"].map(|column| (column, COUNT));
    kept::differences(&["case", "variant", "convergence", "setting"], &columns, kept, found)
}

const COLUMNS: [&str; 9] = [
    "case",
    "variant",
    "convergence",
    "setting",
    "coupling",
    "newton_fluid",
    "newton_structure",
    "wall_seconds",
    "cpu_seconds",
];

fn rows(label: &str, convergence: Convergence, facts: &Facts) -> Vec<Vec<String>> {
    let fixed = facts.grid.cells.keys().copied().map(Setting::Fixed);
    let settings = fixed.chain(Adaptive::ALL.map(Setting::Adaptive));
    let row = |setting| {
        let mut row = vec![facts.case.to_string(), label.to_owned(), convergence.word().to_owned()];
        row.push(Setting::to_string(&setting));
        let text = |of: fn(Counts) -> usize| {
            facts.counts(setting).map(|counts| of(counts).to_string()).unwrap_or_default()
        };
        row.extend([text(|c| c.coupling), text(|c| c.fluid), text(|c| c.structure)]);
        let cost = facts.costs.iter().find(|cost| cost.setting == setting);
        let time = |of: fn(&Cost) -> f64| cost.map(|cost| format!("{:.3}", of(cost))).unwrap_or_default();
        row.extend([time(|cost| cost.wall_seconds), time(|cost| cost.cpu_seconds)]);
        row
    };
    settings.map(row).collect()
}

/// Reads the results again.
fn read(root: &Path) -> Result<Vec<Variant>, TaskError> {
    let mut variants: Vec<Variant> = Vec::new();
    for row in Csv::read(&results::folder(root).join(RESULTS))?.rows() {
        let (case, label): (Case, &str) = (row.value("case")?, row.text("variant")?);
        if variants.last().is_none_or(|last| last.case != case || last.label != label) {
            let facts = [results::nothing(case), results::nothing(case)];
            variants.push(Variant { case, label: label.to_owned(), facts });
        }
        let quadratic = row.text("convergence")? == Convergence::Quadratic.word();
        let facts = &mut variants.last_mut().expect("just pushed").facts[usize::from(quadratic)];
        let setting: Setting = row.value("setting")?;
        let counts = results::counts_in(row)?;
        match setting {
            Setting::Fixed(limits) => drop(facts.grid.cells.insert(limits, counts)),
            Setting::Adaptive(adaptive) => drop(facts.adaptive.insert(adaptive, counts)),
        }
        if let Some(counts) = counts {
            let (wall_seconds, cpu_seconds) = (row.value("wall_seconds")?, row.value("cpu_seconds")?);
            let seconds = Seconds::default();
            facts.costs.push(Cost { setting, counts, wall_seconds, cpu_seconds, seconds });
        }
    }
    Ok(variants)
}
