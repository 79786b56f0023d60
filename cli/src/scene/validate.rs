//! What no single value shows: whether the parts of a scene fit together.

mod fields;
mod fluid;
mod structure;

use std::ops::Range;

use super::document::Document;
use super::finding::Finding;
use super::schema::Scene;

/// Everything that does not fit, in the order in which it stands in the scene.
pub(super) fn validate(scene: &Scene, document: &Document<'_>) -> Vec<Finding> {
    let mut check = Check { document, findings: Vec::new() };
    fields::check(&mut check, scene);
    if let Some(fluid) = &scene.fluid {
        fluid::check(&mut check, fluid, scene.structure.is_some());
    }
    if let Some(structure) = &scene.structure {
        structure::check(&mut check, structure, scene.fluid.is_some());
    }
    check.findings.sort_by_key(|finding| finding.marks.first().map(|(place, _)| place.start));
    check.findings
}

/// The findings so far, and the places they can point at.
struct Check<'a> {
    document: &'a Document<'a>,
    findings: Vec<Finding>,
}

impl Check<'_> {
    fn add(&mut self, finding: Finding) {
        self.findings.push(finding);
    }

    fn key(&self, path: &[&str]) -> Option<Range<usize>> {
        self.document.entry(path).map(|entry| entry.key)
    }

    fn value(&self, path: &[&str]) -> Option<Range<usize>> {
        self.document.entry(path).map(|entry| entry.value)
    }
}
