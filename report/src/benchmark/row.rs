//! `docs/data/benchmarks.csv`: a row for each quantity of each level.

use std::fmt::Write;

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

const HEAD: &str = "case,level,quantity,reference,ours,error_percent,target_percent,dofs,steps,cpu_seconds,coupling_per_step,simulated_seconds,repeats_percent";

/// Part by which a repeated number may differ: the file keeps six digits.
const SAME: f64 = 2e-5;

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

    fn read(line: &str) -> Option<Self> {
        let cells: Vec<&str> = line.split(',').collect();
        let [
            case,
            level,
            quantity,
            reference,
            ours,
            error,
            target,
            dofs,
            steps,
            cpu,
            coupling,
            time,
            repeats,
        ] = cells[..]
        else {
            return None;
        };
        Some(Self {
            case: case.to_owned(),
            level: level.parse().ok()?,
            quantity: quantity.to_owned(),
            reference: reference.to_owned(),
            ours: ours.to_owned(),
            error_percent: error.to_owned(),
            target_percent: target.to_owned(),
            dofs: dofs.parse().ok()?,
            steps: steps.parse().ok()?,
            cpu_seconds: cpu.to_owned(),
            coupling_per_step: coupling.to_owned(),
            simulated_seconds: time.to_owned(),
            repeats_percent: repeats.to_owned(),
        })
    }

    /// Whether both compare the same thing.
    pub(super) fn is_about_the_same_as(&self, other: &Self) -> bool {
        (&self.case, self.level, &self.quantity) == (&other.case, other.level, &other.quantity)
    }

    /// Whether the other repeats this one, the time left out.
    pub(super) fn agrees_with(&self, other: &Self) -> bool {
        let same = |a: &str, b: &str| a == b || near(a, b);
        self.is_about_the_same_as(other)
            && same(&self.reference, &other.reference)
            && same(&self.ours, &other.ours)
            && (self.dofs, self.steps) == (other.dofs, other.steps)
    }

    /// Whether ours is as near to the reference as was aimed at.
    pub(super) fn meets_its_target(&self) -> bool {
        number(&self.error_percent).abs() <= number(&self.target_percent)
    }
}

fn near(a: &str, b: &str) -> bool {
    let (a, b) = (number(a), number(b));
    (a - b).abs() <= SAME * a.abs().max(b.abs())
}

/// The number in a cell; not-a-number for anything else.
pub(super) fn number(cell: &str) -> f64 {
    cell.parse().unwrap_or(f64::NAN)
}

/// Six significant digits, without trailing zeros.
pub(super) fn six_digits(number: f64) -> String {
    format!("{number:.5e}").parse::<f64>().map_or_else(|_| number.to_string(), |rounded| rounded.to_string())
}

/// The file of some rows.
pub(super) fn to_csv(rows: &[Row]) -> String {
    let mut text = format!("{HEAD}\n");
    for row in rows {
        writeln!(text, "{}", row.cells().join(",")).expect("a String takes any text");
    }
    text
}

/// The rows of a file, or the line that is none.
pub(super) fn from_csv(text: &str) -> Result<Vec<Row>, String> {
    let mut lines = text.lines();
    if lines.next() != Some(HEAD) {
        return Err(format!("the first line is not `{HEAD}`"));
    }
    lines.map(|line| Row::read(line).ok_or_else(|| format!("not a row: `{line}`"))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    pub(super) fn row(level: usize, ours: &str, error: &str) -> Row {
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
        let text = to_csv(&rows);
        assert_eq!(from_csv(&text).expect("a file"), rows);
        assert!(from_csv("case,level\n").is_err());
        assert!(from_csv(&format!("{HEAD}\ncsm1,1\n")).is_err());
    }

    #[test]
    fn a_repetition_agrees_to_five_digits_whatever_it_cost() {
        let before = row(1, "-65.223", "1.327");
        let slower = Row { cpu_seconds: "7".into(), ..row(1, "-65.2231", "1.326") };
        assert!(before.agrees_with(&slower));
        assert!(!before.agrees_with(&row(1, "-65.233", "1.312")));
        assert!(!before.agrees_with(&row(2, "-65.223", "1.327")));
        assert!(!before.agrees_with(&Row { dofs: 121, ..before.clone() }));
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
