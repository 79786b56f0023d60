//! Which values of a scene the paper does not give, read off the scene's own comments.

/// A key whose comment says `substitute`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Substitute {
    pub(crate) key: String,
    pub(crate) value: String,
    pub(crate) comment: String,
}

/// Those of a scene file, in its order.
pub(crate) fn of_scene(text: &str) -> Vec<Substitute> {
    let mut table = String::new();
    let mut found = Vec::new();
    for line in text.lines() {
        if let Some(name) = line.strip_prefix('[').and_then(|rest| rest.split(']').next()) {
            name.clone_into(&mut table);
        }
        let Some((setting, comment)) = line.split_once('#') else { continue };
        let Some((key, value)) = setting.split_once('=').filter(|_| comment.contains("substitute")) else {
            continue;
        };
        let words: Vec<&str> = comment.split_whitespace().collect();
        found.push(Substitute {
            key: format!("{table}.{}", key.trim()),
            value: value.trim().to_owned(),
            comment: words.join(" "),
        });
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_marked_as_substitutes_are_found() {
        let text = "# [substitute] in prose\n[fluid]\ndensity = 1.0   # kg/m3   [paper]\n\
                    viscosity = 2.0   # Pa s   [substitute]\n[structure.geometry]\nsize = [1, 2] # m [paper; substitute: height]\n";
        let found = of_scene(text);
        let keys: Vec<(&str, &str, &str)> =
            found.iter().map(|s| (s.key.as_str(), s.value.as_str(), s.comment.as_str())).collect();
        assert_eq!(
            keys,
            [
                ("fluid.viscosity", "2.0", "Pa s [substitute]"),
                ("structure.geometry.size", "[1, 2]", "m [paper; substitute: height]"),
            ]
        );
    }
}
