//! Formulas without a finite value at t = 0, where no run evaluates them.

use super::{Found, Kind};
use partita_scene::formulas::faults;

pub(super) fn check(found: &mut Found<'_>) {
    let resolved = found.resolved;
    for fault in faults(&resolved.scene, &resolved.shapes, &[0.0]) {
        let path: Vec<&str> = fault.path.iter().map(String::as_str).collect();
        found.warn(Kind::NotFinite, &path, fault.what, "the first step ends later, but check the formula");
    }
}
