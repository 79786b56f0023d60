//! The reference of all keys, `docs/scene.md`.

use std::fs;
use std::path::Path;

use partita::scene::reference;

#[test]
fn scene_page_is_the_schemas() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/scene.md");
    let generated = reference::markdown();
    if std::env::var_os("UPDATE_DOCS").is_some() {
        fs::write(&file, &generated).expect("docs can be written");
    }
    let committed = fs::read_to_string(&file).unwrap_or_default();
    assert!(
        committed == generated,
        "docs/scene.md is not what the schema says; `UPDATE_DOCS=1 cargo test -p partita scene_page` rewrites it"
    );
}

/// `[`Type`]` and `[words](Type::name)` are links in rustdoc and nothing to a reader of the page.
#[test]
fn scene_page_has_no_links_of_rustdoc() {
    let page = reference::markdown();
    let mut links = 0;
    for (line, text) in page.lines().enumerate() {
        for (start, _) in text.match_indices('[').filter(|(start, _)| !text[..*start].ends_with('\\')) {
            let rest = &text[start..];
            let target = rest.split_once("](").map(|(_, target)| target);
            let is_code = text[..start].matches('`').count() % 2 == 1;
            if is_code {
                continue;
            }
            let target = target.unwrap_or_else(|| panic!("line {}: {rest} leads nowhere", line + 1));
            let anchor = target.strip_prefix('#').and_then(|target| target.split_once(')'));
            let (anchor, _) =
                anchor.unwrap_or_else(|| panic!("line {}: {rest} is no link of the page", line + 1));
            let heading = |line: &str| {
                let letters = line.strip_prefix("## `")?.chars();
                Some(letters.filter(|&c| c.is_alphanumeric() || c == '_').collect::<String>())
            };
            assert!(
                page.lines().filter_map(heading).any(|heading| heading == anchor),
                "no heading #{anchor}"
            );
            links += 1;
        }
    }
    assert!(links > 40, "{links} links are hardly all");
    assert!(!page.contains("::"), "a path of Rust");
    assert!(page.contains("| `halvings` | how often a step may be halved: 1 to 16 | `3` |"));
}

#[test]
fn scene_page_holds_every_kind_of_key() {
    let page = reference::markdown();
    for row in [
        "| `density` | a finite number above zero | must be given | Density \\[kg/m3\\]. |",
        "| `filter` | [a choice](#couplingaccelerationiqn_ilsfilter) | `{ qr3 = 0.01 }` |",
        "| `qr3` | a number above 0 and below 1 |",
        "| `history_steps` | a count of at least 0, or `\"unlimited\"` | `5` |",
    ] {
        assert!(page.contains(row), "{row}");
    }
}
