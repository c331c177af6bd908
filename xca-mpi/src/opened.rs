//! What a process says of the engine of its part, as text that every build on every machine can read.

use xca_core::Engine;

/// The engine of a part.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Opened {
    pub(crate) threads: usize,
    /// The entries of a report: names and values.
    facts: Vec<(String, String)>,
}

/// The name of the reason of a process that has no engine.
const DECLINED: &str = "declined";
const THREADS: &str = "threads";

impl Opened {
    pub(crate) fn new(engine: &dyn Engine) -> Self {
        let facts = engine.facts().into_iter().map(|(name, value)| (name.to_owned(), one_line(&value)));
        Self { threads: engine.threads(), facts: facts.collect() }
    }

    pub(crate) fn bytes(&self) -> Vec<u8> {
        let facts = self.facts.iter().map(|(name, value)| format!("{name}={value}\n"));
        format!("{THREADS}={}\n{}", self.threads, facts.collect::<String>()).into_bytes()
    }

    /// Of a process that has no engine.
    pub(crate) fn declined(reason: &str) -> Vec<u8> {
        format!("{DECLINED}={}\n", one_line(reason)).into_bytes()
    }

    /// Why a process has no engine, where it has none.
    pub(crate) fn from_bytes(bytes: &[u8]) -> Result<Self, String> {
        let garbled = || "it says what this build does not understand".to_owned();
        let text = str::from_utf8(bytes).map_err(|_| garbled())?;
        let mut facts = text.lines().filter_map(|line| line.split_once('='));
        match facts.next() {
            Some((DECLINED, reason)) => Err(reason.to_owned()),
            Some((THREADS, number)) => Ok(Self {
                threads: number.parse().map_err(|_| garbled())?,
                facts: facts.map(|(name, value)| (name.to_owned(), value.to_owned())).collect(),
            }),
            _ => Err(garbled()),
        }
    }

    /// Those of these entries that it has.
    pub(crate) fn facts(&self, names: &[&'static str]) -> Vec<(&'static str, String)> {
        let value =
            |name: &str| self.facts.iter().find(|(own, _)| own == name).map(|(_, value)| value.clone());
        names.iter().filter_map(|name| Some((*name, value(name)?))).collect()
    }
}

fn one_line(text: &str) -> String {
    text.replace('\n', "; ")
}

#[cfg(test)]
mod tests {
    use super::Opened;

    #[test]
    fn engines_are_told_as_they_are() {
        let facts = vec![("adapter".to_owned(), "a=b".to_owned()), ("kind".to_owned(), String::new())];
        let opened = Opened { threads: 3, facts };
        assert_eq!(Opened::from_bytes(&opened.bytes()), Ok(opened.clone()));
        assert_eq!(opened.facts(&["driver", "adapter"]), [("adapter", "a=b".to_owned())]);
        assert_eq!(Opened::from_bytes(&Opened::declined("no\ndriver")), Err("no; driver".to_owned()));
        for bytes in [&b"threads=x"[..], b"", b"\xff", b"adapter=a"] {
            assert!(Opened::from_bytes(bytes).is_err_and(|reason| reason.contains("does not understand")));
        }
    }
}
