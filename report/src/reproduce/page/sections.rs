//! The parts of the page that are not tables of counts.

use crate::markdown::{prose_table, table};
use crate::reproduce::case::Case;
use crate::reproduce::claims::{Judged, word};
use crate::reproduce::cost::{Prices, time_follows, time_follows_newton};
use crate::reproduce::counts::Count;
use crate::reproduce::facts::{Cost, Facts};
use crate::reproduce::substitutes::Substitute;

/// How many claims hold, and which do not.
pub(super) fn held(judged: &[Judged]) -> String {
    let count = |holds| judged.iter().filter(|judged| judged.holds == holds).count();
    let mut text = format!(
        "{} of {} claims hold, {} fail, {} not known.",
        count(Some(true)),
        judged.len(),
        count(Some(false)),
        count(None)
    );
    for judged in judged.iter().filter(|judged| judged.holds == Some(false)) {
        text += &format!(" {} fails.", judged.claim.id);
    }
    text + "\n"
}

/// Every claim with its evidence.
pub(super) fn claims(judged: &[Judged]) -> String {
    let mut rows = Vec::new();
    for judged in judged {
        for (index, (case, verdict)) in judged.verdicts.iter().enumerate() {
            let first = index == 0;
            let once = |text: &str| if first { text.to_owned() } else { String::new() };
            rows.push(vec![
                once(judged.claim.id),
                once(judged.claim.statement),
                case.short().to_owned(),
                word(verdict.holds).to_owned(),
                verdict.evidence.clone(),
            ]);
        }
    }
    format!(
        "\n## Claims\n\nEach is evaluated by code on the results; the same code finds all of them true on the published \
         tables. A claim about both cases holds if it holds on both.\n\n{}",
        prose_table(&["", "claim", "case", "holds", "evidence"], &rows)
    )
}

/// What iterations cost and what that means for the count.
pub(super) fn cost(ours: &[Facts; 2]) -> String {
    let mut text = "\n## Cost, measured\n\nMeans over the settings of tables 1 and 2; wall-clock times of one machine. A \
                    coupling iteration outside the solvers is the transfer of displacements and loads and the \
                    acceleration.\n\n"
        .to_owned();
    let milliseconds = |seconds: f64| format!("{:.3}", 1e3 * seconds);
    let measured: Vec<(Case, Vec<Cost>, Prices)> = ours
        .iter()
        .filter_map(|facts| {
            let costs = facts.table_costs();
            let prices = Prices::of(&costs)?;
            Some((facts.case, costs, prices))
        })
        .collect();
    let rows: Vec<Vec<String>> = measured
        .iter()
        .map(|(case, _, prices)| {
            let Prices { fluid, structure, transfer, mesh_motion } = *prices;
            let times = [fluid, structure, transfer, mesh_motion].map(milliseconds);
            std::iter::once(case.short().to_owned()).chain(times).collect()
        })
        .collect();
    text += &table(
        &[
            "\\[ms\\]",
            "Newton iteration, fluid",
            "Newton iteration, structure",
            "coupling iteration outside the solvers",
            "mesh motion, a coupling iteration",
        ],
        &rows,
    );
    let header = ["rank correlation of wall time with", "Newton total", "fluid", "weighted sum", "coupling"];
    let rows: Vec<Vec<String>> =
        measured.iter().map(|(case, costs, prices)| correlations(*case, costs, prices)).collect();
    text += &format!(
        "\nSpearman's rank correlation over each table's settings. The weighted sum counts an iteration of each field \
         by its price above.\n\n{}",
        table(&header, &rows)
    );
    for (case, costs, prices) in &measured {
        text += &format!("\n{}\n", answer(*case, costs, prices));
    }
    text + &times(ours)
}

fn correlations(case: Case, costs: &[Cost], prices: &Prices) -> Vec<String> {
    let weighted = |cost: &Cost| {
        prices.fluid * cost.counts.fluid as f64 + prices.structure * cost.counts.structure as f64
    };
    let shown = |value: Option<f64>| value.map_or_else(|| "-".to_owned(), |value| format!("{value:.3}"));
    let by = |count: Count| time_follows(costs, |cost| count.of(cost.counts) as f64);
    vec![
        case.short().to_owned(),
        shown(time_follows_newton(costs)),
        shown(by(Count::Fluid)),
        shown(time_follows(costs, weighted)),
        shown(by(Count::Coupling)),
    ]
}

/// A plain answer to: is the total of Newton iterations a good measure of run time?
fn answer(case: Case, costs: &[Cost], prices: &Prices) -> String {
    let Some(correlation) = time_follows_newton(costs) else { return String::new() };
    let ratio = prices.fluid / prices.structure;
    let verdict = if correlation >= 0.9 {
        "puts the settings in the order of their run time"
    } else {
        "does not put the settings in the order of their run time"
    };
    let one = (1.0 / 1.5..1.5).contains(&ratio);
    let reason = if one {
        "an iteration of either field costs about the same".to_owned()
    } else {
        format!(
            "a fluid iteration costs {ratio:.1} times a structure iteration, and the total counts both alike"
        )
    };
    format!(
        "**{}: is the Newton total a good measure of run time?** It {verdict} (rank correlation {correlation:.2}); {reason}. \
         The transfer and the acceleration of a coupling iteration cost {:.1} % of a structure iteration.",
        if case == Case::Tank { "Tank" } else { "Beam" },
        100.0 * prices.transfer / prices.structure
    )
}

/// Run times of the settings.
fn times(ours: &[Facts; 2]) -> String {
    let mut text = String::new();
    let (mut wall, mut cpu, mut runs) = (0.0, 0.0, 0);
    for facts in ours {
        let costs = facts.table_costs();
        wall += facts.costs.iter().map(|cost| cost.wall_seconds).sum::<f64>();
        cpu += facts.costs.iter().map(|cost| cost.cpu_seconds).sum::<f64>();
        runs += facts.costs.len();
        if costs.is_empty() {
            continue;
        }
        let columns = facts.grid.structure_limits();
        let header: Vec<String> = std::iter::once(format!("{}, wall time \\[s\\]: N^f", facts.case.short()))
            .chain(columns.iter().map(|limit| format!("N^s = {limit}")))
            .collect();
        let rows: Vec<Vec<String>> = facts
            .grid
            .fluid_limits()
            .into_iter()
            .map(|fluid| {
                let row = columns.iter().map(|&structure| {
                    let found =
                        costs.iter().find(|cost| cost.setting.to_string() == format!("{fluid}/{structure}"));
                    found.map_or_else(|| "-".to_owned(), |cost| format!("{:.2}", cost.wall_seconds))
                });
                std::iter::once(fluid.to_string()).chain(row).collect()
            })
            .collect();
        text += &format!("\n{}", table(&header, &rows));
    }
    text + &format!(
        "\nAll {runs} runs together: {wall:.0} s one after the other, {cpu:.0} s of processor time.\n"
    )
}

/// The two snapshots of the paper.
pub(super) fn snapshots() -> String {
    let mut text = "\n## Snapshots\n\nThe paper shows each case once in its deformed state. These are ours, at the same \
                    times, deformation to scale.\n"
        .to_owned();
    for (case, what) in [
        (Case::Tank, "The tank at t = 0.2 s: mesh, pressure, and the deformed bottom"),
        (Case::Beam, "The beam at t = 0.25 s: mesh, speed, and the deformed beam"),
    ] {
        text += &format!("\n![{what}]({})\n\n{what}.\n", crate::snapshot::path(case));
    }
    text
}

/// What the paper does not give.
pub(super) fn substituted(substitutes: &[Vec<Substitute>; 2]) -> String {
    let mut text = "\n## What is substituted\n\nThese keys of the scenes hold values, or parts of values, that the paper's \
                    text does not give.\n"
        .to_owned();
    for (case, found) in Case::ALL.into_iter().zip(substitutes) {
        let rows: Vec<Vec<String>> = found
            .iter()
            .map(|Substitute { key, value, comment }| {
                vec![format!("`{key}`"), format!("`{value}`"), comment.clone()]
            })
            .collect();
        text += &format!(
            "\n### {}\n\n{}",
            case.scene(),
            prose_table(&["key", "value", "remark of the scene"], &rows)
        );
    }
    text
}
