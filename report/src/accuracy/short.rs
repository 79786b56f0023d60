//! The opening of the page: what all studies say together.

use partita_charts::axis::rounded;
use partita_charts::work_precision::Fit;

use super::findings::{FIRM, Findings, MOVES};
use super::row::Row;
use super::words::{cost, seconds};
use crate::markdown;

/// The section `In short`.
pub(super) fn section(findings: &[Findings]) -> String {
    let mut text = "\n## In short\n\n### What does one more digit cost?\n\n".to_owned();
    let of = |is_of_tolerances: bool| {
        laws(findings.iter().filter(|found| found.study.is_of_tolerances() == is_of_tolerances))
    };
    let [refining, tightening] = [false, true].map(of);
    text.push_str(&price("Refining steps, elements or degree", &refining));
    text.push_str(&price("Tightening tolerances", &tightening));
    text.push_str(&plainly(&refining, &tightening));
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

/// A law and the curve that it is of.
type Law = (String, Fit);

/// The firm laws of studies, from the cheapest digit to the dearest.
fn laws<'a>(findings: impl Iterator<Item = &'a Findings>) -> Vec<Law> {
    let mut laws = Vec::new();
    for found in findings {
        let named = |(choice, fit)| (format!("{}: {choice}", found.study.name), fit);
        laws.extend(found.firm_laws().into_iter().map(named));
    }
    laws.sort_by(|(_, a), (_, b)| a.decades_per_digit.total_cmp(&b.decades_per_digit));
    laws
}

/// The law in the middle, of two the cheaper one, so that it is a law one can look up.
fn middle(laws: &[Law]) -> Option<&Fit> {
    laws.get(laws.len().saturating_sub(1) / 2).map(|(_, fit)| fit)
}

/// The least, the middle and the largest price of a digit.
fn price(what: &str, laws: &[Law]) -> String {
    let (Some((least, cheap)), Some(middle), Some((most, dear))) = (laws.first(), middle(laws), laws.last())
    else {
        return format!("* {what}: no study has a law.\n");
    };
    format!(
        "* **{what}: one more digit costs {} to {} times the processor time**, {} times in the middle of {} curves. It is \
         cheapest in {least}, and dearest in {most}.\n",
        cost(cheap),
        cost(dear),
        cost(middle),
        laws.len()
    )
}

/// What to do, where the prices of the two kinds tell.
fn plainly(refining: &[Law], tightening: &[Law]) -> String {
    /// The dearer kind costs this many times the other.
    const CLEARLY: f64 = 2.0;
    let (Some(refining), Some(tightening)) = (middle(refining), middle(tightening)) else {
        return String::new();
    };
    if refining.digit_factor() < CLEARLY * tightening.digit_factor() {
        return String::new();
    }
    format!(
        "* Put plainly: a digit that multiplies the time by {} through finer steps and elements multiplies it by {} through \
         tighter tolerances. Tolerances are to be tight enough not to matter; time is to be spent on steps and elements, and \
         saved by better schemes.\n",
        cost(refining),
        cost(tightening)
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
    let time = |row: &Row| row.cpu_seconds.unwrap_or(f64::INFINITY);
    let loosest = found.loosest(bound).into_iter().filter_map(|loosest| loosest.row);
    if let Some(best) = loosest.min_by(|a, b| time(a).total_cmp(&time(b))) {
        let words = format!("{}, {}", best.choice, best.setting);
        text.push_str(&format!("\nThe cheapest of these is **{words}**, in {} s.\n", seconds(best)));
    }
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
            "* **Tightening tolerances: one more digit costs 100 to 100 times the processor time**, 100 times in the middle of 1",
            "It is cheapest in made: steps, and dearest in made: steps.",
            "| [made](#made) | x 100 | 0.01 | tolerance, level 1 | 0.002 | 1.1 |",
            "leave errors of 0.05 (other, A, coarse). A tolerance that adds less than a tenth of the smallest of these, 0.005,",
            "| steps | none | - | - | level 3: 0.64 s |",
            "| tolerance | level 1 | 0.002 | 1.1 | level 3: 1.3 s |",
            "The cheapest of these is **tolerance, level 1**, in 1.1 s.",
        ] {
            assert!(text.contains(needed), "{needed} is not in\n{text}");
        }
    }

    /// One digit for 100 times the time by refining, for 1.1 times by tightening; the reverse says nothing.
    #[test]
    fn the_plain_word_stands_where_the_prices_differ() {
        let law = |decades_per_digit| Fit { offset: 0.0, decades_per_digit, points: 4, errors: [0.1, 0.01] };
        let [dear, cheap] = [2.0, 0.041_39].map(|decades| vec![(String::new(), law(decades))]);
        let words = plainly(&dear, &cheap);
        assert!(
            words.contains("multiplies the time by 100 through finer") && words.contains("by 1.1 through"),
            "{words}"
        );
        assert_eq!(plainly(&cheap, &dear) + &plainly(&dear, &dear) + &plainly(&[], &cheap), "");
    }

    #[test]
    fn laws_stand_in_their_order_and_the_middle_is_one_of_them() {
        let law = |decades_per_digit| Fit { offset: 0.0, decades_per_digit, points: 4, errors: [0.1, 0.01] };
        let laws: Vec<Law> = [0.1, 0.5, 1.0, 2.0].map(|decades| (String::new(), law(decades))).to_vec();
        assert_eq!(middle(&laws), Some(&law(0.5)));
        assert_eq!(middle(&laws[..3]), Some(&law(0.5)));
        assert_eq!(middle(&[]), None);
    }
}
