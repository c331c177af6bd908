//! Bounds of parts along one axis.
//!
//! Part `n` has the rows from bound `n` to below bound `n + 1`. The first bound is 0, the last one the number
//! of rows.

/// Bounds that distribute the rows evenly.
pub(crate) fn even(rows: usize, parts: usize) -> Vec<usize> {
    (0..=parts).map(|part| rows * part / parts.max(1)).collect()
}

/// Bounds that distribute the work: the largest work of a part is the least possible.
///
/// Each of the `columns` has the work of each row in one part of the other axis. No part is thinner than
/// `thinnest` rows, which must leave room for all parts. Without room, the bounds are even.
pub(crate) fn balanced(columns: &[Vec<u64>], parts: usize, thinnest: usize) -> Vec<usize> {
    let slabs = Slabs::new(columns, parts, thinnest);
    let (mut enough, mut too_little) = (slabs.largest(0, slabs.rows), None);
    // The least limit that a cut can keep lies above `too_little`, and is at most `enough`.
    while too_little.map_or(0, |least: u64| least + 1) < enough {
        let below = too_little.map_or(0, |least: u64| least + 1);
        let limit = below + (enough - below) / 2;
        if slabs.ends(limit).is_some() {
            enough = limit;
        } else {
            too_little = Some(limit);
        }
    }
    slabs.bounds(enough).unwrap_or_else(|| even(slabs.rows, parts))
}

/// The work of slabs: of ranges of rows.
struct Slabs {
    /// For each column the work below each row.
    below: Vec<Vec<u64>>,
    rows: usize,
    parts: usize,
    thinnest: usize,
}

impl Slabs {
    fn new(columns: &[Vec<u64>], parts: usize, thinnest: usize) -> Self {
        let below = columns.iter().map(|column| {
            let sums = column.iter().scan(0_u64, |sum, work| {
                *sum = sum.saturating_add(*work);
                Some(*sum)
            });
            std::iter::once(0).chain(sums).collect()
        });
        let rows = columns.first().map_or(0, Vec::len);
        Self { below: below.collect(), rows, parts, thinnest }
    }

    /// The work from a row to below another one, in the column with the largest.
    fn largest(&self, start: usize, end: usize) -> u64 {
        self.below.iter().map(|below| below[end] - below[start]).max().unwrap_or(0)
    }

    /// The work from a row to below another one, in all columns.
    fn sum(&self, start: usize, end: usize) -> u128 {
        self.below.iter().map(|below| u128::from(below[end] - below[start])).sum()
    }

    /// For each number of parts the ends that so many can have, with no work above a limit. `None` if all
    /// parts cannot end at the last row.
    fn ends(&self, limit: u64) -> Option<Vec<Vec<bool>>> {
        let mut ends = vec![vec![false; self.rows + 1]];
        ends[0][0] = true;
        for part in 0..self.parts {
            let before = &ends[part];
            // How many ends of the parts before lie below each row.
            let mut below = Vec::with_capacity(self.rows + 2);
            below.push(0);
            below.extend(before.iter().scan(0, |count, is_end| {
                *count += usize::from(*is_end);
                Some(*count)
            }));
            let mut first = 0;
            let is_end = |end: usize| {
                while self.largest(first, end) > limit {
                    first += 1;
                }
                end.checked_sub(self.thinnest)
                    .is_some_and(|last| first <= last && below[last + 1] > below[first])
            };
            ends.push((0..=self.rows).map(is_end).collect());
        }
        ends[self.parts][self.rows].then_some(ends)
    }

    /// The bounds of parts without work above a limit. Of several, those with the most even work.
    fn bounds(&self, limit: u64) -> Option<Vec<usize>> {
        let ends = self.ends(limit)?;
        let mut bounds = vec![self.rows; self.parts + 1];
        for part in (0..self.parts).rev() {
            let end = bounds[part + 1];
            let starts = (0..=end.checked_sub(self.thinnest)?).rev();
            let starts = starts.take_while(|start| self.largest(*start, end) <= limit);
            // The parts before have the share of their number.
            let wanted = self.sum(0, end) * part as u128;
            let miss = |start: &usize| (self.sum(0, *start) * (part + 1) as u128).abs_diff(wanted);
            bounds[part] = starts.filter(|start| ends[part][*start]).min_by_key(miss)?;
        }
        Some(bounds)
    }
}

#[cfg(test)]
mod tests {
    use super::{balanced, even};

    /// All bounds of parts that are thick enough.
    fn all(rows: usize, parts: usize, thinnest: usize) -> Vec<Vec<usize>> {
        if parts == 0 {
            return if rows == 0 { vec![vec![0]] } else { Vec::new() };
        }
        let with_last = |start: usize| {
            all(start, parts - 1, thinnest).into_iter().map(move |before| [before, vec![rows]].concat())
        };
        (0..=rows.saturating_sub(thinnest))
            .filter(|start| rows - start >= thinnest)
            .flat_map(with_last)
            .collect()
    }

    fn largest(columns: &[Vec<u64>], bounds: &[usize]) -> u64 {
        let parts = bounds.windows(2);
        let of_part = |part: &[usize]| {
            columns.iter().map(|column| column[part[0]..part[1]].iter().sum()).max().unwrap_or(0)
        };
        parts.map(of_part).max().unwrap_or(0)
    }

    /// Numbers that look random.
    fn numbers(seed: u64, count: usize, below: u64) -> Vec<u64> {
        let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
        let next = |_| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) % below
        };
        (0..count).map(next).collect()
    }

    #[test]
    fn no_other_bounds_have_less_work_in_the_largest_part() {
        let mut cases = 0;
        for rows in 1..=11 {
            for thinnest in 1..=3 {
                for parts in 1..=rows / thinnest {
                    let others = all(rows, parts, thinnest);
                    assert!(!others.is_empty());
                    for seed in 0..12 {
                        // Many rows without work, or few.
                        let column = |number: u64| {
                            let column =
                                numbers(seed * 31 + number, rows, if seed % 2 == 0 { 4 } else { 90 });
                            column.into_iter().map(|work| work.saturating_sub(2 * (seed % 3))).collect()
                        };
                        let columns: Vec<Vec<u64>> = (0..1 + seed % 3).map(column).collect();
                        let bounds = balanced(&columns, parts, thinnest);
                        assert!(others.contains(&bounds), "{columns:?}: {bounds:?}");
                        let least = others.iter().map(|other| largest(&columns, other)).min();
                        assert_eq!(Some(largest(&columns, &bounds)), least, "{columns:?}: {bounds:?}");
                        cases += 1;
                    }
                }
            }
        }
        assert!(cases > 500, "{cases}");
    }

    #[test]
    fn equal_work_is_cut_evenly() {
        for (rows, parts) in [(10, 3), (7, 7), (100, 9), (5, 1)] {
            for bounds in [balanced(&[vec![6; rows]], parts, 1), even(rows, parts)] {
                let lengths: Vec<usize> = bounds.windows(2).map(|pair| pair[1] - pair[0]).collect();
                assert!(lengths.iter().all(|length| length.abs_diff(rows / parts) <= 1), "{bounds:?}");
                assert_eq!((bounds[0], bounds[parts]), (0, rows));
            }
        }
    }

    #[test]
    fn no_room_is_no_panic() {
        assert_eq!(balanced(&[vec![1, 2, 3]], 2, 2), even(3, 2));
        assert_eq!(balanced(&[], 2, 1), even(0, 2));
        assert_eq!(balanced(&[vec![u64::MAX, u64::MAX]], 2, 1), [0, 1, 2]);
    }
}
