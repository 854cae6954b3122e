//! Moves the particles for one sub-step, and stops them at surfaces.
//!
//! Fixed chunks in parallel; what each gives to the bodies is summed in their order, so that nothing depends on the threads.

use crate::body::BodyLoad;
use crate::meetings::Meetings;
use crate::particles::{Particles, Run};
use crate::solids::{Meeting, Solids};
use crate::solver::Rows;
use glam::Vec3;
use rayon::prelude::*;

/// Farthest that a particle may go in a sub-step, in spacings: from a quarter behind a wall, where the last stop is, it must
/// not come past its middle, one behind.
pub(crate) const LONGEST_WAY: f64 = 0.7;

/// Particles that one thread moves at a time.
const CHUNK: usize = 256;

/// One sub-step.
#[derive(Clone, Copy)]
pub(crate) struct Step {
    pub dt: f64,
    /// How contacts by impulse are met.
    pub contact: ContactRule,
    /// Highest speed a particle may have, m/s.
    pub cap: f32,
    /// Above this the cap is no setting but a rescue, m/s.
    pub guard: f32,
}

#[derive(Clone, Copy)]
pub(crate) struct ContactRule {
    /// Distance from a surface at which a particle is stopped, m.
    pub distance: f32,
    pub restitution: f32,
}

/// What moves the particles.
pub(crate) struct Motion<'a, S> {
    pub step: &'a Step,
    pub gravity: Vec3,
    /// What is left of a velocity after the sub-step.
    pub decay: f32,
    /// Longest way, m.
    pub longest: f32,
    pub mass: f32,
    pub two_way: bool,
    /// Accelerations without gravity, m/s².
    pub rows: &'a Rows,
    /// What the solver shifts a particle by in this sub-step, beside its motion, m.
    pub shift: S,
    pub solids: Solids<'a>,
    /// Who meets nothing within the support comes to no surface in one sub-step; none where that was not looked up.
    pub meetings: Option<&'a Meetings>,
}

/// What came of it.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Moved {
    /// Speed of the fastest particle, m/s.
    pub fastest: f32,
    /// Whether somebody had to be rescued.
    pub degraded: bool,
}

/// Room to work in, kept from one sub-step to the next.
#[derive(Clone, Debug, Default)]
pub(crate) struct MotionScratch {
    moved: Vec<Moved>,
    loads: Vec<BodyLoad>,
}

impl<S: Fn(usize) -> Vec3 + Sync> Motion<'_, S> {
    /// Moves all but the images; what the contacts give to the bodies is added to `loads`.
    pub fn run(&self, p: &mut Particles, scratch: &mut MotionScratch, loads: &mut [BodyLoad]) -> Moved {
        if p.len() == 0 {
            // Where there is no fluid there are no threads either.
            return Moved::default();
        }
        let (chunks, bodies) = (p.len().div_ceil(CHUNK), loads.len().max(1));
        let MotionScratch { moved, loads: parts } = scratch;
        moved.clear();
        moved.resize(chunks, Moved::default());
        parts.clear();
        parts.resize(chunks * bodies, BodyLoad::default());
        let each = p.runs(CHUNK).zip(&mut *moved).zip(parts.par_chunks_mut(bodies));
        each.for_each(|((run, moved), loads)| *moved = self.chunk(run, loads));
        BodyLoad::add_chunks(loads, parts);
        let all = |a: Moved, b: &Moved| Moved {
            fastest: a.fastest.max(b.fastest),
            degraded: a.degraded || b.degraded,
        };
        moved.iter().fold(Moved::default(), all)
    }

    fn chunk(&self, mut run: Run<'_>, loads: &mut [BodyLoad]) -> Moved {
        let mut moved = Moved::default();
        for k in 0..run.len() {
            if run.is_image(k) {
                continue;
            }
            moved.degraded |= self.push(&mut run, k);
            let was = run.position(k);
            let way = run.velocity(k) * self.step.dt as f32 + (self.shift)(run.first + k);
            let mut state = (was + way.clamp_length_max(self.longest), run.velocity(k));
            if self.meetings.is_none_or(|meetings| !meetings.of(run.first + k).is_empty()) {
                run.held[k] = if self.touch(was, &mut state, loads) { 0.0 } else { run.held[k] };
                // Between two that close in on it a particle would be squirted out at any speed.
                state.1 = state.1.clamp_length_max(self.step.cap);
            }
            run.set(k, state);
            moved.fastest = moved.fastest.max(state.1.length());
        }
        moved
    }

    /// Gives a particle its acceleration, unless its source still leads it. Returns whether it had to be rescued.
    fn push(&self, run: &mut Run<'_>, k: usize) -> bool {
        let (dt, Step { cap, guard, .. }) = (self.step.dt as f32, *self.step);
        run.age[k] += dt;
        let mut velocity = run.velocity(k);
        if run.held[k] > 0.0 {
            run.held[k] -= dt;
        } else {
            let [x, y, z, _] = self.rows[run.first + k];
            velocity = (velocity + (Vec3::new(x, y, z) + self.gravity) * dt) * self.decay;
        }
        let speed = velocity.length();
        let held_back = if speed > cap { velocity * (cap / speed) } else { velocity };
        run.set(k, (run.position(k), held_back));
        speed > cap && speed > guard
    }

    /// Stops a particle at all surfaces, and tells the bodies of the impulse of each. Returns whether there was any.
    /// A particle that comes from `was` goes through no wall, however far a body that is suddenly there puts it.
    fn touch(&self, was: Vec3, state: &mut (Vec3, Vec3), loads: &mut [BodyLoad]) -> bool {
        let (rule, solids) = (self.step.contact, &self.solids);
        let (mut met, mut met_body) = (false, false);
        solids.visit(state.0, rule.distance, |m| {
            met = true;
            met_body |= m.body.is_some();
            let impulse = stop(state, &m, rule, self.mass);
            if let (true, Some(body)) = (self.two_way, m.body) {
                loads[body].react(impulse / self.step.dt as f32, Vec3::ZERO, m.contact.arm);
            }
        });
        if met_body {
            // A tool that overlaps a wall must not push water through it.
            state.0 = solids.walls.hold(was, state.0);
            let walls = Solids { bodies: &[], ..*solids };
            walls.visit(state.0, rule.distance, |m| {
                stop(state, &m, rule, self.mass);
            });
        }
        met
    }
}

/// Contact by impulse (thesis: v_a = u_a + (j/m_a) n): takes the approach out of a particle's velocity but for
/// the share that it keeps, and puts the particle back to the contact distance. Returns the impulse on the
/// particle, N·s.
fn stop(state: &mut (Vec3, Vec3), m: &Meeting, rule: ContactRule, mass: f32) -> Vec3 {
    let n = m.contact.normal;
    state.0 += (rule.distance - m.contact.distance) * n;
    let approach = (state.1 - m.contact.velocity).dot(n);
    if approach >= 0.0 {
        return Vec3::ZERO;
    }
    let j = -(1.0 + rule.restitution) * approach / (1.0 / mass + m.inverse_mass);
    state.1 += j / mass * n;
    j * n
}
