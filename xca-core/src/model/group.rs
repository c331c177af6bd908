//! The substates of a model, by their structs.

use std::any::TypeId;
use std::fmt;
use std::sync::Arc;
use xca_process::Faces;
use xca_values::Schema;
use xca_values::{Precision, StoredType};

/// The substates of one struct, in a model.
#[derive(Clone)]
pub struct Group {
    pub(super) type_id: TypeId,
    /// With its path, for messages.
    pub(super) type_name: &'static str,
    pub(super) schema: &'static Schema,
    pub(super) kind: GroupKind,
}

/// Writes the value of the field with this number, in its stored type.
pub type WriteOutside = dyn Fn(usize, Precision, &mut [u8]) + Send + Sync;

/// The owners of a group's substates.
#[derive(Clone)]
pub enum GroupKind {
    /// The cells.
    Cells {
        /// Writes the outside value of a field, for each flat face.
        outside: Faces<Arc<WriteOutside>>,
    },
    /// The items of a population.
    Population {
        /// The most items in a cell.
        slots: usize,
        /// Whether a migration may send items out of the space.
        may_leave: bool,
    },
}

impl fmt::Debug for GroupKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Cells { .. } => f.write_str("Cells"),
            Self::Population { slots, may_leave } => {
                f.debug_struct("Population").field("slots", slots).field("may_leave", may_leave).finish()
            }
        }
    }
}

impl Group {
    /// The type of the struct.
    pub fn type_id(&self) -> TypeId {
        self.type_id
    }

    /// The fields.
    pub fn schema(&self) -> &'static Schema {
        self.schema
    }

    /// Whether the substates belong to cells or to a population.
    pub fn kind(&self) -> &GroupKind {
        &self.kind
    }

    /// The machine types of the fields.
    pub fn stored(&self, precision: Precision) -> Vec<StoredType> {
        self.schema.fields.iter().map(|field| field.value_type.stored(precision)).collect()
    }

    /// The sizes of the stored fields in bytes.
    pub fn sizes(&self, precision: Precision) -> Vec<usize> {
        self.stored(precision).into_iter().map(StoredType::size).collect()
    }

    /// The stored bytes of a field beyond each flat face. `None` for a population.
    pub fn outside(&self, field: usize, precision: Precision) -> Option<Faces<Vec<u8>>> {
        let GroupKind::Cells { outside } = &self.kind else { return None };
        let size = self.schema.fields[field].value_type.stored(precision).size();
        Some(outside.map(|write| {
            let mut bytes = vec![0; size];
            write(field, precision, &mut bytes);
            bytes
        }))
    }
}

impl fmt::Debug for Group {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Group").field("substates", &self.schema.name).field("kind", &self.kind).finish()
    }
}
