//! Animations of pictures.
//!
//! | function | file | for |
//! |---|---|---|
//! | [`write_apng`] | animated PNG | browsers; every other program shows the first picture |
//! | [`write_gif`] | animated GIF | nearly every program; at most 256 colours |
//!
//! Both play in an endless loop, and store only the changes from one picture to the next.

mod apng;
mod film;
mod gif;
mod palette;

pub use apng::write_apng;
pub use gif::write_gif;

#[cfg(test)]
mod tests;
