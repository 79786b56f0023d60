//! The examples run, and what they add to Partita survives a restart.

use std::error::Error;

use partita::Run;
use partita::coupling::state;

#[path = "../../examples/coupled.rs"]
mod coupled;
#[path = "../../examples/custom_accelerator.rs"]
mod custom_accelerator;
#[path = "../../examples/custom_material.rs"]
mod custom_material;
#[path = "../../examples/custom_participant.rs"]
mod custom_participant;
#[path = "../../examples/custom_probe.rs"]
mod custom_probe;

type Build = fn() -> Result<Run, Box<dyn Error>>;

/// What a run remembers at its end, in which every bit of every field, of the coupling and of all probes counts.
fn finish(run: &mut Run) -> Vec<u8> {
    while run.step().expect("the step converges") {}
    state::encode(&run.state())
}

/// Runs to the end; half-way, saved, built anew, resumed, and to the end. Both must end with the same bits.
fn check_resume(build: Build) -> Vec<u8> {
    let whole = finish(&mut build().expect("it can be built"));
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("half-way");
    let mut first = build().expect("it can be built");
    for _ in 0..4 {
        assert!(first.step().expect("the step converges"));
    }
    first.save(&path).expect("it can be saved");
    drop(first);
    let mut second = build().expect("it can be built");
    second.resume(&path).expect("it can be resumed");
    assert_eq!(second.done(), 4);
    assert!(finish(&mut second) == whole, "the resumed run ends with other bits");
    whole
}

#[test]
fn the_examples_run() {
    for main in [
        coupled::main,
        custom_accelerator::main,
        custom_material::main,
        custom_participant::main,
        custom_probe::main,
    ] {
        main().expect("it runs");
    }
}

#[test]
fn a_custom_participant_resumes_bit_for_bit() {
    check_resume(custom_participant::build);
}

#[test]
fn a_custom_accelerator_resumes_bit_for_bit() {
    let end = check_resume(custom_accelerator::build);
    let named = b"barzilai_borwein";
    assert!(end.windows(named.len()).any(|bytes| bytes == named), "the state names it");
}

#[test]
fn a_custom_material_resumes_bit_for_bit() {
    check_resume(custom_material::build);
}

#[test]
fn a_custom_probe_resumes_bit_for_bit() {
    check_resume(custom_probe::build);
    let mut run = custom_probe::build().expect("it can be built");
    assert_eq!(run.probe("peak"), None, "no step yet");
    finish(&mut run);
    let [energy, time] = run.probe("peak").expect("steps were made") else { panic!("two columns") };
    assert!(*energy > 0.0 && *time > 0.0 && *time <= 0.08 + 1e-12, "{energy} J/m at {time} s");
}

/// The program on the page of the crate has at most fifteen lines.
#[test]
fn a_coupled_run_takes_fifteen_lines() {
    let text = include_str!("../../examples/coupled.rs");
    let (_, body) = text.split_once("fn main()").expect("it has a main");
    let lines = body.lines().skip(1).take_while(|line| *line != "}").count();
    assert!(lines <= 15, "{lines} lines");
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/examples");
    for entry in std::fs::read_dir(folder).expect("the examples").map(|entry| entry.expect("a file").path()) {
        if entry.file_name().is_some_and(|name| name.to_string_lossy().starts_with("custom_")) {
            let lines = std::fs::read_to_string(&entry)
                .expect("text")
                .lines()
                .filter(|line| !line.is_empty())
                .count();
            assert!(lines <= 40, "{}: {lines} lines", entry.display());
        }
    }
}

/// A run with a participant of another name than ours.
pub(crate) fn piston() -> Result<Run, Box<dyn Error>> {
    custom_participant::build()
}
