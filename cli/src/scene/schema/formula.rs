//! A number, or an expression of `x`, `y`, `t`.

use std::fmt;

use serde::de::{self, Deserializer, Visitor};
use serde::ser::Serializer;
use serde::{Deserialize, Serialize};

/// One component: a number, or an expression such as `"4*y*(1-y)"`.
#[derive(Debug, Clone, PartialEq)]
pub enum Formula {
    /// The same everywhere and always.
    Number(f64),
    /// An expression of the position `x`, `y` [m] and the time `t` [s].
    Expression(String),
}

/// Two components.
pub type VectorFormula = [Formula; 2];

impl Default for Formula {
    fn default() -> Self {
        Self::Number(0.0)
    }
}

impl Serialize for Formula {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Number(value) => serializer.serialize_f64(*value),
            Self::Expression(text) => serializer.serialize_str(text),
        }
    }
}

impl<'de> Deserialize<'de> for Formula {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(FormulaVisitor)
    }
}

struct FormulaVisitor;

impl Visitor<'_> for FormulaVisitor {
    type Value = Formula;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a finite number or an expression of x, y and t in quotes")
    }

    #[allow(clippy::cast_precision_loss, reason = "a scene's whole numbers are small")]
    fn visit_i64<E: de::Error>(self, value: i64) -> Result<Formula, E> {
        Ok(Formula::Number(value as f64))
    }

    fn visit_f64<E: de::Error>(self, value: f64) -> Result<Formula, E> {
        if value.is_finite() {
            Ok(Formula::Number(value))
        } else {
            Err(E::invalid_value(de::Unexpected::Float(value), &self))
        }
    }

    fn visit_str<E: de::Error>(self, value: &str) -> Result<Formula, E> {
        Ok(Formula::Expression(value.to_owned()))
    }
}
