//! The line of keys.

use super::Space;

/// `Lattice`, `Origin` and `pbc`, followed by a blank.
pub(super) fn lattice(space: Option<&Space>) -> String {
    let Some(Space { origin: [x, y, z], sides: [a, b, c], periodic }) = space else {
        return "pbc=\"F F F\" ".to_owned();
    };
    let [p, q, r] = periodic.map(|is_periodic| if is_periodic { 'T' } else { 'F' });
    format!(
        "Lattice=\"{a:?} 0.0 0.0 0.0 {b:?} 0.0 0.0 0.0 {c:?}\" Origin=\"{x:?} {y:?} {z:?}\" pbc=\"{p} {q} {r}\" "
    )
}

/// A key with its value.
#[derive(Debug, PartialEq)]
pub(super) struct Pair<'a> {
    pub(super) key: &'a str,
    /// The value without quotes. Empty if the key has no value.
    pub(super) value: &'a str,
}

/// The pairs of a line: `key=value`, `key="a value"`, `key={a value}`, or a key alone.
pub(super) fn pairs(line: &str) -> Result<Vec<Pair<'_>>, String> {
    let mut rest = line.trim_start();
    let mut pairs = Vec::new();
    while !rest.is_empty() {
        let end = rest.find(|letter: char| letter == '=' || letter.is_whitespace()).unwrap_or(rest.len());
        let (key, after) = rest.split_at(end);
        let Some(after) = after.strip_prefix('=') else {
            pairs.push(Pair { key, value: "" });
            rest = after.trim_start();
            continue;
        };
        let quotes = [('"', '"'), ('\'', '\''), ('{', '}'), ('[', ']')];
        let quoted = quotes.into_iter().find_map(|(open, close)| Some((after.strip_prefix(open)?, close)));
        let (value, after) = match quoted {
            Some((text, close)) => text.split_once(close).ok_or_else(|| {
                let key: String = key.escape_debug().take(40).collect();
                format!("the value of `{key}` has no closing `{close}`")
            })?,
            None => after.split_at(after.find(char::is_whitespace).unwrap_or(after.len())),
        };
        pairs.push(Pair { key, value });
        rest = after.trim_start();
    }
    Ok(pairs)
}
