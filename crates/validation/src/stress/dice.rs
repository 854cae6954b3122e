//! Random numbers that a seed repeats.

use glam::DVec3;

/// A sequence of random numbers (SplitMix64: Steele, Lea & Flood 2014, doi:10.1145/2714064.2660195).
#[derive(Clone, Debug)]
pub(super) struct Dice(u64);

impl Dice {
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// Another sequence for what is called `name`: whatever else there is, it draws the same.
    pub fn of(&self, name: &str) -> Self {
        // Fowler, Noll & Vo's hash, FNV-1a.
        let hash = name.bytes().fold(self.0 ^ 0xCBF2_9CE4_8422_2325, |h, b| {
            (h ^ u64::from(b)).wrapping_mul(0x0000_0100_0000_01B3)
        });
        Self(hash)
    }

    /// One of `list` by its name, so that one more in the list changes few choices.
    pub fn pick_named<'a, T>(&mut self, list: &'a [T], name: impl Fn(&T) -> &str) -> Option<&'a T> {
        self.next();
        list.iter().min_by_key(|t| self.of(name(t)).next())
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// A number from 0 to below 1.
    pub fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// True in `share` (0..1) of all throws.
    pub fn chance(&mut self, share: f64) -> bool {
        self.unit() < share
    }

    /// A number between two others.
    pub fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// A number between two others above 0, each power of ten as often as any.
    pub fn scale(&mut self, low: f64, high: f64) -> f64 {
        (low * (high / low).powf(self.unit())).clamp(low, high)
    }

    /// A whole number from `low` to `high`.
    pub fn whole(&mut self, low: usize, high: usize) -> usize {
        low + (self.unit() * (high - low + 1) as f64) as usize
    }

    /// One of `list`, if there is any.
    pub fn pick<'a, T>(&mut self, list: &'a [T]) -> Option<&'a T> {
        list.get((self.unit() * list.len() as f64) as usize)
    }

    /// A place in a box.
    pub fn place(&mut self, low: DVec3, high: DVec3) -> DVec3 {
        low + (high - low) * DVec3::new(self.unit(), self.unit(), self.unit())
    }

    /// A direction, each as often as any.
    pub fn direction(&mut self) -> DVec3 {
        let (y, turn) = (self.within(-1.0, 1.0), self.within(0.0, std::f64::consts::TAU));
        let level = (1.0 - y * y).sqrt();
        DVec3::new(level * turn.cos(), y, level * turn.sin())
    }
}
