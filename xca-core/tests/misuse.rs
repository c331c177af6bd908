//! What scientists may write by mistake, and what the compiler then tells them.
//!
//! Each file of `tests/misuse` has its messages beside it. After a change of the messages read them all again
//! as the user would: `TRYBUILD=overwrite cargo test -p xca-core --test misuse` writes them anew.

#[test]
fn mistakes_are_explained_where_they_stand() {
    trybuild::TestCases::new().compile_fail("tests/misuse/*.rs");
}
