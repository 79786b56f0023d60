//! The paper's tables side by side with ours, and how far they are apart.

use super::heat_map_path;
use crate::markdown::{percent, table};
use crate::reproduce::case::Case;
use crate::reproduce::counts::{Count, Counts, deviation};
use crate::reproduce::facts::Facts;
use crate::reproduce::published::Published;
use crate::reproduce::setting::{Adaptive, Limits, Setting};

/// Deviations up to these parts are counted.
const CLASSES: [f64; 3] = [0.05, 0.10, 0.25];

/// Table 1 or 2 with its heat maps.
pub(super) fn grid_section(facts: &Facts, published: &Published) -> String {
    let (case, reference) = (facts.case, published.of(facts.case));
    let mut text = format!(
        "\n## Table {}: {}\n\nEach cell: ours / published (deviation). Rows are N^f, columns N^s.\n",
        case.table(),
        title(case)
    );
    let columns = reference.grid.structure_limits();
    let header: Vec<String> = std::iter::once("N^f".to_owned())
        .chain(columns.iter().map(|limit| format!("N^s = {limit}")))
        .collect();
    for count in Count::ALL {
        let rows: Vec<Vec<String>> = reference
            .grid
            .fluid_limits()
            .into_iter()
            .map(|fluid| {
                let cells = columns.iter().map(|&structure| {
                    let setting = Setting::Fixed(Limits { fluid, structure });
                    let mark = if count == Count::Structure && misprinted(published, case, setting) {
                        " \\*"
                    } else {
                        ""
                    };
                    cell(facts.counts(setting), reference.counts(setting), count) + mark
                });
                std::iter::once(fluid.to_string()).chain(cells).collect()
            })
            .collect();
        text += &format!("\n### {}\n\n{}", count.title(), table(&header, &rows));
    }
    text += &footnote(published, case);
    for count in [Count::Coupling, Count::Newton] {
        text += &format!("\n![{}, {}]({})\n", title(case), count.title(), heat_map_path(case, count));
    }
    text
}

fn title(case: Case) -> &'static str {
    match case {
        Case::Tank => "tank with elastic bottom",
        Case::Beam => "elastic beam in channel flow",
    }
}

fn misprinted(published: &Published, case: Case, setting: Setting) -> bool {
    published.misprints[case as usize].iter().any(|misprint| Setting::Fixed(misprint.limits) == setting)
}

/// What is wrong in the printed table, if something is.
fn footnote(published: &Published, case: Case) -> String {
    let misprints = &published.misprints[case as usize];
    if misprints.is_empty() {
        return String::new();
    }
    let cells: Vec<String> =
        misprints.iter().map(|m| format!("{}: {} for {}", m.limits, m.printed, m.derived)).collect();
    format!(
        "\n\\* Printed otherwise, but then fluid and structure do not add up to the printed total; the difference of total \
         and fluid is taken (printed for taken: {}). In the row N^f = 1 the printed counts fit no other row, in cell \
         (inf, 2) two digits are swapped.\n",
        cells.join("; ")
    )
}

/// "ours / published (deviation)".
fn cell(ours: Option<Counts>, published: Option<Counts>, count: Count) -> String {
    let published = count.of(published.expect("the published tables are complete"));
    match ours.map(|counts| count.of(counts)) {
        None => format!("fails / {published}"),
        Some(ours) => format!("{ours} / {published} ({})", percent(deviation(ours, published))),
    }
}

/// Table 3.
pub(super) fn adaptive_section(ours: &[Facts; 2], published: &Published) -> String {
    let header = ["", "case", "coupling", "Newton total", "fluid", "structure"];
    let mut rows = Vec::new();
    for setting in Adaptive::ALL {
        for facts in ours {
            let reference = published.of(facts.case).counts(Setting::Adaptive(setting));
            let cells =
                Count::ALL.map(|count| cell(facts.counts(Setting::Adaptive(setting)), reference, count));
            let start = [setting.title().to_owned(), facts.case.short().to_owned()];
            rows.push(start.into_iter().chain(cells).collect());
        }
    }
    format!(
        "\n## Table 3: adaptive limits\n\nEach cell: ours / published (deviation).\n\n{}",
        table(&header, &rows)
    )
}

/// How many cells lie within each class of deviation, by table and count.
pub(super) fn distribution(ours: &[Facts; 2], published: &Published) -> String {
    let mut rows = Vec::new();
    let mut main = [0; CLASSES.len() + 1];
    let mut line = |name: &str, count: Count, pairs: &[(Option<Counts>, Counts)]| {
        let within = CLASSES.map(|class| {
            let near = |&&(ours, reference): &&(Option<Counts>, Counts)| {
                ours.is_some_and(|ours| deviation(count.of(ours), count.of(reference)).abs() <= class)
            };
            pairs.iter().filter(near).count()
        });
        let numbers = [pairs.len()].into_iter().chain(within);
        if matches!(count, Count::Coupling | Count::Newton) {
            main.iter_mut().zip(numbers.clone()).for_each(|(sum, number)| *sum += number);
        }
        let mut row = vec![name.to_owned(), count.title().to_lowercase()];
        row.extend(numbers.map(|number| number.to_string()));
        rows.push(row);
    };
    for facts in ours {
        let reference = published.of(facts.case);
        let pairs: Vec<_> = reference
            .grid
            .cells
            .iter()
            .map(|(&limits, counts)| {
                (facts.grid.get(limits), counts.expect("the published tables are complete"))
            })
            .collect();
        for count in Count::ALL {
            line(&facts.case.table().to_string(), count, &pairs);
        }
    }
    let settings = || Adaptive::ALL.into_iter().map(Setting::Adaptive);
    let pairs: Vec<_> = ours
        .iter()
        .flat_map(|facts| {
            settings().map(|setting| {
                let reference = published.of(facts.case).counts(setting);
                (facts.counts(setting), reference.expect("the published tables are complete"))
            })
        })
        .collect();
    for count in Count::ALL {
        line("3", count, &pairs);
    }
    let header = ["table", "count", "cells", "within 5 %", "within 10 %", "within 25 %"];
    let [cells, five, ten, quarter] = main;
    format!(
        "Of {cells} published numbers of coupling iterations and Newton totals {five} are met within 5 %, {ten} within \
         10 %, {quarter} within 25 %.\n\n{}",
        table(&header, &rows)
    )
}
