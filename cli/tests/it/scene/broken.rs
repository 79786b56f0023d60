//! Broken scenes and the messages they give.

mod fit;
mod geometry;
mod keys;
mod overrides;
mod several;
mod shapes;
mod values;

use miette::{GraphicalReportHandler, GraphicalTheme};
use partita::scene::{SceneError, read_in};

use super::SOUND;

/// A message as a terminal of 100 columns shows it.
fn render(error: &SceneError) -> String {
    let mut message = String::new();
    GraphicalReportHandler::new_themed(GraphicalTheme::unicode_nocolor())
        .with_width(100)
        .render_report(&mut message, error)
        .expect("a string takes everything");
    message
}

/// The message for a scene that names no file.
fn message(text: &str, overrides: &[&str]) -> String {
    let overrides: Vec<String> = overrides.iter().map(ToString::to_string).collect();
    render(&read_in("".as_ref(), "scene.toml", text, &overrides).expect_err("the scene is broken"))
}

/// The message for the sound scene with `old` replaced by `new`.
fn broken(old: &str, new: &str) -> String {
    assert!(SOUND.contains(old), "{old} is not in the sound scene");
    message(&SOUND.replacen(old, new, 1), &[])
}
