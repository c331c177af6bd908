use super::{Balance, Balancer, Cost};
use crate::cut::Cut;
use crate::grid::Grid;
use std::num::NonZeroU64;
use xca_core::engine::RowWork;
use xca_core::prelude::*;

#[derive(Substates, Clone)]
struct Ground {
    worn: u32,
}

#[derive(Substates, Clone)]
struct Walker {
    steps: u32,
}

#[elementary_process]
fn rest(ground: &mut Cell<Ground>) {
    ground.worn += 1;
}

#[elementary_process]
fn walk(walker: &mut Slot<Walker>) {
    walker.steps += 1;
}

/// Eight rows of ten cells.
fn model() -> Model {
    let builder = Model::builder("walkers").extents([10, 8, 1]).substates::<Ground>();
    builder.population::<Walker>(4).process((rest, walk)).build().unwrap()
}

const EVERY: u64 = 4;

/// A move costs 3 runs on each of 80 cells.
const COST: Cost = Cost { cells: 80, items: 0 };
const MOVE: u64 = 3 * 80;

/// A balancer of two parts after its first step, and its cut.
fn settled() -> (Model, Balancer, Cut) {
    let model = model();
    let balance = Balance { every: NonZeroU64::new(EVERY), cost: 3 };
    let mut balancer = Balancer::new(&model, balance);
    let cut = Cut::even(model.geometry(), Grid { y: 2, z: 1 });
    assert_eq!(balancer.steps_left(), 1);
    balancer.stepped(1);
    assert_eq!(balancer.look(&model, &cut, &work([0; 8]), COST), None);
    (model, balancer, cut)
}

/// Work on cells of rows.
fn work(rows: [u64; 8]) -> RowWork {
    RowWork { cells: rows.into(), items: vec![0; 8] }
}

/// How many looks it takes until the bounds move, of a hundred, with this work before each.
fn looks(work_before: impl Fn(u64) -> [u64; 8]) -> Option<u64> {
    let (model, mut balancer, cut) = settled();
    let mut sum = [0; 8];
    (1..=100).find(|number| {
        assert_eq!(balancer.steps_left(), EVERY);
        balancer.stepped(EVERY);
        assert_eq!(balancer.steps_left(), 0);
        sum.iter_mut().zip(work_before(*number)).for_each(|(sum, more)| *sum += more);
        balancer.look(&model, &cut, &work(sum), COST).is_some()
    })
}

/// All work is in four rows of the first part. The best cut halves it: 20 of 40 are lost before each look.
#[test]
fn bounds_move_once_the_losses_pay_for_it() {
    assert_eq!(looks(|_| [10, 10, 10, 10, 0, 0, 0, 0]), Some(MOVE / 20));
    assert_eq!(looks(|_| [20, 20, 20, 20, 0, 0, 0, 0]), Some(MOVE / 40));
    assert_eq!(looks(|_| [0, 0, 0, 0, 0, 0, 10 * MOVE, 10 * MOVE]), Some(1));
    // A single row cannot be cut, so nothing is lost.
    assert_eq!(looks(|_| [50, 0, 0, 0, 0, 0, 0, 0]), None);
}

#[test]
fn a_small_or_short_imbalance_moves_nothing() {
    // 42 against 40, for which nothing is better than 41.
    assert_eq!(looks(|_| [12, 10, 10, 10, 10, 10, 10, 10]), None);
    // It ends before it has lost enough, again and again.
    let comes_and_goes = |number: u64| {
        if number.is_multiple_of(MOVE / 20) { [5; 8] } else { [10, 10, 10, 10, 0, 0, 0, 0] }
    };
    assert_eq!(looks(comes_and_goes), None);
}

/// The first step works on all cells: it is no sign, neither at the start nor after a move.
#[test]
fn the_first_step_does_not_count() {
    let (model, mut balancer, cut) = settled();
    balancer.moved();
    assert_eq!(balancer.steps_left(), 1);
    balancer.stepped(1);
    let rows = [10 * MOVE, 10 * MOVE, 0, 0, 0, 0, 0, 0];
    assert_eq!(balancer.look(&model, &cut, &work(rows), COST), None);
    balancer.stepped(EVERY);
    assert_eq!(balancer.look(&model, &cut, &work(rows), COST), None);
    let figures = balancer.figures(model.geometry(), &cut, &work(rows));
    // All work is in one of two parts.
    assert_eq!(figures, [("bounds_moved".to_owned(), 1.0), ("imbalance".to_owned(), 2.0)]);
}

/// Items in the first rows count as the work of as many steps as lie between two looks.
#[test]
fn items_that_are_set_are_work_to_be_expected() {
    let (model, mut balancer, cut) = settled();
    let heap = |balancer: &mut Balancer, items: usize, moved: u64| {
        balancer.set(1, &[items, items, 0, 0, 0, 0, 0, 0]);
        balancer.expect(&model, &cut, Cost { items: moved, ..COST })
    };
    // The bounds have just moved.
    assert_eq!(heap(&mut balancer, 100, 0), None);
    balancer.stepped(EVERY);
    // An item is worth 16 cells. In four steps, each row has 40 runs on cells, and the first two 384 more.
    // That is 928 in the first half. Behind the first row it is 664, so 264 are lost.
    assert_eq!(heap(&mut balancer, 6, 0).unwrap().part(0).y, 0..1);
    // With five items 200 are lost, which is less than a move costs.
    assert_eq!(heap(&mut balancer, 5, 0), None);
    // Moving an item costs as much as moving four cells.
    assert!(heap(&mut balancer, 6, 2).is_some());
    assert_eq!(heap(&mut balancer, 6, 3), None);
    // Nothing was set since.
    assert_eq!(balancer.expect(&model, &cut, COST), None);
    balancer.set(1, &[100, 100, 0, 0, 0, 0, 0, 0]);
    balancer.stepped(1);
    assert_eq!(balancer.expect(&model, &cut, COST), None);
}

#[test]
fn without_counts_or_balance_nothing_moves() {
    let (model, mut balancer, cut) = settled();
    balancer.stepped(EVERY);
    assert_eq!(balancer.look(&model, &cut, &RowWork::default(), COST), None);
    assert_eq!(balancer.figures(model.geometry(), &cut, &RowWork::default()).len(), 1);
    let mut never = Balancer::new(&model, Balance::NEVER);
    never.stepped(1000);
    never.set(1, &[1000, 1000, 0, 0, 0, 0, 0, 0]);
    assert_eq!((never.steps_left(), never.expect(&model, &cut, COST)), (u64::MAX, None));
}
