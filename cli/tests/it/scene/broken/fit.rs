//! Parts that are fine and do not fit together.

use insta::assert_snapshot;

use partita::scene::parse;

use super::{SOUND, broken, message};

#[test]
fn an_unknown_group_names_the_nearest_one() {
    assert_snapshot!(broken("bottom = \"interface\"", "botom = \"interface\""), @r#"
      × the mesh has no boundary group `botom`
        ╭─[scene.toml:20:1]
     19 │ top = "stress_free"
     20 │ botom = "interface"
        · ──┬──
        ·   ╰── unknown group
     21 │ 
        ╰────
      help: did you mean `bottom`?
    "#);
}

#[test]
fn a_group_too_many_lists_the_groups() {
    assert_snapshot!(broken("bottom = \"interface\"", "bottom = \"interface\"\noutlet = \"do_nothing\""), @r#"
      × the mesh has no boundary group `outlet`
        ╭─[scene.toml:21:1]
     20 │ bottom = "interface"
     21 │ outlet = "do_nothing"
        · ───┬──
        ·    ╰── unknown group
     22 │ 
        ╰────
      help: groups of the mesh: left, right, bottom, top
    "#);
}

#[test]
fn a_group_without_a_condition_is_named() {
    assert_snapshot!(broken("right = \"no_slip\"\nt", "t"), @r#"
      × boundary group `right` has no condition
        ╭─[scene.toml:16:8]
     15 │ 
     16 │ [fluid.boundary]
        ·        ────┬───
        ·            ╰── nothing about `right` here
     17 │ left = "no_slip"
        ╰────
      help: without one the equations are not closed: add `right = "no_slip"` or another condition
    "#);
}

#[test]
fn a_side_both_clamped_and_wetted_is_refused() {
    assert_snapshot!(broken("wetted = [\"top\"]", "wetted = [\"left\", \"top\"]"), @r#"
      × side `left` is both clamped and wetted
        ╭─[scene.toml:24:11]
     23 │ density = 1000.0
     24 │ clamped = ["left", "right"]
        ·           ────────┬────────
        ·                   ╰── does not move
     25 │ wetted = ["left", "top"]
        ·          ───────┬───────
        ·                 ╰── moves with the fluid
     26 │ 
        ╰────
      help: name it in one of the two
    "#);
}

#[test]
fn a_scene_without_an_interface_is_refused() {
    assert_snapshot!(broken("bottom = \"interface\"", "bottom = \"no_slip\""), @r#"
      × no boundary group of the fluid is the interface
        ╭─[scene.toml:16:8]
     15 │ 
     16 │ [fluid.boundary]
        ·        ────┬───
        ·            ╰── none of these is "interface"
     17 │ left = "no_slip"
        ╰────
      help: give the condition "interface" to the group that touches the structure
    "#);
}

#[test]
fn a_structure_that_is_not_wetted_is_refused() {
    assert_snapshot!(broken("wetted = [\"top\"]\n", ""), @r#"
      × no side of the structure touches the fluid
        ╭─[scene.toml:22:2]
     21 │ 
     22 │ [structure]
        ·  ────┬────
        ·      ╰── `wetted` is missing or empty
     23 │ density = 1000.0
        ╰────
      help: name the sides that touch the fluid: `wetted = ["top"]`
    "#);
}

#[test]
fn two_fields_need_a_coupling() {
    assert_snapshot!(broken("[coupling.acceleration.iqn_imvls]\ninitial_relaxation = 0.1\n", ""), @r#"
      × the scene has a fluid and a structure but no [coupling]
        ╭─[scene.toml:22:2]
     21 │ 
     22 │ [structure]
        ·  ────┬────
        ·      ╰── how does this meet the fluid?
     23 │ density = 1000.0
        ╰────
      help: add a table [coupling] with an acceleration, such as `acceleration = "iqn_imvls"`
    "#);
}

#[test]
fn an_enclosed_fluid_is_refused() {
    assert_snapshot!(broken("top = \"stress_free\"", "top = \"slip\""), @r#"
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
    "#);
}

#[test]
fn a_steady_fluid_and_inertia_do_not_go_together() {
    assert_snapshot!(broken("viscosity = 200.0", "viscosity = 200.0\ntime_scheme = \"steady\""), @r#"
      × a steady fluid is coupled with a structure that has inertia
        ╭─[scene.toml:10:15]
      9 │ viscosity = 200.0
     10 │ time_scheme = "steady"
        ·               ────┬───
        ·                   ╰── no time derivative here
     11 │ body_force = [0.0, -9.81]
        ╰────
        ╭─[scene.toml:23:2]
     22 │ 
     23 │ [structure]
        ·  ────┬────
        ·      ╰── but here
     24 │ density = 1000.0
        ╰────
      help: a steady fluid knows no wall velocity: take `structure.time_scheme = "quasi_static"`, or
            `fluid.time_scheme = "bdf1"`
    "#);
}

#[test]
fn a_probe_outside_the_mesh_is_refused() {
    assert_snapshot!(message(&format!("{SOUND}{}", "\n[output.probes]\ncentre = { fluid_value = [0.5, 1.5] }\n"), &[]), @r"
     × probe `centre` lies outside the fluid's mesh
       ╭─[scene.toml:40:26]
    39 │ [output.probes]
    40 │ centre = { fluid_value = [0.5, 1.5] }
       ·                          ─────┬────
       ·                               ╰── no triangle holds (0.5, 1.5) m
       ╰────
     help: give a point [m] inside the undeformed mesh
    ");
}

#[test]
fn several_mistakes_are_shown_together() {
    assert_snapshot!(broken("left = \"no_slip\"\nright = \"no_slip\"", "left = \"no_slip\"\nrigth = \"no_slip\"\ninside = \"slip\""), @r#"
      × 2 things are wrong in the scene

    Error: 
      × the mesh has no boundary group `rigth`
        ╭─[scene.toml:18:1]
     17 │ left = "no_slip"
     18 │ rigth = "no_slip"
        · ──┬──
        ·   ╰── unknown group
     19 │ inside = "slip"
        ╰────
      help: did you mean `right`?

    Error: 
      × the mesh has no boundary group `inside`
        ╭─[scene.toml:19:1]
     18 │ rigth = "no_slip"
     19 │ inside = "slip"
        · ───┬──
        ·    ╰── unknown group
     20 │ top = "stress_free"
        ╰────
      help: groups of the mesh: left, right, bottom, top
    "#);
}

#[test]
fn an_absurd_mesh_is_refused() {
    assert_snapshot!(broken("divisions = [10, 10]", "divisions = [4000000, 4000000]"), @r#"
      × the fluid's mesh would have about 6e13 cells
        ╭─[scene.toml:14:13]
     13 │ size = [1.0, 1.0]
     14 │ divisions = [4000000, 4000000]
        ·             ─────────┬────────
        ·                      ╰── too fine
     15 │ 
        ╰────
      help: at most 1e8 cells can be asked for
    "#);
}

/// The problems of the sound scene under these overrides, a line each.
fn problems(overrides: &[&str]) -> String {
    problems_of(SOUND, overrides)
}

fn problems_of(text: &str, overrides: &[&str]) -> String {
    let overrides: Vec<String> = overrides.iter().map(ToString::to_string).collect();
    let error = parse("scene.toml", text, &overrides).expect_err("the scene is broken");
    let mut lines: Vec<String> = error.problems().iter().map(ToString::to_string).collect();
    lines.push(String::new());
    lines.join("\n")
}

/// The sound scene without the tables that start with one of these headings.
fn without(headings: &[&str]) -> String {
    let tables = SOUND.split("\n[");
    let kept = tables.filter(|table| !headings.iter().any(|heading| table.starts_with(heading)));
    kept.collect::<Vec<_>>().join("\n[")
}

#[test]
fn every_misfit_has_its_own_words() {
    let mut all = String::new();
    for overrides in [
        &["fluid.mesh_motion.slide=[\"bottom\"]"][..],
        &["fluid.mesh_motion.slide=[\"lft\"]"],
        &["fluid.pressure_pin={ point = [0, 0], value = 0 }"],
        &["structure.clamped=[\"left\", \"left\"]"],
        &["structure.clamped=[]", "structure.time_scheme=quasi_static"],
        &["structure.time_scheme=quasi_static", "structure.rayleigh_damping={ mass = 1, stiffness = 0 }"],
        &["structure.geometry.rectangle.elements=[100000, 100000]"],
        &["structure.body_force=[0, \"-9.81*y\"]"],
        &["output.probes.drag.fluid_force=ceiling"],
    ] {
        all += &problems(overrides);
    }
    let fluid = without(&["structure", "coupling"]);
    let structure = without(&["fluid", "coupling"]);
    let dry = structure.replace("wetted = [\"top\"]\n", "");
    let walls = "fluid.boundary={ left = \"slip\", right = \"slip\", top = \"slip\", bottom = \"no_slip\" }";
    all += &problems_of(&fluid, &[]);
    all += &problems_of(&fluid, &[walls]);
    all += &problems_of(&structure, &[]);
    all += &problems_of(&dry, &["coupling.acceleration=aitken"]);
    all += &problems_of(&dry, &["output.probes.centre.fluid_value=[0, 0]"]);
    all += &problems_of(&without(&["fluid", "structure", "coupling"]), &[]);
    assert_snapshot!(all, @r#"
    mesh nodes cannot slide along `bottom`, which moves itself
    the mesh has no boundary group `lft`
    the pressure is fixed twice
    structure.clamped names `left` twice
    a quasi-static structure is held nowhere
    a quasi-static structure has no velocity to damp
    the structure would have about 1e10 control points
    the body force of a structure is the same everywhere
    the mesh has no boundary group `ceiling`
    `bottom` is an interface, but the scene has no structure
    the fluid is enclosed: its pressure is known only up to a constant
    side `top` is wetted, but the scene has no fluid
    [coupling] needs a [fluid] beside the [structure]
    probe `centre` needs a fluid
    the scene has neither a fluid nor a structure
    "#);
}

#[test]
fn a_coupling_in_both_directions_needs_an_acceleration() {
    assert_snapshot!(broken("[coupling.acceleration.iqn_imvls]\ninitial_relaxation = 0.1", "[coupling]\nmax_iterations = 20"), @r#"
      × [coupling] has no acceleration
        ╭─[scene.toml:36:2]
     35 │ 
     36 │ [coupling]
        ·  ────┬───
        ·      ╰── how does the next displacement come from the last?
     37 │ max_iterations = 20
        ╰────
      help: add one, such as `acceleration = "iqn_imvls"`, or take `direction = "one_way"`, where
            nothing comes back to the fluid
    "#);
}

#[test]
fn backflow_of_a_fluid_without_convection_is_not_stabilized() {
    let stabilized = "top = { stress_free = { backflow_stabilization = true } }";
    let scene = SOUND.replacen("top = \"stress_free\"", stabilized, 1);
    assert_snapshot!(message(&scene, &["fluid.convection=false"]), @r#"
      × `top` stabilizes backflow of a fluid without convection
        ╭─[scene.toml:19:7]
     18 │ right = "no_slip"
     19 │ top = { stress_free = { backflow_stabilization = true } }
        ·       ─────────────────────────┬─────────────────────────
        ·                                ╰── stabilized here
     20 │ bottom = "interface"
        ╰────
      help: fluid that flows back then brings no momentum: leave out `backflow_stabilization`
            without the overrides the scene is sound: look at the `--set`s
    "#);
}

#[test]
fn work_at_an_interface_that_stands_still_cannot_be_probed() {
    let overrides = ["coupling.direction=one_way", "output.probes.work=interface_work"];
    assert_snapshot!(message(SOUND, &overrides), @r#"
      × probe `work` needs a coupling in both directions
       ╭─[--set:1:22]
     1 │ output.probes.work = "interface_work"
       ·                      ────────┬───────
       ·                              ╰── the interface stands still for the fluid
       ╰────
      help: leave the probe out, or take `direction = "two_way"`
            without the overrides the scene is sound: look at the `--set`s
    "#);
}
