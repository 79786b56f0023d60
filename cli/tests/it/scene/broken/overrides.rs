//! Overrides that break a sound scene.

use insta::assert_snapshot;

use std::fs;

use partita::scene::load;

use super::{SOUND, message};

#[test]
fn an_override_out_of_range_is_shown_as_it_was_given() {
    assert_snapshot!(message(SOUND, &["fluid.density=-3"]), @r#"
      × fluid.density: -3 is not a number above zero
       ╭─[--set:1:17]
     1 │ fluid.density = -3
       ·                 ─┬
       ·                  ╰── out of range
       ╰────
      help: Density [kg/m3].
            without the overrides the scene is sound: look at the `--set`s
    "#);
}

#[test]
fn an_override_with_a_misspelled_key_is_shown() {
    assert_snapshot!(message(SOUND, &["fluid.densty=3"]), @r#"
      × `densty` is not a key of [fluid]
       ╭─[--set:1:7]
     1 │ fluid.densty = 3
       ·       ───┬──
       ·          ╰── unknown key
       ╰────
      help: did you mean `density`?
            without the overrides the scene is sound: look at the `--set`s
    "#);
}

#[test]
fn an_override_inside_a_value_is_refused() {
    assert_snapshot!(message(SOUND, &["fluid.density.value=3"]), @r#"
      × fluid.density is a value, not a table
       ╭─[--set:1:7]
     1 │ fluid.density.value = 3
       ·       ───┬───
       ·          ╰── nothing can be set inside it
       ╰────
      help: set `fluid.density` itself
            without the overrides the scene is sound: look at the `--set`s
    "#);
}

#[test]
fn an_override_without_a_value_is_refused() {
    assert_snapshot!(message(SOUND, &["fluid.density"]), @r#"
      × there is no `=` in it
       ╭─[--set:1:1]
     1 │ fluid.density
       · ─────────────
       ╰────
      help: an override is `--set key.path=value`, such as `--set time.steps=3`
    "#);
}

#[test]
fn an_override_with_half_a_list_is_refused() {
    assert_snapshot!(message(SOUND, &["fluid.body_force=[1,"]), @r#"
      × `[1,` is neither a TOML value nor a bare word
       ╭─[--set:1:1]
     1 │ fluid.body_force=[1,
       · ────────────────────
       ╰────
      help: an override is `--set key.path=value`, such as `--set time.steps=3`
    "#);
}

#[test]
fn an_override_that_breaks_the_fit_is_shown() {
    assert_snapshot!(message(SOUND, &["fluid.boundary.top=no_slip"]), @r#"
      × the fluid is enclosed, and an elastic structure moves its boundary
        ╭─[scene.toml:16:8]
     15 │ 
     16 │ [fluid.boundary]
        ·        ────┬───
        ·            ╰── every group prescribes the velocity
     17 │ left = "no_slip"
        ╰────
      help: an incompressible fluid keeps its volume, which the iterates of a structure do not: make
            one group "stress_free" or "do_nothing"
            without the overrides the scene is sound: look at the `--set`s
    "#);
}

/// The sound scene with its defaults written out, as the shipped scene writes them.
fn spelled_out() -> String {
    format!(
        "{SOUND}filter = {{ qr3 = 0.1 }}\n\n[coupling.newton.fixed]\nfluid = \"unlimited\"\n\n\
         [fluid.newton]\ntolerance = {{ absolute = 5e-9 }}\n"
    )
}

#[test]
fn a_policy_out_of_range_is_blamed_on_the_override() {
    assert_snapshot!(message(&spelled_out(), &["coupling.newton.until_coupled=0"]), @r#"
     × coupling.newton.until_coupled: 0 is not a count of at least 1
      ╭─[--set:1:33]
    1 │ coupling.newton.until_coupled = 0
      ·                                 ┬
      ·                                 ╰── out of range
      ╰────
     help: So many until the coupling criterion is met, then to convergence.
           without the overrides the scene is sound: look at the `--set`s
    "#);
}

#[test]
fn a_bound_of_interface_data_out_of_range_is_blamed_on_the_override() {
    assert_snapshot!(message(&spelled_out(), &["coupling.newton.converged_interface_data=2"]), @r#"
     × coupling.newton.converged_interface_data: 2 is not a number above 0 and below 1
      ╭─[--set:1:44]
    1 │ coupling.newton.converged_interface_data = 2
      ·                                            ┬
      ·                                            ╰── out of range
      ╰────
     help: Until one more Newton iteration changes the call's result by less than this part.
           without the overrides the scene is sound: look at the `--set`s
    "#);
}

#[test]
fn a_tolerance_out_of_range_is_blamed_on_the_override() {
    assert_snapshot!(message(&spelled_out(), &["fluid.newton.tolerance.absolute=-1"]), @r#"
     × fluid.newton.tolerance.absolute: -1 is not a number above zero
      ╭─[--set:1:35]
    1 │ fluid.newton.tolerance.absolute = -1
      ·                                   ─┬
      ·                                    ╰── out of range
      ╰────
     help: In the unit of what is measured: for a residual of forces N, in two dimensions N/m; for
           the interface residual m.
           without the overrides the scene is sound: look at the `--set`s
    "#);
}

#[test]
fn a_filter_out_of_range_is_named_with_its_whole_key() {
    assert_snapshot!(message(&spelled_out(), &["coupling.acceleration.iqn_imvls.filter.qr3=2"]), @r#"
     × coupling.acceleration.iqn_imvls.filter.qr3: 2 is not a number above 0 and below 1
      ╭─[--set:1:46]
    1 │ coupling.acceleration.iqn_imvls.filter.qr3 = 2
      ·                                              ┬
      ·                                              ╰── out of range
      ╰────
     help: Drops a column whose part orthogonal to the newer ones is below this part of its own
           length.
           without the overrides the scene is sound: look at the `--set`s
    "#);
}

#[test]
fn a_choice_in_a_choice_is_blamed_on_the_override() {
    assert_snapshot!(message(&spelled_out(), &["coupling.convergence.interface_residual.absolute=-1"]), @r#"
     × coupling.convergence.interface_residual.absolute: -1 is not a number above zero
      ╭─[--set:1:52]
    1 │ coupling.convergence.interface_residual.absolute = -1
      ·                                                    ─┬
      ·                                                     ╰── out of range
      ╰────
     help: In the unit of what is measured: for a residual of forces N, in two dimensions N/m; for
           the interface residual m.
           without the overrides the scene is sound: look at the `--set`s
    "#);
}

#[test]
fn a_filter_out_of_range_in_the_file_is_named_with_its_whole_key() {
    assert_snapshot!(message(&spelled_out().replace("qr3 = 0.1", "qr3 = 2"), &[]), @r#"
     × coupling.acceleration.iqn_imvls.filter.qr3: 2 is not a number above 0 and below 1
       ╭─[scene.toml:38:18]
    37 │ initial_relaxation = 0.1
    38 │ filter = { qr3 = 2 }
       ·                  ┬
       ·                  ╰── out of range
    39 │ 
       ╰────
     help: Drops a column whose part orthogonal to the newer ones is below this part of its own
           length.
    "#);
}

#[test]
fn two_choices_in_one_place_are_both_named() {
    assert_snapshot!(message(SOUND, &["coupling.newton.fixed.fluid=1", "coupling.newton.until_coupled=1"]), @r#"
     × coupling.newton cannot be both `fixed` and `until_coupled`
      ╭─[--set:1:1]
    1 │ coupling.newton.until_coupled = 1
      · ─────────────────────────────────
      ╰────
     help: leave out this one, or `--set coupling.newton.fixed.fluid = 1`
    "#);
}

#[test]
fn a_count_below_zero_says_what_is_counted() {
    assert_snapshot!(message(SOUND, &["output.fields_every=-1"]), @r#"
     × output.fields_every should be a count of zero or more
      ╭─[--set:1:23]
    1 │ output.fields_every = -1
      ·                       ─┬
      ·                        ╰── not a count of zero or more
      ╰────
     help: give a count of zero or more
           Steps between two files of fields; 0 writes none. Default: 1.
           without the overrides the scene is sound: look at the `--set`s
    "#);
}

#[test]
fn a_huge_number_keeps_its_exponent() {
    assert_snapshot!(message(SOUND, &["fluid.density=-1e300"]), @r#"
     × fluid.density: -1e300 is not a number above zero
      ╭─[--set:1:17]
    1 │ fluid.density = -1e300
      ·                 ───┬──
      ·                    ╰── out of range
      ╰────
     help: Density [kg/m3].
           without the overrides the scene is sound: look at the `--set`s
    "#);
}

#[test]
fn a_file_that_is_not_text_says_so() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("scene.toml");
    fs::write(&file, [0x74, 0xff, 0xfe]).expect("written");
    let error = load(&file, &[]).expect_err("not text");
    let text = format!("{error}\n{}", error.problems()[0].hint());
    assert_snapshot!(text.replace(&file.display().to_string(), "FILE"), @r#"
    FILE is not text
    a scene file is text in UTF-8: name that file, or save it as UTF-8
    "#);
}
