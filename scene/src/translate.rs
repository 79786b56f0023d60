//! From the deserializer's words to the user's.

use std::ops::Range;

use super::document::Document;
use super::finding::Finding;
use super::repair::Repair;
use super::sources::Sources;
use super::{reference, schema};
use crate::expression::Expression;
use crate::spelling::nearest;

/// What a deserialization error means in this scene, and what lets the rest be read.
pub(super) fn translate(
    error: &toml::de::Error,
    document: &Document<'_>,
    sources: &Sources,
) -> (Finding, Repair) {
    let place = error.span().unwrap_or(0..0);
    let mut context = Context { text: sources.text_at(&place), path: document.path_to(&place), place };
    let message = error.message();
    let names: Vec<&str> = message.split('`').skip(1).step_by(2).collect();
    if message.starts_with("unknown field") {
        return context.unknown_key(names[0], &names[1..]);
    }
    if let Some(keys) = message.strip_prefix("unexpected keys in table: ") {
        let (given, known) = keys.split_once(", available keys: ").unwrap_or((keys, ""));
        return context
            .unknown_key(given.split(", ").next().unwrap_or(given), &known.split(", ").collect::<Vec<_>>());
    }
    if message.starts_with("unknown variant") {
        return context.unknown_choice(names[0], &names[1..]);
    }
    if message.starts_with("missing field") {
        return context.missing(names[0]);
    }
    if message.starts_with("wanted exactly 1 element") {
        return context.not_one_choice(document);
    }
    document.follow_choice(&mut context.path, &mut context.place);
    context.text = sources.text_at(&context.place);
    let repair = Repair::Replace { path: context.path.clone() };
    if let Some(wanted) = message.strip_prefix("invalid ").and_then(|m| m.rsplit_once(", expected ")) {
        return (context.wrong_kind(wanted.1), repair);
    }
    if message == "wanted string or table" {
        return (context.wrong_kind("the name of a choice, or a table with that name"), repair);
    }
    (context.out_of_range(message), repair)
}

/// Where an error stands.
struct Context<'a> {
    place: Range<usize>,
    path: Vec<String>,
    text: &'a str,
}

impl Context<'_> {
    fn unknown_key(self, key: &str, known: &[&str]) -> (Finding, Repair) {
        let near = nearest(key, known.iter().copied());
        let repair = Repair::Rename { path: self.path.clone(), to: near.map(str::to_owned) };
        let table = reference::table(self.path.split_last().map_or(&[], |(_, parents)| parents));
        let homes = reference::homes_of(key);
        let hint = match near {
            Some(near) => format!("did you mean `{near}`?"),
            None if !homes.is_empty() => format!("`{key}` is a key of {}", homes.join(", ")),
            None => format!("keys of {table}: {}", known.join(", ")),
        };
        let finding = Finding::new(format!("`{key}` is not a key of {table}"));
        (finding.mark(self.place, "unknown key").hint(hint), repair)
    }

    fn unknown_choice(self, name: &str, known: &[&str]) -> (Finding, Repair) {
        let place =
            self.path.split_last().filter(|(last, _)| *last == name).map_or(&self.path[..], |(_, rest)| rest);
        let near = nearest(name, known.iter().copied());
        let hint = match near {
            Some(near) => format!("did you mean `{near}`?"),
            None => format!("choices: {}", known.join(", ")),
        };
        let repair = Repair::Choose { path: place.to_vec(), to: near.map(str::to_owned) };
        let finding = Finding::new(format!("{} cannot be `{name}`", place.join(".")))
            .mark(self.place, "unknown choice")
            .hint(hint);
        (finding, repair)
    }

    fn missing(self, key: &str) -> (Finding, Repair) {
        let path: Vec<String> = self.path.iter().cloned().chain([key.to_owned()]).collect();
        let choices = reference::choices(&path);
        let name = path.join(".");
        let set = if choices.is_empty() {
            format!("set `{name}`, it has no default")
        } else {
            format!("choose `{name}`, it has no default: {}", choices.join(", "))
        };
        let finding = Finding::new(format!("{} lacks `{key}`", reference::table(&self.path)))
            .mark(self.place, format!("`{key}` is missing here"))
            .hint(explained(set, &path));
        (finding, Repair::Replace { path })
    }

    fn not_one_choice(self, document: &Document<'_>) -> (Finding, Repair) {
        let length = (0..=self.path.len()).find(|&length| schema::is_choice(&self.path[..length]));
        let path = &self.path[..length.unwrap_or(self.path.len())];
        let name = path.join(".");
        let repair = Repair::Choose { path: path.to_vec(), to: None };
        let chosen = document.keys(path);
        let choices = reference::choices(path).join(", ");
        if chosen.is_empty() {
            let finding = Finding::new(format!("{name} names no choice"))
                .mark(self.place, "empty")
                .hint(format!("choose one of {choices}"));
            return (finding, repair);
        }
        let finding = Finding::new(format!("{name} names {} choices", chosen.len()))
            .hint(format!("keep one; known are {choices}"));
        let mark = |finding: Finding, (key, place)| finding.mark(place, format!("`{key}`"));
        (chosen.into_iter().fold(finding, mark), repair)
    }

    fn wrong_kind(self, wanted: &str) -> Finding {
        let wanted = plain_kind(wanted);
        let path = self.path.join(".");
        if self.text.starts_with("[[") {
            return Finding::new(format!("{path} is a list of tables"))
                .mark(self.place, "double brackets make a list")
                .hint(format!("write [{path}]"));
        }
        let quoted = self.text.starts_with(['"', '\'']) && wanted.contains("number");
        let hint =
            if quoted { "a number stands without quotes".to_owned() } else { format!("give {wanted}") };
        Finding::new(format!("{path} should be {wanted}"))
            .mark(self.place, format!("not {wanted}"))
            .hint(explained(hint, &self.path))
    }

    fn out_of_range(self, message: &str) -> Finding {
        let path = self.path.join(".");
        if let Some((place, hint)) = self.place_in_expression(message) {
            return Finding::new(format!("{path} holds an expression that cannot be read"))
                .mark(place, message)
                .hint(hint);
        }
        Finding::new(format!("{path}: {message}"))
            .mark(self.place, "out of range")
            .hint(reference::describe(&self.path).unwrap_or_default())
    }

    /// The part of a quoted expression that is to blame, where the quoted text is the expression itself.
    fn place_in_expression(&self, message: &str) -> Option<(Range<usize>, &'static str)> {
        let quoted = self.text.strip_prefix(['"', '\''])?;
        let inner = quoted.get(..quoted.len().checked_sub(1)?)?;
        let error = Expression::<2>::parse(inner).err().filter(|error| error.message == message)?;
        let start = self.place.start + 1;
        let hint =
            "an expression may use x, y [m], t [s], pi, + - * / ^ and functions such as sin, exp, sqrt, min";
        Some((start + error.place.start..start + error.place.end, hint))
    }
}

/// A hint, and below it what the key means.
fn explained(hint: String, path: &[String]) -> String {
    match reference::describe(path) {
        Some(text) => format!("{hint}\n{text}"),
        None => hint,
    }
}

/// serde's name of a kind in plain words.
fn plain_kind(kind: &str) -> String {
    match kind {
        "f64" => "a number".to_owned(),
        "i64" => "a whole number".to_owned(),
        "usize" => "a count of zero or more".to_owned(),
        "a string" => "text in quotes".to_owned(),
        "a boolean" => "true or false".to_owned(),
        "a sequence" => "a list".to_owned(),
        "a map" | "struct variant" => "a table".to_owned(),
        _ if kind.starts_with("struct ") => "a table".to_owned(),
        _ => match kind.strip_prefix("an array of length ") {
            Some(length) => format!("a list of {length} entries"),
            None => kind.to_owned(),
        },
    }
}
