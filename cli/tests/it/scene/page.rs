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
