//! Errors over unknowns as a picture.

use partita_charts::plot::{Panel, Plot, percent};

use super::row::{Row, number};

/// Smaller errors are drawn here \[%\].
const FLOOR: f64 = 0.01;

/// The absolute errors of a case over its unknowns, both on logarithmic axes, a line for each quantity; each target is dashed.
/// Two levels or more are needed to draw anything.
pub(super) fn errors(name: &str, title: &str, rows: &[&Row]) -> Option<String> {
    let mut sizes: Vec<usize> = rows.iter().map(|row| row.dofs).collect();
    sizes.sort_unstable();
    sizes.dedup();
    if sizes.len() < 2 {
        return None;
    }
    let (mut series, mut curves, mut targets) = (Vec::new(), Vec::new(), Vec::new());
    for row in rows {
        let name = with_target(row);
        let index = series.iter().position(|known| *known == name).unwrap_or_else(|| {
            series.push(name);
            curves.push(Vec::new());
            curves.len() - 1
        });
        curves[index].push([row.dofs as f64, height(row)]);
        let target = number(&row.target_percent);
        if !targets.contains(&target) {
            targets.push(target);
        }
    }
    let rules = targets.into_iter().map(|target| (target, percent(target))).collect();
    Plot {
        title: format!("{name}: {title}"),
        across: "unknowns".to_owned(),
        is_logarithmic: true,
        has_marks: true,
        series,
        panels: vec![Panel { up: "error [%]".to_owned(), curves, rules, band: None }],
        rules: Some(format!("targets; errors below {FLOOR} % are drawn there")),
        bands: None,
    }
    .draw()
}

/// A quantity and its target.
fn with_target(row: &Row) -> String {
    format!("{}, target {}", row.quantity, percent(number(&row.target_percent)))
}

fn height(row: &Row) -> f64 {
    number(&row.error_percent).abs().max(FLOOR)
}

#[cfg(test)]
mod tests {
    use super::*;
    use partita_charts::legible::faults;

    fn row(dofs: usize, quantity: &str, error: &str, target: &str) -> Row {
        let of = super::super::row::tests::row(1, "14", error);
        Row { dofs, quantity: quantity.into(), target_percent: target.into(), ..of }
    }

    #[test]
    fn a_picture_names_every_quantity_with_its_target_and_is_the_same_again() {
        let rows = [
            row(1000, "drag", "-1.9", "2"),
            row(4000, "drag", "-0.5", "2"),
            row(1000, "lift", "17", "6"),
            row(4000, "lift", "0", "6"),
        ];
        let rows: Vec<&Row> = rows.iter().collect();
        let picture = errors("cfd1", "CFD1", &rows).expect("two levels");
        for needed in ["<svg", "CFD1", "drag, target 2 %", "lift, target 6 %", ">2 %<", ">6 %<", "unknowns"] {
            assert!(picture.contains(needed), "{needed} is not in the picture");
        }
        assert!(!picture.contains("NaN"));
        assert_eq!(faults(&picture), Vec::<String>::new());
        assert_eq!(errors("cfd1", "CFD1", &rows), Some(picture));
        assert_eq!(errors("cfd1", "CFD1", &rows[..1]), None);
    }
}
