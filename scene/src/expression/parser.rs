//! From text to operations, by recursive descent over the grammar of the parent module.

use std::ops::Range;

use super::{ExpressionError, Function, Operation};
use crate::spelling::nearest;

/// Parentheses, signs and powers inside one another.
const DEPTH: usize = 60;

const COORDINATES: [&str; 3] = ["x", "y", "z"];

pub(super) fn parse(text: &str, dimension: usize) -> Result<Vec<Operation>, ExpressionError> {
    let mut parser = Parser { text, at: 0, depth: 0, dimension, operations: Vec::new() };
    if parser.peek().is_none() {
        return Err(fail("the expression is empty", 0..text.len()));
    }
    parser.sum()?;
    match parser.peek() {
        None => Ok(parser.operations),
        Some(found) => Err(parser.leftover(found)),
    }
}

struct Parser<'a> {
    text: &'a str,
    at: usize,
    depth: usize,
    dimension: usize,
    operations: Vec<Operation>,
}

type Parsed = Result<(), ExpressionError>;

impl Parser<'_> {
    fn sum(&mut self) -> Parsed {
        self.product()?;
        loop {
            let operation = match self.peek() {
                Some(b'+') => Operation::Add,
                Some(b'-') => Operation::Subtract,
                _ => return Ok(()),
            };
            self.at += 1;
            self.product()?;
            self.operations.push(operation);
        }
    }

    fn product(&mut self) -> Parsed {
        self.signed()?;
        loop {
            let operation = match self.peek() {
                Some(b'*') => Operation::Multiply,
                Some(b'/') => Operation::Divide,
                _ => return Ok(()),
            };
            self.at += 1;
            self.signed()?;
            self.operations.push(operation);
        }
    }

    fn signed(&mut self) -> Parsed {
        self.depth += 1;
        if self.depth > DEPTH {
            return Err(fail("the expression is nested too deeply", 0..self.text.len()));
        }
        match self.peek() {
            Some(b'-') => {
                self.at += 1;
                self.signed()?;
                self.operations.push(Operation::Negate);
            }
            Some(b'+') => {
                self.at += 1;
                self.signed()?;
            }
            _ => self.power()?,
        }
        self.depth -= 1;
        Ok(())
    }

    fn power(&mut self) -> Parsed {
        self.primary()?;
        if self.peek() == Some(b'^') {
            self.at += 1;
            self.signed()?;
            self.operations.push(Operation::Power);
        }
        Ok(())
    }

    fn primary(&mut self) -> Parsed {
        match self.peek() {
            Some(b'(') => {
                let open = self.at;
                self.at += 1;
                self.sum()?;
                self.close(open)
            }
            Some(c) if c.is_ascii_digit() || c == b'.' => self.number(),
            Some(c) if c.is_ascii_alphabetic() || c == b'_' => self.name(),
            Some(b'*') if self.text[..self.at].ends_with('*') => Err(self
                .fail_here("a number, a name or a parenthesis is missing here; a power is written with `^`")),
            None | Some(b'+' | b'-' | b'*' | b'/' | b'^' | b')' | b',') => {
                Err(self.fail_here("a number, a name or a parenthesis is missing here"))
            }
            Some(_) => Err(self.fail_here("this character has no meaning here")),
        }
    }

    fn close(&mut self, open: usize) -> Parsed {
        match self.peek() {
            Some(b')') => {
                self.at += 1;
                Ok(())
            }
            None => Err(fail("this parenthesis is never closed", open..open + 1)),
            Some(found) => Err(self.leftover(found)),
        }
    }

    /// What is wrong with something that follows a complete sum.
    fn leftover(&self, found: u8) -> ExpressionError {
        self.fail_here(match found {
            b')' => "no parenthesis is open here",
            b',' => "a comma stands only between the arguments of a function",
            b'(' | b'.' | b'_' | b'0'..=b'9' | b'a'..=b'z' | b'A'..=b'Z' => {
                "an operator is missing before this; a product is written with `*`"
            }
            _ => "this character has no meaning here",
        })
    }

    fn number(&mut self) -> Parsed {
        let start = self.at;
        let bytes = self.text.as_bytes();
        let digits = |mut at: usize| {
            while bytes.get(at).is_some_and(|c| c.is_ascii_digit() || *c == b'.') {
                at += 1;
            }
            at
        };
        self.at = digits(start);
        if matches!(bytes.get(self.at), Some(b'e' | b'E')) {
            let sign = usize::from(matches!(bytes.get(self.at + 1), Some(b'+' | b'-')));
            let exponent = self.at + 1 + sign;
            if bytes.get(exponent).is_some_and(u8::is_ascii_digit) {
                self.at = digits(exponent);
            }
        }
        match self.text[start..self.at].parse::<f64>() {
            Ok(number) if number.is_finite() => {
                self.operations.push(Operation::Number(number));
                Ok(())
            }
            Ok(_) => Err(fail("this number is too large", start..self.at)),
            Err(_) => Err(fail("this is not a number", start..self.at)),
        }
    }

    fn name(&mut self) -> Parsed {
        let start = self.at;
        while self.text.as_bytes().get(self.at).is_some_and(|c| c.is_ascii_alphanumeric() || *c == b'_') {
            self.at += 1;
        }
        let place = start..self.at;
        let name = &self.text[place.clone()];
        if self.peek() == Some(b'(') {
            let function = Function::named(name).ok_or_else(|| no_function(name, place.clone()))?;
            return self.call(function, place);
        }
        let operation = match COORDINATES[..self.dimension].iter().position(|known| *known == name) {
            Some(index) => Operation::Coordinate(index),
            None if name == "t" => Operation::Time,
            None if name == "pi" => Operation::Number(std::f64::consts::PI),
            None => return Err(self.unknown(name, place)),
        };
        self.operations.push(operation);
        Ok(())
    }

    fn call(&mut self, function: &'static Function, place: Range<usize>) -> Parsed {
        let open = self.at;
        let mut count = 0;
        while count == 0 || self.peek() == Some(b',') {
            self.at += 1;
            self.sum()?;
            count += 1;
        }
        self.close(open)?;
        if count != function.arity() {
            let (name, arity) = (function.name(), function.arity());
            let plural = if arity == 1 { "" } else { "s" };
            return Err(fail(format!("`{name}` takes {arity} argument{plural}, not {count}"), place));
        }
        self.operations.push(Operation::Call(function));
        Ok(())
    }

    fn unknown(&self, name: &str, place: Range<usize>) -> ExpressionError {
        if Function::named(name).is_some() {
            return fail(format!("the argument of `{name}` belongs in parentheses"), place);
        }
        let known = COORDINATES[..self.dimension].join(", ");
        fail(format!("`{name}` is unknown; known are {known}, t, pi and functions such as `sin`"), place)
    }

    /// The next byte that is not a blank.
    fn peek(&mut self) -> Option<u8> {
        let bytes = self.text.as_bytes();
        while bytes.get(self.at).is_some_and(u8::is_ascii_whitespace) {
            self.at += 1;
        }
        bytes.get(self.at).copied()
    }

    fn fail_here(&self, message: &str) -> ExpressionError {
        let length = self.text[self.at..].chars().next().map_or(0, char::len_utf8);
        fail(message, self.at..self.at + length)
    }
}

fn no_function(name: &str, place: Range<usize>) -> ExpressionError {
    let names = super::FUNCTIONS.iter().map(Function::name);
    let hint = nearest(name, names).map_or_else(String::new, |near| format!("; did you mean `{near}`?"));
    fail(format!("`{name}` is no function{hint}"), place)
}

fn fail(message: impl Into<String>, place: Range<usize>) -> ExpressionError {
    ExpressionError { message: message.into(), place }
}
