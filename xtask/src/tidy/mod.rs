//! `cargo xtask tidy`: the rules of the house that the compiler does not know.

mod arrows;
mod length;
mod rooms;
mod tree;
mod words;

use std::fmt;
use std::path::Path;

use crate::task::TaskError;
use tree::Tree;

/// A rule that is broken, and where.
#[derive(Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Finding {
    /// Path from the workspace's root.
    path: String,
    /// Line, counted from 1; 0 where the whole file or folder is meant.
    line: usize,
    message: String,
}

impl Finding {
    fn at(path: &str, line: usize, message: impl Into<String>) -> Self {
        Self { path: path.to_owned(), line, message: message.into() }
    }
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { path, line, message } = self;
        if *line == 0 { write!(f, "{path}: {message}") } else { write!(f, "{path}:{line}: {message}") }
    }
}

/// Prints every finding; any is a failure.
pub(crate) fn run(root: &Path) -> Result<(), TaskError> {
    let tree = Tree::read(root)?;
    let findings = check(&tree);
    for finding in &findings {
        println!("{finding}");
    }
    let long = length::count_long(&tree);
    println!("tidy: {} files, {long} over {} lines", tree.files().len(), length::LONG);
    if findings.is_empty() {
        Ok(())
    } else {
        Err(TaskError::Failed(format!("tidy: {} findings", findings.len())))
    }
}

fn check(tree: &Tree) -> Vec<Finding> {
    let mut findings = length::check(tree);
    findings.extend(arrows::check(tree));
    findings.extend(words::check(tree));
    findings.extend(rooms::check(tree));
    findings.sort();
    findings
}
