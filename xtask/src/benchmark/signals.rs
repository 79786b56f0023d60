//! The last periods of a level's signals: a small table beside the rows, and a picture of all levels.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use plotters::coord::Shift;
use plotters::prelude::*;

use super::case::Case;
use super::row::six_digits;
use super::signal::last_samples;

/// Periods that are kept and drawn.
const PERIODS: usize = 2;
/// Width of the picture and height of a signal's part of it, in points.
const SIZE: (u32, u32) = (640, 170);
/// Colours that colour-blind readers tell apart (Okabe and Ito 2008), one a level.
const COLOURS: [RGBColor; 4] =
    [RGBColor(86, 180, 233), RGBColor(0, 158, 115), RGBColor(213, 94, 0), RGBColor(0, 0, 0)];

/// Samples by column; `time` is that since the beginning of the last period \[s\].
pub(super) type Samples = BTreeMap<String, Vec<f64>>;

/// The last periods of what a case compares, the periods those of the signal that ends its runs. Nothing for a case whose
/// runs end elsewhere.
pub(super) fn last(case: &Case, probes: &BTreeMap<String, Vec<f64>>) -> Option<Samples> {
    let until = case.until.as_ref()?;
    let times = probes.get("time")?;
    let (first, origin) = last_samples(times, probes.get(&until.column)?, PERIODS)?;
    let mut samples =
        Samples::from([("time".to_owned(), times[first..].iter().map(|t| t - origin).collect())]);
    for column in columns(case) {
        samples.insert(column.to_owned(), probes.get(column)?[first..].to_vec());
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
pub(super) fn to_csv(samples: &Samples) -> String {
    let names: Vec<&str> = samples.keys().map(String::as_str).collect();
    let mut text = names.join(",") + "\n";
    for i in 0..samples.values().map(Vec::len).min().unwrap_or(0) {
        let cells: Vec<String> = samples.values().map(|column| six_digits(column[i])).collect();
        writeln!(text, "{}", cells.join(",")).expect("a String takes any text");
    }
    text
}

/// A picture of the signals of the levels that there are, one below the other; `levels` are numbers and samples.
pub(super) fn picture(case: &Case, levels: &[(usize, Samples)]) -> Option<String> {
    let columns = columns(case);
    if levels.is_empty() {
        return None;
    }
    let mut picture = String::new();
    {
        let height = SIZE.1 * u32::try_from(columns.len()).ok()?;
        let area = SVGBackend::with_string(&mut picture, (SIZE.0, height)).into_drawing_area();
        area.fill(&WHITE).expect("a String takes any picture");
        for (part, column) in area.split_evenly((columns.len(), 1)).iter().zip(&columns) {
            signal(part, column, &label(case, column), scale(case, column), levels)
                .expect("a String takes any picture");
        }
        area.present().expect("a String takes any picture");
    }
    Some(picture)
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

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

fn signal(
    area: &Area<'_>,
    column: &str,
    label: &str,
    scale: f64,
    levels: &[(usize, Samples)],
) -> Result<(), Box<dyn std::error::Error>> {
    let all = |name: &str, factor: f64| {
        let values = levels.iter().flat_map(|(_, samples)| samples[name].iter().copied());
        let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
            (low.min(factor * value), high.max(factor * value))
        });
        let margin = 0.05 * (high - low).max(f64::MIN_POSITIVE);
        low - margin..high + margin
    };
    let mut chart = ChartBuilder::on(area)
        .margin(8)
        .x_label_area_size(30)
        .y_label_area_size(60)
        .build_cartesian_2d(all("time", 1.0), all(column, scale))?;
    chart
        .configure_mesh()
        .light_line_style(WHITE)
        .x_labels(9)
        .y_labels(5)
        .x_desc("s")
        .y_desc(label)
        .draw()?;
    for ((level, samples), colour) in levels.iter().zip(COLOURS.into_iter().cycle()) {
        let points = samples["time"].iter().zip(&samples[column]).map(|(t, value)| (*t, scale * value));
        chart
            .draw_series(LineSeries::new(points, colour.stroke_width(2)))?
            .label(format!("level {level}"))
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 16, y)], colour.stroke_width(2)));
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::UpperRight)
        .background_style(WHITE.mix(0.8))
        .draw()?;
    Ok(())
}

/// The samples of a table, or the line that is none of it.
pub(super) fn from_csv(text: &str) -> Result<Samples, String> {
    let mut lines = text.lines();
    let names: Vec<&str> = lines.next().unwrap_or_default().split(',').collect();
    let mut columns = vec![Vec::new(); names.len()];
    for line in lines {
        let cells: Vec<f64> = line.split(',').filter_map(|cell| cell.parse().ok()).collect();
        if cells.len() != names.len() {
            return Err(format!("not a row of {}: `{line}`", names.join(",")));
        }
        for (column, cell) in columns.iter_mut().zip(cells) {
            column.push(cell);
        }
    }
    Ok(names.into_iter().map(str::to_owned).zip(columns).collect())
}

#[cfg(test)]
mod tests {
    use super::super::case;
    use super::*;
    use crate::task::workspace_root;

    fn swinging() -> (Case, Samples) {
        let cases = case::all(workspace_root()).expect("the shipped cases");
        let case = cases.into_iter().find(|case| case.name == "cfd3").expect("it is shipped");
        let time: Vec<f64> = (0..400).map(|i| 0.01 * f64::from(i)).collect();
        let sine: Vec<f64> = time.iter().map(|t| (std::f64::consts::TAU * t).sin()).collect();
        let probes = ["time", "body_force_x", "body_force_y"].map(str::to_owned);
        (case, probes.into_iter().zip([time, sine.clone(), sine]).collect())
    }

    #[test]
    fn two_periods_are_kept_and_read_back() {
        let (case, probes) = swinging();
        let samples = last(&case, &probes).expect("periods");
        let time = &samples["time"];
        assert!((time[0] + 1.0).abs() < 0.011, "{}", time[0]);
        assert_eq!(samples.len(), 3);
        let text = to_csv(&samples);
        assert_eq!(to_csv(&from_csv(&text).expect("a table")), text);
        assert!(from_csv("time,x\n1\n").is_err());
    }

    #[test]
    fn the_picture_shows_every_signal_of_every_level() {
        let (case, probes) = swinging();
        let samples = last(&case, &probes).expect("periods");
        let drawn = picture(&case, &[(1, samples.clone()), (2, samples)]).expect("two levels");
        for needed in ["<svg", "drag [N/m]", "lift [N/m]", "level 2"] {
            assert!(drawn.contains(needed), "{needed} is not in the picture");
        }
        assert_eq!(picture(&case, &[]), None);
    }
}
