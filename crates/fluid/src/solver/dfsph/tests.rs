//! The sums against the scalar twin, that they are each other's transpose, and the descent on a problem by hand.

use super::descent::{Descent, violation};
use super::site::{Crowd, Look, Site, Survey};
use super::solve::{Opening, Push, Walls};
use super::{Dfsph, level_surface, stiffest_wave};
use crate::particles::Particles;
use crate::solver::tests::{assert_rows, config, each_pass, twins, vector};
use crate::solver::{Pass, Rows, Scratch, sweep};
use crate::twin::WcsphTwin;
use crate::{FluidConfig, Kernel, Solver};
use glam::DVec3;
use std::cell::RefCell;

/// Without friction, so that the pressure alone pushes.
fn inviscid() -> FluidConfig {
    let mut config = config(Solver::Dfsph);
    (config.settings.viscosity, config.settings.artificial_viscosity) = (0.0, 0.0);
    config
}

fn pushes(solver: &Dfsph, pass: Pass<'_>, sites: &[Site]) -> Rows {
    let mut rows = Rows::new();
    sweep(pass, Push { solver, sites }, &mut rows, &mut Scratch::default(), &mut []);
    rows
}

fn openings(solver: &Dfsph, pass: Pass<'_>, sites: &[Site]) -> Vec<f32> {
    let (mut openings, opening) = (Vec::new(), Opening { solver, sites, walls: Walls::Mirrors });
    sweep(pass, opening, &mut openings, &mut Scratch::default(), &mut []);
    openings
}

/// Pressures in `aux` and velocities in `lx`, `ly`, `lz`, as the solves have them.
fn stand_by(p: &mut Particles) {
    p.aux = p.p.clone();
    (p.lx, p.ly, p.lz) = (p.u.clone(), p.v.clone(), p.w.clone());
}

#[test]
fn sums_equal_the_twin() {
    let config = inviscid();
    let s = &config.settings;
    let (dx, h) = (s.spacing, s.support_length());
    let volume = dx.powi(3) / Kernel::Wendland.lattice_moment(dx, h);
    let twin =
        WcsphTwin { kernel: Kernel::Wendland, h, volume, viscosity: 0.0, filter: 0.0, gravity: s.gravity };
    let solver = Dfsph::new(&config);
    each_pass(&config, |particles, with_pass| {
        stand_by(particles);
        let all = twins(particles, |_| 1000.0);
        with_pass(particles, &|pass| {
            let sites = vec![Site::default(); all.len()];
            let still = vec![DVec3::ZERO; all.len()];
            let expected: Vec<_> = (0..all.len()).map(|i| twin.acceleration(&all, &still, i)).collect();
            assert_rows(pushes(&solver, pass, &sites).iter().map(vector), expected.into_iter());
            let along = |x: f64| DVec3::X * x;
            let expected: Vec<_> = (0..all.len()).map(|i| along(twin.divergence(&all, i))).collect();
            let got = openings(&solver, pass, &sites);
            assert_rows(got.iter().map(|&o| along(o.into())), expected.into_iter());
        });
    });
}

/// Σ P D(v) = Σ v·a(P), before walls too: the pressure does as much work as it takes.
#[test]
fn pressure_and_divergence_are_each_other_s_transpose() {
    for ground in [None, Some(0.0), Some(0.001)] {
        let mut config = inviscid();
        config.world.ground = ground;
        let solver = Dfsph::new(&config);
        each_pass(&config, |particles, with_pass| {
            stand_by(particles);
            let sites = RefCell::new(Vec::new());
            // Nothing bears on the walls: what the fluid hides of a slope there is no transpose but nearly.
            particles.aux.fill(0.0);
            with_pass(particles, &|pass| {
                let (mut crowds, mut scratch) = (Vec::<Crowd>::new(), Scratch::default());
                sweep(pass, Look(&solver), &mut crowds, &mut scratch, &mut []);
                let survey = Survey { solver: &solver, crowds: &crowds, dt: 1e-3, filter: 0.0 };
                sweep(pass, survey, &mut *sites.borrow_mut(), &mut scratch, &mut []);
            });
            stand_by(particles);
            with_pass(particles, &|pass| {
                let (a, d) =
                    (pushes(&solver, pass, &sites.borrow()), openings(&solver, pass, &sites.borrow()));
                let v = |i: usize| particles.velocity(i).as_dvec3();
                let (mut taken, mut done, mut size) = (0.0, 0.0, 0.0);
                for (i, (a, d)) in a.iter().zip(d).enumerate() {
                    let p = f64::from(particles.aux[i]);
                    taken += p * f64::from(d);
                    done += v(i).dot(vector(a));
                    size += (p * f64::from(d)).abs();
                }
                assert!(size > 0.0 && (taken - done).abs() < 1e-5 * size, "{taken}, {done} of {size}");
            });
        });
    }
}

/// Pressures p ≥ 0 of a chain, with b − A p left over, A = 2 on the diagonal and −1 beside it.
#[test]
fn the_descent_finds_pressures_that_only_push() {
    let n = 40;
    let b: Vec<f32> = (0..n).map(|i| if i < 25 { 1.0 } else { -3.0 }).collect();
    let sites = vec![Site { relief: 0.25, ..Site::default() }; n];
    let left = |p: &[f32]| -> Vec<f32> {
        let beside = |i: usize, k: isize| p.get(i.wrapping_add_signed(k)).copied().unwrap_or(0.0);
        (0..n).map(|i| b[i] - 2.0 * p[i] + beside(i, -1) + beside(i, 1)).collect()
    };
    let (mut at, mut descent) = (vec![0.0; n], Descent::default());
    descent.begin(&at);
    let mut iterations = 0;
    while violation(&at, &sites, |i| left(&at)[i]) > 1e-4 {
        let r = left(&at);
        descent.advance(&mut at, &sites, (1.0, f32::INFINITY), |i| r[i]);
        iterations += 1;
        assert!(iterations < 400, "plain descent would need thousands");
    }
    assert!(at.iter().all(|&p| p >= 0.0) && at[10] > 50.0 && at[n - 1] == 0.0, "{at:?}");
}

#[test]
fn constants_of_the_lattice_scale_with_the_spacing() {
    for ratio in [2.0, 2.7, 3.5] {
        let [coarse, fine] = [0.02, 0.005].map(|dx| stiffest_wave(dx, ratio * dx) * dx * dx);
        assert!((coarse / fine - 1.0).abs() < 1e-9 && (0.3..1.5).contains(&coarse), "{ratio}: {coarse}");
    }
    // The wider the support, the less a particle itself counts, and the nearer a level surface is to one half.
    let levels = [2.0, 2.7, 3.5, 8.0].map(|ratio| level_surface(0.01, ratio * 0.01));
    assert!(
        levels.is_sorted_by(|a, b| a > b) && levels[0] < 0.9 && (0.5..0.6).contains(&levels[3]),
        "{levels:?}"
    );
}
