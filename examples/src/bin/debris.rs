//! A debris flow that starts as soil breaks loose, tears away more of it, and comes to rest on a fan.
use xca_examples::models::debris::{Debris, Slope, model};
use xca_run::prelude::*;

/// Columns and rows of hexagons.
const EXTENTS: [usize; 2] = [120, 200];

/// From centre to centre, in m.
const SIDE: f64 = 5.0;

/// A gully that winds down to the south, meets a slope opposite, and has loose soil at its head.
fn gully(site: Site) -> Slope {
    let [x, y] = [site.centre().x, site.centre().y];
    let along = y - 220.0;
    let across = (x - 300.0 - 60.0 * (y / 110.0).sin()) / 60.0;
    let walls = 7.0 * across * across / (1.0 + 0.15 * across.abs());
    let altitude = 0.0004 * along * along + walls + 0.3 * site.random(0);
    let breaks_loose = u32::from((880.0..940.0).contains(&y) && across.abs() < 0.5);
    Slope { altitude, soil: 0.5, breaks_loose, ..Slope::bare() }
}

fn main() -> ExitCode {
    xca_run::main_of!("debris", "A debris flow that erodes its bed", |_given| {
        let view = CellView::named("debris").draw(Slope::THICKNESS, "thickness of the debris (m)");
        let view = view.relief(Slope::ALTITUDE, 0.01);
        let map = Map::new(Placement { extents: EXTENTS, corner: [0.0; 2], side: SIDE });
        let edge = map.edge();
        let observe = move |state: &State<'_>| {
            let thickness = state.read(Slope::THICKNESS)?;
            let at_edge = edge.iter().filter(|cell| thickness[**cell] > 0.0).count();
            let (debris, soil) = (state.sum(Slope::THICKNESS)?, state.sum(Slope::SOIL)?);
            Ok(vec![
                Observable::new("thickness_in_all", "m", debris),
                Observable::new("debris_and_soil", "m", debris + soil).conserved(),
                Observable::new("debris_at_edge", "cells", at_edge as f64),
            ])
        };
        let model = model(EXTENTS, SIDE, Debris::default(), gully)?;
        let set_up = SetUp::new(model, 800).observables(observe).cells(view);
        let text = "debris has reached the edge of the map and piles up there";
        Ok(set_up.warning_unless_zero("debris_at_edge", text))
    })
}
