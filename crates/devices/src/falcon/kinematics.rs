//! From arm angles to the grip's place and back, and from forces to torques.
//!
//! The mechanism and its closure equations are those of R. E. Stamper, "A three degree of freedom parallel
//! manipulator with only translational degrees of freedom" (PhD thesis, University of Maryland, 1997), with an
//! offset piece at either end of the parallelogram. In the plane of leg i, with U outwards from the arm's axis, w = z,
//! v sideways, a the arm, b the link, d the offsets, ρ and σ the radial and lateral offsets:
//!
//! U + ρ = x cos φ + y sin φ,  v = −x sin φ + y cos φ,
//! U = a cos θ₁ + L cos θ₂,  w = a sin θ₁ + L sin θ₂,  v + σ = b cos θ₃,  L = d + b sin θ₃.
//!
//! Frame: origin on the base's axis in the plane of the arms' axes; x right, y up, z towards the user. m, rad, N, N·m.

use crate::falcon::Geometry;
use glam::{DMat3, DVec3};

/// Where the search for a place begins that has no better start, m. From here every place in the workspace is found.
const START: DVec3 = DVec3::new(0.0, 0.0, 0.11);
/// Longest step of that search, m.
const MAX_STEP_M: f64 = 0.010;
/// Most steps of it; from the last sample three suffice, from [`START`] some fifteen.
const MAX_STEPS: usize = 60;
/// A step as short as this ends it, m.
const FOUND_M: f64 = 1e-11;
/// A leg whose arm and link are nearer than this to one line, or whose parallelogram to flat (both as sines), moves
/// the grip no more in a way that can be told from its angle. In the workspace the sines are above 0.5.
const MIN_SINE: f64 = 0.05;
/// Least determinant of the directions in which the three legs hold the grip, all of length 1. In the workspace it is
/// above 0.1.
const MIN_DETERMINANT: f64 = 0.01;

/// Where the grip moves freely: depth (z) and radius of discs about the z axis, m, from a little within what the legs reach.
/// A pyramid more than a cylinder: narrow at its front and back.
pub const FREE_DISCS: [(f64, f64); 5] =
    [(0.09, 0.012), (0.11, 0.06), (0.13, 0.06), (0.15, 0.048), (0.17, 0.022)];

/// Why a place or an angle was refused.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum PoseError {
    /// A number that is none.
    #[error("it is not finite")]
    NotFinite,
    /// The legs do not reach there.
    #[error("({}, {}, {}) m is out of reach", .position.x, .position.y, .position.z)]
    OutOfReach {
        /// The place, m.
        position: DVec3,
    },
    /// There the legs do not hold the grip in all directions.
    #[error("({}, {}, {}) m is singular", .position.x, .position.y, .position.z)]
    Singular {
        /// The place, m.
        position: DVec3,
    },
    /// The legs do not meet at these angles.
    #[error("the arms at {:.2}, {:.2} and {:.2} degrees do not meet", .angles_deg[0], .angles_deg[1], .angles_deg[2])]
    DoNotMeet {
        /// The arm angles, degrees.
        angles_deg: [f64; 3],
    },
}

/// The kinematics of one Falcon. Costs under a microsecond a call; allocates nothing.
#[derive(Clone, Debug)]
pub struct Kinematics {
    geometry: Geometry,
    /// Sines and cosines of the legs' azimuths.
    azimuths: [(f64, f64); 3],
}

/// A leg at one place of the grip.
#[derive(Clone, Copy, Default)]
struct Leg {
    /// Arm angle, rad.
    angle: f64,
    /// Its gradient, rad/m.
    gradient: DVec3,
}

/// A place of the grip with its arms.
struct Pose {
    position: DVec3,
    /// Arm angles, rad.
    angles: DVec3,
    /// Their gradients, row by row, rad/m.
    jacobian: DMat3,
}

impl Kinematics {
    /// The kinematics of `geometry`.
    pub fn new(geometry: Geometry) -> Self {
        let azimuths = geometry.azimuth_deg.map(|azimuth| azimuth.to_radians().sin_cos());
        Self { geometry, azimuths }
    }

    /// Its parameters.
    pub fn geometry(&self) -> &Geometry {
        &self.geometry
    }

    /// The arm angles that hold the grip at `position`, rad.
    ///
    /// # Errors
    /// [`PoseError`] where the legs do not reach, or hold the grip no more.
    pub fn inverse(&self, position: DVec3) -> Result<[f64; 3], PoseError> {
        Ok(self.legs(position)?.map(|leg| leg.angle))
    }

    /// The arm angles' gradients at `position`, row i that of arm i, rad/m.
    ///
    /// # Errors
    /// As [`inverse`](Self::inverse).
    pub fn jacobian(&self, position: DVec3) -> Result<DMat3, PoseError> {
        Ok(self.pose(position)?.jacobian)
    }

    /// Where the arms at `angles` (rad) hold the grip, m: by Newton's method from `near`, the last place, or from the
    /// middle if that leads nowhere.
    ///
    /// # Errors
    /// [`PoseError`] if the arms do not meet at these angles.
    pub fn forward(&self, angles: [f64; 3], near: DVec3) -> Result<DVec3, PoseError> {
        if !angles.iter().all(|angle| angle.is_finite()) {
            return Err(PoseError::NotFinite);
        }
        let wanted = DVec3::from_array(angles);
        let found = self.search(wanted, near).or_else(|| self.search(wanted, START));
        found.ok_or_else(|| PoseError::DoNotMeet { angles_deg: angles.map(f64::to_degrees) })
    }

    /// The torques at the arms' axes that give `force` (N) at `position`, N·m.
    ///
    /// # Errors
    /// As [`inverse`](Self::inverse), or a force that is not finite.
    pub fn torques(&self, position: DVec3, force: DVec3) -> Result<DVec3, PoseError> {
        if !force.is_finite() {
            return Err(PoseError::NotFinite);
        }
        // Virtual work: F·dp = τ·dθ, with dθ = Q dp.
        Ok(self.jacobian(position)?.transpose().inverse() * force)
    }

    /// The force that these torques (N·m) give at `position`, N: the way back of [`torques`](Self::torques).
    ///
    /// # Errors
    /// As [`inverse`](Self::inverse).
    pub fn force(&self, position: DVec3, torques: DVec3) -> Result<DVec3, PoseError> {
        Ok(self.jacobian(position)?.transpose() * torques)
    }

    /// Newton's method from `p`, held back where a step leaves the reach.
    fn search(&self, wanted: DVec3, p: DVec3) -> Option<DVec3> {
        let mut pose = self.pose(p).ok()?;
        for _ in 0..MAX_STEPS {
            let step = pose.jacobian.inverse() * (wanted - pose.angles);
            if step.length() < FOUND_M {
                return Some(pose.position);
            }
            pose = self.advance(&pose, step.clamp_length_max(MAX_STEP_M))?;
        }
        None
    }

    /// `pose` moved by `step`, or by the largest half, quarter … of it that the legs reach.
    fn advance(&self, pose: &Pose, mut step: DVec3) -> Option<Pose> {
        for _ in 0..20 {
            if let Ok(next) = self.pose(pose.position + step) {
                return Some(next);
            }
            step *= 0.5;
        }
        None
    }

    /// The arms' angles and their gradients at `position`, where the legs hold the grip in all directions.
    fn pose(&self, position: DVec3) -> Result<Pose, PoseError> {
        let legs = self.legs(position)?;
        let [a, b, c] = legs.map(|leg| leg.gradient);
        let volume = a.normalize().dot(b.normalize().cross(c.normalize()));
        if volume.abs() < MIN_DETERMINANT {
            return Err(PoseError::Singular { position });
        }
        let angles = DVec3::from_array(legs.map(|leg| leg.angle));
        Ok(Pose { position, angles, jacobian: DMat3::from_cols(a, b, c).transpose() })
    }

    fn legs(&self, position: DVec3) -> Result<[Leg; 3], PoseError> {
        if !position.is_finite() {
            return Err(PoseError::NotFinite);
        }
        let mut legs = [Leg::default(); 3];
        for (leg, azimuth) in legs.iter_mut().zip(self.azimuths) {
            *leg = self.leg(position, azimuth)?;
        }
        Ok(legs)
    }

    /// The leg at this azimuth (sine, cosine), elbow outwards: the only way in which a Falcon can be put together.
    fn leg(&self, position: DVec3, (sin, cos): (f64, f64)) -> Result<Leg, PoseError> {
        let g = &self.geometry;
        let out = position.x * cos + position.y * sin - g.radial_offset_m;
        let up = position.z;
        let cos3 = (position.y * cos - position.x * sin + g.lateral_offset_m) / g.link_m;
        let sin3_squared = 1.0 - cos3 * cos3;
        if sin3_squared < 0.0 {
            return Err(PoseError::OutOfReach { position });
        }
        let sin3 = sin3_squared.sqrt();
        let reach = g.link_offset_m + g.link_m * sin3;
        // The arm's share along the line from its axis to the grip, by the law of cosines; then its angle from that line.
        let squared = out * out + up * up;
        let along = (squared + g.arm_m * g.arm_m - reach * reach) / (2.0 * g.arm_m);
        let across_squared = squared - along * along;
        if across_squared < 0.0 || squared == 0.0 {
            return Err(PoseError::OutOfReach { position });
        }
        let across = across_squared.sqrt();
        let (cos1, sin1) = ((out * along + up * across) / squared, (up * along - out * across) / squared);
        let (cos2, sin2) = ((out - g.arm_m * cos1) / reach, (up - g.arm_m * sin1) / reach);
        let bend = sin2 * cos1 - cos2 * sin1;
        if bend < MIN_SINE || sin3 < MIN_SINE {
            return Err(PoseError::Singular { position });
        }
        let toward = DVec3::new(cos * cos2 * sin3 - sin * cos3, sin * cos2 * sin3 + cos * cos3, sin2 * sin3);
        Ok(Leg { angle: sin1.atan2(cos1), gradient: toward / (g.arm_m * sin3 * bend) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn kinematics() -> Kinematics {
        Kinematics::new(Geometry::load("libnifalcon").unwrap())
    }

    /// Places all over the free disc of each depth.
    fn places() -> Vec<DVec3> {
        let mut places = Vec::new();
        for (z, radius) in
            [(0.09, 0.014), (0.1, 0.04), (0.11, 0.06), (0.13, 0.065), (0.15, 0.05), (0.17, 0.024)]
        {
            for n in 0..60 {
                let r = radius * (f64::from(n % 10) / 9.0).sqrt();
                let turn = f64::from(n) * 2.4;
                places.push(DVec3::new(r * turn.cos(), r * turn.sin(), z));
            }
        }
        places
    }

    #[test]
    fn forward_undoes_inverse_from_near_and_from_afar() {
        let kinematics = kinematics();
        for place in places() {
            let angles = kinematics.inverse(place).unwrap();
            for near in [place + DVec3::splat(4e-4), START, DVec3::NAN, DVec3::splat(9.0)] {
                let found = kinematics.forward(angles, near).unwrap();
                assert!(found.distance(place) < 1e-9, "{place} found as {found} from {near}");
            }
        }
    }

    #[test]
    fn gradients_are_the_slopes() {
        let kinematics = kinematics();
        for place in places() {
            let jacobian = kinematics.jacobian(place).unwrap();
            for axis in DVec3::AXES {
                let at = |by: f64| DVec3::from_array(kinematics.inverse(place + axis * by).unwrap());
                let slope = (at(1e-6) - at(-1e-6)) / 2e-6;
                assert!((jacobian * axis - slope).length() < 1e-6 * jacobian.x_axis.length(), "at {place}");
            }
        }
    }

    #[test]
    fn torques_do_the_forces_work() {
        let kinematics = kinematics();
        let force = DVec3::new(1.0, -2.0, 0.5);
        for place in places() {
            let torques = kinematics.torques(place, force).unwrap();
            assert!(kinematics.force(place, torques).unwrap().distance(force) < 1e-12);
            let moved = DVec3::new(2e-7, 1e-7, -3e-7);
            let turned = DVec3::from_array(kinematics.inverse(place + moved).unwrap())
                - DVec3::from_array(kinematics.inverse(place - moved).unwrap());
            assert!((torques.dot(turned) - force.dot(moved) * 2.0).abs() < 1e-12, "at {place}");
        }
    }

    /// With either shipped set, so that the rim is felt before the arms' own stops.
    #[test]
    fn every_free_place_is_reached() {
        for name in Geometry::NAMES {
            let kinematics = Kinematics::new(Geometry::load(name).unwrap());
            for pair in FREE_DISCS.windows(2) {
                for n in 0..200 {
                    let share = f64::from(n % 10) / 9.0;
                    let between = |a: f64, b: f64| a + (b - a) * share;
                    let (z, radius) = (between(pair[0].0, pair[1].0), between(pair[0].1, pair[1].1));
                    let turn = f64::from(n) * 0.37;
                    let place = DVec3::new(radius * turn.cos(), radius * turn.sin(), z);
                    assert!(kinematics.jacobian(place).is_ok(), "{name}: {place}");
                }
            }
        }
    }

    #[test]
    fn what_cannot_be_is_refused() {
        let kinematics = kinematics();
        let far = DVec3::new(0.0, 0.0, 0.3);
        assert_eq!(kinematics.inverse(far), Err(PoseError::OutOfReach { position: far }));
        assert_eq!(kinematics.inverse(DVec3::NAN), Err(PoseError::NotFinite));
        assert_eq!(kinematics.torques(START, DVec3::INFINITY), Err(PoseError::NotFinite));
        assert_eq!(kinematics.forward([f64::NAN; 3], START), Err(PoseError::NotFinite));
        assert!(matches!(kinematics.forward([3.0, -3.0, 0.0], START), Err(PoseError::DoNotMeet { .. })));
    }

    /// Where the arms stretch out, at the end of their reach, torque gives no more force sideways.
    #[test]
    fn a_stretched_leg_is_singular() {
        let kinematics = kinematics();
        let refused = (1800..2000).filter(|n| {
            matches!(kinematics.inverse(DVec3::Z * f64::from(*n) * 1e-4), Err(PoseError::Singular { .. }))
        });
        assert!(refused.count() > 0);
    }

    /// The other set's heights at count 0, as they follow from its paper's lengths at three zero angles.
    #[test]
    fn the_other_set_stands_where_its_paper_puts_it() {
        let mut geometry = Geometry::load("martin").unwrap();
        for (zero, height) in [(35.0, 0.1385), (40.0, 0.1448), (50.0, 0.1565)] {
            geometry.zero_deg = [zero; 3];
            let kinematics = Kinematics::new(geometry.clone());
            let found = kinematics.forward(geometry.angles([0; 3]), START).unwrap();
            assert!((found.z - height).abs() < 1e-4, "{found}");
        }
    }
}
