//! Whether and when neighbour lists are made. The times of passes decide, and change no result.

use crate::layout::Layout;
use crate::listing::make;
use crate::lists::Room;
use crate::motion::Motion;
use crate::population::Population;
use std::time::{Duration, Instant};
use xca_core::Geometry;
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

    /// Learns from the cost of lists that have become too old.
    fn learn(&mut self) {
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

/// Keeps the lists of a population usable for the next pass, or removes them. Returns the largest radius for
/// which searches can use them.
pub(crate) fn keep_lists(
    population: &mut Population,
    layout: &Layout,
    geometry: &Geometry,
    room: &Room,
    motion: &mut Motion,
) -> Option<f64> {
    let widest = population.upkeep.widest;
    if widest <= 0.0 {
        return None;
    }
    if let Some(lists) = &population.lists {
        let radius = lists.radius(motion, room);
        if radius >= widest {
            return Some(radius);
        }
        population.upkeep.learn();
    }
    let within = (widest * (1.0 + population.upkeep.skin)).min(room.widest);
    let useful = within - room.rounding > widest;
    let few = population.count() < FEWEST_ITEMS && !population.upkeep.fixed;
    if population.upkeep.pause > 0 || !useful || few {
        population.upkeep.pause = population.upkeep.pause.saturating_sub(1);
        population.forget_lists();
        return None;
    }
    let start = Instant::now();
    population.lists = None;
    let listed = make(population, layout, geometry, within + room.rounding);
    let kept = population.keep_lists(layout, &listed, within);
    *motion = Motion { square: 0.0, ..*motion };
    let items = population.count() as u64;
    let candidates = population.lists.as_ref().map_or(0, |lists| lists.candidates.len());
    let upkeep = &mut population.upkeep;
    upkeep.life = Life { passes: 0, spent: start.elapsed() };
    upkeep.widest = 0.0;
    upkeep.figures.made += 1;
    upkeep.figures.items += items;
    upkeep.figures.candidates += candidates as u64;
    upkeep.figures.skin = within - widest;
    kept.then_some(within - room.rounding)
}
