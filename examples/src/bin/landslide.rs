//! A landslide that runs down a valley: debris levels out with the ground, cell by cell.
//!
//! The model is SCIDDICA-T in its simplest form. What a cell holds above a layer that sticks to the ground (the adherence) can move. It is shared with the four
//! neighbours so that the heights of all that take part differ as little as possible (the minimisation of differences of Di Gregorio and Serra,
//! Future Generation Computer Systems 16, 1999): a cell that stands above the common level takes no part. Of what would flow then, a step
//! moves a part (the rate). Debris is neither lost nor made.
use std::path::{Path, PathBuf};
use xca_run::prelude::*;

#[derive(Substates, Clone)]
struct Slope {
    /// Of the ground below the debris, in m
    altitude: Real,
    /// Of the debris, in m
    thickness: Real,
    /// What leaves for the neighbours 1 to 4 (south, west, east, north), in m of thickness
    outflow: Vector4<Real>,
}

#[derive(Parameters, Clone, Copy, Debug)]
struct Debris {
    /// The thickness of what sticks to the ground, in m
    adherence: Real,
    /// The part of the flow that a step moves, up to 1
    rate: Real,
}

#[elementary_process]
fn flow(cell: &mut Cell<Slope>, p: &Debris) {
    cell.outflow = Vector4::splat(0.0);
    let mobile = cell.thickness - p.adherence;
    if mobile <= 0.0 {
        return;
    }
    let mut heights = [0.0; 5];
    let mut takes_part = [true; 5];
    heights[0] = cell.altitude + p.adherence;
    for n in 1..5 {
        heights[n] = cell.neighbour(n).altitude + cell.neighbour(n).thickness;
    }
    let mut level = 0.0;
    let mut is_settled = false;
    while !is_settled {
        let mut sum = mobile;
        let mut count = 0.0;
        for n in 0..5 {
            if takes_part[n] {
                sum += heights[n];
                count += 1.0;
            }
        }
        level = sum / count;
        is_settled = true;
        for n in 0..5 {
            if takes_part[n] && heights[n] > level {
                takes_part[n] = false;
                is_settled = false;
            }
        }
    }
    let mut outflow = [0.0; 5];
    for n in 1..5 {
        if takes_part[n] {
            outflow[n] = p.rate * (level - heights[n]);
        }
    }
    cell.outflow = Vector4::new(outflow[1], outflow[2], outflow[3], outflow[4]);
}

/// What leaves for one of the neighbours.
#[helper]
fn towards(outflow: Vector4<Real>, neighbour: usize) -> Real {
    match neighbour {
        directions::von_neumann_2d::SOUTH => outflow.x,
        directions::von_neumann_2d::WEST => outflow.y,
        directions::von_neumann_2d::EAST => outflow.z,
        _ => outflow.w,
    }
}

#[elementary_process]
fn settle(cell: &mut Cell<Slope>) {
    let gone = cell.outflow.x + cell.outflow.y + cell.outflow.z + cell.outflow.w;
    let mut come = 0.0;
    for n in 1..cell.neighbour_count() {
        come += towards(cell.neighbour(n).outflow, cell.opposite(n));
    }
    cell.thickness += come - gone;
}

/// The altitude of what no debris climbs: beyond the map, and where it has no value.
const WALL: f64 = 1e5;

#[derive(Args)]
struct Landslide {
    /// The ground: an ESRI ASCII grid of altitudes, in m; a valley is made up unless it is given
    #[arg(long, value_name = "FILE")]
    dem: Option<PathBuf>,
    /// The debris: an ESRI ASCII grid of its thickness, in m, of the same cells as the ground
    #[arg(long, value_name = "FILE", requires = "dem")]
    debris: Option<PathBuf>,
    /// Stop when no cell sends more than this to a neighbour in a step, in m
    #[arg(long, value_name = "METRES", default_value_t = 1e-4)]
    until: f64,
}

/// Ground and debris, with their place on the map.
struct Map {
    ground: AsciiGrid,
    debris: AsciiGrid,
    /// How much the ground rises at random in each cell at most, in m.
    roughness: f64,
    files: Vec<PathBuf>,
}

impl Map {
    /// A valley that falls to the south, has bends, and ends at another slope; and a slab of debris at its head.
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
            ground: AsciiGrid::new(extents, side, ground.collect())?,
            debris: AsciiGrid::new(extents, side, debris.collect())?,
            roughness: 2.0,
            files: Vec::new(),
        })
    }

    fn read(dem: &Path, debris: &Path) -> Result<Self, Failure> {
        let [ground, thickness] = [AsciiGrid::read(dem)?, AsciiGrid::read(debris)?];
        let same = (ground.extents(), ground.side()) == (thickness.extents(), thickness.side());
        if !same {
            return Err(format!("{} and {} have different cells", dem.display(), debris.display()).into());
        }
        if thickness.values().iter().any(|thickness| *thickness < 0.0) {
            return Err(format!("{} has debris of less than 0 m", debris.display()).into());
        }
        Ok(Self { ground, debris: thickness, roughness: 0.0, files: vec![dem.to_owned(), debris.to_owned()] })
    }

    fn state(&self, site: Site) -> Slope {
        let [x, y, _] = site.cell();
        let rough = |altitude: f64| altitude + self.roughness * site.random(0);
        Slope {
            altitude: self.ground.value([x, y]).map_or(WALL, rough),
            thickness: self.debris.value([x, y]).unwrap_or(0.0),
            outflow: Vector4::splat(0.0),
        }
    }
}

impl Program for Landslide {
    const NAME: &'static str = "landslide";
    const ABOUT: &'static str =
        "A landslide that runs down a valley, over a map of yours or one that is made up";
    const EXAMPLES: &'static str =
        "--set adherence=0.5 --set rate=0.75\n--dem ground.asc --debris debris.asc";

    fn set_up(&self, _given: Given) -> Result<SetUp, Failure> {
        let map = match (&self.dem, &self.debris) {
            (Some(dem), Some(debris)) => Map::read(dem, debris)?,
            (Some(_), None) => return Err("a map needs its debris too: add --debris FILE".into()),
            _ => Map::made_up().ok_or("a valley has cells")?,
        };
        let ([columns, rows], side, until) = (map.ground.extents(), map.ground.side(), self.until);
        let (corner, files) = (map.ground.corner(), map.files.clone());
        let outside = Slope { altitude: WALL, thickness: 0.0, outflow: Vector4::splat(0.0) };
        let debris = Debris { adherence: 1.0, rate: 0.5 };
        let model = Model::builder("landslide")
            .extents([columns, rows, 1])
            .cell_side(side)
            .neighbourhood(Neighbourhood::von_neumann_2d(1))
            .boundary(Boundary::Flat)
            .substates_with_outside(outside)
            .parameters(debris)
            .process(flow)
            .process(settle)
            .fill(move |site| map.state(site))
            .stop_when(Schedule::Every(20), move |state| {
                let largest = state.maximum(Slope::OUTFLOW)?.unwrap_or_default();
                let flows = [largest.x, largest.y, largest.z, largest.w];
                let rests = flows.iter().all(|metres| *metres <= until);
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
            Ok(vec![
                Observable::new("volume", "m^3", state.sum(Slope::THICKNESS)? * side * side).conserved(),
                Observable::new("covered_area", "m^2", area),
                Observable::new("front_from_south", "m", front as f64 * side),
                Observable::new("largest_thickness", "m", state.maximum(Slope::THICKNESS)?.unwrap_or(0.0)),
            ])
        };
        let view = CellView::named("landslide").draw(Slope::THICKNESS, "thickness of the debris (m)");
        let view = view.relief(Slope::ALTITUDE, 0.0);
        let set_up = SetUp::new(model, 4000).observables(observe).cells(view).corner(corner);
        Ok(files.into_iter().fold(set_up, SetUp::input))
    }
}

fn main() -> ExitCode {
    xca_run::main!(Landslide)
}
