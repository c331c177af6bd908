//! Whether a run of a system can start from particles.

use crate::configuration::Configuration;
use crate::face::Face;
use crate::near::Near;
use crate::particles::{Particle, ParticleError};
use crate::substates::FIRST_BOUNDARY_LABEL;

impl Configuration {
    /// Checks that a run of this system can start from these particles. [`crate::model()`] does it too.
    ///
    /// # Errors
    /// The first mistake that is found, in the order of [`ParticleError`]'s variants for each particle, and
    /// overlaps last.
    pub fn check_particles(&self, particles: &[Particle]) -> Result<(), ParticleError> {
        for particle in particles {
            self.check_particle(particle)?;
        }
        let mut labels: Vec<u32> = particles.iter().map(|particle| particle.label).collect();
        labels.sort_unstable();
        if let Some(pair) = labels.windows(2).find(|pair| pair[0] == pair[1]) {
            return Err(ParticleError::LabelTwice { label: pair[0] });
        }
        if self.allow_overlaps { Ok(()) } else { self.check_overlaps(particles) }
    }

    fn check_particle(&self, particle: &Particle) -> Result<(), ParticleError> {
        let Particle { label, position, velocity } = *particle;
        for (what, value) in [("position", position), ("velocity", velocity)] {
            if !value.iter().all(|component| component.is_finite()) {
                return Err(ParticleError::NotFinite { label, what, value });
            }
        }
        let sides = self.sides();
        if !(0..3).all(|axis| (0.0..sides[axis]).contains(&position[axis])) {
            return Err(ParticleError::Outside { label, position, sides });
        }
        if let Some(face) = Face::ALL.into_iter().find(|&face| self.is_behind(face, position))
            && !self.allow_overlaps
        {
            return Err(ParticleError::BehindWall { label, position, face, wall: self.wall(face) });
        }
        if label >= FIRST_BOUNDARY_LABEL {
            return Err(ParticleError::LargeLabel { label, limit: FIRST_BOUNDARY_LABEL });
        }
        Ok(())
    }

    /// Whether a position is behind a wall that has no openings.
    fn is_behind(&self, face: Face, position: [f64; 3]) -> bool {
        let above = position[face.axis()] - self.wall(face);
        (if face.is_high() { above > 0.0 } else { above < 0.0 })
            && self.openings.iter().all(|opening| opening.face != face)
    }

    fn check_overlaps(&self, particles: &[Particle]) -> Result<(), ParticleError> {
        let diameter = 2.0 * self.radius;
        let positions: Vec<[f64; 3]> = particles.iter().map(|particle| particle.position).collect();
        let mut pairs = 0;
        let mut first: Option<(u32, u32, f64)> = None;
        Near::new(self.sides(), self.cell_side, &positions).pairs_within(diameter, |one, other, distance| {
            pairs += 1;
            let (one, other) = (particles[one].label, particles[other].label);
            let labels = (one.min(other), one.max(other));
            if first.is_none_or(|(label, other, _)| labels < (label, other)) {
                first = Some((labels.0, labels.1, distance));
            }
        });
        match first {
            Some((label, other, distance)) => {
                Err(ParticleError::Overlap { label, other, distance, diameter, pairs })
            }
            None => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests;
