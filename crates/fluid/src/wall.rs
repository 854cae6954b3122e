//! Walls and bodies as analytic volumes: what the solid part of a particle's support adds to its sums.
//!
//! For a particle at signed distance d from the surface, with the solid S filling part of its support, four
//! integrals of the kernel over S depend on d alone (for a plane, and for a sphere of known radius):
//! λ = ∫W, g = n·∫∇W, and the tensor ∫(x'−x)⊗∇W = tn n⊗n + tt (I − n⊗n); and the viscous sum for a velocity
//! that goes on linearly into the wall and has the wall's value at its surface, so that a uniform shear ends at
//! the wall without a fault. With a wall pressure extrapolated linearly (gravity and the wall's acceleration
//! included), a fluid at rest meets Archimedes' force of the true shape at any support. Ideas: density maps
//! (Koschier & Bender 2017, doi:10.1145/3099564.3099565), semi-analytic boundaries (Winchenbach, Akhunov & Kolb
//! 2020, doi:10.1145/3414685.3417829), pressure and velocity extrapolation (Adami, Hu & Adams 2012,
//! doi:10.1016/j.jcp.2012.05.005).

use crate::{Kernel, Shape};
use std::f64::consts::PI;

const CELLS: usize = 512;

/// The integrals at one distance.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct WallTerms {
    /// λ: share of the kernel inside the solid.
    pub volume: f32,
    /// g: normal component of the gradient, 1/m; never positive.
    pub gradient: f32,
    /// tn and tt.
    pub normal_moment: f32,
    pub tangent_moment: f32,
    /// Friction: viscous sum over the solid for a unit slope of the velocity at the wall, 1/m.
    pub friction: f32,
}

impl WallTerms {
    pub fn add_scaled(&mut self, other: &Self, scale: f32) {
        self.volume += scale * other.volume;
        self.gradient += scale * other.gradient;
        self.normal_moment += scale * other.normal_moment;
        self.tangent_moment += scale * other.tangent_moment;
        self.friction += scale * other.friction;
    }
}

/// The integrals tabulated over d from −H/2 to H.
#[derive(Clone, Debug)]
pub(crate) struct WallTable {
    inverse_step: f32,
    start: f32,
    terms: Vec<WallTerms>,
}

impl WallTable {
    /// For a flat wall.
    pub fn plane(kernel: Kernel, support: f64) -> Self {
        Self::tabulate(kernel, support, |d, s| d / s)
    }

    /// For the surface of `shape`: exact for a sphere. A tube gets the sphere of equal mean curvature, which is
    /// all of a curvature that the integrals know in first order. Edges are taken for flat.
    pub fn for_shape(shape: &Shape, kernel: Kernel, support: f64) -> Self {
        Self::round(shape.mean_curvature(), kernel, support)
    }

    /// For a wall of this mean curvature (1/m): see [`for_shape`](Self::for_shape).
    pub fn round(curvature: f64, kernel: Kernel, support: f64) -> Self {
        if curvature == 0.0 {
            return Self::plane(kernel, support);
        }
        let radius = 1.0 / curvature;
        Self::tabulate(kernel, support, |d, s| {
            // Of a hollow sphere the radius is negative, and so is the distance from its centre.
            let centre = if radius > 0.0 { (radius + d).max(1e-9) } else { (radius + d).min(-1e-9) };
            (centre * centre + s * s - radius * radius) / (2.0 * centre * s)
        })
    }

    /// `cap(d, s)`: cosine of the cap's opening, seen from the particle, on the shell of radius s.
    fn tabulate(kernel: Kernel, support: f64, cap: impl Fn(f64, f64) -> f64) -> Self {
        let (start, step) = (-0.5 * support, 1.5 * support / CELLS as f64);
        let (shells, viscous) = (shells(kernel, support), kernel.viscous_factor() / 8.0);
        let at = |k: usize| integrate(&shells, support, viscous, |s| cap(start + step * k as f64, s));
        let terms = (0..=CELLS).map(at).collect();
        Self { inverse_step: (1.0 / step) as f32, start: start as f32, terms }
    }

    /// The integrals at distance `d`, linear between entries; those of −H/2 for deeper ones.
    pub fn at(&self, d: f32) -> WallTerms {
        let u = ((d - self.start) * self.inverse_step).clamp(0.0, CELLS as f32 - 0.001);
        let k = u as usize;
        let w = u - k as f32;
        let (a, b) = (&self.terms[k], &self.terms[k + 1]);
        let mix = |p: f32, q: f32| p + w * (q - p);
        WallTerms {
            volume: mix(a.volume, b.volume),
            gradient: mix(a.gradient, b.gradient),
            normal_moment: mix(a.normal_moment, b.normal_moment),
            tangent_moment: mix(a.tangent_moment, b.tangent_moment),
            friction: mix(a.friction, b.friction),
        }
    }
}

/// A shell of the support, seen from the particle, and what the kernel is on it.
struct Shell {
    radius: f64,
    area: f64,
    value: f64,
    slope: f64,
}

fn shells(kernel: Kernel, support: f64) -> Vec<Shell> {
    const SHELLS: usize = 250;
    let ds = support / SHELLS as f64;
    let shell = |m: usize| {
        let s = (m as f64 + 0.5) * ds;
        let slope = kernel.slope_over_r(s, support) * s;
        Shell { radius: s, area: 2.0 * PI * s * s * ds, value: kernel.value(s, support), slope }
    };
    (0..SHELLS).map(shell).collect()
}

/// `cap`: cosine of the opening of what is solid of a shell.
fn integrate(shells: &[Shell], support: f64, viscous: f64, cap: impl Fn(f64) -> f64) -> WallTerms {
    let [mut volume, mut gradient, mut normal, mut tangent, mut friction] = [0.0; 5];
    for &Shell { radius: s, area: shell, value, slope } in shells {
        let mu = cap(s).clamp(-1.0, 1.0);
        let cube = 1.0 - mu.powi(3);
        volume += shell * value * (1.0 - mu);
        gradient += shell * slope * (1.0 - mu * mu) / 2.0;
        normal -= shell * s * slope * cube / 3.0;
        tangent -= shell * s * slope * ((1.0 - mu) / 2.0 - cube / 6.0);
        friction -= shell * slope * viscous * (s / support * (1.0 - mu * mu)).powi(2);
    }
    WallTerms {
        volume: volume as f32,
        gradient: gradient as f32,
        normal_moment: normal as f32,
        tangent_moment: tangent as f32,
        friction: friction as f32,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const KERNELS: [Kernel; 3] = [Kernel::Wendland, Kernel::Cubic, Kernel::LowPass];

    #[test]
    fn a_plane_through_the_particle_takes_half() {
        for kernel in KERNELS {
            let t = WallTable::plane(kernel, 0.02).at(0.0);
            assert!((t.volume - 0.5).abs() < 1e-3);
            // Half of the full first moment ∫(x'−x)⊗∇W = I.
            assert!((t.normal_moment - 0.5).abs() < 2e-3 && (t.tangent_moment - 0.5).abs() < 2e-3);
        }
    }

    #[test]
    fn gradient_is_the_slope_of_the_volume() {
        let h = 0.02_f64;
        let ball = Shape::Sphere { radius: 0.03 };
        let tables = |kernel| [WallTable::plane(kernel, h), WallTable::for_shape(&ball, kernel, h)];
        for table in KERNELS.into_iter().flat_map(tables) {
            for k in -8..18 {
                let (d, e) = (h as f32 * 0.05 * k as f32, 2e-4_f32);
                let slope = (table.at(d + e).volume - table.at(d - e).volume) / (2.0 * e);
                assert!((slope - table.at(d).gradient).abs() < 0.02 / h as f32, "{d}");
            }
            assert!(table.at(2.0 * h as f32).volume < 1e-6);
        }
    }

    #[test]
    fn a_huge_sphere_is_a_plane() {
        let h = 0.01;
        let (plane, sphere) = (
            WallTable::plane(Kernel::Wendland, h),
            WallTable::for_shape(&Shape::Sphere { radius: 100.0 }, Kernel::Wendland, h),
        );
        for k in -4..10 {
            let d = 0.001 * k as f32;
            assert!((plane.at(d).volume - sphere.at(d).volume).abs() < 1e-3);
        }
    }
}
