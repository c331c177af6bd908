//! The direction of view, and the camera.

use super::PictureError;

/// The direction from which a box is seen, in degrees.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Viewpoint {
    /// The direction of the viewer in the horizontal plane, from the x axis towards the y axis.
    pub azimuth: f64,
    /// The elevation of the viewer above that plane, from -89 to 89.
    pub elevation: f64,
}

impl Default for Viewpoint {
    /// From the front and above: x runs to the right, y away from the viewer.
    fn default() -> Self {
        Self { azimuth: -62.0, elevation: 24.0 }
    }
}

/// A pinhole camera. Points are 3-vectors in a space where the box has its centre at the origin and a
/// diagonal of 1.
#[derive(Debug, Clone)]
pub(super) struct Camera {
    pub(super) right: [f32; 3],
    pub(super) up: [f32; 3],
    pub(super) forward: [f32; 3],
    pub(super) eye: [f32; 3],
    /// The number of pixels for a tangent of 1.
    pub(super) focal: f32,
    /// The pixel in the direction of sight.
    pub(super) centre: [f32; 2],
}

impl Camera {
    /// A camera that fits `points` into the rectangle of pixels from `low` to `high`.
    pub(super) fn fit(
        viewpoint: Viewpoint,
        points: &[[f32; 3]],
        low: [f32; 2],
        high: [f32; 2],
    ) -> Result<Self, PictureError> {
        const DISTANCE: f32 = 3.0;
        for (what, value) in
            [("the azimuth of the eye", viewpoint.azimuth), ("the elevation of the eye", viewpoint.elevation)]
        {
            if !value.is_finite() {
                return Err(PictureError::Geometry { what, value });
            }
        }
        let (sin, cos) = viewpoint.azimuth.to_radians().sin_cos();
        let (lift, flat) = viewpoint.elevation.clamp(-89.0, 89.0).to_radians().sin_cos();
        let back = [cos * flat, sin * flat, lift].map(|x| x as f32);
        let right = [-sin as f32, cos as f32, 0.0];
        let mut camera = Self {
            right,
            up: cross(back, right),
            forward: back.map(|x| -x),
            eye: back.map(|x| DISTANCE * x),
            focal: 1.0,
            centre: [0.0; 2],
        };
        let (mut least, mut most) = ([f32::MAX; 2], [f32::MIN; 2]);
        for &point in points {
            let seen = camera.project(point);
            for i in 0..2 {
                least[i] = least[i].min(seen[i]);
                most[i] = most[i].max(seen[i]);
            }
        }
        let fitting = |i: usize| (high[i] - low[i]) / (most[i] - least[i]).max(1e-6);
        camera.focal = fitting(0).min(fitting(1));
        camera.centre =
            std::array::from_fn(|i| (low[i] + high[i]) / 2.0 - camera.focal * (least[i] + most[i]) / 2.0);
        Ok(camera)
    }

    /// The same view with `factor` times as many pixels in each direction.
    pub(super) fn magnified(&self, factor: f32) -> Self {
        Self { focal: self.focal * factor, centre: self.centre.map(|x| x * factor), ..self.clone() }
    }

    /// The pixel of a point, and its depth along the line of sight.
    pub(super) fn project(&self, point: [f32; 3]) -> [f32; 3] {
        let p = sub(point, self.eye);
        let depth = dot(p, self.forward).max(1e-3);
        let scale = self.focal / depth;
        [self.centre[0] + scale * dot(p, self.right), self.centre[1] - scale * dot(p, self.up), depth]
    }

    /// The direction of a pixel, of length 1 along the line of sight. The point at depth `d` is `eye + d *
    /// ray`.
    pub(super) fn ray(&self, x: f32, y: f32) -> [f32; 3] {
        let (u, v) = ((x - self.centre[0]) / self.focal, (self.centre[1] - y) / self.focal);
        std::array::from_fn(|i| self.forward[i] + u * self.right[i] + v * self.up[i])
    }
}

pub(super) fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn sub(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// `a + s * b`
pub(super) fn along(a: [f32; 3], s: f32, b: [f32; 3]) -> [f32; 3] {
    [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]]
}

pub(super) fn cross(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(super) fn unit(a: [f32; 3]) -> [f32; 3] {
    let length = dot(a, a).sqrt().max(f32::MIN_POSITIVE);
    a.map(|x| x / length)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn corners() -> Vec<[f32; 3]> {
        let s = 1.0 / 12.0_f32.sqrt();
        (0..8).map(|i| std::array::from_fn(|axis| if i >> axis & 1 == 1 { s } else { -s })).collect()
    }

    fn camera() -> Camera {
        Camera::fit(Viewpoint::default(), &corners(), [50.0, 80.0], [450.0, 380.0]).unwrap()
    }

    #[test]
    fn the_box_fills_the_rectangle_and_no_more() {
        let seen: Vec<[f32; 3]> = corners().iter().map(|&c| camera().project(c)).collect();
        let bounds = |i: usize| {
            seen.iter().fold((f32::MAX, f32::MIN), |(low, high), p| (low.min(p[i]), high.max(p[i])))
        };
        let ((left, right), (top, bottom)) = (bounds(0), bounds(1));
        assert!(left > 49.9 && right < 450.1 && top > 79.9 && bottom < 380.1);
        assert!((right - left - 400.0).abs() < 0.1 || (bottom - top - 300.0).abs() < 0.1);
        assert!((left + right - 500.0).abs() < 0.1 && (top + bottom - 460.0).abs() < 0.1);
    }

    #[test]
    fn x_runs_right_y_away_and_z_up() {
        let camera = camera();
        let o = camera.project([0.0; 3]);
        assert!(camera.project([0.1, 0.0, 0.0])[0] > o[0]);
        assert!(camera.project([0.0, 0.1, 0.0])[2] > o[2]);
        let z = camera.project([0.0, 0.0, 0.1]);
        assert!(z[1] < o[1] && (z[0] - o[0]).abs() < 1e-3);
    }

    #[test]
    fn a_ray_goes_through_the_point_that_is_seen_there() {
        let camera = camera().magnified(2.0);
        let point = [0.11, -0.2, 0.05];
        let [x, y, depth] = camera.project(point);
        let back = along(camera.eye, depth, camera.ray(x, y));
        assert!((0..3).all(|i| (back[i] - point[i]).abs() < 1e-5), "{back:?}");
    }
}
