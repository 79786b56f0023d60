//! The text files of the repository, read once.

use std::collections::BTreeSet;
use std::path::Path;
use std::process::Command;

use crate::task::TaskError;

/// Folders that are never part of the source, for a tree that git does not know.
const GENERATED: [&str; 3] = [".git", "target", "runs"];

/// One file and its text.
pub(crate) struct File {
    /// Path from the root, with `/`.
    pub(crate) path: String,
    /// Empty for a file that is not text.
    pub(crate) text: String,
}

impl File {
    /// Whether the file's name ends in one of the extensions.
    pub(crate) fn is_any_of(&self, extensions: &[&str]) -> bool {
        Path::new(&self.path).extension().is_some_and(|e| extensions.iter().any(|extension| e == *extension))
    }

    /// The folders of the path and the name.
    pub(crate) fn parts(&self) -> impl Iterator<Item = &str> {
        self.path.split('/')
    }

    /// The top-level folder, or the name of a file at the top.
    pub(crate) fn room(&self) -> &str {
        self.parts().next().unwrap_or_default()
    }

    /// Lines with their numbers, counted from 1.
    pub(crate) fn lines(&self) -> impl Iterator<Item = (usize, &str)> {
        self.text.lines().enumerate().map(|(index, line)| (index + 1, line))
    }
}

/// All files of the repository, sorted by path.
pub(crate) struct Tree {
    files: Vec<File>,
}

impl Tree {
    /// Reads every file that git tracks or would track; without git, every file outside generated folders.
    pub(crate) fn read(root: &Path) -> Result<Self, TaskError> {
        let paths = match git_files(root) {
            Some(paths) => paths,
            None => walked_files(root)?,
        };
        let mut files = Vec::with_capacity(paths.len());
        for path in paths {
            let full = root.join(&path);
            if full.is_file() {
                let bytes = std::fs::read(&full).map_err(|source| TaskError::File { path: full, source })?;
                files.push(File { path, text: String::from_utf8(bytes).unwrap_or_default() });
            }
        }
        Ok(Self { files })
    }

    /// A tree that exists only in a test.
    #[cfg(test)]
    pub(crate) fn of(files: &[(&str, &str)]) -> Self {
        let file = |(path, text): &(&str, &str)| File { path: (*path).to_owned(), text: (*text).to_owned() };
        Self { files: files.iter().map(file).collect() }
    }

    pub(crate) fn files(&self) -> &[File] {
        &self.files
    }

    pub(crate) fn file(&self, path: &str) -> Option<&File> {
        self.files.iter().find(|file| file.path == path)
    }

    /// Names of the folders directly below `parent` ("" for the root) that hold a file; hidden ones are left out.
    pub(crate) fn folders(&self, parent: &str) -> BTreeSet<&str> {
        self.files
            .iter()
            .filter_map(|file| file.path.strip_prefix(parent))
            .filter_map(|rest| rest.trim_start_matches('/').split_once('/'))
            .map(|(folder, _)| folder)
            .filter(|folder| !folder.starts_with('.'))
            .collect()
    }
}

fn git_files(root: &Path) -> Option<BTreeSet<String>> {
    let output = Command::new("git")
        .current_dir(root)
        .args(["ls-files", "-z", "--cached", "--others", "--exclude-standard"])
        .output()
        .ok()
        .filter(|output| output.status.success())?;
    let names = String::from_utf8(output.stdout).ok()?;
    Some(names.split('\0').filter(|name| !name.is_empty()).map(str::to_owned).collect())
}

fn walked_files(root: &Path) -> Result<BTreeSet<String>, TaskError> {
    let mut found = BTreeSet::new();
    let mut open = vec![String::new()];
    while let Some(folder) = open.pop() {
        let full = root.join(&folder);
        let fail = |source| TaskError::File { path: full.clone(), source };
        for entry in std::fs::read_dir(&full).map_err(fail)? {
            let entry = entry.map_err(fail)?;
            let name = entry.file_name().to_string_lossy().into_owned();
            let path = if folder.is_empty() { name } else { format!("{folder}/{name}") };
            if entry.file_type().map_err(fail)?.is_file() {
                found.insert(path);
            } else if !GENERATED.contains(&path.as_str()) {
                open.push(path);
            }
        }
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn folders_are_those_that_hold_a_file() {
        let tree =
            Tree::of(&[("README.md", ""), ("iga/src/lib.rs", ""), (".ci/run", ""), ("iga/Cargo.toml", "")]);
        assert_eq!(tree.folders(""), BTreeSet::from(["iga"]));
        assert_eq!(tree.folders("iga"), BTreeSet::from(["src"]));
    }

    #[test]
    fn a_tree_without_git_is_walked() {
        let root = crate::task::workspace_root();
        let walked = walked_files(root).expect("readable workspace");
        assert!(walked.contains("xtask/src/tidy/tree.rs"));
        assert!(walked.iter().all(|path| !path.starts_with("target/")));
    }
}
