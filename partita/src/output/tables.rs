//! The records of a run as CSV tables, made when they are wanted.

use std::fs::File;
use std::io::{self, BufRead, BufReader, ErrorKind, Write};
use std::path::{Path, PathBuf};

use partita_coupling::Record;

use super::csv::{Column, header, row};
use super::{OutputError, RECORDS, record};

/// What has a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rows {
    /// Each coupling iteration, those of steps that failed among them.
    Iterations,
    /// Each finished step.
    Steps,
}

/// Why there is no table.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
pub enum TableError {
    /// The records cannot be read.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Records(#[from] OutputError),
    /// Nobody takes the table.
    #[error(transparent)]
    Write(io::Error),
}

/// Writes the records in the run folder `dir` as a table. A last line that a killed run left unfinished is left out.
///
/// # Errors
/// When the records cannot be read, or `out` refuses.
pub fn write(dir: &Path, rows: Rows, out: &mut impl Write) -> Result<(), TableError> {
    let fields = fields(dir)?;
    match rows {
        Rows::Iterations => each(dir, &record::iteration_columns(&fields), out, |record| match record {
            Record::Iteration(iteration) => Some(iteration),
            Record::Step(_) | Record::Retry(_) => None,
        }),
        Rows::Steps => each(dir, &record::all_step_columns(&fields), out, |record| match record {
            Record::Step(step) => Some(step),
            Record::Iteration(_) | Record::Retry(_) => None,
        }),
    }
}

/// The names of the fields, from the first record that has them.
fn fields(dir: &Path) -> Result<record::FieldNames, TableError> {
    let path = dir.join(RECORDS);
    let file = File::open(&path).map_err(|source| OutputError::Read { path, source })?;
    // What cannot be read is reported with its line when its row is made.
    let records =
        BufReader::new(file).lines().map_while(Result::ok).map_while(|line| serde_json::from_str(&line).ok());
    let names = records.filter_map(|record: Record| match record {
        Record::Iteration(record) => Some(record.fields.map(|field| field.name)),
        Record::Step(record) => Some(record.fields.map(|field| field.name)),
        Record::Retry(_) => None,
    });
    Ok(names.into_iter().next().unwrap_or_else(record::scene_fields))
}

fn each<R>(
    dir: &Path,
    columns: &[Column<R>],
    out: &mut impl Write,
    choose: fn(Record) -> Option<R>,
) -> Result<(), TableError> {
    let path = dir.join(RECORDS);
    let unreadable = |source| OutputError::Read { path: path.clone(), source };
    let mut lines = BufReader::new(File::open(&path).map_err(unreadable)?);
    out.write_all(header(columns).as_bytes()).map_err(TableError::Write)?;
    let mut line = String::new();
    for number in 1.. {
        line.clear();
        match lines.read_line(&mut line) {
            Ok(_) if !line.ends_with('\n') => break,
            Ok(_) => {}
            Err(error) if error.kind() == ErrorKind::InvalidData => {
                return Err(corrupt(&path, number, &error).into());
            }
            Err(source) => return Err(unreadable(source).into()),
        }
        let record = serde_json::from_str(&line).map_err(|error| corrupt(&path, number, &error))?;
        if let Some(record) = choose(record) {
            out.write_all(row(columns, &record).as_bytes()).map_err(TableError::Write)?;
        }
    }
    Ok(())
}

fn corrupt(path: &Path, line: usize, reason: &impl ToString) -> OutputError {
    OutputError::Corrupt { path: PathBuf::from(path), line, reason: reason.to_string() }
}
