//! The structure's patch.

use std::path::Path;

use partita_iga::{Spline, build};

use super::finding;
use super::read::Input;
use crate::scene::finding::Finding;
use crate::scene::schema::{Count, Degree, Geometry, Positive, Real, RectanglePatch};
use crate::scene::validate::Check;

/// The patch, or what is wrong with it.
pub(super) fn patch(
    geometry: &Geometry,
    _folder: &Path,
    _inputs: &mut Vec<Input>,
    check: &mut Check<'_>,
) -> Option<Spline<2>> {
    let (made, place) = match geometry {
        Geometry::Rectangle(patch) => (rectangle(patch), &["structure", "geometry", "rectangle"][..]),
    };
    made.map_err(|finding| check.add(finding.mark_if(check.value(place), "this patch"))).ok()
}

fn rectangle(patch: &RectanglePatch) -> Result<Spline<2>, Finding> {
    let made = build::rectangle(
        patch.origin.map(Real::get),
        patch.size.map(Positive::get),
        patch.degree.map(Degree::get),
        patch.elements.map(Count::get),
    );
    made.map_err(|error| finding(&error))
}
