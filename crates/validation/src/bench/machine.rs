//! What this machine can do at most: fused multiply-adds, and bytes from memory.

use pulp::{Arch, Simd, WithSimd};
use serde_json::json;
use std::hint::black_box;
use std::time::Instant;

/// Accumulators side by side, as many as hide the latency.
const CHAINS: usize = 10;
/// Multiply-adds of each in one go.
const ROUNDS: usize = 2_000_000;
/// Numbers of each of the three arrays that are streamed: far more than any cache holds.
const STREAM: usize = 12_000_000;
/// Goes, of which the fastest counts.
const GOES: usize = 5;

/// Bounds on so many threads.
#[derive(Clone, Copy, Debug)]
pub struct Machine {
    /// Threads.
    pub threads: usize,
    /// Single-precision operations a second, by the lanes that the fluid uses; a multiply-add is two.
    pub flop_per_s: f64,
    /// Bytes read and written a second, a = b + s c.
    pub bytes_per_s: f64,
}

impl Machine {
    /// One line of JSON.
    pub fn json(&self) -> serde_json::Value {
        json!({ "threads": self.threads, "flop_per_s": self.flop_per_s, "bytes_per_s": self.bytes_per_s })
    }
}

/// Measures the bounds on `threads` threads.
pub(super) fn machine(threads: usize) -> Machine {
    let fastest = |work: &(dyn Fn() -> f64 + Sync)| {
        let go = || {
            let rates: Vec<f64> = std::thread::scope(|scope| {
                let all: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
                all.into_iter().map(|t| t.join().unwrap_or(0.0)).collect()
            });
            rates.iter().sum::<f64>()
        };
        (0..GOES).map(|_| go()).fold(0.0, f64::max)
    };
    Machine { threads, flop_per_s: fastest(&|| arch().dispatch(Fma)), bytes_per_s: fastest(&stream) }
}

/// The lanes that the fluid takes.
fn arch() -> Arch {
    #[cfg(target_arch = "x86_64")]
    return pulp::x86::V3::try_new().map_or(Arch::Scalar, Arch::V3);
    #[cfg(not(target_arch = "x86_64"))]
    return Arch::new();
}

/// Multiply-adds in registers; gives operations a second.
struct Fma;

impl WithSimd for Fma {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> f64 {
        let (factor, term) = (simd.splat_f32s(black_box(0.999)), simd.splat_f32s(black_box(0.001)));
        let mut sums = [simd.splat_f32s(0.5); CHAINS];
        let begun = Instant::now();
        for _ in 0..ROUNDS {
            for sum in &mut sums {
                *sum = simd.mul_add_e_f32s(*sum, factor, term);
            }
        }
        let seconds = begun.elapsed().as_secs_f64();
        black_box(sums.map(|sum| simd.reduce_sum_f32s(sum)));
        (2 * CHAINS * ROUNDS * S::F32_LANES) as f64 / seconds
    }
}

/// a = b + s c over large arrays; gives bytes a second.
fn stream() -> f64 {
    let (mut a, b, c) = (vec![0.0_f32; STREAM], vec![1.0_f32; STREAM], vec![2.0_f32; STREAM]);
    let factor = black_box(0.5);
    let begun = Instant::now();
    for ((a, b), c) in a.iter_mut().zip(&b).zip(&c) {
        *a = b + factor * c;
    }
    let seconds = begun.elapsed().as_secs_f64();
    black_box(&a);
    (12 * STREAM) as f64 / seconds
}
