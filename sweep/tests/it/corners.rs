//! The hardest corners of the shipped maps, few steps each.

use std::fs;
use std::path::Path;

use partita_sweep::map::{Outcome, Row};
use partita_sweep::{Findings, Sweep};
use toml::{Table, Value};

use crate::support::execute;

/// What one cell of a shipped map comes to, in at most `steps` steps where the map does not set them.
fn corner(map: &str, choice: &str, values: [&str; 2], steps: Option<i64>) -> Row {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../maps").join(map).with_extension("toml");
    let text = fs::read_to_string(&path).expect("a shipped map");
    let mut table: Table = text.parse().expect("a shipped map is TOML");
    let scene = path.with_file_name(table["scene"].as_str().expect("a scene"));
    table.insert("scene".to_owned(), Value::String(scene.display().to_string()));
    if let Some(steps) = steps {
        table.insert("steps".to_owned(), Value::Integer(steps));
    }
    keep(&mut table, "choice", |entry| entry["name"].as_str() == Some(choice));
    for (axis, value) in values.into_iter().enumerate() {
        let parameter = &mut table["parameter"].as_array_mut().expect("two parameters")[axis];
        let parameter = parameter.as_table_mut().expect("a parameter");
        let number: Option<f64> = value.parse().ok();
        keep(parameter, "values", |entry| match entry {
            Value::String(word) => word == value,
            Value::Integer(integer) => number == Some(*integer as f64),
            other => other.as_float() == number,
        });
    }
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("corner.toml");
    fs::write(&file, table.to_string()).expect("a map of one cell");
    let sweep = Sweep::load(&file).expect("a cell of a shipped map is sound");
    execute(&sweep, &folder.path().join("out"), 1).expect("the folder takes a map");
    let collected = sweep.collect(&folder.path().join("out")).expect("a result");
    let Findings::Map(mut rows, _) = collected.findings else { panic!("it is a map") };
    rows.remove(0).1
}

/// Keeps the one entry of a list that fits.
fn keep(table: &mut Table, key: &str, fits: impl Fn(&Value) -> bool) {
    let list = table[key].as_array_mut().expect("a list");
    list.retain(fits);
    assert_eq!(list.len(), 1, "{key}");
}

fn most(row: &Row) -> usize {
    assert_eq!(row.outcome, Outcome::Converged, "{}", row.cause);
    row.max_iterations().expect("steps were made")
}

/// The aim of the tank's map is 20; the corners are those where a step comes closest to it.
#[test]
fn heaviest_fluid_converges_at_small_and_large_steps() {
    for dt in ["1e-5", "0.01"] {
        let row = corner("tank", "IQN-IMVLS", ["100", dt], Some(2));
        assert!(most(&row) <= 20, "dt = {dt} s: {:?}", row.iterations);
    }
}

#[test]
fn heaviest_fluid_is_too_much_for_relaxation_and_for_the_textbook_and_they_say_so() {
    let row = corner("tank", "constant", ["100", "1e-5"], Some(2));
    assert_eq!((row.outcome, row.failing_step), (Outcome::Diverged, Some(1)), "{}", row.cause);
    assert!(row.cause.contains("|r| grew from") && row.remedy.contains("unseen_relaxation"), "{row:?}");
    let row = corner("tank", "IQN-IMVLS, textbook", ["100", "1e-5"], Some(2));
    assert_eq!((row.outcome, row.failing_step), (Outcome::Diverged, Some(1)), "{}", row.cause);
}

#[test]
fn one_newton_iteration_a_call_is_enough_for_the_heaviest_fluid() {
    let row = corner("limits", "IQN-IMVLS", ["1", "100"], Some(2));
    assert!(most(&row) <= 60, "{:?}", row.iterations);
}

#[test]
fn fast_flow_at_the_smallest_step_has_a_smooth_pressure() {
    for choice in ["BDF1", "BDF2", "BDF2 without grad-div"] {
        for dt in ["1e-7", "0.1"] {
            let row = corner("fluid", choice, ["100000", dt], Some(10));
            assert!(most(&row) <= 6, "{choice}, dt = {dt} s: {:?}", row.iterations);
            let oscillation = row.pressure_oscillation.expect("a fluid");
            assert!(oscillation < 0.04, "{choice}, dt = {dt} s: {oscillation}");
        }
    }
}

#[test]
fn small_steps_of_a_viscous_flow_need_grad_div() {
    let oscillation = |choice: &str| {
        let row = corner("fluid", choice, ["1", "1e-7"], Some(10));
        assert_eq!(row.outcome, Outcome::Converged, "{}", row.cause);
        row.pressure_oscillation.expect("a fluid")
    };
    let (with, without) = (oscillation("BDF2"), oscillation("BDF2 without grad-div"));
    assert!(with < 0.2 && without > 1.0, "{with} with it, {without} without");
}

#[test]
fn nearly_incompressible_flag_converges_on_the_finest_mesh() {
    for (choice, bound) in [("degree 1", 5), ("degree 2", 12), ("degree 3", 12)] {
        let row = corner("poisson", choice, ["0.4999", "72"], Some(2));
        assert!(most(&row) <= bound, "{choice}: {:?}", row.iterations);
    }
}

#[test]
fn low_degrees_lock_and_the_table_shows_it() {
    let displacement = |degree: &str| {
        corner("poisson", degree, ["0.4999", "9"], None).structure_displacement.expect("a structure")
    };
    let (locked, bent) = (displacement("degree 1"), displacement("degree 3"));
    assert!(locked < 0.2 * bent, "{locked} m against {bent} m");
}

#[test]
fn large_load_in_one_step_needs_a_line_search() {
    let row = corner("rotation", "neo-Hookean", ["500000", "1"], None);
    assert_eq!(row.outcome, Outcome::FieldFailed);
    assert!(row.cause.contains("det F") && row.remedy.contains("line search"), "{row:?}");
    let row = corner("rotation", "neo-Hookean, line search", ["500000", "1"], None);
    assert!(most(&row) <= 50, "{:?}", row.iterations);
}

#[test]
fn load_that_crushes_saint_venant_kirchhoff_is_refused_in_any_step() {
    let row = corner("rotation", "St. Venant-Kirchhoff, halved steps", ["500000", "1"], None);
    assert_eq!(row.outcome, Outcome::FieldFailed);
    assert!(row.retries > 0 && row.cause.contains("turned inside out"), "{row:?}");
}

#[test]
fn widest_swing_needs_the_last_mesh_and_small_steps() {
    let row = corner("swing", "elastic, chi = 1", ["0.17", "24"], None);
    assert_eq!(row.outcome, Outcome::FieldFailed);
    assert!(row.cause.contains("mesh motion: cell") && row.cause.contains("is inverted"), "{}", row.cause);
    // A quarter of the swing: out to the widest.
    let row = corner("swing", "elastic, chi = 1, from the last mesh", ["0.17", "24"], Some(6));
    assert!(most(&row) <= 7, "{:?}", row.iterations);
    assert!(row.mesh_quality.expect("a mesh that moves") > 0.01, "{:?}", row.mesh_quality);
}
