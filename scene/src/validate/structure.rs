//! Whether the structure is held and touches what it should.

use std::ops::Range;

use partita_numerics::time::GeneralizedAlpha;

use crate::check::Check;
use crate::finding::Finding;
use crate::schema::{Geometry, Part, Structure, StructureTimeScheme};
use crate::shapes::Content;
use crate::spelling::nearest;

/// Control points of a patch; more would not fit any machine the program is written for.
const MOST_POINTS: f64 = 1e8;

pub(super) fn check(check: &mut Check<'_>, structure: &Structure, coupled: bool) {
    size(check, structure);
    if let Some(sides) = structure.geometry.sides() {
        known_parts(check, structure, "patch", &sides, None);
    }
    held(check, structure);
    twice(check, "clamped", &structure.clamped);
    twice(check, "wetted", &structure.wetted);
    if let Some(side) = structure.wetted.iter().find(|side| structure.clamped.contains(side)) {
        check.add(
            Finding::new(format!("side `{side}` is both clamped and wetted"))
                .mark_if(check.value(&["structure", "clamped"]), "does not move")
                .mark_if(check.value(&["structure", "wetted"]), "moves with the fluid")
                .hint("name it in one of the two"),
        );
    }
    if structure.body_force.uses_position() {
        check.add(
            Finding::new("the body force of a structure is the same everywhere")
                .mark_if(check.value(&["structure", "body_force"]), "depends on the position")
                .hint("use the time `t` alone"),
        );
    }
    match structure.wetted.first() {
        // The groups of a mesh are named when its file was read.
        None if coupled && !matches!(structure.geometry, Geometry::Gmsh(_)) => check.add(
            Finding::new("no side of the structure touches the fluid")
                .mark_if(check.key(&["structure"]), "`wetted` is missing or empty")
                .hint("name the sides that touch the fluid: `wetted = [\"top\"]`"),
        ),
        Some(side) if !coupled => check.add(
            Finding::new(format!("side `{side}` is wetted, but the scene has no fluid"))
                .mark_if(check.value(&["structure", "wetted"]), "by what?")
                .hint("add a [fluid] and a [coupling], or leave out `wetted`"),
        ),
        _ => {}
    }
    newmark(check, structure);
    statics(check, structure);
}

fn size(check: &mut Check<'_>, structure: &Structure) {
    let (choice, elements, degree) = match &structure.geometry {
        Geometry::Rectangle(patch) => ("rectangle", patch.elements, patch.degree),
        Geometry::Arc(patch) => ("arc", patch.elements, patch.degree),
        Geometry::Curve(patch) => ("curve", patch.elements, patch.degree),
        // At least so many: the file has an element or more.
        Geometry::Spline(spline) => ("spline", spline.subdivisions, spline.degree.unwrap_or_default()),
        Geometry::Gmsh(_) => return,
    };
    let along = |c: usize| (elements[c].get() + degree[c].get()) as f64;
    let points = along(0) * along(1);
    if points > MOST_POINTS {
        let key = if choice == "spline" { "subdivisions" } else { "elements" };
        check.add(
            Finding::new(format!("the structure would have about {points:.0e} control points"))
                .mark_if(check.value(&["structure", "geometry", choice, key]), "too fine")
                .hint(format!("at most {MOST_POINTS:.0e} can be asked for")),
        );
    }
}

/// The parts of the boundary that a structure names, and where.
pub(super) fn named_parts<'a>(
    check: &Check<'_>,
    structure: &'a Structure,
) -> Vec<(Option<Range<usize>>, &'a str)> {
    let listed = |key, parts: &'a [Part]| {
        let place = check.value(&["structure", key]);
        parts.iter().map(move |part| (place.clone(), part.name()))
    };
    let held = structure.held.keys().map(|part| (check.key(&["structure", "held", part]), part.as_str()));
    listed("clamped", &structure.clamped).chain(held).chain(listed("wetted", &structure.wetted)).collect()
}

/// Supports of single components, which clamped parts do not need and wetted ones cannot all have.
fn held(check: &mut Check<'_>, structure: &Structure) {
    for (part, components) in &structure.held {
        let path = ["structure", "held", part];
        let names = |part_of: &[Part]| part_of.iter().any(|other| other.name() == part);
        let repeated = components.iter().enumerate().find(|(i, c)| components[..*i].contains(c));
        let finding = if components.is_empty() {
            Finding::new(format!("structure.held.{part} names no component"))
                .mark_if(check.value(&path), "empty")
                .hint(format!("name what stays zero, `{part} = [\"x\"]`, or leave the part out"))
        } else if let Some((_, component)) = repeated {
            Finding::new(format!("structure.held.{part} names `{}` twice", component.name()))
                .mark_if(check.value(&path), "once is enough")
                .hint(format!("name `{}` once", component.name()))
        } else if names(&structure.clamped) {
            Finding::new(format!("side `{part}` is both clamped and held"))
                .mark_if(check.value(&["structure", "clamped"]), "does not move at all")
                .mark_if(check.value(&path), "moves in some directions")
                .hint("name it in one of the two")
        } else if components.len() == 2 && names(&structure.wetted) {
            Finding::new(format!("side `{part}` is wetted and held in x and y"))
                .mark_if(check.value(&path), "does not move")
                .mark_if(check.value(&["structure", "wetted"]), "moves with the fluid")
                .hint("hold it in one direction, or take it out of `wetted`")
        } else {
            continue;
        };
        check.add(finding);
    }
}

/// The parts that a structure names against those of its boundary, and the file that it was read from.
pub(super) fn known_parts(
    check: &mut Check<'_>,
    structure: &Structure,
    what: &str,
    names: &[&str],
    file: Option<&Content>,
) {
    for (place, part) in named_parts(check, structure).into_iter().filter(|(_, part)| !names.contains(part)) {
        let finding = file.and_then(|file| file.elsewhere(part, names)).unwrap_or_else(|| {
            Finding::new(format!("the {what} of the structure has no part `{part}`")).hint(
                match nearest(part, names.iter().copied()) {
                    Some(near) => format!("did you mean `{near}`?"),
                    None => format!("parts of its boundary: {}", names.join(", ")),
                },
            )
        });
        check.add(finding.mark_if(place, "unknown part"));
    }
}

fn twice(check: &mut Check<'_>, key: &str, sides: &[Part]) {
    if let Some(side) =
        sides.iter().enumerate().find_map(|(i, side)| sides[..i].contains(side).then_some(side))
    {
        check.add(
            Finding::new(format!("structure.{key} names `{side}` twice"))
                .mark_if(check.value(&["structure", key]), "once is enough")
                .hint(format!("name `{side}` once")),
        );
    }
}

fn newmark(check: &mut Check<'_>, structure: &Structure) {
    let StructureTimeScheme::Newmark { beta, gamma } = structure.time_scheme else { return };
    if let Err(error) = GeneralizedAlpha::newmark(beta.get(), gamma.get()) {
        check.add(Finding::of(&error).mark_if(check.value(&["structure", "time_scheme"]), "not stable"));
    }
}

fn statics(check: &mut Check<'_>, structure: &Structure) {
    if structure.time_scheme != StructureTimeScheme::QuasiStatic {
        return;
    }
    let place = check.value(&["structure", "time_scheme"]);
    if structure.clamped.is_empty() && structure.held.is_empty() {
        check.add(
            Finding::new("a quasi-static structure is held nowhere")
                .mark_if(place.clone(), "no inertia either")
                .hint("without inertia and supports it has no place of its own: name a part in `clamped` or `held`"),
        );
    }
    if structure.rayleigh_damping.is_some() {
        check.add(
            Finding::new("a quasi-static structure has no velocity to damp")
                .mark_if(check.key(&["structure", "rayleigh_damping"]), "damps nothing")
                .mark_if(place, "because of this")
                .hint("leave out `rayleigh_damping`"),
        );
    }
}
