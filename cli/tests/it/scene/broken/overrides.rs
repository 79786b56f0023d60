//! Overrides that break a sound scene.

use insta::assert_snapshot;

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
      × the fluid is enclosed, and its boundary moves
        ╭─[scene.toml:16:8]
     15 │ 
     16 │ [fluid.boundary]
        ·        ────┬───
        ·            ╰── every group prescribes the velocity
     17 │ left = "no_slip"
        ╰────
      help: an incompressible fluid cannot give way, and its pressure has no level: make one group
            "stress_free" or "do_nothing"
            without the overrides the scene is sound: look at the `--set`s
    "#);
}
