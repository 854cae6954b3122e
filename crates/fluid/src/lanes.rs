//! Vectors in lanes, of any width (pulp picks it at run time). Functions and no closures: a closure is not inlined into
//! the code for the processor at hand, and the lanes then go through memory (sixty times slower, measured).

use pulp::Simd;

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
