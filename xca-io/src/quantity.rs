//! What the values of a raster are.

/// What the values of a raster are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Quantity {
    /// Any number.
    Any,
    /// An altitude or a thickness, in metres.
    Height,
}
