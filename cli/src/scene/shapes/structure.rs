//! The structure's patch or mesh.

use std::path::Path;

use partita_iga::{Spline, build, file, fit, orientation};
use partita_structure::Space;

use super::read::{self, Input};
use super::{PATCH_FILE, SOLID_FILE};
use crate::scene::finding::Finding;
use crate::scene::schema::{
    Alignment, ArcPatch, Count, CurvePatch, Degree, Geometry, Positive, Real, RectanglePatch, SolidMesh,
    SplineFile,
};
use crate::scene::validate::Check;

/// The space, or what is wrong with it.
pub(super) fn space(
    geometry: &Geometry,
    folder: &Path,
    inputs: &mut Vec<Input>,
    check: &mut Check<'_>,
) -> Option<Space<2>> {
    let (made, place) = match geometry {
        Geometry::Rectangle(patch) => (rectangle(patch).and_then(sound), ["rectangle", ""]),
        Geometry::Arc(patch) => (arc(patch).and_then(sound), ["arc", ""]),
        Geometry::Curve(patch) => (strip(patch).and_then(sound), ["curve", ""]),
        Geometry::Spline(spline) => (from_file(spline, folder, inputs).and_then(sound), ["spline", "file"]),
        Geometry::Gmsh(mesh) => (solid(mesh, folder, inputs), ["gmsh", "file"]),
    };
    let place = ["structure", "geometry", place[0], place[1]];
    let shape = if matches!(geometry, Geometry::Gmsh(_)) { "this mesh" } else { "this patch" };
    made.map_err(|finding| check.add(finding.mark_if(check.value(&place), shape))).ok()
}

fn sound(patch: Spline<2>) -> Result<Space<2>, Finding> {
    match orientation::check(&patch) {
        Ok(_) => Ok(Space::Patch(patch)),
        Err(error) => Err(Finding::of(&error)),
    }
}

fn solid(mesh: &SolidMesh, folder: &Path, inputs: &mut Vec<Input>) -> Result<Space<2>, Finding> {
    let (file, bytes) = read::gmsh(&mesh.file, mesh.scale, folder)?;
    let made = file.into_solid_mesh().map_err(|error| Finding::of(&format!("{}: {error}", mesh.file)))?;
    inputs.push(Input { name: SOLID_FILE, bytes });
    Ok(Space::Lagrange(made))
}

fn rectangle(patch: &RectanglePatch) -> Result<Spline<2>, Finding> {
    let made = build::rectangle(
        patch.origin.map(Real::get),
        patch.size.map(Positive::get),
        patch.degree.map(Degree::get),
        patch.elements.map(Count::get),
    );
    made.map_err(|error| Finding::of(&error))
}

fn arc(patch: &ArcPatch) -> Result<Spline<2>, Finding> {
    let made = build::annular_sector(
        patch.center.map(Real::get),
        patch.radii.map(Positive::get),
        patch.start.get().to_radians(),
        patch.sweep.get().to_radians(),
        patch.degree.map(Degree::get),
        patch.elements.map(Count::get),
    );
    made.map_err(|error| Finding::of(&error))
}

/// A curve of one degree more than the strip leaves the strip as smooth as its degree allows.
fn strip(patch: &CurvePatch) -> Result<Spline<2>, Finding> {
    let points: Vec<[f64; 2]> = patch.points.iter().map(|point| point.map(Real::get)).collect();
    let degree = patch.degree.map(Degree::get);
    let along = if points.len() > degree[0] + 1 { degree[0] + 1 } else { degree[0] };
    let (curve, _) = fit::through(&points, along).map_err(|error| Finding::of(&error))?;
    let elements = patch.elements.map(Count::get);
    build::strip(&curve, patch.thickness.get(), patch.alignment.into(), degree, elements)
        .map_err(|error| Finding::of(&error))
}

impl From<Alignment> for build::Alignment {
    fn from(alignment: Alignment) -> Self {
        match alignment {
            Alignment::Bottom => Self::Bottom,
            Alignment::Middle => Self::Middle,
            Alignment::Top => Self::Top,
        }
    }
}

fn from_file(spline: &SplineFile, folder: &Path, inputs: &mut Vec<Input>) -> Result<Spline<2>, Finding> {
    let bytes = read::bytes(&spline.file, folder)?;
    let text = std::str::from_utf8(&bytes).map_err(|_| {
        Finding::new(format!("{} is not text", spline.file)).hint("a spline file is TOML: text in UTF-8")
    })?;
    let patch =
        file::from_toml::<2>(text).map_err(|error| Finding::of(&format!("{}, {error}", spline.file)))?;
    if patch.parameters() != 2 {
        return Err(Finding::new(format!("{} holds a curve, not a patch", spline.file))
            .hint("a plane structure is a spline of two parameters: give two degrees and two knot vectors"));
    }
    let patch = refined(patch, spline)?;
    inputs.push(Input { name: PATCH_FILE, bytes });
    Ok(patch)
}

/// The same shape with more control points. The degree is raised first, so that the cuts are as smooth as it allows.
fn refined(mut patch: Spline<2>, scene: &SplineFile) -> Result<Spline<2>, Finding> {
    for (parameter, degree) in scene.degree.into_iter().flatten().enumerate() {
        let (of_file, degree) = (patch.knots()[parameter].degree(), degree.get());
        let by = degree.checked_sub(of_file).ok_or_else(|| {
            Finding::new(format!(
                "{} has the degree {of_file} along side {parameter}, not {degree}",
                scene.file
            ))
            .hint(format!("a degree can be raised, not lowered: give {of_file} or more"))
        })?;
        patch = patch.elevate_degree(parameter, by);
    }
    for (parameter, parts) in scene.subdivisions.iter().enumerate() {
        patch = patch.subdivide(parameter, parts.get()).map_err(|error| Finding::of(&error))?;
    }
    Ok(patch)
}
