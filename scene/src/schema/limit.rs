//! A count, or the word `"unlimited"`.

use std::borrow::Cow;
use std::fmt;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{self, Deserializer, Visitor};
use serde::ser::Serializer;
use serde::{Deserialize, Serialize};

/// At most so many, at least `MIN`; or `"unlimited"`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Limit<const MIN: usize> {
    /// A whole number in the scene.
    AtMost(usize),
    /// The word `"unlimited"` in the scene.
    Unlimited,
}

impl<const MIN: usize> Limit<MIN> {
    /// The number, or `None` for no limit.
    #[must_use]
    pub const fn get(self) -> Option<usize> {
        match self {
            Self::AtMost(count) => Some(count),
            Self::Unlimited => None,
        }
    }
}

impl<const MIN: usize> fmt::Display for Limit<MIN> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::AtMost(count) => count.fmt(f),
            Self::Unlimited => f.write_str("unlimited"),
        }
    }
}

impl<const MIN: usize> Serialize for Limit<MIN> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::AtMost(count) => count.serialize(serializer),
            Self::Unlimited => serializer.serialize_str("unlimited"),
        }
    }
}

impl<'de, const MIN: usize> Deserialize<'de> for Limit<MIN> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(LimitVisitor)
    }
}

struct LimitVisitor<const MIN: usize>;

impl<const MIN: usize> Visitor<'_> for LimitVisitor<MIN> {
    type Value = Limit<MIN>;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "a count of at least {MIN}, or \"unlimited\"")
    }

    fn visit_i64<E: de::Error>(self, value: i64) -> Result<Self::Value, E> {
        usize::try_from(value)
            .ok()
            .filter(|&count| count >= MIN)
            .map(Limit::AtMost)
            .ok_or_else(|| E::invalid_value(de::Unexpected::Signed(value), &self))
    }

    fn visit_str<E: de::Error>(self, value: &str) -> Result<Self::Value, E> {
        if value == "unlimited" {
            Ok(Limit::Unlimited)
        } else {
            Err(E::invalid_value(de::Unexpected::Str(value), &self))
        }
    }
}

impl<const MIN: usize> JsonSchema for Limit<MIN> {
    fn schema_name() -> Cow<'static, str> {
        format!("LimitFrom{MIN}").into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "anyOf": [{ "type": "integer", "minimum": MIN }, { "const": "unlimited" }] })
    }
}
