//! What a run must remember between two steps, as bytes that only their owner reads.
//!
//! An accelerator, a participant or a probe saves whatever it needs: the rest of a run sees bytes and a name, so that a
//! checkpoint holds things that this crate has never heard of. [`encode`] and [`decode`] turn plain data into such bytes,
//! every `f64` with all its bits; an owner may just as well write them itself.

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use crate::setup::SetupError;

/// A saved state with the name of its owner.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Saved {
    /// Who saved it.
    pub owner: String,
    /// What only the owner understands; empty if it has nothing to remember.
    pub bytes: Vec<u8>,
}

impl Saved {
    /// The state that `owner` saved.
    #[must_use]
    pub fn new(owner: &str, bytes: Vec<u8>) -> Self {
        Self { owner: owner.to_owned(), bytes }
    }

    /// The bytes, if they belong to `owner`.
    ///
    /// # Errors
    /// If somebody else saved them.
    pub fn bytes_of(&self, owner: &str) -> Result<&[u8], SetupError> {
        if self.owner == owner {
            return Ok(&self.bytes);
        }
        Err(SetupError::state(owner, format!("it is that of `{}`", self.owner)))
    }
}

/// Plain data as bytes (postcard's encoding).
///
/// # Panics
/// If the data has a sequence of unknown length, or its own `Serialize` fails.
#[must_use]
pub fn encode<T: Serialize + ?Sized>(data: &T) -> Vec<u8> {
    postcard::to_stdvec(data).expect("plain data can be encoded")
}

/// Plain data from the bytes that [`encode`] made of it.
///
/// # Errors
/// If the bytes are cut, or are not such data: the error names `owner`.
pub fn decode<T: DeserializeOwned>(owner: &str, bytes: &[u8]) -> Result<T, SetupError> {
    match postcard::take_from_bytes(bytes) {
        Ok((data, [])) => Ok(data),
        Ok((_, rest)) => Err(SetupError::state(owner, format!("{} bytes too many", rest.len()))),
        Err(error) => {
            Err(SetupError::state(owner, format!("{} bytes are not its data: {error}", bytes.len())))
        }
    }
}

/// Accepts the saved state of an owner that has nothing to remember.
///
/// # Errors
/// If there is a state.
pub fn expect_none(owner: &str, bytes: &[u8]) -> Result<(), SetupError> {
    if bytes.is_empty() {
        return Ok(());
    }
    Err(SetupError::state(owner, format!("it has no state, but {} bytes were saved", bytes.len())))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn data_come_back_with_all_their_bits() {
        let data = (vec![0.1_f64, -0.0, f64::MIN_POSITIVE / 3.0], Some(7_usize));
        let back: (Vec<f64>, Option<usize>) = decode("test", &encode(&data)).unwrap();
        assert_eq!(back, data);
        assert!(back.0[1].is_sign_negative());
    }

    #[test]
    fn errors_name_the_owner_and_what_is_wrong() {
        let bytes = encode(&vec![1.0_f64, 2.0]);
        let cut = decode::<Vec<f64>>("Anderson", &bytes[..9]).unwrap_err().to_string();
        assert!(cut.contains("Anderson") && cut.contains("9 bytes are not its data"), "{cut}");
        let long = decode::<f64>("Anderson", &[bytes, vec![0; 3]].concat()).unwrap_err().to_string();
        assert!(long.contains("bytes too many"), "{long}");
        let foreign = Saved::new("aitken", Vec::new()).bytes_of("iqn_ils").unwrap_err().to_string();
        assert!(foreign.contains("iqn_ils") && foreign.contains("`aitken`"), "{foreign}");
        assert!(expect_none("constant", &[1]).is_err() && expect_none("constant", &[]).is_ok());
    }
}
