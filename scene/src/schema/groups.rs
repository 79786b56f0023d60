//! One group of a mesh, or several taken together.

use std::borrow::Cow;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{self, Deserializer, SeqAccess, Visitor};
use serde::ser::Serializer;
use serde::{Deserialize, Serialize};

/// Names of groups of a mesh, at least one; a single one may stand without brackets.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Groups(Vec<String>);

impl Groups {
    /// The names, in the order of the scene.
    #[must_use]
    pub fn names(&self) -> &[String] {
        &self.0
    }
}

impl Serialize for Groups {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match &self.0[..] {
            [name] => serializer.serialize_str(name),
            names => names.serialize(serializer),
        }
    }
}

impl<'de> Deserialize<'de> for Groups {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(GroupsVisitor)
    }
}

struct GroupsVisitor;

impl<'de> Visitor<'de> for GroupsVisitor {
    type Value = Groups;

    fn expecting(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.write_str("the name of a group in quotes, or a list of them")
    }

    fn visit_str<E: de::Error>(self, name: &str) -> Result<Groups, E> {
        Ok(Groups(vec![name.to_owned()]))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Groups, A::Error> {
        let mut names = Vec::new();
        while let Some(name) = list.next_element::<String>()? {
            if names.contains(&name) {
                return Err(de::Error::custom(format!("`{name}` is named twice")));
            }
            names.push(name);
        }
        if names.is_empty() { Err(de::Error::invalid_length(0, &self)) } else { Ok(Groups(names)) }
    }
}

impl JsonSchema for Groups {
    fn schema_name() -> Cow<'static, str> {
        "Groups".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "type": ["string", "array"], "items": { "type": "string" } })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Groups, String> {
        #[derive(Deserialize)]
        struct Holder {
            groups: Groups,
        }
        toml::from_str::<Holder>(text).map(|holder| holder.groups).map_err(|error| error.message().to_owned())
    }

    #[test]
    fn one_name_or_a_list_without_repetition() {
        assert_eq!(read("groups = \"beam\"").expect("one").names(), ["beam"]);
        assert_eq!(read("groups = [\"beam\", \"wall\"]").expect("two").names(), ["beam", "wall"]);
        assert_eq!(read("groups = [\"beam\", \"beam\"]").expect_err("twice"), "`beam` is named twice");
        assert!(read("groups = []").expect_err("none").contains("invalid length 0"));
        assert!(read("groups = 3").expect_err("a number").contains("the name of a group"));
    }
}
