//! The pages of the book, and the commands that they show.

use super::command::{Command, is_command, root};
use std::fs;

/// The commands of a page, in its order.
pub(crate) struct Page {
    pub(crate) commands: Vec<Command>,
}

impl Page {
    /// README.md, then the pages of docs/SUMMARY.md.
    pub(crate) fn all() -> Vec<Self> {
        let summary = fs::read_to_string(root().join("docs/SUMMARY.md")).unwrap();
        let links = summary.split("](").skip(1).map(|rest| rest.split(')').next().unwrap());
        let names = links.map(|link| format!("docs/{link}"));
        std::iter::once("README.md".to_owned()).chain(names).map(|name| Self::read(&name)).collect()
    }

    fn read(name: &str) -> Self {
        let text = fs::read_to_string(root().join(name)).unwrap();
        let commands = commands(&text).into_iter().map(|(line, text)| Command::read(name, line, &text));
        Self { commands: commands.collect() }
    }
}

/// The commands of a text in Markdown, each with the number of the line on which it begins.
fn commands(text: &str) -> Vec<(usize, String)> {
    let mut found = Vec::new();
    let mut lines = text.lines().enumerate().map(|(index, line)| (index + 1, line)).peekable();
    while let Some((number, line)) = lines.next() {
        let is_part_of_prose = |line: &str| !line.trim().is_empty() && !line.trim_start().starts_with("```");
        if let Some(tag) = line.trim_start().strip_prefix("```") {
            let block: Vec<_> =
                lines.by_ref().take_while(|(_, line)| !line.trim_start().starts_with("```")).collect();
            if ["", "bash", "console", "sh", "shell"].contains(&tag.trim()) {
                found.extend(of_block(&block));
            }
        } else if is_part_of_prose(line) {
            // Code in a paragraph may go on in the next line.
            let mut paragraph = vec![(number, line)];
            while let Some(next) = lines.next_if(|(_, line)| is_part_of_prose(line)) {
                paragraph.push(next);
            }
            found.extend(of_paragraph(&paragraph));
        }
    }
    found
}

/// Each line of a block. If some lines have a prompt, the others are output.
fn of_block(block: &[(usize, &str)]) -> Vec<(usize, String)> {
    let has_prompts = block.iter().any(|(_, line)| line.starts_with("$ "));
    let mut found: Vec<(usize, String)> = Vec::new();
    let mut goes_on = false;
    for &(number, line) in block {
        let text = without_comment(line).trim();
        let (part, is_continued) = match text.strip_suffix('\\') {
            Some(part) => (part.trim_end(), true),
            None => (text, false),
        };
        match found.last_mut() {
            Some((_, command)) if goes_on => {
                command.push(' ');
                command.push_str(part);
            }
            _ if has_prompts => {
                let Some(part) = part.strip_prefix("$ ") else { continue };
                found.push((number, part.to_owned()));
            }
            _ if part.is_empty() => continue,
            _ => found.push((number, part.to_owned())),
        }
        goes_on = is_continued;
    }
    found
}

/// A line without what follows a `#` outside of quotes.
fn without_comment(line: &str) -> &str {
    let mut quote = None;
    let mut before = ' ';
    for (place, sign) in line.char_indices() {
        match quote {
            Some(open) if sign == open => quote = None,
            Some(_) => {}
            None if sign == '#' && before == ' ' => return &line[..place],
            None if ['\'', '"'].contains(&sign) => quote = Some(sign),
            None => {}
        }
        before = sign;
    }
    line
}

/// The commands between backticks.
fn of_paragraph(paragraph: &[(usize, &str)]) -> Vec<(usize, String)> {
    let mut found = Vec::new();
    let mut code: Option<(usize, String)> = None;
    for &(number, line) in paragraph {
        for (index, piece) in line.split('`').enumerate() {
            if index > 0 {
                code = match code.take() {
                    None => Some((number, String::new())),
                    Some(whole) => {
                        found.push(whole);
                        None
                    }
                };
            }
            if let Some((_, text)) = &mut code {
                text.push_str(piece);
            }
        }
        if let Some((_, text)) = &mut code {
            text.push(' ');
        }
    }
    found.retain(|(_, text)| is_command(text));
    found
}

#[test]
fn commands_of_a_page_are_found() {
    let text = "\
# A page

Type `cargo run --release` or `life run
--steps 3`, not `run DIR`, `life`, or `mpirun …`.

```sh
life run   # no comment
# a comment
heat run --set 'a#b=1' \\
    --steps 4
```

```text
life run --of-text
```

```
$ cargo test
output
```

`heat list` is last.
";
    let found = commands(text);
    let texts: Vec<(usize, &str)> = found.iter().map(|(number, text)| (*number, text.as_str())).collect();
    assert_eq!(
        texts,
        [
            (3, "cargo run --release"),
            (3, "life run --steps 3"),
            (7, "life run"),
            (9, "heat run --set 'a#b=1' --steps 4"),
            (18, "cargo test"),
            (22, "heat list"),
        ]
    );
}
