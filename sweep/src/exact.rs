//! Real numbers in JSON, those that are not finite among them: `"NaN"`, `"inf"`, `"-inf"`. Other formats hold them as they are.

use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// A number as JSON has it.
#[derive(Serialize, Deserialize)]
#[serde(untagged)]
enum Written {
    Finite(f64),
    Word(String),
}

impl From<f64> for Written {
    fn from(value: f64) -> Self {
        if value.is_finite() { Self::Finite(value) } else { Self::Word(value.to_string()) }
    }
}

impl Written {
    fn value<E: serde::de::Error>(self) -> Result<f64, E> {
        match self {
            Self::Finite(value) => Ok(value),
            Self::Word(word) => word.parse().map_err(E::custom),
        }
    }
}

/// For `Vec<f64>`.
pub(crate) mod list {
    use super::{Deserialize, Deserializer, Serialize, Serializer, Written};

    pub(crate) fn serialize<S: Serializer>(values: &[f64], serializer: S) -> Result<S::Ok, S::Error> {
        if serializer.is_human_readable() {
            serializer.collect_seq(values.iter().map(|&value| Written::from(value)))
        } else {
            values.serialize(serializer)
        }
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<f64>, D::Error> {
        if deserializer.is_human_readable() {
            Vec::<Written>::deserialize(deserializer)?.into_iter().map(Written::value).collect()
        } else {
            Vec::deserialize(deserializer)
        }
    }
}

/// For `Option<f64>`.
pub(crate) mod option {
    use super::{Deserialize, Deserializer, Serialize, Serializer, Written};

    #[expect(clippy::ref_option, reason = "the signature is serde's")]
    pub(crate) fn serialize<S: Serializer>(value: &Option<f64>, serializer: S) -> Result<S::Ok, S::Error> {
        if serializer.is_human_readable() {
            value.map(Written::from).serialize(serializer)
        } else {
            value.serialize(serializer)
        }
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<f64>, D::Error> {
        if deserializer.is_human_readable() {
            Option::<Written>::deserialize(deserializer)?.map(Written::value).transpose()
        } else {
            Option::deserialize(deserializer)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Debug, Serialize, Deserialize)]
    struct Numbers {
        #[serde(with = "list")]
        list: Vec<f64>,
        #[serde(with = "option")]
        one: Option<f64>,
    }

    #[test]
    fn every_number_comes_back_with_its_bits() {
        let list = vec![0.1 + 0.2, -0.0, f64::INFINITY, f64::NEG_INFINITY, f64::NAN, 5e-324];
        for one in [None, Some(f64::NAN), Some(1.0)] {
            let text = serde_json::to_string(&Numbers { list: list.clone(), one }).expect("plain data");
            let back: Numbers = serde_json::from_str(&text).expect("what was written");
            let bits = |list: &[f64]| list.iter().map(|value| value.to_bits()).collect::<Vec<_>>();
            assert_eq!(bits(&back.list), bits(&list), "{text}");
            assert_eq!(back.one.map(f64::to_bits), one.map(f64::to_bits), "{text}");
        }
    }
}
