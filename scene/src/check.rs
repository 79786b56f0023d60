//! What is found wrong while a scene is checked.

use std::ops::Range;

use super::document::Document;
use super::finding::Finding;

/// The findings so far, and the places they can point at.
pub(super) struct Check<'a> {
    document: &'a Document<'a>,
    findings: Vec<Finding>,
}

impl<'a> Check<'a> {
    pub(super) fn new(document: &'a Document<'a>) -> Self {
        Self { document, findings: Vec::new() }
    }

    /// `value` if nothing was found, else everything that was, in the order in which it stands in the scene.
    pub(super) fn done<T>(mut self, value: T) -> Result<T, Vec<Finding>> {
        if self.findings.is_empty() {
            return Ok(value);
        }
        self.findings.sort_by_key(|finding| finding.marks.first().map(|(place, _)| place.start));
        Err(self.findings)
    }

    /// Whether nothing was found so far.
    pub(super) fn is_sound(&self) -> bool {
        self.findings.is_empty()
    }

    pub(super) fn add(&mut self, finding: Finding) {
        self.findings.push(finding);
    }

    pub(super) fn key(&self, path: &[&str]) -> Option<Range<usize>> {
        self.document.entry(path).map(|entry| entry.key)
    }

    pub(super) fn value(&self, path: &[&str]) -> Option<Range<usize>> {
        self.document.entry(path).map(|entry| entry.value)
    }
}
