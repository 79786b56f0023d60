//! Files of gmsh as other tools write them, and the conditions on their groups.

mod boundary;
mod mutants;
mod orientation;
mod surfaces;

use super::Case;

/// What `check` prints for a scene that is sound.
fn sound(case: &Case, scene: &str, more: &[&str]) -> String {
    let outcome = case.partita(&[&["check", scene], more].concat());
    assert_eq!(outcome.code, 0, "{scene}: {}", outcome.stderr);
    assert!(outcome.stdout.ends_with("scene is sound\n"), "{}", outcome.stdout);
    outcome.stdout
}

/// The message about a scene that is refused, its lines and blanks joined.
fn refused(case: &Case, scene: &str, more: &[&str]) -> String {
    let [check, run] = ["check", "run"].map(|command| case.partita(&[&[command, scene], more].concat()));
    assert_eq!((check.code, run.code), (2, 2), "{scene}: {}{}", check.stdout, check.stderr);
    assert_eq!(check.stderr, run.stderr);
    check.stderr.split_whitespace().filter(|word| *word != "│").collect::<Vec<_>>().join(" ")
}

#[track_caller]
fn says(message: &str, parts: &[&str]) {
    for part in parts {
        assert!(message.contains(part), "`{part}` is not in: {message}");
    }
}

#[test]
fn files_of_other_tools_and_versions_are_read_as_gmshs_own() {
    let case = Case::new("versions");
    let page = |stem: &str| sound(&case, &format!("{stem}.toml"), &[]).replace(stem, "mesh");
    let plain = page("version_2p200000");
    says(
        &plain,
        &[
            "2 triangles",
            "south     1 edges  no_slip",
            "east      1 edges  do_nothing",
            "surfaces (and their elements): water (2)",
        ],
    );
    for stem in ["comments_first", "bom", "huge_tag22"] {
        assert_eq!(page(stem), plain, "{stem}");
    }
    // These two do not name their surface.
    for stem in ["name_trailing", "v20_names"] {
        assert_eq!(page(stem).replace("group-9", "water"), plain, "{stem}");
    }
}

#[test]
fn names_without_a_dimension_are_told_as_that_and_the_hint_works() {
    let case = Case::new("versions");
    let message = refused(&case, "v20_hint.toml", &[]);
    says(
        &message,
        &["v20_hint.msh, line 6 in $PhysicalNames", "`south` has no dimension", "`1 1 \"south\"`"],
    );
    case.replace("v20_hint.msh", "-1 1 \"south\"", "1 1 \"south\"");
    case.replace("v20_hint.msh", "-1 3 \"north\"", "1 3 \"north\"");
    // gmsh has lost the two other names.
    case.replace("v20_hint.toml", "east", "group-2");
    case.replace("v20_hint.toml", "west", "group-4");
    sound(&case, "v20_hint.toml", &[]);
}

#[test]
fn text_of_other_encodings_is_named_as_that() {
    let case = Case::new("versions");
    let utf_16: Vec<u8> = format!("\u{feff}{}", case.text("version_2p200000.msh"))
        .encode_utf16()
        .flat_map(u16::to_le_bytes)
        .collect();
    std::fs::write(case.path("version_2p200000.msh"), utf_16).expect("the file is written");
    says(&refused(&case, "version_2p200000.toml", &[]), &["UTF-16", "UTF-8"]);
    // A mark before the scene itself is no matter.
    let scene = format!("\u{feff}{}", case.text("bom.toml"));
    std::fs::write(case.path("bom.toml"), scene).expect("the file is written");
    sound(&case, "bom.toml", &[]);
}
