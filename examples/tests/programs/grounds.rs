//! Maps that lie somewhere and end somewhere: the place of a run, and cells without ground in all that it
//! writes.

mod island;
mod outputs;
mod pictures;
mod places;
