//! Buffers larger than a binding: they are bound in pieces, and functions in the code find the piece of a
//! value.
//!
//! All pieces of a buffer but the last have the same length, which the code asks the device for. So the text
//! depends on the number of pieces, not on their size.

use super::Code;
use std::collections::BTreeSet;
use std::fmt::Write as _;

/// Where a piece begins is a multiple of this, so that a binding and a value may begin there.
pub(super) const ALIGNMENT: u64 = 256;

/// The atomic functions of a place and a value.
const ATOMICS: [&str; 4] = ["atomicAdd", "atomicSub", "atomicMin", "atomicMax"];

/// The operators that would both load and store a value.
const COMPOUND: [&str; 10] = ["+=", "-=", "*=", "/=", "%=", "&=", "|=", "^=", "<<=", ">>="];

/// A buffer that is bound in pieces.
struct Cut<'a> {
    name: &'a str,
    /// The type of a value, in the declaration.
    element: &'a str,
    writable: bool,
    count: usize,
}

/// The code with buffer `n` bound in `counts[n]` pieces, one after the other.
///
/// # Errors
/// Where a buffer is used otherwise than value by value.
pub(crate) fn in_pieces(code: &Code, counts: &[usize]) -> Result<Code, String> {
    let mut declarations = String::new();
    let mut body = String::new();
    let mut cuts = Vec::new();
    for line in code.source.lines() {
        let Some((number, declared)) = declaration(line) else {
            // A comment may have the name of a buffer.
            let _ = writeln!(body, "{}", line.split("//").next().unwrap_or_default());
            continue;
        };
        let first: usize = counts.iter().take(number).sum();
        let count = counts.get(number).copied().unwrap_or(1);
        if count == 1 {
            let _ = writeln!(declarations, "@group(0) @binding({first}) {declared}");
        } else {
            cuts.push(Cut::declare(&mut declarations, declared, (first, count))?);
        }
    }
    let mut atomics = BTreeSet::new();
    let body = rewritten(&body, &cuts, &mut atomics)?;
    let functions: Vec<String> = cuts.iter().map(|cut| cut.functions(&atomics)).collect();
    let buffers = code.buffers.iter().zip(counts);
    Ok(Code {
        source: [declarations, body, functions.concat()].concat(),
        buffers: buffers.flat_map(|(access, count)| vec![*access; *count]).collect(),
        ..code.clone()
    })
}

/// The number of a buffer, and its declaration after that.
fn declaration(line: &str) -> Option<(usize, &str)> {
    let (number, declared) = line.strip_prefix("@group(0) @binding(")?.split_once(") ")?;
    Some((number.parse().ok()?, declared))
}

impl<'a> Cut<'a> {
    /// Declares the pieces, numbered from the first.
    fn declare(
        declarations: &mut String,
        declared: &'a str,
        (first, count): (usize, usize),
    ) -> Result<Self, String> {
        let parts = || {
            let (head, type_) = declared.strip_suffix(';')?.split_once(": ")?;
            let (space, name) = head.split_once("> ")?;
            let element = type_.strip_prefix("array<")?.strip_suffix('>')?;
            let writable = match space {
                "var<storage, read" => false,
                "var<storage, read_write" => true,
                _ => return None,
            };
            Some((space, type_, Self { name, element, writable, count }))
        };
        let (space, type_, cut) = parts().ok_or_else(|| format!("`{declared}` is no array"))?;
        for piece in 0..count {
            let (name, number) = (cut.piece(piece), first + piece);
            let _ = writeln!(declarations, "@group(0) @binding({number}) {space}> {name}: {type_};");
        }
        Ok(cut)
    }

    fn piece(&self, number: usize) -> String {
        format!("piece_{number}_of_{}", self.name)
    }

    /// The functions that stand for its uses.
    fn functions(&self, atomics: &BTreeSet<(String, &str)>) -> String {
        let Self { name, element, count, .. } = self;
        let last = count - 1;
        let [length, rest] = [0, last].map(|piece| format!("arrayLength(&{})", self.piece(piece)));
        let length = format!("{last}u * {length} + {rest}");
        let mut text = format!("fn length_of_{name}() -> u32 {{\n    return {length};\n}}\n");
        let Some(value) = element.strip_prefix("atomic<").and_then(|rest| rest.strip_suffix('>')) else {
            text += &self.function(&format!("load_{name}(place: u32) -> {element}"), |place| {
                format!("return {place};")
            });
            if self.writable {
                text += &self.function(&format!("store_{name}(place: u32, value: {element})"), |place| {
                    format!("{place} = value; return;")
                });
            }
            return text;
        };
        for (atomic, _) in atomics.iter().filter(|(_, of)| of == name) {
            let head = format!("{atomic}_of_{name}(place: u32, value: {value}) -> {value}");
            text += &self.function(&head, |place| format!("return {atomic}(&{place}, value);"));
        }
        text
    }

    /// A function that does something at a place, in the piece that the place lies in.
    fn function(&self, head: &str, at: impl Fn(&str) -> String) -> String {
        let mut text = format!("fn {head} {{\n    let length = arrayLength(&{});\n", self.piece(0));
        let last = self.count - 1;
        for number in 0..last {
            let there = at(&format!("{}[place - {number}u * length]", self.piece(number)));
            let _ = writeln!(text, "    if place < {}u * length {{\n        {there}\n    }}", number + 1);
        }
        let there = at(&format!("{}[place - {last}u * length]", self.piece(last)));
        let _ = writeln!(text, "    {there}\n}}");
        text
    }
}

/// The text with calls in place of the uses of buffers that are cut. Notes the atomic functions that are
/// called, with their buffers.
fn rewritten<'a>(
    text: &str,
    cuts: &[Cut<'a>],
    atomics: &mut BTreeSet<(String, &'a str)>,
) -> Result<String, String> {
    let mut out = String::new();
    let mut rest = text;
    while let Some((start, cut)) = next_use(rest, cuts) {
        let name = cut.name;
        out.push_str(&rest[..start]);
        rest = &rest[start + name.len()..];
        if out.ends_with("arrayLength(&") {
            out.truncate(out.len() - "arrayLength(&".len());
            let _ = write!(out, "length_of_{name}(");
            continue;
        }
        let (place, after) = bracketed(rest).ok_or_else(|| format!("`{name}` is used as a whole"))?;
        let place = rewritten(place, cuts, atomics)?;
        rest = after;
        if out.ends_with("(&") {
            out.truncate(out.len() - "(&".len());
            let begin = out.rfind(|c| !is_of_word(c)).map_or(0, |before| before + 1);
            let atomic = out[begin..].to_owned();
            if !ATOMICS.contains(&&*atomic) {
                return Err(format!("`{atomic}` of `{name}`"));
            }
            let _ = write!(out, "_of_{name}({place}");
            atomics.insert((atomic, name));
            continue;
        }
        let follows = rest.trim_start();
        if COMPOUND.iter().any(|operator| follows.starts_with(operator)) {
            return Err(format!("a value of `{name}` is loaded and stored at once"));
        }
        let assigned = follows.strip_prefix('=').filter(|value| !value.starts_with('='));
        if let Some((value, after)) = assigned.and_then(|value| value.split_once(';')) {
            let value = rewritten(value.trim_start(), cuts, atomics)?;
            let _ = write!(out, "store_{name}({place}, {value});");
            rest = after;
        } else {
            let _ = write!(out, "load_{name}({place})");
        }
    }
    out.push_str(rest);
    Ok(out)
}

/// Where the next use of a buffer begins.
fn next_use<'c, 'a>(text: &str, cuts: &'c [Cut<'a>]) -> Option<(usize, &'c Cut<'a>)> {
    let mut at = 0;
    while let Some(start) = text[at..].find(is_of_word).map(|start| at + start) {
        let end = text[start..].find(|c| !is_of_word(c)).map_or(text.len(), |length| start + length);
        let is_field = text[..start].ends_with('.') || text[end..].starts_with(':');
        if let Some(cut) = cuts.iter().find(|cut| cut.name == &text[start..end] && !is_field) {
            return Some((start, cut));
        }
        at = end;
    }
    None
}

fn is_of_word(c: char) -> bool {
    c == '_' || c.is_alphanumeric()
}

/// What stands in the brackets that the text begins with, and what follows them.
fn bracketed(text: &str) -> Option<(&str, &str)> {
    let inner = text.strip_prefix('[')?;
    let mut depth = 1;
    for (at, c) in inner.char_indices() {
        match c {
            '[' => depth += 1,
            ']' => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return Some((&inner[..at], &inner[at + 1..]));
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::device::Access;

    fn code(body: &str) -> Code {
        let source = format!(
            "struct Journal {{ order: u32 }}
@group(0) @binding(0) var<uniform> journal: Journal;
@group(0) @binding(1) var<storage, read> items: array<u32>;
@group(0) @binding(2) var<storage, read_write> order: array<u32>;
@group(0) @binding(3) var<storage, read_write> arrivals: array<atomic<u32>>;
// In any order.
@compute @workgroup_size(1)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {{
    let item = id.x;
    {body}
}}
"
        );
        Code {
            name: "a test".to_owned(),
            source,
            workgroup: [1; 3],
            buffers: vec![Access::Uniform, Access::Read, Access::Write, Access::Write],
            strict: None,
            watched: None,
        }
    }

    fn rewritten(body: &str, counts: [usize; 4]) -> Result<String, String> {
        let code = in_pieces(&code(body), &counts)?;
        assert_eq!(code.buffers.len(), counts.iter().sum::<usize>());
        naga::front::wgsl::parse_str(&code.source).map_err(|error| error.emit_to_string(&code.source))?;
        Ok(code.source)
    }

    #[test]
    fn uses_become_calls() {
        for (body, wanted) in [
            ("order[item] = items[order[item]];", "store_order(item, load_items(load_order(item)));"),
            (
                "order[0] = atomicAdd(&arrivals[order[1]], 1u);",
                "store_order(0, atomicAdd_of_arrivals(load_order(1), 1u));",
            ),
            (
                "if order[item] == items[item] { order[item] = 1u; }",
                "if load_order(item) == load_items(item) { store_order(item, 1u); }",
            ),
            (
                "let length = arrayLength(&items) + journal.order;",
                "let length = length_of_items() + journal.order;",
            ),
            (
                "let changed = items[item] != order[item];",
                "let changed = load_items(item) != load_order(item);",
            ),
        ] {
            let text = rewritten(body, [1, 3, 2, 2]).unwrap();
            assert!(text.contains(wanted), "{text}");
        }
        let text = rewritten("order[item] = items[item];", [1, 2, 1, 1]).unwrap();
        assert!(text.contains("order[item] = load_items(item);"), "{text}");
        assert!(text.contains("@binding(3) var<storage, read_write> order: array<u32>;"), "{text}");
        // The second piece begins where the first ends.
        assert!(text.contains("return piece_1_of_items[place - 1u * length];"), "{text}");
    }

    #[test]
    fn what_is_not_value_by_value_is_refused() {
        for body in [
            "order[item] += 1u;",
            "let all = &order;",
            "atomicStore(&arrivals[item], 1u);",
            "order[item] <<= 1u;",
        ] {
            assert!(in_pieces(&code(body), &[1, 2, 2, 2]).is_err(), "{body}");
        }
        assert!(in_pieces(&code(""), &[2, 1, 1, 1]).is_err());
    }
}
