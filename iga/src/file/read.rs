//! A spline from text.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeArray, DeTable, DeValue};

use super::error::{Fault, FileError};
use super::format::{EXAMPLES, FORMAT, KEYS, VERSION};
use crate::knots::{KnotError, Knots};
use crate::nearest::nearest;
use crate::spline::{MAX_PARAMETERS, Spline, SplineError};

type Value<'a> = Spanned<DeValue<'a>>;

pub(super) fn spline<const D: usize>(text: &str) -> Result<Spline<D>, FileError> {
    let document = Document::parse(text)?;
    // First of all the version: a later one may have other keys.
    document.check_format()?;
    document.check_keys()?;
    document.check_dimension(D)?;
    let knots = document.knots()?;
    let control_points = document.control_points(&knots)?;
    let weights = document.weights(control_points.len())?;
    // Whatever `rational` refuses has been found at its place.
    Spline::rational(knots, control_points, weights)
        .map_err(|error| document.error(0..text.len(), Fault::Spline { key: "control_points", error }))
}

/// The table in the text, whose values know their places.
struct Document<'a> {
    text: &'a str,
    table: DeTable<'a>,
}

impl<'a> Document<'a> {
    fn parse(text: &'a str) -> Result<Self, FileError> {
        match DeTable::parse(text) {
            Ok(table) => Ok(Self { text, table: table.into_inner() }),
            Err(error) => {
                let span = error.span().unwrap_or(0..0);
                let message = error.message().lines().collect::<Vec<_>>().join("; ");
                Err(FileError::new(text, span, Fault::Toml { message }))
            }
        }
    }

    fn error(&self, span: Range<usize>, fault: Fault) -> FileError {
        FileError::new(self.text, span, fault)
    }

    fn check_format(&self) -> Result<(), FileError> {
        let format = self.required("format")?;
        let found = format.get_ref().as_str();
        let found = found.ok_or_else(|| self.wrong_kind("format", format, "a text in quotes"))?;
        if found != FORMAT {
            return Err(self.error(format.span(), Fault::Format { found: shown(found) }));
        }
        let version = self.required("version")?;
        match self.whole("version", version)? {
            VERSION => Ok(()),
            found => Err(self.error(version.span(), Fault::Version { found })),
        }
    }

    /// No key that is unknown; the first in the text is named.
    fn check_keys(&self) -> Result<(), FileError> {
        let unknown = self.table.keys().filter(|key| !KEYS.contains(&key.get_ref().as_ref()));
        match unknown.min_by_key(|key| key.span().start) {
            None => Ok(()),
            Some(key) => {
                let fault =
                    Fault::UnknownKey { key: shown(key.get_ref()), nearest: nearest(key.get_ref(), &KEYS) };
                Err(self.error(key.span(), fault))
            }
        }
    }

    fn check_dimension(&self, wanted: usize) -> Result<(), FileError> {
        let dimension = self.required("dimension")?;
        match self.whole("dimension", dimension)? {
            found if found == wanted => Ok(()),
            found => Err(self.error(dimension.span(), Fault::Dimension { found, wanted })),
        }
    }

    fn knots(&self) -> Result<Vec<Knots>, FileError> {
        let value = self.required("degrees")?;
        let degrees = self.list("degrees", value, "a list of degrees like [2, 2]")?;
        if degrees.len() > MAX_PARAMETERS {
            return Err(self.error(value.span(), Fault::TooManyParameters { found: degrees.len() }));
        }
        let value = self.required("knots")?;
        let vectors = self.list("knots", value, "a list of lists of knots, one for each degree")?;
        if vectors.len() != degrees.len() {
            let fault = Fault::KnotVectors { found: vectors.len(), needed: degrees.len() };
            return Err(self.error(value.span(), fault));
        }
        (0..degrees.len()).map(|i| self.knot_vector(i, &degrees[i], &vectors[i])).collect()
    }

    fn knot_vector(
        &self,
        parameter: usize,
        degree: &Value<'_>,
        vector: &Value<'_>,
    ) -> Result<Knots, FileError> {
        let path = format!("knots[{parameter}]");
        let places = self.list(&path, vector, "a list of knots")?;
        let values = self.numbers(&path, places)?;
        let found = values.len();
        let at = |place: Range<usize>, error| self.error(place, Fault::Knots { parameter, error });
        let degree_place = degree.span();
        let degree = self.whole(&format!("degrees[{parameter}]"), degree)?;
        // Compared before anything is computed from a degree that may be absurd.
        if degree >= found {
            let needed = degree.saturating_add(1).saturating_mul(2);
            return Err(at(vector.span(), KnotError::TooFew { found, needed, degree }));
        }
        Knots::new(degree, values).map_err(|error| {
            let place = match &error {
                KnotError::DegreeZero => degree_place,
                KnotError::NotFinite { index, .. } | KnotError::Decreasing { index, .. } => {
                    places[*index].span()
                }
                KnotError::NoElements
                | KnotError::TooFew { .. }
                | KnotError::Outside { .. }
                | KnotError::Overflow { .. }
                | KnotError::TooClose { .. }
                | KnotError::NotClamped { .. }
                | KnotError::Multiplicity { .. } => vector.span(),
            };
            at(place, error)
        })
    }

    fn control_points<const D: usize>(&self, knots: &[Knots]) -> Result<Vec<[f64; D]>, FileError> {
        const KEY: &str = "control_points";
        let value = self.required(KEY)?;
        let places = self.list(KEY, value, "a list of points like [[0.0, 0.0], [1.0, 0.0]]")?;
        let shape: Vec<usize> = knots.iter().map(Knots::basis_count).collect();
        let needed = shape.iter().fold(1, |product: usize, &count| product.saturating_mul(count));
        if places.len() != needed {
            let error = SplineError::ControlPoints { found: places.len(), needed, shape };
            return Err(self.error(value.span(), Fault::Spline { key: KEY, error }));
        }
        places.iter().enumerate().map(|(index, place)| self.control_point(index, place)).collect()
    }

    fn control_point<const D: usize>(&self, index: usize, value: &Value<'_>) -> Result<[f64; D], FileError> {
        let path = format!("control_points[{index}]");
        let coordinates = self.numbers(&path, self.list(&path, value, "a list of coordinates")?)?;
        if coordinates.iter().any(|x| !x.is_finite()) {
            let error = SplineError::NotFinite { index };
            return Err(self.error(value.span(), Fault::Spline { key: "control_points", error }));
        }
        let found = coordinates.len();
        let components = |_| self.error(value.span(), Fault::Components { index, found, needed: D });
        coordinates.try_into().map_err(components)
    }

    fn weights(&self, needed: usize) -> Result<Vec<f64>, FileError> {
        const KEY: &str = "weights";
        let Some(value) = self.table.get(KEY) else { return Ok(vec![1.0; needed]) };
        let places = self.list(KEY, value, "a list of weights")?;
        let weights = self.numbers(KEY, places)?;
        let refuse = |place, error| Err(self.error(place, Fault::Spline { key: KEY, error }));
        if weights.len() != needed {
            return refuse(value.span(), SplineError::Weights { found: weights.len(), needed });
        }
        match weights.iter().position(|w| !(w.is_finite() && *w > 0.0)) {
            Some(index) => refuse(places[index].span(), SplineError::Weight { index, value: weights[index] }),
            None => Ok(weights),
        }
    }

    fn required(&self, key: &'static str) -> Result<&Value<'a>, FileError> {
        self.table.get(key).ok_or_else(|| {
            let example = KEYS.iter().position(|known| *known == key).map_or("", |index| EXAMPLES[index]);
            self.error(self.text.len()..self.text.len(), Fault::MissingKey { key, example })
        })
    }

    fn list<'v>(
        &self,
        path: &str,
        value: &'v Value<'a>,
        wanted: &'static str,
    ) -> Result<&'v DeArray<'a>, FileError> {
        value.get_ref().as_array().ok_or_else(|| self.wrong_kind(path, value, wanted))
    }

    fn numbers(&self, path: &str, list: &DeArray<'_>) -> Result<Vec<f64>, FileError> {
        list.iter().enumerate().map(|(i, value)| self.number(path, i, value)).collect()
    }

    fn number(&self, path: &str, index: usize, value: &Value<'_>) -> Result<f64, FileError> {
        let number = match value.get_ref() {
            DeValue::Float(float) => float.as_str().parse().ok(),
            DeValue::Integer(whole) if whole.radix() == 10 => whole.as_str().parse().ok(),
            _ => None,
        };
        number.ok_or_else(|| self.wrong_kind(&format!("{path}[{index}]"), value, "a decimal number"))
    }

    fn whole(&self, path: &str, value: &Value<'_>) -> Result<usize, FileError> {
        let whole = value.get_ref().as_integer().filter(|whole| whole.radix() == 10);
        whole
            .and_then(|whole| whole.as_str().parse().ok())
            .ok_or_else(|| self.wrong_kind(path, value, "a whole number, 0 or more"))
    }

    fn wrong_kind(&self, path: &str, value: &Value<'_>, wanted: &'static str) -> FileError {
        let found = match value.get_ref() {
            DeValue::String(text) => format!("the text \"{}\"", shown(text)),
            DeValue::Integer(number) => format!("the number {}", shown(&number.to_string())),
            DeValue::Float(number) => format!("the number {}", shown(number.as_str())),
            DeValue::Boolean(value) => format!("`{value}`"),
            DeValue::Datetime(_) => "a date or time".to_owned(),
            DeValue::Array(_) => "a list".to_owned(),
            DeValue::Table(_) => "a table".to_owned(),
        };
        self.error(value.span(), Fault::Kind { path: path.to_owned(), wanted, found })
    }
}

/// The start of a text on one line: what somebody else wrote may have any length and hold any character.
fn shown(text: &str) -> String {
    const LONGEST: usize = 40;
    let start: String = text.chars().take(LONGEST).flat_map(char::escape_debug).collect();
    if text.chars().nth(LONGEST).is_some() { start + "..." } else { start }
}
