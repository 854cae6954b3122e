//! The units of x86-64: AVX2 and AVX-512. Whole records are loaded and turned, and nothing is gathered.

use super::{Record, Stored, Unit, WIDEST};
use pulp::x86::{V3, V4};
use pulp::{cast, f32x4, f32x8, f32x16, u32x8, u32x16};
use std::arch::x86_64::{__m256, __m256i, __m512, __m512d, __m512i};

const LESS_OR_EQUAL: i32 = 2;

/// The places of the set bits of each mask of eight, lowest first.
const PLACES: [[u32; 8]; 256] = places();

const fn places() -> [[u32; 8]; 256] {
    let mut all = [[0; 8]; 256];
    let mut mask = 0;
    while mask < all.len() {
        let (mut lane, mut end) = (0, 0);
        while lane < 8 {
            if mask >> lane & 1 == 1 {
                all[mask][end] = lane as u32;
                end += 1;
            }
            lane += 1;
        }
        mask += 1;
    }
    all
}

/// Four numbers from `at` on of eight records, transposed.
#[inline(always)]
fn quarter(unit: V3, records: [&Record; 8], at: usize) -> [f32x8; 4] {
    let avx = unit.avx;
    let half = |r: &Record| cast(f32x4(r[at], r[at + 1], r[at + 2], r[at + 3]));
    let pair = |k: usize| {
        let low = avx._mm256_castps128_ps256(half(records[k]));
        avx._mm256_insertf128_ps::<1>(low, half(records[k + 4]))
    };
    let rows = [pair(0), pair(1), pair(2), pair(3)];
    let low = [avx._mm256_unpacklo_ps(rows[0], rows[1]), avx._mm256_unpacklo_ps(rows[2], rows[3])];
    let high = [avx._mm256_unpackhi_ps(rows[0], rows[1]), avx._mm256_unpackhi_ps(rows[2], rows[3])];
    let columns: [__m256; 4] = [
        avx._mm256_shuffle_ps::<0x44>(low[0], low[1]),
        avx._mm256_shuffle_ps::<0xEE>(low[0], low[1]),
        avx._mm256_shuffle_ps::<0x44>(high[0], high[1]),
        avx._mm256_shuffle_ps::<0xEE>(high[0], high[1]),
    ];
    [cast(columns[0]), cast(columns[1]), cast(columns[2]), cast(columns[3])]
}

impl Unit for V3 {
    #[inline(always)]
    fn columns<const N: usize>(self, records: &[Stored], of: &[u32]) -> [f32x8; N] {
        let mut lanes = [self.splat_f32x8(0.0); N];
        if let Some(of) = of.first_chunk::<8>() {
            let records = of.map(|of| &records[of as usize].0);
            let quarters = [quarter(self, records, 0), quarter(self, records, 4)];
            for (lanes, column) in lanes.iter_mut().zip(quarters.as_flattened()) {
                *lanes = *column;
            }
        }
        lanes
    }

    #[inline(always)]
    fn at_most(self, lanes: f32x8, limit: f32) -> usize {
        let limit = cast(self.splat_f32x8(limit));
        let within = self.avx._mm256_cmp_ps::<LESS_OR_EQUAL>(cast(lanes), limit);
        self.avx._mm256_movemask_ps(within) as usize
    }

    #[inline(always)]
    fn pack(self, lanes: u32x8, mask: usize, out: &mut [u32; WIDEST]) {
        let places: __m256i = cast(PLACES[mask % PLACES.len()]);
        let packed = self.avx2._mm256_permutevar8x32_epi32(cast(lanes), places);
        out[..8].copy_from_slice(&cast::<_, [u32; 8]>(packed));
    }
}

/// Two records in one vector.
#[inline(always)]
fn both(unit: V4, one: &Record, other: &Record) -> __m512 {
    let low: __m512d = cast(unit.avx512f._mm512_castps256_ps512(cast(*one)));
    cast(unit.avx512f._mm512_insertf64x4::<1>(low, cast(*other)))
}

/// Eight of sixteen records, from `first` of whom there are on, turned in blocks of four by four: the n-th of what comes back
/// has, in turn, the n-th numbers and those four on of the first four records, and the same of the others.
#[inline(always)]
fn blocks(unit: V4, records: &[Stored], of: &[u32; 16], first: usize) -> [__m512; 4] {
    let avx = unit.avx512f;
    let mut rows = [unit.avx512f._mm512_setzero_ps(); 4];
    for (k, row) in rows.iter_mut().enumerate() {
        *row = both(unit, &records[of[first + k] as usize].0, &records[of[first + k + 4] as usize].0);
    }
    let low = [avx._mm512_unpacklo_ps(rows[0], rows[1]), avx._mm512_unpacklo_ps(rows[2], rows[3])];
    let high = [avx._mm512_unpackhi_ps(rows[0], rows[1]), avx._mm512_unpackhi_ps(rows[2], rows[3])];
    [
        avx._mm512_shuffle_ps::<0x44>(low[0], low[1]),
        avx._mm512_shuffle_ps::<0xEE>(low[0], low[1]),
        avx._mm512_shuffle_ps::<0x44>(high[0], high[1]),
        avx._mm512_shuffle_ps::<0xEE>(high[0], high[1]),
    ]
}

// No closures here: not even one to map an array is inlined into the code for this unit.
impl Unit for V4 {
    #[inline(always)]
    fn columns<const N: usize>(self, records: &[Stored], of: &[u32]) -> [f32x16; N] {
        let mut lanes = [self.splat_f32x16(0.0); N];
        if let Some(of) = of.first_chunk::<16>() {
            let (first, second) = (blocks(self, records, of, 0), blocks(self, records, of, 8));
            for n in 0..N.min(4) {
                lanes[n] = cast(self.avx512f._mm512_shuffle_f32x4::<0x88>(first[n], second[n]));
            }
            for n in 4..N {
                lanes[n] = cast(self.avx512f._mm512_shuffle_f32x4::<0xDD>(first[n - 4], second[n - 4]));
            }
        }
        lanes
    }

    #[inline(always)]
    fn at_most(self, lanes: f32x16, limit: f32) -> usize {
        let limit = cast(self.splat_f32x16(limit));
        self.avx512f._mm512_cmp_ps_mask::<LESS_OR_EQUAL>(cast(lanes), limit) as usize
    }

    #[inline(always)]
    fn pack(self, lanes: u32x16, mask: usize, out: &mut [u32; WIDEST]) {
        let packed: __m512i = self.avx512f._mm512_maskz_compress_epi32(mask as u16, cast(lanes));
        *out = cast(packed);
    }
}
