// Sources: cells with two indices, a value of another type, a substate by its field.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Lava {
    litres: i32,
}

fn main() {
    let builder = || Model::builder("lava").substates::<Lava>();
    let _ = builder().steer(Schedule::Every(1), |state| {
        Ok(state.update(Lava::LITRES, &[[1, 2]], |_cell, litres| litres + 1)?)
    });
    let _ = builder().steer(Schedule::Every(1), |state| {
        Ok(state.update(Lava::LITRES, &[[1, 2, 0]], |_cell, litres| litres + 0.5)?)
    });
    let _ = builder().steer(Schedule::Every(1), |state| Ok(state.set(Lava::litres, [1, 2, 0], 3)?));
    let _ = builder().steer(Every(1), |state| Ok(state.set(Lava::LITRES, [1, 2, 0], 3)?));
}
