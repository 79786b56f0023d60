//! The structure's patch or mesh.

use std::path::Path;

use partita_iga::{Spline, build, file, fit, orientation, seam};
use partita_structure::{Patch, Space};

use super::content::{self, Content};
use super::read::{self, Input};
use super::{PATCH_FILE, SOLID_FILE, Shapes};
use crate::check::Check;
use crate::finding::Finding;
use crate::schema::{
    Alignment, ArcPatch, Count, CurvePatch, Degree, Geometry, Positive, Real, RectanglePatch, SolidMesh,
    SplineFile,
};

/// The space, or what is wrong with it.
pub(super) fn space(
    geometry: &Geometry,
    folder: &Path,
    shapes: &mut Shapes,
    check: &mut Check<'_>,
) -> Option<Space<2>> {
    let (made, place) = match geometry {
        Geometry::Rectangle(patch) => (rectangle(patch).and_then(sound), ["rectangle", ""]),
        Geometry::Arc(patch) => (arc(patch).and_then(sound), ["arc", ""]),
        Geometry::Curve(patch) => (strip(patch).and_then(sound), ["curve", ""]),
        Geometry::Spline(spline) => {
            (from_file(spline, folder, &mut shapes.inputs).and_then(sound), ["spline", "file"])
        }
        Geometry::Gmsh(mesh) => (solid(mesh, folder, shapes, check), ["gmsh", "file"]),
    };
    let place = ["structure", "geometry", place[0], place[1]];
    let shape = if matches!(geometry, Geometry::Gmsh(_)) { "this mesh" } else { "this patch" };
    made.map_err(|finding| check.add(finding.mark_unless(check.value(&place), shape))).ok()
}

fn sound(patch: Spline<2>) -> Result<Space<2>, Finding> {
    orientation::check(&patch).map_err(|error| Finding::of(&error))?;
    let patch = Patch::from(patch);
    match seam::contact(patch.spline(), patch.seams()) {
        None => Ok(Space::Patch(patch)),
        Some(contact) => Err(Finding::new(contact.to_string()).hint(contact.remedy())),
    }
}

fn solid(
    mesh: &SolidMesh,
    folder: &Path,
    shapes: &mut Shapes,
    check: &Check<'_>,
) -> Result<Space<2>, Finding> {
    let (file, bytes) = read::gmsh(&mesh.file, mesh.scale, folder)?;
    let mut content = Content::new(&mesh.file, &file, mesh.surfaces.as_ref());
    let table = ["structure", "geometry", "gmsh"];
    let part = content::choose(file, mesh.surfaces.as_ref(), &mesh.file, check, table)?;
    content.turned = part.is_inverted(2);
    content.touching(&part);
    let made =
        part.into_solid_mesh().map_err(|error| Finding::of(&error).led_by(&format!("{}: ", mesh.file)))?;
    content.bounds(&made.groups().iter().map(|group| &*group.name).collect::<Vec<_>>());
    shapes.structure_file = Some(content);
    shapes.inputs.push(Input { name: SOLID_FILE, bytes });
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

/// Degrees.
const FULL_TURN: f64 = 360.0;

fn arc(patch: &ArcPatch) -> Result<Spline<2>, Finding> {
    let sweep = patch.sweep.get();
    if sweep.abs() > FULL_TURN {
        return Err(Finding::new(format!("an arc that sweeps {sweep} degrees would lie on itself"))
            .hint("the sweep is at most 360 degrees, where both ends are joined to a ring"));
    }
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

/// Ends of a curve closer than this share of its size are one point.
const TOUCH: f64 = 1e-9;

fn is_closed(points: &[[f64; 2]]) -> bool {
    let [Some(first), Some(last)] = [points.first(), points.last()] else { return false };
    let distance = |a: &[f64; 2], b: &[f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
    let size = points.iter().map(|point| distance(first, point)).fold(0.0, f64::max);
    points.len() > 2 && distance(first, last) <= TOUCH * size
}

/// A curve of one degree more than the strip leaves the strip as smooth as its degree allows.
fn strip(patch: &CurvePatch) -> Result<Spline<2>, Finding> {
    let points: Vec<[f64; 2]> = patch.points.iter().map(|point| point.map(Real::get)).collect();
    let degree = patch.degree.map(Degree::get);
    let closed = is_closed(&points);
    let distinct = points.len() - usize::from(closed);
    let along = if distinct > degree[0] + 1 { degree[0] + 1 } else { degree[0] };
    let fitted = if closed { fit::closed(&points, along) } else { fit::through(&points, along) };
    let (curve, _) = fitted.map_err(|error| Finding::of(&error))?;
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
    let patch = file::from_toml::<2>(text)
        .map_err(|error| Finding::of(&error).led_by(&format!("{}, ", spline.file)))?;
    if patch.parameters() != 2 {
        return Err(Finding::new(format!("{} holds a curve, not a patch", spline.file))
            .hint("a plane structure is a spline of two parameters: give two degrees and two knot vectors"));
    }
    let patch = patch.on_unit_parameters().map_err(|(parameter, error)| {
        Finding::of(&error).led_by(&format!("{}, knots[{parameter}]: ", spline.file))
    })?;
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
