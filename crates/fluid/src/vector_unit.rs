//! The vector units that loops are compiled for, chosen at run time, and what the loops need of them beyond arithmetic:
//! records turned into lanes, and the lanes that matter packed together.

use pulp::Simd;

/// What a loop reads of a particle in one piece.
pub(crate) type Record = [f32; 8];

/// A record where it is read from: within one line of the cache, and never in two.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(32))]
pub(crate) struct Stored(pub Record);

/// Lanes of the widest unit.
pub(crate) const WIDEST: usize = 16;

/// A vector unit of up to [`WIDEST`] lanes.
pub(crate) trait Unit: Simd {
    /// The first `N` numbers of the records `of` whom there are, one record a lane.
    #[inline(always)]
    fn columns<const N: usize>(self, records: &[Stored], of: &[u32]) -> [Self::f32s; N] {
        let mut columns = [[0.0; WIDEST]; N];
        for (lane, &of) in of.iter().enumerate().take(Self::F32_LANES) {
            for (column, value) in columns.iter_mut().zip(&records[of as usize].0) {
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
mod x86;

/// A loop that is compiled for each unit.
pub(crate) trait Work {
    fn run<U: Unit>(self, unit: U);
}

/// The unit in use.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Arch {
    Scalar,
    /// AVX2.
    #[cfg(target_arch = "x86_64")]
    V3(pulp::x86::V3),
    /// AVX-512: the pair loops wait for their own results more than for the unit, and twice the lanes wait no longer.
    #[cfg(target_arch = "x86_64")]
    V4(pulp::x86::V4),
    #[cfg(target_arch = "aarch64")]
    Neon(pulp::aarch64::Neon),
}

impl Arch {
    /// The widest unit of this processor.
    pub fn best() -> Self {
        Self::all().last().copied().unwrap_or(Self::Scalar)
    }

    /// The units of this processor, the widest last.
    pub fn all() -> Vec<Self> {
        let mut all = vec![Self::Scalar];
        #[cfg(target_arch = "x86_64")]
        all.extend(pulp::x86::V3::try_new().map(Self::V3));
        #[cfg(target_arch = "x86_64")]
        all.extend(pulp::x86::V4::try_new().map(Self::V4));
        #[cfg(target_arch = "aarch64")]
        all.extend(pulp::aarch64::Neon::try_new().map(Self::Neon));
        all
    }

    /// Runs `work` on it.
    pub fn run(self, work: impl Work) {
        match self {
            Self::Scalar => work.run(pulp::Scalar::new()),
            #[cfg(target_arch = "x86_64")]
            Self::V3(unit) => unit.vectorize(On(unit, work)),
            #[cfg(target_arch = "x86_64")]
            Self::V4(unit) => pulp::Simd::vectorize(unit, On(unit, work)),
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
            let record = |k: usize| Stored(std::array::from_fn(|n| (10 * k + n) as f32));
            let records: Vec<_> = (0..9).map(record).collect();
            let of = [8, 0, 3, 3, 1, 7, 5, 2, 6, 4, 0, 8, 8, 1, 2, 7];
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
        Arch::all().into_iter().for_each(|arch| arch.run(Check));
    }
}
