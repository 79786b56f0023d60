//! Runs with nothing left to do, and how they go on.

use super::{Case, plain};

fn steps(case: &Case, out: &str) -> u64 {
    let summary: serde_json::Value =
        serde_json::from_str(&case.text(&format!("{out}/summary.json"))).expect("JSON");
    summary["steps"].as_u64().expect("a count")
}

#[test]
fn a_complete_run_says_so_and_can_be_extended_as_it_says() {
    let case = Case::new("absolute_tolerance");
    assert_eq!(case.run_with("out", &[]).code, 0);
    let before = case.text("out/summary.json");
    for arguments in [&["resume", "out"][..], &["resume", "out", "--steps", "3"]] {
        let again = case.partita(arguments);
        let message = plain(&again);
        assert_eq!((again.code, again.stdout.as_str()), (0, ""), "{message}");
        assert!(
            message.contains("the run in out is complete: all 5 steps are done, to t = 0.0005 s"),
            "{message}"
        );
        assert!(message.contains("raise `time.steps` in out/scene.toml and resume it again"), "{message}");
    }
    assert_eq!(case.text("out/summary.json"), before, "nothing was touched");
    let json = case.partita(&["resume", "out", "--json", "--quiet"]);
    assert_eq!((json.code, json.stdout, json.stderr.as_str()), (0, before, ""));

    case.replace("out/scene.toml", "\nsteps = 5", "\nsteps = 8");
    let extended = case.partita(&["resume", "out"]);
    assert_eq!(extended.code, 0, "{}", plain(&extended));
    assert_eq!(steps(&case, "out"), 8);
}

#[test]
fn a_complete_run_without_checkpoint_is_complete_all_the_same() {
    let case = Case::new("absolute_tolerance");
    assert_eq!(case.run_with("out", &["output.checkpoint_every=0"]).code, 0);
    let message = plain(&case.partita(&["resume", "out"]));
    assert!(
        message.contains("is complete") && message.contains("no checkpoint to go further from"),
        "{message}"
    );
}

#[test]
fn steps_beyond_the_end_or_behind_what_is_done_are_noted() {
    let case = Case::new("absolute_tolerance");
    let beyond = "note: --steps 9 asks for more than the 5 steps of the scene";
    let run = case.partita(&["run", "scene.toml", "--out", "out", "--steps", "9"]);
    assert!(run.code == 0 && plain(&run).contains(beyond), "{}", plain(&run));
    let resume = case.partita(&["resume", "out", "--steps", "9"]);
    assert!(resume.code == 0 && plain(&resume).contains(beyond), "{}", plain(&resume));
    assert!(plain(&resume).contains("is complete"), "{}", plain(&resume));

    let part = case.partita(&["run", "scene.toml", "--out", "part", "--steps", "3"]);
    assert!(part.code == 0 && !plain(&part).contains("note:"), "{}", plain(&part));
    for asked in ["2", "3"] {
        let outcome = case.partita(&["resume", "part", "--steps", asked]);
        let message = plain(&outcome);
        assert_eq!((outcome.code, outcome.stdout.as_str()), (0, ""), "{message}");
        assert!(
            message
                .contains(&format!("has 3 of 5 steps behind it, so that --steps {asked} asks for nothing")),
            "{message}"
        );
    }
    let on = case.partita(&["resume", "part", "--steps", "4"]);
    assert!(on.code == 0 && steps(&case, "part") == 4, "{}", plain(&on));
}
