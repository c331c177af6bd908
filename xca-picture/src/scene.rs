//! Lit spheres in their box, on the ground.

use super::canvas::{Canvas, Strokes};
use super::colour::{encode, mix};
use super::depth::{DepthBuffer, Disc};
use super::light::{Light, Surface};
use super::view::{Camera, along, unit};

/// Samples per pixel in each direction.
const SAMPLES: usize = 2;
/// The least depth of drawn spheres. The box begins at more than 2.
const NEAREST: f32 = 1.5;

/// The scene, in a space where the box has its centre at the origin and a diagonal of 1.
pub(super) struct Scene<'a> {
    /// The camera, in pixels of the canvas.
    pub(super) camera: Camera,
    /// The centres of the spheres.
    pub(super) spheres: &'a [[f32; 3]],
    pub(super) radius: f32,
    /// The index into `palette` for each sphere.
    pub(super) colours: &'a [u16],
    /// The colours in linear RGB.
    pub(super) palette: &'a [[f32; 3]],
    /// The upper corner of the box. The lower corner is opposite.
    pub(super) corner: [f32; 3],
}

impl Scene<'_> {
    /// Draws the ground, the spheres and the edges of the box.
    pub(super) fn draw(&self, canvas: &mut Canvas) {
        let eye = self.camera.magnified(SAMPLES as f32);
        let mut buffer = DepthBuffer::new(canvas.width() * SAMPLES, canvas.height() * SAMPLES);
        for (owner, &sphere) in (0..).zip(self.spheres) {
            let disc = self.disc(&eye, sphere);
            // A sphere outside the box and close to the camera would cover everything.
            if disc.depth > NEAREST {
                buffer.draw(disc, owner);
            }
        }
        let light = Light::new(&self.camera, self.spheres, self.radius);
        let lit = Lit { scene: self, eye, buffer, light };
        for y in 0..canvas.height() {
            for x in 0..canvas.width() {
                canvas.set(x, y, encode(lit.pixel(x, y)));
            }
        }
        self.draw_edges(canvas, &lit.buffer);
    }

    fn disc(&self, eye: &Camera, sphere: [f32; 3]) -> Disc {
        let [x, y, depth] = eye.project(sphere);
        Disc { at: [x, y], radius: self.radius * eye.focal / depth, depth, thickness: self.radius }
    }

    /// A corner of the box. Bit `axis` of `index` is set at the upper end of the axis.
    pub(super) fn corner(&self, index: usize) -> [f32; 3] {
        std::array::from_fn(
            |axis| if index >> axis & 1 == 1 { self.corner[axis] } else { -self.corner[axis] },
        )
    }

    /// Whether the face of the box at the upper or lower end of `axis` is visible from outside.
    pub(super) fn faces_eye(&self, axis: usize, upper: bool) -> bool {
        let eye = self.camera.eye[axis];
        if upper { eye > self.corner[axis] } else { eye < -self.corner[axis] }
    }

    fn draw_edges(&self, canvas: &mut Canvas, buffer: &DepthBuffer) {
        for axis in 0..3 {
            for start in (0..8).filter(|start| start >> axis & 1 == 0) {
                // Two faces meet at the edge. The box hides the edge if both face away.
                let in_front = (0..3).filter(|&a| a != axis).any(|a| self.faces_eye(a, start >> a & 1 == 1));
                let (colour, strength, width) =
                    if in_front { ([0.20, 0.23, 0.29], 0.75, 1.3) } else { ([0.45, 0.48, 0.54], 0.60, 1.0) };
                let from = self.camera.project(self.corner(start));
                let to = self.camera.project(self.corner(start | 1 << axis));
                let edge = Strokes { segments: vec![[[from[0], from[1]], [to[0], to[1]]]], width };
                edge.cover(canvas.width(), canvas.height(), |x, y, cover| {
                    let depth = depth_on_line(from, to, [x as f32 + 0.5, y as f32 + 0.5]);
                    let seen = (0..SAMPLES * SAMPLES)
                        .filter(|sample| {
                            let (i, j) = (sample % SAMPLES, sample / SAMPLES);
                            depth < buffer.depth(x * SAMPLES + i, y * SAMPLES + j)
                        })
                        .count();
                    let share = seen as f32 / (SAMPLES * SAMPLES) as f32;
                    canvas.blend(x, y, colour, cover * share * strength);
                });
            }
        }
    }
}

/// The depth of the line from `a` to `b` (pixels and depth) next to the pixel `p`. On the screen, 1 / depth
/// is linear.
fn depth_on_line(a: [f32; 3], b: [f32; 3], p: [f32; 2]) -> f32 {
    let [dx, dy] = [b[0] - a[0], b[1] - a[1]];
    let length2 = (dx * dx + dy * dy).max(1e-6);
    let t = (((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / length2).clamp(0.0, 1.0);
    1.0 / ((1.0 - t) / a[2] + t / b[2])
}

/// A scene prepared for colouring one sample.
struct Lit<'a> {
    scene: &'a Scene<'a>,
    eye: Camera,
    buffer: DepthBuffer,
    light: Light,
}

impl Lit<'_> {
    /// The colour of a pixel in linear RGB.
    fn pixel(&self, x: usize, y: usize) -> [f32; 3] {
        const SHARE: f32 = 1.0 / (SAMPLES * SAMPLES) as f32;
        let owners: [Option<usize>; SAMPLES * SAMPLES] = std::array::from_fn(|sample| {
            self.buffer.owner(x * SAMPLES + sample % SAMPLES, y * SAMPLES + sample / SAMPLES)
        });
        // The ground is smooth: one evaluation serves all samples that show it.
        let bare = owners.iter().filter(|owner| owner.is_none()).count() as f32 * SHARE;
        let mut sum = if bare > 0.0 { self.ground(x, y).map(|c| c * bare) } else { [0.0; 3] };
        for (sample, owner) in owners.into_iter().enumerate() {
            if let Some(owner) = owner {
                let colour =
                    self.sphere(x * SAMPLES + sample % SAMPLES, y * SAMPLES + sample / SAMPLES, owner);
                sum = along(sum, SHARE, colour);
            }
        }
        sum
    }

    /// The light of a sphere at a sample.
    fn sphere(&self, x: usize, y: usize, owner: usize) -> [f32; 3] {
        let ray = self.eye.ray(x as f32 + 0.5, y as f32 + 0.5);
        let to_eye = unit(ray.map(|c| -c));
        let scene = self.scene;
        let depth = self.buffer.depth(x, y);
        let disc = scene.disc(&self.eye, scene.spheres[owner]);
        let [u, v, w] = disc.normal(x, y);
        let normal =
            std::array::from_fn(|i| u * self.eye.right[i] + v * self.eye.up[i] - w * self.eye.forward[i]);
        let surface = Surface {
            at: along(self.eye.eye, depth, ray),
            normal,
            albedo: scene.palette[usize::from(scene.colours[owner])],
            open: self.openness(x, y, depth, disc.radius),
            gloss: 0.16,
        };
        self.light.shade(&surface, to_eye)
    }

    /// The background of a pixel. Around the box it is the ground, which fades into the background.
    fn ground(&self, x: usize, y: usize) -> [f32; 3] {
        const PAPER: [f32; 3] = [1.0, 1.0, 1.0];
        const FADE: f32 = 0.11;
        let [half_x, half_y, half_z] = self.scene.corner;
        let middle = |pixel: usize| (pixel * SAMPLES) as f32 + SAMPLES as f32 / 2.0;
        let ray = self.eye.ray(middle(x), middle(y));
        let depth = (-half_z - self.eye.eye[2]) / ray[2];
        // Seen from below, the ground would hide the box.
        if !(depth > 0.0 && ray[2] < 0.0) {
            return PAPER;
        }
        let at = along(self.eye.eye, depth, ray);
        // The square of the distance from the box.
        let beyond = (at[0].abs() - half_x).max(0.0).powi(2) + (at[1].abs() - half_y).max(0.0).powi(2);
        let share = if beyond > 0.0 { 0.85 * (-beyond / (FADE * FADE)).exp() } else { 1.0 };
        if share < 1e-3 {
            return PAPER;
        }
        let surface =
            Surface { at, normal: [0.0, 0.0, 1.0], albedo: [0.655, 0.665, 0.685], open: 1.0, gloss: 0.0 };
        mix(PAPER, self.light.shade(&surface, unit(ray.map(|c| -c))), share)
    }

    /// The openness of a place, from 0 to 1. It falls with the distance by which neighbours on the screen
    /// stand in front, so that spheres stand out from those behind. `radius` is that of a sphere there, in
    /// samples.
    fn openness(&self, x: usize, y: usize, depth: f32, radius: f32) -> f32 {
        const RING: [[f32; 2]; 8] = [
            [1.0, 0.0],
            [0.7, 0.7],
            [0.0, 1.0],
            [-0.7, 0.7],
            [-1.0, 0.0],
            [-0.7, -0.7],
            [0.0, -1.0],
            [0.7, -0.7],
        ];
        let mut closed = 0.0;
        for reach in [(0.45 * radius).clamp(1.0, 10.0), (1.6 * radius).clamp(2.0, 36.0)] {
            for [dx, dy] in RING {
                let near = (x as f32 + reach * dx + 0.5) as i64;
                let neighbour = self.buffer.depth_near(near, (y as f32 + reach * dy + 0.5) as i64);
                closed += ((depth - neighbour) / (3.0 * self.scene.radius)).clamp(0.0, 1.0);
            }
        }
        (-1.5 * closed / 16.0).exp()
    }
}

#[cfg(test)]
mod tests {
    use super::super::Picture;
    use super::super::view::sub;
    use super::*;

    #[test]
    fn depth_along_a_line_is_that_of_perspective() {
        let (a, b) = ([0.0, 0.0, 1.0], [100.0, 0.0, 3.0]);
        assert_eq!(depth_on_line(a, b, [0.0, 5.0]), 1.0);
        assert_eq!(depth_on_line(a, b, [200.0, 5.0]), 3.0);
        // Halfway on the screen is nearer than halfway in space.
        assert!((depth_on_line(a, b, [50.0, 0.0]) - 1.5).abs() < 1e-6);
    }

    /// A cube with at most one sphere, seen from the default viewpoint on 300 by 300 pixels.
    fn drawn(spheres: &[[f32; 3]]) -> (Camera, Picture) {
        let corner = [1.0 / 12.0_f32.sqrt(); 3];
        let corners = [corner, corner.map(|x| -x)];
        let camera = Camera::fit(Default::default(), &corners, [100.0; 2], [200.0; 2]).unwrap();
        let mut canvas = Canvas::new(300, 300, [1.0; 3]);
        let palette = [[0.8, 0.1, 0.1]];
        let eye = camera.clone();
        Scene { camera, spheres, radius: 0.12, colours: &[0], palette: &palette, corner }.draw(&mut canvas);
        (eye, canvas.into_picture())
    }

    /// How much darker the middle of an edge along z is than the pixels on either side.
    fn edge(spheres: &[[f32; 3]], x: f32, y: f32) -> i32 {
        let (camera, picture) = drawn(spheres);
        let half = 1.0 / 12.0_f32.sqrt();
        let [px, py, _] = camera.project([x * half, y * half, 0.0]).map(|v| v as usize);
        let light = |x: usize| picture.pixel(x, py).iter().map(|&c| i32::from(c)).sum::<i32>();
        (light(px - 4) + light(px + 4)) / 2 - (px - 1..=px + 1).map(light).min().unwrap()
    }

    #[test]
    fn spheres_hide_the_edges_behind_them_and_no_others() {
        // The far edge, then the near one.
        assert!(edge(&[], -1.0, 1.0) > 60);
        assert!(edge(&[], 1.0, -1.0) > 60);
        let (camera, _) = drawn(&[]);
        let half = 1.0 / 12.0_f32.sqrt();
        let towards = |target: [f32; 3], share: f32| along(target, share, sub(camera.eye, target));
        assert!(edge(&[towards([-half, half, 0.0], 0.1)], -1.0, 1.0) < 40);
        assert!(edge(&[towards([half, -half, 0.0], -0.1)], 1.0, -1.0) > 60);
    }

    #[test]
    fn the_ground_is_grey_below_the_box_and_fades_into_the_paper() {
        let (camera, picture) = drawn(&[]);
        let half = 1.0 / 12.0_f32.sqrt();
        let at = |x: f32, y: f32| {
            let [px, py, _] = camera.project([x, y, -half]).map(|v| v as usize);
            picture.pixel(px, py)[0]
        };
        assert!(at(0.0, 0.0) < 240);
        assert!(at(0.0, 0.0) < at(half + 0.08, 0.0) && at(half + 0.08, 0.0) < 255);
        assert_eq!(at(half + 0.5, 0.0), 255);
        assert_eq!(picture.pixel(0, 0), [255; 3]);
    }

    #[test]
    fn a_sphere_throws_its_shadow_on_the_ground() {
        let (_, bare) = drawn(&[]);
        let (_, shaded) = drawn(&[[0.0; 3]]);
        let darker = |i: &usize| {
            let (before, after) = (bare.pixel(i % 300, i / 300), shaded.pixel(i % 300, i / 300));
            // Grey, so it is not the sphere itself.
            after[0].saturating_add(25) < before[0] && after[0].abs_diff(after[2]) < 12
        };
        assert!((0..300 * 300).filter(darker).count() > 100);
    }
}
