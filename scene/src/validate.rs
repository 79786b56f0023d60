//! What no single value shows: whether the parts of a scene fit together.

mod fields;
mod fluid;
mod formulas;
mod groups;
mod interface;
mod mesh;
mod solid;
mod structure;

use std::ops::Range;

use super::document::Document;
use super::finding::Finding;
use super::schema::Scene;
use super::shapes::Shapes;
use crate::spelling::nearest;
use crate::warning::Kind;

/// What does not fit, as far as the text of the scene shows it.
pub(super) fn validate(check: &mut Check<'_>, scene: &Scene) {
    fields::check(check, scene);
    warnings(check, scene);
    if let Some(fluid) = &scene.fluid {
        fluid::check(check, scene, fluid);
    }
    if let Some(structure) = &scene.structure {
        structure::check(check, structure, scene.fluid.is_some());
    }
}

/// Warnings are accepted by their names.
fn warnings(check: &mut Check<'_>, scene: &Scene) {
    let names = || Kind::ALL.into_iter().map(Kind::name);
    for name in scene.warnings.accept.keys().filter(|name| Kind::from_name(name).is_none()) {
        check.add(
            Finding::new(format!("there is no warning `{name}`"))
                .mark_if(check.key(&["warnings", "accept", name]), "unknown warning")
                .hint(match nearest(name, names()) {
                    Some(near) => format!("did you mean `{near}`?"),
                    None => format!("warnings: {}", names().collect::<Vec<_>>().join(", ")),
                }),
        );
    }
}

/// What does not fit the shapes, or does not fit between them.
pub(super) fn validate_shapes(check: &mut Check<'_>, scene: &Scene, shapes: &Shapes) {
    if let (Some(fluid), Some(mesh)) = (&scene.fluid, &shapes.fluid) {
        mesh::check(check, scene, fluid, mesh, shapes.fluid_file.as_ref());
    }
    if let (Some(structure), Some(space)) = (&scene.structure, &shapes.structure) {
        solid::check(check, scene, structure, space, shapes.structure_file.as_ref());
    }
    interface::check(check, scene, shapes);
    if check.is_sound() {
        formulas::check(check, scene, shapes);
    }
}

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
    fn is_sound(&self) -> bool {
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
