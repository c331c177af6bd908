//! What can be chosen of an engine, and what was.

use std::collections::BTreeMap;

/// Something that can be chosen of an engine: an option of the command line.
#[derive(Debug, Clone, Copy)]
pub struct EngineOption {
    /// The name of the option, such as `threads` of `--threads`.
    pub name: &'static str,
    /// What stands for its value in help: `N`.
    pub value_name: &'static str,
    /// A sentence without a full stop, for help.
    pub about: &'static str,
    /// Says what is wrong with a value.
    pub check: fn(&str) -> Result<(), String>,
}

/// What was chosen of an engine; the rest is the engine's own choice.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct EngineOptions {
    values: BTreeMap<String, String>,
}

impl EngineOptions {
    /// The same, with the value of an option.
    #[must_use]
    pub fn with(mut self, option: impl Into<String>, value: impl Into<String>) -> Self {
        self.values.insert(option.into(), value.into());
        self
    }

    /// The value of an option, if one was chosen.
    pub fn get(&self, option: &str) -> Option<&str> {
        self.values.get(option).map(String::as_str)
    }

    /// All options that were chosen, with their values, by name.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &str)> {
        self.values.iter().map(|(option, value)| (option.as_str(), value.as_str()))
    }

    /// These options, and of others those that are not among them.
    #[must_use]
    pub fn or(mut self, others: &Self) -> Self {
        for (option, value) in others.iter() {
            self.values.entry(option.to_owned()).or_insert_with(|| value.to_owned());
        }
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_chosen_wins() {
        let own = EngineOptions::default().with("threads", "2");
        let both = own.or(&EngineOptions::default().with("threads", "3").with("adapter", "1"));
        assert_eq!(both.iter().collect::<Vec<_>>(), [("adapter", "1"), ("threads", "2")]);
        assert_eq!((both.get("threads"), both.get("arithmetic")), (Some("2"), None));
    }
}
