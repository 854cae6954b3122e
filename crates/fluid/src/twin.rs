//! The plain scalar twin: the solvers' sums in f64, O(N²), without grid, lanes, tables or threads.
//!
//! Slow and obvious on purpose: tests hold the fast passes against it.

use crate::{Kernel, kernel};
use glam::DVec3;

/// One particle.
#[derive(Clone, Copy, Debug)]
pub struct Twin {
    /// Position, m.
    pub x: DVec3,
    /// Velocity, m/s.
    pub v: DVec3,
    /// Pressure: Pa for `muller`, m²/s² for `wcsph`.
    pub p: f64,
    /// Density, kg/m³ (`muller`).
    pub density: f64,
}

/// Constants of the `muller` sums.
#[derive(Clone, Copy, Debug)]
pub struct MullerTwin {
    /// Support, m.
    pub h: f64,
    /// Particle mass, kg.
    pub mass: f64,
    /// Dynamic viscosity, Pa·s.
    pub viscosity: f64,
    /// Surface tension, N/m.
    pub tension: f64,
    /// |∇c| below which no tension acts, 1/m.
    pub inside: f64,
}

impl MullerTwin {
    /// Density at particle `i`, kg/m³.
    pub fn density(&self, all: &[Twin], i: usize) -> f64 {
        all.iter().map(|j| self.mass * kernel::poly6(j.x.distance(all[i].x), self.h)).sum()
    }

    /// Acceleration of particle `i` without gravity, m/s².
    pub fn acceleration(&self, all: &[Twin], i: usize) -> DVec3 {
        let a = all[i];
        let (mut force, mut normal, mut curvature) = (DVec3::ZERO, DVec3::ZERO, 0.0);
        for (k, b) in all.iter().enumerate() {
            let (offset, r) = (a.x - b.x, a.x.distance(b.x));
            let volume = self.mass / b.density;
            if k != i && r > 0.0 {
                force -= volume * (a.p + b.p) / 2.0 * kernel::spiky_slope(r, self.h) * offset / r;
            }
            force += self.viscosity * volume * (b.v - a.v) * kernel::viscosity_laplacian(r, self.h);
            normal += volume * kernel::poly6_slope_over_r(r, self.h) * offset;
            curvature += volume * kernel::poly6_laplacian(r, self.h);
        }
        if normal.length() > self.inside {
            force -= self.tension * curvature * normal.normalize();
        }
        force / a.density
    }
}

/// Constants of the `wcsph` sums.
#[derive(Clone, Copy, Debug)]
pub struct WcsphTwin {
    /// Kernel.
    pub kernel: Kernel,
    /// Support, m.
    pub h: f64,
    /// Volume of a particle in the gradient sums, m³.
    pub volume: f64,
    /// Kinematic viscosity, m²/s.
    pub viscosity: f64,
    /// κ of the noise filter, m⁴/s.
    pub filter: f64,
    /// Gravity, m/s².
    pub gravity: DVec3,
}

impl WcsphTwin {
    /// Divergence of the velocity at particle `i`, 1/s.
    pub fn divergence(&self, all: &[Twin], i: usize) -> f64 {
        let a = all[i];
        all.iter().map(|b| self.volume * (b.v - a.v).dot(self.gradient(&a, b))).sum()
    }

    /// Σ 2V (P_j − P_i − g·(x_j−x_i)) (x_j−x_i)·∇W/r², the diffusion before its factor.
    pub fn diffusion(&self, all: &[Twin], i: usize) -> f64 {
        let a = all[i];
        let term = |b: &Twin| {
            let d = b.x - a.x;
            let dp = b.p - a.p - self.gravity.dot(d);
            -2.0 * self.volume * dp * self.kernel.slope_over_r(d.length(), self.h)
        };
        all.iter().map(term).sum()
    }

    /// Σ V ∇W at particle `i`, 1/m.
    pub fn crowding(&self, all: &[Twin], i: usize) -> DVec3 {
        all.iter().map(|b| self.volume * self.gradient(&all[i], b)).sum()
    }

    /// Σ W at particle `i`, 1/m³.
    pub fn sum(&self, all: &[Twin], i: usize) -> f64 {
        all.iter().map(|b| self.kernel.value(b.x.distance(all[i].x), self.h)).sum()
    }

    /// Laplacian of a field at particle `i` (the viscous sum, for a unit viscosity).
    pub fn laplacian(&self, all: &[Twin], i: usize, field: impl Fn(usize) -> DVec3) -> DVec3 {
        let term = |(k, b): (usize, &Twin)| {
            let slope = self.kernel.slope_over_r(all[i].x.distance(b.x), self.h);
            let d = b.x - all[i].x;
            -self.kernel.viscous_factor() / (self.h * self.h)
                * self.volume
                * slope
                * (field(k) - field(i)).dot(d)
                * d
        };
        all.iter().enumerate().map(term).sum()
    }

    /// Acceleration of particle `i` by the others, without gravity, m/s²; `laplacians`: those of the velocity.
    pub fn acceleration(&self, all: &[Twin], laplacians: &[DVec3], i: usize) -> DVec3 {
        let pressure: DVec3 =
            all.iter().map(|b| -self.volume * (all[i].p + b.p) * self.gradient(&all[i], b)).sum();
        let filter = self.laplacian(all, i, |k| laplacians[k]);
        pressure + self.viscosity * laplacians[i] - self.filter * filter
    }

    /// ∇_a W.
    fn gradient(&self, a: &Twin, b: &Twin) -> DVec3 {
        self.kernel.slope_over_r(a.x.distance(b.x), self.h) * (a.x - b.x)
    }
}

/// Constants of the sums of `wcsph`'s surface tension.
#[derive(Clone, Copy, Debug)]
pub struct TensionTwin {
    /// Support, m.
    pub h: f64,
    /// Volume of a particle in the gradient sums, m³.
    pub volume: f64,
    /// 2σ/ρ₀, m³/s².
    pub strength: f64,
}

impl TensionTwin {
    /// Gradient of the colour at particle `i`, 1/m.
    pub fn normal(&self, all: &[Twin], i: usize) -> DVec3 {
        all.iter().map(|b| self.weight(&all[i], b) * (b.x - all[i].x)).sum()
    }

    /// Acceleration of particle `i` by its curvature, m/s²; `normals`: the gradients of all.
    pub fn acceleration(&self, all: &[Twin], normals: &[DVec3], i: usize) -> DVec3 {
        let own = normals[i].normalize_or_zero();
        let (mut turn, mut along) = (0.0, 0.0);
        for (b, n) in all.iter().zip(normals) {
            let (d, weight) = (b.x - all[i].x, n.length() * self.weight(&all[i], b));
            turn += weight * (n.normalize_or_zero() - own).dot(d);
            along += weight * d.reject_from_normalized(own).length_squared();
        }
        let curvature = -2.0 * turn / along;
        self.strength * curvature * normals[i]
    }

    fn weight(&self, a: &Twin, b: &Twin) -> f64 {
        -self.volume * kernel::poly6_slope_over_r(a.x.distance(b.x), self.h)
    }
}
