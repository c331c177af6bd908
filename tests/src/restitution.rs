//! What a collision under the linear spring-dashpot law does: the numbers that a correct CADEM reproduces.
//!
//! While two bodies overlap by delta, De Rango et al., equation 2, makes the overlap a damped oscillator,
//!
//! m_eff delta'' + eta delta' + k_n delta = 0, with delta = 0 and delta' = v at first touch,
//!
//! where m_eff is half a particle's mass if two particles collide, and the whole mass at a wall. With b = eta / (2 m_eff) and
//! w = sqrt(k_n / m_eff - b^2) its solution is delta(t) = (v / w) exp(-b t) sin(w t), until delta = 0 again at t = pi / w.
//!
//! The equation is linear: restitution and contact time do not depend on the impact speed v, and the largest overlap is proportional to it.

use std::f64::consts::PI;

use crate::brute_force::Integrator;

/// A collision between two bodies, or of one with a wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Collision {
    stiffness: f64,
    damping: f64,
    effective_mass: f64,
}

/// A restitution that depends on how the first touch falls within a time step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spread {
    /// The mean over phases that are uniform in a time step.
    pub mean: f64,
    /// The smallest.
    pub least: f64,
    /// The largest.
    pub most: f64,
}

impl Collision {
    /// A collision of two particles of this mass (in kg), with stiffness k_n (in N/m) and damping eta (in kg/s).
    ///
    /// `None` if the bodies would not bounce: if the damping is at or above the critical one, or the numbers are not those of
    /// a spring, a mass and a dashpot.
    pub fn of_particles(stiffness: f64, damping: f64, mass: f64) -> Option<Self> {
        Self::new(stiffness, damping, mass / 2.0)
    }

    /// A collision of a particle with a wall. `None` as for [`Self::of_particles`].
    pub fn with_wall(stiffness: f64, damping: f64, mass: f64) -> Option<Self> {
        Self::new(stiffness, damping, mass)
    }

    fn new(stiffness: f64, damping: f64, effective_mass: f64) -> Option<Self> {
        let positive = |x: f64| x.is_finite() && x > 0.0;
        let bounces = damping >= 0.0 && damping * damping < 4.0 * stiffness * effective_mass;
        (positive(stiffness) && positive(effective_mass) && bounces).then_some(Self {
            stiffness,
            damping,
            effective_mass,
        })
    }

    /// The rate b at which the oscillation decays, in 1/s.
    pub fn decay(&self) -> f64 {
        self.damping / (2.0 * self.effective_mass)
    }

    /// The angular frequency w of the damped oscillation, in 1/s.
    pub fn frequency(&self) -> f64 {
        (self.stiffness / self.effective_mass - self.decay() * self.decay()).sqrt()
    }

    /// The speed after the collision over the speed before: exp(-pi b / w).
    pub fn restitution(&self) -> f64 {
        (-PI * self.decay() / self.frequency()).exp()
    }

    /// The time from first to last touch, pi / w, in s.
    pub fn contact_time(&self) -> f64 {
        PI / self.frequency()
    }

    /// The largest overlap over the impact speed, in s.
    ///
    /// It is reached when tan(w t) = w / b, which is after somewhat less than half of the contact time.
    pub fn largest_overlap_per_speed(&self) -> f64 {
        let (b, w) = (self.decay(), self.frequency());
        let angle = w.atan2(b);
        (-b / w * angle).exp() * angle.sin() / w
    }

    /// The restitution that an integrator makes of the collision, to rounding.
    ///
    /// Forces act from the first time step on that starts with an overlap. `phase` is the overlap there in units of impact speed times
    /// `time_step` (in s), above 0 and at most 1: how much of the time step before the bodies already spent overlapping.
    ///
    /// `None` if the bodies have not parted after a hundred contact times.
    pub fn discrete_restitution(&self, integrator: Integrator, time_step: f64, phase: f64) -> Option<f64> {
        let (mut overlap, mut approach) = (phase * time_step, 1.0);
        let most_steps = (100.0 * self.contact_time() / time_step).ceil() as usize;
        for _ in 0..most_steps {
            let force = -self.stiffness * overlap - self.damping * approach;
            let next_approach = approach + force / self.effective_mass * time_step;
            overlap += time_step
                * match integrator {
                    Integrator::SymplecticEuler => next_approach,
                    Integrator::ExplicitEuler => approach,
                };
            approach = next_approach;
            if overlap <= 0.0 {
                return Some(-approach);
            }
        }
        None
    }

    /// [`Self::discrete_restitution`] over `phases` phases, in the middle of as many equal parts of a time step.
    ///
    /// `None` if there are no phases, or if some phase has no restitution.
    pub fn spread_of_restitution(
        &self,
        integrator: Integrator,
        time_step: f64,
        phases: u32,
    ) -> Option<Spread> {
        let of_phase = |n| (f64::from(n) + 0.5) / f64::from(phases);
        let restitutions: Option<Vec<f64>> =
            (0..phases).map(|n| self.discrete_restitution(integrator, time_step, of_phase(n))).collect();
        let restitutions = restitutions.filter(|found| !found.is_empty())?;
        Some(Spread {
            mean: restitutions.iter().sum::<f64>() / restitutions.len() as f64,
            least: restitutions.iter().copied().fold(f64::INFINITY, f64::min),
            most: restitutions.iter().copied().fold(f64::NEG_INFINITY, f64::max),
        })
    }
}

/// The overlap (in m) of a particle of this mass (in kg) at rest on a floor of this stiffness (in N/m): m g / k_n.
pub fn static_deflection(mass: f64, gravity: f64, stiffness: f64) -> f64 {
    mass * gravity / stiffness
}

/// How far (in m) a particle has fallen from rest after `steps` steps of an integrator.
///
/// The distance is g dt^2 n (n + 1) / 2 with the symplectic Euler method, and g dt^2 n (n - 1) / 2 with the explicit one; the exact distance
/// g t^2 / 2 lies between the two.
pub fn free_fall(integrator: Integrator, gravity: f64, time_step: f64, steps: u32) -> f64 {
    let n = f64::from(steps);
    let factor = match integrator {
        Integrator::SymplecticEuler => n * (n + 1.0),
        Integrator::ExplicitEuler => n * (n - 1.0),
    };
    gravity * time_step * time_step * factor / 2.0
}

#[cfg(test)]
mod tests {
    use super::*;
    #[test]
    fn explore() {
        let dt = 0.1 * (1e-4f64 / 8000.0).sqrt();
        for c in [Collision::of_particles(8000.0, 0.0015, 1e-4).unwrap(), Collision::with_wall(8000.0, 0.0015, 1e-4).unwrap()] {
            println!("{} {} {} {}", c.restitution(), c.contact_time(), c.contact_time() / dt, c.largest_overlap_per_speed());
            for i in [Integrator::SymplecticEuler, Integrator::ExplicitEuler] {
                for phases in [100, 400,1000, 10000] {
                println!("{:?}", c.spread_of_restitution(i, dt, phases));}
            }
            for h in [1.0, 2.0, 4.0, 8.0] {
                let s = c.spread_of_restitution(Integrator::SymplecticEuler, dt / h, 10_000).unwrap();
                println!("err {}", s.mean - c.restitution());
            }
        }
    }
}
