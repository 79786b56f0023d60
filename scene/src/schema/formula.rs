//! A number, or an expression of `x`, `y`, `t`.

use std::borrow::Cow;
use std::fmt;
use std::sync::Arc;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{self, Deserializer, Visitor};
use serde::ser::Serializer;
use serde::{Deserialize, Serialize};

use crate::expression::Expression;

/// One component: a number, or an expression such as `"4*y*(1 - y)"`.
#[derive(Debug, Clone, PartialEq)]
pub enum Formula {
    /// The same everywhere and always.
    Number(f64),
    /// An expression of the position `x`, `y` \[m\] and the time `t` \[s\].
    Expression(Expression<2>),
}

impl Formula {
    /// The value at a position \[m\] and a time \[s\].
    #[must_use]
    pub fn value(&self, position: &[f64; 2], time: f64) -> f64 {
        match self {
            Self::Number(number) => *number,
            Self::Expression(expression) => expression.value(position, time),
        }
    }
}

impl Default for Formula {
    fn default() -> Self {
        Self::Number(0.0)
    }
}

/// Two components.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(transparent)]
pub struct VectorFormula(pub [Formula; 2]);

/// A vector at every position and time.
pub type VectorFunction = Arc<dyn Fn(&[f64; 2], f64) -> [f64; 2] + Send + Sync>;

impl VectorFormula {
    /// The value at a position \[m\] and a time \[s\].
    #[must_use]
    pub fn value(&self, position: &[f64; 2], time: f64) -> [f64; 2] {
        [self.0[0].value(position, time), self.0[1].value(position, time)]
    }

    /// The value as a function that a solver can keep.
    #[must_use]
    pub fn function(&self) -> VectorFunction {
        let formula = self.clone();
        Arc::new(move |position, time| formula.value(position, time))
    }

    /// Whether a component depends on the position.
    #[must_use]
    pub fn uses_position(&self) -> bool {
        let uses = |formula: &Formula| match formula {
            Formula::Number(_) => false,
            Formula::Expression(expression) => expression.uses_position(),
        };
        self.0.iter().any(uses)
    }

    /// The value, if both components are numbers.
    #[must_use]
    pub fn constant(&self) -> Option<[f64; 2]> {
        match self.0 {
            [Formula::Number(first), Formula::Number(second)] => Some([first, second]),
            _ => None,
        }
    }
}

impl Serialize for Formula {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Number(number) => serializer.serialize_f64(*number),
            Self::Expression(expression) => serializer.serialize_str(expression.text()),
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
        f.write_str("a finite number or an expression in quotes")
    }

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
        Expression::parse(value).map(Formula::Expression).map_err(E::custom)
    }
}

impl JsonSchema for Formula {
    fn schema_name() -> Cow<'static, str> {
        "Formula".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "type": ["number", "string"] })
    }
}
