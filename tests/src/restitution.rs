//! What a collision under the linear spring-dashpot law does: the numbers that a correct CADEM reproduces.
//!
//! While two bodies overlap by delta, De Rango et al., equation 2, makes the overlap a damped oscillator,
//!
//! m_eff delta'' + eta delta' + k_n delta = 0, with delta = 0 and delta' = v at first touch,
//!
//! where m_eff is half a particle's mass if two particles collide, and the whole mass at a wall. With b = eta
//! / (2 m_eff) and w = sqrt(k_n / m_eff - b^2) its solution is delta(t) = (v / w) exp(-b t) sin(w t), until
//! delta = 0 again at t = pi / w.
//!
//! The equation is linear: restitution and contact time do not depend on the impact speed v, and the largest
//! overlap is proportional to it.

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
    /// A collision of two particles of this mass (in kg), with stiffness k_n (in N/m) and damping eta (in
    /// kg/s).
    ///
    /// `None` if the bodies would not bounce: if the damping is at or above the critical one, or the numbers
    /// are not those of a spring, a mass and a dashpot.
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
    /// Forces act from the first time step on that starts with an overlap. `phase`, above 0 and at most 1, is
    /// that overlap in units of impact speed times `time_step` (in s): the part of the time step before that
    /// the bodies already spent in contact.
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

    /// [`Self::discrete_restitution`] over `phases` phases, in the middle of as many equal parts of a time
    /// step.
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

/// The overlap (in m) of a particle of this mass (in kg) at rest on a floor of this stiffness (in N/m): m g /
/// k_n.
pub fn static_deflection(mass: f64, gravity: f64, stiffness: f64) -> f64 {
    mass * gravity / stiffness
}

/// How far (in m) a particle has fallen from rest after `steps` steps of an integrator.
///
/// The distance is g dt^2 n (n + 1) / 2 with the symplectic Euler method, and g dt^2 n (n - 1) / 2 with the
/// explicit one; the exact distance g t^2 / 2 lies between the two.
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

    /// The parameters of De Rango et al., Table I.
    const STIFFNESS: f64 = 8000.0;
    const DAMPING: f64 = 0.0015;
    const MASS: f64 = 1e-4;

    fn collisions() -> [Collision; 2] {
        [Collision::of_particles(STIFFNESS, DAMPING, MASS), Collision::with_wall(STIFFNESS, DAMPING, MASS)]
            .map(|collision| collision.expect("it bounces"))
    }

    /// The time step of De Rango et al., footnote 4.
    fn time_step() -> f64 {
        0.1 * (MASS / STIFFNESS).sqrt()
    }

    fn spread(collision: Collision, integrator: Integrator, time_step: f64) -> Spread {
        collision.spread_of_restitution(integrator, time_step, 20_000).expect("it bounces")
    }

    fn close(found: f64, expected: f64, tolerance: f64) {
        assert!((found - expected).abs() <= tolerance, "{found:e} is not {expected:e} within {tolerance:e}");
    }

    #[test]
    fn exact_numbers_of_table_1() {
        let [particles, wall] = collisions();
        close(particles.restitution(), 0.996_281_458, 5e-10);
        close(wall.restitution(), 0.997_369_160, 5e-10);
        close(particles.contact_time(), 2.483_649e-4, 5e-11);
        close(wall.contact_time(), 3.512_409e-4, 5e-11);
        close(particles.contact_time() / time_step(), 22.2, 0.05);
        close(wall.contact_time() / time_step(), 31.4, 0.05);
        close(particles.largest_overlap_per_speed(), 7.890_993e-5, 5e-12);
        close(wall.largest_overlap_per_speed(), 1.116_563e-4, 5e-11);
        close(static_deflection(MASS, 9.81, STIFFNESS), 1.226_25e-7, 1e-15);
    }

    #[test]
    fn largest_overlap_is_the_maximum_of_the_solution() {
        // Far from the weakly damped case, in which any formula near 1 / w would pass.
        let collision = Collision::with_wall(100.0, 0.15, 1e-4).expect("it bounces");
        let (b, w) = (collision.decay(), collision.frequency());
        let overlap = |n: i32| {
            let t = f64::from(n) / 1e5 * collision.contact_time();
            (-b * t).exp() * (w * t).sin() / w
        };
        let largest = (0..=100_000).map(overlap).fold(0.0, f64::max);
        close(collision.largest_overlap_per_speed() / largest, 1.0, 1e-8);
        assert!(largest < 0.6 / w);
    }

    #[test]
    fn symplectic_restitution_of_table_1() {
        let [particles, wall] = collisions();
        let found = spread(particles, Integrator::SymplecticEuler, time_step());
        close(found.mean, 0.996_285_4, 2e-7);
        close(found.least, 0.994_455, 1e-6);
        close(found.most, 0.997_913, 1e-6);
        let found = spread(wall, Integrator::SymplecticEuler, time_step());
        close(found.mean, 0.997_370_9, 2e-7);
        close(found.least, 0.996_071, 1e-6);
        close(found.most, 0.998_638, 1e-6);
    }

    #[test]
    fn explicit_restitution_of_table_1_is_above_one() {
        let [particles, wall] = collisions();
        close(spread(particles, Integrator::ExplicitEuler, time_step()).mean, 1.2432, 5e-5);
        close(spread(wall, Integrator::ExplicitEuler, time_step()).mean, 1.1667, 5e-5);
    }

    #[test]
    fn explicit_restitution_needs_damping_above_stiffness_times_time_step() {
        let critical = STIFFNESS * time_step();
        close(critical, 0.0894, 5e-5);
        for (damping, gains) in [(0.9 * critical, true), (1.1 * critical, false)] {
            let collision = Collision::with_wall(STIFFNESS, damping, MASS).expect("it bounces");
            let found = spread(collision, Integrator::ExplicitEuler, time_step());
            assert_eq!(found.mean > 1.0, gains, "damping {damping}: {found:?}");
        }
    }

    #[test]
    fn mean_error_falls_at_least_with_the_second_power_of_the_time_step() {
        for collision in collisions() {
            let errors = [1.0, 2.0, 4.0].map(|parts| {
                let mean = spread(collision, Integrator::SymplecticEuler, time_step() / parts).mean;
                (mean - collision.restitution()).abs()
            });
            assert!(errors[0] < 5e-6, "{errors:?}");
            assert!(errors[0] / errors[1] > 4.0 && errors[1] / errors[2] > 4.0, "{errors:?}");
        }
    }

    #[test]
    fn free_fall_encloses_the_exact_distance() {
        let (gravity, time_step, steps) = (9.81, 1e-3, 100);
        let exact = gravity * 0.1 * 0.1 / 2.0;
        close(free_fall(Integrator::SymplecticEuler, gravity, time_step, steps), exact * 1.01, 1e-15);
        close(free_fall(Integrator::ExplicitEuler, gravity, time_step, steps), exact * 0.99, 1e-15);
    }

    #[test]
    fn what_does_not_bounce_is_no_collision() {
        let critical = 2.0 * (STIFFNESS * MASS).sqrt();
        assert_eq!(Collision::with_wall(STIFFNESS, 1.001 * critical, MASS), None);
        assert!(Collision::with_wall(STIFFNESS, 0.999 * critical, MASS).is_some());
        // Two particles have half the mass between them, and less damping is critical.
        assert_eq!(Collision::of_particles(STIFFNESS, 0.999 * critical, MASS), None);
        for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert_eq!(Collision::with_wall(bad, DAMPING, MASS), None, "stiffness {bad}");
            assert_eq!(Collision::with_wall(STIFFNESS, DAMPING, bad), None, "mass {bad}");
        }
        assert_eq!(Collision::with_wall(STIFFNESS, f64::NAN, MASS), None);
        let [particles, _] = collisions();
        assert_eq!(particles.spread_of_restitution(Integrator::SymplecticEuler, time_step(), 0), None);
    }
}
