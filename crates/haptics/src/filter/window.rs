//! Window functions, in their symmetric forms.
//!
//! Sources: F. J. Harris, "On the use of windows for harmonic analysis with the discrete Fourier transform",
//! Proc. IEEE 66 (1978), doi:10.1109/PROC.1978.10837 (Hann, Hamming, Blackman); Y. H. Ha and J. A. Pearce,
//! "A new window and comparison to standard windows", IEEE Trans. ASSP 37 (1989) (Bartlett-Hann).

use std::f64::consts::TAU;

/// Shape of a window.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum WindowKind {
    /// w = 0.62 − 0.48 |x − 0.5| + 0.38 cos 2π(x − 0.5): the baseline, with 11 taps.
    BartlettHann,
    /// w = 0.5 − 0.5 cos 2πx.
    Hann,
    /// w = 0.54 − 0.46 cos 2πx: lower near side lobes, ends that are not zero.
    Hamming,
    /// w = 0.42 − 0.5 cos 2πx + 0.08 cos 4πx: lowest side lobes, widest main lobe.
    Blackman,
    /// w = 1, a moving mean: of exactly one frame it cancels every multiple of the frame rate.
    Boxcar,
}

impl WindowKind {
    /// Every window, in the order in which they are listed to people.
    pub const ALL: [Self; 5] = [Self::BartlettHann, Self::Hann, Self::Hamming, Self::Blackman, Self::Boxcar];

    /// Its name in a filter's description.
    pub const fn name(self) -> &'static str {
        match self {
            Self::BartlettHann => "bartlett-hann",
            Self::Hann => "hann",
            Self::Hamming => "hamming",
            Self::Blackman => "blackman",
            Self::Boxcar => "boxcar",
        }
    }

    /// The window called `name`.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == name)
    }

    /// Weight at `x`, 0 at the first tap and 1 at the last; never negative.
    fn at(self, x: f64) -> f64 {
        let weight = match self {
            Self::BartlettHann => 0.62 - 0.48 * (x - 0.5).abs() + 0.38 * (TAU * (x - 0.5)).cos(),
            Self::Hann => 0.5 - 0.5 * (TAU * x).cos(),
            Self::Hamming => 0.54 - 0.46 * (TAU * x).cos(),
            Self::Blackman => 0.42 - 0.5 * (TAU * x).cos() + 0.08 * (2.0 * TAU * x).cos(),
            Self::Boxcar => 1.0,
        };
        // The ends of Bartlett-Hann, Hann and Blackman are zero: rounding must not make them ±1e-17.
        if weight < 1e-12 { 0.0 } else { weight }
    }

    /// The weights of `taps` taps with a largest value of about 1, not normalised. One tap has weight 1; none
    /// gives an empty list. Allocates.
    pub fn weights(self, taps: usize) -> Vec<f64> {
        match taps {
            0 => Vec::new(),
            1 => vec![1.0],
            // Mirrored by hand, so that the window is symmetric to the last bit.
            _ => (0..taps).map(|n| self.at(n.min(taps - 1 - n) as f64 / (taps - 1) as f64)).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn assert_close(found: &[f64], expected: &[f64]) {
        assert_eq!(found.len(), expected.len());
        for (a, b) in found.iter().zip(expected) {
            assert!((a - b).abs() < 1e-5, "{found:?} is not {expected:?}");
        }
    }

    #[test]
    fn bartlett_hann_of_11_taps_is_that_of_the_thesis() {
        let half = [0.0, 0.12057, 0.35857, 0.64143, 0.87943, 1.0];
        let expected: Vec<f64> = half.iter().chain(half[..5].iter().rev()).copied().collect();
        assert_close(&WindowKind::BartlettHann.weights(11), &expected);
    }

    #[test]
    fn the_others_of_5_taps_are_the_textbook_ones() {
        assert_close(&WindowKind::Hann.weights(5), &[0.0, 0.5, 1.0, 0.5, 0.0]);
        assert_close(&WindowKind::Hamming.weights(5), &[0.08, 0.54, 1.0, 0.54, 0.08]);
        assert_close(&WindowKind::Blackman.weights(5), &[0.0, 0.34, 1.0, 0.34, 0.0]);
        assert_close(&WindowKind::Boxcar.weights(5), &[1.0; 5]);
    }

    #[test]
    fn one_tap_is_identity_and_none_is_empty() {
        for kind in WindowKind::ALL {
            assert_eq!(kind.weights(1), [1.0]);
            assert!(kind.weights(0).is_empty());
        }
    }

    #[test]
    fn every_window_is_symmetric_and_never_negative() {
        for kind in WindowKind::ALL {
            for taps in [2, 3, 10, 11, 64, 4096] {
                let weights = kind.weights(taps);
                assert!(weights.iter().all(|w| *w >= 0.0));
                assert!(weights.iter().eq(weights.iter().rev()), "{} of {taps}", kind.name());
            }
        }
    }

    #[test]
    fn names_are_found_again() {
        for kind in WindowKind::ALL {
            assert_eq!(WindowKind::from_name(kind.name()), Some(kind));
        }
        assert_eq!(WindowKind::from_name("kaiser"), None);
    }
}
