//! Tables in Markdown.

/// A table; the columns after the first are numbers and stand to the right.
pub(crate) fn table<H: AsRef<str>>(header: &[H], rows: &[Vec<String>]) -> String {
    let rule: Vec<&str> = (0..header.len()).map(|column| if column == 0 { "---" } else { "---:" }).collect();
    let header: Vec<&str> = header.iter().map(AsRef::as_ref).collect();
    let mut text = line(&header) + &format!("|{}|\n", rule.join("|"));
    for row in rows {
        assert_eq!(row.len(), header.len(), "a row has a value for each column");
        text += &line(row);
    }
    text
}

/// The same with text in every column.
pub(crate) fn prose_table<H: AsRef<str>>(header: &[H], rows: &[Vec<String>]) -> String {
    table(header, rows).replacen("---:", "---", header.len())
}

fn line<S: AsRef<str>>(values: &[S]) -> String {
    let values: Vec<String> = values.iter().map(|value| value.as_ref().replace('|', "\\|")).collect();
    format!("| {} |\n", values.join(" | "))
}

/// A part as percent with sign: `+1.3 %`.
pub(crate) fn percent(part: f64) -> String {
    format!("{:+.1} %", 100.0 * part)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_has_a_rule_below_its_header() {
        let rows = [vec!["a|b".to_owned(), percent(0.0125)]];
        assert_eq!(table(&["x", "y"], &rows), "| x | y |\n|---|---:|\n| a\\|b | +1.2 % |\n");
        assert_eq!(prose_table(&["x", "y"], &rows), "| x | y |\n|---|---|\n| a\\|b | +1.2 % |\n");
    }
}
