//! What must hold after every step, whatever was asked for.

use super::crowd;
use super::ledger::{Ledger, kinetic};
use crate::run::vectors;
use glam::DVec3;
use hapflow_fluid::{ContainerForm, FluidConfig, FrameOutput, InteractionMode, ParticleView};
use std::collections::HashMap;

/// How far into a wall a particle may come, in spacings: the last stop of `wcsph` lies a quarter behind it.
const IN_WALL: f64 = 0.3;
/// Energy that the fluid may have of what was put in; the sums of the ledger are of its largest parts.
const ENERGY: f64 = 1.5;
/// Mean square of crowding, beside what the energy put in explains.
const CROWDING: f64 = 1.0;
/// Force in units of area times the pressures that there can be.
const FORCE: f64 = 3.0;

/// One frame as it was asked for.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    /// Its length, s.
    pub duration: f64,
    /// Highest speed of the surface of a body that is moved, m/s.
    pub speed: f64,
    /// Highest speed of a free body's middle, m/s.
    pub free: f64,
    /// How far a body that is suddenly there may put a particle, m.
    pub thrown: f64,
}

/// Watches over one trial.
#[derive(Debug, Default)]
pub(super) struct Judge {
    pub ledger: Ledger,
    /// Most particles so far.
    most: usize,
    /// A source has run.
    fed: bool,
    /// Everybody at the last look, by number.
    seen: HashMap<u32, Seen>,
}

/// A particle at the last look.
#[derive(Clone, Copy, Debug)]
struct Seen {
    /// How far it was from any way out of the world, m.
    exit: f64,
    /// Whether it was in the container; a source may stand behind its wall.
    inside: bool,
}

impl Judge {
    /// Takes a start or a change: of a fluid that is new in all its parts, nobody is looked for.
    pub fn take_state(&mut self, config: &FluidConfig, view: &ParticleView) {
        self.ledger.take_config(config);
        self.ledger.take_state(config, crowd::squeeze(&crowd::fill(view, config.settings.spacing)));
        self.remember(config, view);
    }

    /// Says what is wrong, if anything.
    pub fn look(
        &mut self,
        config: &FluidConfig,
        frame: Frame,
        view: &ParticleView,
        output: &FrameOutput,
    ) -> Result<(), String> {
        self.ledger.take_config(config);
        self.ledger.take_motion(frame.speed);
        self.most = self.most.max(view.ids.len());
        self.fed |= config.world.sources.iter().any(|s| s.on);
        finite(view, output)?;
        in_the_world(config, frame, view)?;
        self.contained(config, view)?;
        self.nobody_lost(config, frame, view, output)?;
        slow(config, frame, view, output)?;
        self.calm(config, view)?;
        self.loose(config, view)?;
        self.bearable(config, frame, view, output)?;
        self.remember(config, view);
        Ok(())
    }

    fn remember(&mut self, config: &FluidConfig, view: &ParticleView) {
        let inside = |p| is_closed(config) && depth_in_wall(config, p) < IN_WALL * config.settings.spacing;
        let seen = vectors(&view.positions).map(|p| {
            let inside = inside(p);
            Seen { exit: way_out(config, p, inside), inside }
        });
        self.seen = view.ids.iter().copied().zip(seen).collect();
    }

    /// Whoever was in a container that is closed is still there.
    fn contained(&self, config: &FluidConfig, view: &ParticleView) -> Result<(), String> {
        let dx = config.settings.spacing;
        for (id, p) in view.ids.iter().zip(vectors(&view.positions)) {
            let depth = depth_in_wall(config, p) / dx;
            if depth > IN_WALL && self.seen.get(id).is_some_and(|s| s.inside) {
                return Err(format!("particle {id} is {depth:.2} spacings in the wall"));
            }
        }
        Ok(())
    }

    /// Whoever is gone has gone through an open side.
    fn nobody_lost(
        &self,
        config: &FluidConfig,
        frame: Frame,
        view: &ParticleView,
        output: &FrameOutput,
    ) -> Result<(), String> {
        if config.settings.lifetime > 0.0 || !config.world.sinks.is_empty() {
            return Ok(());
        }
        let there: std::collections::HashSet<_> = view.ids.iter().collect();
        // What a contact or a shift moves a particle by comes on top.
        let reach =
            (output.max_speed + frame.speed) * frame.duration + frame.thrown + 2.0 * config.settings.spacing;
        match self.seen.iter().find(|(id, seen)| !there.contains(id) && seen.exit > reach) {
            Some((id, seen)) => Err(format!("particle {id} is lost {:.3e} m from any way out", seen.exit)),
            None => Ok(()),
        }
    }

    /// The energy of motion was put in.
    fn calm(&self, config: &FluidConfig, view: &ParticleView) -> Result<(), String> {
        let (have, given) =
            (kinetic(vectors(&view.velocities)), ENERGY * self.most as f64 * self.ledger.total());
        let m = config.settings.particle_mass();
        if have <= given || !is_roomy(config) {
            return Ok(());
        }
        Err(format!("energy of motion {:.3e} J, and {:.3e} J were put in", m * have, m * given))
    }

    /// The fluid is no denser than what was put in can make it.
    fn loose(&self, config: &FluidConfig, view: &ParticleView) -> Result<(), String> {
        let c = config.sound_speed();
        let explained = 2.0 * self.ledger.total() / (c * c).max(1e-30);
        // A source pushes its fluid in, whatever is there.
        if config.settings.mode == InteractionMode::None || self.fed || !is_roomy(config) {
            return Ok(());
        }
        let found = crowd::squeeze(&crowd::fill(view, config.settings.spacing));
        if found <= CROWDING + explained {
            return Ok(());
        }
        Err(format!("density {:.2} times that at rest, on the mean", 1.0 + found.sqrt()))
    }

    /// No force is larger than the pressures that there can be, on the whole surface.
    fn bearable(
        &self,
        config: &FluidConfig,
        frame: Frame,
        view: &ParticleView,
        output: &FrameOutput,
    ) -> Result<(), String> {
        let s = &config.settings;
        let (c, rho, dx) = (config.sound_speed(), s.rest_density, s.spacing);
        let v = output.max_speed + frame.speed + self.ledger.speed();
        let squeeze = crowd::fill(view, dx).into_iter().fold(1.0, f64::max) - 1.0;
        let hammer = rho * (c + v) * v;
        let stress = s.viscosity * v / dx + s.surface_tension / dx;
        let pressure = hammer + self.ledger.pressure(config) + rho * c * c * squeeze + stress;
        // What a free body is pressed against may be felt through it, and there is no telling how much.
        let alone = !config.world.bodies.is_empty() && frame.free == 0.0;
        let bodies = if alone { &config.world.bodies[..] } else { &[] };
        for (k, (body, load)) in bodies.iter().zip(&output.loads).enumerate() {
            let radius = body.shape.bounding_radius() + dx;
            let most = FORCE * 4.0 * std::f64::consts::PI * radius * radius * pressure;
            let (force, torque) = (load.force().length(), load.torque.length());
            if force > most || torque > most * radius {
                return Err(format!("body {k}: {force:.3e} N and {torque:.3e} N m, most {most:.3e} N"));
            }
        }
        Ok(())
    }
}

fn finite(view: &ParticleView, output: &FrameOutput) -> Result<(), String> {
    let rows = view.positions.iter().chain(&view.velocities).flatten().chain(&view.pressures);
    let body = |b: &hapflow_fluid::BodyState| {
        let velocities = b.velocity.is_finite() && b.angular_velocity.is_finite();
        b.position.is_finite() && b.orientation.is_finite() && velocities
    };
    let load = |l: &hapflow_fluid::BodyLoad| l.force().is_finite() && l.torque.is_finite();
    for (sound, what) in [
        (rows.copied().all(f32::is_finite), "a particle"),
        (output.bodies.iter().all(body), "a body"),
        (output.loads.iter().all(load), "a load"),
        (output.max_speed.is_finite(), "the highest speed"),
    ] {
        if !sound {
            return Err(format!("{what} is not finite"));
        }
    }
    Ok(())
}

/// Whether the container reaches to the top of the world, so that nobody comes over its rim.
fn is_closed(config: &FluidConfig) -> bool {
    let bounds = config.world.bounds;
    let holds = |c: hapflow_fluid::Container| {
        // A box that stands in the world's corner would let what leaks vanish at once.
        c.inner.max.y >= bounds.max.y && !config.world.periodic.contains(&true)
    };
    config.world.container.is_some_and(holds)
}

/// Whether the fluid can make way: no body nearly fills the container. Where one does, fluid that comes in is squeezed
/// into what is there, and no simple sum tells how much that gives.
fn is_roomy(config: &FluidConfig) -> bool {
    let room = config.world.container.map_or(config.world.bounds, |c| c.inner);
    let wide = (room.max - room.min).min_element();
    let bodies: f64 = config.world.bodies.iter().map(|b| 2.0 * b.shape.bounding_radius()).sum();
    bodies < 0.7 * wide
}

/// How far it is out of the world from `p`, `inside` a closed container or not, m; not through what is solid.
fn way_out(config: &FluidConfig, p: DVec3, inside: bool) -> f64 {
    let (bounds, periodic) = (config.world.bounds, config.world.periodic);
    let top = bounds.max.y - p.y;
    let (low, high) = (p - bounds.min, bounds.max - p);
    let side = |axis: usize| if periodic[axis] { f64::INFINITY } else { low[axis].min(high[axis]) };
    let floor = config.world.ground.filter(|&y| y >= bounds.min.y).map_or(low.y, |_| f64::INFINITY);
    if inside { top } else { top.min(floor).min(side(0)).min(side(2)) }
}

fn in_the_world(config: &FluidConfig, frame: Frame, view: &ParticleView) -> Result<(), String> {
    let (bounds, s) = (config.world.bounds, &config.settings);
    // Who leaves the world is dropped when the next step begins; walls and bodies may have handed it on, each to a
    // contact's distance.
    let bodies = config.world.bodies.iter().map(|b| 2.0 * b.shape.bounding_radius() + s.spacing);
    let handed = bodies.sum::<f64>() + 4.0 * s.spacing;
    let slack = DVec3::splat((config.highest_speed() + frame.speed) * frame.duration + handed);
    let outside = |p: &DVec3| !(p.cmpge(bounds.min - slack).all() && p.cmple(bounds.max + slack).all());
    match vectors(&view.positions).find(outside) {
        Some(p) => Err(format!("a particle is out of the world at {p}")),
        None => Ok(()),
    }
}

/// How far `p` lies behind the container's walls or its floor, m; negative within.
fn depth_in_wall(config: &FluidConfig, p: DVec3) -> f64 {
    let Some(c) = config.world.container else { return f64::NEG_INFINITY };
    let (low, high) = (c.inner.min - p, p - c.inner.max);
    let arm = p - c.foot();
    match c.form {
        _ if high.y >= 0.0 => f64::NEG_INFINITY,
        ContainerForm::Box => low.max_element().max(high.x).max(high.z),
        ContainerForm::Cylinder => (DVec3 { y: 0.0, ..arm }.length() - c.radius()).max(low.y),
        ContainerForm::Bowl => (arm - DVec3::Y * c.radius()).length() - c.radius(),
    }
}

fn slow(config: &FluidConfig, frame: Frame, view: &ParticleView, output: &FrameOutput) -> Result<(), String> {
    let particles = vectors(&view.velocities).map(DVec3::length).fold(output.max_speed, f64::max);
    let most = 1.001 * config.highest_speed();
    for (fastest, what) in [(particles, "a particle"), (frame.free, "a free body")] {
        if fastest > most {
            return Err(format!("{what} at {fastest:.3e} m/s, most {most:.3e} m/s"));
        }
    }
    Ok(())
}
