//! One table, several renderers: CSV for programs, Markdown for pages, plain text for a terminal.

use std::fmt::{self, Write as _};

/// One value of a table.
#[derive(Debug, Clone, PartialEq)]
pub enum Cell {
    /// Words.
    Text(String),
    /// A whole number.
    Count(usize),
    /// A real number: CSV keeps every digit, the other renderers four.
    Number(f64),
    /// Yes or no.
    Flag(bool),
    /// Nothing to say.
    Empty,
}

impl Cell {
    /// Every digit, so that the value reads back as the same bits.
    fn exact(&self) -> String {
        match self {
            Self::Number(value) => format!("{value:?}"),
            other => other.to_string(),
        }
    }
}

impl fmt::Display for Cell {
    /// Four significant digits.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Text(text) => f.write_str(text),
            Self::Count(count) => write!(f, "{count}"),
            Self::Number(value) => f.write_str(&four_digits(*value)),
            Self::Flag(flag) => write!(f, "{flag}"),
            Self::Empty => Ok(()),
        }
    }
}

impl From<&str> for Cell {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

impl From<String> for Cell {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}

impl From<usize> for Cell {
    fn from(count: usize) -> Self {
        Self::Count(count)
    }
}

impl From<f64> for Cell {
    fn from(value: f64) -> Self {
        Self::Number(value)
    }
}

impl From<bool> for Cell {
    fn from(flag: bool) -> Self {
        Self::Flag(flag)
    }
}

impl<T: Into<Self>> From<Option<T>> for Cell {
    fn from(value: Option<T>) -> Self {
        value.map_or(Self::Empty, Into::into)
    }
}

/// Four significant digits, with an exponent below 1e-3 and from 1e5 on.
fn four_digits(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return format!("{value}");
    }
    let scientific = format!("{value:.3e}");
    let exponent: i32 =
        scientific.rsplit('e').next().and_then(|digits| digits.parse().ok()).unwrap_or_default();
    if (-3..5).contains(&exponent) {
        format!("{value:.*}", usize::try_from(3 - exponent).unwrap_or(0))
    } else {
        scientific
    }
}

/// Columns with a name each, and rows of cells.
///
/// ```
/// use partita::output::table::Table;
///
/// let mut table = Table::new(["field", "Newton iterations"]);
/// table.push(["fluid".into(), 1640.into()]);
/// table.push(["structure".into(), 817.into()]);
/// assert_eq!(table.to_csv(), "field,Newton iterations\nfluid,1640\nstructure,817\n");
/// assert_eq!(
///     table.to_plain(),
///     "field      Newton iterations\n\
///      ---------  -----------------\n\
///      fluid                   1640\n\
///      structure                817\n"
/// );
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    columns: Vec<String>,
    rows: Vec<Vec<Cell>>,
}

impl Table {
    /// A table without rows.
    pub fn new<S: Into<String>>(columns: impl IntoIterator<Item = S>) -> Self {
        Self { columns: columns.into_iter().map(Into::into).collect(), rows: Vec::new() }
    }

    /// Adds a row at the end.
    ///
    /// # Panics
    /// When the row does not have a cell for each column.
    pub fn push(&mut self, row: impl Into<Vec<Cell>>) {
        let row = row.into();
        assert_eq!(row.len(), self.columns.len(), "a row has a cell for each column");
        self.rows.push(row);
    }

    /// Comma-separated values (RFC 4180, lines ended by `\n`), numbers with every digit.
    #[must_use]
    pub fn to_csv(&self) -> String {
        let rows = self.rows.iter().map(|row| csv_row(row));
        std::iter::once(csv_header(&self.columns)).chain(rows).collect()
    }

    /// A table of GitHub's Markdown.
    #[must_use]
    pub fn to_markdown(&self) -> String {
        let escape = |text: String| text.replace('|', "\\|");
        let rows =
            self.rows.iter().map(|row| row.iter().map(|cell| escape(cell.to_string())).collect()).collect();
        let layout =
            Layout::new(self.columns.iter().cloned().map(escape).collect(), rows, self.right_aligned());
        let mut text = layout.line(&layout.head, "| ", " | ", " |");
        let rule = |(width, right): (&usize, &bool)| {
            "-".repeat(width - usize::from(*right)) + if *right { ":" } else { "" }
        };
        let rules: Vec<String> = layout.widths.iter().zip(&layout.right).map(rule).collect();
        text += &layout.line(&rules, "| ", " | ", " |");
        layout.rows.iter().for_each(|row| text += &layout.line(row, "| ", " | ", " |"));
        text
    }

    /// Aligned columns for a terminal.
    #[must_use]
    pub fn to_plain(&self) -> String {
        let rows = self.rows.iter().map(|row| row.iter().map(ToString::to_string).collect()).collect();
        let layout = Layout::new(self.columns.clone(), rows, self.right_aligned());
        let rules: Vec<String> = layout.widths.iter().map(|width| "-".repeat(*width)).collect();
        [&layout.head, &rules]
            .into_iter()
            .chain(&layout.rows)
            .map(|row| layout.line(row, "", "  ", ""))
            .collect()
    }

    /// A column of numbers is aligned at its right; one word in it, and it is a column of text.
    fn right_aligned(&self) -> Vec<bool> {
        let text = |column: usize| self.rows.iter().any(|row| matches!(row[column], Cell::Text(_)));
        (0..self.columns.len()).map(|column| !text(column)).collect()
    }
}

/// The first line of a CSV file.
#[must_use]
pub fn csv_header<S: AsRef<str>>(columns: &[S]) -> String {
    csv_line(columns.iter().map(|column| column.as_ref().to_owned()))
}

/// One line of a CSV file, numbers with every digit.
#[must_use]
pub fn csv_row(cells: &[Cell]) -> String {
    csv_line(cells.iter().map(Cell::exact))
}

fn csv_line(fields: impl Iterator<Item = String>) -> String {
    let quoted = |field: String| {
        if field.contains([',', '"', '\n', '\r']) {
            format!("\"{}\"", field.replace('"', "\"\""))
        } else {
            field
        }
    };
    fields.map(quoted).collect::<Vec<_>>().join(",") + "\n"
}

/// The words of a table and the width of its columns.
struct Layout {
    head: Vec<String>,
    rows: Vec<Vec<String>>,
    widths: Vec<usize>,
    right: Vec<bool>,
}

impl Layout {
    fn new(head: Vec<String>, rows: Vec<Vec<String>>, right: Vec<bool>) -> Self {
        let length = |text: &String| text.chars().count();
        let widest = |column: usize| rows.iter().map(|row| length(&row[column])).max().unwrap_or(0);
        // Markdown needs three characters for its rule.
        let widths =
            head.iter().enumerate().map(|(column, name)| length(name).max(widest(column)).max(3)).collect();
        Self { head, rows, widths, right }
    }

    fn line(&self, words: &[String], start: &str, between: &str, end: &str) -> String {
        let mut line = start.to_owned();
        for (column, word) in words.iter().enumerate() {
            let width = self.widths[column];
            let separator = if column == 0 { "" } else { between };
            if self.right[column] {
                write!(line, "{separator}{word:>width$}")
            } else {
                write!(line, "{separator}{word:<width$}")
            }
            .expect("a String takes any text");
        }
        line += end;
        line.truncate(line.trim_end().len());
        line + "\n"
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample() -> Table {
        let mut table = Table::new(["setting", "N", "residual", "converged"]);
        table.push(["a, \"b\"".into(), 7.into(), 0.1.into(), true.into()]);
        table.push(["c|d".into(), 1200.into(), 1.234_567e-10.into(), Cell::Empty]);
        table
    }

    #[test]
    fn csv_quotes_and_keeps_every_digit() {
        let expected = "setting,N,residual,converged\n\"a, \"\"b\"\"\",7,0.1,true\nc|d,1200,1.234567e-10,\n";
        assert_eq!(sample().to_csv(), expected);
        for value in [0.1 + 0.2, f64::MIN_POSITIVE, -0.0, 1e300, 5e-324, std::f64::consts::PI] {
            let read: f64 = csv_row(&[value.into()]).trim_end().parse().expect("a number");
            assert_eq!(read.to_bits(), value.to_bits());
        }
    }

    #[test]
    fn markdown_escapes_bars_and_aligns_numbers() {
        insta::assert_snapshot!(sample().to_markdown(), @r#"
        | setting |    N |  residual | converged |
        | ------- | ---: | --------: | --------: |
        | a, "b"  |    7 |    0.1000 |      true |
        | c\|d    | 1200 | 1.235e-10 |           |
        "#);
    }

    #[test]
    fn plain_text_has_no_trailing_spaces() {
        insta::assert_snapshot!(sample().to_plain(), @r#"
        setting     N   residual  converged
        -------  ----  ---------  ---------
        a, "b"      7     0.1000       true
        c|d      1200  1.235e-10
        "#);
        assert!(sample().to_plain().lines().all(|line| !line.ends_with(' ')));
    }

    #[test]
    fn numbers_are_shown_with_four_digits() {
        let shown: Vec<String> =
            [0.0, 1.0, -12.345, 123.45, 9999.6, 54321.0, 1e5, 0.001, 0.000_99, f64::INFINITY]
                .map(four_digits)
                .to_vec();
        let expected =
            ["0", "1.000", "-12.35", "123.5", "10000", "54321", "1.000e5", "0.001000", "9.900e-4", "inf"];
        assert_eq!(shown, expected);
    }

    #[test]
    #[should_panic(expected = "a cell for each column")]
    fn a_row_of_another_length_is_a_panic() {
        Table::new(["a", "b"]).push([Cell::Empty]);
    }
}
