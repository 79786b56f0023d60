//! One row of `docs/data/accuracy.csv`: a setting and what it came to.

use crate::csv::{self, Csv};
use crate::kept::Tolerance;
use crate::task::TaskError;

/// Errors that are the same: another processor rounds otherwise, and where a criterion is met by a hair it may take an iteration
/// more.
pub(super) const ERROR: Tolerance = Tolerance { part: 0.02, least: 1e-7 };

/// A setting of a study.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Row {
    pub(super) study: String,
    /// The curve.
    pub(super) choice: String,
    /// The point of it.
    pub(super) setting: String,
    /// `None` where the run failed.
    pub(super) error: Option<f64>,
    /// Processor time \[s\].
    pub(super) cpu_seconds: Option<f64>,
    /// How well the reference is known, in the unit of the error.
    pub(super) uncertainty: f64,
    /// Columns that are kept as they are, in the order of [`COUNTS`].
    pub(super) counts: Vec<String>,
    /// Why there is no error.
    pub(super) failure: String,
}

pub(super) const COUNTS: [&str; 7] = [
    "unknowns",
    "steps",
    "coupling_iterations",
    "newton_fluid",
    "newton_structure",
    "unconverged_steps",
    "retries",
];

pub(super) fn to_csv(rows: &[Row]) -> Csv {
    let head = ["study", "choice", "setting", "error", "cpu_seconds", "uncertainty"];
    let mut table = Csv::new(head.into_iter().chain(COUNTS).chain(["failure"]));
    let number = |value: Option<f64>| value.map_or_else(String::new, |value| format!("{value:.3e}"));
    for row in rows {
        let mut values = vec![row.study.clone(), row.choice.clone(), row.setting.clone()];
        values.extend([row.error, row.cpu_seconds, Some(row.uncertainty)].map(number));
        values.extend_from_slice(&row.counts);
        values.push(row.failure.clone());
        table.push(values);
    }
    table
}

impl Row {
    /// Reads a kept row.
    pub(super) fn read(row: &csv::Row<'_>) -> Result<Self, TaskError> {
        Self::with_setting(row, "setting")
    }

    /// Reads a row that `partita study` wrote: there a setting is a `refinement` of a choice.
    pub(super) fn of_study(row: &csv::Row<'_>) -> Result<Self, TaskError> {
        Self::with_setting(row, "refinement")
    }

    fn with_setting(row: &csv::Row<'_>, setting: &str) -> Result<Self, TaskError> {
        let text = |column| row.text(column).map(str::to_owned);
        Ok(Self {
            study: text("study")?,
            choice: text("choice")?,
            setting: text(setting)?,
            error: row.optional("error")?,
            cpu_seconds: row.optional("cpu_seconds")?,
            uncertainty: row.value("uncertainty")?,
            counts: COUNTS.into_iter().map(text).collect::<Result<_, _>>()?,
            failure: text("failure")?,
        })
    }

    /// A count, `-` where the run failed.
    pub(super) fn count(&self, column: &str) -> &str {
        let index = COUNTS.iter().position(|name| *name == column).expect("a column of counts");
        if self.counts[index].is_empty() { "-" } else { &self.counts[index] }
    }

    /// Study, choice and setting, as other studies name it.
    pub(super) fn title(&self) -> String {
        format!("{}, {}, {}", self.study, self.choice, self.setting)
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// A row that ran.
    pub(crate) fn row(study: &str, choice: &str, setting: &str, error: f64, cpu_seconds: f64) -> Row {
        Row {
            study: study.to_owned(),
            choice: choice.to_owned(),
            setting: setting.to_owned(),
            error: Some(error),
            cpu_seconds: Some(cpu_seconds),
            uncertainty: 0.0,
            counts: COUNTS.map(|_| "7".to_owned()).to_vec(),
            failure: String::new(),
        }
    }

    #[test]
    fn a_row_is_read_as_it_was_written() {
        let ran = row("a", "b, c", "d", 1.234e-5, 0.25);
        let failed = Row {
            error: None,
            cpu_seconds: None,
            counts: COUNTS.map(|_| String::new()).to_vec(),
            failure: "step 3, it \"diverges\"".to_owned(),
            ..ran.clone()
        };
        let text = to_csv(&[ran.clone(), failed.clone()]).to_text();
        assert!(text.starts_with("study,choice,setting,error,cpu_seconds,"), "{text}");
        let table = Csv::parse(&text).expect("its own text");
        let again: Vec<Row> = table.rows().map(|row| Row::read(&row).expect("its own row")).collect();
        assert_eq!(again, [ran, failed.clone()]);
        assert_eq!(failed.count("steps"), "-");
    }

    #[test]
    fn rows_of_a_study_are_understood() {
        let text = "study,setting,error,cpu_seconds,choice,refinement,value,uncertainty,unknowns,steps,\
                    coupling_iterations,newton_fluid,newton_structure,unconverged_steps,retries,failure\n\
                    s,\"c, r\",0.5,2,c,r,-1,0.01,9,1,2,3,4,0,1,\n";
        let table = Csv::parse(text).expect("a table");
        let row = Row::of_study(&table.rows().next().expect("a row")).expect("all columns");
        assert_eq!((row.title().as_str(), row.error, row.uncertainty), ("s, c, r", Some(0.5), 0.01));
        assert_eq!((row.count("unknowns"), row.count("retries")), ("9", "1"));
    }

    #[test]
    fn small_differences_and_small_errors_agree_and_failures_do_not() {
        let holds = |kept, found| ERROR.holds(kept, found);
        assert!(holds("1e-3", "1.01e-3") && holds("1e-12", "3e-9"));
        assert!(!holds("1e-3", "1.03e-3"));
        assert!(holds("", "") && !holds("", "0"));
    }
}
