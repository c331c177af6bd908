//! A landslide with active cells by hand: a list of the cells with debris that can move, on one thread.

use std::error::Error;
use xca_core::prelude::*;
use xca_examples::models::landslide::{Debris, Slope};

const SIDES: usize = 4;

/// A slope within a frame of cells without ground.
pub(super) struct ActiveCells {
    debris: Debris,
    /// The columns of the slope.
    columns: usize,
    altitude: Vec<f64>,
    thickness: Vec<f64>,
    outflow: Vec<[f64; SIDES]>,
    is_ground: Vec<bool>,
    is_active: Vec<bool>,
    active: Vec<usize>,
    /// From a cell to its neighbours, in the order of the model.
    neighbours: [isize; SIDES],
}

impl ActiveCells {
    /// The slope as it is in a state.
    pub(super) fn new(state: &State<'_>, debris: Debris) -> Result<Self, Box<dyn Error>> {
        let [columns, rows, _] = state.geometry().extents();
        let (width, cells) = (columns + 2, (columns + 2) * (rows + 2));
        let framed = |values: Vec<f64>| {
            let mut framed = vec![0.0; cells];
            for (row, values) in values.chunks_exact(columns).enumerate() {
                let first = (row + 1) * width + 1;
                framed[first..first + columns].copy_from_slice(values);
            }
            framed
        };
        let ground =
            state.read(Slope::IS_GROUND)?.into_iter().map(|is_ground| f64::from(u8::from(is_ground)));
        let thickness = framed(state.read(Slope::THICKNESS)?);
        let is_active: Vec<bool> = thickness.iter().map(|metres| *metres > debris.adherence).collect();
        let offset = |[x, y, _]: [i32; 3]| x as isize + y as isize * width as isize;
        let displacements = state.geometry().neighbourhood().displacements([0; 3]);
        let neighbours: Vec<isize> = displacements.iter().skip(1).map(|one| offset(*one)).collect();
        Ok(Self {
            debris,
            columns,
            altitude: framed(state.read(Slope::ALTITUDE)?),
            outflow: vec![[0.0; SIDES]; cells],
            is_ground: framed(ground.collect()).into_iter().map(|ground| ground > 0.0).collect(),
            active: (0..cells).filter(|cell| is_active[*cell]).collect(),
            thickness,
            is_active,
            neighbours: neighbours.try_into().map_err(|_| "other neighbours than four")?,
        })
    }

    /// The thickness of each cell of the slope, in m.
    pub(super) fn thickness(&self) -> Vec<f64> {
        let width = self.columns + 2;
        let rows = self.thickness.chunks_exact(width);
        let rows = rows.skip(1).take(self.thickness.len() / width - 2);
        rows.flat_map(|row| &row[1..=self.columns]).copied().collect()
    }

    /// A step: debris flows from the active cells, cells that it reaches become active, and those whose
    /// debris cannot move any more do not stay so.
    pub(super) fn step(&mut self) {
        for index in 0..self.active.len() {
            self.flow(self.active[index]);
        }
        for cell in self.active.iter().copied() {
            let (mut gone, mut come) = (0.0, 0.0);
            for (side, neighbour) in self.neighbours.iter().enumerate() {
                gone += self.outflow[cell][side];
                // The neighbours come in opposite pairs, from both ends.
                come += self.outflow[cell.wrapping_add_signed(*neighbour)][SIDES - 1 - side];
            }
            self.thickness[cell] += come - gone;
        }
        let (outflow, is_active) = (&mut self.outflow, &mut self.is_active);
        self.active.retain(|cell| {
            outflow[*cell] = [0.0; SIDES];
            is_active[*cell] = self.thickness[*cell] > self.debris.adherence;
            is_active[*cell]
        });
    }

    fn flow(&mut self, cell: usize) {
        let Debris { adherence, rate } = self.debris;
        let mobile = self.thickness[cell] - adherence;
        if mobile <= 0.0 {
            return;
        }
        let mut heights = [self.altitude[cell] + adherence; SIDES + 1];
        let mut takes_part = [true; SIDES + 1];
        let around = self.neighbours.map(|neighbour| cell.wrapping_add_signed(neighbour));
        for (side, neighbour) in around.into_iter().enumerate() {
            heights[side + 1] = self.altitude[neighbour] + self.thickness[neighbour];
            takes_part[side + 1] = self.is_ground[neighbour];
        }
        let level = level(&heights, &mut takes_part, mobile);
        for (side, neighbour) in around.into_iter().enumerate() {
            if !takes_part[side + 1] {
                continue;
            }
            self.outflow[cell][side] = rate * (level - heights[side + 1]);
            if !self.is_active[neighbour] {
                self.is_active[neighbour] = true;
                self.active.push(neighbour);
            }
        }
    }
}

/// The common level of the places that take part in the end.
fn level(heights: &[f64; SIDES + 1], takes_part: &mut [bool; SIDES + 1], mobile: f64) -> f64 {
    loop {
        let (mut sum, mut count) = (mobile, 0.0);
        for (height, takes_part) in heights.iter().zip(&*takes_part) {
            if *takes_part {
                sum += height;
                count += 1.0;
            }
        }
        let level = sum / count;
        let mut is_settled = true;
        for (height, takes_part) in heights.iter().zip(&mut *takes_part) {
            if *takes_part && *height > level {
                *takes_part = false;
                is_settled = false;
            }
        }
        if is_settled {
            return level;
        }
    }
}
