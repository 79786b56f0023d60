//! C2: where the Newton total is smallest.

use super::Verdict;
use crate::reproduce::facts::Facts;
use crate::reproduce::setting::Limits;

/// C2.
pub(super) fn one_a_call_is_cheapest(facts: &Facts) -> Verdict {
    let (Some(one), Some((cheapest, least))) = (facts.one(), facts.grid.cheapest()) else {
        return Verdict::run_failed();
    };
    if cheapest.contains(&Limits::ONE) {
        let others = facts.grid.cells.iter().filter(|(limits, _)| **limits != Limits::ONE);
        let (next, limits) = others
            .filter_map(|(limits, counts)| Some((counts.as_ref()?.newton(), limits)))
            .min()
            .expect("a table has other cells");
        return Verdict::new(true, format!("{least} at (1, 1), next {next} at {limits}"));
    }
    Verdict::new(false, format!("{least} at {} is below {} at (1, 1)", cheapest[0], one.newton()))
}

#[cfg(test)]
mod tests {
    use super::super::samples::{cell, fail, published};
    use super::*;

    #[test]
    fn c2_fails_when_another_cell_is_smaller() {
        let [mut tank, beam] = published();
        assert_eq!(one_a_call_is_cheapest(&tank).evidence, "1166 at (1, 1), next 1316 at (1, 2)");
        assert_eq!(one_a_call_is_cheapest(&beam).holds, Some(true));
        cell(&mut tank, "2", "2", |counts| counts.fluid = 1165 - counts.structure);
        let verdict = one_a_call_is_cheapest(&tank);
        assert_eq!(
            (verdict.holds, verdict.evidence.as_str()),
            (Some(false), "1165 at (2, 2) is below 1166 at (1, 1)")
        );
        let mut incomplete = beam;
        fail(&mut incomplete, "2", "2");
        assert_eq!(one_a_call_is_cheapest(&incomplete).holds, Some(false));
    }
}
