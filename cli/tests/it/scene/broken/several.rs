//! Several mistakes in one scene are shown at once.

use super::{SOUND, message};

fn with(changes: &[(&str, &str)]) -> String {
    let mut text = SOUND.to_owned();
    for (old, new) in changes {
        assert!(text.contains(old), "{old} is not in the sound scene");
        text = text.replacen(old, new, 1);
    }
    message(&text, &[])
}

#[test]
fn mistakes_of_every_kind_are_found_together() {
    let message = with(&[
        ("steps = 50", "steps = 0"),
        ("viscosity = 200.0", "viscosty = 200.0"),
        ("top = \"stress_free\"", "top = \"stres_free\""),
        ("clamped = [\"left\", \"right\"]", "clamped = [\"left\", \"rigth\"]"),
        ("poisson_ratio = 0.3", "poisson_ratio = 0.7"),
        ("size = [1.0, 0.05]", "size = [1.0, 0.05, 0.1]"),
    ]);
    for part in [
        "6 things are wrong in the scene",
        "0 is not a count of at least 1",
        "did you mean `viscosity`?",
        "fluid.boundary.top cannot be `stres_free`",
        "has no part `rigth`",
        "0.7 is not a Poisson ratio",
        "structure.geometry.rectangle.size should be a list of 2 entries",
    ] {
        assert!(message.contains(part), "`{part}` is not in\n{message}");
    }
}

#[test]
fn a_misspelt_key_is_read_as_the_one_that_was_meant() {
    let message = with(&[("young_modulus = 5e6", "young_moduls = -5e6")]);
    for part in ["did you mean `young_modulus`?", "is not a number above zero"] {
        assert!(message.contains(part), "`{part}` is not in\n{message}");
    }
    assert!(!message.contains("lacks"), "the key is not missing as well\n{message}");
}

#[test]
fn a_missing_key_and_a_wrong_one_are_both_named() {
    let message =
        with(&[("step = 0.01\n", ""), ("[structure]\ndensity = 1000.0", "[structure]\ndensity = \"heavy\"")]);
    for part in ["[time] lacks `step`", "structure.density should be a number"] {
        assert!(message.contains(part), "`{part}` is not in\n{message}");
    }
}

#[test]
fn a_table_that_cannot_be_judged_raises_no_second_complaint() {
    let message = with(&[("[fluid.mesh.rectangle]", "[fluid.mesh.hexagon]"), ("steps = 50", "steps = 5.5")]);
    assert!(message.contains("2 things are wrong"), "{message}");
}
