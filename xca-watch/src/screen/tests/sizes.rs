//! Terminals of any size.

use super::*;
use proptest::prelude::*;
use xca_picture::{Category, ColourMap};
use xca_record::record::Sight;

/// A state of any model: `kinds` and `is_layer` as they may be.
fn any_news() -> impl Strategy<Value = News> {
    let value = prop_oneof![Just(f64::NAN), Just(f64::INFINITY), Just(0.0), Just(1.0), -1e300..1e300];
    let layer = (1_usize..40, 1_usize..40, prop::collection::vec(value.clone(), 1600), 0_usize..3).prop_map(
        |(across, down, mut values, axis)| {
            values.truncate(across * down);
            (Subject::Layer { cells: [across, down], axis, layer: 0, layers: 1 }, values)
        },
    );
    let extents = prop::array::uniform3(1_usize..20);
    let positions = prop::collection::vec(prop::array::uniform3(value.clone()), 0..30);
    let items = (extents, positions, 0.0..3.0, value).prop_map(|(extents, positions, radius, value)| {
        let values = vec![value; positions.len()];
        (Subject::Items { positions, radius, extents }, values)
    });
    (prop_oneof![layer, items], any::<bool>(), any::<bool>()).prop_map(
        |((subject, values), has_kinds, has_ended)| {
            let kinds = [Category::new(0, 0.0, "none"), Category::new(1, 1.0, "some")];
            let kinds = if has_kinds { kinds.to_vec() } else { Vec::new() };
            News {
                step: 3,
                sight: Sight {
                    subject,
                    values,
                    hidden: None,
                    substate: "alive".to_owned(),
                    label: "a^2".to_owned(),
                    map: ColourMap::default(),
                    kinds,
                    range: None,
                },
                observables: vec![xca_record::Observable::new("energy", "J", 1.5)],
                observed: 2,
                end: has_ended.then(|| "ended".to_owned()),
            }
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(128))]
    #[test]
    fn no_state_and_no_size_of_the_terminal_is_too_much(
        news in any_news(),
        sizes in prop::collection::vec((1_u16..60, 1_u16..40), 1..4),
        keys in "[zhjklna+ .-]{0,8}",
        colours in prop_oneof![Just(Colours::True), Just(Colours::Indexed), Just(Colours::None)],
    ) {
        let facts = Facts { note: Some("ein Ü".to_owned()), substates: vec!["alive"], ..Facts::default() };
        let mut screen = Screen::new(facts, colours, Pace::new(1, 20), Look::default());
        for (width, height) in sizes {
            drawn(&mut screen, width, height);
            screen.tell(news.clone());
            for key in keys.chars() {
                screen.press(KeyEvent::from(KeyCode::Char(key)));
                drawn(&mut screen, width, height);
            }
        }
    }
}

#[test]
fn words_give_way_to_the_picture() {
    let mut watched = Watched::new(life([8, 8, 1], BLINKER), None);
    watched.screen.facts.note = Some("this is no GPU".to_owned());
    let mut has = |width, height, what: &str| text(&watched.drawn(width, height)).contains(what);
    assert!(has(1, 1, "s") && has(10, 3, "step 0") && has(10, 3, "▀"));
    assert!(!has(100, 5, "quit") && has(100, 6, "quit"));
    assert!(!has(100, 9, "alive_sum") && has(100, 10, "alive_min 0  alive_sum 3  alive_max 1"));
    assert!(!has(100, 11, "no GPU") && has(100, 12, "note: this is no GPU"));
    assert!(!has(30, 24, "some engine"));
    assert!(has(40, 24, "some engine") && !has(40, 24, "much") && !has(40, 24, "life"));
    assert!(has(100, 24, "some engine with much to say") && has(100, 24, "life"));
}
