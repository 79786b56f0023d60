//! No file is longer than a reader's patience.

use super::Finding;
use super::tree::{File, Tree};

/// A file may not have more lines.
const LIMIT: usize = 600;
/// From here on a file is counted as long.
pub(crate) const LONG: usize = 300;

fn written_by_hand(tree: &Tree) -> impl Iterator<Item = &File> {
    tree.files().iter().filter(|file| file.is_any_of(&["rs", "md", "toml"]))
}

pub(crate) fn count_long(tree: &Tree) -> usize {
    written_by_hand(tree).filter(|file| file.lines().count() > LONG).count()
}

pub(crate) fn check(tree: &Tree) -> Vec<Finding> {
    written_by_hand(tree)
        .map(|file| (file, file.lines().count()))
        .filter(|(_, lines)| *lines > LIMIT)
        .map(|(file, lines)| {
            Finding::at(&file.path, LIMIT + 1, format!("{lines} lines, at most {LIMIT}: split the file"))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_may_have_six_hundred_lines_and_no_more() {
        let (full, over) = ("x\n".repeat(600), "x\n".repeat(601));
        let tree = Tree::of(&[("iga/src/a.rs", &full), ("iga/src/b.rs", &over), ("scenes/mesh.msh", &over)]);
        assert_eq!(
            check(&tree),
            [Finding::at("iga/src/b.rs", 601, "601 lines, at most 600: split the file")]
        );
        assert_eq!(count_long(&tree), 2);
    }
}
