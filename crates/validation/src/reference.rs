//! The known answers: formulas and published data, each with its source or derivation.

use std::f64::consts::PI;

/// Gravity in all cases, which is that of a scene which says nothing, m/s².
pub const GRAVITY: f64 = 9.81;

/// Volume of a ball, m³.
pub fn ball_volume(radius: f64) -> f64 {
    4.0 / 3.0 * PI * radius.powi(3)
}

/// Volume of the part of a ball below a level that is `depth` above its lowest point (m³): ∫π(2Rz − z²)dz.
pub fn cap_volume(radius: f64, depth: f64) -> f64 {
    let depth = depth.clamp(0.0, 2.0 * radius);
    PI * depth * depth * (3.0 * radius - depth) / 3.0
}

/// Cross-section of a jet, m².
pub fn disc_area(diameter: f64) -> f64 {
    0.25 * PI * diameter * diameter
}

/// Speed of a jet after a fall (m/s): Bernoulli at constant pressure.
pub fn falling_speed(speed: f64, drop: f64) -> f64 {
    (speed * speed + 2.0 * GRAVITY * drop).sqrt()
}

/// Angular frequency (rad/s) of a small wave of wave number `k` (1/m) over water of `depth`:
/// ω² = g k tanh kh, Lamb 1932, Hydrodynamics, 6th ed., §228.
pub fn wave_frequency(k: f64, depth: f64) -> f64 {
    (GRAVITY * k * (k * depth).tanh()).sqrt()
}

/// Drag coefficient of a sphere in an unbounded fluid: Schiller & Naumann 1933 (Z. Ver. Dtsch. Ing. 77, 318),
/// within 5 % of measurements for Re < 800 (Clift, Grace & Weber 1978, Bubbles, Drops, and Particles, table 5.1);
/// above Re 1000 the constant 0.44 of Newton's regime.
pub fn drag_coefficient(reynolds: f64) -> f64 {
    if reynolds > 1000.0 { 0.44 } else { 24.0 / reynolds * (1.0 + 0.15 * reynolds.powf(0.687)) }
}

/// A sphere that moves along a tube.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SphereInTube {
    /// Radius of the sphere, m.
    pub radius: f64,
    /// Diameter of the sphere over that of the tube; 0 for none.
    pub blockage: f64,
    /// Density of the fluid, kg/m³.
    pub density: f64,
    /// Its dynamic viscosity, Pa·s.
    pub viscosity: f64,
}

impl SphereInTube {
    /// Reynolds number of the diameter at `speed` (m/s).
    pub fn reynolds(&self, speed: f64) -> f64 {
        2.0 * self.radius * speed * self.density / self.viscosity
    }

    /// Drag in an unbounded fluid, N.
    pub fn free_drag(&self, speed: f64) -> f64 {
        if speed == 0.0 {
            return 0.0;
        }
        let area = PI * self.radius * self.radius;
        0.5 * self.density * area * speed * speed * drag_coefficient(self.reynolds(speed))
    }

    /// Share of its speed that a sphere with the same drag keeps in the tube, by its Reynolds number in an unbounded
    /// fluid: ((1 − λ)/(1 − 0.33 λ))^α with (3.3 − α)/(α − 0.85) = 0.1 Re. R. Di Felice 1996, A relationship for
    /// the wall effect on the settling velocity of a sphere at any flow regime, Int. J. Multiphase Flow 22(3),
    /// 527–533. At Re = 0 it is within 1 % of Faxén's series for λ ≤ 0.2 (tested here).
    pub fn slowing(&self, free_reynolds: f64) -> f64 {
        let alpha = (3.3 + 0.085 * free_reynolds) / (1.0 + 0.1 * free_reynolds);
        ((1.0 - self.blockage) / (1.0 - 0.33 * self.blockage)).powf(alpha)
    }

    /// Drag in the tube at `speed` (N): that in an unbounded fluid at the speed which the tube slows to this one.
    pub fn drag(&self, speed: f64) -> f64 {
        let slowed = |free: f64| free * self.slowing(self.reynolds(free));
        self.free_drag(rising_root(|free| slowed(free) - speed, speed, 100.0 * speed))
    }

    /// Speed (m/s) at which the drag in the tube is `force` (N).
    pub fn terminal_speed(&self, force: f64) -> f64 {
        let free = rising_root(|free| self.free_drag(free) - force, 0.0, 100.0);
        free * self.slowing(self.reynolds(free))
    }
}

/// Root of a function that rises from below 0 at `low` to above 0 at `high`, by bisection.
fn rising_root(f: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if f(middle) < 0.0 { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// Added mass over that in an unbounded fluid, of a ball in the middle of a cube of water of side `side` that is
/// shaken along x, faster than waves can follow: five rigid faces, and a free one above.
///
/// A ball of velocity U is a dipole, whose potential is −U R³ x/(2r³). A rigid face mirrors it, and turns its sign
/// over if x is normal to the face; a face at constant pressure mirrors it with the opposite sign. Repeated mirrors
/// fill the lattice of all (i, j, k) sides. The ball sits in the stream u that the images make, which changes its
/// force by the factor 1 − 3 u/U: ½ρV(a − a_u) − ρV a_u, Lamb 1932, §92 and §99. For one wall this gives his
/// 1 + 3/8 (R/h)³ and 1 + 3/16 (R/h)³. The images' own strength follows the ball's strength in that stream.
pub fn added_mass_factor(radius: f64, side: f64) -> f64 {
    const REACH: i32 = 24;
    let mut stream = 0.0;
    for i in -REACH..=REACH {
        for j in -REACH..=REACH {
            for k in -REACH..=REACH {
                if (i, j, k) != (0, 0, 0) {
                    let sign = alternating(i) * floor_and_surface(j);
                    let r2 = f64::from(i * i + j * j + k * k);
                    stream += sign * (3.0 * f64::from(i * i) - r2) / r2.powf(2.5);
                }
            }
        }
    }
    let share = 0.5 * stream * (radius / side).powi(3);
    1.0 - 3.0 * share / (1.0 + share)
}

/// Sign of the i-th image between two rigid faces normal to the motion.
fn alternating(i: i32) -> f64 {
    if i % 2 == 0 { 1.0 } else { -1.0 }
}

/// Sign of the j-th image between a rigid floor (j → −1 − j) and a free surface (j → 1 − j, opposite), which repeats
/// after four: 1, −1, −1, 1 from j = 0.
fn floor_and_surface(j: i32) -> f64 {
    if matches!(j.rem_euclid(4), 0 | 3) { 1.0 } else { -1.0 }
}

/// Speed over that of the wall which slides, in the steady flow between two plates, at height y of the gap h: y/h.
pub fn couette(share: f64) -> f64 {
    share
}

/// Speed over the mean one, in the steady flow that a force drives between two plates at rest, at height y of the
/// gap h: 6 y/h (1 − y/h). The mean speed is f h²/(12 μ) for a force f (N/m³): μ u″ = −f.
pub fn poiseuille(share: f64) -> f64 {
    6.0 * share * (1.0 - share)
}

/// Torque for a metre of length (N) on each of two cylinders of radii `inner` and `outer`, the inner one at `omega`
/// (rad/s): 4πμ Ω R₁²R₂²/(R₂² − R₁²), Landau & Lifshitz 1987, Fluid Mechanics, 2nd ed., §18, below the onset of
/// Taylor's vortices (doi:10.1098/rsta.1923.0008).
pub fn taylor_couette_torque(inner: f64, outer: f64, omega: f64, viscosity: f64) -> f64 {
    let (a, b) = (inner * inner, outer * outer);
    4.0 * PI * viscosity * omega * a * b / (b - a)
}

/// Rate (1/s) at which the speeds of a Taylor–Green vortex of wavelength `length` (m) in x and y decay:
/// ν (kx² + ky²) = 8 π² ν/L²; an exact solution of Navier and Stokes' equation (Taylor & Green 1937,
/// doi:10.1098/rspa.1937.0036).
pub fn taylor_green_rate(length: f64, kinematic_viscosity: f64) -> f64 {
    8.0 * PI * PI * kinematic_viscosity / (length * length)
}

/// First zero of the Bessel function J₁, Abramowitz & Stegun 1964, table 9.5.
const BESSEL_ZERO: f64 = 3.831_705_97;

/// Rate (1/s) of the slowest swirl in a cylinder of `radius` (m) at rest: ν (j₁₁/R)², from ∂u/∂t = ν (u″ + u′/r − u/r²)
/// with u = J₁(j₁₁ r/R) e^(−st).
pub fn swirl_decay_rate(radius: f64, kinematic_viscosity: f64) -> f64 {
    kinematic_viscosity * (BESSEL_ZERO / radius).powi(2)
}

/// Front of a collapsing square column of side a: time in √(a/g) and place in a from its back. Martin & Moyce 1952
/// (doi:10.1098/rsta.1952.0006), n² = 1, as TrixiParticles.jl took it from their figure
/// (validation/dam_break_2d/exp_surge_front.csv).
pub const COLUMN_FRONT: [[f64; 2]; 10] = [
    [0.43, 1.11],
    [0.62, 1.22],
    [0.80, 1.44],
    [0.97, 1.67],
    [1.14, 1.89],
    [1.29, 2.11],
    [1.45, 2.33],
    [1.62, 2.56],
    [1.76, 2.78],
    [1.93, 3.00],
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gravity_is_the_scenes_own() {
        assert_eq!(hapflow_fluid::FluidSettings::default().gravity.to_array(), [0.0, -GRAVITY, 0.0]);
    }

    #[test]
    fn a_cap_grows_to_the_ball() {
        assert!((cap_volume(0.3, 0.6) - ball_volume(0.3)).abs() < 1e-12);
        assert!((cap_volume(0.3, 0.3) - 0.5 * ball_volume(0.3)).abs() < 1e-12);
        assert_eq!(cap_volume(0.3, -1.0), 0.0);
    }

    #[test]
    fn drag_joins_stokes_and_newton() {
        let ball = SphereInTube { radius: 0.01, blockage: 0.0, density: 1000.0, viscosity: 1.0 };
        let stokes = 6.0 * PI * 0.01 * 1e-6;
        assert!((ball.drag(1e-6) / stokes - 1.0).abs() < 1e-2);
        assert!((drag_coefficient(1000.0) - 0.44).abs() < 0.01);
        assert!((drag_coefficient(100.0) - 1.09).abs() < 0.01);
    }

    /// Faxén's series, Happel & Brenner 1983, Low Reynolds Number Hydrodynamics, eq. 7-3.34
    /// (doi:10.1007/978-94-009-8352-6).
    #[test]
    fn the_tube_slows_a_creeping_sphere_as_faxen_says() {
        for blockage in [0.05, 0.1, 0.2] {
            let ball = SphereInTube { radius: 0.01, blockage, density: 1000.0, viscosity: 1.0 };
            let l: f64 = blockage;
            let faxen = 1.0 / (1.0 - 2.104 * l + 2.09 * l.powi(3) - 0.95 * l.powi(5));
            let factor = ball.drag(1e-7) / ball.free_drag(1e-7);
            assert!((factor / faxen - 1.0).abs() < 0.02, "{blockage}: {factor} against {faxen}");
            // And hardly when inertia rules: between Munroe's 1/(1 − λ^1.5) and no effect on the speed.
            let slow = ball.slowing(1e6);
            assert!(slow < 1.0 && slow > 1.0 - l, "{blockage}: {slow}");
        }
    }

    #[test]
    fn terminal_speed_and_drag_are_inverse() {
        let ball = SphereInTube { radius: 0.01, blockage: 0.2, density: 900.0, viscosity: 0.1 };
        for speed in [1e-3, 0.05, 0.5] {
            assert!((ball.terminal_speed(ball.drag(speed)) / speed - 1.0).abs() < 1e-6);
        }
    }

    #[test]
    fn images_add_up_to_lamb_s_walls() {
        // Six terms of the nearest faces: two across, three rigid along, one free along; and the rest are less.
        let (r, side) = (0.02_f64, 0.4);
        let near = (r / (0.5 * side)).powi(3);
        let first = 1.0 + near * (2.0 * 3.0 / 8.0 + (3.0 - 1.0) * 3.0 / 16.0);
        let all = added_mass_factor(r, side);
        assert!((all - 1.0) / (first - 1.0) > 0.6 && (all - 1.0) / (first - 1.0) < 1.4, "{all} {first}");
        assert!((added_mass_factor(1e-3, 0.4) - 1.0).abs() < 1e-5);
        let signs: Vec<f64> = (-3..5).map(floor_and_surface).collect();
        for j in -3..4 {
            let at = |j: i32| signs[(j + 3) as usize];
            if (-3..=4).contains(&(-1 - j)) && (-1 - j) < 5 {
                assert_eq!(at(-1 - j), at(j), "floor mirrors {j}");
            }
            if (1 - j) < 5 {
                assert_eq!(at(1 - j), -at(j), "surface mirrors {j}");
            }
        }
    }

    #[test]
    fn profiles_have_their_means_and_walls() {
        let mean = (0..1000).map(|k| poiseuille((f64::from(k) + 0.5) / 1000.0)).sum::<f64>() / 1000.0;
        assert!((mean - 1.0).abs() < 1e-5 && poiseuille(0.0) == 0.0 && poiseuille(1.0) == 0.0);
        assert_eq!([couette(0.0), couette(1.0)], [0.0, 1.0]);
        // A narrow gap is a plane one: torque = 2πR² μ ΩR/h.
        let (r, h) = (1.0, 1e-4);
        let narrow = 2.0 * PI * r * r * 0.5 * 3.0 * r / h;
        assert!((taylor_couette_torque(r, r + h, 3.0, 0.5) / narrow - 1.0).abs() < 1e-3);
    }
}
