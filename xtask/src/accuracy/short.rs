//! The opening of the page: what all studies say together.

use partita_charts::axis::rounded;
use partita_charts::work_precision::Fit;

use super::findings::{FIRM, Findings, MOVES};
use super::page::{cost, seconds};
use super::row::Row;
use crate::reproduce::markdown;

/// The section `In short`.
pub(super) fn section(findings: &[Findings]) -> String {
    let mut text = "\n## In short\n\n### What does one more digit cost?\n\n".to_owned();
    for (is_of_tolerances, what) in
        [(false, "Refining steps, elements or degree"), (true, "Tightening tolerances")]
    {
        let of = findings.iter().filter(|found| found.study.is_of_tolerances() == is_of_tolerances);
        text.push_str(&price(what, &of.collect::<Vec<_>>()));
    }
    text.push_str(&format!(
        "\nOnly curves with a law through at least {FIRM} settings count here. The cheapest setting for the error that each study \
         wants:\n\n"
    ));
    text.push_str(&overview(findings));
    text.push_str("\n### How loose may the tolerances be before the answer moves?\n");
    for found in findings.iter().filter(|found| found.study.is_of_tolerances()) {
        text.push_str(&looseness(found));
    }
    text
}

/// The least, the middle and the largest price of a digit.
fn price(what: &str, findings: &[&Findings]) -> String {
    let mut laws: Vec<(String, Fit)> = Vec::new();
    for found in findings {
        let named = |(choice, fit)| (format!("{}: {choice}", found.study.name), fit);
        laws.extend(found.firm_laws().into_iter().map(named));
    }
    laws.sort_by(|(_, a), (_, b)| a.decades_per_digit.total_cmp(&b.decades_per_digit));
    let (Some((least, cheap)), Some((most, dear))) = (laws.first(), laws.last()) else {
        return format!("* {what}: no study has a law.\n");
    };
    // The lower of the two in the middle, so that it is a law one can look up.
    let middle = &laws[(laws.len() - 1) / 2].1;
    format!(
        "* **{what}: one more digit costs {}** ({least}) **to {} times the processor time** ({most}); {} in the middle of {} \
         curves.\n",
        cost(cheap),
        cost(dear),
        cost(middle),
        laws.len()
    )
}

fn overview(findings: &[Findings]) -> String {
    let line = |found: &Findings| {
        let mut costs: Vec<(f64, String)> =
            found.firm_laws().iter().map(|(_, fit)| (fit.digit_factor(), cost(fit))).collect();
        costs.sort_by(|a, b| a.0.total_cmp(&b.0));
        let range = match &costs[..] {
            [] => "-".to_owned(),
            [(_, one)] => format!("x {one}"),
            [(_, least), .., (_, most)] => format!("x {least} to {most}"),
        };
        let best = found.cheapest().map_or_else(
            || ["none reaches it".to_owned(), "-".to_owned(), "-".to_owned()],
            |row| [format!("{}, {}", row.choice, row.setting), error(row), seconds(row)],
        );
        let name = format!("[{}](#{})", found.study.name, found.study.name);
        [vec![name, range, rounded(found.study.wanted, 2)], best.to_vec()].concat()
    };
    let header = ["study", "one more digit", "wanted error", "cheapest setting", "its error", "CPU [s]"];
    markdown::prose_table(&header, &findings.iter().map(line).collect::<Vec<_>>())
}

fn looseness(found: &Findings) -> String {
    let title = found.study.title.split(':').next().unwrap_or_default();
    let Some(bound) = found.harmless() else {
        return format!("\n**{title}.** No error of steps or elements is known to compare with.\n");
    };
    let beside: Vec<String> =
        found.beside.iter().map(|row| format!("{} ({})", error(row), row.title())).collect();
    let mut text = format!(
        "\n**{title}.** The scene's own steps and elements leave errors of {}. A tolerance that adds less than a {} of the \
         smallest of these, {}, does not move the answer. The loosest settings from which on that holds:\n\n",
        beside.join(" and "),
        if (MOVES - 0.1).abs() < 1e-12 { "tenth".to_owned() } else { format!("part {MOVES}") },
        rounded(bound, 2),
    );
    let line = |loosest: super::findings::Loosest<'_>| {
        let tight = format!("{}: {} s", loosest.tightest.setting, seconds(loosest.tightest));
        let (setting, error, cpu) = match loosest.row {
            Some(row) => (row.setting.clone(), error(row), seconds(row)),
            None => ("none".to_owned(), "-".to_owned(), "-".to_owned()),
        };
        vec![loosest.choice.to_owned(), setting, error, cpu, tight]
    };
    let header = ["choice", "loosest setting", "error it adds", "CPU [s]", "the tightest setting takes"];
    let lines: Vec<Vec<String>> = found.loosest(bound).into_iter().map(line).collect();
    text.push_str(&markdown::prose_table(&header, &lines));
    text
}

fn error(row: &Row) -> String {
    row.error.map_or_else(|| "-".to_owned(), |error| rounded(error, 2))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accuracy::findings::tests::made;

    #[test]
    fn the_summary_says_what_the_made_data_say() {
        let text = section(&[made()]);
        for needed in [
            "* Refining steps, elements or degree: no study has a law.",
            "* **Tightening tolerances: one more digit costs 100** (made: steps) **to 100 times the processor time**",
            "| [made](#made) | x 100 | 0.01 | tolerance, level 1 | 0.002 | 1.1 |",
            "leave errors of 0.05 (other, A, coarse). A tolerance that adds less than a tenth of the smallest of these, 0.005,",
            "| steps | none | - | - | level 3: 0.64 s |",
            "| tolerance | level 1 | 0.002 | 1.1 | level 3: 1.3 s |",
        ] {
            assert!(text.contains(needed), "{needed} is not in\n{text}");
        }
    }
}
