//! Tables that grow with the run, one CSV file each.

use std::fmt;
use std::path::PathBuf;

use super::OutputError;
use super::lines::LineFile;
use super::table::{Cell, csv_header, csv_row};

/// A column of a table whose rows are made from values of type `R`.
pub(super) struct Column<R> {
    name: String,
    cell: Box<dyn Fn(&R) -> Cell + Send>,
}

impl<R> Column<R> {
    pub(super) fn new<C: Into<Cell>>(
        name: impl Into<String>,
        value: impl Fn(&R) -> C + Send + 'static,
    ) -> Self {
        Self { name: name.into(), cell: Box::new(move |row| value(row).into()) }
    }
}

/// A CSV file that grows by one row for each value of type `R`. Its first column is the step.
pub(super) struct CsvFile<R> {
    columns: Vec<Column<R>>,
    file: LineFile,
}

impl<R> CsvFile<R> {
    /// A file that holds the header only.
    pub(super) fn create(path: PathBuf, columns: Vec<Column<R>>) -> Result<Self, OutputError> {
        let mut file = LineFile::create(path)?;
        file.append(header(&columns).as_bytes())?;
        Ok(Self { columns, file })
    }

    /// Drops the rows after `step` and goes on behind them; returns the number of rows kept, too.
    pub(super) fn resume(
        path: PathBuf,
        columns: Vec<Column<R>>,
        step: usize,
    ) -> Result<(Self, usize), OutputError> {
        let mut rows = 0;
        let header = header(&columns);
        let file = LineFile::resume(path, |number, line| {
            if number == 1 {
                return if line == header.trim_end() {
                    Ok(true)
                } else {
                    Err("not the columns of this run".to_owned())
                };
            }
            let first = line.split(',').next().unwrap_or_default();
            let kept = first.parse::<usize>().map_err(|_| format!("{first:?} is no step"))? <= step;
            rows += usize::from(kept);
            Ok(kept)
        })?;
        Ok((Self { columns, file }, rows))
    }

    /// Appends a row.
    pub(super) fn append(&mut self, row: &R) -> Result<(), OutputError> {
        self.file.append(self::row(&self.columns, row).as_bytes())
    }

    pub(super) fn file(&self) -> &LineFile {
        &self.file
    }
}

/// The header of a table.
pub(super) fn header<R>(columns: &[Column<R>]) -> String {
    csv_header(&columns.iter().map(|column| &column.name).collect::<Vec<_>>())
}

/// A row of a table.
pub(super) fn row<R>(columns: &[Column<R>], row: &R) -> String {
    let cells: Vec<Cell> = columns.iter().map(|column| (column.cell)(row)).collect();
    csv_row(&cells)
}

impl<R> fmt::Debug for CsvFile<R> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("CsvFile").field("path", &self.file.path()).finish_non_exhaustive()
    }
}
