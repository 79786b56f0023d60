//! C9: whether Newton iterations measure the run time.

use super::Verdict;
use crate::reproduce::cost::{Prices, time_follows_newton};
use crate::reproduce::facts::Facts;

/// A coupling iteration outside the solvers costs at most this part of the cheaper Newton iteration.
const FAR_LESS: f64 = 0.1;
/// Least rank correlation between wall time and Newton total.
const RANKED: f64 = 0.9;

/// C9.
pub(super) fn newton_measures_time(facts: &Facts) -> Verdict {
    let costs = facts.table_costs();
    let (Some(prices), Some(correlation)) = (Prices::of(&costs), time_follows_newton(&costs)) else {
        return Verdict::unknown("not measured");
    };
    let part = prices.transfer / prices.fluid.min(prices.structure);
    Verdict::new(
        part <= FAR_LESS && correlation >= RANKED,
        format!(
            "a coupling iteration outside the solvers costs {part:.3} of the cheaper Newton iteration, rank \
             correlation {correlation:.2}"
        ),
    )
}

#[cfg(test)]
mod tests {
    use super::super::samples::published;
    use super::*;
    use crate::reproduce::facts::Cost;
    use crate::reproduce::setting::Setting;
    use partita::output::Seconds;

    /// Costs of the published counts, had every iteration cost the same.
    fn priced(facts: &mut Facts, transfer: f64) {
        let cells = facts.grid.cells.iter().filter_map(|(&limits, counts)| Some((limits, (*counts)?)));
        facts.costs = cells
            .map(|(limits, counts)| {
                let seconds = Seconds {
                    fluid: counts.fluid as f64,
                    structure: counts.structure as f64,
                    transfer: transfer * counts.coupling as f64,
                    ..Seconds::default()
                };
                let wall_seconds = seconds.fluid + seconds.structure + seconds.transfer;
                let setting = Setting::Fixed(limits);
                Cost { setting, counts, wall_seconds, cpu_seconds: wall_seconds, seconds }
            })
            .collect();
    }

    #[test]
    fn c9_fails_when_the_transfer_is_dear_or_the_order_is_another() {
        for mut facts in published() {
            assert_eq!(newton_measures_time(&facts).holds, None);
            priced(&mut facts, 0.01);
            assert_eq!(newton_measures_time(&facts).holds, Some(true));
            priced(&mut facts, 0.2);
            assert_eq!(newton_measures_time(&facts).holds, Some(false));
            priced(&mut facts, 0.01);
            facts.costs.iter_mut().for_each(|cost| cost.wall_seconds = 1.0 / cost.wall_seconds);
            assert_eq!(newton_measures_time(&facts).holds, Some(false));
        }
    }
}
