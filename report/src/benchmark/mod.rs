//! Published benchmarks, run level by level with the release binary and compared with the literature.
//!
//! A case is described by `benchmark.toml` beside its scene. What comes out is kept in `docs/data/benchmarks.csv`; the
//! page and the pictures are made from that file alone.

mod animate;
mod case;
mod options;
mod page;
mod plot;
mod row;
mod run;
mod signal;
mod signals;

use std::path::{Path, PathBuf};

use case::Case;
use options::{Mode, Options};
use row::Row;
pub(crate) use run::unknowns;

use crate::task::{self, TaskError};

const DATA: &str = "docs/data/benchmarks.csv";
/// Samples of the last periods, a file a level.
const SIGNALS: &str = "docs/data/signals";
const PAGE: &str = "docs/benchmarks.md";
const PICTURES: &str = "docs/benchmarks";

/// Runs the levels that `words` ask for and checks or writes what comes out.
pub(crate) fn run(root: &Path, words: &[&str]) -> Result<(), TaskError> {
    let options = Options::read(words).map_err(TaskError::Failed)?;
    let cases = case::all(root)?;
    let chosen = options.choose(&cases).map_err(TaskError::Failed)?;
    let mut kept = kept_rows(root)?;
    if options.mode == Mode::Page {
        return write(root, &cases, &mut kept);
    }
    let binary = task::release_binary(root)?;
    let folder = binary.parent().and_then(Path::parent).expect("target/release/partita").join("benchmark");
    let mut differing = Vec::new();
    for (case, levels) in chosen {
        for level in levels {
            let run::Found { rows: found, samples, dir } = run::level(root, &binary, case, level, &folder)?;
            print!("{}", table(&found));
            if options.animate {
                let copy = animate::period(&binary, case, &dir, samples.as_ref())?;
                println!("one more period with fields: {}", copy.display());
            }
            match options.mode {
                Mode::Check => differing.extend(differences(&kept, &found)),
                Mode::Write | Mode::Page => {
                    kept.retain(|row| (&row.case, row.level) != (&case.name, level));
                    kept.extend(found);
                    if let Some(samples) = samples {
                        put(&samples_file(root, case, level), &signals::to_csv(&samples))?;
                    }
                    // After each level: a task that is cut off keeps what it has.
                    write(root, &cases, &mut kept)?;
                }
            }
        }
    }
    if differing.is_empty() { Ok(()) } else { Err(TaskError::Failed(differing.join("\n"))) }
}

fn kept_rows(root: &Path) -> Result<Vec<Row>, TaskError> {
    let path = root.join(DATA);
    match std::fs::read_to_string(&path) {
        Ok(text) => row::from_csv(&text).map_err(|what| TaskError::Failed(format!("{DATA}: {what}"))),
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(Vec::new()),
        Err(source) => Err(TaskError::File { path, source }),
    }
}

/// Each row found that the kept ones do not have, or have otherwise.
fn differences(kept: &[Row], found: &[Row]) -> Vec<String> {
    let difference = |row: &Row| {
        let Row { case, level, quantity, ours, .. } = row;
        match kept.iter().find(|before| before.is_about_the_same_as(row)) {
            None => Some(format!("{case} level {level}, {quantity}: {ours}, not in {DATA}")),
            Some(before) if !before.agrees_with(row) => Some(format!(
                "{case} level {level}, {quantity}: {ours} (of {} unknowns, {} steps, reference {}), {DATA} has {} ({}, {}, {})",
                row.dofs, row.steps, row.reference, before.ours, before.dofs, before.steps, before.reference
            )),
            Some(_) => None,
        }
    };
    found.iter().filter_map(difference).collect()
}

/// The rows in the order of the cases, and the page and pictures of them.
fn write(root: &Path, cases: &[Case], rows: &mut Vec<Row>) -> Result<(), TaskError> {
    let place = |row: &Row| {
        let case = cases.iter().position(|case| case.name == row.case)?;
        let quantity = cases[case].quantities.iter().position(|quantity| quantity.name == row.quantity)?;
        Some((case, row.level, quantity))
    };
    rows.retain(|row| place(row).is_some());
    rows.sort_by_key(place);
    put(&root.join(DATA), &row::to_csv(rows))?;
    put(&root.join(PAGE), &page::markdown(cases, rows))?;
    for case in cases {
        let of_case: Vec<&Row> = rows.iter().filter(|row| row.case == case.name).collect();
        if let Some(picture) = plot::errors(&case.name, &case.title, &of_case) {
            put(&root.join(PICTURES).join(format!("{}.svg", case.name)), &picture)?;
        }
        if let Some(picture) = signals::picture(case, &kept_samples(root, case)?) {
            put(&root.join(PICTURES).join(format!("{}-signals.svg", case.name)), &picture)?;
        }
    }
    Ok(())
}

fn samples_file(root: &Path, case: &Case, level: usize) -> PathBuf {
    root.join(SIGNALS).join(format!("{}-{level}.csv", case.name))
}

/// The last periods of each level that has been run; nothing for a case without periods.
fn kept_samples(root: &Path, case: &Case) -> Result<Vec<(usize, signals::Samples)>, TaskError> {
    let mut kept = Vec::new();
    for level in 1..=case.levels.len() {
        let path = samples_file(root, case, level);
        if path.is_file() {
            let text = std::fs::read_to_string(&path)
                .map_err(|source| TaskError::File { path: path.clone(), source })?;
            let samples = signals::from_csv(&text)
                .map_err(|what| TaskError::Failed(format!("{}: {what}", path.display())))?;
            kept.push((level, samples));
        }
    }
    Ok(kept)
}

fn put(path: &Path, text: &str) -> Result<(), TaskError> {
    let refused = |source| TaskError::File { path: path.to_owned(), source };
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder).map_err(refused)?;
    }
    std::fs::write(path, text).map_err(refused)
}

fn table(rows: &[Row]) -> String {
    let line = |row: &Row| {
        let mark = if row.meets_its_target() { "" } else { "  above its target" };
        format!(
            "{:<14} {} {:<28} {:>12} {:>12} {:>9} %{mark}\n",
            row.case, row.level, row.quantity, row.reference, row.ours, row.error_percent
        )
    };
    rows.iter().map(line).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::task::workspace_root;

    fn row(level: usize, ours: &str) -> Row {
        Row {
            case: "csm1".into(),
            level,
            quantity: "u_y".into(),
            reference: "-66.1".into(),
            ours: ours.into(),
            error_percent: "1".into(),
            target_percent: "1".into(),
            dofs: 100,
            steps: 1,
            cpu_seconds: "0.01".into(),
            coupling_per_step: String::new(),
            simulated_seconds: String::new(),
            repeats_percent: String::new(),
        }
    }

    #[test]
    fn a_changed_number_and_a_new_row_are_differences() {
        let kept = [row(1, "-65"), row(2, "-66")];
        assert_eq!(differences(&kept, &kept), Vec::<String>::new());
        let found = differences(&kept, &[row(1, "-65.1"), row(2, "-66"), row(3, "-66.1")]);
        assert_eq!(found.len(), 2);
        assert!(found[0].contains("-65.1") && found[0].contains("has -65 "), "{}", found[0]);
        assert!(found[1].contains("not in docs/data/benchmarks.csv"), "{}", found[1]);
    }

    /// Page and pictures say what the data says: nobody has edited one without the other.
    #[test]
    fn the_page_and_the_pictures_are_those_of_the_data() {
        let root = workspace_root();
        let cases = case::all(root).expect("the shipped cases");
        let rows = kept_rows(root).expect("the shipped rows");
        let read = |path: &str| std::fs::read_to_string(root.join(path)).expect(path);
        let hint = "cargo xtask benchmark --mode write";
        assert!(read(PAGE) == page::markdown(&cases, &rows), "{PAGE} is not of {DATA}; {hint}");
        for case in &cases {
            let of_case: Vec<&Row> = rows.iter().filter(|row| row.case == case.name).collect();
            let levels = of_case.len() / case.quantities.len();
            assert_eq!(of_case.len(), levels * case.quantities.len(), "rows of {}", case.name);
            // Runs to a periodic state are long; the page names the levels that are missing.
            assert!(levels == case.levels.len() || case.until.is_some(), "levels of {}", case.name);
            let samples = kept_samples(root, case).expect("the shipped signals");
            assert_eq!(
                samples.len(),
                if case.until.is_some() { levels } else { 0 },
                "signals of {}",
                case.name
            );
            assert!(levels > 0, "{} has no rows", case.name);
            for (file, picture, is_drawn) in [
                (case.name.clone(), plot::errors(&case.name, &case.title, &of_case), levels > 1),
                (format!("{}-signals", case.name), signals::picture(case, &samples), !samples.is_empty()),
            ] {
                let file = format!("{PICTURES}/{file}.svg");
                let kept = root.join(&file).exists().then(|| read(&file));
                assert_eq!(picture.is_some(), is_drawn, "{file}");
                assert!(kept == picture, "{file} is not of the data; {hint}");
            }
        }
    }
}
