use xca_core::prelude::*;

mod confusing {
    pub type Real = f32;
}

#[derive(Substates, Clone, Copy)]
struct Heat {
    warm: confusing::Real,
}

#[derive(Substates, Clone, Copy)]
struct Land {
    height: f32,
}

mod aliases {
    use super::Land;
    use xca_core::prelude::*;

    type i32 = f64;

    #[elementary_process]
    fn lift(cell: &mut Cell<Land>) {
        let number: i32 = 1.0;
        let (pair, _): (i32, u32) = (2.0, 3);
        cell.height = (number + pair) as f32;
    }
}

fn main() {}
