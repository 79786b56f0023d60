//! The paper's claims as statements that code evaluates, each on the facts of one case.

mod adaptive;
mod coupling;
mod newton;
mod observed;
#[cfg(test)]
mod samples;
mod time;

use super::case::Case;
use super::facts::Facts;

/// What a claim comes to on a case.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Verdict {
    /// `None` where the facts do not suffice, such as times that nobody measured.
    pub(crate) holds: Option<bool>,
    /// The numbers it rests on.
    pub(crate) evidence: String,
}

impl Verdict {
    fn new(holds: bool, evidence: impl Into<String>) -> Self {
        Self { holds: Some(holds), evidence: evidence.into() }
    }

    fn unknown(why: &str) -> Self {
        Self { holds: None, evidence: why.to_owned() }
    }

    /// A run that does not reach its end cannot bear out what is claimed of it.
    fn run_failed() -> Self {
        Self::new(false, "a run that it needs does not reach its end")
    }
}

/// A claim of the paper.
pub(crate) struct Claim {
    pub(crate) id: &'static str,
    pub(crate) statement: &'static str,
    /// The cases it is about.
    pub(crate) cases: &'static [Case],
    judge: fn(&Facts) -> Verdict,
}

impl Claim {
    /// Judges it on a case it is about.
    pub(crate) fn on(&self, facts: &Facts) -> Option<Verdict> {
        self.cases.contains(&facts.case).then(|| (self.judge)(facts))
    }
}

const BOTH: &[Case] = &[Case::Tank, Case::Beam];
const TANK: &[Case] = &[Case::Tank];
const BEAM: &[Case] = &[Case::Beam];

/// All of them, in the order of their numbers.
pub(crate) const CLAIMS: [Claim; 10] = [
    Claim {
        id: "C1",
        statement: "More fluid Newton iterations per call lead to fewer coupling iterations: in every column N^f = 1 \
                    is the maximum and N^f = inf is at least 15 % below it",
        cases: BOTH,
        judge: coupling::fluid_iterations_save_coupling,
    },
    Claim {
        id: "C2",
        statement: "The Newton total is smallest at N^f = N^s = 1",
        cases: BOTH,
        judge: newton::one_a_call_is_cheapest,
    },
    Claim {
        id: "C3",
        statement: "Tank: raising N^s lowers the coupling iterations: in every row N^s = 1 is the maximum",
        cases: TANK,
        judge: coupling::structure_iterations_save_coupling,
    },
    Claim {
        id: "C4",
        statement: "Beam: N^s hardly matters for the coupling iterations: in every row they vary by at most 1 %",
        cases: BEAM,
        judge: coupling::structure_iterations_do_not_matter,
    },
    Claim {
        id: "C5",
        statement: "N1-CC needs far fewer coupling iterations than N = 1 (at most 0.8 of them) and no more Newton \
                    iterations",
        cases: BOTH,
        judge: adaptive::one_until_coupled,
    },
    Claim {
        id: "C6",
        statement: "N3-CC needs the coupling iterations of N = inf (within 3 %) with fewer Newton iterations (at most \
                    0.85 of them)",
        cases: BOTH,
        judge: adaptive::three_until_coupled,
    },
    Claim {
        id: "C7",
        statement: "Converged interface data (1e-4) beats neither N = 1 nor N1-CC: its Newton total exceeds both",
        cases: BOTH,
        judge: adaptive::interface_data,
    },
    Claim {
        id: "C8",
        statement: "The tank is bound by added mass, the beam is not: with constant relaxation of 0.8 the tank fails \
                    and the beam converges",
        cases: BOTH,
        judge: observed::added_mass,
    },
    Claim {
        id: "C9",
        statement: "Data transfer costs far less than a Newton iteration (a coupling iteration outside the solvers at \
                    most a tenth of one), so Newton iterations measure the run time (rank correlation at least 0.9)",
        cases: BOTH,
        judge: time::newton_measures_time,
    },
    Claim {
        id: "C10",
        statement: "Beam: no structure call needs more than 3 Newton iterations",
        cases: BEAM,
        judge: observed::short_structure_calls,
    },
];

/// A claim judged on all cases it is about.
pub(crate) struct Judged {
    pub(crate) claim: &'static Claim,
    /// Whether it holds on every case; `None` where that is not known.
    pub(crate) holds: Option<bool>,
    pub(crate) verdicts: Vec<(Case, Verdict)>,
}

impl Judged {
    /// The evidence of all cases.
    pub(crate) fn evidence(&self) -> String {
        let parts =
            self.verdicts.iter().map(|(case, verdict)| format!("{}: {}", case.short(), verdict.evidence));
        parts.collect::<Vec<_>>().join("; ")
    }

    /// "yes", "no", or "not known".
    pub(crate) fn word(&self) -> &'static str {
        word(self.holds)
    }
}

pub(crate) fn word(holds: Option<bool>) -> &'static str {
    match holds {
        Some(true) => "yes",
        Some(false) => "no",
        None => "not known",
    }
}

/// Judges every claim. One case that contradicts it is enough for a claim to fail.
pub(crate) fn judge(facts: &[Facts]) -> Vec<Judged> {
    static ALL: [Claim; 10] = CLAIMS;
    ALL.iter()
        .map(|claim| {
            let verdicts: Vec<(Case, Verdict)> =
                facts.iter().filter_map(|facts| Some((facts.case, claim.on(facts)?))).collect();
            let states = || verdicts.iter().map(|(_, verdict)| verdict.holds);
            let holds = if states().any(|holds| holds == Some(false)) {
                Some(false)
            } else {
                states().collect::<Option<Vec<bool>>>().filter(|known| !known.is_empty()).map(|_| true)
            };
            Judged { claim, holds, verdicts }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::samples::published;
    use super::*;

    #[test]
    fn every_claim_holds_on_the_published_tables_but_the_one_about_time() {
        let all = judge(&published());
        assert_eq!(all.len(), CLAIMS.len());
        for judged in all {
            let expected = if judged.claim.id == "C9" { None } else { Some(true) };
            assert_eq!(judged.holds, expected, "{}: {}", judged.claim.id, judged.evidence());
        }
    }

    #[test]
    fn one_contradicting_case_is_enough() {
        let mut facts = published();
        facts[0].longest_structure_call = None;
        facts[1].longest_structure_call = Some(4);
        let judged = judge(&facts);
        assert_eq!(judged[9].word(), "no");
        assert_eq!(judged[9].evidence(), "beam: the longest takes 4");
        facts[1].longest_structure_call = None;
        assert_eq!(judge(&facts)[9].word(), "not known");
    }

    #[test]
    fn claims_are_numbered_in_order() {
        let ids: Vec<&str> = CLAIMS.iter().map(|claim| claim.id).collect();
        assert_eq!(ids, ["C1", "C2", "C3", "C4", "C5", "C6", "C7", "C8", "C9", "C10"]);
    }
}
