//! Which command a file is meant for: scene, study and map are all TOML, and look alike at first sight.

use std::fs;
use std::path::Path;

use toml::{Table, Value};

use crate::SCENE_FILE;

/// What a file of ours can be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FileKind {
    /// Fluid, structure, or both: `partita run`, `check` and `plan`.
    Scene,
    /// A scene at many settings: `partita study`.
    Study,
    /// A scene over two parameters: `partita stability`.
    Map,
}

impl FileKind {
    /// The kind of a text by the tables that only this kind has. `None` where none of them is there, or the text is not TOML.
    pub fn of(text: &str) -> Option<Self> {
        let table: Table = text.parse().ok()?;
        let has = |keys: &[&str]| keys.iter().any(|key| table.contains_key(*key));
        if has(&["fluid", "structure", "coupling", "time"]) {
            return Some(Self::Scene);
        }
        let is_built_on_a_scene = table.get("scene").is_some_and(Value::is_str);
        if has(&["parameter", "newton_budget", "largest_energy_growth"]) {
            Some(Self::Map)
        } else if has(&["quantity", "reference", "refinements", "wanted"])
            || (is_built_on_a_scene && has(&["choice"]))
        {
            Some(Self::Study)
        } else {
            None
        }
    }

    /// What is wrong with giving the file or folder `path` to a command for files of this kind, and which command to take; where
    /// nothing tells that it is of another kind, `None`.
    #[must_use]
    pub fn misplaced(self, path: &Path) -> Option<(String, String)> {
        let is_folder = path.is_dir();
        let file = if is_folder { path.join(SCENE_FILE) } else { path.to_owned() };
        let found = Self::of(&fs::read_to_string(file).ok()?)?;
        (found != self).then(|| {
            let shown = path.display();
            let what = format!(
                "{shown} {} {}, not a {}",
                if is_folder { "holds" } else { "is" },
                found.name(),
                self.word()
            );
            (what, format!("`partita {} {shown}` is the command for it", found.command()))
        })
    }

    fn word(self) -> &'static str {
        match self {
            Self::Scene => "scene",
            Self::Study => "study",
            Self::Map => "stability map",
        }
    }

    fn name(self) -> String {
        format!("a {}", self.word())
    }

    fn command(self) -> &'static str {
        match self {
            Self::Scene => "run",
            Self::Study => "study",
            Self::Map => "stability",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_of_this_repository_are_told_apart() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
        let mut seen = 0;
        for (folder, kind) in [("studies", FileKind::Study), ("maps", FileKind::Map)] {
            for entry in fs::read_dir(root.join(folder)).expect("a folder") {
                let path = entry.expect("an entry").path();
                if path.extension().is_some_and(|ending| ending == "toml") {
                    let text = fs::read_to_string(&path).expect("text");
                    assert_eq!(FileKind::of(&text), Some(kind), "{}", path.display());
                    assert_eq!(kind.misplaced(&path), None);
                    seen += 1;
                }
            }
        }
        assert!(seen > 5, "{seen} files");
        let tank = root.join("scenes/elastic-bottom");
        assert_eq!(FileKind::Scene.misplaced(&tank), None);
        let (what, hint) = FileKind::Study.misplaced(&tank).expect("a scene is no study");
        assert!(
            what.ends_with("elastic-bottom holds a scene, not a study") && hint.starts_with("`partita run "),
            "{what}: {hint}"
        );
    }

    #[test]
    fn a_file_that_could_be_anything_is_left_to_its_command() {
        for text in ["", "title = \"?\"", "this is not TOML", "[choice]\nname = \"?\""] {
            assert_eq!(FileKind::of(text), None, "{text}");
        }
        assert_eq!(FileKind::of("scene = \"x\"\n[[choice]]\nname = \"a\""), Some(FileKind::Study));
    }
}
