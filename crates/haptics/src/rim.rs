//! The soft edge of a device's workspace.

use crate::{RangeError, check_range};
use glam::{DVec2, DVec3};

/// The space in which a device moves freely, in the device frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Workspace {
    /// A box along the device's axes.
    Box {
        /// Its lower corner, m.
        min: DVec3,
        /// Its upper corner, m; each coordinate above that of `min`.
        max: DVec3,
    },
    /// A sphere.
    Sphere {
        /// Its centre, m.
        centre: DVec3,
        /// Its radius, m, 0.001 to 10.
        radius: f64,
    },
    /// What discs about the z axis span, straight from each to the next: for arms that reach less at some depths.
    Discs {
        /// Where depth 0 is, m.
        centre: DVec3,
        /// Depth (along z) and radius of each, m: at least two, in order of depth; what they span is convex.
        discs: &'static [(f64, f64)],
    },
}

/// Why a workspace or its rim was refused.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum WorkspaceError {
    /// A number outside its range.
    #[error(transparent)]
    Range(#[from] RangeError),
    /// A box whose corners are not finite or not in order.
    #[error("workspace box: every coordinate of min {min} must be below that of max {max}, and finite")]
    Corners {
        /// Its lower corner, m.
        min: DVec3,
        /// Its upper corner, m.
        max: DVec3,
    },
    /// Discs that span nothing, or nothing convex.
    #[error("workspace discs: at least two, in order of depth, with positive radii, and convex")]
    Discs,
    /// A sphere, or discs, whose centre is not finite.
    #[error("workspace: the centre {centre} must be finite")]
    Centre {
        /// Its centre, m.
        centre: DVec3,
    },
}

impl Workspace {
    /// The shortest way from `position` back into it, m; zero inside.
    pub fn way_back(&self, position: DVec3) -> DVec3 {
        match *self {
            Self::Box { min, max } => position.clamp(min, max) - position,
            Self::Sphere { centre, radius } => {
                let from = position - centre;
                from.clamp_length_max(radius) - from
            }
            Self::Discs { centre, discs } => {
                let from = position - centre;
                let place = DVec2::new(from.truncate().length(), from.z);
                let way = nearest(place, discs) - place;
                (from.truncate().normalize_or_zero() * way.x).extend(way.y)
            }
        }
    }

    fn check(&self) -> Result<(), WorkspaceError> {
        match *self {
            Self::Box { min, max } if min.is_finite() && max.is_finite() && min.cmplt(max).all() => Ok(()),
            Self::Box { min, max } => Err(WorkspaceError::Corners { min, max }),
            Self::Sphere { centre, .. } | Self::Discs { centre, .. } if !centre.is_finite() => {
                Err(WorkspaceError::Centre { centre })
            }
            Self::Discs { discs, .. } if !is_convex(discs) => Err(WorkspaceError::Discs),
            Self::Discs { .. } => Ok(()),
            Self::Sphere { radius, .. } => {
                check_range("workspace radius (m)", radius, 0.001, 10.0)?;
                Ok(())
            }
        }
    }
}

/// The place nearest to `place` (distance from the axis, depth) of what `discs` span.
fn nearest(place: DVec2, discs: &[(f64, f64)]) -> DVec2 {
    let rim = |&(depth, radius): &(f64, f64)| DVec2::new(radius, depth);
    let sides = discs.windows(2).map(|pair| (rim(&pair[0]), rim(&pair[1])));
    if sides.clone().any(|(a, b)| (a.y..=b.y).contains(&place.y) && (b - a).perp_dot(place - a) >= 0.0) {
        return place;
    }
    let ends = discs.first().into_iter().chain(discs.last()).map(|disc| (DVec2::new(0.0, disc.0), rim(disc)));
    let on = |(a, b): (DVec2, DVec2)| {
        a + (b - a) * ((place - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0)
    };
    let all = sides.chain(ends).map(on);
    all.min_by(|a, b| a.distance_squared(place).total_cmp(&b.distance_squared(place))).unwrap_or(place)
}

fn is_convex(discs: &[(f64, f64)]) -> bool {
    let sound = |&(depth, radius): &(f64, f64)| depth.is_finite() && radius > 0.0 && radius.is_finite();
    let slope = |pair: &[(f64, f64)]| (pair[1].1 - pair[0].1) / (pair[1].0 - pair[0].0);
    discs.len() >= 2
        && discs.iter().all(sound)
        && discs.windows(2).all(|pair| pair[0].0 < pair[1].0)
        && discs.windows(3).all(|three| slope(&three[..2]) >= slope(&three[1..]))
}

/// A spring outside a workspace that pushes back, so that the hand feels an edge and not the device's hard
/// stop.
///
/// Its stiffness grows from zero over the first `soft_m` outside, so its force and the slope of that have no
/// jump: F = k d²/2s for d < s, k (d − s/2) beyond. It has no damping: it is a potential, and gives back no
/// more than it took. Felt through a sampled servo it is passive on a device with more damping than k T/2:
/// 0.1 N·s/m by default.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rim {
    workspace: Workspace,
    stiffness_n_per_m: f64,
    soft_m: f64,
}

impl Rim {
    /// Default stiffness, N/m: 2 N at about 12 mm outside.
    pub const DEFAULT_STIFFNESS_N_PER_M: f64 = 200.0;
    /// Default distance over which the stiffness grows, m.
    pub const DEFAULT_SOFT_M: f64 = 0.005;

    /// `stiffness_n_per_m`: 0 to 2000 N/m; `soft_m`: 0 to 0.1 m.
    ///
    /// # Errors
    /// [`WorkspaceError`] if a number is outside its range, or a box has no inside.
    pub fn new(workspace: Workspace, stiffness_n_per_m: f64, soft_m: f64) -> Result<Self, WorkspaceError> {
        workspace.check()?;
        check_range("rim stiffness_n_per_m", stiffness_n_per_m, 0.0, 2000.0)?;
        check_range("rim soft_m", soft_m, 0.0, 0.1)?;
        Ok(Self { workspace, stiffness_n_per_m, soft_m })
    }

    /// The workspace that it surrounds.
    pub fn workspace(&self) -> &Workspace {
        &self.workspace
    }

    /// Force at `position` (m, device frame), N.
    pub fn force(&self, position: DVec3) -> DVec3 {
        let way_back = self.workspace.way_back(position);
        let outside = way_back.length();
        if outside == 0.0 { DVec3::ZERO } else { way_back * (self.pull(outside) / outside) }
    }

    /// Size of the force at `outside` metres outside, N.
    fn pull(&self, outside: f64) -> f64 {
        let lead = if outside < self.soft_m {
            outside * outside / (2.0 * self.soft_m)
        } else {
            outside - self.soft_m / 2.0
        };
        self.stiffness_n_per_m * lead
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn unit_box() -> Workspace {
        Workspace::Box { min: DVec3::splat(-1.0), max: DVec3::ONE }
    }

    #[test]
    fn the_force_grows_softly_then_straight() {
        let rim = Rim::new(unit_box(), 200.0, 0.005).unwrap();
        let pull = |outside: f64| rim.force(DVec3::X * (1.0 + outside)).x;
        assert_eq!(pull(-0.5), 0.0);
        assert_eq!(rim.force(DVec3::ONE), DVec3::ZERO);
        for (outside, expected) in [(0.0025, -0.125), (0.005, -0.5), (0.0125, -2.0)] {
            assert!((pull(outside) - expected).abs() < 1e-12, "{outside}: {}", pull(outside));
        }
    }

    #[test]
    fn corners_and_spheres_pull_the_shortest_way() {
        let rim = Rim::new(unit_box(), 100.0, 0.0).unwrap();
        let force = rim.force(DVec3::new(1.3, -1.4, 0.2));
        assert!((force - DVec3::new(-30.0, 40.0, 0.0)).length() < 1e-9, "{force}");
        let sphere = Workspace::Sphere { centre: DVec3::Y, radius: 0.5 };
        let rim = Rim::new(sphere, 100.0, 0.0).unwrap();
        assert!((rim.force(DVec3::Y * 1.6) - DVec3::Y * -10.0).length() < 1e-9);
        assert_eq!(rim.force(DVec3::Y * 1.4), DVec3::ZERO);
    }

    const SPINDLE: [(f64, f64); 3] = [(-1.0, 0.5), (0.0, 1.0), (1.0, 0.5)];

    #[test]
    fn discs_pull_the_shortest_way() {
        let spindle = Workspace::Discs { centre: DVec3::X, discs: &SPINDLE };
        let way = |x: f64, z: f64| spindle.way_back(DVec3::new(x, 0.0, z));
        for inside in [(1.0, 0.0), (1.99, 0.0), (1.49, 1.0), (1.0, -1.0), (1.7, 0.5)] {
            assert_eq!(way(inside.0, inside.1), DVec3::ZERO, "{inside:?}");
        }
        // Outwards of the widest disc, off an end, and off a slope, along its normal.
        assert!((way(3.0, 0.0) - DVec3::X * -1.0).length() < 1e-12);
        assert!((way(1.2, 1.3) - DVec3::Z * -0.3).length() < 1e-12);
        let normal = DVec3::new(2.0, 0.0, 1.0).normalize();
        let off = DVec3::new(1.75, 0.0, 0.5) + normal * 0.1;
        assert!((spindle.way_back(off) + normal * 0.1).length() < 1e-12);
        for refused in [&SPINDLE[..1], &[(0.0, 1.0), (0.0, 2.0)], &[(0.0, 1.0), (1.0, 0.1), (2.0, 1.0)]] {
            let discs: &'static [(f64, f64)] = Box::leak(refused.to_vec().into_boxed_slice());
            let rim = Rim::new(Workspace::Discs { centre: DVec3::ZERO, discs }, 1.0, 0.0);
            assert_eq!(rim, Err(WorkspaceError::Discs));
        }
    }

    #[test]
    fn it_gives_back_what_it_took() {
        let round = Workspace::Sphere { centre: DVec3::ZERO, radius: 0.1 };
        let discs = Workspace::Discs { centre: DVec3::ZERO, discs: &[(-0.1, 0.05), (0.0, 0.1), (0.01, 0.1)] };
        [round, discs].into_iter().for_each(gives_back);
    }

    fn gives_back(workspace: Workspace) {
        let rim = Rim::new(workspace, 200.0, 0.005).unwrap();
        let place = |turn: f64| {
            let angle = std::f64::consts::TAU * turn;
            DVec3::new(0.1 + 0.03 * angle.cos(), 0.04 * angle.sin(), 0.02 * (2.0 * angle).sin())
        };
        let steps = 20_000;
        let (mut work, mut effort) = (0.0, 0.0_f64);
        for n in 0..steps {
            let (from, to) = (place(n as f64 / steps as f64), place((n + 1) as f64 / steps as f64));
            let share = rim.force((from + to) / 2.0).dot(to - from);
            work += share;
            effort += share.abs();
        }
        assert!(effort > 0.05 && work.abs() < 1e-7 * effort, "work {work} J of {effort} J");
    }

    #[test]
    fn what_makes_no_workspace_is_refused() {
        let flat = Workspace::Box { min: DVec3::ZERO, max: DVec3::new(1.0, 0.0, 1.0) };
        assert!(matches!(Rim::new(flat, 1.0, 0.0), Err(WorkspaceError::Corners { .. })));
        let lost = Workspace::Sphere { centre: DVec3::NAN, radius: 1.0 };
        assert!(matches!(Rim::new(lost, 1.0, 0.0), Err(WorkspaceError::Centre { .. })));
        let error = Rim::new(unit_box(), 2001.0, 0.0).unwrap_err();
        assert_eq!(error.to_string(), "rim stiffness_n_per_m = 2001 is outside its range 0 to 2000");
        assert!(Rim::new(unit_box(), 1.0, f64::NAN).is_err());
        let point = Workspace::Sphere { centre: DVec3::ZERO, radius: 0.0 };
        assert!(Rim::new(point, 1.0, 0.0).is_err());
    }
}
