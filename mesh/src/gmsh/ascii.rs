//! Text values, lines and section marks. Section marks are text in binary files, too.

use std::str::FromStr;

use super::cursor::{Cursor, Encoding};
use super::error::ParseError;
use super::fault::{Fault, excerpt};

impl<'a> Cursor<'a> {
    /// The next word of this line.
    pub(super) fn word(&mut self, wanted: &'static str) -> Result<&'a [u8], ParseError> {
        self.skip(|byte| byte == b' ' || byte == b'\t');
        let rest = self.rest();
        let length = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
        let word = &rest[..length];
        if rest.is_empty() {
            return Err(self.fail(Fault::Truncated { wanted: wanted.into() }));
        }
        if word.is_empty() {
            return Err(self.fail(Fault::LineEnds { wanted }));
        }
        if word[0] == b'$' {
            return Err(self.fail(Fault::SectionEndsEarly { wanted, found: excerpt(word) }));
        }
        self.at += length;
        Ok(word)
    }

    /// The next word as a number.
    pub(super) fn text_number<T: FromStr>(&mut self, wanted: &'static str) -> Result<T, ParseError> {
        let word = self.word(wanted)?;
        let number = str::from_utf8(word).ok().and_then(|word| word.parse().ok());
        number.ok_or_else(|| self.fail(Fault::NotANumber { wanted, found: excerpt(word) }))
    }

    /// Ends the line: exactly one line break before binary data, any number of empty lines in text.
    pub(super) fn end_line(&mut self, record: &'static str) -> Result<(), ParseError> {
        let line = self.line();
        let surplus = line.trim_ascii();
        if !surplus.is_empty() {
            return Err(self.fail(Fault::Surplus { record, found: excerpt(surplus) }));
        }
        self.at += line.len();
        self.skip_line_break();
        if self.encoding == Encoding::Ascii {
            self.skip(|byte| byte.is_ascii_whitespace());
        }
        Ok(())
    }

    /// What is left of the line, without its line feed.
    pub(super) fn line(&self) -> &'a [u8] {
        let rest = self.rest();
        &rest[..rest.iter().position(|&byte| byte == b'\n').unwrap_or(rest.len())]
    }

    /// Opens the next section, `None` at the end of the file.
    pub(super) fn open_section(&mut self) -> Result<Option<String>, ParseError> {
        self.section = None;
        self.skip(|byte| byte.is_ascii_whitespace());
        if self.rest().is_empty() {
            return Ok(None);
        }
        let line = self.line().trim_ascii_end();
        let name = line.strip_prefix(b"$").and_then(|name| str::from_utf8(name).ok());
        let Some(name) = name.filter(|name| !name.is_empty() && !name.starts_with("End")) else {
            return Err(self.fail(Fault::OutsideSections { found: excerpt(line) }));
        };
        self.at += line.len();
        self.end_line("a section's name")?;
        self.mark = self.at;
        self.section = Some(name.to_owned());
        Ok(self.section.clone())
    }

    /// Closes the section that is open.
    pub(super) fn close_section(&mut self) -> Result<(), ParseError> {
        self.skip(|byte| byte.is_ascii_whitespace());
        let end = self.section_end();
        let line = self.line().trim_ascii_end();
        if self.rest().is_empty() {
            return Err(self.fail(Fault::Truncated { wanted: end }));
        }
        if line != end.as_bytes() {
            return Err(self.fail(Fault::SectionGoesOn { end, found: excerpt(line) }));
        }
        self.at += line.len();
        Ok(())
    }

    /// Leaps over the section that is open.
    pub(super) fn skip_section(&mut self) -> Result<(), ParseError> {
        let end = self.section_end();
        let found = self.rest().windows(end.len()).position(|window| window == end.as_bytes());
        let Some(offset) = found else {
            return Err(self.fail(Fault::SectionOpen { end }));
        };
        self.at += offset;
        self.close_section()
    }

    fn section_end(&self) -> String {
        format!("$End{}", self.section.as_deref().expect("a section is closed after it was opened"))
    }

    /// Passes bytes of a kind; the value behind them is what messages point to.
    pub(super) fn skip(&mut self, passes: impl Fn(u8) -> bool) {
        let rest = self.rest();
        self.at += rest.iter().position(|&byte| !passes(byte)).unwrap_or(rest.len());
        self.mark = self.at;
    }

    fn skip_line_break(&mut self) {
        if self.rest().first() == Some(&b'\n') {
            self.at += 1;
        }
    }
}
