//! Pairs of near points on the host: a cell list.

/// Points sorted into cubic bins.
pub(crate) struct Near<'a> {
    points: &'a [[f64; 3]],
    bins: [usize; 3],
    bin_side: f64,
    /// For each bin, where its points start in `order`; and the end of the last.
    starts: Vec<u32>,
    /// The indices of the points, bin after bin, in ascending order within each.
    order: Vec<u32>,
}

/// Half of the 26 bins around a bin: of two bins next to each other one finds the other.
const FORWARD: [[isize; 3]; 13] = [
    [1, 0, 0],
    [-1, 1, 0],
    [0, 1, 0],
    [1, 1, 0],
    [-1, -1, 1],
    [0, -1, 1],
    [1, -1, 1],
    [-1, 0, 1],
    [0, 0, 1],
    [1, 0, 1],
    [-1, 1, 1],
    [0, 1, 1],
    [1, 1, 1],
];

impl<'a> Near<'a> {
    /// Sorts points of a box from the origin to `sides` into bins at least `least_side` wide. Points outside
    /// count to the nearest bin.
    pub(crate) fn new(sides: [f64; 3], least_side: f64, points: &'a [[f64; 3]]) -> Self {
        // Where few points stand in a large box, wider bins keep the list small.
        let most_bins = 8.0 * points.len() as f64 + 4096.0;
        let mut bin_side = least_side;
        let count = |bin_side: f64| sides.map(|side| (side / bin_side).ceil().max(1.0));
        while count(bin_side).iter().product::<f64>() > most_bins {
            bin_side *= 2.0;
        }
        let bins = count(bin_side).map(|bins| bins as usize);
        let mut near = Self { points, bins, bin_side, starts: Vec::new(), order: vec![0; points.len()] };
        let mut starts = vec![0_u32; bins.iter().product::<usize>() + 1];
        for point in points {
            starts[near.linear(near.bin(*point)) + 1] += 1;
        }
        for bin in 1..starts.len() {
            starts[bin] += starts[bin - 1];
        }
        let mut next = starts.clone();
        for (index, point) in points.iter().enumerate() {
            let place = &mut next[near.linear(near.bin(*point))];
            near.order[*place as usize] = index as u32;
            *place += 1;
        }
        near.starts = starts;
        near
    }

    fn bin(&self, point: [f64; 3]) -> [usize; 3] {
        let mut bin = [0; 3];
        for axis in 0..3 {
            bin[axis] = ((point[axis] / self.bin_side) as usize).min(self.bins[axis] - 1);
        }
        bin
    }

    fn linear(&self, [x, y, z]: [usize; 3]) -> usize {
        (z * self.bins[1] + y) * self.bins[0] + x
    }

    fn points_of(&self, bin: usize) -> &[u32] {
        &self.order[self.starts[bin] as usize..self.starts[bin + 1] as usize]
    }

    /// Calls `pair` with the indices and the distance of every two points nearer than `reach`, which is at
    /// most the side of a bin. The order of the calls follows from the points alone.
    pub(crate) fn pairs_within(&self, reach: f64, mut pair: impl FnMut(usize, usize, f64)) {
        let mut compare = |one: u32, other: u32| {
            let ([x, y, z], [u, v, w]) = (self.points[one as usize], self.points[other as usize]);
            let (x, y, z) = (x - u, y - v, z - w);
            let square = x * x + y * y + z * z;
            if square < reach * reach {
                pair(one as usize, other as usize, square.sqrt());
            }
        };
        let [width, height, depth] = self.bins;
        for z in 0..depth {
            for y in 0..height {
                for x in 0..width {
                    let own = self.points_of(self.linear([x, y, z]));
                    if own.is_empty() {
                        continue;
                    }
                    for (index, &one) in own.iter().enumerate() {
                        own[index + 1..].iter().for_each(|&other| compare(one, other));
                    }
                    for [dx, dy, dz] in FORWARD {
                        let at = |index: usize, step: isize, extent: usize| {
                            index.checked_add_signed(step).filter(|&index| index < extent)
                        };
                        let (Some(x), Some(y), Some(z)) =
                            (at(x, dx, width), at(y, dy, height), at(z, dz, depth))
                        else {
                            continue;
                        };
                        let others = self.points_of(self.linear([x, y, z]));
                        for &one in own {
                            others.iter().for_each(|&other| compare(one, other));
                        }
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Near;

    /// Points by a linear congruence: no two alike, none in line.
    fn points(count: usize, side: f64) -> Vec<[f64; 3]> {
        let mut state = 12345_u64;
        let mut next = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 40) as f64 / (1_u64 << 24) as f64 * side
        };
        (0..count).map(|_| [next(), next(), next()]).collect()
    }

    #[test]
    fn finds_the_same_pairs_as_a_comparison_of_all() {
        for (count, sides, reach) in
            [(300, [1.0; 3], 0.1), (300, [1.0; 3], 0.5), (20, [9.0, 1.0, 900.0], 0.05), (0, [1.0; 3], 0.1)]
        {
            let points = points(count, 1.0);
            let distance = |one: usize, other: usize| {
                (0..3).map(|axis| (points[one][axis] - points[other][axis]).powi(2)).sum::<f64>().sqrt()
            };
            let all = (0..count).flat_map(|one| (0..one).map(move |other| (other, one)));
            let mut expected: Vec<(usize, usize)> = all.filter(|(a, b)| distance(*a, *b) < reach).collect();
            let mut found = Vec::new();
            Near::new(sides, reach, &points).pairs_within(reach, |one, other, apart| {
                assert!((apart - distance(one, other)).abs() < 1e-15);
                found.push((one.min(other), one.max(other)));
            });
            expected.sort_unstable();
            found.sort_unstable();
            assert_eq!(found, expected);
        }
    }
}
