//! The blob of fluid that stands for each particle.
//!
//! Each blob is an ellipsoid that follows how its neighbours lie, flat in a film and long in a thread, after
//! Yu and Turk, "Reconstructing surfaces of particle-based fluids using anisotropic kernels" (2013).

use glam::{Mat3, Vec3};

use super::mirror::Mote;
use super::neighbours::Neighbours;
use super::tensor::eigen;

/// How far neighbours are looked for, in spacings.
pub(crate) const REACH: f32 = 2.5;
/// How much each centre moves towards its neighbours' mean.
const SMOOTHING: f32 = 0.85;
/// Radius of a blob deep in the fluid, in spacings.
const RADIUS: f32 = 2.0;
/// Thinnest and widest a blob may get, against the radius deep in the fluid.
const THIN: f32 = 0.3;
const WIDE: f32 = 1.1;
/// Radius of a drop of one particle, in spacings.
const DROP_RADIUS: f32 = 1.0;
/// Speed below which differences between neighbours are not foam, m/s.
const CALM: f32 = 0.6;

/// One particle's blob.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Kernel {
    pub centre: Vec3,
    /// Takes an offset from the centre into the unit ball.
    pub squash: Mat3,
    /// Half the sides of the box that holds the blob.
    pub extent: Vec3,
    /// Height of the blob at its centre, 1 deep in the fluid when summed over neighbours.
    pub peak: f32,
    /// How much the particle foams, 0 to 1.
    pub foam: f32,
    /// For an image behind a wall: the number of the box.
    pub behind: Option<usize>,
}

/// The blobs of `motes`.
pub(crate) fn kernels(motes: &[Mote], spacing: f32) -> Vec<Kernel> {
    let points: Vec<Vec3> = motes.iter().map(|mote| mote.place).collect();
    let neighbours = Neighbours::new(&points, REACH * spacing);
    motes.iter().map(|mote| kernel(&neighbours, motes, spacing, mote)).collect()
}

fn kernel(neighbours: &Neighbours, motes: &[Mote], spacing: f32, own: &Mote) -> Kernel {
    let reach = REACH * spacing;
    let (mut total, mut mean, mut count, mut speed) = (0.0_f32, Vec3::ZERO, 0.0_f32, 0.0_f32);
    neighbours.each(own.place, |j, r| {
        let weight = 1.0 - (r / reach).powi(3);
        total += weight;
        mean += weight * (motes[j].place - own.place);
        speed += weight * motes[j].speed;
        count += 1.0;
    });
    mean /= total.max(1e-9);
    let mut spread = Mat3::ZERO;
    neighbours.each(own.place, |j, r| {
        let off = motes[j].place - own.place - mean;
        spread += (1.0 - (r / reach).powi(3)) * Mat3::from_cols(off * off.x, off * off.y, off * off.z);
    });
    let crowd = ((count - 4.0) / 8.0).clamp(0.0, 1.0);
    let radii = Radii::new(spread * (1.0 / total.max(1e-9)), spacing, crowd);
    let stir = (own.speed - speed / total.max(1e-9)).abs() / (own.speed + CALM);
    let foam = ((stir - 0.12) * 2.5).clamp(0.0, 1.0).max(0.5 * (1.0 - crowd) * (own.speed / 1.0).min(1.0));
    let blob = radii.kernel(own.place + SMOOTHING * crowd * mean, spacing, foam);
    Kernel { behind: own.behind, ..blob }
}

/// The half axes of a blob and the directions they point.
struct Radii {
    lengths: Vec3,
    axes: Mat3,
}

impl Radii {
    /// Follows `spread` where the particle has a crowd round it, and is a drop where it has none.
    fn new(spread: Mat3, spacing: f32, crowd: f32) -> Self {
        let (values, axes) = eigen(spread);
        let deviation = values.max(Vec3::ZERO).map(f32::sqrt);
        // In an evenly filled ball the weighted variance along an axis is 0.15 of the radius squared.
        let even = 0.387 * REACH * spacing;
        let share = (deviation / even).max(Vec3::splat(deviation.max_element() / even / 4.0));
        let shaped = share.clamp(Vec3::splat(THIN), Vec3::splat(WIDE)) * (RADIUS * spacing);
        let lengths = Vec3::splat(DROP_RADIUS * spacing).lerp(shaped, crowd);
        Self { lengths, axes }
    }

    fn kernel(&self, centre: Vec3, spacing: f32, foam: f32) -> Kernel {
        let squash = Mat3::from_diagonal(self.lengths.recip()) * self.axes.transpose();
        let stretch = self.axes * Mat3::from_diagonal(self.lengths);
        let rows = stretch.transpose();
        let extent = Vec3::new(rows.x_axis.length(), rows.y_axis.length(), rows.z_axis.length());
        // The polynomial (1 - q²)³ over a unit ball has the volume 64π/315.
        let peak = 315.0 / (64.0 * std::f32::consts::PI) * spacing.powi(3) / self.lengths.element_product();
        Kernel { centre, squash, extent, peak, foam, behind: None }
    }
}
