//! The CPU backend: rayon over chunks of sorted particles, vector lanes inside.
//!
//! One frame = motion of the bodies, then n sub-steps of { emit, sort, forces, integrate, contacts }, then the
//! mean load on each body. The whole frame runs inside the backend's own pool. Nothing depends on the number
//! of threads: see `solver`.

use crate::backend::{FluidBackend, FluidError, FrameInput, FrameOutput, ParticleView};
use crate::body::{Body, BodyLoad, BodyNow, BodyTables, Medium};
use crate::emitter::Emitter;
use crate::grid::Grid;
use crate::meetings::Meetings;
use crate::motion::{ContactRule, LONGEST_WAY, Motion, MotionScratch, Step};
use crate::neighbours::Neighbours;
use crate::particles::{Newborn, Particles};
use crate::periodic::Periodic;
use crate::restack::restack;
use crate::rigid::Rigid;
use crate::sleep::{Around, Sleepers};
use crate::solids::{Solids, Walls};
use crate::solver::dfsph::{Dfsph, Solves, Surroundings};
use crate::solver::muller::Muller;
use crate::solver::tension::{Pull, Tension};
use crate::solver::viscosity::{Room, Viscosity};
use crate::solver::wcsph::{PACKING_INTERVAL, Rates, Wcsph};
use crate::solver::{Pass, Rows, Scratch};
use crate::stages::{Stage, StageTimes, Stopwatch};
use crate::vector_unit::Arch;
use crate::wall::WallTable;
use crate::{BodyConfig, BodyMotion, FluidConfig, InteractionMode, Solver, World, limits, pools};
use glam::{DVec3, Vec3};
use rayon::prelude::*;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

/// How far a particle may go before its neighbours are looked for again, in spacings: the lists are 7 % longer for it.
const LEEWAY: f32 = 0.03;
/// Sub-steps that lists must last for that to pay.
const WORTHWHILE: f32 = 3.0;

/// A fluid on the CPU.
pub struct CpuBackend {
    config: FluidConfig,
    /// None where there is no fluid and none comes.
    pool: Option<rayon::ThreadPool>,
    arch: Arch,
    fluid: Fluid,
    output: FrameOutput,
    ready: bool,
}

impl std::fmt::Debug for CpuBackend {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("CpuBackend").field("particles", &self.fluid.particles.len()).finish_non_exhaustive()
    }
}

impl CpuBackend {
    /// A fluid of `config`, its pools filled.
    ///
    /// # Errors
    /// What [`FluidConfig::check`] refuses, too many particles, or worker threads that could not be made.
    pub fn new(config: &FluidConfig) -> Result<Self, FluidError> {
        config.check()?;
        let newborn = pools::fill(config)?;
        let pool = config.world.may_hold_fluid().then(|| threads(config)).transpose()?;
        let mut fluid = within(pool.as_ref(), || Fluid::new(config));
        fluid.particles.extend(&newborn);
        Ok(Self {
            config: config.clone(),
            pool,
            arch: Arch::best(),
            fluid,
            output: FrameOutput::default(),
            ready: false,
        })
    }
}

/// The worker threads of one fluid.
fn threads(config: &FluidConfig) -> Result<rayon::ThreadPool, FluidError> {
    rayon::ThreadPoolBuilder::new()
        .num_threads(config.threads.max(1))
        .thread_name(|k| format!("hapflow-fluid-{k}"))
        .build()
        .map_err(|e| FluidError::Threads(e.to_string()))
}

/// Does `work` on the threads of `pool`, if there are any.
fn within<R: Send>(pool: Option<&rayon::ThreadPool>, work: impl FnOnce() -> R + Send) -> R {
    match pool {
        Some(pool) => pool.install(work),
        None => work(),
    }
}

impl CpuBackend {
    /// Gives each particle the velocity (m/s) that `flow` has at its place: a start from a known flow.
    pub fn set_flow(&mut self, flow: impl Fn(DVec3) -> DVec3) {
        self.fluid.sleepers.wake_all(&mut self.fluid.particles);
        let p = &mut self.fluid.particles;
        for i in 0..p.len() {
            let velocity = flow(p.position(i).as_dvec3()).as_vec3();
            p.set_velocity(i, if velocity.is_finite() { velocity } else { Vec3::ZERO });
        }
    }

    /// From now on takes the times of the stages.
    pub fn time_stages(&mut self) {
        self.fluid.watch.start();
    }

    /// The times of the stages since [`time_stages`](Self::time_stages).
    pub fn stage_times(&self) -> StageTimes {
        self.fluid.watch.times
    }

    /// [`submit`](FluidBackend::submit) in `steps` sub-steps, whatever stability asks for: to measure where it ends.
    pub fn submit_in(&mut self, frame: &FrameInput<'_>, steps: usize) {
        let Self { config, pool, arch, fluid, output, .. } = self;
        let arch = *arch;
        within(pool.as_ref(), || fluid.frame(config, arch, (frame, steps), output));
        self.ready = true;
    }
}

impl FluidBackend for CpuBackend {
    fn name(&self) -> &'static str {
        "cpu"
    }

    fn configure(&mut self, config: &FluidConfig) -> Result<(), FluidError> {
        config.check()?;
        let Self { pool, fluid, config: old, .. } = self;
        let count = fluid.particles.len() + fluid.sleepers.count();
        pools::check_spacing(count, old.settings.spacing, config)?;
        if pool.is_none() && config.world.may_hold_fluid() {
            *pool = Some(threads(config)?);
        }
        within(pool.as_ref(), || fluid.adapt(old, config));
        self.config = config.clone();
        Ok(())
    }

    fn submit(&mut self, frame: &FrameInput<'_>) {
        self.fluid.wake(&self.config, frame);
        let steps = self.fluid.substeps(&self.config, frame);
        self.submit_in(frame, steps);
    }

    fn poll(&mut self) -> Option<&FrameOutput> {
        std::mem::take(&mut self.ready).then_some(&self.output)
    }

    fn snapshot(&mut self, view: &mut ParticleView) {
        self.fluid.snapshot(&self.config, view);
    }

    fn surroundings(&mut self, around: DVec3, reach: f64, out: &mut crate::Surroundings) {
        out.lay(around, reach);
        out.take(&self.fluid.particles, self.config.settings.spacing.powi(3));
    }
}

/// The constants of the solver in use.
#[derive(Clone, Copy)]
enum Method {
    Muller(Muller),
    Wcsph(Wcsph),
    Dfsph(Dfsph),
}

/// State and scratch of the fluid.
struct Fluid {
    particles: Particles,
    bodies: Vec<Body>,
    emitters: Vec<Emitter>,
    method: Method,
    tension: Option<Tension>,
    viscosity: Option<Viscosity>,
    walls: Walls,
    periodic: Periodic,
    plane: WallTable,
    tables: BodyTables,
    rigid: Rigid,
    sleepers: Sleepers,
    watch: Stopwatch,
    time: f64,
    substep: u64,
    max_speed: f32,
    /// Interaction has just been switched on: forgive the overlaps that it finds.
    forgive: bool,
    grid: Grid,
    neighbours: Neighbours,
    meetings: Meetings,
    scratch: Scratch,
    moving: MotionScratch,
    rows: Rows,
    normals: Rows,
    pulls: Vec<Pull>,
    room: Room,
    rates: Vec<Rates>,
    solves: Solves,
    dead: Vec<bool>,
    images: Vec<(u32, Vec3)>,
    newborn: Vec<Newborn>,
    now: Vec<BodyNow>,
    step_loads: Vec<BodyLoad>,
    degraded: bool,
    /// The neighbours of the last sub-step are still all that there are.
    known: bool,
}

impl Fluid {
    fn new(config: &FluidConfig) -> Self {
        let support = config.settings.support_length();
        Self {
            particles: Particles::new(),
            bodies: config.world.bodies.iter().cloned().map(Body::new).collect(),
            emitters: vec![Emitter::default(); config.world.sources.len()],
            method: Method::new(config),
            tension: Tension::new(config),
            viscosity: Viscosity::new(config),
            walls: Walls::new(&config.world, &config.settings),
            periodic: Periodic::new(&config.world),
            plane: WallTable::plane(config.settings.kernel_in_use(), support),
            tables: BodyTables::new(bodies_in_fluid(&config.world), config.settings.kernel_in_use(), support),
            rigid: Rigid::default(),
            sleepers: Sleepers::default(),
            watch: Stopwatch::default(),
            time: 0.0,
            substep: 0,
            max_speed: 0.0,
            forgive: false,
            grid: Grid::default(),
            neighbours: Neighbours::default(),
            meetings: Meetings::default(),
            scratch: Scratch::default(),
            moving: MotionScratch::default(),
            rows: Rows::new(),
            normals: Rows::new(),
            pulls: Vec::new(),
            room: Room::default(),
            rates: Vec::new(),
            solves: Solves::default(),
            dead: Vec::new(),
            images: Vec::new(),
            newborn: Vec::new(),
            now: Vec::new(),
            step_loads: vec![BodyLoad::default(); config.world.bodies.len()],
            degraded: false,
            known: false,
        }
    }

    /// Takes new settings over without losing the fluid.
    fn adapt(&mut self, old: &FluidConfig, new: &FluidConfig) {
        self.sleepers.wake_all(&mut self.particles);
        self.neighbours.forget();
        self.method = Method::new(new);
        self.tension = Tension::new(new);
        self.viscosity = Viscosity::new(new);
        for (body, config) in self.bodies.iter_mut().zip(&new.world.bodies) {
            body.config = config.clone();
        }
        self.emitters.resize(new.world.sources.len(), Emitter::default());
        let kernels =
            |config: &FluidConfig| (config.settings.kernel_in_use(), config.settings.support_length());
        let (kernel, support) = kernels(new);
        if kernels(old) != kernels(new) {
            self.plane = WallTable::plane(kernel, support);
        }
        self.tables.update(bodies_in_fluid(&new.world), kernel, support);
        self.walls = Walls::new(&new.world, &new.settings);
        self.periodic = Periodic::new(&new.world);
        let off = |config: &FluidConfig| config.settings.mode == InteractionMode::None;
        let switched_on = off(old) && !off(new);
        let respaced = new.settings.spacing != old.settings.spacing;
        if switched_on || respaced {
            self.make_room(old.settings.spacing, new);
        }
        if switched_on || respaced || new.settings.solver != old.settings.solver {
            self.particles.p.fill(0.0);
            self.particles.slow.fill(0.0);
            self.forgive = true;
        }
    }

    /// Brings the particles to a new spacing, and spreads those that lie in each other's room.
    fn make_room(&mut self, old_spacing: f64, config: &FluidConfig) {
        let now: Vec<_> = self
            .bodies
            .iter()
            .enumerate()
            .map(|b| BodyNow::new(b, config.settings.spacing, self.periodic))
            .collect();
        let solids = Solids { walls: &self.walls, bodies: &now, plane: &self.plane, tables: &self.tables };
        if old_spacing != config.settings.spacing {
            self.particles.replace(&pools::resample(&self.particles, old_spacing, config, &solids));
        }
        restack(&mut self.particles, config, &solids);
    }

    /// Sub-steps that `frame` needs.
    fn substeps(&self, config: &FluidConfig, frame: &FrameInput<'_>) -> usize {
        let seen = f64::from(self.max_speed).max(self.tool_speed(frame));
        let speed = limits::expected_speed(config, seen, frame.duration);
        let needed = limits::substeps(config, frame.duration, speed);
        match frame.duration {
            // Bodies alone go their ways in one.
            length if length > 0.0 && self.is_empty(config) => 1,
            length if length > 0.0 => needed.min(config.settings.max_substeps),
            // A frame of no length changes nothing.
            _ => 0,
        }
    }

    /// Whether there is nothing to be stepped but bodies that are led, nor will there be.
    fn is_empty(&self, config: &FluidConfig) -> bool {
        let fed = config.world.sources.iter().any(|source| source.on);
        self.particles.len() == 0 && !fed && !self.bodies.iter().any(Body::is_free)
    }

    /// Wakes what `frame` may touch.
    fn wake(&mut self, config: &FluidConfig, frame: &FrameInput<'_>) {
        let reach = self.reach(config, frame);
        let around = Around { config, bodies: &self.bodies, motions: frame.bodies };
        let woken = self.sleepers.wake(&mut self.particles, &around, reach);
        self.max_speed = self.max_speed.max(woken);
    }

    /// Farthest that anything awake may go in `frame`, m.
    fn reach(&self, config: &FluidConfig, frame: &FrameInput<'_>) -> f64 {
        let fall = config.settings.gravity.length() * frame.duration;
        (f64::from(self.max_speed).max(self.tool_speed(frame)) + fall) * frame.duration
    }

    fn frame(
        &mut self,
        config: &FluidConfig,
        arch: Arch,
        (frame, steps): (&FrameInput<'_>, usize),
        output: &mut FrameOutput,
    ) {
        let step = self.plan(config, frame.duration / steps.max(1) as f64);
        self.begin(frame, output);
        for k in 0..steps {
            let share = (k + 1) as f64 / steps as f64;
            self.step(config, arch, &step, frame.bodies, share);
            for (mean, load) in output.loads.iter_mut().zip(&self.step_loads) {
                mean.add_scaled(load, 1.0 / steps as f64);
            }
            output.iterations += self.solves.iterations;
            output.max_speed = output.max_speed.max(f64::from(self.max_speed));
        }
        self.finish(config, frame, steps, output);
    }

    fn begin(&mut self, frame: &FrameInput<'_>, output: &mut FrameOutput) {
        for (body, motion) in self.bodies.iter_mut().zip(frame.bodies) {
            body.begin_frame(motion, frame.duration);
        }
        self.rigid.take_shapes(&self.bodies);
        self.degraded = false;
        (output.max_speed, output.iterations) = (0.0, 0);
        output.loads.clear();
        output.loads.resize(self.bodies.len(), BodyLoad::default());
    }

    fn finish(
        &mut self,
        config: &FluidConfig,
        frame: &FrameInput<'_>,
        steps: usize,
        output: &mut FrameOutput,
    ) {
        self.particles.drop_images();
        for (body, motion) in self.bodies.iter_mut().zip(frame.bodies) {
            body.end_frame(motion);
        }
        let reach = self.reach(config, frame);
        let around = Around { config, bodies: &self.bodies, motions: frame.bodies };
        self.sleepers.look(&mut self.particles, &around, &output.loads, frame.duration);
        // What would wake at once is better left awake.
        self.sleepers.wake(&mut self.particles, &around, reach);
        output.bodies.clear();
        output.bodies.extend(self.bodies.iter().map(|b| b.state));
        output.time = self.time;
        output.particles = self.particles.len() + self.sleepers.count();
        output.substeps = steps;
        output.degraded = self.degraded;
    }

    /// Highest speed of any body, along its path or as it is, m/s; a jump counts as none.
    fn tool_speed(&self, frame: &FrameInput<'_>) -> f64 {
        let path = frame.bodies.iter().flat_map(|m| m.path);
        let free = self.bodies.iter().filter(|b| b.is_free()).map(|b| &b.state);
        path.chain(free).map(|s| s.velocity.length()).filter(|v| v.is_finite()).fold(0.0, f64::max).min(20.0)
    }

    fn plan(&self, config: &FluidConfig, dt: f64) -> Step {
        let s = &config.settings;
        let impulses = s.solver == Solver::Muller || s.mode == InteractionMode::None;
        let contact = if impulses {
            ContactRule { distance: 0.5 * s.spacing as f32, restitution: s.restitution as f32 }
        } else {
            // The wall's pressure stops a particle; this only catches what has come through.
            ContactRule { distance: -0.25 * s.spacing as f32, restitution: 0.0 }
        };
        // A speed that nobody reckoned with when the frame began must not carry a particle through a wall.
        let guard = config.highest_speed().min(LONGEST_WAY * s.spacing / dt.max(1e-12));
        let cap = if s.max_displacement > 0.0 { s.max_displacement * config.frame_hz } else { f64::INFINITY };
        Step { dt, contact, cap: cap.min(guard) as f32, guard: guard as f32 }
    }

    fn step(
        &mut self,
        config: &FluidConfig,
        arch: Arch,
        step: &Step,
        motions: &[BodyMotion<'_>],
        share: f64,
    ) {
        self.watch.begin();
        self.time += step.dt;
        self.emit(config, step.dt);
        for (body, motion) in self.bodies.iter_mut().zip(motions) {
            body.advance(motion, share, step.dt);
        }
        // Nothing is looked for where there is nobody.
        let wet = self.particles.len() > 0;
        if wet {
            self.sort(config);
        }
        self.watch.lap(Stage::Sort);
        let margin = config.settings.support_length() + f64::from(LEEWAY) * config.settings.spacing;
        self.now.clear();
        let bodies = self.bodies.iter().enumerate().filter(|_| wet);
        let bodies = bodies.map(|b| BodyNow::new(b, margin, self.periodic));
        self.now.extend(bodies.filter(|b| b.is_near(self.grid.corners)));
        self.step_loads.fill(BodyLoad::default());
        self.sleepers.load(&mut self.step_loads);
        self.solves.rest();
        if wet && self.interacts(config.settings.mode) {
            // In mixed mode a sub-step with forces gives the push of the next one too.
            let mixed = config.settings.mode == InteractionMode::Mixed;
            self.look_round(config, arch, step.dt as f32);
            self.forces(arch, if mixed { 2.0 * step.dt } else { step.dt });
            if mixed {
                self.rows.as_flattened_mut().iter_mut().for_each(|a| *a *= 2.0);
                self.step_loads.iter_mut().for_each(|load| *load = *load * 2.0);
            }
        } else {
            self.rates.clear();
            self.rows.clear();
            self.rows.resize(self.particles.len(), [0.0; 4]);
        }
        self.watch.lap(Stage::Pairs);
        self.integrate(config, step);
        let s = &config.settings;
        let prompt = s.solver == Solver::Dfsph;
        let medium = Medium { density: s.rest_density, gravity: s.gravity, prompt };
        for (body, load) in self.bodies.iter_mut().zip(&self.step_loads) {
            body.push(load, &medium, step.dt);
        }
        self.rigid.part(
            &mut self.bodies,
            &self.walls,
            &self.periodic,
            &mut self.step_loads,
            (&medium, step.dt),
        );
        self.bodies.iter_mut().for_each(|body| body.rein(config.highest_speed()));
        self.watch.lap(Stage::Move);
        self.substep += 1;
    }

    fn interacts(&self, mode: InteractionMode) -> bool {
        match mode {
            InteractionMode::Full => true,
            InteractionMode::None => false,
            InteractionMode::Mixed => self.substep.is_multiple_of(2),
        }
    }

    fn emit(&mut self, config: &FluidConfig, dt: f64) {
        let spacing = config.settings.spacing;
        self.newborn.clear();
        let room =
            config.settings.max_particles.saturating_sub(self.particles.count() + self.sleepers.count());
        for (emitter, source) in self.emitters.iter_mut().zip(&config.world.sources) {
            emitter.emit(source, spacing, self.time, dt, room, &mut self.newborn);
        }
        if !self.newborn.is_empty() {
            self.particles.extend(&self.newborn);
        }
    }

    /// Drops what has left, aged or broken, and sorts the rest, unless all are there and near where they were.
    fn sort(&mut self, config: &FluidConfig) {
        self.mark_dead(config);
        let complete = !self.periodic.any() && !self.dead.contains(&true);
        self.known = complete && self.neighbours.hold(&self.particles);
        if self.known {
            return;
        }
        let support = config.settings.support_length() as f32;
        let first = self.particles.len();
        if self.periodic.any() {
            self.periodic.images(&self.particles, &self.dead, support, &mut self.images);
            self.particles.add_images(&self.images);
            self.dead.resize(self.particles.len(), false);
        }
        self.grid.sort(&mut self.particles, config.settings.spacing as f32, support, &self.dead);
        if self.periodic.any() {
            self.particles.link_images(&self.grid.order, &self.images, first);
        }
    }

    /// Finds what has left, aged or broken, and whose image is done with; what has crossed a periodic side comes
    /// in on the other.
    fn mark_dead(&mut self, config: &FluidConfig) {
        if self.periodic.any() {
            for i in 0..self.particles.len() {
                let inside = self.periodic.wrap(self.particles.position(i));
                self.particles.set_position(i, inside);
            }
        }
        let (p, periodic, world) = (&self.particles, &self.periodic, &config.world);
        let lifetime = config.settings.lifetime as f32;
        let broken = AtomicBool::new(false);
        let is_dead = |i: usize| {
            let (position, velocity) = (p.position(i), p.velocity(i));
            if !(position.is_finite() && velocity.is_finite()) {
                broken.store(true, Relaxed);
                return true;
            }
            let gone = periodic.has_left(&world.bounds, position)
                || world.sinks.iter().any(|s| s.contains(position.as_dvec3()));
            gone || (lifetime > 0.0 && p.age[i] > lifetime) || p.is_image(i)
        };
        self.dead.resize(p.len(), false);
        let each = self.dead.par_iter_mut().with_min_len(1024).enumerate();
        each.for_each(|(i, dead)| *dead = is_dead(i));
        self.degraded |= broken.into_inner();
    }

    /// Finds who is near whom, and near which solids.
    fn look_round(&mut self, config: &FluidConfig, arch: Arch, dt: f32) {
        let s = &config.settings;
        let (spacing, support) = (s.spacing as f32, s.support_length() as f32);
        if !self.known {
            let slow = WORTHWHILE * self.max_speed * dt <= LEEWAY * spacing;
            let leeway = if slow { LEEWAY * spacing } else { 0.0 };
            self.neighbours.find(arch, &self.grid, &self.particles, spacing, [support, leeway]);
        }
        self.watch.lap(Stage::Neighbours);
        if self.meets_walls() {
            let solids =
                Solids { walls: &self.walls, bodies: &self.now, plane: &self.plane, tables: &self.tables };
            self.meetings.find(&self.particles, &solids, support);
            self.watch.lap(Stage::Walls);
        }
    }

    /// Whether the solver knows walls by their integrals, and not by contacts alone.
    fn meets_walls(&self) -> bool {
        !matches!(self.method, Method::Muller(_))
    }

    fn forces(&mut self, arch: Arch, dt: f64) {
        let dt = dt as f32;
        macro_rules! pass {
            () => {
                Pass {
                    arch,
                    particles: &self.particles,
                    neighbours: &self.neighbours,
                    meetings: &self.meetings,
                }
            };
        }
        match self.method {
            Method::Muller(m) => {
                self.rates.clear();
                m.densities(pass!(), &mut self.scratch, &mut self.rows);
                m.take_densities(&mut self.particles, &self.rows, self.forgive, dt);
                self.particles.refresh_images();
                m.accelerations(pass!(), &mut self.scratch, &mut self.rows);
            }
            Method::Wcsph(w) => {
                if self.substep.is_multiple_of(PACKING_INTERVAL) {
                    w.packing(pass!(), &mut self.scratch, &mut self.rows);
                    w.take_packing(&mut self.particles, &self.rows);
                }
                w.rates(pass!(), &mut self.scratch, &mut self.rates);
                w.take_rates(&mut self.particles, &mut self.rates, dt);
                self.particles.refresh_images();
                let (rates, scratch) = (&self.rates, &mut self.scratch);
                w.accelerations(pass!(), rates, scratch, &mut self.rows, &mut self.step_loads);
            }
            Method::Dfsph(d) => {
                let (neighbours, meetings) = (&self.neighbours, &self.meetings);
                let around = Surroundings { arch, neighbours, meetings, dt, speed: self.max_speed };
                let (rows, loads) = (&mut self.rows, &mut self.step_loads);
                d.step(around, &mut self.particles, &mut self.solves, &mut self.scratch, rows, loads);
            }
        }
        if let Some(t) = self.tension {
            t.normals(pass!(), &mut self.scratch, &mut self.normals);
            self.particles.copy_to_images(&mut self.normals);
            t.pulls(pass!(), &self.normals, &mut self.scratch, &mut self.pulls, &mut self.step_loads);
            t.add(&self.particles, &self.normals, &self.pulls, &mut self.rows);
        }
        if let Some(v) = self.viscosity {
            let (rows, loads) = (&mut self.rows, &mut self.step_loads);
            self.degraded |= !v.solve(pass!(), dt, &mut self.room, &mut self.scratch, rows, loads);
        }
        self.forgive = false;
    }

    fn integrate(&mut self, config: &FluidConfig, step: &Step) {
        let s = &config.settings;
        let looked_up = self.meets_walls() && self.interacts(s.mode);
        let (rates, solves) = (&self.rates, &self.solves);
        let prompt = s.solver == Solver::Dfsph;
        let motion = Motion {
            step,
            gravity: s.gravity.as_vec3(),
            decay: (-s.damping * step.dt).exp() as f32,
            longest: (LONGEST_WAY * s.spacing) as f32,
            mass: s.particle_mass() as f32,
            two_way: s.two_way,
            rows: &self.rows,
            shift: |i: usize| {
                if prompt { solves.shift(i) } else { rates.get(i).map_or(Vec3::ZERO, |r| r.shift) }
            },
            solids: Solids {
                walls: &self.walls,
                bodies: &self.now,
                plane: &self.plane,
                tables: &self.tables,
            },
            meetings: looked_up.then_some(&self.meetings),
        };
        let moved = motion.run(&mut self.particles, &mut self.moving, &mut self.step_loads);
        self.degraded |= moved.degraded;
        self.max_speed = if moved.fastest.is_finite() { moved.fastest } else { step.cap };
    }

    fn snapshot(&self, config: &FluidConfig, view: &mut ParticleView) {
        view.positions.clear();
        view.velocities.clear();
        view.ids.clear();
        view.pressures.clear();
        let scale = if self.meets_walls() { config.settings.rest_density as f32 } else { 1.0 };
        for p in std::iter::once(&self.particles).chain(self.sleepers.each()) {
            let n = p.len();
            view.positions.extend((0..n).map(|i| p.position(i).to_array()));
            view.velocities.extend((0..n).map(|i| p.velocity(i).to_array()));
            view.ids.extend_from_slice(&p.id[..n]);
            view.pressures.extend(p.p[..n].iter().map(|&p| p * scale));
        }
    }
}

/// The bodies that fluid may ever meet.
fn bodies_in_fluid(world: &World) -> &[BodyConfig] {
    if world.may_hold_fluid() { &world.bodies } else { &[] }
}

impl Method {
    fn new(config: &FluidConfig) -> Self {
        match config.settings.solver {
            Solver::Muller => Self::Muller(Muller::new(config)),
            Solver::Dfsph => Self::Dfsph(Dfsph::new(config)),
            Solver::Wcsph => Self::Wcsph(Wcsph::new(config)),
        }
    }
}
