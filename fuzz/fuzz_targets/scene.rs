//! Whatever a scene file and its overrides hold, the answer is a scene that survives being written and read, or a message
//! that can be shown.
//!
//! A scene that is small and names no file is also given its shapes, for what is wrong with those.
//!
//! Lines of the input that begin with `--set ` are overrides, all others are the file.

#![no_main]

use std::path::Path;

use libfuzzer_sys::{Corpus, fuzz_target};
use miette::{GraphicalReportHandler, GraphicalTheme};
use partita_scene::schema::{Count, FluidMesh, Geometry, Scene};
use partita_scene::{SceneError, parse, read_in, to_toml};

fuzz_target!(|bytes: &[u8]| -> Corpus {
    let Ok(input) = str::from_utf8(bytes) else { return Corpus::Reject };
    let (text, overrides) = split(input);
    match parse("scene.toml", &text, &overrides) {
        Ok(scene) => {
            let written = to_toml(&scene);
            let again = parse("written.toml", &written, &[]);
            assert_eq!(again.ok().as_ref(), Some(&scene), "is written as\n{written}");
            if is_small_and_alone(&scene)
                && let Err(error) = read_in(Path::new(""), "scene.toml", &text, &overrides)
            {
                check_message(&error);
            }
        }
        Err(error) => check_message(&error),
    }
    Corpus::Keep
});

/// Whether shapes are made in a moment, and without a look at the disk.
fn is_small_and_alone(scene: &Scene) -> bool {
    let mesh = match scene.fluid.as_ref().map(|fluid| &fluid.mesh) {
        None => true,
        Some(FluidMesh::Rectangle(mesh)) => are_few(&mesh.divisions),
        Some(FluidMesh::Gmsh(_)) => false,
    };
    let patch = match scene.structure.as_ref().map(|structure| &structure.geometry) {
        None => true,
        Some(Geometry::Rectangle(patch)) => are_few(&patch.elements),
        Some(Geometry::Arc(patch)) => are_few(&patch.elements),
        Some(Geometry::Curve(patch)) => are_few(&patch.elements),
        Some(Geometry::Spline(_) | Geometry::Gmsh(_)) => false,
    };
    mesh && patch
}

fn are_few(counts: &[Count; 2]) -> bool {
    counts.iter().all(|count| count.get() <= 20)
}

/// The text of the file, and the overrides of the command line.
fn split(input: &str) -> (String, Vec<String>) {
    let (mut text, mut overrides) = (String::new(), Vec::new());
    for line in input.split_inclusive('\n') {
        match line.strip_prefix("--set ") {
            Some(given) => overrides.push(given.trim_end_matches('\n').to_owned()),
            None => text.push_str(line),
        }
    }
    (text, overrides)
}

fn check_message(error: &SceneError) {
    let mut message = String::new();
    GraphicalReportHandler::new_themed(GraphicalTheme::unicode_nocolor())
        .render_report(&mut message, error)
        .expect("a message that can be shown");
    for problem in error.problems() {
        assert!(!problem.to_string().is_empty() && !problem.hint().is_empty(), "{message}");
    }
}
