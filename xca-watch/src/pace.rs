//! How fast a run is shown.

use std::time::Duration;
use xca_io::numbers::{counted, significant};

/// Steps from picture to picture, and pictures a second.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Pace {
    every: u64,
    /// Pictures a second are halved so many times.
    slowed: u32,
    full: u16,
}

/// How many times pictures a second are halved at most.
const SLOWEST: u32 = 5;
/// The most steps from picture to picture.
const FASTEST: u64 = 1_000_000_000;

impl Pace {
    pub(super) fn new(every: u64, pictures_a_second: u16) -> Self {
        Self { every: every.clamp(1, FASTEST), slowed: 0, full: pictures_a_second.max(1) }
    }

    /// The steps from picture to picture.
    pub(super) fn every(self) -> u64 {
        self.every
    }

    /// The time from picture to picture.
    pub(super) fn interval(self) -> Duration {
        Duration::from_secs(1) * 2_u32.pow(self.slowed) / u32::from(self.full)
    }

    pub(super) fn faster(&mut self) {
        if self.slowed > 0 {
            self.slowed -= 1;
        } else {
            self.every = round_numbers().find(|every| *every > self.every).unwrap_or(FASTEST);
        }
    }

    pub(super) fn slower(&mut self) {
        if self.every == 1 {
            self.slowed = (self.slowed + 1).min(SLOWEST);
        } else {
            self.every = round_numbers().take_while(|every| *every < self.every).last().unwrap_or(1);
        }
    }

    /// The pace for people.
    pub(super) fn words(self) -> String {
        let steps = counted(self.every, "step");
        if self.slowed == 0 {
            format!("{steps} a picture")
        } else {
            let rate = f64::from(self.full) / f64::from(2_u32.pow(self.slowed));
            format!("{steps} a picture, {} pictures/s", significant(rate, 2))
        }
    }
}

/// 1, 2, 5, 10, 20, …
fn round_numbers() -> impl Iterator<Item = u64> {
    (0..=9).flat_map(|power| [1, 2, 5].map(|digit| digit * 10_u64.pow(power))).filter(|n| *n <= FASTEST)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pace_goes_through_round_numbers() {
        let mut pace = Pace::new(7, 20);
        let mut shown = Vec::new();
        for _ in 0..5 {
            pace.slower();
            shown.push(pace.words());
        }
        assert_eq!(
            shown,
            [
                "5 steps a picture",
                "2 steps a picture",
                "1 step a picture",
                "1 step a picture, 10 pictures/s",
                "1 step a picture, 5 pictures/s"
            ]
        );
        assert_eq!(pace.interval(), Duration::from_millis(200));
        for _ in 0..3 {
            pace.faster();
        }
        assert_eq!((pace.every(), pace.interval()), (2, Duration::from_millis(50)));
    }

    #[test]
    fn a_pace_has_ends() {
        let mut pace = Pace::new(0, 0);
        for _ in 0..100 {
            pace.faster();
        }
        assert_eq!(pace.every(), FASTEST);
        for _ in 0..200 {
            pace.slower();
        }
        assert_eq!((pace.every(), pace.interval()), (1, Duration::from_secs(32)));
    }
}
