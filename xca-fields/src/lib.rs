//! What the fields of structs of substates and parameters say: their types and attributes.

mod attributes;
mod words;

pub use attributes::{About, Wanted, documentation};
pub use words::{check_type, is_position, is_value_type, marked, may_be_states, meant, with_real};
