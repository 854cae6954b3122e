//! The vector units that loops are compiled for, chosen at run time, and what the loops need of them beyond arithmetic:
//! records turned into lanes, and the lanes that matter packed together.

use pulp::Simd;

/// What a loop reads of a particle in one piece.
pub(crate) type Record = [f32; 8];

/// Lanes of the widest unit: lists are padded to a multiple of them.
pub(crate) const WIDEST: usize = 8;

/// A vector unit of up to [`WIDEST`] lanes.
pub(crate) trait Unit: Simd {
    /// The first `N` numbers of the records `of` whom there are, one record a lane.
    #[inline(always)]
    fn columns<const N: usize>(self, records: &[Record], of: &[u32]) -> [Self::f32s; N] {
        let mut columns = [[0.0; WIDEST]; N];
        for (lane, &of) in of.iter().enumerate().take(Self::F32_LANES) {
            for (column, value) in columns.iter_mut().zip(&records[of as usize]) {
                column[lane] = *value;
            }
        }
        let mut lanes = [self.splat_f32s(0.0); N];
        for (lanes, column) in lanes.iter_mut().zip(&columns) {
            *lanes = Self::as_simd_f32s(column).0[0];
        }
        lanes
    }

    /// Which lanes are at most `limit`, the first in the lowest bit.
    #[inline(always)]
    fn at_most(self, lanes: Self::f32s, limit: f32) -> usize {
        let mut values = [f32::INFINITY; WIDEST];
        Self::as_mut_simd_f32s(&mut values).0[0] = lanes;
        let bits = values.iter().take(Self::F32_LANES).enumerate();
        bits.map(|(lane, &value)| usize::from(value <= limit) << lane).sum()
    }

    /// Writes the lanes in `mask` to the start of `out`; what stands after them, up to [`WIDEST`], is lost.
    #[inline(always)]
    fn pack(self, lanes: Self::u32s, mask: usize, out: &mut [u32; WIDEST]) {
        let mut values = [0; WIDEST];
        Self::as_mut_simd_u32s(&mut values).0[0] = lanes;
        let mut end = 0;
        for (lane, &value) in values.iter().enumerate().take(Self::F32_LANES) {
            out[end] = value;
            end = (end + (mask >> lane & 1)).min(WIDEST - 1);
        }
    }
}

impl Unit for pulp::Scalar {}

#[cfg(target_arch = "aarch64")]
impl Unit for pulp::aarch64::Neon {}

#[cfg(target_arch = "x86_64")]
mod x86 {
    use super::{Record, Unit, WIDEST};
    use pulp::x86::V3;
    use pulp::{cast, f32x4, f32x8, u32x8};
    use std::arch::x86_64::{__m256, __m256i};

    /// The places of the set bits of each mask, lowest first.
    const PLACES: [[u32; WIDEST]; 1 << WIDEST] = places();

    const fn places() -> [[u32; WIDEST]; 1 << WIDEST] {
        let mut all = [[0; WIDEST]; 1 << WIDEST];
        let mut mask = 0;
        while mask < all.len() {
            let (mut lane, mut end) = (0, 0);
            while lane < WIDEST {
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

    /// Four numbers from `at` on of eight records, transposed: whole records are loaded and nothing is gathered.
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
        fn columns<const N: usize>(self, records: &[Record], of: &[u32]) -> [f32x8; N] {
            let mut lanes = [self.splat_f32x8(0.0); N];
            if let Some(of) = of.first_chunk::<8>() {
                let records = of.map(|of| &records[of as usize]);
                let quarters = [quarter(self, records, 0), quarter(self, records, 4)];
                for (lanes, column) in lanes.iter_mut().zip(quarters.as_flattened()) {
                    *lanes = *column;
                }
            }
            lanes
        }

        #[inline(always)]
        fn at_most(self, lanes: f32x8, limit: f32) -> usize {
            const LESS_OR_EQUAL: i32 = 2;
            let limit = cast(self.splat_f32x8(limit));
            let within = self.avx._mm256_cmp_ps::<LESS_OR_EQUAL>(cast(lanes), limit);
            self.avx._mm256_movemask_ps(within) as usize
        }

        #[inline(always)]
        fn pack(self, lanes: u32x8, mask: usize, out: &mut [u32; WIDEST]) {
            let places: __m256i = cast(PLACES[mask % PLACES.len()]);
            let packed = self.avx2._mm256_permutevar8x32_epi32(cast(lanes), places);
            *out = cast(packed);
        }
    }
}

/// A loop that is compiled for each unit.
pub(crate) trait Work {
    fn run<U: Unit>(self, unit: U);
}

/// The unit in use.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Arch {
    Scalar,
    #[cfg(target_arch = "x86_64")]
    V3(pulp::x86::V3),
    #[cfg(target_arch = "aarch64")]
    Neon(pulp::aarch64::Neon),
}

impl Arch {
    /// The widest unit of this processor that has no more lanes than [`WIDEST`].
    pub fn best() -> Self {
        #[cfg(target_arch = "x86_64")]
        return pulp::x86::V3::try_new().map_or(Self::Scalar, Self::V3);
        #[cfg(target_arch = "aarch64")]
        return pulp::aarch64::Neon::try_new().map_or(Self::Scalar, Self::Neon);
        #[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
        return Self::Scalar;
    }

    /// Runs `work` on it.
    pub fn run(self, work: impl Work) {
        match self {
            Self::Scalar => work.run(pulp::Scalar::new()),
            #[cfg(target_arch = "x86_64")]
            Self::V3(unit) => unit.vectorize(On(unit, work)),
            #[cfg(target_arch = "aarch64")]
            Self::Neon(unit) => pulp::Simd::vectorize(unit, On(unit, work)),
        }
    }
}

/// Work on a unit; a type and no closure, so that it is inlined into the code for the unit.
struct On<U, W>(U, W);

impl<U: Unit, W: Work> pulp::NullaryFnOnce for On<U, W> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        self.1.run(self.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Checks what a unit does beyond arithmetic.
    struct Check;

    impl Work for Check {
        #[inline(always)]
        fn run<U: Unit>(self, unit: U) {
            let records: Vec<Record> = (0..9).map(|k| std::array::from_fn(|n| (10 * k + n) as f32)).collect();
            let of = [8, 0, 3, 3, 1, 7, 5, 2];
            let columns: [U::f32s; 7] = unit.columns(&records, &of);
            for (n, column) in columns.into_iter().enumerate() {
                let mut values = [0.0; WIDEST];
                U::as_mut_simd_f32s(&mut values).0[0] = column;
                for lane in 0..U::F32_LANES {
                    assert_eq!(values[lane], (10 * of[lane] as usize + n) as f32);
                }
            }
            let mask = unit.at_most(columns[0], 30.0);
            let expected: Vec<u32> = of[..U::F32_LANES].iter().copied().filter(|&k| k <= 3).collect();
            let mut out = [99; WIDEST];
            unit.pack(U::as_simd_u32s(&of).0[0], mask, &mut out);
            assert_eq!((mask.count_ones() as usize, &out[..expected.len()]), (expected.len(), &expected[..]));
        }
    }

    #[test]
    fn every_unit_turns_and_packs_alike() {
        Arch::Scalar.run(Check);
        Arch::best().run(Check);
    }
}
