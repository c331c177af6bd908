//! The methods that numbers, vectors and arrays have in an elementary process.
//!
//! This list is the only one: the macros accept the methods in it, say in their messages what it says, and
//! write calls of the functions that it names; shaders are written from it; the tables of the documentation
//! are those of [`table`].
//!
//! A method is either an [`Operation`], which each engine has for each type of number, or a function of
//! `xca_core::math`, which is written once, for `Real`.

mod list;
mod method;

pub use list::METHODS;
pub use method::{Meaning, Method, Operation, Outcome, Receiver};

/// The methods as rows of a Markdown table, one for each kind of receiver.
pub fn table() -> Vec<String> {
    let row = |receiver: Receiver| {
        let methods: Vec<String> = METHODS
            .iter()
            .filter(|method| method.receiver == receiver)
            .map(|method| format!("`{}`", method.usage()))
            .collect();
        format!("| {} | {} |", receiver.words(), methods.join(", "))
    };
    Receiver::ALL.into_iter().map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::{METHODS, Meaning, Method, Receiver, table};

    #[test]
    fn each_name_and_each_meaning_stands_once() {
        for (number, method) in METHODS.iter().enumerate() {
            let others = METHODS.iter().enumerate().filter(|(other, _)| *other != number);
            for (_, other) in others {
                assert_ne!(method.name, other.name);
                assert_ne!(method.meaning, other.meaning, "{}", method.name);
            }
            assert_eq!(Method::named(method.name), Some(method));
            if let Meaning::Operation(operation) = method.meaning {
                assert_eq!(operation.method(), Some(method));
            }
        }
        assert_eq!(Method::named("mul_add"), None);
    }

    #[test]
    fn each_method_stands_in_the_table_once() {
        let text = table().join("\n");
        assert_eq!(Receiver::ALL.len(), text.lines().count());
        for method in METHODS {
            assert_eq!(text.matches(&format!("`{}`", method.usage())).count(), 1, "{}", method.name);
        }
    }
}
