//! What the memory can do, so that times can be compared with it.

use rayon::prelude::*;
use std::error::Error;
use std::hint::black_box;
use std::time::Instant;

/// Numbers in each of two arrays: 256 MB, more than caches hold.
const NUMBERS: usize = 1 << 25;

/// Numbers that are copied at once.
const PART: usize = 1 << 16;

const ROUNDS: usize = 5;

/// Bytes a second that threads read and write together while they copy a large array: the best of some
/// rounds.
pub(crate) fn bandwidth(threads: usize) -> Result<f64, Box<dyn Error>> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
    let from = vec![1.0_f64; NUMBERS];
    let mut to = vec![2.0_f64; NUMBERS];
    let mut best = f64::INFINITY;
    for _ in 0..ROUNDS {
        let start = Instant::now();
        pool.install(|| {
            let parts = to.par_chunks_mut(PART).zip(from.par_chunks(PART));
            parts.for_each(|(to, from)| to.copy_from_slice(from));
        });
        best = best.min(start.elapsed().as_secs_f64());
        black_box(&mut to);
    }
    Ok((2 * NUMBERS * size_of::<f64>()) as f64 / best)
}
