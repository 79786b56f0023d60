//! `--set key.path=value` as a line of TOML.

use toml::de::{DeTable, DeValue};

use super::schema;

/// Names in a key; a scene needs five.
const LONGEST_KEY: usize = 12;

/// An override, read.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Override {
    /// One line of TOML: `coupling.predictor = "linear"`.
    pub(super) text: String,
    /// The names in its key, from the outermost in.
    pub(super) path: Vec<String>,
}

impl Override {
    /// Reads `key.path=value`. The value is TOML; a bare word is a string.
    ///
    /// # Errors
    ///
    /// A sentence about what is wrong with it.
    pub(super) fn read(given: &str) -> Result<Self, String> {
        let (key, path, value) = split(given)?;
        if DeValue::parse(value).is_ok() {
            return Ok(Self { text: format!("{key} = {value}"), path });
        }
        let bare = value.starts_with(|c: char| c.is_alphabetic() || matches!(c, '_' | '.' | '/'));
        if bare && !value.contains(|c: char| c.is_control() || matches!(c, '"' | '\\')) {
            return Ok(Self { text: format!("{key} = \"{value}\""), path });
        }
        if value.is_empty() {
            return Err("there is no value behind the `=`".to_owned());
        }
        Err(format!("`{value}` is neither a TOML value nor a bare word"))
    }

    /// Where the two make different choices in one place: its path, and the choice of each.
    pub(super) fn rivals<'a>(&'a self, other: &'a Self) -> Option<(&'a [String], &'a str, &'a str)> {
        let shared = self.path.iter().zip(&other.path).take_while(|(one, two)| one == two).count();
        let (place, rest) = self.path.split_at(shared);
        let (mine, yours) = (rest.first()?, other.path.get(shared)?);
        schema::is_choice(place).then_some((place, mine, yours))
    }
}

/// The key, the names in it, and the value: cut at the first `=` that leaves a key before it.
fn split(given: &str) -> Result<(&str, Vec<String>, &str), String> {
    let cut = given.match_indices('=').find_map(|(at, _)| {
        let key = given[..at].trim();
        names_in(key).map(|names| (key, names, given[at + 1..].trim()))
    });
    match cut {
        Some((_, names, _)) if names.len() > LONGEST_KEY => Err("the key has too many names".to_owned()),
        Some(cut) => Ok(cut),
        None if given.contains('=') => Err("what stands before the `=` is not a key".to_owned()),
        None => Err("there is no `=` in it".to_owned()),
    }
}

fn names_in(key: &str) -> Option<Vec<String>> {
    if key.contains(['\n', '#']) {
        return None;
    }
    let line = format!("{key} = 0");
    let parsed = DeTable::parse(&line).ok()?;
    let mut table = parsed.get_ref();
    let mut names = Vec::new();
    loop {
        let (name, value) = table.iter().next()?;
        names.push(name.get_ref().to_string());
        match value.get_ref() {
            DeValue::Table(inner) => table = inner,
            _ => return Some(names),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(given: &str) -> Result<(String, usize), String> {
        Override::read(given).map(|read| (read.text, read.path.len()))
    }

    #[test]
    fn values_are_toml_and_bare_words_are_strings() {
        for (given, text, names) in [
            ("time.steps=3", "time.steps = 3", 2),
            ("title = The tank", "title = \"The tank\"", 1),
            (
                "fluid.boundary.\"a=b\".velocity=[1, \"x=y\"]",
                "fluid.boundary.\"a=b\".velocity = [1, \"x=y\"]",
                4,
            ),
            ("a.b={ c = 1 }", "a.b = { c = 1 }", 2),
            ("a=\"quoted\"", "a = \"quoted\"", 1),
            ("a=meshes/tank.msh", "a = \"meshes/tank.msh\"", 1),
        ] {
            assert_eq!(read(given), Ok((text.to_owned(), names)), "{given}");
        }
    }

    #[test]
    fn what_is_no_assignment_says_so() {
        for (given, message) in [
            ("time.steps", "there is no `=` in it"),
            ("=3", "what stands before the `=` is not a key"),
            ("a b=3", "what stands before the `=` is not a key"),
            ("a=1\nb=2", "`1\nb=2` is neither a TOML value nor a bare word"),
            ("a\nb=1", "what stands before the `=` is not a key"),
            ("a=", "there is no value behind the `=`"),
            ("a=[1, 2", "`[1, 2` is neither a TOML value nor a bare word"),
            ("a.a.a.a.a.a.a.a.a.a.a.a.a=1", "the key has too many names"),
        ] {
            assert_eq!(read(given), Err(message.to_owned()), "{given}");
        }
    }
}
