//! Rain on rock and soil: water levels out, wet soil becomes mud, and leaves float until they are soaked.
use xca_run::prelude::*;

#[derive(States, Clone, Copy, Debug, PartialEq)]
enum Ground {
    Rock,
    Soil,
    Mud,
}

#[derive(Substates, Clone)]
struct Pond {
    ground: Ground,
    wet: bool,
    /// Depth of the water.
    #[substate(unit = "m")]
    depth: Real,
    /// What flows to each of the four neighbours in a step.
    #[substate(unit = "m")]
    outflow: [Real; 4],
    /// How fast water comes in, and how fast it leaves, in cells a step.
    currents: [Vector2<Real>; 2],
}

#[derive(States, Clone, Copy, Debug, PartialEq)]
enum Leaf {
    Floating,
    Soaked,
    Sunk,
}

#[derive(Substates, Clone)]
struct Litter {
    #[position]
    position: Vector3<Real>,
    state: Leaf,
    moved: bool,
    /// How many steps it has spent in each state.
    ages: [u32; 3],
}

#[derive(Parameters, Clone, Debug)]
struct Weather {
    raining: bool,
    /// Where water comes in.
    source: Ground,
    /// What falls on a source in a step.
    #[parameter(unit = "m", range = 0.0..)]
    rain: Real,
    /// The share of the water that flows to each neighbour.
    #[parameter(range = 0.0..=1.0)]
    shares: [Real; 4],
    /// After how many steps a leaf is soaked.
    soaked_after: u8,
}

#[elementary_process]
fn flow(cell: &mut Cell<Pond>, weather: &Weather) {
    for k in 0..4 {
        cell.outflow[k] = weather.shares[k] * cell.depth;
    }
    // The neighbours are those in the south, west, east and north.
    cell.currents[1] = Vector2::new(
        weather.shares[2] * cell.depth - weather.shares[1] * cell.depth,
        weather.shares[3] * cell.depth - weather.shares[0] * cell.depth,
    );
}

#[elementary_process]
fn level(cell: &mut Cell<Pond>, weather: &Weather) {
    let mut change = 0.0;
    for n in 1..cell.neighbour_count() {
        change += cell.neighbour(n).outflow[cell.opposite(n) - 1] - cell.outflow[n - 1];
    }
    cell.depth += change;
    cell.currents[0] = Vector2::new(
        cell.neighbour(2).outflow[2] - cell.neighbour(3).outflow[1],
        cell.neighbour(1).outflow[3] - cell.neighbour(4).outflow[0],
    );
    if weather.raining && cell.ground == weather.source {
        cell.depth += weather.rain;
    }
    cell.wet = cell.depth > 0.01;
    if cell.wet && cell.ground == Ground::Soil && cell.random(0) < 0.1 {
        cell.ground = Ground::Mud;
    }
}

#[elementary_process]
fn drift(me: &mut Slot<Litter>, cell: &Cell<Pond>, weather: &Weather) {
    me.moved = me.state == Leaf::Floating && cell.wet;
    if me.moved {
        me.position.x += cell.currents[0].x;
        me.position.y += cell.currents[0].y;
    }
    match me.state {
        Leaf::Floating => {
            me.ages[0] += 1;
            if me.ages[0] > weather.soaked_after as u32 {
                me.state = Leaf::Soaked;
            }
        }
        Leaf::Soaked => {
            me.ages[1] += 1;
            if cell.wet {
                me.state = Leaf::Sunk;
            }
        }
        Leaf::Sunk => me.ages[2] += 1,
    }
}

#[migration]
fn reassign(me: &Slot<Litter>, space: &Space) -> Destination {
    space.cell_containing(me.position)
}

/// Rock in the middle, with a rough edge.
fn ground(site: Site) -> Ground {
    let [x, y] = [site.centre().x - 24.0, site.centre().y - 16.0];
    let is_rock = (x * x + 2.0 * y * y).sqrt() + 6.0 * site.random(0) < 15.0;
    if is_rock { Ground::Rock } else { Ground::Soil }
}

fn leaf(label: u32) -> Item<Litter> {
    let [x, y] = [4 + 5 * (label % 8), 4 + 6 * (label / 8)].map(|cell| cell as usize);
    let position = Vector3::new(x as f64 + 0.5, y as f64 + 0.5, 0.5);
    let state = if label.is_multiple_of(5) { Leaf::Soaked } else { Leaf::Floating };
    Item { label, cell: [x, y, 0], state: Litter { position, state, moved: false, ages: [0; 3] } }
}

fn main() -> ExitCode {
    xca_run::main_of!("pond", "Rain on rock and soil", |_given| {
        let weather = Weather {
            raining: true,
            source: Ground::Rock,
            rain: 0.002,
            shares: [0.1, 0.1, 0.2, 0.1],
            soaked_after: 40,
        };
        let model = Model::builder("pond")
            .extents([48, 32, 1])
            .neighbourhood(Neighbourhood::von_neumann_2d(1))
            .boundaries([Boundary::Toroidal, Boundary::Toroidal, Boundary::Flat])
            .substates::<Pond>()
            .population::<Litter>(4)
            .parameters(weather)
            .process(flow)
            .process(level)
            .process(drift)
            .process(reassign)
            .fill(|site| Pond {
                ground: ground(site),
                wet: false,
                depth: 0.0,
                outflow: [0.0; 4],
                currents: [Vector2::default(); 2],
            })
            .initialise(|state| Ok(state.set_items((0..32).map(leaf).collect())?))
            .build()?;
        let earth =
            [(Ground::Rock, [150, 150, 150]), (Ground::Soil, [222, 200, 150]), (Ground::Mud, [110, 70, 40])];
        let cells = CellView::named("pond").colours(Pond::GROUND, &earth);
        let leaves = ItemView::named("leaves").colour(Litter::STATE, "leaves");
        Ok(SetUp::new(model, 100).cells(cells).items(leaves))
    })
}
