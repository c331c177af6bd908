//! Whether and when neighbour lists are made. The times of passes decide, and change no result.

use crate::lists::Room;
use std::time::Duration;
use xca_core::engine::Figure;

/// The least number of items for which lists pay.
const FEWEST_ITEMS: usize = 64;

/// The least number of passes that lists must last to pay.
const SHORTEST_LIFE: u64 = 2;

/// The numbers of passes without lists after they did not pay: the first time, and at most.
const PAUSES: [u64; 2] = [8, 512];

/// The first skin, in radii.
const FIRST_SKIN: f64 = 0.4;

/// The smallest and the largest skin, in radii.
const SKINS: [f64; 2] = [0.01, 1.0];

/// The factor by which the skin changes from lists to lists.
const CHANGE: f64 = 1.25;

/// Decides whether and when lists are made.
pub(crate) struct Upkeep {
    /// The largest search radius since lists were last made, in metres.
    widest: f64,
    /// The skin, in radii.
    skin: f64,
    /// Whether the skin is fixed.
    fixed: bool,
    /// Whether the last change of the skin was an increase.
    grew: bool,
    /// The time of a pass with the previous lists, including their construction.
    before: Option<Duration>,
    /// The time of a pass without lists.
    without: Option<Duration>,
    /// The number of remaining passes without lists, then that of the next pause.
    pause: u64,
    next_pause: u64,
    life: Life,
    figures: Figures,
}

/// The passes with the same lists.
#[derive(Default)]
struct Life {
    passes: u64,
    /// The time for the construction of the lists and for the passes.
    spent: Duration,
}

/// The figures for reports.
#[derive(Debug, Default, Clone, Copy, PartialEq)]
pub(crate) struct Figures {
    /// The number of passes in which a process searched.
    pub(crate) passes: u64,
    /// The number of these with lists.
    pub(crate) listed: u64,
    /// The number of times that lists were made.
    pub(crate) made: u64,
    /// The total number of list entries at construction, then that of items.
    pub(crate) candidates: u64,
    pub(crate) items: u64,
    /// The skin of the last lists, in metres.
    pub(crate) skin: f64,
}

impl Upkeep {
    /// With a fixed skin in radii, or with a skin that adapts.
    pub(crate) fn new(skin: Option<f64>) -> Self {
        Self {
            widest: 0.0,
            skin: skin.unwrap_or(FIRST_SKIN),
            fixed: skin.is_some(),
            grew: false,
            before: None,
            without: None,
            pause: 0,
            next_pause: PAUSES[0],
            life: Life::default(),
            figures: Figures::default(),
        }
    }

    pub(crate) fn figures(&self) -> Figures {
        self.figures
    }

    /// Records a pass that searched, with its largest radius and its time.
    pub(crate) fn searched(&mut self, widest: f64, listed: bool, time: Duration) {
        self.widest = self.widest.max(widest);
        self.figures.passes += 1;
        if listed {
            self.figures.listed += 1;
            self.life.passes += 1;
            self.life.spent += time;
        } else {
            self.without = Some(self.without.map_or(time, |before| before.min(time)));
        }
    }

    /// The largest search radius since lists were last made, in metres.
    pub(crate) fn widest(&self) -> f64 {
        self.widest
    }

    /// The radius of new lists for so many items, in metres. `None` if lists would not pay in the next pass.
    pub(crate) fn next_radius(&mut self, items: usize, room: &Room) -> Option<f64> {
        let within = (self.widest * (1.0 + self.skin)).min(room.widest);
        let useful = within - room.rounding > self.widest;
        let few = items < FEWEST_ITEMS && !self.fixed;
        if self.pause > 0 || !useful || few {
            self.pause = self.pause.saturating_sub(1);
            return None;
        }
        Some(within)
    }

    /// Records lists of this radius in metres, the time of their construction and their entries.
    pub(crate) fn made(&mut self, within: f64, spent: Duration, items: usize, candidates: usize) {
        self.life = Life { passes: 0, spent };
        self.figures.made += 1;
        self.figures.items += items as u64;
        self.figures.candidates += candidates as u64;
        self.figures.skin = within - self.widest;
        self.widest = 0.0;
    }

    /// Learns from the cost of lists that have become too old.
    pub(crate) fn learn(&mut self) {
        let Life { passes, spent } = std::mem::take(&mut self.life);
        if self.fixed {
            return;
        }
        let cost = spent.checked_div(u32::try_from(passes).unwrap_or(u32::MAX));
        if passes < SHORTEST_LIFE || self.without.zip(cost).is_none_or(|(without, cost)| cost > without) {
            self.pause = self.next_pause;
            self.next_pause = (2 * self.next_pause).min(PAUSES[1]);
            self.before = None;
            return;
        }
        self.next_pause = PAUSES[0];
        // Descend: continue in the same direction while the cost falls, turn back if it rises.
        if self.before.zip(cost).is_some_and(|(before, cost)| cost > before) {
            self.grew = !self.grew;
        }
        self.before = cost;
        let skin = if self.grew { self.skin * CHANGE } else { self.skin / CHANGE };
        self.skin = skin.clamp(SKINS[0], SKINS[1]);
    }
}

impl Figures {
    /// The figures with the name of the population. Empty if nothing was searched.
    pub(crate) fn named(&self, population: &str) -> Vec<Figure> {
        if self.passes == 0 {
            return Vec::new();
        }
        let all = [
            ("searching_passes", self.passes as f64),
            ("passes_with_lists", self.listed as f64),
            ("lists_made", self.made as f64),
            ("candidates_per_item", self.candidates as f64 / self.items.max(1) as f64),
            ("skin_metres", self.skin),
        ];
        let name = population.to_lowercase();
        all.into_iter().map(|(figure, value)| Figure { name: format!("{name}_{figure}"), value }).collect()
    }
}
