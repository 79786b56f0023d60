//! The place in the file: values are taken one after the other, as text or binary.

use super::error::{ParseError, Position};
use super::fault::Fault;

/// How numbers are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Encoding {
    Ascii,
    LittleEndian,
    BigEndian,
}

/// A file that is read from the front. Text is strict about lines: a record fills its line, no less, no more.
pub(super) struct Cursor<'a> {
    pub(super) bytes: &'a [u8],
    /// The next byte to read.
    pub(super) at: usize,
    /// Where the latest value began: the place that messages name.
    pub(super) mark: usize,
    pub(super) encoding: Encoding,
    pub(super) section: Option<String>,
}

impl<'a> Cursor<'a> {
    /// A UTF-8 byte-order mark, which editors put before text, is passed over.
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        let at = if bytes.starts_with(b"\xef\xbb\xbf") { 3 } else { 0 };
        Self { bytes, at, mark: at, encoding: Encoding::Ascii, section: None }
    }

    pub(super) fn rest(&self) -> &'a [u8] {
        &self.bytes[self.at..]
    }

    /// A fault at the latest value.
    pub(super) fn fail(&self, fault: Fault) -> ParseError {
        let position = if self.encoding == Encoding::Ascii {
            Position::Line(self.bytes[..self.mark].split(|&byte| byte == b'\n').count())
        } else {
            Position::Byte(self.mark)
        };
        ParseError { position, section: self.section.clone(), fault }
    }

    /// An `int` of the format: 32 bits in binary; in text other tools write larger ones, too.
    pub(super) fn int(&mut self, wanted: &'static str) -> Result<i64, ParseError> {
        match self.encoding {
            Encoding::Ascii => self.text_number(wanted),
            Encoding::LittleEndian => Ok(i32::from_le_bytes(self.array(wanted)?).into()),
            Encoding::BigEndian => Ok(i32::from_be_bytes(self.array(wanted)?).into()),
        }
    }

    /// A `size_t` of the format.
    pub(super) fn size(&mut self, wanted: &'static str) -> Result<u64, ParseError> {
        match self.encoding {
            Encoding::Ascii => self.text_number(wanted),
            Encoding::LittleEndian => Ok(u64::from_le_bytes(self.array(wanted)?)),
            Encoding::BigEndian => Ok(u64::from_be_bytes(self.array(wanted)?)),
        }
    }

    /// A `double` of the format.
    pub(super) fn real(&mut self, wanted: &'static str) -> Result<f64, ParseError> {
        match self.encoding {
            Encoding::Ascii => self.text_number(wanted),
            Encoding::LittleEndian => Ok(f64::from_le_bytes(self.array(wanted)?)),
            Encoding::BigEndian => Ok(f64::from_be_bytes(self.array(wanted)?)),
        }
    }

    /// Three finite coordinates.
    pub(super) fn point(&mut self) -> Result<[f64; 3], ParseError> {
        let mut point = [0.0; 3];
        for x in &mut point {
            *x = self.real("a coordinate")?;
            if !x.is_finite() {
                return Err(self.fail(Fault::NotFinite { value: *x }));
            }
        }
        Ok(point)
    }

    /// An `int` that is not negative.
    pub(super) fn unsigned(&mut self, wanted: &'static str) -> Result<u64, ParseError> {
        let value = self.int(wanted)?;
        u64::try_from(value).map_err(|_| self.fail(Fault::Negative { wanted, value }))
    }

    /// The dimension of an entity, 0 to 3.
    pub(super) fn dimension(&mut self) -> Result<usize, ParseError> {
        let value = self.int("a dimension")?;
        match usize::try_from(value) {
            Ok(dimension @ 0..=3) => Ok(dimension),
            _ => Err(self.fail(Fault::Dimension { value })),
        }
    }

    /// Ends a record: the end of the line in text, nothing in binary.
    pub(super) fn end_record(&mut self, record: &'static str) -> Result<(), ParseError> {
        if self.encoding == Encoding::Ascii { self.end_line(record) } else { Ok(()) }
    }

    /// Refuses a count of records that the bytes left cannot hold, before anything of its size is allocated.
    /// A record has `numbers = [ints, sizes, reals]` at least; in text each takes a digit and a separator.
    pub(super) fn bounded(
        &self,
        what: &'static str,
        count: u64,
        numbers: [usize; 3],
    ) -> Result<usize, ParseError> {
        let [ints, sizes, reals] = numbers;
        let least = match self.encoding {
            Encoding::Ascii => 2 * (ints + sizes + reals),
            Encoding::LittleEndian | Encoding::BigEndian => 4 * ints + 8 * (sizes + reals),
        };
        let left = self.rest().len();
        match usize::try_from(count) {
            Ok(count) if count <= left / least => Ok(count),
            _ => Err(self.fail(Fault::TooMany { what, count, left })),
        }
    }
}
