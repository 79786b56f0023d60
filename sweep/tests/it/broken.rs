//! Broken studies and the messages they give.

use insta::assert_snapshot;
use miette::{GraphicalReportHandler, GraphicalTheme};
use partita_scene::file_kind::FileKind;
use partita_sweep::Sweep;

use crate::support::{Case, SOUND};

/// The message for a study, its file without the folder.
fn message(study: &str) -> String {
    let case = Case::new(study);
    let error = Sweep::load_as(FileKind::Study, case.file()).expect_err("the study is broken");
    let mut message = String::new();
    GraphicalReportHandler::new_themed(GraphicalTheme::unicode_nocolor())
        .with_width(100)
        .render_report(&mut message, &error)
        .expect("a string takes everything");
    message.replace(&format!("{}/", case.path().display()), "")
}

/// The message for the sound study with `old` replaced by `new`.
fn broken(old: &str, new: &str) -> String {
    assert!(SOUND.contains(old), "{old} is not in the sound study");
    message(&SOUND.replacen(old, new, 1))
}

#[test]
fn a_misspelled_key_is_shown() {
    assert_snapshot!(broken("column =", "colum ="), @r#"
     × `colum` is not a key of a study
       ╭─[bending.toml:12:1]
    11 │ name = "deflection of the tip"
    12 │ colum = "tip_displacement_y"
       · ──┬──
       ·   ╰── unknown key
    13 │ take = "last"
       ╰────
     help: did you mean `column`?
    "#);
}

#[test]
fn a_missing_key_says_what_to_give() {
    assert_snapshot!(broken("take = \"last\"\n", ""), @r#"
     × the study lacks `take`
       ╭─[bending.toml:10:1]
     9 │ 
    10 │ [quantity]
       · ─────┬────
       ·      ╰── `take` is missing here
    11 │ name = "deflection of the tip"
       ╰────
     help: choose one of last, max, min, mean, history
    "#);
}

#[test]
fn an_unknown_word_names_the_known_ones() {
    assert_snapshot!(broken("take = \"last\"", "take = \"end\""), @r#"
     × `end` cannot be chosen here
       ╭─[bending.toml:13:8]
    12 │ column = "tip_displacement_y"
    13 │ take = "end"
       ·        ──┬──
       ·          ╰── unknown choice
    14 │ 
       ╰────
     help: choose one of last, max, min, mean, history
    "#);
}

#[test]
fn a_wrong_kind_is_shown() {
    assert_snapshot!(broken("wanted = 1e-4", "wanted = \"small\""), @r#"
     × this should be a number
      ╭─[bending.toml:3:10]
    2 │ scene = "cantilever.toml"
    3 │ wanted = "small"
      ·          ───┬───
      ·             ╰── not a number
    4 │ refinements = [
      ╰────
     help: give a number
    "#);
}

#[test]
fn what_is_no_toml_is_shown() {
    assert_snapshot!(broken("wanted = 1e-4", "wanted 1e-4"), @r#"
     × this is not TOML
      ╭─[bending.toml:3:8]
    2 │ scene = "cantilever.toml"
    3 │ wanted 1e-4
      ·        ▲
      ·        ╰── key with no value, expected `=`
    4 │ refinements = [
      ╰────
     help: a study is written in TOML: lines `key = value` under headings `[table]`
    "#);
}

#[test]
fn an_error_below_zero_is_refused() {
    assert_snapshot!(broken("wanted = 1e-4", "wanted = -1"), @r#"
     × wanted: -1 is not a number above zero
      ╭─[bending.toml:3:10]
    2 │ scene = "cantilever.toml"
    3 │ wanted = -1
      ·          ─┬
      ·           ╰── out of range
    4 │ refinements = [
      ╰────
     help: give the error that is to be reached, or leave it out
    "#);
}

#[test]
fn an_override_that_does_not_fit_the_scene_is_shown_in_the_study() {
    assert_snapshot!(broken("degree=[3, 2]", "degree=[30, 2]"), @r#"
     × structure.geometry.rectangle.degree: 30 is not a spline degree, from 1 to 9
       ╭─[bending.toml:23:8]
    22 │ name = "degree 3"
    23 │ set = ["structure.geometry.rectangle.degree=[30, 2]"]
       ·        ──────────────────────┬──────────────────────
       ·                              ╰── this override does not fit
       ╰────
     help: Spline degree along each side, each from 1 to 9. Default: `[2, 2]`.
    "#);
}

#[test]
fn an_override_of_a_key_that_is_not_there_is_shown_in_the_study() {
    assert_snapshot!(broken("elements=[4, 1]", "element=[4, 1]"), @r#"
     × `element` is not a key of [structure.geometry.rectangle]
      ╭─[bending.toml:6:35]
    5 │     { name = "2 elements", set = [] },
    6 │     { name = "4 elements", set = ["structure.geometry.rectangle.element=[4, 1]"] },
      ·                                   ──────────────────────┬──────────────────────
      ·                                                         ╰── this override does not fit
    7 │     { name = "8 elements", set = ["structure.geometry.rectangle.elements=[8, 1]"] },
      ╰────
     help: did you mean `elements`?
    "#);
}

#[test]
fn a_scene_that_is_not_there_is_named() {
    assert_snapshot!(broken("cantilever.toml", "beam.toml"), @r#"
     × beam.toml cannot be read: No such file or directory (os error 2)
      ╭─[bending.toml:2:9]
    1 │ title = "Cantilever: elements and degree"
    2 │ scene = "beam.toml"
      ·         ─────┬─────
      ·              ╰── in this scene
    3 │ wanted = 1e-4
      ╰────
     help: name a scene file, or a folder with a `scene.toml` in it
    "#);
}

#[test]
fn a_column_that_is_not_probed_names_the_nearest() {
    assert_snapshot!(broken("tip_displacement_y", "tip_displacment_y"), @r#"
     × the scene has no column `tip_displacment_y`
       ╭─[bending.toml:12:10]
    11 │ name = "deflection of the tip"
    12 │ column = "tip_displacment_y"
       ·          ─────────┬─────────
       ·                   ╰── not probed
    13 │ take = "last"
       ╰────
     help: did you mean `tip_displacement_y`?
    "#);
}

#[test]
fn runs_that_end_at_different_times_are_not_compared() {
    assert_snapshot!(broken("set = [] }", "set = [\"time.steps=2\"] }"), @r#"
     × the runs end at different times: 1 s and 2 s
      ╭─[bending.toml:5:14]
    4 │ refinements = [
    5 │     { name = "2 elements", set = ["time.steps=2"] },
      ·              ──────┬─────
      ·                    ╰── 2 steps of 1 s
    6 │     { name = "4 elements", set = ["structure.geometry.rectangle.elements=[4, 1]"] },
      ╰────
     help: set time.steps together with time.step, or say with `to` under [quantity] up to when
           values count
    "#);
}

#[test]
fn a_window_without_a_step_is_shown() {
    assert_snapshot!(broken("take = \"last\"", "take = \"last\"\nfrom = 2\nto = 3"), @r#"
     × no step ends between t = 2 s and t = 3 s
      ╭─[bending.toml:5:14]
    4 │ refinements = [
    5 │     { name = "2 elements", set = [] },
      ·              ──────┬─────
      ·                    ╰── ends at t = 1 s
    6 │     { name = "4 elements", set = ["structure.geometry.rectangle.elements=[4, 1]"] },
      ╰────
     help: change the window `from`, `to` under [quantity], or time.steps
    "#);
}

#[test]
fn a_window_that_ends_before_it_begins_is_shown() {
    assert_snapshot!(broken("take = \"last\"", "take = \"last\"\nfrom = 3\nto = 2"), @r#"
     × the window ends before it begins
       ╭─[bending.toml:15:6]
    14 │ from = 3
    15 │ to = 2
       ·      ┬
       ·      ╰── before from = 3
    16 │ 
       ╰────
     help: give times with `from` below `to`, or leave one out
    "#);
}

#[test]
fn a_reference_is_a_run_or_a_value() {
    assert_snapshot!(broken("[reference]\nset = [", "[reference]\nvalue = 1\nset = ["), @r#"
     × [reference] gives both a run and a value
       ╭─[bending.toml:16:9]
    15 │ [reference]
    16 │ value = 1
       ·         ┬
       ·         ╰── `set` makes a run, too
    17 │ set = ["structure.geometry.rectangle.elements=[16, 1]", "structure.geometry.rectangle.degree=[4, 2]"]
       ╰────
     help: keep one of the two
    "#);
    assert_snapshot!(broken("[reference]\nset = [", "[reference]\ncheck = ["), @r#"
     × [reference] gives neither a run nor a value
       ╭─[bending.toml:15:1]
    14 │ 
    15 │ [reference]
       · ─────┬─────
       ·      ╰── nothing to measure against
    16 │ check = ["structure.geometry.rectangle.elements=[16, 1]", "structure.geometry.rectangle.degree=[4, 2]"]
       ╰────
     help: give `set`, the overrides of a finer run, or `value`
    "#);
}

#[test]
fn a_relative_error_of_nothing_is_refused() {
    let start = SOUND.find("[reference]").expect("a reference");
    let end = SOUND.find("[[choice]]").expect("a choice");
    let text = format!("{}[reference]\nvalue = 0\n\n{}", &SOUND[..start], &SOUND[end..]);
    assert_snapshot!(message(&text), @r#"
     × an error relative to 0 is no number
       ╭─[bending.toml:16:9]
    15 │ [reference]
    16 │ value = 0
       ·         ┬
       ·         ╰── nothing to compare with
    17 │ 
       ╰────
     help: give `error = "absolute"` under [quantity]
    "#);
    assert_snapshot!(message(&text.replace("\"last\"", "\"history\"")), @r#"
     × a history cannot be measured against one value
       ╭─[bending.toml:13:8]
    12 │ column = "tip_displacement_y"
    13 │ take = "history"
       ·        ────┬────
       ·            ╰── needs a reference run
    14 │ 
       ╰────
     help: give `set` under [reference], or take "last", "max", "min" or "mean"
    "#);
}

#[test]
fn two_choices_of_one_name_are_refused() {
    assert_snapshot!(broken("degree 3", "degree 2"), @r#"
     × two choices have this name
       ╭─[bending.toml:22:8]
    21 │ [[choice]]
    22 │ name = "degree 2"
       ·        ─────┬────
       ·             ╰── the second time
    23 │ set = ["structure.geometry.rectangle.degree=[3, 2]"]
       ╰────
     help: give each its own name
    "#);
}

#[test]
fn a_choice_without_refinements_is_refused() {
    let start = SOUND.find("refinements").expect("refinements");
    let end = SOUND.find("[quantity]").expect("a quantity");
    assert_snapshot!(message(&format!("{}{}", &SOUND[..start], &SOUND[end..])), @r#"
     × the choice `degree 2` has no refinements
       ╭─[bending.toml:13:8]
    12 │ [[choice]]
    13 │ name = "degree 2"
       ·        ─────┬────
       ·             ╰── a curve without points
    14 │ 
       ╰────
     help: give it `refinements`, or put some above all choices: a list of { name = "...", set =
           [..] }
    "#);
}
