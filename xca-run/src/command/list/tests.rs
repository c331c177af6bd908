//! A model told by `list`.

use super::*;
use serde_json::Value;
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Ground {
    water: Real,
}

#[derive(States, Clone, Copy, PartialEq)]
enum Look {
    Clear,
    Grey,
}

#[derive(Substates, Clone, Copy)]
#[allow(dead_code, reason = "only its schema is looked at")]
struct Sky {
    look: Look,
    #[substate(unit = "kg")]
    water: [Real; 2],
    wind: Real,
}

#[derive(Parameters, Clone, Debug)]
struct Soil {
    rate: Real,
}

#[derive(Parameters, Clone, Debug)]
struct Air {
    /// The share of its speed that the wind keeps in a day, where neither mountains nor trees are in its way.
    #[parameter(unit = "1/d", range = 0.0..=1.0)]
    rate: Real,
    #[parameter(computed)]
    calm: Real,
}

#[elementary_process]
fn soak(ground: &mut Cell<Ground>, sky: &Cell<Sky>, soil: &Soil) {
    ground.water += soil.rate * sky.water[0] * sky.neighbour(1).wind;
}

#[elementary_process]
fn blow(sky: &mut Cell<Sky>, air: &Air) {
    sky.wind *= air.rate + air.calm;
}

fn model() -> Model {
    Model::builder("weather")
        .extents([3, 3, 1])
        .neighbourhood(Neighbourhood::von_neumann_2d(1))
        .substates::<Ground>()
        .substates::<Sky>()
        .parameters(Soil { rate: 0.5 })
        .parameters(Air { rate: 0.25, calm: 0.0 })
        .compute_parameters(|air: &mut Air| air.calm = 1.0 + 2.0 * air.rate)
        .process(soak)
        .process_every(6, blow)
        .build()
        .unwrap()
}

/// What several structs share is told apart, and processes say in which steps they are run.
#[test]
fn several_structs() {
    let told: Value =
        serde_json::from_str(&as_json(&model(), &Engines::default(), &Formats::default()).unwrap()).unwrap();
    let values = ["Soil.rate", "Air.rate", "calm"].map(|name| &told["parameters"][name]["value"]);
    assert_eq!(values, [&json!(0.5), &json!(0.25), &json!(1.5)]);
    let [first, second] = [0, 1].map(|number| &told["processes"][number]);
    assert_eq!(first["reads"], json!(["Sky.water", "Ground.water"]));
    assert_eq!(first["reads_elsewhere"], json!(["Sky.wind"]));
    assert_eq!(first["writes"], json!(["Ground.water"]));
    assert_eq!((&first["every"], &second["every"]), (&json!(1), &json!(6)));
    assert_eq!(second["writes"], json!(["wind"]));
    let text = as_text(&model(), &Engines::default(), &Formats::default());
    assert_eq!(row(&text, "Air.rate"), ["Air.rate", "Real", "0.25", "1/d", "[0,", "1]"]);
    assert_eq!(row(&text, "blow"), ["blow", "cell", "every", "6"]);
    assert_eq!(row(&text, "reads elsewhere"), ["reads", "elsewhere", "Sky.wind"]);
}

/// The words of the first line that begins so.
fn row(text: &str, first: &str) -> Vec<String> {
    let line = text.lines().find(|line| line.trim_start().starts_with(first)).unwrap();
    line.split_whitespace().map(str::to_owned).collect()
}

/// Units, ranges, documentation, states, and what is computed are told, in 80 columns.
#[test]
fn fields_are_described() {
    let told: Value =
        serde_json::from_str(&as_json(&model(), &Engines::default(), &Formats::default()).unwrap()).unwrap();
    let expected = json!({
        "value": 0.25,
        "type": "Real",
        "states": [],
        "unit": "1/d",
        "low": { "number": 0.0, "included": true },
        "high": { "number": 1.0, "included": true },
        "computed": false,
        "documentation": "The share of its speed that the wind keeps in a day, where neither mountains nor trees \
                          are in its way.",
    });
    assert_eq!(told["parameters"]["Air.rate"], expected);
    assert_eq!(told["parameters"]["calm"]["computed"], true);
    assert_eq!(told["substates"][1]["states"], json!(["Clear", "Grey"]));
    assert_eq!((&told["substates"][2]["unit"], &told["substates"][3]["unit"]), (&json!("kg"), &json!(null)));
    let text = as_text(&model(), &Engines::default(), &Formats::default());
    assert_eq!(row(&text, "Sky.water"), ["Sky.water", "[Real;", "2]", "kg", "cells"]);
    assert!(text.contains("\n    states: Clear, Grey\n"), "{text}");
    assert!(text.contains("\n    computed from other parameters\n"), "{text}");
    assert!(text.contains("mountains\n    nor trees are in its way.\n"), "{text}");
    let wide: Vec<&str> = text.lines().filter(|line| line.chars().count() > 80).collect();
    assert!(wide.is_empty(), "{wide:#?}");
}
