//! C8, C10: what single runs show.

use super::Verdict;
use crate::reproduce::case::Case;
use crate::reproduce::facts::{Facts, Relaxation};

/// C10: Newton iterations of the longest structure call.
const LONGEST: usize = 3;

/// C8.
pub(super) fn added_mass(facts: &Facts) -> Verdict {
    let Some(relaxation) = facts.relaxation else { return Verdict::unknown("not run") };
    let evidence = match relaxation {
        Relaxation::Converges => "converges".to_owned(),
        Relaxation::Fails { step: Some(step) } => format!("fails in step {step}"),
        Relaxation::Fails { step: None } => "fails".to_owned(),
    };
    let expected = match facts.case {
        Case::Tank => matches!(relaxation, Relaxation::Fails { .. }),
        Case::Beam => relaxation == Relaxation::Converges,
    };
    Verdict::new(expected, evidence)
}

/// C10.
pub(super) fn short_structure_calls(facts: &Facts) -> Verdict {
    match facts.longest_structure_call {
        None => Verdict::unknown("not recorded"),
        Some(longest) => Verdict::new(longest <= LONGEST, format!("the longest takes {longest}")),
    }
}

#[cfg(test)]
mod tests {
    use super::super::samples::published;
    use super::*;

    #[test]
    fn c8_fails_when_the_tank_converges_or_the_beam_does_not() {
        for mut facts in published() {
            assert_eq!(added_mass(&facts).holds, Some(true));
            facts.relaxation = Some(match facts.case {
                Case::Tank => Relaxation::Converges,
                Case::Beam => Relaxation::Fails { step: Some(3) },
            });
            assert_eq!(added_mass(&facts).holds, Some(false));
            facts.relaxation = None;
            assert_eq!(added_mass(&facts).holds, None);
        }
    }

    #[test]
    fn c10_fails_with_a_longer_call() {
        let [_, mut beam] = published();
        assert_eq!(short_structure_calls(&beam).holds, Some(true));
        beam.longest_structure_call = Some(4);
        assert_eq!(short_structure_calls(&beam).holds, Some(false));
    }
}
