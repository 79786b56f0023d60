//! Small tables in files: comma-separated, a header line, quotes where a value needs them.

use std::path::Path;

use partita::output::table::csv_header;

use crate::task::{self, TaskError};

/// A table of text with named columns.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Csv {
    header: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl Csv {
    /// An empty table with these columns.
    pub(crate) fn new<S: Into<String>>(header: impl IntoIterator<Item = S>) -> Self {
        Self { header: header.into_iter().map(Into::into).collect(), rows: Vec::new() }
    }

    /// Adds a row, which has a value for each column.
    pub(crate) fn push(&mut self, row: Vec<String>) {
        assert_eq!(row.len(), self.header.len(), "a row has a value for each column");
        self.rows.push(row);
    }

    /// Reads a file.
    pub(crate) fn read(path: &Path) -> Result<Self, TaskError> {
        let text = task::read(path)?;
        Self::parse(&text).map_err(|what| TaskError::Failed(format!("{}: {what}", path.display())))
    }

    /// Reads a file as values that each have a row.
    pub(crate) fn read_as<T>(
        path: &Path,
        value: impl Fn(Row<'_>) -> Result<T, TaskError>,
    ) -> Result<Vec<T>, TaskError> {
        Self::read(path)?.rows().map(value).collect()
    }

    /// Reads a text.
    pub(crate) fn parse(text: &str) -> Result<Self, String> {
        let mut lines = text.lines().enumerate();
        let (_, header) = lines.next().ok_or("it is empty, without a header")?;
        let mut table = Self { header: values(header), rows: Vec::new() };
        for (index, line) in lines {
            let row = values(line);
            if row.len() != table.header.len() {
                let (found, wanted) = (row.len(), table.header.len());
                return Err(format!("line {}: {found} values, the header names {wanted}", index + 1));
            }
            table.rows.push(row);
        }
        Ok(table)
    }

    /// The file's text.
    pub(crate) fn to_text(&self) -> String {
        std::iter::once(&self.header).chain(&self.rows).map(|values| csv_header(values)).collect()
    }

    /// A row by its place.
    pub(crate) fn row(&self, index: usize) -> Row<'_> {
        Row { header: &self.header, values: &self.rows[index] }
    }

    /// The names of the columns.
    pub(crate) fn header(&self) -> &[String] {
        &self.header
    }

    /// The numbers in a column, `NaN` where a cell holds none; `None` without such a column.
    pub(crate) fn numbers(&self, column: &str) -> Option<Vec<f64>> {
        let index = self.header.iter().position(|name| name == column)?;
        Some(self.rows.iter().map(|row| row[index].parse().unwrap_or(f64::NAN)).collect())
    }

    /// The vectors in two columns.
    pub(crate) fn vectors(&self, columns: [&str; 2]) -> Result<Vec<[f64; 2]>, TaskError> {
        self.rows().map(|row| Ok([row.value(columns[0])?, row.value(columns[1])?])).collect()
    }

    /// The rows, to be asked for values by column.
    pub(crate) fn rows(&self) -> impl Iterator<Item = Row<'_>> {
        self.rows.iter().map(|values| Row { header: &self.header, values })
    }
}

/// One row of a table.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Row<'a> {
    header: &'a [String],
    values: &'a [String],
}

impl<'a> Row<'a> {
    /// The text in a column.
    pub(crate) fn text(&self, column: &str) -> Result<&'a str, TaskError> {
        let index = self.header.iter().position(|name| name == column);
        index
            .map(|index| self.values[index].as_str())
            .ok_or_else(|| TaskError::Failed(format!("no column `{column}` among {}", self.header.join(","))))
    }

    /// The value in a column.
    pub(crate) fn value<T: std::str::FromStr>(&self, column: &str) -> Result<T, TaskError> {
        let text = self.text(column)?;
        text.parse().map_err(|_| TaskError::Failed(format!("column `{column}`: `{text}` is no value for it")))
    }

    /// The value in a column, where there is one.
    pub(crate) fn optional<T: std::str::FromStr>(&self, column: &str) -> Result<Option<T>, TaskError> {
        if self.text(column)?.is_empty() { Ok(None) } else { self.value(column).map(Some) }
    }
}

fn values(line: &str) -> Vec<String> {
    let mut values = vec![String::new()];
    let mut inside = false;
    let mut characters = line.chars().peekable();
    while let Some(character) = characters.next() {
        let last = values.last_mut().expect("there is one from the start");
        match character {
            '"' if inside && characters.peek() == Some(&'"') => {
                characters.next();
                last.push('"');
            }
            '"' => inside = !inside,
            ',' if !inside => values.push(String::new()),
            other => last.push(other),
        }
    }
    values
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_is_read_as_it_was_written() {
        let mut table = Csv::new(["id", "evidence"]);
        table.push(vec!["C1".to_owned(), "(1, 1) is the \"maximum\"".to_owned()]);
        table.push(vec![String::new(), "plain".to_owned()]);
        let text = table.to_text();
        assert_eq!(text, "id,evidence\nC1,\"(1, 1) is the \"\"maximum\"\"\"\n,plain\n");
        assert_eq!(Csv::parse(&text).expect("its own text"), table);
    }

    #[test]
    fn a_short_row_and_a_missing_column_are_found() {
        assert_eq!(Csv::parse("a,b\n1\n").expect_err("short"), "line 2: 1 values, the header names 2");
        let table = Csv::parse("a,b\n1,\n").expect("a table");
        let row = table.rows().next().expect("one row");
        assert_eq!(row.value::<usize>("a").expect("a number"), 1);
        assert_eq!(row.optional::<usize>("b").expect("nothing"), None);
        assert!(row.text("c").is_err() && row.value::<usize>("b").is_err());
    }
}
