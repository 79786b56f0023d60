//! The list of rooms in `ARCHITECTURE.md` is the list of folders; each scene is complete.

use std::collections::BTreeMap;

use super::Finding;
use super::tree::{File, Tree};

const PAGE: &str = "ARCHITECTURE.md";

pub(crate) fn check(tree: &Tree) -> Vec<Finding> {
    let mut findings = check_rooms(tree);
    findings.extend(check_scenes(tree));
    findings
}

/// Lines of the first block fenced as `text` below the heading, with their numbers.
pub(crate) fn block<'a>(page: &'a File, heading: &str) -> Vec<(usize, &'a str)> {
    page.lines()
        .skip_while(|(_, line)| *line != heading)
        .skip_while(|(_, line)| *line != "```text")
        .skip(1)
        .take_while(|(_, line)| *line != "```")
        .collect()
}

fn check_rooms(tree: &Tree) -> Vec<Finding> {
    let Some(page) = tree.file(PAGE) else {
        return vec![Finding::at(PAGE, 0, "missing: it holds the list of rooms")];
    };
    let listed: BTreeMap<&str, usize> = block(page, "## Rooms")
        .into_iter()
        .filter(|(_, text)| !text.starts_with(' '))
        .filter_map(|(line, text)| Some((text.split_once('/')?.0, line)))
        .collect();
    if listed.is_empty() {
        return vec![Finding::at(
            PAGE,
            0,
            "no block fenced as `text` with lines `name/` below the heading \"## Rooms\"",
        )];
    }
    let folders = tree.folders("");
    let absent = listed.iter().filter(|(name, _)| !folders.contains(*name)).map(|(name, line)| {
        Finding::at(PAGE, *line, format!("lists the room {name}/, which is not on disk"))
    });
    let unlisted = folders
        .iter()
        .filter(|name| !listed.contains_key(*name))
        .map(|name| Finding::at(name, 0, format!("this folder is not in the list of rooms of {PAGE}")));
    absent.chain(unlisted).collect()
}

fn check_scenes(tree: &Tree) -> Vec<Finding> {
    let mut findings = Vec::new();
    for scene in tree.folders("scenes") {
        for name in ["scene.toml", "README.md"] {
            if tree.file(&format!("scenes/{scene}/{name}")).is_none() {
                findings.push(Finding::at(
                    &format!("scenes/{scene}"),
                    0,
                    format!("this scene has no {name}"),
                ));
            }
        }
    }
    findings
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROOMS: &str =
        "# A\n\n## Rooms\n\n```text\niga/     splines\n         and more/less\nscenes/  cases\n```\n";

    #[test]
    fn rooms_and_folders_are_the_same() {
        let complete = [
            (PAGE, ROOMS),
            ("iga/Cargo.toml", ""),
            ("scenes/tank/scene.toml", ""),
            ("scenes/tank/README.md", ""),
        ];
        assert_eq!(check(&Tree::of(&complete)), []);

        let renamed = [(PAGE, ROOMS), ("nurbs/Cargo.toml", ""), ("scenes/README.md", "")];
        let messages: Vec<String> = check(&Tree::of(&renamed)).iter().map(ToString::to_string).collect();
        assert_eq!(
            messages,
            [
                "ARCHITECTURE.md:6: lists the room iga/, which is not on disk",
                "nurbs: this folder is not in the list of rooms of ARCHITECTURE.md",
            ]
        );
    }

    #[test]
    fn a_scene_without_prose_is_found() {
        let tree = Tree::of(&[(PAGE, ROOMS), ("iga/Cargo.toml", ""), ("scenes/tank/scene.toml", "")]);
        assert_eq!(check(&tree), [Finding::at("scenes/tank", 0, "this scene has no README.md")]);
    }

    #[test]
    fn a_page_without_the_list_is_found() {
        assert_eq!(check(&Tree::of(&[(PAGE, "# A\n")])).len(), 1);
        assert_eq!(check(&Tree::of(&[])).len(), 1);
    }
}
