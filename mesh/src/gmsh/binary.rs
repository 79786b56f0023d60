//! Binary values: a fixed number of bytes in the byte order of the file.

use super::cursor::Cursor;
use super::error::ParseError;
use super::fault::Fault;

impl Cursor<'_> {
    /// The next `N` bytes.
    pub(super) fn array<const N: usize>(&mut self, wanted: &'static str) -> Result<[u8; N], ParseError> {
        self.mark = self.at;
        let Some(&bytes) = self.rest().first_chunk::<N>() else {
            return Err(self.fail(Fault::Truncated { wanted: wanted.into() }));
        };
        self.at += N;
        Ok(bytes)
    }
}
