//! The last periods of a level's signals: a small table beside the rows, and a picture of all levels.

use std::collections::BTreeMap;

use partita_charts::plot::{Panel, Plot};

use super::case::{Case, Take};
use super::row::six_digits;
use super::signal::last_samples;
use crate::csv::Csv;

/// Periods that are kept and drawn.
const PERIODS: usize = 2;
/// Samples by column; `time` is that since the beginning of the last period \[s\].
pub(super) type Samples = BTreeMap<String, Vec<f64>>;

/// The last periods of what a case compares, the periods those of the signal that ends its runs. Nothing for a case whose
/// runs end elsewhere.
pub(super) fn last(case: &Case, probes: &Csv) -> Option<Samples> {
    let until = case.until.as_ref()?;
    let times = probes.numbers("time")?;
    let (first, origin) = last_samples(&times, &probes.numbers(&until.column)?, PERIODS)?;
    let mut samples =
        Samples::from([("time".to_owned(), times[first..].iter().map(|t| t - origin).collect())]);
    for column in columns(case) {
        samples.insert(column.to_owned(), probes.numbers(column)?[first..].to_vec());
    }
    Some(samples)
}

/// What is compared, each once, in the order of the case.
fn columns(case: &Case) -> Vec<&str> {
    let mut columns: Vec<&str> = Vec::new();
    for quantity in &case.quantities {
        if !columns.contains(&quantity.column.as_str()) {
            columns.push(&quantity.column);
        }
    }
    columns
}

/// The table of some samples.
pub(super) fn to_csv(samples: &Samples) -> Csv {
    let mut table = Csv::new(samples.keys());
    for i in 0..samples.values().map(Vec::len).min().unwrap_or(0) {
        table.push(samples.values().map(|column| six_digits(column[i])).collect());
    }
    table
}

/// A picture of the signals of the levels that there are, one below the other, over the means and amplitudes of the
/// reference; `levels` are numbers and samples.
pub(super) fn picture(case: &Case, levels: &[(usize, Samples)]) -> Option<String> {
    let panel = |column: &str| {
        let factor = scale(case, column);
        let curve = |(_, samples): &(usize, Samples)| {
            samples["time"].iter().zip(&samples[column]).map(|(t, value)| [*t, factor * value]).collect()
        };
        let [mean, amplitude] = [Take::Mean, Take::Amplitude].map(|take| reference(case, column, take));
        let mean = mean.or_else(|| middle(case, column));
        Panel {
            up: label(case, column),
            curves: levels.iter().map(curve).collect(),
            rules: mean.map(|mean| (mean, String::new())).into_iter().collect(),
            band: mean.zip(amplitude).map(|(mean, amplitude)| [mean - amplitude, mean + amplitude]),
        }
    };
    Plot {
        title: format!("{}: {}", case.name, case.title),
        across: "time since the last period began [s]".to_owned(),
        is_logarithmic: false,
        has_marks: false,
        series: levels.iter().map(|(level, _)| format!("level {level}")).collect(),
        panels: columns(case).into_iter().map(panel).collect(),
        rules: Some("mean of the reference".to_owned()),
        bands: Some("its mean and amplitude".to_owned()),
    }
    .draw()
}

/// A number of the literature about a column, in the unit of the tables.
fn reference(case: &Case, column: &str, take: Take) -> Option<f64> {
    let found = case.quantities.iter().find(|quantity| quantity.column == column && quantity.take == take);
    found.map(|quantity| quantity.reference)
}

/// A mean of the literature that is drawn, but too near to zero to be compared.
fn middle(case: &Case, column: &str) -> Option<f64> {
    case.quantities.iter().filter(|quantity| quantity.column == column).find_map(|quantity| quantity.around)
}

/// Factor to the unit in which a column is compared.
fn scale(case: &Case, column: &str) -> f64 {
    let of_column = case.quantities.iter().filter(|quantity| quantity.column == column);
    of_column.map(|quantity| quantity.scale).fold(1.0, f64::max)
}

/// What is called `u_y(A) amplitude [mm]` in the tables is `u_y(A) [mm]` here.
fn label(case: &Case, column: &str) -> String {
    let name = case
        .quantities
        .iter()
        .find(|quantity| quantity.column == column && !quantity.name.contains("[1/s]"))
        .map_or(column, |quantity| &quantity.name);
    name.replace(" mean", "").replace(" amplitude", "")
}

/// The samples of a table.
pub(super) fn from_csv(table: &Csv) -> Samples {
    let column = |name: &String| Some((name.clone(), table.numbers(name)?));
    table.header().iter().filter_map(column).collect()
}

#[cfg(test)]
mod tests {
    use super::super::case;
    use super::*;
    use crate::task::workspace_root;
    use partita_charts::legible::faults;

    fn swinging() -> (Case, Csv) {
        let cases = case::all(workspace_root()).expect("the shipped cases");
        let case = cases.into_iter().find(|case| case.name == "cfd3").expect("it is shipped");
        let time: Vec<f64> = (0..400).map(|i| 0.01 * f64::from(i)).collect();
        let sine: Vec<f64> = time.iter().map(|t| (std::f64::consts::TAU * t).sin()).collect();
        let mut probes = Csv::new(["time", "body_force_x", "body_force_y"]);
        for (time, sine) in time.iter().zip(&sine) {
            probes.push([time, sine, sine].map(ToString::to_string).to_vec());
        }
        (case, probes)
    }

    #[test]
    fn two_periods_are_kept_and_read_back() {
        let (case, probes) = swinging();
        let samples = last(&case, &probes).expect("periods");
        let time = &samples["time"];
        assert!((time[0] + 1.0).abs() < 0.011, "{}", time[0]);
        assert_eq!(samples.len(), 3);
        let text = to_csv(&samples);
        assert_eq!(to_csv(&from_csv(&text)), text);
    }

    #[test]
    fn every_signal_that_is_compared_has_the_band_of_its_reference() {
        for case in case::all(workspace_root()).expect("the shipped cases") {
            for column in columns(&case).into_iter().filter(|_| case.until.is_some()) {
                let mean = reference(&case, column, Take::Mean).or_else(|| middle(&case, column));
                assert!(mean.is_some(), "{}: {column} has no mean to draw", case.name);
                assert!(reference(&case, column, Take::Amplitude).is_some(), "{}: {column}", case.name);
            }
        }
    }

    #[test]
    fn the_picture_shows_every_signal_of_every_level() {
        let (case, probes) = swinging();
        let samples = last(&case, &probes).expect("periods");
        let drawn = picture(&case, &[(1, samples.clone()), (2, samples)]).expect("two levels");
        assert_eq!(faults(&drawn), Vec::<String>::new());
        for needed in ["<svg", "drag [N/m]", "lift [N/m]", "level 2", "mean of the reference", "amplitude"] {
            assert!(drawn.contains(needed), "{needed} is not in the picture");
        }
        assert_eq!(picture(&case, &[]), None);
    }
}
