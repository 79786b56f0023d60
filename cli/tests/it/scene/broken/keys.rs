//! Text that is no TOML, and keys: misspelled, missing, in the wrong place.

use insta::assert_snapshot;

use super::broken;

#[test]
fn a_misspelled_key_names_the_nearest_one() {
    assert_snapshot!(broken("density = 1000.0\nvisc", "densty = 1000.0\nvisc"), @r#"
      × `densty` is not a key of [fluid]
       ╭─[scene.toml:8:1]
     7 │ [fluid]
     8 │ densty = 1000.0
       · ───┬──
       ·    ╰── unknown key
     9 │ viscosity = 200.0
       ╰────
      help: did you mean `density`?
    "#);
}

#[test]
fn a_strange_key_lists_the_keys() {
    assert_snapshot!(broken("viscosity = 200.0", "viscosity = 200.0\ncolour = \"blue\""), @r#"
      × `colour` is not a key of [fluid]
        ╭─[scene.toml:10:1]
      9 │ viscosity = 200.0
     10 │ colour = "blue"
        · ───┬──
        ·    ╰── unknown key
     11 │ body_force = [0.0, -9.81]
        ╰────
      help: keys of [fluid]: density, viscosity, body_force, time_scheme, convection, tangent,
            inverse_constant, grad_div, pressure_pin, mesh, boundary, initial, newton, mesh_motion
    "#);
}

#[test]
fn a_misspelled_table_is_found() {
    assert_snapshot!(broken("[fluid.boundary]", "[fluid.boundry]"), @r#"
      × `boundry` is not a key of [fluid]
        ╭─[scene.toml:16:8]
     15 │ 
     16 │ [fluid.boundry]
        ·        ───┬───
        ·           ╰── unknown key
     17 │ left = "no_slip"
        ╰────
      help: did you mean `boundary`?
    "#);
}

#[test]
fn a_key_of_a_choice_is_checked() {
    assert_snapshot!(broken("initial_relaxation = 0.1", "relaxation = 0.1"), @r#"
      × `relaxation` is not a key of [coupling.acceleration.iqn_imvls]
        ╭─[scene.toml:37:1]
     36 │ [coupling.acceleration.iqn_imvls]
     37 │ relaxation = 0.1
        · ─────┬────
        ·      ╰── unknown key
        ╰────
      help: `relaxation` is a key of [coupling.acceleration.constant]
    "#);
}

#[test]
fn a_missing_key_is_named() {
    assert_snapshot!(broken("viscosity = 200.0\n", ""), @r#"
      × [fluid] lacks `viscosity`
       ╭─[scene.toml:7:1]
     6 │ 
     7 │ [fluid]
       · ───┬───
       ·    ╰── `viscosity` is missing here
     8 │ density = 1000.0
       ╰────
      help: set `fluid.viscosity`, it has no default
            Dynamic viscosity [Pa s].
    "#);
}

#[test]
fn a_missing_table_is_named() {
    assert_snapshot!(broken("[structure.geometry.rectangle]\norigin = [0.0, -0.05]\nsize = [1.0, 0.05]\nelements = [60, 1]\n", ""), @r"
     × [structure] lacks `geometry`
       ╭─[scene.toml:22:1]
    21 │ 
    22 │ [structure]
       · ─────┬─────
       ·      ╰── `geometry` is missing here
    23 │ density = 1000.0
       ╰────
     help: choose `structure.geometry`, it has no default: rectangle, arc, curve, spline, gmsh
           Where the structure is.
    ");
}

#[test]
fn a_missing_title_is_named() {
    assert_snapshot!(broken("title = \"Sound\"\n", ""), @r#"
      × the scene lacks `title`
       ╭─[scene.toml:1:1]
     1 │ 
       · ▲
       · ╰── `title` is missing here
     2 │ [time]
     3 │ step = 0.01
       ╰────
      help: set `title`, it has no default
            One line that names the scene.
    "#);
}

#[test]
fn missing_steps_are_named() {
    assert_snapshot!(broken("steps = 50\n", ""), @r#"
      × [time] lacks `steps`
       ╭─[scene.toml:3:1]
     2 │ 
     3 │ [time]
       · ───┬──
       ·    ╰── `steps` is missing here
     4 │ step = 0.01
       ╰────
      help: set `time.steps`, it has no default
            Number of time steps.
    "#);
}

#[test]
fn a_value_that_is_missing_is_no_toml() {
    assert_snapshot!(broken("steps = 50", "steps ="), @r#"
      × a value is missing
       ╭─[scene.toml:5:8]
     4 │ step = 0.01
     5 │ steps =
       ·        ▲
       ·        ╰── missing here
     6 │ 
       ╰────
      help: write `key = value`
    "#);
}

#[test]
fn a_list_for_a_table_is_refused() {
    assert_snapshot!(broken("[time]\nstep = 0.01\nsteps = 50\n", "time = [0.01, 50]\n"), @r#"
      × time should be a table
       ╭─[scene.toml:3:8]
     2 │ 
     3 │ time = [0.01, 50]
       ·        ─────┬────
       ·             ╰── not a table
     4 │ 
       ╰────
      help: write a table [time] with one `key = value` a line
    "#);
}

#[test]
fn double_brackets_are_refused() {
    assert_snapshot!(broken("[time]", "[[time]]"), @r#"
      × time is a list of tables
       ╭─[scene.toml:3:1]
     2 │ 
     3 │ [[time]]
       · ────┬───
       ·     ╰── double brackets make a list
     4 │ step = 0.01
       ╰────
      help: write [time]
    "#);
}

#[test]
fn a_duplicate_key_is_refused() {
    assert_snapshot!(broken("steps = 50", "steps = 50\nsteps = 60"), @r#"
      × `steps` is set twice
       ╭─[scene.toml:6:1]
     5 │ steps = 50
     6 │ steps = 60
       · ──┬──
       ·   ╰── the second time
     7 │ 
       ╰────
      help: keep one of the two
    "#);
}

#[test]
fn an_unquoted_word_is_refused() {
    assert_snapshot!(broken("left = \"no_slip\"", "left = no_slip"), @r#"
      × `no_slip` is no value
        ╭─[scene.toml:17:8]
     16 │ [fluid.boundary]
     17 │ left = no_slip
        ·        ───┬───
        ·           ╰── text stands in quotes
     18 │ right = "no_slip"
        ╰────
      help: write "no_slip"
    "#);
}

#[test]
fn an_unclosed_heading_is_refused() {
    assert_snapshot!(broken("[coupling.acceleration.iqn_imvls]", "[coupling.acceleration.iqn_imvls"), @r#"
      × this is not TOML
        ╭─[scene.toml:36:33]
     35 │ 
     36 │ [coupling.acceleration.iqn_imvls
        ·                                 ▲
        ·                                 ╰── unclosed table, expected `]`
     37 │ initial_relaxation = 0.1
        ╰────
      help: a scene is written in TOML: lines `key = value` under headings `[table]`
    "#);
}
