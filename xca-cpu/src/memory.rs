//! The memory of a model, computed before allocation.

use crate::layout::Layout;
use xca_core::engine::{StartError, SubstateId};
use xca_core::model::{Group, GroupKind};
use xca_core::{Model, Precision, StoredType};

/// # Errors
/// If the state is larger than the memory of any machine.
pub(crate) fn check_size(model: &Model, layout: &Layout, precision: Precision) -> Result<(), StartError> {
    let too_large = |what: &str, wanted: u128, limit: u128| StartError::TooLarge {
        engine: "cpu".to_owned(),
        what: what.to_owned(),
        wanted,
        limit,
    };
    let cells = layout.checked_cells().unwrap_or(usize::MAX) as u128;
    let bytes = least_memory(model, layout, precision).max(cells);
    if bytes > 1 << 45 { Err(too_large("the bytes of the state", bytes, 1 << 45)) } else { Ok(()) }
}

/// The size of a model without items, in bytes: planes, some of them doubled, and the item ranges of cells
/// and rows.
pub(crate) fn least_memory(model: &Model, layout: &Layout, precision: Precision) -> u128 {
    let is_population = |group: &&Group| matches!(group.kind(), GroupKind::Population { .. });
    let rows = model.groups().iter().filter(is_population).count() * layout.rows() * 2 * size_of::<u32>();
    let cells = layout.checked_cells().unwrap_or(usize::MAX) as u128;
    cells * bytes_per_cell(model, precision) as u128 + rows as u128
}

/// The bytes per padded cell.
pub(crate) fn bytes_per_cell(model: &Model, precision: Precision) -> usize {
    let of_field = |group: usize, (field, stored): (usize, StoredType)| {
        let planes = if model.plan().is_doubled(SubstateId { group, field }) { 2 } else { 1 };
        planes * stored.size()
    };
    let of_group = |(number, group): (usize, &Group)| match group.kind() {
        GroupKind::Cells { .. } => {
            group.stored(precision).into_iter().enumerate().map(|field| of_field(number, field)).sum()
        }
        GroupKind::Population { .. } => 2 * size_of::<u32>(),
    };
    model.groups().iter().enumerate().map(of_group).sum::<usize>()
}
