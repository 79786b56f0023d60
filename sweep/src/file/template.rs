//! Overrides with formulas of a value: `structure.density=$(1000/x)`.

use partita_scene::expression::Expression;
use partita_scene::schema::plain;

/// A value of a parameter, as the map writes it.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Value {
    /// A number, which formulas may use as `x`.
    Number(f64),
    /// A word such as `unlimited`, which stands for itself.
    Word(String),
}

impl Value {
    /// As it stands in overrides, tables and pictures: the shortest digits that give the same bits.
    pub(super) fn text(&self) -> String {
        match self {
            Self::Number(number) => plain(*number),
            Self::Word(word) => word.clone(),
        }
    }
}

/// The override with the formula in each `$(...)` replaced by its number; `x` is the value.
///
/// # Errors
/// A sentence about what is wrong with it.
pub(super) fn fill(template: &str, value: &Value) -> Result<String, String> {
    let mut filled = String::new();
    let mut rest = template;
    while let Some(start) = rest.find("$(") {
        let (before, after) = rest.split_at(start);
        let length = closing(&after[2..]).ok_or("a `$(` is never closed")?;
        filled.push_str(before);
        filled.push_str(&number(after[2..2 + length].trim(), value)?);
        rest = &after[length + 3..];
    }
    filled.push_str(rest);
    Ok(filled)
}

/// Where the parenthesis that is open at the start is closed.
fn closing(text: &str) -> Option<usize> {
    let mut open = 1;
    for (at, character) in text.char_indices() {
        match character {
            '(' => open += 1,
            ')' => open -= 1,
            _ => {}
        }
        if open == 0 {
            return Some(at);
        }
    }
    None
}

fn number(formula: &str, value: &Value) -> Result<String, String> {
    let x = match value {
        value if formula == "x" => return Ok(value.text()),
        Value::Number(number) => *number,
        Value::Word(word) => {
            return Err(format!(
                "`{formula}` is a formula, but `{word}` is no number: a word is set by `$(x)` alone"
            ));
        }
    };
    let expression = Expression::<1>::parse(formula).map_err(|error| format!("`{formula}`: {error}"))?;
    // There is no time in a map; what depends on it comes out as no number.
    match expression.value(&[x], f64::NAN) {
        result if result.is_finite() => Ok(plain(result)),
        _ => {
            Err(format!("`{formula}` is no finite number where x = {}; a formula may use x and pi", plain(x)))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formulas_are_replaced_and_all_else_stays() {
        let filled = |template: &str, x: f64| fill(template, &Value::Number(x));
        assert_eq!(filled("structure.density=$(1000/x)", 100.0).as_deref(), Ok("structure.density=10"));
        assert_eq!(filled("time.step=$(x)", 1e-5).as_deref(), Ok("time.step=1e-5"));
        assert_eq!(
            filled("a.b=[\"$(x)*t\", \"$( (x + 1)*(x - 1) )\"]", 3.0).as_deref(),
            Ok("a.b=[\"3*t\", \"8\"]")
        );
        assert_eq!(filled("output.fields_every=0", 3.0).as_deref(), Ok("output.fields_every=0"));
        let word = Value::Word("unlimited".to_owned());
        assert_eq!(fill("a.fluid=$(x)", &word).as_deref(), Ok("a.fluid=unlimited"));
    }

    #[test]
    fn what_cannot_be_filled_says_why() {
        for (template, words) in [
            ("a=$(x", "never closed"),
            ("a=$(1/(x - 2))", "no finite number"),
            ("a=$(t*x)", "no finite number"),
            ("a=$(y)", "`y` is unknown"),
        ] {
            let error = fill(template, &Value::Number(2.0)).unwrap_err();
            assert!(error.contains(words), "{template}: {error}");
        }
        let error = fill("a=$(2*x)", &Value::Word("unlimited".to_owned())).unwrap_err();
        assert!(error.contains("a word is set by `$(x)` alone"), "{error}");
    }
}
