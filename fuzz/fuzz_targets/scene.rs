//! Whatever a scene file and its overrides hold, the answer is a scene that survives being written and read, or a message
//! that can be shown.
//!
//! Lines of the input that begin with `--set ` are overrides, all others are the file.

#![no_main]

use libfuzzer_sys::{Corpus, fuzz_target};
use miette::{GraphicalReportHandler, GraphicalTheme};
use partita::scene::{SceneError, parse, to_toml};

fuzz_target!(|bytes: &[u8]| -> Corpus {
    let Ok(input) = str::from_utf8(bytes) else { return Corpus::Reject };
    let (text, overrides) = split(input);
    match parse("scene.toml", &text, &overrides) {
        Ok(scene) => {
            let written = to_toml(&scene);
            let again = parse("written.toml", &written, &[]);
            assert_eq!(again.ok().as_ref(), Some(&scene), "is written as\n{written}");
        }
        Err(error) => check_message(&error),
    }
    Corpus::Keep
});

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
