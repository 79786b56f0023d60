//! Splines, meshes and scenes with some damage: each is answered with a run or a message, never with a panic.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::{fs, str};

use miette::{Diagnostic, GraphicalReportHandler, GraphicalTheme};
use partita::output::Clock;
use partita::scene::{SceneError, load};
use partita::session::{Options, Session};
use partita::{build, check, warning};
use partita_testing::Noise;

use super::super::Case;
use crate::scene::SOUND;

/// What a value may become. Counts are tiny or absurd: one that is merely large would be honest work.
const STRANGE: [&str; 26] = [
    "0",
    "1",
    "2",
    "3",
    "-1",
    "-0.0",
    "0.5",
    "1e-300",
    "5e-324",
    "1e308",
    "-1e308",
    "1e999",
    "nan",
    "NaN",
    "inf",
    "-inf",
    "99999999999",
    "18446744073709551616",
    "9223372036854775807",
    "-2147483648",
    "\"\"",
    "\"x\"",
    "[]",
    "true",
    "\u{0}",
    "ü",
];

/// Damages text: one word, two words, one line, two lines, the end, or a byte.
fn damage_text(text: &str, random: &mut Noise) -> String {
    let lines: Vec<&str> = text.split_inclusive('\n').collect();
    let words = words(text);
    if words.is_empty() {
        return text.to_owned();
    }
    let (line, other) = (random.below(lines.len()), random.below(lines.len()));
    match random.below(10) {
        0 => [&lines[..line], &lines[line + 1..]].concat().concat(),
        1 => [&lines[..=line], &lines[line..]].concat().concat(),
        2 => {
            let mut lines = lines;
            lines.swap(line, other);
            lines.concat()
        }
        3 => {
            let mut end = random.below(text.len());
            while !text.is_char_boundary(end) {
                end -= 1;
            }
            text[..end].to_owned()
        }
        4 => {
            let (a, b) = (random.below(words.len()), random.below(words.len()));
            let (first, second) = (words[a.min(b)].clone(), words[a.max(b)].clone());
            if first == second {
                return text.to_owned();
            }
            let (one, two) = (&text[first.clone()], &text[second.clone()]);
            format!(
                "{}{two}{}{one}{}",
                &text[..first.start],
                &text[first.end..second.start],
                &text[second.end..]
            )
        }
        5 => {
            let word = words[random.below(words.len())].clone();
            let (before, after) = text.split_at(word.end);
            format!("{before}{}{}{after}", random.of(&[" ", "\n", "-", "e", ".", ""]), &text[word])
        }
        _ => {
            let word = words[random.below(words.len())].clone();
            format!("{}{}{}", &text[..word.start], random.of(&STRANGE), &text[word.end..])
        }
    }
}

/// Places of the words: runs of letters, digits, dots, signs and underscores.
fn words(text: &str) -> Vec<std::ops::Range<usize>> {
    let part = |c: char| c.is_alphanumeric() || matches!(c, '.' | '-' | '_' | '$');
    let mut words: Vec<std::ops::Range<usize>> = Vec::new();
    for (at, c) in text.char_indices().filter(|&(_, c)| part(c)) {
        match words.last_mut() {
            Some(word) if word.end == at => word.end = at + c.len_utf8(),
            _ => words.push(at..at + c.len_utf8()),
        }
    }
    words
}

/// Damages bytes: some of them, four or eight of them at once, or the end.
fn damage_bytes(bytes: &[u8], random: &mut Noise) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    let at = random.below(bytes.len());
    let put = |bytes: &mut [u8], new: &[u8]| {
        let end = (at + new.len()).min(bytes.len());
        bytes[at..end].copy_from_slice(&new[..end - at]);
    };
    match random.below(6) {
        0 => bytes.truncate(at),
        1 => drop(bytes.remove(at)),
        2 => {
            put(&mut bytes, &random.of(&[f64::NAN, f64::INFINITY, 1e308, -1e308, 5e-324, 0.0]).to_le_bytes());
        }
        3 => put(&mut bytes, &random.of(&[u64::MAX, 0, 1, 1 << 40, u64::MAX / 8]).to_le_bytes()),
        4 => put(&mut bytes, &random.of(&[i32::MIN, i32::MAX, -1, 0, 1, 2, 3]).to_le_bytes()),
        _ => {
            for _ in 0..3 {
                let at = random.below(bytes.len());
                bytes[at] = random.below(256).to_le_bytes()[0];
            }
        }
    }
    bytes
}

/// What became of some mutants.
struct Tally {
    all: usize,
    sound: usize,
    panics: Vec<String>,
}

impl Tally {
    /// Damages `file` of a scene in `folder` so many times, and looks at the scene each time.
    fn damage(&mut self, case: &Case, scene: &str, file: &str, rounds: usize) {
        let whole = fs::read(case.path(file)).expect("the file is there");
        let mut random = Noise::new(0x9e37_79b9_7f4a_7c15 ^ (whole.len() as u64) << 8 ^ rounds as u64);
        assert!(answer(&case.path(scene), &case.path("out")), "{scene} itself is sound");
        for round in 0..rounds {
            let mutant = match str::from_utf8(&whole) {
                Ok(text) if !text.contains('\0') => {
                    let mut text = damage_text(text, &mut random);
                    if round % 4 == 3 {
                        text = damage_text(&text, &mut random);
                    }
                    text.into_bytes()
                }
                _ => damage_bytes(&whole, &mut random),
            };
            fs::write(case.path(file), &mutant).expect("the file is written");
            self.all += 1;
            match catch_unwind(AssertUnwindSafe(|| answer(&case.path(scene), &case.path("out")))) {
                Ok(sound) => self.sound += usize::from(sound),
                Err(_) => {
                    self.panics.push(format!("{file}, round {round}:\n{}", String::from_utf8_lossy(&mutant)));
                }
            }
        }
        fs::write(case.path(file), whole).expect("the file is written");
    }
}

/// Whether a scene is sound; then it is described and makes a step, for better or worse. Else the message must be one.
fn answer(scene: &Path, out: &Path) -> bool {
    let resolved = match load(scene, &[]) {
        Ok(resolved) => resolved,
        Err(error) => {
            check_message(&error);
            return false;
        }
    };
    let run = match build::march(&resolved) {
        Ok(run) => run,
        Err(error) => {
            assert!(error.help().is_some(), "{error}");
            return false;
        }
    };
    assert!(check::describe(&resolved, &run).ends_with("scene is sound\n"));
    let _ = warning::of(&resolved, &run);
    let options = Options { steps: Some(1), ..Options::default() };
    let step = Session::start_with(run, &resolved, out, options, Clock::start()).and_then(Session::finish);
    if let Err(error) = step {
        assert!(error.help().is_some(), "{error}");
    }
    if out.exists() {
        fs::remove_dir_all(out).expect("the run can go");
    }
    true
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

const FLUID: &str = r#"title = "Flow round a hole"
time = { step = 0.1, steps = 2 }
output.fields_every = 0
[fluid]
density = 1.0
viscosity = 0.1
newton.max_iterations = 5
[fluid.mesh.gmsh]
file = "mesh.msh"
surfaces = "fluid"
[fluid.boundary]
inflow = { velocity = ["y*(1 - y)*t", 0] }
outflow = "do_nothing"
top = "slip"
bottom = "no_slip"
hole = "no_slip"
"#;

const SOLID: &str = r#"title = "A plate with a hole"
time = { step = 0.1, steps = 2 }
output.fields_every = 0
[structure]
density = 1.0
body_force = [0, "-t"]
clamped = ["bottom"]
geometry.gmsh = { file = "mesh.msh" }
newton.max_iterations = 5
[structure.material.neo_hookean]
young_modulus = 1e3
poisson_ratio = 0.3
"#;

/// The scene of `knots_not_unit` on whatever knots; every step must do with few iterations.
const PATCH: &str = "format = \"partita-spline\"\nversion = 1\ndimension = 2\ndegrees = [2, 1]\n\
knots = [[0, 0, 0, 1, 1, 1], [0, 0, 1, 1]]\n\
control_points = [[0, 0], [1, 0], [2, 0], [0, 1], [1, 1], [2, 1]]\nweights = [1, 0.9, 1, 1, 0.9, 1]\n";

fn write(case: &Case, name: &str, text: impl AsRef<[u8]>) {
    fs::write(case.path(name), text).expect("the file is written");
}

fn fixture(name: &str) -> Vec<u8> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../mesh/tests/data");
    fs::read(folder.join(format!("{name}.msh"))).expect("a fixture")
}

#[test]
fn no_damage_to_splines_meshes_and_scenes_makes_a_panic() {
    let mutants = damage_all();
    assert!(mutants >= 600, "{mutants} mutants");
}

/// Damages every kind of file; returns the number of mutants.
fn damage_all() -> usize {
    let mut tally = Tally { all: 0, sound: 0, panics: Vec::new() };
    let case = Case::new("knots_not_unit");
    write(&case, "patch.toml", PATCH);
    tally.damage(&case, "scene.toml", "patch.toml", 120);
    tally.damage(&case, "scene.toml", "scene.toml", 60);

    let small = SOUND.replace("divisions = [10, 10]", "divisions = [2, 2]").replace("[60, 1]", "[4, 1]");
    let small = small.replace("[coupling.acceleration", "[output]\nfields_every = 1\n[output.probes]\ncentre = { fluid_value = [0.5, 0.5] }\nload = { fluid_force = \"bottom\" }\nmiddle = { structure_displacement = [0.5, 1] }\n[coupling]\nmax_iterations = 3\n[coupling.acceleration");
    write(&case, "tank.toml", small);
    tally.damage(&case, "tank.toml", "tank.toml", 160);

    write(&case, "fluid.toml", FLUID);
    for format in ["2.2-ascii", "2.2-binary", "4.1-ascii", "4.1-binary"] {
        write(&case, "mesh.msh", fixture(&format!("plate-with-hole-{format}")));
        tally.damage(&case, "fluid.toml", "mesh.msh", 40);
    }
    tally.damage(&case, "fluid.toml", "fluid.toml", 40);
    write(&case, "solid.toml", SOLID);
    for stem in [
        "plate-quadrilaterals-4.1-ascii",
        "plate-quadrilaterals-8-2.2-ascii",
        "plate-quadrilaterals-9-4.1-binary",
        "plate-second-order-4.1-binary",
    ] {
        write(&case, "mesh.msh", fixture(stem));
        tally.damage(&case, "solid.toml", "mesh.msh", 20);
    }
    let Tally { all, sound, panics, .. } = tally;
    assert!(panics.is_empty(), "{} of {all} mutants panic:\n{}", panics.len(), panics.join("\n----\n"));
    assert!(sound * 20 >= all, "{all} mutants, {sound} of them sound");
    all
}
