//! The little vector algebra that the particle code needs.

/// A vector of three components: x, y, z.
pub type Vector = [f64; 3];

/// The scalar product.
pub(super) fn dot(one: Vector, other: Vector) -> f64 {
    one[0] * other[0] + one[1] * other[1] + one[2] * other[2]
}

/// `one` - `other`.
pub(super) fn difference(one: Vector, other: Vector) -> Vector {
    [one[0] - other[0], one[1] - other[1], one[2] - other[2]]
}

/// `sum` += `factor` * `term`.
pub(super) fn add_scaled(sum: &mut Vector, factor: f64, term: Vector) {
    for (component, addend) in sum.iter_mut().zip(term) {
        *component += factor * addend;
    }
}
