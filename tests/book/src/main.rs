//! Builds the book: `cargo run -p xca-tests-book`, then open `target/book/index.html`.

use std::error::Error;

fn main() -> Result<(), Box<dyn Error + Send + Sync>> {
    xca_tests_book::build(&xca_tests_book::folder())
}
