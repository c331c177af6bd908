//! Pictures of particles.

use super::canvas::Canvas;
use super::category::Category;
use super::legend::{FAINT_INK, Scalar, draw_bar, draw_categories, draw_title};
use super::scene::Scene;
use super::text::{self, Anchor, Style};
use super::view::{Camera, Viewpoint};
use super::{Picture, PictureError, check_size};
use xca_io::numbers::significant;

/// The box of the particles: two opposite corners, as lengths.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Domain {
    /// The corner with the least coordinates.
    pub lower: [f64; 3],
    /// The corner with the largest coordinates.
    pub upper: [f64; 3],
}

/// Particles as shaded spheres in their box, in perspective, z up.
///
/// Create one with [`ParticlePicture::new`], set its fields, and call [`render`](ParticlePicture::render). At
/// the default size, in a release build on one core, 2,602 particles take about a quarter of a second.
/// 316,000 particles take less than a second. Rendering uses about 100 MB of memory.
#[derive(Debug, Clone)]
pub struct ParticlePicture<'a> {
    /// The centres of the particles, as lengths. Positions that are not finite are left out.
    pub positions: &'a [[f64; 3]],
    /// The radius of all particles, as a length.
    pub radius: f64,
    /// The box. Its edges are drawn, and it stands on the ground.
    pub domain: Domain,
    /// The scalar that colours the particles. `None` for one colour.
    pub colour: Option<Scalar<'a>>,
    /// The categories of the scalar's values, if not empty. Other values are drawn in grey.
    pub categories: &'a [Category],
    /// The text above the picture, such as the model and the case.
    pub title: &'a str,
    /// The smaller text below the title, such as the time and the number of particles.
    pub caption: &'a str,
    /// The unit of length, for the sides of the box.
    pub length_unit: &'a str,
    /// Width and height in pixels, from 200 to 8192 each.
    pub size: [usize; 2],
    /// The direction of view.
    pub viewpoint: Viewpoint,
}

impl<'a> ParticlePicture<'a> {
    /// A picture of 1200 by 900 pixels in the default view, without text and colours.
    #[must_use]
    pub fn new(positions: &'a [[f64; 3]], radius: f64, domain: Domain) -> Self {
        Self {
            positions,
            radius,
            domain,
            colour: None,
            categories: &[],
            title: "",
            caption: "",
            length_unit: "m",
            size: [1200, 900],
            viewpoint: Viewpoint::default(),
        }
    }

    /// Draws the picture.
    ///
    /// # Errors
    /// [`PictureError::Size`], [`PictureError::Geometry`] (box, radius or viewpoint) and
    /// [`PictureError::Length`] (one value of the scalar for each particle).
    pub fn render(&self) -> Result<Picture, PictureError> {
        check_size(self.size)?;
        self.check_geometry()?;
        if let Some(scalar) = &self.colour {
            scalar.check(self.positions.len(), "particles")?;
        }
        let [width, height] = self.size;
        let mut canvas = Canvas::new(width, height, [1.0; 3]);

        // Lengths are relative to the diagonal of the box, and measured from its middle.
        let Domain { lower, upper } = self.domain;
        let sides: [f64; 3] = std::array::from_fn(|i| upper[i] - lower[i]);
        let diagonal = sides.iter().map(|side| side * side).sum::<f64>().sqrt();
        let corner = sides.map(|side| (side / diagonal / 2.0) as f32);
        let (mut spheres, mut colours) = (Vec::new(), Vec::new());
        let (palette, colour_of) = self.palette();
        for (i, position) in self.positions.iter().enumerate() {
            if position.iter().all(|x| x.is_finite()) {
                spheres.push(std::array::from_fn(|k| {
                    ((position[k] - lower[k] - sides[k] / 2.0) / diagonal) as f32
                }));
                colours.push(colour_of(i));
            }
        }

        let corners: [[f32; 3]; 8] = std::array::from_fn(|c| {
            std::array::from_fn(|axis| if c >> axis & 1 == 1 { corner[axis] } else { -corner[axis] })
        });
        let right = width as f32 - if self.colour.is_some() { 170.0 } else { 50.0 };
        let camera = Camera::fit(self.viewpoint, &corners, [92.0, 92.0], [right, height as f32 - 56.0])?;
        let radius = (self.radius / diagonal) as f32;
        let scene = Scene { camera, spheres: &spheres, radius, colours: &colours, palette: &palette, corner };
        scene.draw(&mut canvas);
        self.draw_sides(&mut canvas, &scene, sides);
        draw_title(&mut canvas, 36.0, self.title, self.caption);
        if let Some(scalar) = &self.colour {
            if self.categories.is_empty() {
                let (y, h) = (height * 3 / 10, height * 9 / 20);
                draw_bar(&mut canvas, [width - 128, y], [18, h], scalar.label, scalar.map, scalar.scale());
            } else {
                draw_categories(&mut canvas, [width - 128, 120], height - 8, scalar.label, self.categories);
            }
        }
        Ok(canvas.into_picture())
    }

    fn check_geometry(&self) -> Result<(), PictureError> {
        let Domain { lower, upper } = self.domain;
        let bad = |what, value| Err(PictureError::Geometry { what, value });
        if let Some(&value) = lower.iter().chain(&upper).find(|x| !x.is_finite()) {
            return bad("a corner of the box", value);
        }
        for side in (0..3).map(|i| upper[i] - lower[i]) {
            if !(side.is_finite() && side > 0.0) {
                return bad("a side of the box", side);
            }
        }
        if !(self.radius.is_finite() && self.radius > 0.0) {
            return bad("the radius", self.radius);
        }
        Ok(())
    }

    /// The colours in linear RGB, and the index of each particle's colour.
    fn palette(&self) -> (Vec<[f32; 3]>, impl Fn(usize) -> u16 + '_) {
        const GREY: u16 = 256;
        const PLAIN: u16 = 257;
        let mut palette = self.colour.map(|scalar| scalar.map).unwrap_or_default().table();
        palette.push([0.35, 0.35, 0.35]);
        palette.push([0.10, 0.27, 0.50]);
        palette.extend(self.categories.iter().map(Category::linear));
        let scale = self.colour.map(|scalar| (scalar.values, scalar.scale()));
        let colour_of = move |i: usize| match scale {
            None => PLAIN,
            Some((values, _)) if !self.categories.is_empty() => {
                let number = Category::number_of(self.categories, values[i]);
                // A state is a byte, so there are at most 256.
                number.and_then(|number| u16::try_from(number).ok()).map_or(GREY, |number| PLAIN + 1 + number)
            }
            Some((values, scale)) => {
                scale.place(values[i]).map_or(GREY, |place| (place * 255.0).round() as u16)
            }
        };
        (palette, colour_of)
    }

    /// Labels three edges of the box with the lengths of the sides.
    fn draw_sides(&self, canvas: &mut Canvas, scene: &Scene<'_>, sides: [f64; 3]) {
        let style = Style { height: 11.0, colour: FAINT_INK };
        let middle = scene.camera.project([0.0; 3]);
        for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
            // An edge on the outline of the box, with one visible and one hidden face. For x and y it is the
            // lower one, for z the left one.
            let outline = (0..8_usize).filter(|start| start >> axis & 1 == 0).filter(|start| {
                let seen = (0..3).filter(|&a| a != axis).filter(|&a| scene.faces_eye(a, start >> a & 1 == 1));
                seen.count() == 1
            });
            let place = |start: usize| {
                let ends = [start, start | 1 << axis].map(|end| scene.camera.project(scene.corner(end)));
                [(ends[0][0] + ends[1][0]) / 2.0, (ends[0][1] + ends[1][1]) / 2.0]
            };
            let key = |at: [f32; 2]| if axis == 2 { at[0] } else { -at[1] };
            let Some([x, y]) = outline.map(place).min_by(|a, b| key(*a).total_cmp(&key(*b))) else {
                continue;
            };
            let text = format!("{name}  {} {}", significant(sides[axis], 4), self.length_unit);
            let (at, anchor) = match axis {
                2 => ([x - 12.0, y + 4.0], Anchor::Right),
                _ if x < middle[0] => ([x - 10.0, y + 20.0], Anchor::Right),
                _ => ([x + 10.0, y + 20.0], Anchor::Left),
            };
            text::draw(canvas, &text, at, anchor, &style);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DOMAIN: Domain = Domain { lower: [0.0; 3], upper: [1.0; 3] };

    fn picture<'a>(positions: &'a [[f64; 3]], values: &'a [f64]) -> ParticlePicture<'a> {
        let mut picture = ParticlePicture::new(positions, 0.1, DOMAIN);
        picture.size = [600, 450];
        picture.colour = Some(Scalar { range: Some([0.0, 1.0]), ..Scalar::new("value", values) });
        picture
    }

    /// Counts pixels of the drawing without the bar: bluish dark ones (`true`, the low end of the map) or
    /// yellowish ones (`false`, the high end).
    fn count(picture: &Picture, low: bool) -> usize {
        let in_drawing = |i: &usize| i % picture.width() < 430;
        (0..picture.width() * picture.height())
            .filter(in_drawing)
            .filter(|i| {
                let [r, _, b] = picture.pixel(i % picture.width(), i / picture.width()).map(i32::from);
                if low { b > r + 30 } else { r > b + 60 }
            })
            .count()
    }

    #[test]
    fn a_sphere_in_front_hides_the_one_behind() {
        let mut viewed = picture(&[], &[]);
        viewed.viewpoint = Viewpoint { azimuth: -90.0, elevation: 0.0 };
        let (near, far) = ([0.5, 0.2, 0.5], [0.5, 0.8, 0.5]);
        for positions in [[near, far], [far, near]] {
            // The near sphere has the low value (violet), in either order.
            let values = positions.map(|p| if p == near { 0.0 } else { 1.0 });
            let both = ParticlePicture { positions: &positions, ..viewed.clone() };
            let both =
                ParticlePicture { colour: Some(Scalar { values: &values, ..both.colour.unwrap() }), ..both };
            let rendered = both.render().unwrap();
            assert!(count(&rendered, true) > 500);
            assert_eq!(count(&rendered, false), 0);
        }
        let alone = ParticlePicture { positions: &[far], colour: None, ..viewed.clone() };
        let alone =
            ParticlePicture { colour: Some(Scalar { values: &[1.0], ..viewed.colour.unwrap() }), ..alone };
        assert!(count(&alone.render().unwrap(), false) > 400);
    }

    #[test]
    fn a_sphere_is_as_large_as_its_radius_says() {
        let one = picture(&[[0.5; 3]], &[1.0]).render().unwrap();
        let mut wide = picture(&[[0.5; 3]], &[1.0]);
        wide.radius = 0.2;
        let ratio = count(&wide.render().unwrap(), false) as f64 / count(&one, false) as f64;
        assert!((3.4..4.6).contains(&ratio), "{ratio}");
    }

    #[test]
    fn the_lamp_is_above() {
        let rendered = picture(&[[0.5; 3]], &[1.0]).render().unwrap();
        let bright: Vec<(usize, usize, u32)> = (0..430 * 450)
            .map(|i| (i % 430, i / 430))
            .map(|(x, y)| (x, y, rendered.pixel(x, y).iter().map(|&c| u32::from(c)).sum()))
            .filter(|&(x, y, _)| {
                let [r, _, b] = rendered.pixel(x, y).map(i32::from);
                r > b + 60
            })
            .collect();
        let middle = bright.iter().map(|p| p.1).sum::<usize>() / bright.len();
        let mean = |upper: bool| {
            let half: Vec<u32> = bright.iter().filter(|p| (p.1 < middle) == upper).map(|p| p.2).collect();
            f64::from(half.iter().sum::<u32>()) / half.len() as f64
        };
        assert!(mean(true) > mean(false) + 60.0, "{} {}", mean(true), mean(false));
    }

    #[test]
    fn positions_and_values_that_are_not_finite_do_no_harm() {
        let positions = [[f64::NAN; 3], [f64::INFINITY, 0.5, 0.5], [0.5; 3], [1e300, 0.0, 0.0]];
        let rendered = picture(&positions, &[0.0, 0.0, f64::NAN, 1.0]).render().unwrap();
        assert_eq!((rendered.width(), rendered.height()), (600, 450));
        assert_eq!(count(&rendered, false), 0);
        let empty = picture(&[], &[]).render().unwrap();
        assert_ne!(rendered, empty, "the sphere without a value is drawn, in grey");
    }

    #[test]
    fn a_particle_that_has_passed_the_eye_is_not_seen() {
        let mut viewed = picture(&[], &[]);
        viewed.viewpoint = Viewpoint { azimuth: -90.0, elevation: 0.0 };
        let empty = viewed.render().unwrap();
        for y in [-3.0, -5.0, -50.0] {
            let passed = [[0.5, y, 0.5]];
            let rendered = ParticlePicture { positions: &passed, colour: None, ..viewed.clone() };
            let scalar = Scalar { values: &[1.0], ..viewed.colour.unwrap() };
            let rendered = ParticlePicture { colour: Some(scalar), ..rendered }.render().unwrap();
            assert!(rendered == empty, "{y}");
        }
    }

    #[test]
    fn what_cannot_be_drawn_is_said() {
        let error = |change: fn(&mut ParticlePicture<'_>)| {
            let mut picture = picture(&[[0.5; 3]], &[1.0]);
            change(&mut picture);
            picture.render().unwrap_err().to_string()
        };
        assert_eq!(error(|p| p.positions = &[]), "cannot draw `value`: 1 values for 0 particles");
        assert_eq!(error(|p| p.radius = 0.0), "cannot draw particles: the radius is 0");
        assert_eq!(error(|p| p.domain.upper[1] = -1.0), "cannot draw particles: a side of the box is -1");
        assert!(error(|p| p.domain.lower[0] = f64::NAN).contains("a corner of the box is NaN"));
        assert!(error(|p| p.viewpoint.azimuth = f64::NAN).contains("the azimuth of the eye is NaN"));
        assert!(error(|p| p.size = [100, 900]).contains("100 by 900"));
    }
}
