//! Words that must not stand: printing in libraries, unfinished code, paths of one machine, hosts of registries.
//!
//! The words are put together from pieces, so that this file does not find itself.

use super::Finding;
use super::tree::{File, Tree};

/// Rooms whose source may print.
const PRINTING_ROOMS: [&str; 3] = ["cli", "report", "xtask"];
/// Folders of a room whose code may print.
const PRINTING_FOLDERS: [&str; 3] = ["examples", "benches", "tests"];

const PRINTS: [&str; 5] = [
    concat!("print", "!"),
    concat!("println", "!"),
    concat!("eprint", "!"),
    concat!("eprintln", "!"),
    concat!("dbg", "!"),
];
const UNFINISHED: [&str; 3] = [concat!("todo", "!"), concat!("unimplemented", "!"), concat!("#[ig", "nore")];
const MACHINE_PATHS: [&str; 3] = [concat!("/wo", "rk/"), concat!("/tm", "p/"), concat!("/ho", "me/")];
const REGISTRY_HOSTS: [&str; 5] = [
    concat!("crates", ".io"),
    concat!("py", "pi.org"),
    concat!("npm", "js.org"),
    concat!("ana", "conda.org"),
    concat!("artif", "actory"),
];
/// The only source of packages in the lock file.
const PUBLIC_INDEX: &str = concat!("registry+https://github.com/rust-lang/crates", ".io-index");

pub(crate) fn check(tree: &Tree) -> Vec<Finding> {
    let mut findings = Vec::new();
    for file in tree.files() {
        if file.is_any_of(&["rs"]) {
            findings.extend(check_code(file));
        }
        if file.room() == "Cargo.lock" {
            findings.extend(check_lock(file));
        } else if file.room() != ".ci" {
            findings.extend(check_hosts(file));
            findings.extend(check_paths(file));
        }
    }
    findings
}

fn check_code(file: &File) -> Vec<Finding> {
    let may_print = PRINTING_ROOMS.contains(&file.room())
        || file.parts().nth(1).is_some_and(|folder| PRINTING_FOLDERS.contains(&folder));
    let mut findings = Vec::new();
    for (line, text) in file.lines().filter(|(_, text)| !text.trim_start().starts_with("//")) {
        if let Some(word) = UNFINISHED.iter().find(|word| has_macro(text, word)) {
            findings.push(Finding::at(&file.path, line, format!("`{word}` is unfinished code")));
        }
        if let Some(word) = PRINTS.iter().find(|word| !may_print && has_macro(text, word)) {
            findings.push(Finding::at(&file.path, line, format!("`{word}`: only cli and xtask print")));
        }
    }
    findings
}

/// Whether a macro or an attribute stands in the text, and not a longer name that ends like it.
fn has_macro(text: &str, word: &str) -> bool {
    text.match_indices(word)
        .any(|(start, _)| !text[..start].ends_with(|c: char| c.is_alphanumeric() || c == '_'))
}

fn check_lock(file: &File) -> Vec<Finding> {
    file.lines()
        .filter_map(|(line, text)| Some((line, text.strip_prefix("source = ")?.trim_matches('"'))))
        .filter(|(_, source)| *source != PUBLIC_INDEX)
        .map(|(line, source)| {
            Finding::at(&file.path, line, format!("a package from {source}, not the public index"))
        })
        .collect()
}

fn check_hosts(file: &File) -> Vec<Finding> {
    let mut findings = Vec::new();
    for (line, text) in file.lines() {
        if let Some(host) = REGISTRY_HOSTS.iter().find(|host| text.contains(*host)) {
            findings.push(Finding::at(&file.path, line, format!("names a package registry, {host}")));
        }
    }
    findings
}

fn check_paths(file: &File) -> Vec<Finding> {
    let mut findings = Vec::new();
    for (line, text) in file.lines() {
        if let Some(path) = MACHINE_PATHS.iter().find(|path| has_absolute_path(text, path)) {
            findings.push(Finding::at(&file.path, line, format!("names a path of one machine, {path}")));
        }
    }
    findings
}

/// Whether a path begins with `start`, which inside a longer path or an address it does not.
fn has_absolute_path(text: &str, start: &str) -> bool {
    let inside = |c: char| c.is_alphanumeric() || "_-.~}".contains(c);
    text.match_indices(start).any(|(at, _)| !text[..at].ends_with(inside))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(path: &str, text: &str) -> Vec<usize> {
        check(&Tree::of(&[(path, text)])).iter().map(|finding| finding.line).collect()
    }

    #[test]
    fn libraries_do_not_print() {
        let text =
            format!("/// {0}(\"\")\nfn f() {{\n    {0}(\"x\");\n    {1}(x);\n}}\n", PRINTS[1], PRINTS[4]);
        assert_eq!(lines("fluid/src/step.rs", &text), [3, 4]);
        for printing in [
            "fluid/examples/cavity.rs",
            "fluid/benches/newton.rs",
            "fluid/tests/it/main.rs",
            "cli/src/main.rs",
        ] {
            assert_eq!(lines(printing, &text), [0; 0], "{printing}");
        }
        assert_eq!(lines("fluid/src/step.rs", &format!("my_{}(1)\n", PRINTS[0])), [0; 0]);
    }

    #[test]
    fn unfinished_code_is_found_in_tests_too() {
        for word in UNFINISHED {
            assert_eq!(
                lines("iga/tests/it/main.rs", &format!("fn f() {{\n    {word}(reason)]\n")),
                [2],
                "{word}"
            );
        }
    }

    #[test]
    fn paths_of_a_machine_are_found_and_relative_ones_are_not() {
        for path in MACHINE_PATHS {
            assert_eq!(lines("docs/theory.md", &format!("see\n`{path}x`\n")), [2], "{path}");
            assert_eq!(
                lines("docs/theory.md", &format!("target{path}x https://example.net{path}\n")),
                [0; 0],
                "{path}"
            );
            assert_eq!(lines(".ci/run", &format!("cd {path}x\n")), [0; 0], "{path}");
        }
    }

    #[test]
    fn hosts_of_registries_are_found() {
        for host in REGISTRY_HOSTS {
            assert_eq!(lines("README.md", &format!("\n\nhttps://{host}/x\n")), [3], "{host}");
        }
    }

    #[test]
    fn the_lock_file_knows_the_public_index_only() {
        assert_eq!(lines("Cargo.lock", &format!("name = \"a\"\nsource = \"{PUBLIC_INDEX}\"\n")), [0; 0]);
        assert_eq!(
            lines("Cargo.lock", "name = \"a\"\nsource = \"registry+https://example.net/index\"\n"),
            [2]
        );
    }
}
