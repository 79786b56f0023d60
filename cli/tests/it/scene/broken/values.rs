//! Values: out of range, of the wrong kind or length, unknown choices, expressions.

use insta::assert_snapshot;

use super::broken;

#[test]
fn a_negative_density_is_refused() {
    assert_snapshot!(broken("density = 1000.0\nvisc", "density = -1000.0\nvisc"), @r#"
      × fluid.density: -1000 is not a number above zero
       ╭─[scene.toml:8:11]
     7 │ [fluid]
     8 │ density = -1000.0
       ·           ───┬───
       ·              ╰── out of range
     9 │ viscosity = 200.0
       ╰────
      help: Density [kg/m3].
    "#);
}

#[test]
fn a_poisson_ratio_of_one_half_is_refused() {
    assert_snapshot!(broken("poisson_ratio = 0.3", "poisson_ratio = 0.5"), @r#"
      × structure.material.saint_venant_kirchhoff.poisson_ratio: 0.5 is not a Poisson ratio, above -1
      │ and below 0.5
        ╭─[scene.toml:34:17]
     33 │ young_modulus = 5e6
     34 │ poisson_ratio = 0.5
        ·                 ─┬─
        ·                  ╰── out of range
     35 │ 
        ╰────
      help: Poisson ratio; towards 0.5 the material becomes incompressible and these elements lock.
    "#);
}

#[test]
fn a_spectral_radius_above_one_is_refused() {
    assert_snapshot!(broken("[structure.geometry", "[structure.time_scheme.generalized_alpha]\nspectral_radius = 1.5\n\n[structure.geometry"), @r#"
      × structure.time_scheme.generalized_alpha.spectral_radius: 1.5 is not a spectral radius, from 0
      │ to 1
        ╭─[scene.toml:28:19]
     27 │ [structure.time_scheme.generalized_alpha]
     28 │ spectral_radius = 1.5
        ·                   ─┬─
        ·                    ╰── out of range
     29 │ 
        ╰────
      help: Spectral radius at infinite frequency: 1 keeps the energy, and the interface force
            oscillates from step to step; 0 damps most. Default: 0.5.
    "#);
}

#[test]
fn zero_steps_are_refused() {
    assert_snapshot!(broken("steps = 50", "steps = 0"), @r#"
      × time.steps: 0 is not a count of at least 1
       ╭─[scene.toml:5:9]
     4 │ step = 0.01
     5 │ steps = 0
       ·         ┬
       ·         ╰── out of range
     6 │ 
       ╰────
      help: Number of time steps.
    "#);
}

#[test]
fn half_a_step_is_refused() {
    assert_snapshot!(broken("steps = 50", "steps = 50.5"), @r#"
      × time.steps should be a whole number
       ╭─[scene.toml:5:9]
     4 │ step = 0.01
     5 │ steps = 50.5
       ·         ──┬─
       ·           ╰── not a whole number
     6 │ 
       ╰────
      help: give a whole number
            Number of time steps.
    "#);
}

#[test]
fn not_a_number_is_refused() {
    assert_snapshot!(broken("step = 0.01", "step = nan"), @r#"
      × time.step: NaN is not a number above zero
       ╭─[scene.toml:4:8]
     3 │ [time]
     4 │ step = nan
       ·        ─┬─
       ·         ╰── out of range
     5 │ steps = 50
       ╰────
      help: Size of a time step [s].
    "#);
}

#[test]
fn text_for_a_number_is_refused() {
    assert_snapshot!(broken("density = 1000.0\nvisc", "density = \"1000\"\nvisc"), @r#"
      × fluid.density should be a number
       ╭─[scene.toml:8:11]
     7 │ [fluid]
     8 │ density = "1000"
       ·           ───┬──
       ·              ╰── not a number
     9 │ viscosity = 200.0
       ╰────
      help: a number stands without quotes
            Density [kg/m3].
    "#);
}

#[test]
fn a_number_for_text_is_refused() {
    assert_snapshot!(broken("title = \"Sound\"", "title = 3"), @r#"
      × title should be text in quotes
       ╭─[scene.toml:1:9]
     1 │ title = 3
       ·         ┬
       ·         ╰── not text in quotes
     2 │ 
       ╰────
      help: give text in quotes
            One line that names the scene.
    "#);
}

#[test]
fn a_date_for_a_number_is_refused() {
    assert_snapshot!(broken("step = 0.01", "step = 2021-06-30"), @r#"
      × time.step should be a number
       ╭─[scene.toml:4:8]
     3 │ [time]
     4 │ step = 2021-06-30
       ·        ─────┬────
       ·             ╰── not a number
     5 │ steps = 50
       ╰────
      help: give a number
            Size of a time step [s].
    "#);
}

#[test]
fn three_components_in_two_dimensions_are_refused() {
    assert_snapshot!(broken("[0.0, -9.81]", "[0.0, 0.0, -9.81]"), @r#"
      × fluid.body_force should be a list of 2 entries
        ╭─[scene.toml:10:14]
      9 │ viscosity = 200.0
     10 │ body_force = [0.0, 0.0, -9.81]
        ·              ────────┬────────
        ·                      ╰── a list of 3
     11 │ 
        ╰────
      help: leave 2 entries
    "#);
}

#[test]
fn one_component_in_two_dimensions_is_refused() {
    assert_snapshot!(broken("[0.0, -9.81]", "[-9.81]"), @r#"
      × fluid.body_force should be a list of 2 entries
        ╭─[scene.toml:10:14]
      9 │ viscosity = 200.0
     10 │ body_force = [-9.81]
        ·              ───┬───
        ·                 ╰── not a list of 2 entries
     11 │ 
        ╰────
      help: give a list of 2 entries
            Force per mass [m/s2], numbers or expressions of `x`, `y`, `t`. Default: none.
    "#);
}

#[test]
fn an_unknown_side_names_the_nearest_one() {
    assert_snapshot!(broken("[\"left\", \"right\"]", "[\"left\", \"rigth\"]"), @r#"
     × the patch of the structure has no part `rigth`
       ╭─[scene.toml:24:11]
    23 │ density = 1000.0
    24 │ clamped = ["left", "rigth"]
       ·           ────────┬────────
       ·                   ╰── unknown part
    25 │ wetted = ["top"]
       ╰────
     help: did you mean `right`?
    "#);
}

#[test]
fn an_unknown_condition_names_the_nearest_one() {
    assert_snapshot!(broken("top = \"stress_free\"", "top = \"stressfree\""), @r#"
      × fluid.boundary.top cannot be `stressfree`
        ╭─[scene.toml:19:7]
     18 │ right = "no_slip"
     19 │ top = "stressfree"
        ·       ──────┬─────
        ·             ╰── unknown choice
     20 │ bottom = "interface"
        ╰────
      help: did you mean `stress_free`?
    "#);
}

#[test]
fn an_unknown_choice_lists_the_choices() {
    assert_snapshot!(broken("viscosity = 200.0", "viscosity = 200.0\ntangent = \"exact\""), @r#"
      × fluid.tangent cannot be `exact`
        ╭─[scene.toml:10:11]
      9 │ viscosity = 200.0
     10 │ tangent = "exact"
        ·           ───┬───
        ·              ╰── unknown choice
     11 │ body_force = [0.0, -9.81]
        ╰────
      help: choices: full, frozen_tau, picard
    "#);
}

#[test]
fn two_choices_in_one_place_are_refused() {
    assert_snapshot!(broken("[coupling.acceleration.iqn_imvls]", "[coupling.acceleration.aitken]\n\n[coupling.acceleration.iqn_imvls]"), @r#"
      × coupling.acceleration names 2 choices
        ╭─[scene.toml:36:24]
     35 │ 
     36 │ [coupling.acceleration.aitken]
        ·                        ───┬──
        ·                           ╰── `aitken`
     37 │ 
     38 │ [coupling.acceleration.iqn_imvls]
        ·                        ────┬────
        ·                            ╰── `iqn_imvls`
     39 │ initial_relaxation = 0.1
        ╰────
      help: keep one; known are constant, aitken, iqn_ils, iqn_mvj, iqn_imvls
    "#);
}

#[test]
fn a_choice_that_needs_values_says_which() {
    assert_snapshot!(broken("left = \"no_slip\"", "left = \"velocity\""), @r#"
      × fluid.boundary.left.velocity should be a list of 2 entries
        ╭─[scene.toml:17:8]
     16 │ [fluid.boundary]
     17 │ left = "velocity"
        ·        ─────┬────
        ·             ╰── not a list of 2 entries
     18 │ right = "no_slip"
        ╰────
      help: give a list of 2 entries
            Given velocity [m/s] in `x`, `y`, `t`.
    "#);
}

#[test]
fn an_open_parenthesis_in_an_expression_is_shown() {
    assert_snapshot!(broken("left = \"no_slip\"", "left = { velocity = [\"4*y*(1 - y\", 0] }"), @r#"
      × fluid.boundary.left.velocity holds an expression that cannot be read
        ╭─[scene.toml:17:27]
     16 │ [fluid.boundary]
     17 │ left = { velocity = ["4*y*(1 - y", 0] }
        ·                           ┬
        ·                           ╰── this parenthesis is never closed
     18 │ right = "no_slip"
        ╰────
      help: an expression may use x, y [m], t [s], pi, + - * / ^ and functions such as sin, exp, sqrt,
            min
    "#);
}

#[test]
fn an_unknown_name_in_an_expression_is_shown() {
    assert_snapshot!(broken("[0.0, -9.81]", "[0.0, '-9.81*min(tau, 1)']"), @r#"
      × fluid.body_force holds an expression that cannot be read
        ╭─[scene.toml:10:31]
      9 │ viscosity = 200.0
     10 │ body_force = [0.0, '-9.81*min(tau, 1)']
        ·                               ─┬─
        ·                                ╰── `tau` is unknown; known are x, y, t, pi and functions such as `sin`
     11 │ 
        ╰────
      help: an expression may use x, y [m], t [s], pi, + - * / ^ and functions such as sin, exp, sqrt,
            min
    "#);
}

#[test]
fn an_unlimited_count_below_its_least_is_refused() {
    assert_snapshot!(broken("[coupling.acceleration", "[coupling.newton.fixed]\nfluid = 0\n\n[coupling.acceleration"), @r#"
      × coupling.newton.fixed.fluid should be a count of at least 1, or "unlimited"
        ╭─[scene.toml:37:9]
     36 │ [coupling.newton.fixed]
     37 │ fluid = 0
        ·         ┬
        ·         ╰── not a count of at least 1, or "unlimited"
     38 │ 
        ╰────
      help: give a count of at least 1, or "unlimited"
            Newton iterations of one fluid call, or `"unlimited"`: to convergence. Default:
            `"unlimited"`.
    "#);
}
