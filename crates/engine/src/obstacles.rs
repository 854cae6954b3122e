//! Obstacles that the host moves: poses go to the fluid wait-free, the newest wins.

use crate::scene::MAX_OBSTACLES;
use crate::touch::{SolidPath, SolidPaths, solid_shape};
use glam::{DQuat, DVec3};
use hapflow_fluid::{BodyConfig, BodySample};
use hapflow_haptics::Pose;
use hapflow_realtime::{LatestReader, LatestWriter, latest};

/// Where each obstacle is to be, in the order of the scene; none where the host has not moved it.
pub(crate) type Poses = [Option<(DVec3, DQuat)>; MAX_OBSTACLES];

/// The host's hold on the obstacles. Thread: any one; wait-free.
#[derive(Debug)]
pub struct ObstacleMover {
    poses: Poses,
    count: usize,
    writer: LatestWriter<Poses>,
}

/// Both ends of the way from host to fluid, for `count` obstacles.
pub(crate) fn obstacle_poses(count: usize) -> (ObstacleMover, LatestReader<Poses>) {
    let (writer, reader) = latest([None; MAX_OBSTACLES]);
    (ObstacleMover { poses: [None; MAX_OBSTACLES], count, writer }, reader)
}

impl ObstacleMover {
    /// Obstacles of the scene.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Obstacle `index` is to be at `position` (m) and `orientation` when the next fluid frame ends; it goes there
    /// evenly. False, and nothing changed, for an index or a number that cannot be.
    pub fn set(&mut self, index: usize, position: DVec3, orientation: DQuat) -> bool {
        let sound = position.is_finite() && orientation.is_finite() && orientation.length_squared() > 0.25;
        if index >= self.count || !sound {
            return false;
        }
        self.poses[index] = Some((position, orientation.normalize()));
        true
    }

    /// Hands all poses over together.
    pub fn publish(&mut self) {
        self.writer.write(self.poses);
    }
}

/// The fluid's side: where the obstacles are, and their paths through a frame.
pub(crate) struct Obstacles {
    poses: LatestReader<Poses>,
    paths: Vec<[BodySample; 2]>,
    /// To the servos of tools that feel solids.
    felt: Vec<LatestWriter<SolidPaths>>,
}

impl Obstacles {
    pub fn new(
        poses: LatestReader<Poses>,
        bodies: &[BodyConfig],
        felt: Vec<LatestWriter<SolidPaths>>,
    ) -> Self {
        Self { poses, paths: bodies.iter().map(|b| [BodySample::at(b.position); 2]).collect(), felt }
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.paths.len()
    }

    /// The path of each obstacle through the frame that ends at `end_s`.
    pub fn paths(&mut self, bodies: &[BodyConfig], end_s: f64, frame_s: f64) -> &[[BodySample; 2]] {
        self.poses.update();
        let poses = self.poses.get();
        for ((path, body), pose) in self.paths.iter_mut().zip(bodies).zip(poses) {
            let from = path[1];
            let (position, orientation) = pose.unwrap_or((body.position, from.orientation));
            let velocity = (position - from.position) / frame_s;
            let turn = orientation * from.orientation.conjugate();
            let angular_velocity = turn.to_scaled_axis() / frame_s;
            let start = BodySample { time: end_s - frame_s, velocity, angular_velocity, ..from };
            *path = [start, BodySample { time: end_s, position, orientation, velocity, angular_velocity }];
        }
        self.tell(bodies, end_s, frame_s);
        &self.paths
    }

    /// Tells the servos.
    fn tell(&mut self, bodies: &[BodyConfig], end_s: f64, frame_s: f64) {
        for writer in &mut self.felt {
            let told = writer.buffer();
            (told.end_s, told.frame_s) = (end_s, frame_s);
            for ((to, path), body) in told.paths.iter_mut().zip(&self.paths).zip(bodies) {
                let [from, end] = path.map(|s| Pose { position: s.position, orientation: s.orientation });
                *to = SolidPath { shape: solid_shape(&body.shape), from, to: end };
            }
            writer.publish();
        }
    }
}
