//! What stopped a run, as the device noted it.

use crate::device::DeviceError;
use crate::execution::GpuExecution;
use xca_core::engine::Fault;
use xca_core::kernel::{BEYOND_NEIGHBOURHOOD, NOWHERE, OUTSIDE, RowFault, StoppedAt};
use xca_core::{Precision, ProcessKind};
use xca_wgsl::{Content, Dispatch, FaultKind};

impl GpuExecution {
    /// The fault of a process, from the cause and the cell or item that the device noted; of a migration, the
    /// item's label, cell and destination, or the number of items in the cell.
    pub(crate) fn fault(
        &self,
        process: usize,
        cause: u32,
        at: u32,
        [label, home, destination, count]: [u32; 4],
    ) -> Result<Fault, DeviceError> {
        match cause {
            0 => self.reported(process, at),
            1 => Ok(self.aimed(process, [label, home, destination])),
            _ => Ok(self.full(process, at, count)),
        }
    }

    /// The record that the workgroup of the cell or item wrote.
    fn reported(&self, index: usize, at: u32) -> Result<Fault, DeviceError> {
        let program = &self.programs[index];
        let workgroup = match program.shader.dispatch {
            Dispatch::Items(size) => u64::from(at / size),
            Dispatch::Cells(size) => {
                let cell = self.space.geometry().indices(at as usize);
                let section = self.space.section_of(cell);
                let [x, y, z] = std::array::from_fn(|axis| {
                    let first = section.map_or(0, |section| section.first[axis]);
                    (cell[axis] - first) as u64 / u64::from(size[axis])
                });
                let [width, height, _] =
                    section.map_or([1; 3], |section| section.workgroups(size)).map(u64::from);
                (z * height + y) * width + x
            }
        };
        let layout = program.shader.bindings.iter().find_map(|binding| match &binding.content {
            Content::Faults(layout) => Some(layout),
            _ => None,
        });
        let size = layout.map_or(0, |layout| u64::from(layout.size));
        let start = 8 + workgroup * size;
        let bytes = self.device.download(self.groups.faults(), start..start + size)?;
        let field = |name: &str| {
            let offset =
                layout.and_then(|layout| layout.field(name)).map_or(0, |field| field.offset as usize);
            bytes.get(offset..).unwrap_or_default()
        };
        let word = |name: &str| field(name).first_chunk().map_or(0, |bytes| u32::from_ne_bytes(*bytes));
        let (kind, cell, number) = (FaultKind::from_number(word("kind")), word("cell"), word("number"));
        let label = Some(word("label")).filter(|_| program.process.kind != ProcessKind::Cells);
        let (process, geometry) = (&program.process, self.space.geometry());
        if let Some(message) = kind.and_then(|kind| kind.panic_message(number, word("limit"))) {
            return Ok(Fault::panicked(process, StoppedAt { cell, label }, &message, geometry));
        }
        if kind == Some(FaultKind::BeyondNeighbourhood) {
            let fault = RowFault { cell, label, code: BEYOND_NEIGHBOURHOOD, value: number.into() };
            return Ok(Fault::reported(process, fault, geometry));
        }
        let value = match self.manner.precision {
            Precision::F32 => {
                field("value").first_chunk().map_or(0.0, |bytes| f32::from_ne_bytes(*bytes).into())
            }
            Precision::F64 => field("value").first_chunk().map_or(0.0, |bytes| f64::from_ne_bytes(*bytes)),
        };
        Ok(Fault::reported(process, RowFault { cell, label, code: number, value }, geometry))
    }

    /// An item that was sent where it cannot go.
    fn aimed(&self, index: usize, [label, cell, destination]: [u32; 3]) -> Fault {
        let process = self.programs[index].process.name;
        let cell = self.space.cell(cell as usize);
        match destination {
            NOWHERE => Fault::Nowhere { process, label, cell },
            OUTSIDE => Fault::Left { process, label, cell },
            there => {
                let to = self.space.geometry().indices(there as usize);
                Fault::TooFar { process, label, from: cell, to }
            }
        }
    }

    /// A cell with too many items.
    fn full(&self, index: usize, cell: u32, items: u32) -> Fault {
        let program = &self.programs[index];
        let population = program.population(&self.model).and_then(|group| self.groups.population(group));
        let slots = population.map_or(0, |population| population.slots);
        let (process, cell) = (Some(program.process.name), self.space.cell(cell as usize));
        Fault::CellFull { process, cell, items: items as usize, slots }
    }
}
