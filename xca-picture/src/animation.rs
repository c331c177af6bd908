//! Pictures in motion.
//!
//! | function | file | for |
//! |---|---|---|
//! | [`write_apng`] | animated PNG | browsers; every other program shows the first picture |
//! | [`write_gif`] | animated GIF | nearly every program; it has 256 colours at most |
//!
//! Both are played for ever, and store only what changes from one picture to the next.

mod apng;
mod film;
mod gif;
mod palette;

pub use apng::write_apng;
pub use gif::write_gif;

#[cfg(test)]
mod tests;
