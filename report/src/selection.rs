//! The words behind a task that runs named things and keeps what they come to: `[--mode check|write|page] [NAME]...`.

use crate::task::TaskError;

/// What to do with what is found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Mode {
    /// Keep it, and write page and pictures.
    Write,
    /// Compare it with what is kept.
    Check,
    /// Run nothing, but write the page again: a remark has changed.
    Page,
}

/// What is asked for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Selection {
    pub(crate) mode: Mode,
    /// The names asked for, in the order of the page.
    pub(crate) names: Vec<&'static str>,
}

impl Selection {
    /// Reads the words behind `task` in any order; no name means all that are known.
    pub(crate) fn parse(
        task: &str,
        usage: &'static str,
        known: &[&'static str],
        words: &[&str],
    ) -> Result<Self, TaskError> {
        let wrong = || TaskError::Usage { given: format!("{task} {}", words.join(" ")), usage };
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
                name if known.contains(&name) => asked.push(name),
                _ => return Err(wrong()),
            }
        }
        let is_asked = |name: &&str| asked.is_empty() || asked.contains(name);
        let names = known.iter().copied().filter(is_asked).collect();
        Ok(Self { mode: mode.unwrap_or(Mode::Check), names })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(words: &[&str]) -> Result<Selection, TaskError> {
        Selection::parse("accuracy", "Usage", &["csm1", "fsi1"], words)
    }

    #[test]
    fn names_and_mode_stand_in_any_order() {
        let all = Selection { mode: Mode::Check, names: vec!["csm1", "fsi1"] };
        assert_eq!(parse(&[]).expect("sound"), all);
        let some = Selection { mode: Mode::Write, names: vec!["fsi1"] };
        assert_eq!(parse(&["fsi1", "--mode", "write"]).expect("sound"), some);
        assert_eq!(parse(&["--mode", "write", "fsi1"]).expect("sound"), some);
        let turned = parse(&["fsi1", "--mode", "page", "csm1"]).expect("sound");
        assert_eq!(turned, Selection { mode: Mode::Page, ..all });
    }

    #[test]
    fn what_is_not_known_is_refused() {
        for words in
            [&["csm2"][..], &["--mode"], &["--mode", "print"], &["--mode", "write", "--mode", "write"]]
        {
            assert!(matches!(parse(words), Err(TaskError::Usage { .. })), "{words:?}");
        }
    }
}
