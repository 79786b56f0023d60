//! The words behind `cargo xtask accuracy`.

use super::study::STUDIES;
use crate::task::TaskError;

const USAGE: &str = "Usage: cargo xtask accuracy [--mode check|write|page] [STUDY]...";

/// What to do with what is found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Mode {
    /// Keep it, and write page and pictures.
    Write,
    /// Compare it with what is kept.
    Check,
    /// Run nothing, but write page and pictures again: a remark has changed.
    Page,
}

#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Options {
    pub(super) mode: Mode,
    /// The studies asked for, in the order of the page.
    pub(super) studies: Vec<&'static str>,
}

impl Options {
    /// Reads `[--mode check|write|page] [STUDY]...` in any order; no study means all of them.
    pub(super) fn parse(words: &[&str]) -> Result<Self, TaskError> {
        let wrong = || TaskError::Usage { given: format!("accuracy {}", words.join(" ")), usage: USAGE };
        let (mut mode, mut asked) = (None, Vec::new());
        let mut rest = words.iter().copied();
        while let Some(word) = rest.next() {
            match word {
                "--mode" if mode.is_none() => {
                    mode = match rest.next() {
                        Some("write") => Some(Mode::Write),
                        Some("check") => Some(Mode::Check),
                        Some("page") => Some(Mode::Page),
                        _ => return Err(wrong()),
                    };
                }
                name if STUDIES.contains(&name) => asked.push(name),
                _ => return Err(wrong()),
            }
        }
        let is_asked = |name: &&str| asked.is_empty() || asked.contains(name);
        let studies = STUDIES.into_iter().filter(is_asked).collect();
        Ok(Self { mode: mode.unwrap_or(Mode::Check), studies })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn studies_and_mode_stand_in_any_order() {
        let parse = |words: &[&str]| Options::parse(words).expect("sound");
        assert_eq!(parse(&[]), Options { mode: Mode::Check, studies: STUDIES.to_vec() });
        let some = parse(&["fsi1", "--mode", "write", "csm1"]);
        assert_eq!(some, Options { mode: Mode::Write, studies: vec!["csm1", "fsi1"] });
    }

    #[test]
    fn what_is_no_study_is_refused() {
        for words in
            [&["csm2"][..], &["--mode"], &["--mode", "print"], &["--mode", "write", "--mode", "write"]]
        {
            assert!(Options::parse(words).is_err(), "{words:?}");
        }
    }
}
