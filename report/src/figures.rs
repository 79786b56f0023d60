//! Every figure of the pages can be read, whoever drew it.

use std::path::{Path, PathBuf};

use partita_charts::legible;

use crate::task::{self, TaskError};

/// Folders with figures; a page shows nothing from elsewhere.
const FOLDERS: [&str; 3] = ["docs", "scenes", "paper"];

/// What is wrong with each figure in the repository; a drawing without a text is another program's.
fn faults(root: &Path) -> Result<Vec<String>, TaskError> {
    let mut faults = Vec::new();
    for path in
        FOLDERS.iter().map(|folder| drawings(&root.join(folder))).collect::<Result<Vec<_>, _>>()?.concat()
    {
        let text = task::read(&path)?;
        if text.contains("<text") {
            let name = path.strip_prefix(root).unwrap_or(&path).display();
            faults.extend(legible::faults(&text).into_iter().map(|fault| format!("{name}: {fault}")));
        }
    }
    Ok(faults)
}

/// The SVG files below a folder.
fn drawings(folder: &Path) -> Result<Vec<PathBuf>, TaskError> {
    let refused = |source| TaskError::File { path: folder.to_owned(), source };
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(refused)? {
        let path = entry.map_err(refused)?.path();
        if path.is_dir() {
            found.extend(drawings(&path)?);
        } else if path.extension().is_some_and(|ending| ending == "svg") {
            found.push(path);
        }
    }
    found.sort();
    Ok(found)
}

#[test]
fn every_figure_can_be_read() {
    let root = task::workspace_root();
    let faults = faults(root).expect("the figures are there");
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    assert!(drawings(&root.join("docs")).expect("the folder is there").len() > 40);
}
