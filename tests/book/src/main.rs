//! Builds the book: `cargo run -p xca-tests-book`, then open `target/book/index.html`.

use std::process::ExitCode;

fn main() -> ExitCode {
    match xca_tests_book::build(&xca_tests_book::folder()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}
