//! Whether every formula has a finite value where the run will use it.

use crate::check::Check;
use crate::finding::Finding;
use crate::formulas::{faults, initial_fault, times};
use crate::schema::Scene;
use crate::shapes::Shapes;

pub(super) fn check(check: &mut Check<'_>, scene: &Scene, shapes: &Shapes) {
    for fault in faults(scene, shapes, &times(&scene.time)).into_iter().chain(initial_fault(scene, shapes)) {
        let path: Vec<&str> = fault.path.iter().map(String::as_str).collect();
        check.add(
            Finding::new(fault.what)
                .mark_if(check.value(&path), "not finite there")
                .hint("a formula needs a finite value wherever and whenever it is used: look for a division by zero, a root or a logarithm"),
        );
    }
}
