//! Lava out of the vents of a volcano, made up or over a map.
use std::path::PathBuf;
use std::str::FromStr;
use xca_examples::models::lava::{Lava, Rate, Vent, Volcano, model};
use xca_run::prelude::*;

#[derive(Args)]
struct Eruption {
    /// The ground: a GeoTIFF or ESRI ASCII grid of altitudes, in m; a volcano is made up without it
    #[arg(long, value_name = "FILE")]
    dem: Option<PathBuf>,
    /// A vent: column and row from the south-west; can be given several times. Default: the highest cell
    #[arg(long, value_name = "X,Y")]
    vent: Vec<Place>,
    /// What a vent gives at its height, in m³/s
    #[arg(long, value_name = "RATE", default_value_t = 30.0, value_parser = number_in(0.0..))]
    rate: f64,
}

/// A column and a row.
#[derive(Clone, Copy)]
struct Place {
    x: usize,
    y: usize,
}

impl FromStr for Place {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let numbers = text.split_once(',').map(|(x, y)| (x.trim().parse(), y.trim().parse()));
        match numbers {
            Some((Ok(x), Ok(y))) => Ok(Self { x, y }),
            _ => Err("it must be a column and a row, such as 40,25"),
        }
    }
}

/// The vents of the volcano that is made up.
const VENTS: [Place; 2] = [Place { x: 70, y: 82 }, Place { x: 85, y: 70 }];

/// A cone with a flank that has a valley, in cells of 10 m.
fn volcano() -> Option<Raster> {
    const EXTENTS: [usize; 2] = [200, 150];
    let cells = (0..EXTENTS[1]).flat_map(|y| (0..EXTENTS[0]).map(move |x| [x as f64, y as f64]));
    let altitudes = cells.map(|[x, y]| {
        let cone = 600.0 - 4.0 * (x - 60.0).hypot(y - 75.0);
        let valley = -20.0 * (-((y - 75.0 - 20.0 * (x / 25.0).sin()) / 8.0).powi(2)).exp();
        cone.max(150.0 - 0.5 * x) + valley
    });
    Raster::new(EXTENTS, 10.0, altitudes.collect())
}

impl Eruption {
    /// The vents: they begin, are at their height for half an hour, and go on at a lower rate.
    fn vents(&self, ground: &Raster) -> Result<Vec<Vent>, Failure> {
        let [columns, rows] = ground.extents();
        if let Some(Place { x, y }) = self.vent.iter().find(|place| place.x >= columns || place.y >= rows) {
            return Err(format!("no cell {x},{y} for a vent: the ground has {columns} x {rows} cells").into());
        }
        if let Some(Place { x, y }) =
            self.vent.iter().find(|place| ground.value([place.x, place.y]).is_none())
        {
            return Err(format!("cell {x},{y} has no ground (NODATA) for a vent").into());
        }
        let cells = ground.values().iter().enumerate().filter(|(_, altitude)| !altitude.is_nan());
        let highest = cells.max_by(|(_, one), (_, other)| one.total_cmp(other)).map_or(0, |(cell, _)| cell);
        let highest = [Place { x: highest % columns, y: highest / columns }];
        let places = match &self.dem {
            _ if !self.vent.is_empty() => &self.vent[..],
            Some(_) => &highest,
            None => &VENTS,
        };
        let hours = [(0.0, 0.25), (1.0, 1.0), (5.0, 0.4), (20.0, 0.0)];
        let rates = hours.map(|(hour, share)| Rate { from: 3600.0 * hour, volume: share * self.rate });
        Ok(places.iter().map(|place| Vent { cell: [place.x, place.y, 0], rates: rates.to_vec() }).collect())
    }
}

/// The warning of a run in which lava has reached the edge.
const TOO_SMALL: &str = "lava has reached the edge of the map and piles up there; use a larger map";

/// The range of temperatures below solidification that pictures show, in kelvin.
const SOLID_SHOWN: f64 = 143.0;

impl Program for Eruption {
    const NAME: &'static str = "lava";
    const ABOUT: &'static str = "Lava out of the vents of a volcano";
    const EXAMPLES: &'static str = "--vent 60,75 --vent 80,70 --rate 30\n--dem etna.asc --vent 210,180";

    fn set_up(&self, given: Given) -> Result<SetUp, Failure> {
        let ground = match &self.dem {
            Some(path) => Raster::read_heights(path)?,
            None => volcano().ok_or("a volcano has cells")?,
        };
        let (extents, side, map) = (ground.extents(), ground.side(), Map::from(&ground));
        let edge = map.edge();
        let (lava, vents) = (given.applied_to(Lava::default())?, self.vents(&ground)?);
        let [solid, hot] = [lava.solid_temperature, lava.vent_temperature];
        if hot <= solid {
            return Err(format!(
                "the parameter `vent_temperature` is {hot} K, but must be above `solid_temperature`, {solid} K"
            )
            .into());
        }
        let roughness = if self.dem.is_some() { 0.0 } else { 2.0 };
        let altitude = move |site: Site| {
            let [x, y, _] = site.cell();
            ground.value([x, y]).map(|altitude| altitude + roughness * site.random(0))
        };
        let model = model(extents, side, lava, vents, altitude)?;
        let area = side * side;
        let observe = move |state: &State<'_>| {
            let (fluid, solid) = (area * state.sum(Volcano::THICKNESS)?, area * state.sum(Volcano::SOLID)?);
            let covered = state.count_where(|cell: &Volcano| cell.thickness + cell.solid > 0.0)?;
            let [fluids, solids] = [state.read(Volcano::THICKNESS)?, state.read(Volcano::SOLID)?];
            let at_edge = edge.iter().filter(|cell| fluids[**cell] + solids[**cell] > 0.0).count();
            Ok(vec![
                Observable::new("fluid", "m^3", fluid),
                Observable::new("solid", "m^3", solid),
                Observable::new("covered_area", "m^2", covered as f64 * area),
                Observable::new("hottest", "K", state.maximum(Volcano::TEMPERATURE)?.unwrap_or(0.0)),
                Observable::new("lava_at_edge", "cells", at_edge as f64),
            ])
        };
        let view = CellView::named("lava").draw(Volcano::TEMPERATURE, "temperature (K)");
        // Solid lava goes on cooling, and that is shown too.
        let view = view.range(solid - SOLID_SHOWN, hot).relief(Volcano::ALTITUDE, 0.0);
        let set_up = SetUp::new(model, 720).time_step(lava.clock).observables(observe).cells(view);
        let set_up = set_up.warning_unless_zero("lava_at_edge", TOO_SMALL);
        Ok(self.dem.iter().fold(set_up.map(map), SetUp::input))
    }
}

fn main() -> ExitCode {
    xca_run::main!(Eruption)
}
