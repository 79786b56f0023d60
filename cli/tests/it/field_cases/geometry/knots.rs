//! `knots_not_unit`: knots over any range.

use super::{Case, refusal, run};

const KNOTS: &str = "[5, 5, 5, 7, 7, 7]";

fn tip(case: &Case) -> f64 {
    run(case, "scene.toml", "out", &[]);
    case.last_probe("out", "a_displacement_y")
}

/// Finer, of higher degree, and with another range for the second parameter.
fn refine(case: &Case, across: &str) {
    case.replace("patch.toml", "[0, 0, 1, 1]", across);
    let file = "file = \"patch.toml\"";
    case.replace("scene.toml", file, &format!("{file}\nsubdivisions = [3, 2]\ndegree = [3, 2]"));
}

#[test]
fn parameters_run_from_0_to_1_whatever_the_knots_are() {
    let unit = Case::new("knots_not_unit");
    unit.replace("patch.toml", KNOTS, "[0, 0, 0, 1, 1, 1]");
    let expected = tip(&unit);
    refine(&unit, "[0, 0, 1, 1]");
    let refined = tip(&unit);
    assert!(expected < 0.0 && refined < 1.1 * expected, "the beam sinks, and more where it is finer");
    // Knots from 0 to 2 once showed the middle for the end.
    let ranges = [
        KNOTS,
        "[0, 0, 0, 2, 2, 2]",
        "[-3, -3, -3, -1, -1, -1]",
        "[0, 0, 0, 1e-12, 1e-12, 1e-12]",
        "[0, 0, 0, 1e-300, 1e-300, 1e-300]",
        "[-8e307, -8e307, -8e307, 8e307, 8e307, 8e307]",
        "[1e16, 1e16, 1e16, 10000000000000002.0, 10000000000000002.0, 10000000000000002.0]",
    ];
    for knots in ranges {
        let case = Case::new("knots_not_unit");
        case.replace("patch.toml", KNOTS, knots);
        assert_eq!(tip(&case).to_bits(), expected.to_bits(), "{knots}");
        refine(&case, "[-4, -4, 0, 0]");
        assert_eq!(tip(&case).to_bits(), refined.to_bits(), "{knots}");
    }
    let wrong = Case::new("knots_not_unit");
    wrong.replace("scene.toml", "patch.toml", "wrong.toml");
    assert_eq!(tip(&wrong).to_bits(), expected.to_bits());
}

#[test]
fn a_resumed_run_and_a_point_find_the_same_place() {
    let case = Case::new("knots_not_unit");
    case.replace("scene.toml", "[output.probes]", "[output.probes]\np = { structure_point = [2, 0.5] }");
    run(&case, "scene.toml", "out", &[]);
    let value = |column| case.last_probe("out", column);
    assert_eq!(value("a_displacement_y"), value("p_displacement_y"));
    // The folder of the run holds the file as it was.
    assert!(case.text("out/input/structure.toml").contains(KNOTS));
    run(&case, "out/scene.toml", "again", &[]);
    assert_eq!(case.last_probe("again", "a_displacement_y"), value("a_displacement_y"));
}

#[test]
fn knots_that_cannot_work_are_refused_with_their_place() {
    let refused = |knots: &str, points: usize| {
        let case = Case::new("knots_not_unit");
        case.replace("patch.toml", KNOTS, knots);
        if points > 3 {
            case.replace("patch.toml", "[2, 0], [0, 1]", "[1.5, 0], [2, 0], [0, 1]");
            case.replace("patch.toml", "[1, 1], [2, 1]]", "[1, 1], [1.5, 1], [2, 1]]");
        }
        refusal(&case, "scene.toml", &[])
    };
    let close = refused("[0, 0, 0, 1e-14, 1, 1, 1]", 4);
    assert!(
        close.contains("patch.toml, knots[0]: the knots 2 and 3 differ by 1.0e-14 of the range"),
        "{close}"
    );
    assert!(close.contains("make them equal, or move them apart"), "{close}");
    let wide = refused("[-1.7e308, -1.7e308, -1.7e308, 1.7e308, 1.7e308, 1.7e308]", 3);
    assert!(wide.contains("range that overflows"), "{wide}");
    let hidden = refused("[0, 0, 0, 1e-300, 1e300, 1e300, 1e300]", 4);
    assert!(hidden.contains("too little for an element"), "{hidden}");
}

/// Mutated splines never end in a panic (exit code 101).
#[test]
fn mutated_splines_are_refused_or_run() {
    let case = Case::new("knots_not_unit");
    let text = case.text("patch.toml");
    let replacements = [
        "0", "-1", "1e308", "-1e308", "1e-308", "5e-324", "nan", "inf", "7", "[]", "\"x\"", "1e17", "0.1",
        "-0.0",
    ];
    let numbers: Vec<(usize, usize)> = number_spans(&text);
    let mut noise = partita_testing::Noise::new(7);
    let mut random = move |bound: usize| noise.below(bound);
    let mut sound = 0;
    for _ in 0..500 {
        let mut mutated = text.clone();
        for _ in 0..=random(2) {
            let (start, end) = numbers[random(numbers.len())];
            // From the back, places before stay; a second mutation may hit what the first left, which is as good.
            let end = end.min(mutated.len());
            if mutated.is_char_boundary(start) && start < end {
                mutated.replace_range(start..end, replacements[random(replacements.len())]);
            }
        }
        let folder = case.0.path();
        std::fs::write(folder.join("patch.toml"), &mutated).expect("the file is written");
        let scene = case.text("scene.toml");
        let outcome = std::panic::catch_unwind(|| {
            let resolved = partita::scene::read_in(folder, "scene.toml", &scene, &[]).ok()?;
            let mut run = partita::build::march(&resolved).ok()?;
            Some(run.step(0.01, &mut ()).is_ok())
        });
        let Ok(stepped) = outcome else { panic!("a panic for\n{mutated}") };
        sound += usize::from(stepped.is_some());
    }
    assert!(sound > 20, "only {sound} of 500 reach a step");
}

/// Where the numbers stand behind `degrees = `.
fn number_spans(text: &str) -> Vec<(usize, usize)> {
    let start = text.find("degrees").expect("the key is there");
    let mut spans = Vec::new();
    let mut begin = None;
    for (at, c) in text.char_indices().filter(|(at, _)| *at > start) {
        match (c.is_ascii_digit(), begin) {
            (true, None) => begin = Some(at),
            (false, Some(from)) => {
                spans.push((from, at));
                begin = None;
            }
            _ => {}
        }
    }
    spans
}
