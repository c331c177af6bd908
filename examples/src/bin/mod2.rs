//! The parity rule in three dimensions, which copies whatever it starts from.
//!
//! A cell becomes the sum, modulo 2, of the 27 cells of its Moore neighbourhood, itself among them. The rule
//! is linear over the field of two elements, where (a + b)^2 = a^2 + b^2. So 2^k steps at once are one step
//! of the same rule with the neighbours 2^k cells away: the state is then 27 copies of the initial figure,
//! shifted by 0 or 2^k cells either way along each axis. On a torus of 2^m cells the copies meet after
//! 2^(m-1) steps, cancel in pairs, and leave the figure as it was.
use xca_run::prelude::*;

#[derive(Substates, Clone)]
struct Parity {
    odd: u8,
}

#[elementary_process]
fn add_up(cell: &mut Cell<Parity>) {
    let mut sum = 0;
    for n in 0..cell.neighbour_count() {
        sum += cell.neighbour(n).odd;
    }
    cell.odd = sum % 2;
}

/// The initial figure, from the middle of the space: a bent rod with a foot, unlike its mirror images.
const FIGURE: [[usize; 3]; 6] = [[0, 0, 0], [1, 0, 0], [2, 0, 0], [2, 1, 0], [2, 1, 1], [0, 0, 1]];

#[derive(Args)]
struct Mod2 {
    /// Cells along each side of the torus; a power of 2 brings the figure back
    #[arg(long, value_name = "N", default_value_t = 64, value_parser = whole_number)]
    size: usize,
}

impl Program for Mod2 {
    const NAME: &'static str = "mod2";
    const ABOUT: &'static str = "The parity rule in 3D, which copies whatever it starts from";
    const EXAMPLES: &'static str = "--steps 32\n--size 128 --steps 48 --every 1";

    fn set_up(&self, _given: Given) -> Result<SetUp, Failure> {
        let middle = self.size / 2;
        let model = Model::builder("mod2")
            .extents([self.size; 3])
            .neighbourhood(Neighbourhood::moore(1))
            .boundary(Boundary::Toroidal)
            .substates::<Parity>()
            .process(add_up)
            .fill(move |site| Parity {
                odd: u8::from(FIGURE.contains(&site.cell().map(|index| index.wrapping_sub(middle)))),
            })
            .build()?;
        let observe =
            |state: &State<'_>| Ok(vec![Observable::number("odd_cells", state.sum(Parity::ODD)? as f64)]);
        Ok(SetUp::new(model, 16).observables(observe))
    }
}

fn main() -> ExitCode {
    xca_run::main!(Mod2)
}
