//! Where a hand will be in a moment.

use crate::ToolState;
use glam::{DQuat, DVec3};

/// Longest time ahead that a hand goes straight on, s.
const LONGEST_S: f64 = 0.12;
/// Faster than any hand, m/s: such a step is a jump, after which nothing is known.
const JUMP_SPEED: f64 = 20.0;

/// Where the hand is and how fast, by the parabola nearest to its newest `TICKS` places (least squares), carried on.
///
/// The parabola's end knows the velocity without delay. From there the way goes on straight or as the parabola, or between:
/// over 60 ms, and 43 ms ahead, a swing of 3 Hz comes out 5 ms late (straight) or 7 ms early, and one of 20 Hz, where a hand
/// does nothing on purpose, 8 or 12 times too large: in a fluid that answers accelerations that would howl. Steps of an encoder
/// of 60 µm are some 30 to 40 µm there.
#[derive(Clone, Debug)]
pub struct Forecast<const TICKS: usize> {
    times_s: [f64; TICKS],
    places: [DVec3; TICKS],
    next: usize,
    count: usize,
    newest: ToolState,
}

impl<const TICKS: usize> Forecast<TICKS> {
    /// A hand at rest at `tool`.
    pub fn new(tool: ToolState) -> Self {
        Self { times_s: [0.0; TICKS], places: [tool.position; TICKS], next: 0, count: 0, newest: tool }
    }

    /// Takes the tool at `time_s`; times must grow, others are passed over.
    pub fn take(&mut self, time_s: f64, tool: &ToolState) {
        let last = (self.next + TICKS - 1) % TICKS;
        if !time_s.is_finite() || !tool.is_finite() || (self.count > 0 && time_s <= self.times_s[last]) {
            return;
        }
        let way = tool.position.distance(self.places[last]);
        if way > JUMP_SPEED * (time_s - self.times_s[last]) {
            self.count = 0;
        }
        (self.times_s[self.next], self.places[self.next], self.newest) = (time_s, tool.position, *tool);
        self.next = (self.next + 1) % TICKS;
        self.count = (self.count + 1).min(TICKS);
    }

    /// Whether it has seen the hand for long enough to know how it moves.
    pub fn knows(&self) -> bool {
        self.count == TICKS
    }

    /// The tool at `time_s`; after 0.12 s without news it rests. `bend` is the share of the acceleration that goes on, 0..1.
    pub fn at(&self, time_s: f64, bend: f64) -> ToolState {
        if !self.knows() {
            return ToolState { velocity: DVec3::ZERO, ..self.newest };
        }
        let last_s = self.times_s[(self.next + TICKS - 1) % TICKS];
        // A time that is no number is now.
        let since = time_s - last_s;
        let ahead = if since > 0.0 { since.min(LONGEST_S) } else { 0.0 };
        let [place, velocity, half] = self.end(last_s);
        let half = half * bend;
        let moving = if since > LONGEST_S { 0.0 } else { 1.0 };
        let turn = DQuat::from_scaled_axis(self.newest.angular_velocity * ahead);
        ToolState {
            position: place + (velocity + half * ahead) * ahead,
            velocity: (velocity + half * (2.0 * ahead)) * moving,
            orientation: (turn * self.newest.orientation).normalize(),
            ..self.newest
        }
    }

    /// Place, velocity and half the acceleration of the parabola at `zero_s`, its end.
    fn end(&self, zero_s: f64) -> [DVec3; 3] {
        // In units of the window, about its middle, so that the sums are well conditioned.
        let oldest = self.times_s[self.next];
        let (unit, middle) = (0.5 * (zero_s - oldest), 0.5 * (zero_s + oldest));
        let mut moments = [0.0; 5];
        let mut sums = [DVec3::ZERO; 3];
        for (time, place) in self.times_s.iter().zip(&self.places) {
            let s = (time - middle) / unit;
            let (mut power, place) = (1.0, *place - self.newest.position);
            for (k, moment) in moments.iter_mut().enumerate() {
                *moment += power;
                if k < 3 {
                    sums[k] += place * power;
                }
                power *= s;
            }
        }
        let [c0, c1, c2] = solve(&moments, &sums);
        [self.newest.position + c0 + c1 + c2, (c1 + 2.0 * c2) / unit, c2 / (unit * unit)]
    }
}

/// Solves the normal equations of a parabola, of power sums `m` and right sides `b`, by Cramer's rule.
fn solve(m: &[f64; 5], b: &[DVec3; 3]) -> [DVec3; 3] {
    let matrix = glam::DMat3::from_cols_array(&[m[0], m[1], m[2], m[1], m[2], m[3], m[2], m[3], m[4]]);
    if matrix.determinant().abs() < 1e-9 {
        return [b[0] / m[0].max(1.0), DVec3::ZERO, DVec3::ZERO];
    }
    let inverse = matrix.inverse();
    std::array::from_fn(|row| {
        let r = inverse.row(row);
        b[0] * r.x + b[1] * r.y + b[2] * r.z
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fed(place: impl Fn(f64) -> DVec3) -> Forecast<40> {
        let mut forecast = Forecast::new(ToolState::at(place(0.0)));
        (0..100).for_each(|n| {
            let t = f64::from(n) * 1e-3;
            forecast.take(t, &ToolState::at(place(t)));
        });
        forecast
    }

    #[test]
    fn place_and_velocity_of_a_parabola_are_exact() {
        let place = |t: f64| DVec3::new(0.1 - 0.3 * t + 2.0 * t * t, 0.2 * t, -t * t);
        let (now, later) = (fed(place).at(0.099, 0.0), fed(place).at(0.109, 0.0));
        assert!((fed(place).at(0.14, 1.0).position - place(0.14)).length() < 1e-9);
        assert!((now.position - place(0.099)).length() < 1e-9, "{}", now.position);
        assert!((now.velocity - DVec3::new(-0.3 + 4.0 * 0.099, 0.2, -0.198)).length() < 1e-7);
        assert!((later.position - now.position - now.velocity * 0.01).length() < 1e-9);
    }

    #[test]
    fn a_swing_of_a_hand_is_met_and_steps_of_an_encoder_are_smoothed() {
        let swing = |t: f64| DVec3::X * 0.008 * (std::f64::consts::TAU * 1.0 * t).sin();
        let rounded = |t: f64| (swing(t) / 60e-6).round() * 60e-6;
        let (exact, rounded) = (fed(swing).at(0.141, 1.0), fed(rounded).at(0.141, 1.0));
        assert!((exact.position - swing(0.141)).length() < 3e-4, "{}", exact.position);
        assert!((exact.position - rounded.position).length() < 2e-4, "{}", rounded.position - exact.position);
    }

    #[test]
    fn after_a_jump_it_rests() {
        let jumped = fed(|t| if t < 0.09 { DVec3::ZERO } else { DVec3::Y });
        assert_eq!((jumped.at(0.14, 1.0).position, jumped.at(0.14, 1.0).velocity), (DVec3::Y, DVec3::ZERO));
    }

    #[test]
    fn it_rests_until_it_knows_and_after_long_silence() {
        let mut young = Forecast::<40>::new(ToolState::at(DVec3::X));
        young.take(0.0, &ToolState { velocity: DVec3::Y, ..ToolState::at(DVec3::X) });
        assert_eq!(young.at(0.05, 1.0).position, DVec3::X);
        let moving = fed(|t| DVec3::Y * t);
        assert_eq!(moving.at(5.0, 1.0).velocity, DVec3::ZERO);
        assert!(moving.at(5.0, 1.0).position.y < 0.3);
        assert!(moving.at(f64::NAN, 1.0).is_finite());
    }
}
