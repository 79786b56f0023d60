//! The runs behind the rows.

use std::path::Path;
use std::process::Command;
use std::time::Instant;

use super::row::Row;
use super::study::Study;
use crate::csv::Csv;
use crate::task::{self, TaskError};

/// Runs studies, one after the other so that each has the machine to itself.
pub(super) fn studies(root: &Path, names: &[&str]) -> Result<Vec<Row>, TaskError> {
    let binary = task::release_binary(root)?;
    let folder = binary.parent().and_then(Path::parent).expect("target/release/partita").join("accuracy");
    let start = Instant::now();
    let mut rows = Vec::new();
    for name in names {
        let begun = Instant::now();
        let dir = folder.join(name);
        task::remove_folder(&dir)?;
        let mut command = Command::new(&binary);
        command.current_dir(root).arg("study").arg(Study::file(name)).arg("--out").arg(&dir);
        task::run(command)?;
        let table = Csv::read(&dir.join("study.csv"))?;
        let found: Vec<Row> = table.rows().map(|row| Row::of_study(&row)).collect::<Result<_, _>>()?;
        eprintln!("== {name}: {} settings in {:.1} s\n", found.len(), begun.elapsed().as_secs_f64());
        rows.extend(found);
    }
    eprintln!("== {} studies in {:.1} s", names.len(), start.elapsed().as_secs_f64());
    Ok(rows)
}
