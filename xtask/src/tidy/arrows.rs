//! The arrows between the rooms run as `ARCHITECTURE.md` draws them under "Who may know whom".

use std::collections::{BTreeMap, BTreeSet};

use toml::de::DeTable;

use super::Finding;
use super::rooms::block;
use super::tree::{File, Tree};

const PAGE: &str = "ARCHITECTURE.md";

/// Rooms that may not meet anywhere: not in tests, benches or examples, and not by name in a comment.
const STRANGERS: [(&str, &str); 8] = [
    ("fluid", "structure"),
    ("fluid", "coupling"),
    ("structure", "fluid"),
    ("structure", "coupling"),
    ("coupling", "fluid"),
    ("coupling", "structure"),
    ("coupling", "mesh"),
    ("coupling", "iga"),
];

/// Dependencies from outside that belong to few rooms: heavy ones, and those that read settings, print or draw.
const RESERVED: [(&str, &[&str]); 5] = [
    ("faer", &["numerics"]),
    ("clap", &["cli", "report"]),
    ("indicatif", &["cli", "report"]),
    (
        "miette",
        &[
            "numerics",
            "iga",
            "mesh",
            "fluid",
            "structure",
            "coupling",
            "scene",
            "partita",
            "sweep",
            "testing",
            "cli",
            "fuzz",
        ],
    ),
    ("toml", &["scene", "partita", "sweep", "iga", "report", "xtask"]),
];

/// Dependencies that are a trait and no more unless features are turned on, which belongs to few rooms.
const DRAWING: [(&str, &[&str]); 1] = [("miette", &["cli", "fuzz"])];

pub(crate) fn check(tree: &Tree) -> Vec<Finding> {
    let mut findings = Vec::new();
    let manifests: Vec<(&str, Manifest)> = tree
        .files()
        .iter()
        .filter(|file| file.path == format!("{}/Cargo.toml", file.room()))
        .filter_map(|file| match Manifest::parse(file) {
            Ok(manifest) => Some((file.room(), manifest)),
            Err(finding) => {
                findings.push(finding);
                None
            }
        })
        .collect();
    let room_of: BTreeMap<&str, &str> =
        manifests.iter().map(|(room, manifest)| (manifest.package.as_str(), *room)).collect();
    let arrows = Arrows::read(tree, &room_of.values().copied().collect());
    for (room, manifest) in &manifests {
        if let Some(known) = arrows.rooms.get(room) {
            findings.extend(manifest.check(room, known, &room_of));
        } else {
            findings.push(Finding::at(PAGE, 0, format!("\"Who may know whom\" does not name {room}")));
        }
    }
    for file in tree.files().iter().filter(|file| file.is_any_of(&["rs"])) {
        findings.extend(check_source(file, &room_of));
    }
    findings
}

/// Which rooms each room may know, itself included.
struct Arrows<'a> {
    rooms: BTreeMap<&'a str, BTreeSet<&'a str>>,
}

impl<'a> Arrows<'a> {
    /// Reads lines `room -> a, b   (remark)`; "all of them" is every room.
    fn read(tree: &'a Tree, all: &BTreeSet<&'a str>) -> Self {
        let Some(page) = tree.file(PAGE) else { return Self { rooms: BTreeMap::new() } };
        let rooms = block(page, "## Who may know whom")
            .into_iter()
            .filter_map(|(_, line)| line.split_once("->"))
            .map(|(room, rest)| {
                let words = rest.split(['(', ';']).next().unwrap_or_default().split(',').map(str::trim);
                let mut known: BTreeSet<&str> = words.clone().filter(|word| all.contains(word)).collect();
                if words.clone().any(|word| word == "all of them") {
                    known.extend(all);
                }
                known.insert(room.trim());
                (room.trim(), known)
            })
            .collect();
        Self { rooms }
    }
}

/// A dependency and where it is written.
struct Dependency {
    package: String,
    line: usize,
    /// Only for tests, benches and examples.
    development: bool,
    /// Whether it turns on more than the workspace does.
    has_features: bool,
}

struct Manifest {
    path: String,
    package: String,
    dependencies: Vec<Dependency>,
}

impl Manifest {
    fn parse(file: &File) -> Result<Self, Finding> {
        let unreadable = |message: String| Finding::at(&file.path, 0, message);
        let table =
            DeTable::parse(&file.text).map_err(|error| unreadable(error.message().to_owned()))?.into_inner();
        let package = table
            .get("package")
            .and_then(|package| package.get_ref().get("name"))
            .and_then(|name| name.get_ref().as_str())
            .ok_or_else(|| unreadable("no package name".to_owned()))?
            .to_owned();
        let mut manifest = Self { path: file.path.clone(), package, dependencies: Vec::new() };
        manifest.collect(&table, &file.text);
        let targets = table.get("target").and_then(|targets| targets.get_ref().as_table());
        for (_, target) in targets.into_iter().flatten() {
            if let Some(target) = target.get_ref().as_table() {
                manifest.collect(target, &file.text);
            }
        }
        Ok(manifest)
    }

    fn collect(&mut self, table: &DeTable<'_>, text: &str) {
        for (kind, development) in
            [("dependencies", false), ("build-dependencies", false), ("dev-dependencies", true)]
        {
            let listed = table.get(kind).and_then(|listed| listed.get_ref().as_table());
            for (name, value) in listed.into_iter().flatten() {
                let renamed = value.get_ref().get("package").and_then(|package| package.get_ref().as_str());
                let line = text[..name.span().start].lines().count() + 1;
                let package = renamed.unwrap_or(name.get_ref()).to_owned();
                let has_features = value.get_ref().get("features").is_some();
                self.dependencies.push(Dependency { package, line, development, has_features });
            }
        }
    }

    fn check(&self, room: &str, known: &BTreeSet<&str>, room_of: &BTreeMap<&str, &str>) -> Vec<Finding> {
        let mut findings = Vec::new();
        for Dependency { package, line, development, has_features } in &self.dependencies {
            let mut tell = |message: String| findings.push(Finding::at(&self.path, *line, message));
            if let Some(other) = room_of.get(package.as_str()) {
                if *development && STRANGERS.contains(&(room, other)) {
                    tell(format!("{room} may not know {other}, in tests neither"));
                } else if !development && !known.contains(other) {
                    tell(format!(
                        "{room} may not know {other}: \"Who may know whom\" in {PAGE} has no such arrow"
                    ));
                }
            }
            let reserved = RESERVED.iter().find(|(name, _)| name == package);
            if let Some((name, rooms)) = reserved.filter(|(_, rooms)| !development && !rooms.contains(&room))
            {
                tell(format!("{name} belongs to {}", rooms.join(", ")));
            }
            let drawing = DRAWING.iter().find(|(name, rooms)| name == package && !rooms.contains(&room));
            if let Some((name, rooms)) = drawing.filter(|_| *has_features && !development) {
                tell(format!("features of {name} belong to {}", rooms.join(", ")));
            }
        }
        findings
    }
}

/// Finds the library names of strangers, in comments and links too. Any other room that the manifest does not list the
/// compiler refuses.
fn check_source(file: &File, room_of: &BTreeMap<&str, &str>) -> Vec<Finding> {
    let room = file.room();
    let mut findings = Vec::new();
    for (package, _) in room_of.iter().filter(|(_, other)| STRANGERS.contains(&(room, *other))) {
        let library = package.replace('-', "_");
        for (line, text) in file.lines().filter(|(_, text)| has_word(text, &library)) {
            findings.push(Finding::at(
                &file.path,
                line,
                format!("{room} may not name {library}: {}", text.trim()),
            ));
        }
    }
    findings
}

/// Whether `word` stands in the text and not inside a longer identifier.
fn has_word(text: &str, word: &str) -> bool {
    let part = |c: char| c.is_alphanumeric() || c == '_';
    text.match_indices(word)
        .any(|(start, _)| !text[..start].ends_with(part) && !text[start + word.len()..].starts_with(part))
}

#[cfg(test)]
mod tests {
    use super::*;

    const ARROWS: &str = "## Who may know whom\n\n```text\nnumerics -> faer\nfluid -> numerics   (no structure)\n\
                          structure -> numerics\ncli -> all of them\n```\n";

    fn manifest(package: &str, dependencies: &str) -> String {
        format!("[package]\nname = \"{package}\"\n\n{dependencies}")
    }

    fn messages(fluid: &str, source: (&str, &str)) -> Vec<String> {
        let fluid = manifest("partita-fluid", fluid);
        let (numerics, structure) = (manifest("partita-numerics", ""), manifest("partita-structure", ""));
        let cli = manifest(
            "partita",
            "[dependencies]\npartita-fluid = \"1\"\npartita-structure = \"1\"\nclap = \"4\"\n",
        );
        let tree = Tree::of(&[
            (PAGE, ARROWS),
            ("cli/Cargo.toml", &cli),
            ("fluid/Cargo.toml", &fluid),
            ("numerics/Cargo.toml", &numerics),
            ("structure/Cargo.toml", &structure),
            source,
        ]);
        check(&tree).iter().map(ToString::to_string).collect()
    }

    const NO_SOURCE: (&str, &str) = ("README.md", "");

    #[test]
    fn drawn_arrows_pass() {
        assert_eq!(messages("[dependencies]\npartita-numerics.workspace = true\n", NO_SOURCE), [""; 0]);
    }

    #[test]
    fn an_arrow_that_is_not_drawn_is_found_on_its_line() {
        let expected = "fluid/Cargo.toml:5: fluid may not know structure: \"Who may know whom\" in ARCHITECTURE.md has no such arrow";
        for written in [
            "[dependencies]\npartita-structure.workspace = true\n",
            "[dependencies]\nsolid = { package = \"partita-structure\", version = \"1\" }\n",
            "[target.'cfg(unix)'.dependencies]\npartita-structure = \"1\"\n",
        ] {
            assert_eq!(messages(written, NO_SOURCE), [expected], "{written}");
        }
    }

    #[test]
    fn strangers_do_not_meet_in_tests() {
        let dev = messages("[dev-dependencies]\npartita-structure = \"1\"\npartita = \"1\"\n", NO_SOURCE);
        assert_eq!(dev, ["fluid/Cargo.toml:5: fluid may not know structure, in tests neither"]);
        let test = messages("", ("fluid/tests/it/main.rs", "// as in\nuse partita_structure::x;\n"));
        assert_eq!(
            test,
            ["fluid/tests/it/main.rs:2: fluid may not name partita_structure: use partita_structure::x;"]
        );
    }

    #[test]
    fn a_stranger_is_found_in_comments_and_longer_names_are_not() {
        let found = messages(
            "",
            ("fluid/src/lib.rs", "//! See [`partita_structure`].\nlet partita_structured = 1;\n"),
        );
        assert_eq!(found.len(), 1);
        assert!(found[0].starts_with("fluid/src/lib.rs:1:"), "{found:?}");
    }

    #[test]
    fn reserved_dependencies_stay_in_their_rooms() {
        let found =
            messages("[dependencies]\nfaer = \"0.24\"\n\n[dev-dependencies]\nclap = \"4\"\n", NO_SOURCE);
        assert_eq!(found, ["fluid/Cargo.toml:5: faer belongs to numerics"]);
    }

    #[test]
    fn libraries_take_the_trait_of_errors_and_not_what_draws_them() {
        assert_eq!(messages("[dependencies]\nmiette.workspace = true\n", NO_SOURCE), [""; 0]);
        let drawing = "[dependencies]\nmiette = { workspace = true, features = [\"fancy\"] }\n";
        let found = messages(drawing, NO_SOURCE);
        assert_eq!(found, ["fluid/Cargo.toml:5: features of miette belong to cli, fuzz"]);
    }

    #[test]
    fn a_room_without_arrows_is_found() {
        let tree = Tree::of(&[(PAGE, ARROWS), ("iga/Cargo.toml", "[package]\nname = \"partita-iga\"\n")]);
        assert_eq!(check(&tree), [Finding::at(PAGE, 0, "\"Who may know whom\" does not name iga")]);
    }
}
