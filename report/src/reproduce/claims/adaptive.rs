//! C5, C6, C7: what the adaptive settings come to beside fixed ones.

use super::Verdict;
use crate::reproduce::counts::Counts;
use crate::reproduce::facts::Facts;
use crate::reproduce::setting::{Adaptive, Setting};

/// C5: N1-CC needs at most this part of the coupling iterations of N = 1.
const FAR_FEWER: f64 = 0.8;
/// C6: N3-CC needs the coupling iterations of N = inf up to this part.
const SAME: f64 = 0.03;
/// C6: and at most this part of its Newton iterations.
const FEWER: f64 = 0.85;

/// C5.
pub(super) fn one_until_coupled(facts: &Facts) -> Verdict {
    let (Some(ours), Some(one)) = (facts.counts(Setting::Adaptive(Adaptive::N1Cc)), facts.one()) else {
        return Verdict::run_failed();
    };
    let (coupling, newton) = ratios(ours, one);
    Verdict::new(coupling <= FAR_FEWER && newton <= 1.0, evidence(coupling, newton, "N = 1"))
}

/// C6.
pub(super) fn three_until_coupled(facts: &Facts) -> Verdict {
    let (Some(ours), Some(unlimited)) = (facts.counts(Setting::Adaptive(Adaptive::N3Cc)), facts.unlimited())
    else {
        return Verdict::run_failed();
    };
    let (coupling, newton) = ratios(ours, unlimited);
    Verdict::new((coupling - 1.0).abs() <= SAME && newton <= FEWER, evidence(coupling, newton, "N = inf"))
}

/// C7.
pub(super) fn interface_data(facts: &Facts) -> Verdict {
    let newton = |setting| facts.counts(setting).map(Counts::newton);
    let (Some(ours), Some(n1_cc), Some(one)) = (
        newton(Setting::Adaptive(Adaptive::InterfaceData)),
        newton(Setting::Adaptive(Adaptive::N1Cc)),
        facts.one().map(Counts::newton),
    ) else {
        return Verdict::run_failed();
    };
    Verdict::new(
        ours > one && ours > n1_cc,
        format!("{ours} Newton iterations, N = 1 takes {one} and N1-CC {n1_cc}"),
    )
}

fn ratios(ours: Counts, other: Counts) -> (f64, f64) {
    let ratio = |a: usize, b: usize| a as f64 / b as f64;
    (ratio(ours.coupling, other.coupling), ratio(ours.newton(), other.newton()))
}

fn evidence(coupling: f64, newton: f64, other: &str) -> String {
    format!("{coupling:.3} of the coupling and {newton:.3} of the Newton iterations of {other}")
}

#[cfg(test)]
mod tests {
    use super::super::samples::{adaptive, cell, published};
    use super::*;

    #[test]
    fn c5_fails_with_too_many_iterations_of_either_kind() {
        for facts in published() {
            assert_eq!(one_until_coupled(&facts).holds, Some(true));
            let mut coupling = facts.clone();
            adaptive(&mut coupling, Adaptive::N1Cc, |counts| counts.coupling = 867);
            assert_eq!(one_until_coupled(&coupling).holds, Some(false));
            let mut newton = facts;
            adaptive(&mut newton, Adaptive::N1Cc, |counts| counts.fluid = 2000);
            assert_eq!(one_until_coupled(&newton).holds, Some(false));
        }
        let expected = "0.676 of the coupling and 0.810 of the Newton iterations of N = 1";
        assert_eq!(one_until_coupled(&published()[0]).evidence, expected);
    }

    #[test]
    fn c6_fails_off_the_coupling_iterations_or_near_the_newton_iterations_of_inf() {
        for facts in published() {
            assert_eq!(three_until_coupled(&facts).holds, Some(true));
            for percent in [96, 104] {
                let mut coupling = facts.clone();
                cell(&mut coupling, "inf", "inf", |counts| {
                    counts.coupling = counts.coupling * percent / 100;
                });
                assert_eq!(three_until_coupled(&coupling).holds, Some(false));
            }
            let mut newton = facts;
            adaptive(&mut newton, Adaptive::N3Cc, |counts| counts.fluid += counts.fluid / 2);
            assert_eq!(three_until_coupled(&newton).holds, Some(false));
        }
    }

    #[test]
    fn c7_fails_when_it_beats_either() {
        for facts in published() {
            assert_eq!(interface_data(&facts).holds, Some(true));
            for (fluid, structure) in [(800, 800), (300, 300)] {
                let mut cheap = facts.clone();
                adaptive(&mut cheap, Adaptive::InterfaceData, |counts| {
                    *counts = Counts { fluid, structure, ..*counts };
                });
                let expected = fluid + structure > facts.one().expect("published").newton();
                assert_eq!(interface_data(&cheap).holds, Some(expected), "{fluid} + {structure}");
            }
        }
    }

    #[test]
    fn a_setting_that_fails_bears_nothing_out() {
        for mut facts in published() {
            facts.adaptive.values_mut().for_each(|counts| *counts = None);
            for judge in [one_until_coupled, three_until_coupled, interface_data] {
                assert_eq!(judge(&facts).holds, Some(false));
            }
        }
    }
}
