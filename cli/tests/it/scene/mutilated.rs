//! Whatever a file holds, the answer is a scene or a message, never a panic.

use miette::{GraphicalReportHandler, GraphicalTheme};
use partita::scene::{parse, to_toml};

use super::SOUND;

/// Reads a text; a message must render, a scene must survive being written and read.
fn read(text: &str, overrides: &[String]) {
    match parse("scene.toml", text, overrides) {
        Ok(scene) => {
            let written = to_toml(&scene);
            let again = parse("written.toml", &written, &[]);
            assert_eq!(again.ok().as_ref(), Some(&scene), "{text}\n{overrides:?}\nis written as\n{written}");
        }
        Err(error) => {
            let mut message = String::new();
            GraphicalReportHandler::new_themed(GraphicalTheme::unicode_nocolor())
                .render_report(&mut message, &error)
                .unwrap_or_else(|_| panic!("no message for {text}\n{overrides:?}"));
            for problem in error.problems() {
                assert!(!problem.to_string().is_empty() && !problem.hint().is_empty(), "{message}");
            }
        }
    }
}

const STRANGE: [&str; 22] = [
    "",
    "\"",
    "\"\"\"",
    "[",
    "]",
    "[[",
    "{",
    "}",
    "=",
    "0",
    "-1",
    "nan",
    "inf",
    "1e999",
    "99999999999999999999",
    "true",
    "[1, 2, 3]",
    "{ a = 1 }",
    "2021-06-30",
    "\u{0}",
    "ünïcode \u{1F980}",
    "\"x ^ (y\"",
];

#[test]
fn a_file_cut_anywhere_is_answered() {
    for (end, _) in SOUND.char_indices() {
        read(&SOUND[..end], &[]);
    }
}

#[test]
fn a_file_with_a_line_lost_or_doubled_is_answered() {
    let lines: Vec<&str> = SOUND.lines().collect();
    for (index, line) in lines.iter().enumerate() {
        let (before, after) = (lines[..index].join("\n"), lines[index + 1..].join("\n"));
        read(&format!("{before}\n{after}"), &[]);
        read(&format!("{before}\n{line}\n{line}\n{after}"), &[]);
    }
}

#[test]
fn a_file_with_a_strange_word_anywhere_is_answered() {
    let mut start = 0;
    for word in SOUND.split_inclusive(|c: char| !c.is_alphanumeric() && c != '_' && c != '.') {
        let (before, after) = (&SOUND[..start], &SOUND[start + word.len()..]);
        for strange in STRANGE {
            read(&format!("{before}{strange}{after}"), &[]);
        }
        start += word.len();
    }
}

#[test]
fn a_strange_override_is_answered() {
    let keys = [
        "",
        "title",
        "time",
        "time.step",
        "fluid",
        "fluid.boundary",
        "fluid.boundary.top",
        "fluid.boundary.top.velocity",
        "fluid.boundary.\"top\"",
        "fluid.mesh.rectangle",
        "fluid.initial",
        "coupling.acceleration",
        "coupling.acceleration.iqn_imvls.filter",
        "coupling.newton.fixed.fluid",
        "output.probes.a.fluid_value",
        "a.b.c.d",
        "fluid.boundary.top.stress_free.backflow_stabilization",
    ];
    for key in keys {
        for value in
            STRANGE.into_iter().chain(["aitken", "\"no_slip\"", "[\"x\", \"y\"]", "{ velocity = [0, 0] }"])
        {
            read(SOUND, &[format!("{key}={value}")]);
            read(
                SOUND,
                &[format!("{key}={value}"), "coupling.acceleration.aitken.initial_relaxation=1".to_owned()],
            );
        }
    }
}

#[test]
fn a_scene_nested_deeply_is_answered() {
    for text in [
        format!("title = {}", "[".repeat(100_000)),
        format!("title{} = 1", ".a".repeat(20_000)),
        format!("[{}]", vec!["a"; 20_000].join(".")),
        format!("title = {}", "{ a = ".repeat(20_000)),
    ] {
        read(&text, &[]);
    }
}

#[test]
fn the_corpus_of_the_fuzz_target_is_answered() {
    let inputs = partita_testing::corpus::of("scene");
    assert!(inputs.len() > 100, "{} files", inputs.len());
    for input in inputs {
        let input = String::from_utf8(input).expect("text");
        // As the target splits it: lines that begin with `--set ` are overrides.
        let (given, kept): (Vec<&str>, Vec<&str>) =
            input.split_inclusive('\n').partition(|line| line.starts_with("--set "));
        let overrides: Vec<String> =
            given.iter().map(|line| line["--set ".len()..].trim_end_matches('\n').to_owned()).collect();
        read(&kept.concat(), &overrides);
    }
}
