//! Which known word a mistyped one was meant to be.

use strsim::osa_distance;

/// The known word that is nearest, if it is near.
pub(super) fn similar<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> Option<String> {
    let limit = match word.chars().count() {
        0..=2 => 1,
        3..=5 => 2,
        _ => 3,
    };
    known
        .into_iter()
        .map(|candidate| (osa_distance(word, candidate), candidate))
        .filter(|(distance, candidate)| *distance <= limit && *distance < candidate.chars().count())
        .min()
        .map(|(_, candidate)| candidate.to_owned())
}

#[cfg(test)]
mod tests {
    use super::similar;

    #[test]
    fn only_near_words_are_offered() {
        assert_eq!(similar("flx", ["cell", "flux"]), Some("flux".to_owned()));
        assert_eq!(similar("pressure", ["cell", "flux"]), None);
        assert_eq!(similar("a", ["b"]), None);
        assert_eq!(similar("lenght", ["weight", "length"]), Some("length".to_owned()));
    }
}
