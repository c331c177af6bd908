//! A landslide that runs down a valley: debris levels out with the ground, cell by cell.
//!
//! The model is `models::landslide`. The volume of debris is conserved.
use std::path::{Path, PathBuf};
use xca_examples::models::landslide::{Debris, Slope, builder};
use xca_run::prelude::*;

#[derive(Args)]
struct Landslide {
    /// The ground: a GeoTIFF or ESRI ASCII grid of altitudes, in m; a valley is made up unless it is given
    #[arg(long, value_name = "FILE")]
    dem: Option<PathBuf>,
    /// The debris: a GeoTIFF or ESRI ASCII grid of its thickness, in m, of the same cells as the ground; no
    /// value is 0 m
    #[arg(long, value_name = "FILE", requires = "dem")]
    debris: Option<PathBuf>,
    /// Where debris was found afterwards: a GeoTIFF or ESRI ASCII grid of its thickness, in m, of the same
    /// cells as the ground. The observable `fitness` then tells how well the debris of the run lies on it: 1
    /// where both cover the same cells, 0 where none
    #[arg(long, value_name = "FILE")]
    observed: Option<PathBuf>,
    /// Stop when no cell sends more than this to a neighbour in a step, in m; never where it is below 0
    #[arg(long, value_name = "METRES", default_value_t = 1e-4, value_parser = number_in(..))]
    until: f64,
}

/// Ground and debris, with their place on the map.
struct Terrain {
    ground: Raster,
    debris: Raster,
    /// How much the ground rises at random in each cell at most, in m.
    roughness: f64,
    files: Vec<PathBuf>,
}

impl Terrain {
    /// A valley that falls to the south, has bends, and ends at another slope; and a slab of debris at its
    /// head.
    fn made_up() -> Option<Self> {
        let (extents, side) = ([160, 240], 10.0);
        let metres = |cell: usize| (cell as f64 + 0.5) * side;
        let cells = || (0..extents[1]).flat_map(|y| (0..extents[0]).map(move |x| [x, y]));
        let bed = |y: f64| 800.0 + 180.0 * (y / 350.0).sin();
        let ground = cells().map(|[x, y]| {
            let across = (metres(x) - bed(metres(y))) / 100.0;
            // The opposite slope is the steeper one.
            let along = (metres(y) - 600.0) / 1000.0;
            let steepness = if along < 0.0 { 300.0 } else { 120.0 };
            500.0 + steepness * along * along + 12.0 * across * across
        });
        let debris = cells().map(|[x, y]| {
            let away = [(metres(x) - bed(2150.0)) / 180.0, (metres(y) - 2150.0) / 120.0];
            20.0 * (1.0 - away[0] * away[0] - away[1] * away[1]).max(0.0)
        });
        Some(Self {
            ground: Raster::new(extents, side, ground.collect())?,
            debris: Raster::new(extents, side, debris.collect())?,
            roughness: 2.0,
            files: Vec::new(),
        })
    }

    fn read(dem: &Path, debris: &Path) -> Result<Self, Failure> {
        let [ground, thickness] = [Raster::read_heights(dem)?, Raster::read_thickness(debris)?];
        let map = Map::from(&ground);
        map.check(debris, &thickness, &dem.display().to_string())?;
        Ok(Self { ground, debris: thickness, roughness: 0.0, files: vec![dem.to_owned(), debris.to_owned()] })
    }

    fn state(&self, site: Site) -> Slope {
        let [x, y, _] = site.cell();
        let altitude = self.ground.value([x, y]);
        Slope {
            altitude: altitude.map_or(0.0, |altitude| altitude + self.roughness * site.random(0)),
            thickness: self.debris.value([x, y]).unwrap_or(0.0),
            is_ground: altitude.is_some(),
            ..Slope::bare()
        }
    }
}

/// Debris that is thinner, in m, does not count as such.
const TRACE: f64 = 1e-3;

/// The cells in which debris was found.
fn read_observed(path: &Path, map: &Map) -> Result<Vec<bool>, Failure> {
    let found = Raster::read_thickness(path)?;
    map.check(path, &found, "the ground")?;
    Ok(found.values().iter().map(|metres| *metres > TRACE).collect())
}

/// The root of the area that a run and the observation share, divided by the area that either covers: the
/// measure by which SCIDDICA was calibrated (D'Ambrosio, Spataro and Iovine 2006).
fn fitness(thickness: &[f64], observed: &[bool]) -> f64 {
    let cells = || thickness.iter().map(|metres| *metres > TRACE).zip(observed.iter().copied());
    let shared = cells().filter(|(run, found)| *run && *found).count();
    let either = cells().filter(|(run, found)| *run || *found).count();
    if either == 0 { 1.0 } else { (shared as f64 / either as f64).sqrt() }
}

/// The warning of a run in which debris has reached the edge.
const TOO_SMALL: &str = "debris has reached the edge of the map and piles up there; use a larger map";

impl Program for Landslide {
    const NAME: &'static str = "landslide";
    const ABOUT: &'static str =
        "A landslide that runs down a valley, over a map of yours or one that is made up";
    const EXAMPLES: &'static str =
        "--set adherence=0.5 --set rate=0.75\n--dem ground.asc --debris debris.asc";

    fn set_up(&self, _given: Given) -> Result<SetUp, Failure> {
        let terrain = match (&self.dem, &self.debris) {
            (Some(dem), Some(debris)) => Terrain::read(dem, debris)?,
            (Some(_), None) => return Err("a map needs its debris too: add --debris FILE".into()),
            _ => Terrain::made_up().ok_or("a valley has cells")?,
        };
        let ([columns, rows], side, until) = (terrain.ground.extents(), terrain.ground.side(), self.until);
        let (map, files) = (Map::from(&terrain.ground), terrain.files.clone());
        let observed = self.observed.as_deref().map(|path| read_observed(path, &map)).transpose()?;
        let files = files.into_iter().chain(self.observed.clone());
        let edge = map.edge();
        let debris = Debris { adherence: 1.0, rate: 0.5 };
        let model = builder([columns, rows], side, debris, move |site| terrain.state(site))
            .stop_when(Schedule::Every(20), move |state| {
                let largest = state.maximum(Slope::OUTFLOW)?.unwrap_or_default();
                let rests = largest.iter().all(|metres| *metres <= until);
                Ok(rests.then(|| format!("no cell sends more than {until} m to a neighbour")))
            })
            .build()?;
        let observe = move |state: &State<'_>| {
            let thickness = state.read(Slope::THICKNESS)?;
            let adherence = state.parameters::<Debris>()?.adherence;
            let front =
                thickness.iter().position(|metres| *metres > adherence).map_or(0, |cell| cell / columns);
            let covered = state.count_where(|slope: &Slope| slope.thickness > adherence)?;
            let area = covered as f64 * side * side;
            let at_edge = edge.iter().filter(|cell| thickness[**cell] > 0.0).count();
            let fitness = observed.as_ref().map(|observed| fitness(&thickness, observed));
            let fitness = fitness.map(|fitness| Observable::number("fitness", fitness));
            let observables = vec![
                Observable::new("volume", "m^3", state.sum(Slope::THICKNESS)? * side * side).conserved(),
                Observable::new("covered_area", "m^2", area),
                Observable::new("front_from_south", "m", front as f64 * side),
                Observable::new("largest_thickness", "m", state.maximum(Slope::THICKNESS)?.unwrap_or(0.0)),
                Observable::new("debris_at_edge", "cells", at_edge as f64),
            ];
            Ok(observables.into_iter().chain(fitness).collect())
        };
        let view = CellView::named("landslide").draw(Slope::THICKNESS, "thickness of the debris (m)");
        let view = view.relief(Slope::ALTITUDE, 0.0);
        let set_up = SetUp::new(model, 4000).observables(observe).cells(view).map(map);
        let set_up = set_up.warning_unless_zero("debris_at_edge", TOO_SMALL);
        Ok(files.fold(set_up, SetUp::input))
    }
}

fn main() -> ExitCode {
    xca_run::main!(Landslide)
}
