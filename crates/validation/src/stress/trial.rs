//! One trial: a scene, and some frames of it in which everything is tried.

use super::dice::Dice;
use super::draw::{addresses, misfit};
use super::judge::{Frame, Judge};
use super::motion::{Moved, Mover};
use super::scenery::Scenery;
use glam::DVec3;
use hapflow_engine::settings;
use hapflow_fluid::{
    BodyDrive, BodyMotion, CpuBackend, FluidBackend, FluidConfig, FrameInput, ParticleView, step_limits,
};
use hapflow_haptics::CouplingKind;

/// Settings that are tried with values that they must refuse.
const REFUSALS: usize = 20;
/// Scenes that are drawn until one is accepted.
const DRAWS: usize = 20;
/// What a trial may cost: sub-steps of a particle.
const BUDGET: f64 = 3e5;
/// Most frames, and their lengths, s.
const FRAMES: usize = 30;
const LENGTHS: [f64; 2] = [1e-4, 0.1];

/// Runs the trial of `seed`.
///
/// # Errors
/// What went wrong.
pub(super) fn run(seed: u64) -> Result<(), String> {
    let mut dice = Dice::new(seed);
    for _ in 0..DRAWS {
        let scenery = Scenery::draw(&mut dice);
        refuse_what_does_not_fit(&scenery, &mut dice)?;
        // What is refused is refused by both, and neither panics.
        let checked = scenery.scene.check();
        let config = scenery.config();
        match (checked, CpuBackend::new(&config)) {
            (Ok(()), Ok(fluid)) => return Trial::new(scenery, fluid, dice).frames(),
            (Err(_), Ok(_)) if config.check().is_ok() => {}
            (Err(error), Ok(_)) => return Err(format!("the fluid takes what the scene refuses: {error}")),
            (_, Err(_)) => {}
        }
    }
    Ok(())
}

/// A value outside its range is refused by name, and changes nothing.
fn refuse_what_does_not_fit(scenery: &Scenery, dice: &mut Dice) -> Result<(), String> {
    let all = addresses(&scenery.scene);
    for _ in 0..REFUSALS {
        let Some(address) = dice.pick_named(&all, |a| &a.path) else { return Ok(()) };
        let (mut scene, value) = (scenery.scene.clone(), misfit(&address.kind, dice));
        match settings::set(&mut scene, &address.path, &value) {
            Ok(()) => return Err(format!("{} = {value} is taken", address.path)),
            Err(e) if !e.to_string().contains(&address.path) => {
                return Err(format!("{} = {value} is refused without its name: {e}", address.path));
            }
            Err(_) if scene != scenery.scene => {
                return Err(format!("{} = {value} is refused, and changes the scene", address.path));
            }
            Err(_) => {}
        }
    }
    Ok(())
}

/// A trial under way.
struct Trial {
    scenery: Scenery,
    config: FluidConfig,
    fluid: CpuBackend,
    view: ParticleView,
    judge: Judge,
    movers: Vec<Mover>,
    dice: Dice,
    /// What is left to spend.
    budget: f64,
    /// A setting is another than in the last frame.
    changed: bool,
    /// What was done, for the record.
    told: Vec<String>,
}

impl Trial {
    fn new(scenery: Scenery, fluid: CpuBackend, dice: Dice) -> Self {
        let config = scenery.config();
        let mover =
            |b: &hapflow_fluid::BodyConfig| Mover::new(b.position, b.shape.bounding_radius().max(1e-6));
        Self {
            movers: config.world.bodies.iter().map(mover).collect(),
            scenery,
            config,
            fluid,
            view: ParticleView::default(),
            judge: Judge::default(),
            dice,
            budget: BUDGET,
            changed: false,
            told: Vec::new(),
        }
    }

    fn frames(mut self) -> Result<(), String> {
        self.fluid.snapshot(&mut self.view);
        self.judge.take_state(&self.config, &self.view);
        for k in 0..FRAMES {
            if k > 0 && self.dice.chance(0.25) {
                self.change();
            }
            let wrong = self.frame();
            wrong.map_err(|what| format!("frame {k}: {what} ({})", self.story()))?;
            if self.budget <= 0.0 {
                break;
            }
        }
        Ok(())
    }

    /// What the trial is about.
    fn story(&self) -> String {
        let s = &self.config.settings;
        let first = format!("{:?}, {:?}, {} particles", s.solver, s.mode, self.view.ids.len());
        std::iter::once(first).chain(self.told.iter().cloned()).collect::<Vec<_>>().join("; ")
    }

    /// Gives a live setting a new value. If the fluid refuses it, it must go on as it was.
    fn change(&mut self) {
        let Some((scenery, told)) = self.scenery.changed(&mut self.dice) else { return };
        let config = scenery.config();
        if self.fluid.configure(&config).is_ok() {
            (self.scenery, self.config) = (scenery, config);
            self.told.push(told);
            self.changed = true;
            self.fluid.snapshot(&mut self.view);
            self.judge.take_state(&self.config, &self.view);
        }
    }

    fn frame(&mut self) -> Result<(), String> {
        let duration = self.length();
        let moved = self.move_bodies(duration);
        let motions: Vec<_> =
            moved.iter().map(|(drive, m)| BodyMotion { drive: *drive, path: &m.path }).collect();
        self.fluid.submit(&FrameInput { duration, bodies: &motions });
        let output = self.fluid.poll().cloned().ok_or("no output")?;
        self.fluid.snapshot(&mut self.view);
        let work = output.substeps.max(output.iterations) * output.particles;
        self.budget -= work as f64 + 0.03 * BUDGET;
        let led = moved.iter().filter(|(drive, _)| *drive != BodyDrive::Free);
        let speed = led.map(|(_, m)| m.speed).fold(0.0, f64::max);
        let bodies = moved.iter().zip(&output.bodies).filter(|(m, _)| m.0 == BodyDrive::Free);
        let free = bodies.map(|(_, b)| b.velocity.length()).fold(0.0, f64::max);
        let born = self.config.world.sources.iter().any(|s| s.on);
        let sudden = moved.iter().any(|(_, m)| m.jumped) || std::mem::take(&mut self.changed) || born;
        let thrown = if sudden {
            // From one to the next, at worst.
            self.config.world.bodies.iter().map(|b| 2.0 * b.shape.bounding_radius()).sum()
        } else {
            0.0
        };
        self.judge.look(&self.config, Frame { duration, speed, free, thrown }, &self.view, &output)
    }

    /// The length of the next frame, s: any that there is something left for.
    fn length(&mut self) -> f64 {
        let wanted = self.dice.scale(LENGTHS[0], LENGTHS[1]);
        let speed = self.judge.ledger.speed().min(20.0);
        let step = step_limits(&self.config, speed).shortest();
        wanted.min(0.3 * self.budget.max(0.1 * BUDGET) / self.view.ids.len().max(50) as f64 * step)
    }

    /// Moves tools and obstacles; free bodies move themselves.
    fn move_bodies(&mut self, duration: f64) -> Vec<(BodyDrive, Moved)> {
        let tools = self.scenery.scene.tools().count();
        let led = tools + self.scenery.scene.obstacles.len();
        let driven = self.scenery.scene.run.coupling == CouplingKind::Momentum;
        let room = self.config.world.bounds;
        let mut all = Vec::new();
        for (k, mover) in self.movers.iter_mut().enumerate() {
            let moved = mover.next(duration, &room, &mut self.dice);
            let drive = match k {
                k if k >= led => BodyDrive::Free,
                k if k < tools && driven => {
                    let velocity = moved.path.last().map_or(DVec3::ZERO, |s| s.velocity);
                    BodyDrive::Driven { velocity }
                }
                _ => BodyDrive::Led,
            };
            if drive == BodyDrive::Led && moved.jumped {
                let body = self.config.world.bodies[k].shape.volume();
                let fluid = self.view.ids.len() as f64 * self.config.settings.spacing.powi(3);
                self.judge.ledger.take_jump(&self.config, body / fluid.max(1e-30));
            }
            all.push((drive, moved));
        }
        all
    }
}
