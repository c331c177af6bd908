//! What makes the commands of the book short, and fit for a machine of tests.

use super::command::Invocation;

/// The options that this may change: how long a run is, how large, and on which device.
const CHANGED: [&str; 9] = [
    "--adapter",
    "--checkpoint-every",
    "--every",
    "--grains",
    "--seeds",
    "--side",
    "--size",
    "--steps",
    "--width",
];

/// The commands that begin with these words get these options. A smaller number in the command stays.
pub(crate) struct Short {
    pub(crate) words: &'static str,
    options: &'static str,
    pub(crate) reason: &'static str,
}

const fn short(words: &'static str, options: &'static str, reason: &'static str) -> Short {
    Short { words, options, reason }
}

const LONG: &str = "it does hundreds of steps or more";
const LARGE: &str = "it has 315,979 particles";
const MANY: &str = "it does up to 200 runs";

/// The first that fits is taken.
pub(crate) const SHORT: &[Short] = &[
    short("boltzmann run", "--steps 2", LONG),
    short("cadem compare", "--steps 2", LONG),
    short("cadem resume out/table1 --steps", "--steps 3", LARGE),
    short("cadem run --case table1", "--side 30 --steps 2", LARGE),
    short("cadem run --engine gpu --adapter 1", "--adapter 0 --steps 2", "the tests need one adapter only"),
    short("cadem run", "--steps 2", LONG),
    short("cavity run", "--steps 5", LONG),
    short("debris run", "--steps 2", LONG),
    short("elementary run", "--steps 60 --width 80", LONG),
    short("excitable run", "--steps 3", LONG),
    short("heat render --view", "--every 10 --steps 20", LONG),
    short("heat run --every 20", "--every 2 --steps 4", LONG),
    short("heat run", "--steps 2", LONG),
    short("ising run", "--steps 3", LONG),
    short("landslide compare", "--steps 3", LONG),
    short("landslide run", "--steps 3", LONG),
    short("landslide sweep", "--steps 3", MANY),
    short("lava run", "--steps 3", LONG),
    short("life run", "--steps 10", LONG),
    short("pond run", "--steps 20", LONG),
    short("predators run", "--steps 1", LONG),
    short("reaction run --checkpoint-every", "--checkpoint-every 2 --steps 4", LONG),
    short("reaction run", "--steps 3", LONG),
    short("sandpile run", "--grains 500 --size 31", LONG),
    short("wildfire run", "--steps 3", LONG),
    short("wildfire sweep", "--seeds 2 --steps 3", MANY),
];

impl Short {
    /// That of a command, if it has one.
    pub(crate) fn of(invocation: &Invocation) -> Option<&'static Self> {
        let text = format!("{invocation} ");
        SHORT.iter().find(|short| text.starts_with(short.words))
    }

    /// Sets the options.
    pub(crate) fn apply(&self, invocation: &mut Invocation) {
        let words: Vec<&str> = self.options.split(' ').collect();
        for pair in words.chunks(2) {
            let [option, value] = pair else { panic!("{}: each option has a value", self.options) };
            assert!(CHANGED.contains(option), "{option} may change what a command of the book is about");
            let Some(place) = invocation.words.iter().position(|word| word == option) else {
                invocation.words.extend([*option, *value].map(str::to_owned));
                continue;
            };
            let Some(written) = invocation.words.get_mut(place + 1) else { continue };
            let [before, after] = [written.as_str(), value].map(|text| text.parse().unwrap_or(u64::MAX));
            if before > after {
                (*value).clone_into(written);
            }
        }
    }
}

#[test]
fn an_option_is_set_or_added_or_stays() {
    let short = short("life run", "--steps 10 --every 5", LONG);
    for (before, after) in [
        ("run", "run --steps 10 --every 5"),
        ("run --every 20 --steps 1000", "run --every 5 --steps 10"),
        ("run --steps 0 --out here", "run --steps 0 --out here --every 5"),
    ] {
        let words = before.split(' ').map(str::to_owned).collect();
        let mut invocation = Invocation { program: "life".to_owned(), words };
        short.apply(&mut invocation);
        assert_eq!(invocation.to_string(), format!("life {after}"));
    }
}
