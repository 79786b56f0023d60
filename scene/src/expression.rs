//! Formulas in scene files: `"4*y*(1 - y)"`, checked once, evaluated anywhere.
//!
//! ```text
//! sum     = product { ("+" | "-") product }
//! product = signed { ("*" | "/") signed }
//! signed  = ("+" | "-") signed | power
//! power   = primary [ "^" signed ]                     -x^2 = -(x^2),  2^3^2 = 2^(3^2)
//! primary = number | name | name "(" sum { "," sum } ")" | "(" sum ")"
//! ```
//!
//! Names are the position (`x`, `y`, in three dimensions `z`) \[m\], the time `t` \[s\], `pi`, and the functions
//! listed in [`FUNCTIONS`]. The grammar is our own because a profile such as `exp(-y^2)` must mean what it says: the
//! expression crate tried first read it as `exp((-y)^2)`, refused `1e-3` and gave no place with an error.

mod function;
mod parser;

use std::fmt;
use std::ops::Range;

use thiserror::Error;

pub use function::FUNCTIONS;
use function::Function;

/// An expression of `D` coordinates and the time.
///
/// A flat list of operations on a stack of fixed size: evaluating allocates nothing, and the same input gives
/// the same bits.
///
/// ```
/// use partita_scene::expression::Expression;
///
/// let inflow = Expression::<2>::parse("4*y*(1 - y) * min(t/0.1, 1)")?;
/// assert_eq!(inflow.value(&[0.0, 0.5], 1.0), 1.0);
/// # Ok::<(), partita_scene::expression::ExpressionError>(())
/// ```
#[derive(Clone)]
pub struct Expression<const D: usize> {
    text: String,
    operations: Vec<Operation>,
}

/// Where an expression cannot be read, and why.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{message}")]
pub struct ExpressionError {
    /// What is wrong there.
    pub message: String,
    /// Bytes of the text that are to blame; empty at its end.
    pub place: Range<usize>,
}

#[derive(Debug, Clone, Copy)]
enum Operation {
    Number(f64),
    Coordinate(usize),
    Time,
    Negate,
    Add,
    Subtract,
    Multiply,
    Divide,
    Power,
    Call(&'static Function),
}

impl Operation {
    /// How many values it takes off the stack; it always leaves one.
    const fn takes(self) -> usize {
        match self {
            Self::Number(_) | Self::Coordinate(_) | Self::Time => 0,
            Self::Negate => 1,
            Self::Add | Self::Subtract | Self::Multiply | Self::Divide | Self::Power => 2,
            Self::Call(function) => function.arity(),
        }
    }
}

/// Values the stack can hold.
const STACK: usize = 64;

impl<const D: usize> Expression<D> {
    /// Reads and checks an expression.
    ///
    /// # Errors
    ///
    /// [`ExpressionError`] with the place in `text`.
    pub fn parse(text: &str) -> Result<Self, ExpressionError> {
        const { assert!(D >= 1 && D <= 3, "a position has one to three coordinates") };
        let operations = parser::parse(text, D)?;
        if stack_depth(&operations) > STACK {
            let message = "the expression is nested too deeply".to_owned();
            return Err(ExpressionError { message, place: 0..text.len() });
        }
        Ok(Self { text: text.to_owned(), operations })
    }

    /// The value at a position \[m\] and a time \[s\].
    #[must_use]
    pub fn value(&self, position: &[f64; D], time: f64) -> f64 {
        let mut stack = [0.0; STACK];
        let mut top = 0;
        for &operation in &self.operations {
            top -= operation.takes();
            let (a, b) = (stack[top], stack[(top + 1).min(STACK - 1)]);
            stack[top] = match operation {
                Operation::Number(number) => number,
                Operation::Coordinate(index) => position[index],
                Operation::Time => time,
                Operation::Negate => -a,
                Operation::Add => a + b,
                Operation::Subtract => a - b,
                Operation::Multiply => a * b,
                Operation::Divide => a / b,
                Operation::Power => a.powf(b),
                Operation::Call(function) => function.call(a, b),
            };
            top += 1;
        }
        stack[0]
    }

    /// Whether the value depends on the position.
    #[must_use]
    pub fn uses_position(&self) -> bool {
        self.operations.iter().any(|operation| matches!(operation, Operation::Coordinate(_)))
    }

    /// The text it was read from.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }
}

fn stack_depth(operations: &[Operation]) -> usize {
    let mut depth = 0;
    let mut deepest = 0;
    for operation in operations {
        depth = depth + 1 - operation.takes();
        deepest = deepest.max(depth);
    }
    deepest
}

impl<const D: usize> fmt::Debug for Expression<D> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Expression({:?})", self.text)
    }
}

impl<const D: usize> PartialEq for Expression<D> {
    fn eq(&self, other: &Self) -> bool {
        self.text == other.text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(text: &str) -> f64 {
        Expression::<3>::parse(text).unwrap().value(&[3.0, 5.0, 7.0], 0.25)
    }

    fn error(text: &str) -> (String, Range<usize>) {
        let error = Expression::<2>::parse(text).unwrap_err();
        (error.message, error.place)
    }

    #[track_caller]
    fn assert_values(cases: &[(&str, f64)]) {
        for &(text, expected) in cases {
            assert_eq!(value(text).to_bits(), expected.to_bits(), "{text} = {}, not {expected}", value(text));
        }
    }

    #[test]
    fn operators_bind_as_on_paper() {
        assert_values(&[
            ("1 + 2*3", 7.0),
            ("(1 + 2)*3", 9.0),
            ("-2^2", -4.0),
            ("2^-1", 0.5),
            ("2^3^2", 512.0),
            ("2 - 3 - 4", -5.0),
            ("16/4/2", 2.0),
            ("1/-2^2", -0.25),
            ("2--3", 5.0),
            ("-+-1", 1.0),
            ("exp(-(1)^2)", (-1.0f64).exp()),
        ]);
    }

    #[test]
    fn numbers_are_read_in_every_usual_form() {
        assert_values(&[("1e-3", 1e-3), ("1.5E2", 150.0), (".5", 0.5), ("2.", 2.0), ("0.1e+1", 1.0)]);
    }

    #[test]
    fn names_are_the_position_the_time_and_pi() {
        assert_values(&[("x", 3.0), ("y", 5.0), ("z", 7.0), ("t", 0.25), ("pi", std::f64::consts::PI)]);
    }

    #[test]
    fn functions_nest_and_take_their_arguments_in_order() {
        assert_values(&[
            ("min(max(1, 2), max(3, 4))", 2.0),
            ("atan2(1, 2)", 1.0f64.atan2(2.0)),
            ("sqrt(x^2 + 16)", 5.0),
            ("abs(-x) + 1", 4.0),
            ("1 + min(2, 3)*2", 5.0),
        ]);
    }

    #[test]
    fn an_error_points_at_its_place() {
        let cases: &[(&str, &str, Range<usize>)] = &[
            ("", "the expression is empty", 0..0),
            ("4*y*(1-y", "this parenthesis is never closed", 4..5),
            ("4*y)", "no parenthesis is open here", 3..4),
            ("1 -", "a number, a name or a parenthesis is missing here", 3..3),
            ("1 + * 2", "a number, a name or a parenthesis is missing here", 4..5),
            ("4y", "an operator is missing before this; a product is written with `*`", 1..2),
            ("2**3", "a number, a name or a parenthesis is missing here; a power is written with `^`", 2..3),
            ("sin x", "the argument of `sin` belongs in parentheses", 0..3),
            ("min(1)", "`min` takes 2 arguments, not 1", 0..3),
            ("sin(1, 2)", "`sin` takes 1 argument, not 2", 0..3),
            ("2*z", "`z` is unknown; known are x, y, t, pi and functions such as `sin`", 2..3),
            ("siin(x)", "`siin` is no function; did you mean `sin`?", 0..4),
            ("x(2)", "`x` is no function", 0..1),
            ("1e999", "this number is too large", 0..5),
            ("1.2.3", "this is not a number", 0..5),
            ("x & y", "this character has no meaning here", 2..3),
            ("(x & y)", "this character has no meaning here", 3..4),
            ("(1, 2)", "a comma stands only between the arguments of a function", 2..3),
            ("2 * ünder", "this character has no meaning here", 4..6),
        ];
        for (text, message, place) in cases {
            assert_eq!(error(text), ((*message).to_owned(), place.clone()), "{text}");
        }
    }

    #[test]
    fn depth_is_bounded_and_length_is_not() {
        let deep = format!("{}1{}", "(".repeat(100_000), ")".repeat(100_000));
        assert_eq!(error(&deep).0, "the expression is nested too deeply");
        let signs = format!("{}1", "-".repeat(100_000));
        assert_eq!(error(&signs).0, "the expression is nested too deeply");
        let long = vec!["x"; 10_000].join("+");
        assert!((value(&long) - 30_000.0).abs() < 1e-9);
    }
}
