//! A depth buffer of spheres.

/// The nearest sphere and its depth for each sample.
#[derive(Debug)]
pub struct DepthBuffer {
    pub(super) width: usize,
    pub(super) height: usize,
    depth: Vec<f32>,
    owner: Vec<u32>,
}

/// A sphere in projection.
#[derive(Debug, Clone, Copy)]
pub struct Disc {
    /// The centre, in samples from the top left.
    pub at: [f32; 2],
    /// The radius in samples.
    pub radius: f32,
    /// The depth of the centre.
    pub depth: f32,
    /// The radius in units of depth.
    pub thickness: f32,
}

impl Disc {
    /// The disc as drawn. It is never smaller than a sample, because far spheres would flicker.
    fn visible(mut self) -> Self {
        self.radius = self.radius.max(0.75);
        self
    }

    /// The normal of the surface at a sample: right, up, towards the viewer.
    pub fn normal(&self, x: usize, y: usize) -> [f32; 3] {
        let disc = self.visible();
        let u = (x as f32 + 0.5 - disc.at[0]) / disc.radius;
        let v = (disc.at[1] - y as f32 - 0.5) / disc.radius;
        [u, v, (1.0 - u * u - v * v).max(0.0).sqrt()]
    }
}

impl DepthBuffer {
    /// The owner of a sample without a sphere.
    const NONE: u32 = u32::MAX;

    /// An empty buffer of `width` by `height` samples.
    pub fn new(width: usize, height: usize) -> Self {
        Self {
            width,
            height,
            depth: vec![f32::INFINITY; width * height],
            owner: vec![Self::NONE; width * height],
        }
    }

    /// Draws sphere `owner` where it is in front of the spheres drawn so far.
    pub fn draw(&mut self, disc: Disc, owner: u32) {
        let disc = disc.visible();
        let [cx, cy] = disc.at;
        let r = disc.radius;
        // Casts of negative numbers and of NaN give zero, so a disc far outside has an empty range.
        let (y0, y1) = ((cy - r).max(0.0) as usize, ((cy + r + 1.0) as usize).min(self.height));
        for y in y0..y1 {
            let v = (y as f32 + 0.5 - cy) / r;
            let half = 1.0 - v * v;
            if half <= 0.0 {
                continue;
            }
            let reach = half.sqrt() * r;
            let (x0, x1) = ((cx - reach).max(0.0) as usize, ((cx + reach + 1.0) as usize).min(self.width));
            if x0 >= x1 {
                continue;
            }
            let row = y * self.width;
            let depths = &mut self.depth[row + x0..row + x1];
            let owners = &mut self.owner[row + x0..row + x1];
            for ((x, depth), owned) in (x0..).zip(depths).zip(owners) {
                let u = (x as f32 + 0.5 - cx) / r;
                let w2 = half - u * u;
                if w2 > 0.0 {
                    let near = disc.depth - disc.thickness * w2.sqrt();
                    if near < *depth {
                        *depth = near;
                        *owned = owner;
                    }
                }
            }
        }
    }

    /// The depth at a sample. Infinite without a sphere. The sample must be inside.
    pub(super) fn depth(&self, x: usize, y: usize) -> f32 {
        self.depth[y * self.width + x]
    }

    /// The depth at the sample nearest to a place that may be outside.
    pub(super) fn depth_near(&self, x: i64, y: i64) -> f32 {
        let x = x.clamp(0, self.width as i64 - 1) as usize;
        let y = y.clamp(0, self.height as i64 - 1) as usize;
        self.depth(x, y)
    }

    /// The sphere at a sample. `None` outside.
    pub fn owner(&self, x: usize, y: usize) -> Option<usize> {
        let owner = *self.owner.get(y * self.width + x)?;
        (x < self.width && owner != Self::NONE).then_some(owner as usize)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn disc(x: f32, y: f32, depth: f32) -> Disc {
        Disc { at: [x, y], radius: 4.0, depth, thickness: 0.4 }
    }

    #[test]
    fn the_nearer_sphere_is_seen_in_either_order() {
        for order in [[0, 1], [1, 0]] {
            let mut buffer = DepthBuffer::new(20, 20);
            for owner in order {
                buffer.draw(disc(8.0 + 4.0 * owner as f32, 10.0, 2.0 - 0.8 * owner as f32), owner);
            }
            assert_eq!(buffer.owner(10, 10), Some(1));
            assert_eq!(buffer.owner(5, 10), Some(0));
            assert_eq!(buffer.owner(1, 1), None);
            assert!((buffer.depth(12, 10) - 0.8).abs() < 0.01);
        }
    }

    #[test]
    fn spheres_that_cross_are_parted_in_the_middle() {
        let mut buffer = DepthBuffer::new(20, 20);
        buffer.draw(disc(8.0, 10.0, 1.0), 0);
        buffer.draw(disc(12.0, 10.0, 1.0), 1);
        assert_eq!((buffer.owner(9, 10), buffer.owner(10, 10)), (Some(0), Some(1)));
    }

    #[test]
    fn a_sphere_outside_or_smaller_than_a_sample_is_no_trouble() {
        let mut buffer = DepthBuffer::new(20, 20);
        for at in [[-50.0, 5.0], [5.0, 50.0], [1e9, 1e9], [f32::NAN, 3.0]] {
            buffer.draw(Disc { at, ..disc(0.0, 0.0, 1.0) }, 7);
        }
        assert!((0..20).all(|y| (0..20).all(|x| buffer.owner(x, y).is_none())));
        buffer.draw(Disc { radius: 1e-3, ..disc(10.0, 10.0, 1.0) }, 8);
        assert_eq!(buffer.owner(9, 9).or(buffer.owner(10, 10)), Some(8));
    }

    #[test]
    fn the_normal_looks_at_the_eye_in_the_middle_and_sideways_at_the_rim() {
        let normal = disc(10.5, 10.5, 1.0).normal(10, 10);
        assert_eq!(normal, [0.0, 0.0, 1.0]);
        let normal = disc(10.5, 10.5, 1.0).normal(10, 7);
        assert!(normal[1] > 0.7 && normal[0] == 0.0);
    }
}
