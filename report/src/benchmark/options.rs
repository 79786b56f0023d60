//! `cargo xtask benchmark [CASE...] [--level L] [--mode check|write|page] [--animate]`.

use super::case::Case;

/// What is asked for.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(super) struct Options {
    /// Names of cases; none for all.
    pub(super) cases: Vec<String>,
    /// Only this level, from 1.
    pub(super) level: Option<usize>,
    pub(super) mode: Mode,
    /// Go on for a period more, with fields to look at.
    pub(super) animate: bool,
}

/// What becomes of the results.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum Mode {
    /// They must be those of `docs/data/benchmarks.csv`.
    #[default]
    Check,
    /// They take their place there, and page and pictures are drawn anew.
    Write,
    /// Nothing is run; page and pictures are drawn anew from that file.
    Page,
}

impl Options {
    /// Reads the words behind `benchmark`, or says what is wrong with them.
    pub(super) fn read(words: &[&str]) -> Result<Self, String> {
        let mut options = Self::default();
        let mut words = words.iter().copied();
        while let Some(word) = words.next() {
            match word {
                "--level" => {
                    let level = words.next().unwrap_or_default();
                    options.level = Some(
                        level
                            .parse()
                            .ok()
                            .filter(|&level| level > 0)
                            .ok_or_else(|| format!("--level takes a number from 1, not `{level}`"))?,
                    );
                }
                "--mode" => {
                    options.mode = match words.next().unwrap_or_default() {
                        "check" => Mode::Check,
                        "write" => Mode::Write,
                        "page" => Mode::Page,
                        other => return Err(format!("--mode is `check`, `write` or `page`, not `{other}`")),
                    };
                }
                "--animate" => options.animate = true,
                option if option.starts_with('-') => return Err(format!("no such option: {option}")),
                case => options.cases.push(case.to_owned()),
            }
        }
        Ok(options)
    }

    /// The cases asked for and the levels of each.
    pub(super) fn choose<'a>(&self, all: &'a [Case]) -> Result<Vec<(&'a Case, Vec<usize>)>, String> {
        if let Some(unknown) = self.cases.iter().find(|name| !all.iter().any(|case| case.name == **name)) {
            let names: Vec<&str> = all.iter().map(|case| case.name.as_str()).collect();
            return Err(format!("no case `{unknown}`; there are {}", names.join(", ")));
        }
        let asked = all.iter().filter(|case| self.cases.is_empty() || self.cases.contains(&case.name));
        let levels = |case: &Case| -> Vec<usize> {
            (1..=case.levels.len()).filter(|level| self.level.is_none_or(|only| only == *level)).collect()
        };
        let chosen: Vec<_> = asked.map(|case| (case, levels(case))).collect();
        match chosen.iter().find(|(_, levels)| levels.is_empty()) {
            Some((case, _)) => Err(format!("{} has {} levels", case.name, case.levels.len())),
            None => Ok(chosen),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::benchmark::case;
    use crate::task::workspace_root;

    #[test]
    fn words_are_cases_and_options() {
        let read = |words: &[&str]| Options::read(words);
        assert_eq!(read(&[]), Ok(Options::default()));
        assert_eq!(
            read(&["csm1", "--level", "2", "fsi1", "--mode", "write"]),
            Ok(Options {
                cases: vec!["csm1".into(), "fsi1".into()],
                level: Some(2),
                mode: Mode::Write,
                animate: false
            })
        );
        assert!(read(&["fsi2", "--animate"]).expect("sound words").animate);
        for wrong in [&["--level", "0"][..], &["--level"], &["--mode", "see"], &["--all"]] {
            assert!(read(wrong).is_err(), "{wrong:?}");
        }
    }

    #[test]
    fn cases_and_levels_that_do_not_exist_are_named() {
        let all = case::all(workspace_root()).expect("the shipped cases");
        let choose = |words: &[&str]| Options::read(words).expect("sound words").choose(&all);
        assert_eq!(choose(&[]).expect("all").len(), all.len());
        let one = choose(&["csm1", "--level", "2"]).expect("one");
        assert_eq!((one.len(), one[0].1.as_slice()), (1, &[2][..]));
        assert!(choose(&["csm9"]).expect_err("no such case").contains("csm1"));
        assert!(choose(&["csm1", "--level", "77"]).expect_err("no such level").contains("csm1 has"));
    }
}
