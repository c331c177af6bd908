//! A fire that runs over hills with the wind, and stops at a river.
use std::path::PathBuf;
use xca_examples::models::wildfire::{Cover, Landscape, Weather, model};
use xca_run::prelude::*;

#[derive(Args)]
struct Wildfire {
    /// Fuel: a GeoTIFF or ESRI ASCII grid of numbers from 0 (bare) to 1, on flat ground; hills are made up
    /// without it. The fire begins in the cell with a value that is nearest to a quarter of the map
    #[arg(long, value_name = "FILE")]
    fuel: Option<PathBuf>,
}

/// Hills of forest and grass, in cells of 20 m, with a river.
fn hills(site: Site) -> Landscape {
    let [x, y] = [site.centre().x, site.centre().y];
    let river = 3400.0 + 300.0 * (y / 400.0).sin();
    let hills = (x / 500.0).sin() * (y / 700.0).cos() + 0.5 * (x / 230.0 + y / 310.0).sin();
    let carved = 30.0 * (-((x - river) / 60.0).powi(2)).exp();
    let fuel = if hills < -0.6 { 0.6 } else { 0.9 + 0.1 * site.random(0) };
    let cover = if (x - river).abs() < 50.0 { Cover::Bare } else { Cover::Whole };
    Landscape { cover, fuel, altitude: 300.0 + 45.0 * hills - carved }
}

impl Wildfire {
    /// The grid, whose cells without a value are bare.
    fn grid(&self) -> Result<Option<Raster>, Failure> {
        let Some(path) = &self.fuel else { return Ok(None) };
        let grid = Raster::read(path)?;
        let Some(cell) = grid.values().iter().position(|fuel| *fuel < 0.0 || *fuel > 1.0) else {
            return Ok(Some(grid));
        };
        let ([column, row], fuel) = (grid.placement().place(cell), grid.values()[cell]);
        let place = format!("column {column}, row {row} from the north");
        Err(format!("{}: fuel of {fuel} in {place}; it must be from 0 to 1", path.display()).into())
    }
}

/// The cell with ground that is nearest to a quarter of the map.
fn start(map: &Map) -> Option<[usize; 2]> {
    let [columns, rows] = map.placement().extents;
    let away = |[x, y]: [usize; 2]| x.abs_diff(columns / 4).pow(2) + y.abs_diff(rows / 4).pow(2);
    let cells = (0..columns * rows).filter(|cell| map.has_ground(*cell));
    cells.map(|cell| [cell % columns, cell / columns]).min_by_key(|cell| away(*cell))
}

impl Program for Wildfire {
    const NAME: &'static str = "wildfire";
    const ABOUT: &'static str = "A fire that runs over hills with the wind";
    const EXAMPLES: &'static str = "--set wind=-4,0 --set spread=0.4\n--fuel fuel.asc";

    fn set_up(&self, _given: Given) -> Result<SetUp, Failure> {
        let grid = self.grid()?;
        let made_up = || Map::new(Placement { extents: [240, 160], corner: [0.0; 2], side: 20.0 });
        let map = grid.as_ref().map_or_else(made_up, Map::from);
        let Placement { extents, side, .. } = map.placement();
        let fire = start(&map).ok_or("no cell of the map has a value")?;
        let weather =
            Weather { spread: 0.32, wind: Vector2::new(3.0, 1.5), extinction: 0.4, ..Weather::default() };
        let model = model(extents, side, weather, move |site| {
            let [x, y, _] = site.cell();
            let land = match &grid {
                Some(grid) => {
                    let fuel = grid.value([x, y]).unwrap_or(0.0);
                    let cover = if fuel > 0.0 { Cover::Whole } else { Cover::Bare };
                    Landscape { cover, fuel, altitude: 0.0 }
                }
                None => hills(site),
            };
            if [x, y] == fire { Landscape { cover: Cover::Burning, ..land } } else { land }
        })?;
        let colours = [
            (Cover::Bare, [150, 180, 210]),
            (Cover::Whole, [120, 160, 90]),
            (Cover::Burning, [230, 80, 30]),
            (Cover::Burnt, [60, 50, 50]),
        ];
        let view =
            CellView::named("wildfire").draw(Landscape::COVER, "cover").colours(Landscape::COVER, &colours);
        let set_up = SetUp::new(model, 130).cells(view).map(map);
        Ok(self.fuel.iter().fold(set_up, SetUp::input))
    }
}

fn main() -> ExitCode {
    xca_run::main!(Wildfire)
}
