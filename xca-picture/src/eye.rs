//! The view of pictures in three dimensions.

/// The position of the viewer, and the projection to pixels.
pub(super) struct Eye {
    right: [f64; 3],
    up: [f64; 3],
    /// The direction of sight.
    pub(super) forward: [f64; 3],
    /// The side of a cell in pixels.
    pub(super) scale: f64,
    /// The pixel of the middle of the block.
    pub(super) centre: [f64; 2],
}

impl Eye {
    /// The isometric view: x to the right, y away from the viewer, z up, all equally foreshortened.
    pub(super) fn new(extents: [f64; 3], low: [f64; 2], high: [f64; 2]) -> Self {
        let [two, three, six] = [2.0_f64, 3.0, 6.0].map(f64::sqrt);
        let right = [1.0 / two, 1.0 / two, 0.0];
        let up = [-1.0 / six, 1.0 / six, 2.0 / six];
        let forward = [-1.0 / three, 1.0 / three, -1.0 / three];
        let reach = |axis: [f64; 3]| (0..3).map(|i| axis[i].abs() * extents[i]).sum::<f64>();
        let scale = ((high[0] - low[0]) / reach(right)).min((high[1] - low[1]) / reach(up));
        Self { right, up, forward, scale, centre: [(low[0] + high[0]) / 2.0, (low[1] + high[1]) / 2.0] }
    }

    /// The pixel of a point. The point is relative to the middle of the block.
    pub(super) fn project(&self, point: [f64; 3]) -> [f64; 2] {
        let along = |axis: [f64; 3]| (0..3).map(|i| axis[i] * point[i]).sum::<f64>();
        [self.centre[0] + self.scale * along(self.right), self.centre[1] - self.scale * along(self.up)]
    }

    /// The point of a pixel, in the plane through the middle of the block.
    pub(super) fn point(&self, x: f64, y: f64) -> [f64; 3] {
        let (u, v) = ((x - self.centre[0]) / self.scale, (self.centre[1] - y) / self.scale);
        std::array::from_fn(|i| u * self.right[i] + v * self.up[i])
    }
}
