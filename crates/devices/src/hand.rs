//! A hand that is not there: a mass on a spring and damper that holds a simulated device.

use crate::mass::Mass;
use crate::{DeviceError, HandSettings, HapticDevice, Pacing, PathPoint, TargetScript};
use glam::DVec3;
use hapflow_haptics::{GatedWrench, ToolState, VelocityEstimator};
use std::collections::VecDeque;

/// Longest stretch of time that is simulated at once, s: after a longer pause the hand goes on from where it
/// was, and only the end of the pause is lived through, so that no tick takes long.
const MAX_GAP_S: f64 = 0.1;

/// Most forces that are on their way to the device at once: those of 50 ms at 1 kHz, and a few.
const MOST_PENDING: usize = 64;

/// A hand that follows a [`TargetScript`] and gives way to the force that is written:
///
/// (m_device + m_hand) x″ = F + k (p − x) + b_hand (p′ − x′) − b_device x′ − f x′/|x′|,
///
/// with p, p′ the script's place and velocity. That is the usual impedance of a hand about a wanted motion
/// (N. Hogan, "Impedance control", J. Dyn. Sys. Meas. Control 107 (1985), doi:10.1115/1.3140702).
///
/// A written force acts after the transport's delay until the next one, so without delay over the tick that follows. Dry
/// friction f takes its impulse off each step's momentum, and never turns it round; at rest it lets the device creep by
/// less than a tenth of a millimetre a second. [`read`](HapticDevice::read) lives
/// through the time up to the one asked for, in steps of at most 0.25 ms that are exact for a steady force
/// and a straight wish. The first read is the beginning: the hand is at rest at the script's start. A time
/// that does not grow moves nothing. Costs about a microsecond a tick.
#[derive(Clone, Debug)]
pub struct SimulatedHand {
    settings: HandSettings,
    script: TargetScript,
    mass: Mass,
    force: DVec3,
    /// Forces that are on their way: when each begins to act, s, and what it is, N.
    pending: VecDeque<(f64, DVec3)>,
    time_s: Option<f64>,
    velocity: VelocityEstimator,
    closed: bool,
}

impl SimulatedHand {
    /// A hand at rest at the start of its script.
    ///
    /// # Errors
    /// [`DeviceError::Setting`] if a setting is outside its range.
    pub fn new(settings: HandSettings, script: TargetScript) -> Result<Self, DeviceError> {
        settings.check()?;
        let mass = Mass {
            mass_kg: settings.device_mass_kg + settings.hand_mass_kg,
            damping_n_s_per_m: settings.device_damping_n_s_per_m + settings.hand_damping_n_s_per_m,
            stiffness_n_per_m: settings.hand_stiffness_n_per_m,
            position: script.start(),
            velocity: DVec3::ZERO,
        };
        let velocity = VelocityEstimator::new(settings.velocity_cutoff_hz)?;
        let pending = VecDeque::with_capacity(MOST_PENDING);
        Ok(Self {
            settings,
            script,
            mass,
            force: DVec3::ZERO,
            pending,
            time_s: None,
            velocity,
            closed: false,
        })
    }

    /// Its settings.
    pub fn settings(&self) -> &HandSettings {
        &self.settings
    }

    /// What it follows.
    pub fn script(&self) -> &TargetScript {
        &self.script
    }

    /// Where it truly is, without the encoder's steps, at the time of the newest read.
    pub fn truth(&self) -> PathPoint {
        PathPoint { position: self.mass.position, velocity: self.mass.velocity }
    }

    /// Takes a force that no gate has let out, N: for a hand at an emulated device, whose motors give it.
    pub(crate) fn feel(&mut self, force: DVec3) {
        self.force = force;
    }

    /// Lives through the time up to `time_s`.
    fn advance_to(&mut self, time_s: f64) {
        if !time_s.is_finite() {
            return;
        }
        let gap_s = (time_s - self.time_s.unwrap_or(time_s)).min(MAX_GAP_S);
        if gap_s > 0.0 {
            self.advance(time_s - gap_s, gap_s);
        }
        self.time_s = Some(self.time_s.map_or(time_s, |time| time.max(time_s)));
    }

    fn advance(&mut self, begin_s: f64, gap_s: f64) {
        let steps = (gap_s / self.mass.longest_step_s()).ceil().max(1.0);
        let step_s = gap_s / steps;
        let mut from = self.wish(begin_s);
        for n in 0..steps as u32 {
            self.take_forces(begin_s + (f64::from(n) + 0.5) * step_s);
            let to = self.wish(begin_s + f64::from(n + 1) * step_s);
            self.mass.advance(self.force + from, self.force + to, step_s);
            self.mass.rub(self.settings.device_friction_n, step_s);
            from = to;
        }
    }

    /// The newest force that acts at `time_s`.
    fn take_forces(&mut self, time_s: f64) {
        while let Some((_, force)) = self.pending.pop_front_if(|(acts_s, _)| *acts_s <= time_s) {
            self.force = force;
        }
    }

    /// How the hand's wish pulls at the mass at `time_s`, N.
    fn wish(&self, time_s: f64) -> DVec3 {
        let wish = self.script.at(time_s);
        wish.position * self.settings.hand_stiffness_n_per_m
            + wish.velocity * self.settings.hand_damping_n_s_per_m
    }

    /// What the device's encoders say at `time_s`.
    fn measure(&mut self, time_s: f64) -> ToolState {
        let step = self.settings.encoder_step_m;
        if step == 0.0 {
            return ToolState { velocity: self.mass.velocity, ..ToolState::at(self.mass.position) };
        }
        let position = (self.mass.position / step).round() * step;
        ToolState { velocity: self.velocity.update(time_s, position), ..ToolState::at(position) }
    }
}

impl HapticDevice for SimulatedHand {
    fn name(&self) -> &str {
        "hand"
    }

    fn pacing(&self) -> Pacing {
        Pacing::Timer
    }

    fn read(&mut self, time_s: f64) -> Result<ToolState, DeviceError> {
        DeviceError::if_closed(self.closed, "hand")?;
        self.advance_to(time_s);
        Ok(self.measure(self.time_s.unwrap_or(0.0)))
    }

    fn write(&mut self, wrench: GatedWrench, _dt_s: f64) -> Result<(), DeviceError> {
        DeviceError::if_closed(self.closed, "hand")?;
        if self.pending.len() == MOST_PENDING {
            self.pending.pop_front();
        }
        let acts_s = self.time_s.unwrap_or(0.0) + self.settings.transport_delay_s;
        self.pending.push_back((acts_s, wrench.force()));
        Ok(())
    }

    fn close(&mut self) {
        self.force = DVec3::ZERO;
        self.pending.clear();
        self.closed = true;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{AtEnd, HandPreset, Segment};
    use hapflow_haptics::{FaultSet, GateSettings, ModelAge, SafetyGate, Wrench};
    use std::f64::consts::TAU;

    const DT: f64 = 1e-3;

    /// A force as a gate lets it out.
    fn gated(force: DVec3) -> GatedWrench {
        let settings = GateSettings { ramp_in_s: 0.0, max_slew_n_per_s: 1e6, ..GateSettings::default() };
        let mut gate = SafetyGate::new(settings).unwrap();
        gate.pass(Wrench::from_force(force), &ModelAge::FRESH, FaultSet::NONE, DT)
    }

    fn hand(settings: HandSettings, segments: &[Segment]) -> SimulatedHand {
        let script = TargetScript::new(DVec3::ZERO, segments, AtEnd::Hold).unwrap();
        SimulatedHand::new(settings, script).unwrap()
    }

    #[test]
    fn a_push_gives_the_step_response_of_a_mass_spring_damper() {
        let mut hand = hand(HandSettings::default(), &[]);
        let (m, c, k, f) = (0.35, 4.5, 300.0, -2.0);
        let sigma: f64 = c / (2.0 * m);
        let omega = (k / m - sigma * sigma).sqrt();
        for tick in 0..500 {
            let t = f64::from(tick) * DT;
            let tool = hand.read(t).unwrap();
            let swing = (omega * t).cos() + sigma / omega * (omega * t).sin();
            let x = f / k * (1.0 - (-sigma * t).exp() * swing);
            let v = f / (m * omega) * (-sigma * t).exp() * (omega * t).sin();
            assert!((tool.position - DVec3::Y * x).length() < 1e-13, "tick {tick}: {}", tool.position);
            assert!((tool.velocity - DVec3::Y * v).length() < 1e-11, "tick {tick}: {}", tool.velocity);
            hand.write(gated(DVec3::Y * f), DT).unwrap();
        }
    }

    #[test]
    fn a_free_device_runs_up_to_force_over_damping() {
        let mut hand = hand(HandSettings::preset(HandPreset::Free), &[]);
        for tick in 0..1000 {
            let t = f64::from(tick) * DT;
            let expected = 1.0 / 0.5 * (1.0 - (-0.5 * t / 0.2_f64).exp());
            assert!((hand.read(t).unwrap().velocity.x - expected).abs() < 1e-11);
            hand.write(gated(DVec3::X), DT).unwrap();
        }
    }

    #[test]
    fn a_swing_is_followed_as_the_transfer_function_says() {
        let (frequency, amplitude) = (4.0, 0.02);
        let swing =
            Segment::Sine { amplitude: DVec3::Z * amplitude, frequency_hz: frequency, duration_s: 10.0 };
        let mut hand = hand(HandSettings::default(), &[swing]);
        let (mut sine, mut cosine) = (0.0, 0.0);
        for tick in 0..6000 {
            let t = f64::from(tick) * DT;
            let z = hand.read(t).unwrap().position.z;
            if tick >= 4000 {
                sine += z * (TAU * frequency * t).sin() / 1000.0;
                cosine += z * (TAU * frequency * t).cos() / 1000.0;
            }
        }
        // (k + b s) / (m s² + c s + k) at s = iω, numerator over denominator.
        let w = TAU * frequency;
        let (num, den) = ((300.0, 4.0 * w), (300.0 - 0.35 * w * w, 4.5 * w));
        let norm = den.0 * den.0 + den.1 * den.1;
        let re = (num.0 * den.0 + num.1 * den.1) / norm;
        let im = (num.1 * den.0 - num.0 * den.1) / norm;
        assert!((sine - amplitude * re).abs() < 1e-7, "{sine} is not {}", amplitude * re);
        assert!((cosine - amplitude * im).abs() < 1e-7, "{cosine} is not {}", amplitude * im);
    }

    #[test]
    fn once_let_go_its_energy_only_falls() {
        for preset in HandPreset::ALL {
            let settings = HandSettings::preset(preset);
            let mut hand = hand(settings, &[]);
            for tick in 0..300 {
                hand.read(f64::from(tick) * DT).unwrap();
                hand.write(gated(DVec3::new(2.0, -3.0, 1.0)), DT).unwrap();
            }
            hand.write(GatedWrench::ZERO, DT).unwrap();
            let mass = settings.device_mass_kg + settings.hand_mass_kg;
            let mut before = f64::INFINITY;
            for tick in 300..3000 {
                let tool = hand.read(f64::from(tick) * DT).unwrap();
                let energy = 0.5 * mass * tool.velocity.length_squared()
                    + 0.5 * settings.hand_stiffness_n_per_m * tool.position.length_squared();
                assert!(energy <= before + 1e-18, "{} at tick {tick}: {before} to {energy} J", preset.name());
                before = energy;
            }
            assert!(before < 0.1, "{}: {before} J", preset.name());
        }
    }

    #[test]
    fn a_written_force_acts_after_the_transports_delay() {
        let settings = HandSettings { transport_delay_s: 0.003, ..HandSettings::preset(HandPreset::Free) };
        let mut hand = hand(settings, &[]);
        for tick in 0..=4 {
            let tool = hand.read(f64::from(tick) * DT).unwrap();
            assert_eq!(tool.velocity.x > 0.0, tick == 4, "tick {tick}: {}", tool.velocity);
            hand.write(gated(DVec3::X), DT).unwrap();
        }
    }

    /// A push below the dry friction moves nothing; one above moves by the difference; without a push it stops.
    #[test]
    fn dry_friction_holds_and_slows() {
        let free = HandSettings { device_damping_n_s_per_m: 0.0, ..HandSettings::preset(HandPreset::Free) };
        let settings = HandSettings { device_friction_n: 0.3, ..free };
        let mut hand = hand(settings, &[]);
        let mut run = |ticks: std::ops::Range<u32>, push: f64| {
            for tick in ticks {
                hand.read(f64::from(tick) * DT).unwrap();
                hand.write(gated(DVec3::X * push), DT).unwrap();
            }
            hand.truth()
        };
        assert!(run(0..500, 0.29).position.x < 1e-4);
        let pushed = run(500..1000, 1.0);
        assert!((pushed.velocity.x / (0.7 / 0.2 * 0.498) - 1.0).abs() < 0.01, "{}", pushed.velocity);
        assert_eq!(run(1000..3000, 0.0).velocity, DVec3::ZERO);
    }

    #[test]
    fn it_reaches_where_the_script_goes() {
        let to = DVec3::new(0.1, -0.05, 0.02);
        let mut hand = hand(HandSettings::default(), &[Segment::MoveTo { position: to, duration_s: 1.0 }]);
        (0..3000).for_each(|tick| assert!(hand.read(f64::from(tick) * DT).unwrap().is_finite()));
        assert!((hand.truth().position - to).length() < 1e-6);
        assert!(hand.truth().velocity.length() < 1e-5);
    }

    #[test]
    fn how_often_it_is_read_does_not_matter() {
        let swing = Segment::Sine { amplitude: DVec3::X * 0.02, frequency_hz: 2.0, duration_s: 10.0 };
        let mut often = hand(HandSettings::default(), &[swing]);
        let mut seldom = often.clone();
        for tick in 0..=2000 {
            often.read(f64::from(tick) * 0.5e-3).unwrap();
            if tick % 20 == 0 {
                seldom.read(f64::from(tick) * 0.5e-3).unwrap();
            }
        }
        assert!((often.truth().position - seldom.truth().position).length() < 1e-8);
    }

    #[test]
    fn encoders_round_and_velocity_is_estimated() {
        let settings = HandSettings { encoder_step_m: 60e-6, ..HandSettings::default() };
        let swing = Segment::Sine { amplitude: DVec3::X * 0.05, frequency_hz: 1.0, duration_s: 10.0 };
        let mut hand = hand(settings, &[swing]);
        let mut worst: f64 = 0.0;
        for tick in 0..2000 {
            let tool = hand.read(f64::from(tick) * DT).unwrap();
            let truth = hand.truth();
            let steps = tool.position.x / 60e-6;
            assert!((steps - steps.round()).abs() < 1e-9);
            assert!((tool.position.x - truth.position.x).abs() <= 30e-6 + 1e-12);
            if tick > 100 {
                worst = worst.max((tool.velocity.x - truth.velocity.x).abs());
            }
        }
        // One encoder step in a tick is 60 mm/s: the estimate must be well below it, but cannot be perfect.
        assert!(worst > 1e-4 && worst < 0.04, "{worst} m/s");
    }

    #[test]
    fn times_that_do_not_grow_move_nothing() {
        let mut hand = hand(HandSettings::default(), &[]);
        hand.read(0.0).unwrap();
        hand.write(gated(DVec3::X), DT).unwrap();
        let tool = hand.read(0.01).unwrap();
        for time in [0.01, 0.005, -1.0, f64::NAN, f64::INFINITY] {
            assert_eq!(hand.read(time), Ok(tool), "at {time}");
        }
        assert!(hand.read(0.011).unwrap().position.x > tool.position.x);
    }

    #[test]
    fn the_first_read_is_the_beginning_and_pauses_are_short() {
        let mut hand = hand(HandSettings::default(), &[]);
        assert_eq!(hand.read(1e5), Ok(ToolState::default()));
        hand.write(gated(DVec3::X), DT).unwrap();
        let after = hand.read(2e5).unwrap();
        let mut other = self::hand(HandSettings::default(), &[]);
        other.read(0.0).unwrap();
        other.write(gated(DVec3::X), DT).unwrap();
        assert!((after.position - other.read(0.1).unwrap().position).length() < 1e-9);
    }

    #[test]
    fn closing_takes_the_force_off() {
        let mut hand = hand(HandSettings::default(), &[]);
        hand.write(gated(DVec3::X), DT).unwrap();
        hand.close();
        assert_eq!(hand.force, DVec3::ZERO);
        assert_eq!(hand.read(0.0), Err(DeviceError::Closed { device: "hand" }));
        assert!(hand.write(GatedWrench::ZERO, DT).is_err());
    }

    #[test]
    fn settings_are_checked() {
        let script = TargetScript::new(DVec3::ZERO, &[], AtEnd::Hold).unwrap();
        let settings = HandSettings { device_mass_kg: 0.0, ..HandSettings::default() };
        assert!(matches!(SimulatedHand::new(settings, script), Err(DeviceError::Setting(_))));
    }
}
