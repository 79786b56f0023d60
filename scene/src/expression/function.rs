//! The functions an expression may call.

use std::fmt;

/// A named function of one or two numbers.
#[derive(Clone, Copy)]
pub struct Function {
    name: &'static str,
    kind: Kind,
}

#[derive(Clone, Copy)]
enum Kind {
    One(fn(f64) -> f64),
    Two(fn(f64, f64) -> f64),
}

impl Function {
    const fn one(name: &'static str, function: fn(f64) -> f64) -> Self {
        Self { name, kind: Kind::One(function) }
    }

    const fn two(name: &'static str, function: fn(f64, f64) -> f64) -> Self {
        Self { name, kind: Kind::Two(function) }
    }

    /// What it is called in an expression.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        self.name
    }

    /// The number of arguments: one or two.
    #[must_use]
    pub const fn arity(&self) -> usize {
        match self.kind {
            Kind::One(_) => 1,
            Kind::Two(_) => 2,
        }
    }

    pub(super) fn call(&self, a: f64, b: f64) -> f64 {
        match self.kind {
            Kind::One(function) => function(a),
            Kind::Two(function) => function(a, b),
        }
    }

    pub(super) fn named(name: &str) -> Option<&'static Self> {
        FUNCTIONS.iter().find(|function| function.name == name)
    }
}

impl fmt::Debug for Function {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name)
    }
}

/// All of them. Angles are in radians; `ln` is the natural logarithm; `heaviside(s)` is 0 below zero, else 1.
pub static FUNCTIONS: [Function; 20] = [
    Function::one("sin", f64::sin),
    Function::one("cos", f64::cos),
    Function::one("tan", f64::tan),
    Function::one("asin", f64::asin),
    Function::one("acos", f64::acos),
    Function::one("atan", f64::atan),
    Function::one("sinh", f64::sinh),
    Function::one("cosh", f64::cosh),
    Function::one("tanh", f64::tanh),
    Function::one("exp", f64::exp),
    Function::one("ln", f64::ln),
    Function::one("log10", f64::log10),
    Function::one("sqrt", f64::sqrt),
    Function::one("abs", f64::abs),
    Function::one("floor", f64::floor),
    Function::one("ceil", f64::ceil),
    Function::one("heaviside", |s| if s < 0.0 { 0.0 } else { 1.0 }),
    Function::two("min", f64::min),
    Function::two("max", f64::max),
    Function::two("atan2", f64::atan2),
];
