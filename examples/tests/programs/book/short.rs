//! What makes the commands of the book short, and fit for the machine of the tests.

use super::command::Invocation;

/// The options that this may change: how long a run is, how large, and on which device.
const CHANGED: [&str; 10] = [
    "--adapter",
    "--checkpoint-every",
    "--every",
    "--grains",
    "--jobs",
    "--seeds",
    "--side",
    "--size",
    "--steps",
    "--width",
];

/// The commands that begin with these words get these options, instead of their own values.
pub(crate) struct Short {
    pub(crate) words: &'static str,
    options: &'static str,
    #[expect(dead_code, reason = "for readers")]
    reason: &'static str,
}

const fn short(words: &'static str, options: &'static str, reason: &'static str) -> Short {
    Short { words, options, reason }
}

/// The first that fits is taken.
pub(crate) const SHORT: &[Short] = &[
    short("boltzmann run", "--steps 2", "a long run"),
    short("cadem compare", "--steps 2", "the reference engine is slow"),
    short("cadem resume out/table1 --steps 40000", "--steps 3", "315,979 particles"),
    short("cadem run --case table1", "--steps 1", "315,979 particles"),
    short("cadem run --case published", "--steps 1", "many particles"),
    short("cadem run --engine gpu --adapter 1", "--steps 2 --adapter 0", "the tests have one adapter"),
    short("cadem run", "--steps 2", "a long run"),
    short("cavity run", "--steps 5", "a long run"),
    short("debris run", "--steps 5", "a long run"),
    short("excitable run", "--steps 3", "a long run"),
    short("heat render --view", "--steps 20 --every 10", "a long run"),
    short("heat run", "--steps 10", "a long run"),
    short("ising run", "--steps 3", "a long run"),
    short("landslide compare", "--steps 3", "the reference engine is slow"),
    short("landslide run", "--steps 10", "a long run"),
    short("landslide sweep", "--steps 3", "many runs"),
    short("lava run", "--steps 5", "a long run"),
    short("life run --steps 1000", "--steps 10", "a long run"),
    short("life run --initial", "--steps 10", "a long run"),
    short("pond run", "--steps 10", "a long run"),
    short("predators run", "--steps 3", "a long run"),
    short("reaction run --checkpoint-every 500", "--steps 4 --checkpoint-every 2", "a long run"),
    short("reaction run", "--steps 3", "a long run"),
    short("sandpile run", "--grains 500 --size 31", "a long run"),
    short("wildfire run", "--steps 3", "a long run"),
    short("wildfire sweep", "--steps 3 --seeds 2", "many runs"),
];

impl Short {
    /// That of a command, if it has one.
    pub(crate) fn of(invocation: &Invocation) -> Option<&'static Self> {
        let text = format!("{invocation} ");
        SHORT.iter().find(|short| text.starts_with(&format!("{} ", short.words)))
    }

    /// Sets the options.
    pub(crate) fn apply(&self, invocation: &mut Invocation) {
        let words: Vec<&str> = self.options.split(' ').collect();
        for pair in words.chunks(2) {
            let [option, value] = pair else { panic!("{}: each option has a value", self.options) };
            assert!(CHANGED.contains(option), "{option} may change what a command of the book is about");
            match invocation.words.iter().position(|word| word == option) {
                Some(place) => (*value).clone_into(&mut invocation.words[place + 1]),
                None => invocation.words.extend([*option, *value].map(str::to_owned)),
            }
        }
    }
}
