//! `docs/beyond-the-paper.md` and its heat maps.

use std::path::Path;

use super::{Variant, read};
use crate::markdown::{percent, prose_table, table};
use crate::report::File;
use crate::reproduce::case::Case;
use crate::reproduce::claims::{CLAIMS, word};
use crate::reproduce::counts::{Count, Counts, deviation, heat_maps};
use crate::reproduce::facts::Facts;
use crate::reproduce::setting::{Adaptive, Limits, Setting};
use crate::task::{self, TaskError};

const FILE: &str = "docs/beyond-the-paper.md";

/// The page and its heat maps.
pub(super) fn files(root: &Path) -> Result<Vec<File>, TaskError> {
    let variants = read(root)?;
    let mut text = INTRODUCTION.to_owned();
    text += &task::read(&root.join("paper/remarks-beyond.md"))?;
    text += &cheapest(&variants);
    text += &claims(&variants);
    let mut files = Vec::new();
    for case in Case::ALL {
        let Some(scene) = variants.iter().find(|variant| variant.case == case) else { continue };
        text += &section(scene);
        for count in [Count::Coupling, Count::Newton] {
            let title = format!("{}: {}", case.scene(), count.title());
            let panels = [
                ("linear convergence", &scene.facts[0].grid),
                ("quadratic convergence", &scene.facts[1].grid),
            ];
            files.push((format!("docs/{}", figure(case, count)), heat_maps(&title, panels, count)));
        }
    }
    files.push((FILE.to_owned(), text));
    Ok(files)
}

const INTRODUCTION: &str = "\
# Beyond the paper: quadratic convergence

<!-- Written by `cargo xtask beyond` from paper/results/beyond.csv and paper/remarks-beyond.md. Do not edit. -->

The counts of the paper show a fluid whose Newton loop converges linearly. Here tables 1 and 2 are run once more with a full
Newton tangent and the residual checked before each solve, so that the loop converges quadratically and a call that enters
converged costs nothing. How many Newton iterations per call are then best? Times are processor times of the whole program.

";

fn figure(case: Case, count: Count) -> String {
    let name = if count == Count::Coupling { "coupling" } else { "newton" };
    format!("figures/{}-beyond-{name}.svg", case.scene())
}

/// The settings of the table by something, the least first.
fn least(facts: &Facts, measure: impl Fn(Setting) -> Option<f64>) -> Option<(Limits, f64)> {
    let values =
        facts.grid.cells.keys().filter_map(|&limits| Some((limits, measure(Setting::Fixed(limits))?)));
    values.min_by(|a, b| a.1.total_cmp(&b.1))
}

fn newton(facts: &Facts) -> impl Fn(Setting) -> Option<f64> + '_ {
    |setting| facts.counts(setting).map(|counts| counts.newton() as f64)
}

fn time(facts: &Facts) -> impl Fn(Setting) -> Option<f64> + '_ {
    |setting| facts.costs.iter().find(|cost| cost.setting == setting).map(|cost| cost.cpu_seconds)
}

/// For every variant: where the least is, by Newton total and by time.
fn cheapest(variants: &[Variant]) -> String {
    let header = [
        "",
        "values",
        "convergence",
        "least Newton total",
        "at (1, 1)",
        "at (2, 2)",
        "N1-CC",
        "least time \\[s\\]",
        "at (1, 1)",
        "N1-CC",
    ];
    let mut rows = Vec::new();
    for variant in variants {
        for (index, facts) in variant.facts.iter().enumerate() {
            let shown = |found: Option<(Limits, f64)>, digits: usize| {
                found
                    .map_or_else(|| "-".to_owned(), |(limits, value)| format!("{value:.digits$} at {limits}"))
            };
            let number = |value: Option<f64>, digits: usize| {
                value.map_or_else(|| "fails".to_owned(), |value| format!("{value:.digits$}"))
            };
            let (two, one) = (Setting::Fixed(TWO), Setting::Fixed(Limits::ONE));
            let n1_cc = Setting::Adaptive(Adaptive::N1Cc);
            rows.push(vec![
                variant.case.short().to_owned(),
                variant.label.clone(),
                super::Convergence::BOTH[index].word().to_owned(),
                shown(least(facts, newton(facts)), 0),
                number(newton(facts)(one), 0),
                number(newton(facts)(two), 0),
                number(newton(facts)(n1_cc), 0),
                shown(least(facts, time(facts)), 2),
                number(time(facts)(one), 2),
                number(time(facts)(n1_cc), 2),
            ]);
        }
    }
    format!(
        "\n## Which limits are cheapest?\n\nThe least is sought among fixed limits (all of the paper's for the scene, 1, 2 and \
         inf for the others); N1-CC stands beside it.\n\n{}",
        prose_table(&header, &rows)
    )
}

const TWO: Limits = Limits {
    fluid: crate::reproduce::setting::Limit::AtMost(2),
    structure: crate::reproduce::setting::Limit::AtMost(2),
};

/// Which of the paper's claims about counts survive.
fn claims(variants: &[Variant]) -> String {
    let counted: Vec<_> = CLAIMS.iter().filter(|claim| !["C8", "C9", "C10"].contains(&claim.id)).collect();
    let header: Vec<&str> =
        ["", "values", "convergence"].into_iter().chain(counted.iter().map(|claim| claim.id)).collect();
    let mut rows = Vec::new();
    for variant in variants {
        for (index, facts) in variant.facts.iter().enumerate() {
            let mut row = vec![
                variant.case.short().to_owned(),
                variant.label.clone(),
                super::Convergence::BOTH[index].word().to_owned(),
            ];
            row.extend(counted.iter().map(|claim| {
                claim.on(facts).map(|verdict| word(verdict.holds).to_owned()).unwrap_or_default()
            }));
            rows.push(row);
        }
    }
    format!(
        "\n## The paper's claims\n\nAs [the reproduction](reproduction.md) states them.\n\n{}",
        prose_table(&header, &rows)
    )
}

/// The tables of a scene.
fn section(scene: &Variant) -> String {
    let [linear, quadratic] = &scene.facts;
    let columns = quadratic.grid.structure_limits();
    let header: Vec<String> = std::iter::once("N^f".to_owned())
        .chain(columns.iter().map(|limit| format!("N^s = {limit}")))
        .collect();
    let mut text = format!(
        "\n## {}\n\nEach cell: with quadratic convergence / with linear convergence (difference).\n",
        scene.case.scene()
    );
    for count in Count::ALL {
        let rows: Vec<Vec<String>> = quadratic
            .grid
            .fluid_limits()
            .into_iter()
            .map(|fluid| {
                let cells = columns.iter().map(|&structure| {
                    let at = |facts: &Facts| facts.grid.get(Limits { fluid, structure });
                    cell(at(quadratic), at(linear), count)
                });
                std::iter::once(fluid.to_string()).chain(cells).collect()
            })
            .collect();
        text += &format!("\n### {}\n\n{}", count.title(), table(&header, &rows));
    }
    let rows: Vec<Vec<String>> = Adaptive::ALL
        .into_iter()
        .map(|adaptive| {
            let setting = Setting::Adaptive(adaptive);
            let cells =
                Count::ALL.map(|count| cell(quadratic.counts(setting), linear.counts(setting), count));
            std::iter::once(adaptive.title().to_owned()).chain(cells).collect()
        })
        .collect();
    text += &format!(
        "\n### Adaptive limits\n\n{}",
        table(&["", "coupling", "Newton total", "fluid", "structure"], &rows)
    );
    for count in [Count::Coupling, Count::Newton] {
        text += &format!("\n![{}, {}]({})\n", scene.case.scene(), count.title(), figure(scene.case, count));
    }
    text
}

fn cell(quadratic: Option<Counts>, linear: Option<Counts>, count: Count) -> String {
    match (quadratic.map(|counts| count.of(counts)), linear.map(|counts| count.of(counts))) {
        (Some(ours), Some(other)) => format!("{ours} / {other} ({})", percent(deviation(ours, other))),
        (ours, other) => {
            let shown =
                |value: Option<usize>| value.map_or_else(|| "fails".to_owned(), |value| value.to_string());
            format!("{} / {}", shown(ours), shown(other))
        }
    }
}
