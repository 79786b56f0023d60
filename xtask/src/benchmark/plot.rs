//! Errors over unknowns as a picture.

use plotters::prelude::*;

use super::row::{Row, number};

/// Width and height in points.
const SIZE: (u32, u32) = (640, 400);
/// Colours that colour-blind readers tell apart (Okabe and Ito 2008).
const COLOURS: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(0, 0, 0),
];
/// Smaller errors are drawn here \[%\].
const FLOOR: f64 = 0.01;

/// The absolute errors of a case over its unknowns, both on logarithmic axes, a line a quantity; the largest target is
/// dashed. Two levels or more are needed to draw anything.
pub(super) fn errors(title: &str, rows: &[&Row]) -> Option<String> {
    let dofs = || rows.iter().map(|row| row.dofs as f64);
    let (fewest, most) = (dofs().fold(f64::INFINITY, f64::min), dofs().fold(0.0, f64::max));
    if fewest >= most {
        return None;
    }
    let worst = rows.iter().map(|row| height(row)).fold(1.0, f64::max);
    let mut picture = String::new();
    draw(&mut picture, title, rows, [0.8 * fewest..1.25 * most, FLOOR..2.0 * worst])
        .expect("a String takes any picture");
    Some(picture)
}

fn height(row: &Row) -> f64 {
    number(&row.error_percent).abs().max(FLOOR)
}

fn draw(
    picture: &mut String,
    title: &str,
    rows: &[&Row],
    [across, up]: [std::ops::Range<f64>; 2],
) -> Result<(), Box<dyn std::error::Error>> {
    let area = SVGBackend::with_string(picture, SIZE).into_drawing_area();
    area.fill(&WHITE)?;
    let target = rows.iter().map(|row| number(&row.target_percent)).fold(0.0, f64::max);
    let ends = [(across.start, target), (across.end, target)];
    let mut chart = ChartBuilder::on(&area)
        .caption(title, ("sans-serif", 16))
        .margin(12)
        .x_label_area_size(40)
        .y_label_area_size(60)
        .build_cartesian_2d(across.log_scale(), up.log_scale())?;
    chart
        .configure_mesh()
        .light_line_style(WHITE)
        .x_labels(5)
        .x_desc("unknowns")
        .y_desc("error [%]")
        .x_label_formatter(&|x| plain(*x))
        .y_label_formatter(&|y| plain(*y))
        .draw()?;
    chart.draw_series(DashedLineSeries::new(ends, 4, 4, BLACK.mix(0.6).into()))?;
    let mut names: Vec<&str> = Vec::new();
    for row in rows {
        if !names.contains(&row.quantity.as_str()) {
            names.push(&row.quantity);
        }
    }
    for (name, colour) in names.into_iter().zip(COLOURS.into_iter().cycle()) {
        let points: Vec<(f64, f64)> = rows
            .iter()
            .filter(|row| row.quantity == name)
            .map(|row| (row.dofs as f64, height(row)))
            .collect();
        chart
            .draw_series(LineSeries::new(points, colour.stroke_width(2)).point_size(3))?
            .label(name)
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 16, y)], colour.stroke_width(2)));
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::LowerLeft)
        .background_style(WHITE.mix(0.8))
        .border_style(BLACK.mix(0.3))
        .draw()?;
    area.present()?;
    Ok(())
}

/// 1000 as `1000`, 0.1 as `0.1`.
fn plain(number: f64) -> String {
    format!("{number:.3e}").parse::<f64>().map_or_else(|_| String::new(), |rounded| rounded.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(dofs: usize, quantity: &str, error: &str) -> Row {
        Row {
            case: "cfd1".into(),
            level: 1,
            quantity: quantity.into(),
            reference: "14.2929".into(),
            ours: "14".into(),
            error_percent: error.into(),
            target_percent: "1".into(),
            dofs,
            steps: 1,
            cpu_seconds: "1".into(),
            coupling_per_step: String::new(),
            simulated_seconds: String::new(),
            repeats_percent: String::new(),
        }
    }

    #[test]
    fn a_picture_names_every_quantity_and_is_the_same_again() {
        let rows = [
            row(1000, "drag", "-1.9"),
            row(4000, "drag", "-0.5"),
            row(1000, "lift", "17"),
            row(4000, "lift", "0"),
        ];
        let rows: Vec<&Row> = rows.iter().collect();
        let picture = errors("CFD1", &rows).expect("two levels");
        for needed in ["<svg", "CFD1", "drag", "lift", "unknowns"] {
            assert!(picture.contains(needed), "{needed} is not in the picture");
        }
        assert!(!picture.contains("NaN"));
        assert_eq!(errors("CFD1", &rows), Some(picture));
        assert_eq!(errors("CFD1", &rows[..1]), None);
    }
}
