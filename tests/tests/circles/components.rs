//! Which files use each other in a circle.

use std::collections::{BTreeMap, BTreeSet};

/// For each file, the names that it uses of others.
pub(crate) type Uses<F> = BTreeMap<F, BTreeMap<F, BTreeSet<String>>>;

/// All that is reached from a file by one use or more.
fn reached<'a, F: Ord>(uses: &'a Uses<F>, from: &F) -> BTreeSet<&'a F> {
    let mut found = BTreeSet::new();
    let mut left: Vec<&F> = uses.get(from).into_iter().flat_map(BTreeMap::keys).collect();
    while let Some(file) = left.pop() {
        if found.insert(file) {
            left.extend(uses.get(file).into_iter().flat_map(BTreeMap::keys));
        }
    }
    found
}

/// The sets of files each of which reaches all others of its set.
pub(crate) fn circles<F: Ord>(uses: &Uses<F>) -> BTreeSet<Vec<&F>> {
    let reached: BTreeMap<&F, BTreeSet<&F>> = uses.keys().map(|file| (file, reached(uses, file))).collect();
    let mut circles = BTreeSet::new();
    for (file, there) in &reached {
        let both: Vec<&F> = there
            .iter()
            .copied()
            .filter(|other| reached.get(other).is_some_and(|back| back.contains(file)))
            .collect();
        if both.len() > 1 {
            circles.insert(both);
        }
    }
    circles
}

#[test]
fn a_circle_is_found() {
    let uses = |pairs: &[(&'static str, &'static str)]| {
        let mut uses: Uses<&str> = Uses::new();
        for (from, to) in pairs {
            uses.entry(from).or_default().entry(*to).or_default();
            uses.entry(to).or_default();
        }
        uses
    };
    assert!(circles(&uses(&[("a", "b"), ("b", "c"), ("a", "c")])).is_empty());
    let found = uses(&[("a", "b"), ("b", "c"), ("c", "b"), ("c", "d"), ("d", "e"), ("e", "d"), ("e", "f")]);
    assert_eq!(circles(&found), [vec![&"b", &"c"], vec![&"d", &"e"]].into());
}
