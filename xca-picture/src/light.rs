//! Light and shadow on spheres.

use super::depth::{DepthBuffer, Disc};
use super::view::{Camera, along, cross, dot, unit};

/// A distant lamp at the upper left of the viewer, with the shadows of the spheres.
pub(super) struct Light {
    /// The direction to the lamp.
    direction: [f32; 3],
    right: [f32; 3],
    up: [f32; 3],
    /// The spheres as seen from the lamp.
    shadows: DepthBuffer,
    /// The samples of the shadows per unit of length.
    scale: f32,
    radius: f32,
}

/// A surface under the lamp.
#[derive(Debug, Clone, Copy)]
pub(super) struct Surface {
    pub(super) at: [f32; 3],
    pub(super) normal: [f32; 3],
    /// The albedo in linear RGB.
    pub(super) albedo: [f32; 3],
    /// The share of the sky that is open.
    pub(super) open: f32,
    /// The strength of the gloss.
    pub(super) gloss: f32,
}

impl Light {
    /// A lamp above `camera` for spheres in a space with its centre at the origin and a diagonal of 1.
    pub(super) fn new(camera: &Camera, spheres: &[[f32; 3]], radius: f32) -> Self {
        const SIZE: usize = 2048;
        let flat = unit([camera.forward[0], camera.forward[1], 0.0]);
        let direction = unit(along(along([0.0, 0.0, 1.0], -0.42, camera.right), -0.38, flat));
        let right = unit(cross([0.0, 1.0, 0.0], direction));
        let up = cross(direction, right);
        let scale = SIZE as f32 / 1.1;
        let mut light = Self { direction, right, up, shadows: DepthBuffer::new(SIZE, SIZE), scale, radius };
        for (owner, &sphere) in (0..).zip(spheres) {
            let (at, depth) = light.project(sphere);
            light.shadows.draw(Disc { at, radius: radius * scale, depth, thickness: radius }, owner);
        }
        light
    }

    fn project(&self, p: [f32; 3]) -> ([f32; 2], f32) {
        let middle = self.shadows.width as f32 / 2.0;
        let at = [middle + self.scale * dot(p, self.right), middle - self.scale * dot(p, self.up)];
        (at, -dot(p, self.direction))
    }

    /// The share of the light that reaches a point, from 0 to 1, with a soft edge.
    fn reaching(&self, p: [f32; 3]) -> f32 {
        let ([x, y], depth) = self.project(p);
        let depth = depth - 0.4 * self.radius;
        let spread = (0.22 * self.radius * self.scale).clamp(1.0, 4.0);
        let mut open = 0.0;
        for (j, down) in [(-1.0, 1.0), (0.0, 2.0), (1.0, 1.0)] {
            for (i, across) in [(-1.0, 1.0), (0.0, 2.0), (1.0, 1.0)] {
                let place = |at: f32, k: f32| (at + k * spread) as i64;
                let weight = down * across;
                open += if self.shadows.depth_near(place(x, i), place(y, j)) >= depth { weight } else { 0.0 };
            }
        }
        open / 16.0
    }

    /// The light from `surface` in the direction `to_eye`, in linear RGB.
    pub(super) fn shade(&self, surface: &Surface, to_eye: [f32; 3]) -> [f32; 3] {
        let Surface { at, normal, albedo, open, gloss } = *surface;
        let facing = dot(normal, self.direction);
        let reaching = if facing > 0.0 { self.reaching(along(at, 0.15 * self.radius, normal)) } else { 0.0 };
        // A bright sky, and a ground that reflects some of it.
        let sky = 0.36 + 0.16 * normal[2];
        let diffuse = sky * open + 0.72 * facing.max(0.0) * reaching * (0.55 + 0.45 * open);
        let halfway = unit(along(self.direction, 1.0, to_eye));
        let shine = gloss * reaching * dot(normal, halfway).max(0.0).powi(36);
        albedo.map(|x| x * diffuse + shine)
    }
}

#[cfg(test)]
mod tests {
    use super::super::view::Viewpoint;
    use super::*;

    #[test]
    fn a_sphere_shades_what_lies_behind_it_and_only_that() {
        let points = [[-0.3; 3], [0.3; 3]];
        let camera = Camera::fit(Viewpoint::default(), &points, [0.0; 2], [100.0; 2]).unwrap();
        let light = Light::new(&camera, &[[0.0; 3]], 0.05);
        let behind = along([0.0; 3], -0.2, light.direction);
        let beside = along(behind, 0.1, light.right);
        let above = along([0.0; 3], 0.2, light.direction);
        assert_eq!(light.reaching(behind), 0.0);
        assert_eq!(light.reaching(beside), 1.0);
        assert_eq!(light.reaching(above), 1.0);
        // The side of the sphere that faces the lamp is not in its own shadow.
        assert_eq!(light.reaching(along([0.0; 3], 0.05, light.direction)), 1.0);
        let surface = |at| Surface { at, normal: light.direction, albedo: [0.5; 3], open: 1.0, gloss: 0.0 };
        let to_eye = camera.forward.map(|x| -x);
        assert!(light.shade(&surface(behind), to_eye)[0] < 0.5 * light.shade(&surface(beside), to_eye)[0]);
        // The lamp is above the ground, on the side of the viewer.
        assert!(light.direction[2] > 0.5 && dot(light.direction, camera.forward) < 0.0);
    }
}
