//! `docs/data/benchmarks.csv`: a row for each quantity of each level.

use crate::csv::{self, Csv};
use crate::kept::{self, EXACT, Tolerance};
use crate::task::TaskError;

/// One comparison. Numbers are kept as they are written, so that a file that is read and written again is the same.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Row {
    /// Name of the case.
    pub(super) case: String,
    /// From 1, the coarsest.
    pub(super) level: usize,
    /// Name of the quantity.
    pub(super) quantity: String,
    pub(super) reference: String,
    pub(super) ours: String,
    pub(super) error_percent: String,
    pub(super) target_percent: String,
    /// Unknowns of both fields.
    pub(super) dofs: usize,
    pub(super) steps: usize,
    pub(super) cpu_seconds: String,
    /// Coupling iterations a step; empty where nothing is coupled.
    pub(super) coupling_per_step: String,
    /// Time at the end of the run \[s\]; empty where there is no time.
    pub(super) simulated_seconds: String,
    /// How well the last periods repeat each other \[%\]; empty where nobody asked.
    pub(super) repeats_percent: String,
}

const COLUMNS: [&str; 13] = [
    "case",
    "level",
    "quantity",
    "reference",
    "ours",
    "error_percent",
    "target_percent",
    "dofs",
    "steps",
    "cpu_seconds",
    "coupling_per_step",
    "simulated_seconds",
    "repeats_percent",
];

impl Row {
    fn cells(&self) -> [String; 13] {
        [
            self.case.clone(),
            self.level.to_string(),
            self.quantity.clone(),
            self.reference.clone(),
            self.ours.clone(),
            self.error_percent.clone(),
            self.target_percent.clone(),
            self.dofs.to_string(),
            self.steps.to_string(),
            self.cpu_seconds.clone(),
            self.coupling_per_step.clone(),
            self.simulated_seconds.clone(),
            self.repeats_percent.clone(),
        ]
    }

    pub(super) fn read(row: csv::Row<'_>) -> Result<Self, TaskError> {
        let text = |column| row.text(column).map(str::to_owned);
        Ok(Self {
            case: text("case")?,
            level: row.value("level")?,
            quantity: text("quantity")?,
            reference: text("reference")?,
            ours: text("ours")?,
            error_percent: text("error_percent")?,
            target_percent: text("target_percent")?,
            dofs: row.value("dofs")?,
            steps: row.value("steps")?,
            cpu_seconds: text("cpu_seconds")?,
            coupling_per_step: text("coupling_per_step")?,
            simulated_seconds: text("simulated_seconds")?,
            repeats_percent: text("repeats_percent")?,
        })
    }

    /// Whether ours is as near to the reference as was aimed at.
    pub(super) fn meets_its_target(&self) -> bool {
        number(&self.error_percent).abs() <= number(&self.target_percent)
    }
}

/// The number in a cell; not-a-number for anything else.
pub(super) fn number(cell: &str) -> f64 {
    cell.parse().unwrap_or(f64::NAN)
}

/// Six significant digits, without trailing zeros.
pub(super) fn six_digits(number: f64) -> String {
    format!("{number:.5e}").parse::<f64>().map_or_else(|_| number.to_string(), |rounded| rounded.to_string())
}

/// The table of some rows.
pub(super) fn to_csv(rows: &[Row]) -> Csv {
    let mut table = Csv::new(COLUMNS);
    for row in rows {
        table.push(row.cells().to_vec());
    }
    table
}

/// Numbers to five digits, for the file keeps six; times are not compared.
pub(super) fn differences(kept: &Csv, found: &Csv) -> Result<Vec<String>, TaskError> {
    let number = Tolerance { part: 2e-5, least: 0.0 };
    let columns = [("reference", number), ("ours", number), ("dofs", EXACT), ("steps", EXACT)];
    kept::differences(&["case", "level", "quantity"], &columns, kept, found)
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// A level of csm1.
    pub(crate) fn row(level: usize, ours: &str, error: &str) -> Row {
        Row {
            case: "csm1".into(),
            level,
            quantity: "u_y(A) [mm]".into(),
            reference: "-66.1".into(),
            ours: ours.into(),
            error_percent: error.into(),
            target_percent: "1".into(),
            dofs: 120,
            steps: 1,
            cpu_seconds: "0.01".into(),
            coupling_per_step: String::new(),
            simulated_seconds: String::new(),
            repeats_percent: String::new(),
        }
    }

    #[test]
    fn a_file_reads_back_as_it_was_written() {
        let rows = [row(1, "-65.223", "1.327"), row(2, "-65.8375", "0.397")];
        let text = to_csv(&rows).to_text();
        let read = |text: &str| -> Result<Vec<Row>, TaskError> {
            Csv::parse(text).expect("a table").rows().map(Row::read).collect()
        };
        assert_eq!(read(&text).expect("its own rows"), rows);
        assert!(read("case,level\ncsm1,1\n").is_err());
    }

    #[test]
    fn a_repetition_agrees_to_five_digits_whatever_it_cost() {
        let before = row(1, "-65.223", "1.327");
        let slower = Row { cpu_seconds: "7".into(), ..row(1, "-65.2231", "1.326") };
        let found = |row: Row| {
            let [kept, found] = [before.clone(), row].map(|row| to_csv(&[row]));
            differences(&kept, &found).expect("all columns are there").len()
        };
        assert_eq!(found(slower), 0);
        assert_eq!(found(row(1, "-65.233", "1.312")), 1);
        assert_eq!(found(row(2, "-65.223", "1.327")), 2, "one row comes, another goes");
        assert_eq!(found(Row { dofs: 121, ..before.clone() }), 1);
    }

    #[test]
    fn a_target_is_met_from_both_sides() {
        assert!(row(1, "", "-0.99").meets_its_target());
        assert!(row(1, "", "1").meets_its_target());
        assert!(!row(1, "", "-1.01").meets_its_target());
        assert!(!row(1, "", "").meets_its_target());
    }

    #[test]
    fn numbers_have_six_digits() {
        assert_eq!(six_digits(-66.030_830_25), "-66.0308");
        assert_eq!(six_digits(14.3), "14.3");
        assert_eq!(six_digits(0.000_022_812_56), "0.0000228126");
        assert_eq!(six_digits(f64::NAN), "NaN");
    }
}
