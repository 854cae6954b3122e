//! Vector loops over ranges of columns, one body for every lane width (pulp picks it at run time).

use pulp::Simd;

/// 16 ones, then 16 zeros: a window of it marks the live lanes of a partly filled vector.
static LIVE: [f32; 32] = {
    let mut live = [0.0; 32];
    let mut k = 0;
    while k < 16 {
        live[k] = 1.0;
        k += 1;
    }
    live
};

/// Runs the block for each vector of `range` over the columns, with one name a column for its lanes; `live` is
/// 1 in lanes that belong to the range and 0 in those behind its end. Columns are padded, so whole vectors may
/// be read. A macro and no function, because a plain closure is not inlined into the code for the processor at hand
/// and the lanes then go through memory: sixty times slower, measured.
macro_rules! for_lanes {
    ($S:ident, $simd:expr, $range:expr, [$($name:ident: $column:expr),*], $live:ident, $body:block) => {{
        let range = $range;
        let lanes = $S::F32_LANES;
        let (whole, rest) = (range.len() / lanes, range.len() % lanes);
        let vectors = whole + usize::from(rest > 0);
        let end = range.start + vectors * lanes;
        $( let $name = &$S::as_simd_f32s(&$column[range.start..end]).0[..vectors]; )*
        let ones = $simd.splat_f32s(1.0);
        for k in 0..vectors {
            let $live = if k < whole { ones } else { $crate::lanes::live($simd, rest) };
            $( let $name = $name[k]; )*
            $body
        }
    }};
}
pub(crate) use for_lanes;

/// Ones in the first `count` lanes, zeros behind.
#[inline(always)]
pub(crate) fn live<S: Simd>(_: S, count: usize) -> S::f32s {
    S::as_simd_f32s(&LIVE[16 - count..16 - count + S::F32_LANES]).0[0]
}

/// a·b + c.
#[inline(always)]
pub(crate) fn fma<S: Simd>(simd: S, a: S::f32s, b: S::f32s, c: S::f32s) -> S::f32s {
    simd.mul_add_e_f32s(a, b, c)
}

/// Dot product of two lane vectors.
#[inline(always)]
pub(crate) fn dot<S: Simd>(simd: S, a: [S::f32s; 3], b: [S::f32s; 3]) -> S::f32s {
    fma(simd, a[0], b[0], fma(simd, a[1], b[1], simd.mul_f32s(a[2], b[2])))
}

/// b − a, by component.
#[inline(always)]
pub(crate) fn difference<S: Simd>(simd: S, a: [S::f32s; 3], b: [S::f32s; 3]) -> [S::f32s; 3] {
    [simd.sub_f32s(b[0], a[0]), simd.sub_f32s(b[1], a[1]), simd.sub_f32s(b[2], a[2])]
}

/// sum += scale · v, by component.
#[inline(always)]
pub(crate) fn add_scaled<S: Simd>(simd: S, sum: &mut [S::f32s; 3], scale: S::f32s, v: [S::f32s; 3]) {
    for axis in 0..3 {
        sum[axis] = fma(simd, scale, v[axis], sum[axis]);
    }
}

/// The same value in all lanes, by component.
#[inline(always)]
pub(crate) fn splat3<S: Simd>(simd: S, v: [f32; 3]) -> [S::f32s; 3] {
    [simd.splat_f32s(v[0]), simd.splat_f32s(v[1]), simd.splat_f32s(v[2])]
}

/// Sum over lanes, by component.
#[inline(always)]
pub(crate) fn sum3<S: Simd>(simd: S, v: [S::f32s; 3]) -> [f32; 3] {
    [simd.reduce_sum_f32s(v[0]), simd.reduce_sum_f32s(v[1]), simd.reduce_sum_f32s(v[2])]
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::ops::Range;

    struct Sum<'a>(&'a [f32], Range<usize>);
    impl pulp::WithSimd for Sum<'_> {
        type Output = f32;
        fn with_simd<S: Simd>(self, simd: S) -> f32 {
            let mut sum = simd.splat_f32s(0.0);
            for_lanes!(S, simd, self.1.clone(), [a: self.0], live, {
                sum = fma(simd, a, live, sum);
            });
            simd.reduce_sum_f32s(sum)
        }
    }

    #[test]
    fn ranges_of_every_length_and_start_are_summed_exactly() {
        let column: Vec<f32> = (0..120).map(|k| k as f32).collect();
        for start in 0..30 {
            for end in start..start + 70 {
                let expected: f32 = column[start..end].iter().sum();
                assert_eq!(pulp::Arch::new().dispatch(Sum(&column, start..end)), expected);
                assert_eq!(pulp::Arch::Scalar.dispatch(Sum(&column, start..end)), expected);
            }
        }
    }
}
