//! The solids of a scene as one tool's servo feels them: where they are, and the tool's proxy among them. A scene whose
//! solids are not felt has none of this.

use crate::scene::{MAX_OBSTACLES, Scene, ToolSettings};
use glam::DVec3;
use hapflow_fluid::{ContainerForm, Shape};
use hapflow_haptics::{
    Pose, Proxy, Solid, SolidFeel, SolidKind, SolidShape, ToolState, Touching, ground, open_box,
};
use hapflow_realtime::{LatestReader, LatestWriter, latest};

/// The way of every obstacle through a fluid frame, from the fluid to a servo.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SolidPaths {
    /// When the frame ended, s: the servo plays it in the frame after, as the fluid's own answer comes then.
    pub end_s: f64,
    /// Its length, s.
    pub frame_s: f64,
    /// In the order of the scene; there are as many as it has obstacles.
    pub paths: [SolidPath; MAX_OBSTACLES],
}

/// The way of one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SolidPath {
    pub shape: SolidShape,
    pub from: Pose,
    pub to: Pose,
}

impl SolidPath {
    fn resting(shape: SolidShape, place: DVec3) -> Self {
        Self { shape, from: Pose::at(place), to: Pose::at(place) }
    }
}

impl SolidPaths {
    fn at_rest(scene: &Scene) -> Self {
        let mut paths = [SolidPath::resting(SolidShape::HalfSpace, DVec3::ZERO); MAX_OBSTACLES];
        for (path, obstacle) in paths.iter_mut().zip(&scene.obstacles) {
            *path = SolidPath::resting(solid_shape(&obstacle.form.shape()), obstacle.position);
        }
        Self { end_s: 0.0, frame_s: 1.0 / scene.run.fluid_hz, paths }
    }
}

/// The fluid's shape, as a solid.
pub(crate) fn solid_shape(shape: &Shape) -> SolidShape {
    match *shape {
        Shape::Sphere { radius } => SolidShape::Sphere { radius },
        Shape::Disc { radius, thickness } => SolidShape::Disc { radius, thickness },
        Shape::Box { size } => SolidShape::Box { half: 0.5 * size },
        Shape::Capsule { radius, length } => SolidShape::Capsule { radius, length },
        // The proxy takes solids for convex: a mesh is felt as the ball round it. Scenes make no others.
        Shape::Mesh(_) | Shape::Slab { .. } | Shape::Drum { .. } => {
            SolidShape::Sphere { radius: shape.bounding_radius() }
        }
    }
}

/// See the module. Thread: servo.
pub(crate) struct Touch {
    proxy: Proxy,
    feel: SolidFeel,
    solids: Vec<Solid>,
    /// How many of them never move; the obstacles come after.
    fixed: usize,
    paths: LatestReader<SolidPaths>,
    report: LatestWriter<Touching>,
}

/// Most steps in which solids go on in a tick.
const MOST_STEPS: f64 = 16.0;

impl Touch {
    /// What `tool` feels of the solids of `scene`, if it does; with the fluid's end, and main's.
    pub fn open(
        scene: &Scene,
        tool: &ToolSettings,
    ) -> Option<(Self, LatestWriter<SolidPaths>, LatestReader<Touching>)> {
        if tool.solids.stiffness_n_per_m <= 0.0 {
            return None;
        }
        let start = SolidPaths::at_rest(scene);
        let (paths_in, paths) = latest(start);
        let (report, report_out) = latest(Touching::nothing(&ToolState::at(tool.position)));
        let mut solids: Vec<Solid> = scene.ground.map(ground).into_iter().collect();
        // The proxy takes solids for convex, which the walls of a box are, and a round one is not.
        if let Some(inner) = scene.container.filter(|_| scene.container_form == ContainerForm::Box) {
            // Their thickness is the fluid's, which keeps a particle on each side.
            solids.extend(open_box(inner.min, inner.max, 2.0 * scene.fluid.spacing));
        }
        let fixed = solids.len();
        let obstacle = |(k, path): (usize, &SolidPath)| {
            Solid::at_rest(SolidKind::Obstacle, k as u32, path.shape, path.to)
        };
        solids.extend(start.paths.iter().take(scene.obstacles.len()).enumerate().map(obstacle));
        let touch = Self { proxy: Proxy::default(), feel: tool.solids, solids, fixed, paths, report };
        Some((touch, paths_in, report_out))
    }

    /// One tick of a tool whose hand is at `tool`, and which counts as a ball of `radius` metres.
    pub fn tick(&mut self, tool: &ToolState, radius: f64, time_s: f64, dt_s: f64) -> Touching {
        self.paths.update();
        let paths = self.paths.get();
        let share = (time_s - paths.end_s) / paths.frame_s;
        // A time that is no number moves nothing.
        let share = if share > 0.0 { share.min(1.0) } else { 0.0 };
        let mut farthest = 0.0_f64;
        for (solid, path) in self.solids[self.fixed..].iter_mut().zip(&paths.paths) {
            solid.shape = path.shape;
            farthest = farthest.max(set_velocity(solid, &path.from.towards(&path.to, share), dt_s));
        }
        // A thin plate that goes on by more than the tool's size would be past it without having touched it.
        let steps = (2.0 * farthest / radius).ceil().clamp(1.0, MOST_STEPS);
        for step in 0..steps as usize {
            for (solid, path) in self.solids[self.fixed..].iter_mut().zip(&paths.paths) {
                let end = path.from.towards(&path.to, share);
                solid.pose = solid.pose.towards(&end, 1.0 / (steps - step as f64));
            }
            self.proxy.follow(tool.position, radius, &self.solids);
        }
        let touching = self.proxy.touch(tool, radius, &self.solids, self.feel);
        self.report.write(touching);
        touching
    }

    /// Begins anew at the hand: after a fault nobody knows where it has been meanwhile.
    pub fn reset(&mut self) {
        self.proxy.reset();
    }
}

/// Lets a solid have the velocity with which it goes to `end` in `dt_s`; how far any of its matter goes, m.
fn set_velocity(solid: &mut Solid, end: &Pose, dt_s: f64) -> f64 {
    let way = end.position - solid.pose.position;
    let turn = (end.orientation * solid.pose.orientation.conjugate()).to_scaled_axis();
    let rate = if dt_s > 0.0 { dt_s.recip() } else { 0.0 };
    (solid.velocity, solid.angular_velocity) = (way * rate, turn * rate);
    way.length() + turn.length() * solid.shape.reach()
}
