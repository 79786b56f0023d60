//! `docs/accuracy.md`: the rows as diagrams, tables and words.

use partita_charts::axis::rounded;
use partita_charts::work_precision::{Floor, FloorKind};

use super::findings::Findings;
use super::row::{ERROR, Row};
use super::short;
use super::study::Study;
use super::words::{cost, seconds};
use crate::markdown;

const HEAD: &str = "\
# Accuracy against time

<!-- Generated from docs/data/accuracy.csv and studies/: `cargo xtask accuracy` -->

What does one more digit cost? Each study here runs a scene at many settings and measures, for each, the error and the
processor time. The error is the distance from an exact solution, from a published value, or from a reference: a run of its
own with much finer settings. How well such a reference is known, a second, somewhat coarser run tells; errors below that say
nothing, and stand on grey in the diagrams. The time is that of building and stepping a run on one processor, without
reading files and without output; of runs that take less than half a second it is the least of several.

A law `time ~ error^(-b)` is fitted to each curve, by least squares of the logarithms, as far as its error falls: up to where
the reference is no better than the error, or where refining no longer helps. The slope in the diagram is `-1/b`, and one
more digit, a tenth of the error, costs `10^(1/|slope|) = 10^b` times the time.

";

/// The page of these findings.
pub(super) fn text(findings: &[Findings]) -> String {
    let mut text = HEAD.to_owned();
    text.push_str(&format!(
        "`cargo xtask accuracy` repeats everything, keeps what it finds and writes this page; names of studies behind it do so for \
         these alone. `--mode compare` compares the errors with [data/accuracy.csv](data/accuracy.csv): they may differ by {} % or \
         {}, for another processor rounds otherwise. `--mode page` writes the page from the data. A single study, with other settings if wanted, is \
         `partita study studies/NAME.toml`.\n",
        rounded(100.0 * ERROR.part, 2),
        rounded(ERROR.least, 2)
    ));
    text.push_str(&short::section(findings));
    for found in findings {
        text.push_str(&section(found));
    }
    text
}

fn section(found: &Findings) -> String {
    let Study { name, title, remark, scene, .. } = &found.study;
    let mut text = format!("\n## {name}\n\n**{title}**\n\n{}\n\n", remark.trim());
    text.push_str(&format!(
        "The settings are in [studies/{name}.toml](../studies/{name}.toml), the scene is [{}]({scene}/README.md).\n\n",
        scene.rsplit('/').next().unwrap_or(scene)
    ));
    text.push_str(&format!("![{title}]({})\n\n", found.picture()));
    text.push_str(&cheapest(found));
    text.push('\n');
    for choice in found.choices() {
        text.push_str(&format!("* {choice}: {}.\n", law(found, choice)));
    }
    text.push_str(&format!("\n{}\n\n", reference(found)));
    text.push_str(&table(found));
    text
}

fn cheapest(found: &Findings) -> String {
    let wanted = rounded(found.study.wanted, 2);
    let named = |row: &Row| {
        let error = row.error.map_or_else(String::new, |error| rounded(error, 2));
        format!("**{}, {}**: error {error} in {} s", row.choice, row.setting, seconds(row))
    };
    match (found.cheapest(), found.most_accurate()) {
        (Some(row), _) => format!("The cheapest setting for an error of {wanted} is {}.\n", named(row)),
        (None, Some(row)) => {
            format!("No setting reaches an error of {wanted}; the most accurate is {}.\n", named(row))
        }
        (None, None) => "No setting could be run.\n".to_owned(),
    }
}

/// What a digit costs on a curve, and where its error stops.
fn law(found: &Findings, choice: &str) -> String {
    let trend = found.trend(choice);
    let fitted = trend.fit.map(|fit| {
        let digits = rounded(fit.digits(), 2);
        let times = cost(&fit);
        if fit.decades_per_digit <= 0.0 {
            return format!("one more digit costs nothing that the clock could tell ({} settings, {digits} digits)", fit.points);
        }
        format!(
            "one more digit costs {times} times the processor time (slope {}, {} settings over {digits} digits)",
            rounded(fit.slope(), 2),
            fit.points
        )
    });
    let stop = trend.floor.map(|floor| stop(found, choice, floor));
    let words: Vec<String> = fitted.into_iter().chain(stop).collect();
    if words.is_empty() { "too few settings for a law".to_owned() } else { words.join("; ") }
}

fn stop(found: &Findings, choice: &str, Floor { start, error, kind }: Floor) -> String {
    let error = rounded(error, 2);
    let from = found.ran(choice).nth(start).map_or_else(String::new, |row| row.setting.clone());
    match (kind, start) {
        (FloorKind::OtherError, 0) => format!("refining does not change the error, {error}"),
        (FloorKind::OtherError, _) => format!("from {from} on the error no longer falls: {error}"),
        (FloorKind::Reference, 0) => format!("the reference is no better than the errors, {error}"),
        (FloorKind::Reference, _) => {
            format!("from {from} on the reference is no better than the error: {error}")
        }
    }
}

fn reference(found: &Findings) -> String {
    let known = match found.uncertainty() {
        0.0 => "What it is measured against is exact.".to_owned(),
        uncertainty => format!("What it is measured against is known to {}.", rounded(uncertainty, 2)),
    };
    format!(
        "The {}. {known} Errors in *italics* are beyond the law: there refining no longer helps, or the reference does not tell.",
        found.study.error_of()
    )
}

fn table(found: &Findings) -> String {
    let header = [
        "setting",
        "error",
        "CPU [s]",
        "unknowns",
        "steps",
        "coupling it.",
        "Newton, fluid",
        "Newton, structure",
    ];
    let mut lines = Vec::new();
    for choice in found.choices() {
        let mut head = vec![format!("**{choice}**")];
        head.resize(header.len(), String::new());
        lines.push(head);
        lines.extend(found.rows.iter().filter(|row| row.choice == choice).map(|row| line(found, row)));
    }
    markdown::table(&header, &lines)
}

fn line(found: &Findings, row: &Row) -> Vec<String> {
    let error = match row.error {
        None => "failed".to_owned(),
        Some(error) if found.is_on_floor(row) => format!("*{}*", rounded(error, 3)),
        Some(error) => rounded(error, 3),
    };
    let counts = ["unknowns", "steps", "coupling_iterations", "newton_fluid", "newton_structure"];
    let counts = counts.map(|column| row.count(column).to_owned());
    [vec![row.setting.clone(), error, seconds(row)], counts.to_vec()].concat()
}

/// The factor in time for one more digit.
#[cfg(test)]
mod tests {
    use super::*;
    use crate::accuracy::findings::tests::made;

    #[test]
    fn a_section_has_the_diagram_the_table_and_the_law_in_words() {
        let text = text(&[made()]);
        for needed in [
            "## made\n\n**Made: steps**\n\nMade data.",
            "![Made: steps](figures/accuracy-made.svg)",
            "The cheapest setting for an error of 0.01 is **tolerance, level 1**: error 0.002 in 1.1 s.",
            "* steps: one more digit costs 100 times the processor time (slope -0.5, 4 settings over 0.9 digits).",
            "from level 2 on the error no longer falls: 2.1e-4",
            "| **steps** |  |",
            "| level 0 | 0.1 | 0.01 | 7 | 7 | 7 | 7 | 7 |",
            "| level 3 | *2e-4* | 1.3 |",
            "The relative error of the tip. What it is measured against is exact.",
        ] {
            assert!(text.contains(needed), "{needed} is not in\n{text}");
        }
    }
}
