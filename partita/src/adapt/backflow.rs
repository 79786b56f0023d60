//! Advice where fluid enters through an outlet: the usual end of such runs is a velocity that grows without bound.

use partita_fluid::{Backflow, FluidSolver, Outlet};

use super::suspect::Suspect;

/// Names the groups through which fluid entered at the end of the last step, and what can be done about it.
pub(crate) fn suspect(fluid: &FluidSolver<2>) -> Option<Suspect> {
    advice(&fluid.backflows())
}

fn advice(backflows: &[Backflow]) -> Option<Suspect> {
    // What no stabilization damps is the most likely cause, an inlet driven by pressure the least.
    let first = backflows.iter().max_by_key(|backflow| weight(backflow.outlet))?;
    let alike: Vec<&Backflow> =
        backflows.iter().filter(|backflow| weight(backflow.outlet) == weight(first.outlet)).collect();
    let groups = alike.iter().map(|backflow| described(backflow)).collect::<Vec<_>>().join(" and ");
    let advice = match first.outlet {
        Outlet::DoNothing { stabilized: false } | Outlet::StressFree { stabilized: false } => {
            let keys: Vec<String> = alike.iter().map(|backflow| remedy(backflow)).collect();
            format!(
                "fluid enters through {groups}, which smaller steps do not mend: set {}, or move that boundary farther \
                 downstream",
                keys.join(" and ")
            )
        }
        Outlet::DoNothing { stabilized: true } | Outlet::StressFree { stabilized: true } => {
            format!(
                "fluid enters through {groups}, although its backflow is stabilized: move that boundary farther downstream"
            )
        }
        Outlet::Traction => format!(
            "fluid enters through {groups}, as it should where a pressure drives it; if fluid should only leave there, take \
             `do_nothing` with `backflow_stabilization`"
        ),
    };
    Some(Suspect { advice, comes_first: weight(first.outlet) > 0 })
}

fn weight(outlet: Outlet) -> u8 {
    match outlet {
        Outlet::DoNothing { stabilized: false } | Outlet::StressFree { stabilized: false } => 2,
        Outlet::DoNothing { stabilized: true } | Outlet::StressFree { stabilized: true } => 1,
        Outlet::Traction => 0,
    }
}

fn word(outlet: Outlet) -> &'static str {
    match outlet {
        Outlet::DoNothing { .. } => "do_nothing",
        Outlet::StressFree { .. } => "stress_free",
        Outlet::Traction => "traction",
    }
}

/// As in "`right` (`do_nothing`, 12 % of the flow through the boundary)".
fn described(Backflow { group, outlet, share }: &Backflow) -> String {
    format!("`{group}` ({}, {:.2} % of the flow through the boundary)", word(*outlet), 100.0 * share)
}

fn remedy(Backflow { group, outlet, .. }: &Backflow) -> String {
    format!("`fluid.boundary.{} = {{ {} = {{ backflow_stabilization = true }} }}`", key(group), word(*outlet))
}

/// A group's name as a key of a scene.
fn key(group: &str) -> String {
    let bare = !group.is_empty() && group.chars().all(|c| c.is_ascii_alphanumeric() || c == '_' || c == '-');
    if bare { group.to_owned() } else { format!("{group:?}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn backflow(group: &str, outlet: Outlet) -> Backflow {
        Backflow { group: group.to_owned(), outlet, share: 0.0123 }
    }

    const OPEN: Outlet = Outlet::DoNothing { stabilized: false };
    const FREE: Outlet = Outlet::StressFree { stabilized: false };
    const DAMPED: Outlet = Outlet::StressFree { stabilized: true };

    #[test]
    fn every_outlet_without_stabilization_is_named_with_its_key() {
        let found =
            advice(&[backflow("far right", OPEN), backflow("top", FREE), backflow("left", Outlet::Traction)]);
        let Suspect { advice, comes_first } = found.expect("a suspect");
        assert!(comes_first);
        for part in [
            "`far right` (do_nothing, 1.23 % of the flow through the boundary) and `top` (stress_free, ",
            "`fluid.boundary.\"far right\" = { do_nothing = { backflow_stabilization = true } }` and `fluid.boundary.top = ",
        ] {
            assert!(advice.contains(part), "{advice}");
        }
        assert!(!advice.contains("left"), "{advice}");
    }

    #[test]
    fn stabilization_that_is_on_is_not_advised() {
        let Suspect { advice, comes_first } = advice(&[backflow("top", DAMPED)]).expect("a suspect");
        assert!(comes_first && advice.contains("`top`") && !advice.contains("set `"), "{advice}");
    }

    #[test]
    fn an_inlet_driven_by_pressure_comes_last() {
        let Suspect { advice, comes_first } = advice(&[backflow("in", Outlet::Traction)]).expect("a suspect");
        assert!(!comes_first && advice.contains("as it should"), "{advice}");
        assert_eq!(super::advice(&[]), None);
    }
}
