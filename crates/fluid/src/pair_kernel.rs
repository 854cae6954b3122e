//! The kernels of `wcsph` as the pair loops take them: in lanes, at squared distances in supports², without their constants.
//!
//! Types and no values, so that each loop is compiled for one of them and the choice costs nothing in it.

use crate::kernel::LOW_PASS;
use crate::lanes::{difference, dot, fma};
use pulp::Simd;

/// A kernel in lanes.
pub(crate) trait PairKernel: Copy + Sync {
    /// −(dW/dr)/r over [`Kernel::gradient_scale`](crate::Kernel::gradient_scale) at distances of square `r2`; 0 from 1 on.
    fn slope<S: Simd>(self, simd: S, r2: S::f32s) -> S::f32s;

    /// W/W(0) there, added to `sum`.
    fn add_value<S: Simd>(self, simd: S, r2: S::f32s, sum: S::f32s) -> S::f32s;
}

/// Runs the body for the kernel's own type, so that its pair loop is compiled for it alone.
macro_rules! with_kernel {
    ($kernel:expr, |$k:ident| $body:expr) => {
        match $kernel {
            $crate::Kernel::Wendland => {
                let $k = $crate::pair_kernel::Wendland;
                $body
            }
            $crate::Kernel::Cubic => {
                let $k = $crate::pair_kernel::Cubic;
                $body
            }
            $crate::Kernel::LowPass => {
                let $k = $crate::pair_kernel::LowPass;
                $body
            }
        }
    };
}
pub(crate) use with_kernel;

/// d = j − i and d² of pairs.
#[inline(always)]
pub(crate) fn apart<S: Simd>(simd: S, i: [S::f32s; 3], j: [S::f32s; 3]) -> ([S::f32s; 3], S::f32s) {
    let d = difference(simd, i, j);
    (d, dot(simd, d, d))
}

/// The larger of a − b and 0.
#[inline(always)]
fn above<S: Simd>(simd: S, a: S::f32s, b: S::f32s) -> S::f32s {
    simd.max_f32s(simd.sub_f32s(a, b), simd.splat_f32s(0.0))
}

/// a³.
#[inline(always)]
fn cube<S: Simd>(simd: S, a: S::f32s) -> S::f32s {
    simd.mul_f32s(simd.mul_f32s(a, a), a)
}

/// Wendland C2: (1 − r)³ and (1 − r)⁴ (1 + 4r).
#[derive(Clone, Copy)]
pub(crate) struct Wendland;

impl PairKernel for Wendland {
    #[inline(always)]
    fn slope<S: Simd>(self, simd: S, r2: S::f32s) -> S::f32s {
        cube(simd, above(simd, simd.splat_f32s(1.0), simd.sqrt_f32s(r2)))
    }

    #[inline(always)]
    fn add_value<S: Simd>(self, simd: S, r2: S::f32s, sum: S::f32s) -> S::f32s {
        let (one, r) = (simd.splat_f32s(1.0), simd.sqrt_f32s(r2));
        let w = simd.mul_f32s(simd.sub_f32s(one, r), fma(simd, simd.splat_f32s(4.0), r, one));
        fma(simd, self.slope(simd, r2), w, sum)
    }
}

/// The cubic spline: 2 − 3r + (2r − 1)²/r and 2 (1 − r)³ − 8 (½ − r)³, where brackets below 0 are 0.
#[derive(Clone, Copy)]
pub(crate) struct Cubic;

impl PairKernel for Cubic {
    #[inline(always)]
    fn slope<S: Simd>(self, simd: S, r2: S::f32s) -> S::f32s {
        let (one, half) = (simd.splat_f32s(1.0), simd.splat_f32s(0.5));
        let r = simd.min_f32s(simd.sqrt_f32s(r2), one);
        let bend = above(simd, simd.add_f32s(r, r), one);
        let bend = simd.div_f32s(simd.mul_f32s(bend, bend), simd.max_f32s(r, half));
        simd.add_f32s(fma(simd, simd.splat_f32s(-3.0), r, simd.splat_f32s(2.0)), bend)
    }

    #[inline(always)]
    fn add_value<S: Simd>(self, simd: S, r2: S::f32s, sum: S::f32s) -> S::f32s {
        let r = simd.sqrt_f32s(r2);
        let outer = cube(simd, above(simd, simd.splat_f32s(1.0), r));
        let inner = cube(simd, above(simd, simd.splat_f32s(0.5), r));
        let sum = fma(simd, simd.splat_f32s(2.0), outer, sum);
        fma(simd, simd.splat_f32s(-8.0), inner, sum)
    }
}

/// a_n of the low-pass kernel, and n a_n.
const VALUE: [f32; 7] = low_pass_factors(false);
const SLOPE: [f32; 7] = low_pass_factors(true);

const fn low_pass_factors(slope: bool) -> [f32; 7] {
    let (mut factors, mut k) = ([0.0; 7], 0);
    while k < 7 {
        let n = if slope { (k + 3) as f64 } else { 1.0 };
        factors[k] = (n * LOW_PASS[k]) as f32;
        k += 1;
    }
    factors
}

/// The low-pass kernel: with s = 1 − r², Σ n a_n sⁿ⁻¹ and Σ a_n sⁿ; no root.
#[derive(Clone, Copy)]
pub(crate) struct LowPass;

impl PairKernel for LowPass {
    #[inline(always)]
    fn slope<S: Simd>(self, simd: S, r2: S::f32s) -> S::f32s {
        let s = above(simd, simd.splat_f32s(1.0), r2);
        simd.mul_f32s(polynomial(simd, &SLOPE, s), simd.mul_f32s(s, s))
    }

    #[inline(always)]
    fn add_value<S: Simd>(self, simd: S, r2: S::f32s, sum: S::f32s) -> S::f32s {
        let s = above(simd, simd.splat_f32s(1.0), r2);
        fma(simd, polynomial(simd, &VALUE, s), cube(simd, s), sum)
    }
}

/// Σ factors[k] s^k, in pairs (Estrin): a chain of four multiplications and not of seven, for which the pair loops would wait.
#[inline(always)]
fn polynomial<S: Simd>(simd: S, factors: &[f32; 7], s: S::f32s) -> S::f32s {
    let s2 = simd.mul_f32s(s, s);
    let s4 = simd.mul_f32s(s2, s2);
    let factor = |k: usize| simd.splat_f32s(factors[k]);
    let pair = |k: usize| fma(simd, factor(k + 1), s, factor(k));
    let (low, high) = (fma(simd, pair(2), s2, pair(0)), fma(simd, factor(6), s2, pair(4)));
    fma(simd, high, s4, low)
}
