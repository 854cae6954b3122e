//! Fluid at rest sleeps: it is taken out of all that a sub-step loops over, and put back as it was when something comes
//! near that could move it.
//!
//! What sleeps is an island: all fluid that hangs together, and with it what stands in the same still bodies, so that
//! nothing awake ever touches what is asleep and no force is cut anywhere. It falls asleep when its shape has not changed for
//! a while (where its middle is, and how far it spreads along each axis) and what moves in it is less than a wave of one
//! spacing: particles at rest are never quite still, and wander. It wakes as a whole, as it was. Until then the loads on
//! the bodies in it are the mean ones before it fell asleep.

use crate::body::{Body, BodyLoad};
use crate::particles::Particles;
use crate::{BodyDrive, BodyMotion, BodySample, FluidConfig, InteractionMode};
use glam::{DVec3, IVec3, Vec3};
use std::collections::HashMap;

/// Time between two looks, s: so long the shape may not have changed.
const LOOK: f64 = 0.5;
/// How far its middle may have gone and its spread have changed, in spacings.
const WAY: f64 = 0.02;
/// Highest root of the mean square of the speeds at rest, as a share of that of a fall through half a spacing.
const SPEED: f64 = 0.15;
/// How far a still body may be from where it was, in spacings, and how fast its surface, in spacings a second.
const STILL: f64 = 0.01;
const STILL_RATE: f64 = 0.1;
/// Radius of a body without end, m.
const LARGEST: f64 = 1e3;

/// Fluid asleep.
#[derive(Clone, Debug)]
struct Island {
    particles: Particles,
    low: Vec3,
    high: Vec3,
    /// Highest speed, m/s.
    fastest: f32,
    /// Bodies that stand in it, and its mean load on each.
    loads: Vec<(usize, BodyLoad)>,
    /// All bodies as they were.
    bodies: Vec<BodySample>,
}

/// What sleeps, and what is needed to tell.
#[derive(Clone, Debug, Default)]
pub(crate) struct Sleepers {
    islands: Vec<Island>,
    /// Time since the last look, s, and where everybody was then.
    since: f64,
    places: HashMap<u32, Vec3>,
    /// Loads since then, times the time, N s.
    loads: Vec<BodyLoad>,
}

impl Sleepers {
    /// How many particles sleep.
    pub fn count(&self) -> usize {
        self.islands.iter().map(|i| i.particles.len()).sum()
    }

    /// All that sleeps.
    pub fn each(&self) -> impl Iterator<Item = &Particles> {
        self.islands.iter().map(|i| &i.particles)
    }

    /// Adds the loads of what sleeps.
    pub fn load(&self, loads: &mut [BodyLoad]) {
        for (body, load) in self.islands.iter().flat_map(|i| &i.loads) {
            loads[*body].add_scaled(load, 1.0);
        }
    }

    /// Wakes everything.
    pub fn wake_all(&mut self, particles: &mut Particles) {
        self.islands.drain(..).for_each(|island| particles.append(&island.particles));
        self.forget();
    }

    /// Wakes what a frame may touch in which nothing awake goes farther than `reach` (m). Returns the highest speed of what
    /// wakes, m/s.
    pub fn wake(&mut self, particles: &mut Particles, around: &Around<'_>, reach: f64) -> f32 {
        let s = &around.config.settings;
        let reach = reach + s.support_length() + s.spacing;
        let mut fastest = 0.0_f32;
        // What wakes may wake the next.
        while let Some(k) = self.islands.iter().position(|i| i.is_touched(particles, around, reach)) {
            let island = self.islands.swap_remove(k);
            fastest = fastest.max(island.fastest);
            particles.append(&island.particles);
            self.forget();
        }
        fastest
    }

    /// After a frame of `duration` seconds: looks now and then whether something has come to rest, and takes it out.
    pub fn look(
        &mut self,
        particles: &mut Particles,
        around: &Around<'_>,
        loads: &[BodyLoad],
        duration: f64,
    ) {
        if !may_sleep(around.config) {
            return;
        }
        self.since += duration;
        self.loads.resize(loads.len(), BodyLoad::default());
        self.loads.iter_mut().zip(loads).for_each(|(sum, load)| sum.add_scaled(load, duration));
        if self.since < LOOK {
            return;
        }
        if !self.places.is_empty() {
            self.lay_down(particles, around);
        }
        self.forget();
        self.places.extend((0..particles.len()).map(|i| (particles.id[i], particles.position(i))));
    }

    fn forget(&mut self) {
        self.since = 0.0;
        self.places.clear();
        self.loads.clear();
    }

    /// Takes out every island that has come to rest.
    fn lay_down(&mut self, particles: &mut Particles, around: &Around<'_>) {
        let map = Map::of(particles, around);
        let mut rests: Vec<_> =
            self.motions(particles, &map).iter().map(|m| m.is_rest(around.config)).collect();
        for (k, island) in map.of_body.iter().enumerate() {
            if let Some(island) = *island {
                rests[island] &= around.is_still(k, &around.bodies[k].state);
            }
        }
        for island in (0..map.count).filter(|&k| rests[k]) {
            let mut bed = particles.clone();
            bed.permute(&numbers(particles.len(), |i| map.of_particle[i] == island));
            let stand = (0..map.of_body.len()).filter(|&b| map.of_body[b] == Some(island));
            let loads = stand.map(|b| (b, self.loads[b] * (1.0 / self.since))).collect();
            self.islands.push(Island::new(bed, loads, around.bodies));
        }
        if rests.contains(&true) {
            particles.permute(&numbers(particles.len(), |i| !rests[map.of_particle[i]]));
        }
    }

    /// How each island has moved since the last look.
    fn motions(&self, particles: &Particles, map: &Map) -> Vec<Motion> {
        let mut motions = vec![Motion::default(); map.count];
        for (i, &island) in map.of_particle.iter().enumerate() {
            let then = self.places.get(&particles.id[i]).filter(|_| particles.held[i] <= 0.0);
            motions[island].add(particles.position(i), particles.velocity(i), then.copied());
        }
        motions
    }
}

/// What is round the fluid in a frame.
#[derive(Clone, Copy)]
pub(crate) struct Around<'a> {
    pub config: &'a FluidConfig,
    pub bodies: &'a [Body],
    pub motions: &'a [BodyMotion<'a>],
}

impl Around<'_> {
    /// Whether body `k` is led, and stays where `place` says.
    fn is_still(&self, k: usize, place: &BodySample) -> bool {
        let (body, dx) = (&self.bodies[k], self.config.settings.spacing);
        let Some(motion) = self.motions.get(k) else { return false };
        let radius = body.config.shape.bounding_radius().min(LARGEST);
        let here = |s: &BodySample| {
            let turned = s.orientation.angle_between(place.orientation) * radius;
            let rate = s.velocity.length() + s.angular_velocity.length() * radius;
            s.position.distance(place.position) + turned < STILL * dx && rate < STILL_RATE * dx
        };
        motion.drive == BodyDrive::Led && here(&body.state) && motion.path.iter().all(here)
    }
}

/// Sums over an island: where it is, and where it was at the last look.
#[derive(Clone, Copy, Debug, Default)]
struct Motion {
    count: f64,
    /// Places, and their squares, now and then.
    places: [DVec3; 2],
    squares: [DVec3; 2],
    /// Squares of the speeds.
    speeds: f64,
    /// Somebody was not there then, or is still led by a source.
    new: bool,
}

impl Motion {
    fn add(&mut self, now: Vec3, velocity: Vec3, then: Option<Vec3>) {
        self.new |= then.is_none();
        self.count += 1.0;
        self.speeds += f64::from(velocity.length_squared());
        for (k, place) in [now, then.unwrap_or(now)].into_iter().enumerate() {
            let place = place.as_dvec3();
            self.places[k] += place;
            self.squares[k] += place * place;
        }
    }

    /// Whether its shape has stayed, and nothing much moves in it.
    fn is_rest(&self, config: &FluidConfig) -> bool {
        let s = &config.settings;
        let middles = self.places.map(|sum| sum / self.count);
        let spread = |k: usize| (self.squares[k] / self.count - middles[k] * middles[k]).max(DVec3::ZERO);
        let spreads = [0, 1].map(|k| spread(k).powf(0.5));
        let [went, grew] = [middles, spreads].map(|[now, then]| now.distance(then) / s.spacing);
        let calm = self.speeds / self.count < SPEED * SPEED * s.gravity.length() * s.spacing;
        !self.new && calm && went < WAY && grew < WAY
    }
}

/// Whether fluid of `config` may sleep: where it is whole, ages not and has no ends that are one.
fn may_sleep(config: &FluidConfig) -> bool {
    let s = &config.settings;
    s.sleep && s.mode == InteractionMode::Full && s.lifetime == 0.0 && !config.world.periodic.contains(&true)
}

/// Numbers below `count` for which `chosen` holds.
fn numbers(count: usize, chosen: impl Fn(usize) -> bool) -> Vec<u32> {
    (0..count).filter(|&i| chosen(i)).map(|i| i as u32).collect()
}

impl Island {
    fn new(particles: Particles, loads: Vec<(usize, BodyLoad)>, bodies: &[Body]) -> Self {
        let places = || (0..particles.len()).map(|i| particles.position(i));
        let low = places().fold(Vec3::INFINITY, Vec3::min);
        let high = places().fold(Vec3::NEG_INFINITY, Vec3::max);
        let fastest = (0..particles.len()).map(|i| particles.velocity(i).length()).fold(0.0, f32::max);
        Self { low, high, fastest, loads, bodies: bodies.iter().map(|b| b.state).collect(), particles }
    }

    /// Whether something that is awake comes within `reach` of it in a frame, m.
    fn is_touched(&self, particles: &Particles, around: &Around<'_>, reach: f64) -> bool {
        let (low, high) = (self.low.as_dvec3(), self.high.as_dvec3());
        let near = |place: DVec3, reach: f64| place.distance(place.clamp(low, high)) < reach;
        let met = (0..particles.len()).any(|i| near(particles.position(i).as_dvec3(), reach));
        let sources = around.config.world.sources.iter().filter(|s| s.on);
        let fed = sources.map(|s| (s.position, s.diameter)).any(|(place, wide)| near(place, reach + wide));
        let stirred = |k: usize| {
            let (body, was) = (&around.bodies[k], &self.bodies[k]);
            let radius = body.config.shape.bounding_radius();
            let path = around.motions.get(k).into_iter().flat_map(|m| m.path).map(|s| s.position);
            let mut places = path.chain([body.state.position, was.position]);
            !around.is_still(k, was) && places.any(|place| near(place, radius + reach))
        };
        met || fed || (0..self.bodies.len()).any(stirred)
    }
}

/// Which island each particle and body belongs to.
struct Map {
    count: usize,
    of_particle: Vec<usize>,
    of_body: Vec<Option<usize>>,
}

impl Map {
    /// Particles in neighbouring cells of one support hang together, and all that is before one body.
    fn of(particles: &Particles, around: &Around<'_>) -> Self {
        let (side, bodies) = (around.config.settings.support_length() as f32, around.bodies);
        let mut numbers: HashMap<IVec3, usize> = HashMap::new();
        let cell = |i: usize| (particles.position(i) / side).floor().as_ivec3();
        let cells: Vec<usize> = (0..particles.len())
            .map(|i| {
                let next = numbers.len();
                *numbers.entry(cell(i)).or_insert(next)
            })
            .collect();
        let mut sets = Sets((0..numbers.len() + bodies.len()).collect());
        for (at, &k) in &numbers {
            let around = (0..27).map(|n| *at + IVec3::new(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1));
            around.filter_map(|c| numbers.get(&c)).for_each(|&other| sets.join(k, other));
        }
        let mut stands = vec![false; bodies.len()];
        for (b, body) in bodies.iter().enumerate() {
            for i in (0..particles.len()).filter(|&i| meets(body, particles.position(i), side)) {
                sets.join(numbers.len() + b, cells[i]);
                stands[b] = true;
            }
        }
        let mut islands = HashMap::new();
        let mut island = |sets: &mut Sets, member: usize| {
            let next = islands.len();
            *islands.entry(sets.find(member)).or_insert(next)
        };
        let of_particle: Vec<_> = cells.iter().map(|&c| island(&mut sets, c)).collect();
        let of_body =
            (0..bodies.len()).map(|b| stands[b].then(|| island(&mut sets, numbers.len() + b))).collect();
        Self { count: islands.len(), of_particle, of_body }
    }
}

/// Whether `place` is within `support` of a body's surface, m.
fn meets(body: &Body, place: Vec3, support: f32) -> bool {
    let arm = place.as_dvec3() - body.state.position;
    let shape = &body.config.shape;
    arm.length() < shape.bounding_radius() + f64::from(support)
        && shape.distance((body.state.orientation.inverse() * arm).as_vec3()).0 < support
}

/// Disjoint sets by their representatives (Galler & Fischer 1964, doi:10.1145/364099.364331).
struct Sets(Vec<usize>);

impl Sets {
    fn find(&mut self, mut member: usize) -> usize {
        while self.0[member] != member {
            self.0[member] = self.0[self.0[member]];
            member = self.0[member];
        }
        member
    }

    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.find(a), self.find(b));
        self.0[a.max(b)] = a.min(b);
    }
}
