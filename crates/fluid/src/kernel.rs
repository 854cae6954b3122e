//! Smoothing kernels of support `h` (no influence beyond it), three-dimensional and normalised.
//!
//! `Muller` uses poly6, spiky and viscosity of Müller, Charypar & Gross 2003 (SCA 2003, "Particle-based fluid
//! simulation for interactive applications"); `Wcsph` uses a [`Kernel`] of choice: Wendland C2 (Wendland 1995,
//! doi:10.1007/BF02123482; for SPH Dehnen & Aly 2012, doi:10.1111/j.1365-2966.2012.21439.x), the cubic spline
//! (Monaghan & Lattanzio 1985, A&A 149, 135; doi:10.1146/annurev.aa.30.090192.002551 has it too) or a low-pass kernel.
//!
//! What a kernel's Fourier transform has left at the wave numbers of the particles' own arrangement, from about 5/dx on,
//! is felt as an elasticity of that arrangement: under pressure it resists shear like a weak solid, and a body that is
//! towed slowly is held back by a yield stress. The low-pass kernel is the polynomial Σ a_n (1−q²)ⁿ, n = 3 to 9, of which,
//! at a support of 2.7 dx, least is left there: 1e-5, where Wendland C2 has 3e-3 and the cubic spline −2e-3. Found by a
//! linear program (least maximum of the transform over 0.8 to 1.7 times 2π/dx, a slope that falls steadily to zero).
//! These scalar forms are the reference; `pair_kernel.rs` holds the same polynomials in lanes.

use std::f64::consts::PI;

/// Kernel of `wcsph`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kernel {
    /// Wendland C2.
    Wendland,
    /// The cubic spline, whose smoothing length is half the support.
    Cubic,
    /// Blind to the particles' own arrangement.
    LowPass,
}

impl Kernel {
    /// Value, 1/m³.
    pub fn value(self, r: f64, h: f64) -> f64 {
        match self {
            Self::Wendland => wendland(r, h),
            Self::Cubic => cubic(r, h),
            Self::LowPass => low_pass(r, h),
        }
    }

    /// Derivative over r, (dW/dr)/r, 1/m⁵ (never positive).
    pub fn slope_over_r(self, r: f64, h: f64) -> f64 {
        match self {
            Self::Wendland => wendland_slope_over_r(r, h),
            Self::Cubic => cubic_slope_over_r(r, h),
            Self::LowPass => low_pass_slope_over_r(r, h),
        }
    }

    /// The constant of [`slope_over_r`](Self::slope_over_r), 1/m⁵.
    pub fn gradient_scale(self, h: f64) -> f64 {
        match self {
            Self::Wendland => wendland_gradient_scale(h),
            Self::Cubic => cubic_gradient_scale(h),
            Self::LowPass => low_pass_gradient_scale(h),
        }
    }

    /// K for which −K/h² Σ V (dW/dr)/r (Δv·d) d is the Laplacian of v, where div v = 0: 2/K is the mean of the fourth
    /// moments, (4π/15) ∫ −W' r⁵ dr, over h².
    pub fn viscous_factor(self) -> f64 {
        match self {
            Self::Wendland => 30.0,
            Self::Cubic => 80.0 / 3.0,
            Self::LowPass => 6.0 * LOW_PASS_SECOND / LOW_PASS_FOURTH,
        }
    }

    /// First moment of the gradient over a cubic lattice of spacing `dx`: 1 in the continuum. Volumes divided by it
    /// make the discrete gradient exact for linear fields on the lattice.
    pub fn lattice_moment(self, dx: f64, h: f64) -> f64 {
        lattice_sum(dx, h, |r, x| -self.slope_over_r(r, h) * x * x)
    }

    /// Sum of the kernel over a cubic lattice of spacing `dx`: 1 in the continuum.
    pub fn lattice_sum(self, dx: f64, h: f64) -> f64 {
        lattice_sum(dx, h, |r, _| self.value(r, h))
    }
}

/// Poly6 value, 1/m³.
pub fn poly6(r: f64, h: f64) -> f64 {
    if r > h { 0.0 } else { 315.0 / (64.0 * PI * h.powi(9)) * (h * h - r * r).powi(3) }
}

/// Spiky derivative dW/dr, 1/m⁴ (never positive).
pub fn spiky_slope(r: f64, h: f64) -> f64 {
    if r > h { 0.0 } else { -45.0 / (PI * h.powi(6)) * (h - r).powi(2) }
}

/// Poly6 derivative over r, (dW/dr)/r, 1/m⁵ (never positive).
pub fn poly6_slope_over_r(r: f64, h: f64) -> f64 {
    if r > h { 0.0 } else { -945.0 / (32.0 * PI * h.powi(9)) * (h * h - r * r).powi(2) }
}

/// First moment of the poly6 gradient over a cubic lattice of spacing `dx`: 1 in the continuum.
pub fn poly6_lattice_moment(dx: f64, h: f64) -> f64 {
    lattice_sum(dx, h, |r, x| -poly6_slope_over_r(r, h) * x * x)
}

/// Normal component of the gradient of poly6's integral over a half space at distance `d`, 1/m; never positive.
pub fn poly6_plane_gradient(d: f64, h: f64) -> f64 {
    let q2 = (d / h).powi(2);
    if q2 > 1.0 { 0.0 } else { -315.0 / (256.0 * h) * (1.0 - q2).powi(4) }
}

/// Poly6 Laplacian, 1/m⁵.
pub fn poly6_laplacian(r: f64, h: f64) -> f64 {
    let (h2, r2) = (h * h, r * r);
    if r > h { 0.0 } else { -945.0 / (32.0 * PI * h.powi(9)) * (h2 - r2) * (3.0 * h2 - 7.0 * r2) }
}

/// Laplacian of the viscosity kernel, 1/m⁵ (never negative).
pub fn viscosity_laplacian(r: f64, h: f64) -> f64 {
    if r > h { 0.0 } else { 45.0 / (PI * h.powi(6)) * (h - r) }
}

/// Wendland C2 value, 1/m³.
pub fn wendland(r: f64, h: f64) -> f64 {
    let q = r / h;
    if q > 1.0 { 0.0 } else { 21.0 / (2.0 * PI * h.powi(3)) * (1.0 - q).powi(4) * (1.0 + 4.0 * q) }
}

/// Wendland C2 derivative over r, (dW/dr)/r, 1/m⁵: a polynomial without division.
pub fn wendland_slope_over_r(r: f64, h: f64) -> f64 {
    let q = r / h;
    if q > 1.0 { 0.0 } else { -wendland_gradient_scale(h) * (1.0 - q).powi(3) }
}

/// The constant of [`wendland_slope_over_r`], 1/m⁵.
pub fn wendland_gradient_scale(h: f64) -> f64 {
    20.0 * 21.0 / (2.0 * PI * h.powi(5))
}

/// Cubic spline value, 1/m³.
pub fn cubic(r: f64, h: f64) -> f64 {
    let q = r / h;
    let (outer, inner) = ((1.0 - q).max(0.0), (0.5 - q).max(0.0));
    8.0 / (PI * h.powi(3)) * (2.0 * outer.powi(3) - 8.0 * inner.powi(3))
}

/// Cubic spline derivative over r, (dW/dr)/r, 1/m⁵.
pub fn cubic_slope_over_r(r: f64, h: f64) -> f64 {
    let q = (r / h).min(1.0);
    let bend = (2.0 * q - 1.0).max(0.0).powi(2) / q.max(0.5);
    -cubic_gradient_scale(h) * (2.0 - 3.0 * q + bend)
}

/// The constant of [`cubic_slope_over_r`], 1/m⁵.
pub fn cubic_gradient_scale(h: f64) -> f64 {
    48.0 / (PI * h.powi(5))
}

/// a_n of the low-pass kernel for n = 3 to 9; their sum is 1.
pub const LOW_PASS: [f64; 7] = [0.3499, -1.8993, 6.9524, -12.3113, 13.4827, -7.4977, 1.9233];

/// Low-pass kernel value, 1/m³.
pub fn low_pass(r: f64, h: f64) -> f64 {
    let s = (1.0 - (r / h).powi(2)).max(0.0);
    let sum: f64 = (3..).zip(LOW_PASS).map(|(n, a)| a * s.powi(n)).sum();
    sum / (4.0 * PI * h.powi(3) * LOW_PASS_SECOND)
}

/// Low-pass kernel derivative over r, (dW/dr)/r, 1/m⁵.
pub fn low_pass_slope_over_r(r: f64, h: f64) -> f64 {
    let s = (1.0 - (r / h).powi(2)).max(0.0);
    let sum: f64 = (3..).zip(LOW_PASS).map(|(n, a)| a * f64::from(n) * s.powi(n - 1)).sum();
    -low_pass_gradient_scale(h) * sum
}

/// The constant of [`low_pass_slope_over_r`], 1/m⁵.
pub fn low_pass_gradient_scale(h: f64) -> f64 {
    2.0 / (4.0 * PI * h.powi(5) * LOW_PASS_SECOND)
}

/// Moments of the low-pass kernel's polynomial: see [`low_pass_moment`].
const LOW_PASS_SECOND: f64 = low_pass_moment(2);
const LOW_PASS_FOURTH: f64 = low_pass_moment(4);

/// ∫ q^power Σ a_n (1−q²)ⁿ dq from 0 to 1, for an even power: by parts, each n follows from the one before.
const fn low_pass_moment(power: u32) -> f64 {
    let half = (power + 1) as f64 / 2.0;
    let (mut sum, mut at) = (0.0, 0);
    while at < LOW_PASS.len() {
        let (mut integral, mut k) = (0.5 / half, 1);
        while k <= at + 3 {
            integral = integral * k as f64 / (k as f64 + half);
            k += 1;
        }
        sum += LOW_PASS[at] * integral;
        at += 1;
    }
    sum
}

fn lattice_sum(dx: f64, h: f64, term: impl Fn(f64, f64) -> f64) -> f64 {
    let reach = (h / dx).ceil() as i32;
    let mut sum = 0.0;
    for i in -reach..=reach {
        for j in -reach..=reach {
            for k in -reach..=reach {
                let r = dx * f64::from(i * i + j * j + k * k).sqrt();
                sum += dx.powi(3) * term(r, dx * f64::from(i));
            }
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    const KERNELS: [Kernel; 3] = [Kernel::Wendland, Kernel::Cubic, Kernel::LowPass];

    /// ∫ f(r) 4πr² dr over the support, by the midpoint rule.
    fn ball_integral(h: f64, f: impl Fn(f64) -> f64) -> f64 {
        let n = 20_000;
        let dr = h / f64::from(n);
        (0..n).map(|k| (f64::from(k) + 0.5) * dr).map(|r| f(r) * 4.0 * PI * r * r * dr).sum()
    }

    #[test]
    fn kernels_are_normalised() {
        for h in [0.01, 0.3] {
            assert!((ball_integral(h, |r| poly6(r, h)) - 1.0).abs() < 1e-6);
            for kernel in KERNELS {
                assert!((ball_integral(h, |r| kernel.value(r, h)) - 1.0).abs() < 1e-6);
            }
            // ∫ W = −∫ (r/3) W' for any kernel that vanishes at its edge.
            assert!((ball_integral(h, |r| -r / 3.0 * spiky_slope(r, h)) - 1.0).abs() < 1e-6);
            // A Laplacian that reproduces ∇²(r²) = 6 has second moment 6: the viscosity kernel's.
            assert!((ball_integral(h, |r| r * r * viscosity_laplacian(r, h)) - 6.0).abs() < 1e-5);
        }
    }

    #[test]
    fn slopes_are_the_derivatives() {
        let (h, e) = (0.2, 1e-6);
        for k in 1..19 {
            let r = 0.01 * f64::from(k);
            let numeric = |w: &dyn Fn(f64) -> f64| (w(r + e) - w(r - e)) / (2.0 * e);
            let near = |a: f64, b: f64| (a - b).abs() < 1e-3 * poly6(0.0, h) / h / h;
            assert!(near(numeric(&|r| poly6(r, h)) / r, poly6_slope_over_r(r, h)));
            for kernel in KERNELS {
                assert!(near(numeric(&|r| kernel.value(r, h)) / r, kernel.slope_over_r(r, h)));
            }
            let second = (poly6(r + 1e-4, h) - 2.0 * poly6(r, h) + poly6(r - 1e-4, h)) / 1e-8;
            let laplacian = second + 2.0 * poly6_slope_over_r(r, h);
            assert!((laplacian - poly6_laplacian(r, h)).abs() < 1e-3 * poly6(0.0, h) / h / h);
        }
    }

    #[test]
    fn lattice_sums_approach_one() {
        for kernel in KERNELS {
            for ratio in [2.4, 2.7, 3.2] {
                assert!((kernel.lattice_moment(0.01, 0.01 * ratio) - 1.0).abs() < 0.04);
                assert!((kernel.lattice_sum(0.01, 0.01 * ratio) - 1.0).abs() < 0.04);
            }
            assert!((kernel.lattice_moment(0.01, 0.06) - 1.0).abs() < 1e-3);
        }
    }

    #[test]
    fn the_plane_gradient_is_the_integral_over_its_face() {
        let h = 0.3;
        for d in [-0.2_f64, 0.0, 0.1, 0.29] {
            let n = 20_000;
            let ring = |k: i32| (f64::from(k) + 0.5) * h / f64::from(n);
            let face = |s: f64| 2.0 * PI * s * poly6(d.hypot(s), h) * h / f64::from(n);
            let sum: f64 = (0..n).map(ring).map(face).sum();
            assert!((poly6_plane_gradient(d, h) + sum).abs() < 1e-5 / h);
        }
    }

    #[test]
    fn the_viscous_factor_is_that_of_the_fourth_moment() {
        for kernel in KERNELS {
            let h = 0.3;
            let moment = ball_integral(h, |r| -kernel.slope_over_r(r, h) * r.powi(4) / 15.0) / (h * h);
            assert!((2.0 / moment / kernel.viscous_factor() - 1.0).abs() < 1e-6);
        }
    }

    /// ∫ W sin(kr)/(kr) over space.
    fn transform(kernel: Kernel, k: f64, h: f64) -> f64 {
        ball_integral(h, |r| kernel.value(r, h) * (k * r).sin() / (k * r))
    }

    #[test]
    fn the_low_pass_kernel_does_not_see_the_arrangement() {
        let dx = 0.01;
        let worst = |kernel| {
            let numbers = (80..250).map(|m| f64::from(m) / 100.0 * std::f64::consts::TAU / dx);
            numbers.map(|k| transform(kernel, k, 2.7 * dx).abs()).fold(0.0, f64::max)
        };
        assert!(worst(Kernel::LowPass) < 1.1e-5, "{}", worst(Kernel::LowPass));
        let others = [worst(Kernel::Wendland), worst(Kernel::Cubic)];
        assert!(others[0] > 2e-3 && others[1] > 3e-4, "{others:?}");
        // Nor is it narrower than the other, and so blinder to the flow no less.
        let width = |kernel: Kernel| 1.0 / kernel.viscous_factor();
        assert!((width(Kernel::LowPass) / width(Kernel::Wendland) - 1.0).abs() < 0.02);
    }
}
