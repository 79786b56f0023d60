//! Tolerances below round-off, or above the load.

use super::{Found, Kind};
use partita_scene::schema::{Convergence, Coupling, Newton, Tolerance, plain};

/// Relative sizes that a sum of some hundred terms in double precision does not reach.
const ROUND_OFF: f64 = 1e-14;

/// The bound of a field's Newton iterations; `load` is about the force on it `[N/m]`.
pub(super) fn newton(found: &mut Found<'_>, field: &str, newton: &Newton, load: f64) {
    let path = |kind| [field, "newton", "tolerance", kind];
    match newton.tolerance {
        Tolerance::Relative(bound) if bound.get() < ROUND_OFF => {
            tight(found, &path("relative"), bound.get(), "");
        }
        Tolerance::Absolute(bound) if bound.get() < ROUND_OFF * load => {
            tight(found, &path("absolute"), bound.get(), &format!(" of a load of about {load:.1e} N/m"));
        }
        Tolerance::Absolute(bound) if load > 0.0 && bound.get() > load => found.warn(
            Kind::LooseTolerance,
            &path("absolute"),
            format!("the bound of {} N/m lies above the load of about {load:.1e} N/m", plain(bound.get())),
            format!(
                "take `{field}.newton.tolerance = {{ relative = 1e-10 }}`, or a bound far below the load"
            ),
        ),
        _ => {}
    }
}

/// The bound of the coupling; `extent` is that of the structure `[m]`.
pub(super) fn coupling(found: &mut Found<'_>, coupling: &Coupling, extent: f64) {
    let path = |choice| ["coupling", "convergence", choice];
    match coupling.convergence {
        Convergence::Changes(bound) if bound.get() < ROUND_OFF => {
            tight(found, &path("changes"), bound.get(), "");
        }
        Convergence::ChangesAndResidual(bound) if bound.get() < ROUND_OFF => {
            tight(found, &path("changes_and_residual"), bound.get(), "");
        }
        Convergence::InterfaceResidual(Tolerance::Relative(bound)) if bound.get() < ROUND_OFF => {
            tight(found, &path("interface_residual"), bound.get(), "");
        }
        Convergence::InterfaceResidual(Tolerance::Absolute(bound))
            if bound.get() < ROUND_OFF * extent * 1e-3 =>
        {
            tight(
                found,
                &path("interface_residual"),
                bound.get(),
                &format!(" of a structure {extent:.1e} m across"),
            );
        }
        Convergence::InterfaceResidual(Tolerance::Absolute(bound)) if bound.get() > 0.1 * extent => found
            .warn(
                Kind::LooseTolerance,
                &path("interface_residual"),
                format!(
                    "the bound of {} m lies near the structure's extent of {extent:.1e} m",
                    plain(bound.get())
                ),
                "take a bound far below the displacement that you expect",
            ),
        Convergence::Changes(bound) | Convergence::ChangesAndResidual(bound) if bound.get() >= 0.5 => found
            .warn(
                Kind::LooseTolerance,
                &["coupling", "convergence"],
                format!("changes of {} are no sign of convergence", plain(bound.get())),
                "take 1e-3 or less",
            ),
        _ => {}
    }
}

fn tight(found: &mut Found<'_>, path: &[&str], bound: f64, of: &str) {
    found.warn(
        Kind::TightTolerance,
        path,
        format!("a bound of {} lies below the round-off{of}", plain(bound)),
        "take 1e-10 of the size of what is measured",
    );
}
