//! Our numbers in `paper/results`: written after the runs, read for the pages.

use std::path::{Path, PathBuf};

use partita::output::Seconds;

use super::case::Case;
use super::claims::Judged;
use super::counts::{Count, Counts, deviation};
use super::facts::{Cost, Facts, Relaxation};
use super::published::Published;
use super::setting::{Adaptive, Limits, Setting};
use crate::csv::{Csv, Row};
use crate::kept::{self, COUNT, EXACT};
use crate::report::Table;
use crate::task::TaskError;

const FOLDER: &str = "paper/results";

pub(crate) fn folder(root: &Path) -> PathBuf {
    root.join(FOLDER)
}

/// A file in `paper/results`, from the root of the workspace.
pub(crate) fn path(name: &str) -> String {
    format!("{FOLDER}/{name}")
}

/// A table of `paper/results`.
pub(crate) fn table(
    name: &str,
    rows: Csv,
    differences: fn(&Csv, &Csv) -> Result<Vec<String>, TaskError>,
) -> Table {
    Table { path: path(name), rows, differences }
}

/// Counts of a case at a setting.
pub(crate) fn same_settings(kept: &Csv, found: &Csv) -> Result<Vec<String>, TaskError> {
    same_counts(&["case", "setting"], kept, found)
}

/// Counts in rows that are named by these columns.
pub(crate) fn same_counts(key: &[&str], kept: &Csv, found: &Csv) -> Result<Vec<String>, TaskError> {
    kept::differences(key, &Count::ALL.map(|count| (count.column(), COUNT)), kept, found)
}

/// Facts about a case that nobody ran.
pub(crate) fn nothing(case: Case) -> Facts {
    Facts {
        case,
        grid: super::counts::Grid::default(),
        adaptive: std::collections::BTreeMap::new(),
        relaxation: None,
        longest_structure_call: None,
        costs: Vec::new(),
    }
}

/// The tables, the observations beside them and the times.
pub(crate) fn tables(ours: &[Facts; 2], published: &Published) -> Vec<Table> {
    let grids = ours.iter().filter(|facts| !facts.grid.cells.is_empty()).map(|facts| {
        let rows = grid_table(facts, published.of(facts.case));
        table(&format!("table{}.csv", facts.case.table()), rows, |kept, found| {
            same_counts(&["n_f", "n_s"], kept, found)
        })
    });
    let others = [
        table("table3.csv", adaptive_table(ours, published), same_settings),
        table("observations.csv", observations(ours), |kept, found| {
            let columns =
                [("constant_relaxation", EXACT), ("failing_step", EXACT), ("longest_structure_call", COUNT)];
            kept::differences(&["case"], &columns, kept, found)
        }),
        // Times: the settings are compared, and no number.
        table("cost.csv", cost_table(ours), |kept, found| {
            kept::differences(&["case", "setting"], &[], kept, found)
        }),
    ];
    grids.chain(others).collect()
}

/// Reads them again; what was never run is missing from the facts.
pub(crate) fn read(root: &Path) -> Result<[Facts; 2], TaskError> {
    let folder = folder(root);
    let mut ours = Case::ALL.map(nothing);
    let present = |name: &str| Some(folder.join(name)).filter(|path| path.is_file());
    for facts in &mut ours {
        if let Some(path) = present(&format!("table{}.csv", facts.case.table())) {
            for row in Csv::read(&path)?.rows() {
                let limits = Limits { fluid: row.value("n_f")?, structure: row.value("n_s")? };
                facts.grid.cells.insert(limits, counts_in(row)?);
            }
        }
    }
    if let Some(path) = present("table3.csv") {
        for row in Csv::read(&path)?.rows() {
            ours[row.value::<Case>("case")? as usize].adaptive.insert(row.value("setting")?, counts_in(row)?);
        }
    }
    if let Some(path) = present("observations.csv") {
        for row in Csv::read(&path)?.rows() {
            let facts = &mut ours[row.value::<Case>("case")? as usize];
            facts.longest_structure_call = row.optional("longest_structure_call")?;
            facts.relaxation = match row.text("constant_relaxation")? {
                "converges" => Some(Relaxation::Converges),
                "fails" => Some(Relaxation::Fails { step: row.optional("failing_step")? }),
                _ => None,
            };
        }
    }
    if let Some(path) = present("cost.csv") {
        for row in Csv::read(&path)?.rows() {
            let facts = &mut ours[row.value::<Case>("case")? as usize];
            let setting: Setting = row.value("setting")?;
            if let Some(counts) = facts.counts(setting) {
                facts.costs.push(cost(row, setting, counts)?);
            }
        }
    }
    Ok(ours)
}

/// What the claims come to.
pub(crate) fn claims_table(judged: &[Judged]) -> Csv {
    let mut table = Csv::new(["id", "statement", "holds", "evidence"]);
    for judged in judged {
        let claim = judged.claim;
        table.push(vec![
            claim.id.to_owned(),
            claim.statement.to_owned(),
            judged.word().to_owned(),
            judged.evidence(),
        ]);
    }
    table
}

fn grid_table(facts: &Facts, published: &Facts) -> Csv {
    let mut table = Csv::new(["n_f", "n_s"].into_iter().map(str::to_owned).chain(value_columns()));
    for (&limits, &counts) in &facts.grid.cells {
        let mut row = vec![limits.fluid.to_string(), limits.structure.to_string()];
        row.extend(values(facts, Setting::Fixed(limits), counts, published));
        table.push(row);
    }
    table
}

fn adaptive_table(ours: &[Facts; 2], published: &Published) -> Csv {
    let mut table = Csv::new(["setting", "case"].into_iter().map(str::to_owned).chain(value_columns()));
    for setting in Adaptive::ALL {
        for facts in ours {
            if let Some(&counts) = facts.adaptive.get(&setting) {
                let mut row = vec![setting.to_string(), facts.case.to_string()];
                row.extend(values(facts, Setting::Adaptive(setting), counts, published.of(facts.case)));
                table.push(row);
            }
        }
    }
    table
}

fn value_columns() -> impl Iterator<Item = String> {
    let named = |prefix: &'static str| Count::ALL.map(|count| format!("{prefix}{}", count.column()));
    let ours = named("").into_iter().chain(["wall_seconds".to_owned()]);
    ours.chain(named("published_")).chain(named("deviation_"))
}

/// The values below [`value_columns`].
fn values(facts: &Facts, setting: Setting, counts: Option<Counts>, published: &Facts) -> Vec<String> {
    let reference = published.counts(setting).expect("the published tables are complete");
    let text = |of: &dyn Fn(Counts) -> String| counts.map(of).unwrap_or_default();
    let wall = facts.costs.iter().find(|cost| cost.setting == setting).map(|cost| cost.wall_seconds);
    let ours = Count::ALL.map(|count| text(&|counts| count.of(counts).to_string()));
    let wall = wall.map(|seconds| format!("{seconds:.3}")).unwrap_or_default();
    let theirs = Count::ALL.map(|count| count.of(reference).to_string());
    let deviations = Count::ALL
        .map(|count| text(&|counts| format!("{:.4}", deviation(count.of(counts), count.of(reference)))));
    ours.into_iter().chain([wall]).chain(theirs).chain(deviations).collect()
}

/// The counts in a row, if its run reached its end.
pub(crate) fn counts_in(row: Row<'_>) -> Result<Option<Counts>, TaskError> {
    let count = |count: Count| row.optional(count.column());
    let (coupling, fluid, structure) =
        (count(Count::Coupling)?, count(Count::Fluid)?, count(Count::Structure)?);
    Ok(coupling.zip(fluid).zip(structure).map(|((coupling, fluid), structure)| Counts {
        coupling,
        fluid,
        structure,
    }))
}

fn observations(ours: &[Facts; 2]) -> Csv {
    let mut table = Csv::new(["case", "constant_relaxation", "failing_step", "longest_structure_call"]);
    for facts in ours {
        let (word, step) = match facts.relaxation {
            None => ("", None),
            Some(Relaxation::Converges) => ("converges", None),
            Some(Relaxation::Fails { step }) => ("fails", step),
        };
        let text = |number: Option<usize>| number.map(|number| number.to_string()).unwrap_or_default();
        table.push(vec![
            facts.case.to_string(),
            word.to_owned(),
            text(step),
            text(facts.longest_structure_call),
        ]);
    }
    table
}

const COST_COLUMNS: [&str; 8] = [
    "wall_seconds",
    "cpu_seconds",
    "fluid_seconds",
    "structure_seconds",
    "mesh_motion_seconds",
    "transfer_seconds",
    "acceleration_seconds",
    "output_seconds",
];

fn cost_table(ours: &[Facts; 2]) -> Csv {
    let mut table = Csv::new(["case", "setting"].into_iter().chain(COST_COLUMNS));
    for facts in ours {
        for cost in &facts.costs {
            let Seconds { fluid, structure, mesh_motion, transfer, acceleration, output } = cost.seconds;
            let times = [
                cost.wall_seconds,
                cost.cpu_seconds,
                fluid,
                structure,
                mesh_motion,
                transfer,
                acceleration,
                output,
            ];
            let mut row = vec![facts.case.to_string(), cost.setting.to_string()];
            row.extend(times.map(|seconds| format!("{seconds:.6}")));
            table.push(row);
        }
    }
    table
}

fn cost(row: Row<'_>, setting: Setting, counts: Counts) -> Result<Cost, TaskError> {
    Ok(Cost {
        setting,
        counts,
        wall_seconds: row.value("wall_seconds")?,
        cpu_seconds: row.value("cpu_seconds")?,
        seconds: Seconds {
            fluid: row.value("fluid_seconds")?,
            structure: row.value("structure_seconds")?,
            mesh_motion: row.value("mesh_motion_seconds")?,
            transfer: row.value("transfer_seconds")?,
            acceleration: row.value("acceleration_seconds")?,
            output: row.value("output_seconds")?,
        },
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::task::{self, workspace_root};

    fn ours(published: &Published) -> [Facts; 2] {
        let mut ours = published.facts.clone();
        ours[0].relaxation = Some(Relaxation::Fails { step: Some(1) });
        ours[0].longest_structure_call = Some(5);
        ours[0].grid.cells.insert(Limits::of("2", "3"), None);
        let setting = Setting::Fixed(Limits::ONE);
        let counts = ours[0].counts(setting).expect("published");
        let seconds = Seconds { fluid: 0.25, structure: 0.125, ..Seconds::default() };
        ours[0].costs = vec![Cost { setting, counts, wall_seconds: 0.5, cpu_seconds: 0.375, seconds }];
        ours
    }

    #[test]
    fn results_are_read_as_they_were_written() {
        let published = Published::read(workspace_root()).expect("the files are there");
        let root = tempfile::tempdir().expect("a folder");
        let ours = ours(&published);
        for Table { path, rows, .. } in tables(&ours, &published) {
            task::write(&root.path().join(path), &rows.to_text()).expect("it can be written");
        }
        assert_eq!(read(root.path()).expect("it can be read"), ours);
    }

    #[test]
    fn a_row_holds_counts_published_counts_and_deviations() {
        let published = Published::read(workspace_root()).expect("the files are there");
        let mut ours = ours(&published);
        let counts = Counts { coupling: 598, fluid: 598, structure: 547 };
        ours[0].grid.cells.insert(Limits::ONE, Some(counts));
        let table = grid_table(&ours[0], published.of(Case::Tank)).to_text();
        let lines: Vec<&str> = table.lines().collect();
        assert_eq!(
            lines[0],
            "n_f,n_s,coupling,newton_total,newton_fluid,newton_structure,wall_seconds,published_coupling,\
             published_newton_total,published_newton_fluid,published_newton_structure,deviation_coupling,\
             deviation_newton_total,deviation_newton_fluid,deviation_newton_structure"
        );
        assert_eq!(lines[1], "1,1,598,1145,598,547,0.500,617,1166,617,549,-0.0308,-0.0180,-0.0308,-0.0036");
        assert_eq!(lines[9], "2,3,,,,,,438,1667,875,792,,,,", "a run that failed has no counts");
    }
}
