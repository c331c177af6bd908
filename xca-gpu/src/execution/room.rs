//! Room for the items that there are.

use super::{GpuExecution, memory::records};
use crate::device::DeviceError;
use crate::groups::JOURNAL;
use crate::program::Program;
use xca_core::ProcessKind;

impl GpuExecution {
    /// Tells the device and all that is bound how many items a population has now.
    pub(crate) fn items_changed(&mut self, group: usize) -> Result<(), DeviceError> {
        let items = self.groups.items(group);
        for migration in self.migrations.iter_mut().filter(|migration| migration.group() == group) {
            migration.make_room(&self.device, items)?;
        }
        let (groups, model) = (&self.groups, &self.model);
        let of = |program: &Program| program.population(model).map_or(0, |group| groups.items(group));
        let records = records(&self.space, &self.programs, of);
        self.groups.make_room(&self.device, records)?;
        self.services.forget();
        self.programs.iter_mut().for_each(Program::forget);
        self.try_bindings(group)?;
        let journal = (group as u64 + 1) * JOURNAL;
        self.device.upload(self.groups.journals(), journal + 8, bytemuck::bytes_of(&(items as u32)))
    }

    /// Binds all that works on a population, so that what cannot be bound is told before the first step.
    fn try_bindings(&mut self, group: usize) -> Result<(), DeviceError> {
        let mut never_submitted = self.device.recorder();
        for index in 0..self.programs.len() {
            let program = &mut self.programs[index];
            if program.population(&self.model) != Some(group) {
                continue;
            }
            program.dispatches(&self.device, &self.model, &self.space, &self.groups)?;
            if program.process.kind == ProcessKind::Migration {
                self.record_migration(&mut never_submitted, index)?;
            }
        }
        Ok(())
    }
}
