//! The fast passes against the scalar twin, on clouds with every kind of neighbourhood.

use super::{Pass, Rows, Scratch};
use crate::body::BodyTables;
use crate::grid::Grid;
use crate::meetings::Meetings;
use crate::neighbours::Neighbours;
use crate::particles::{Newborn, Particles};
use crate::solids::{Solids, Walls};
use crate::solver::viscosity::{Room, Viscosity};
use crate::solver::{muller::Muller, tension::Tension, wcsph::Wcsph};
use crate::twin::{MullerTwin, TensionTwin, Twin, WcsphTwin};
use crate::vector_unit::{Arch, WIDEST};
use crate::wall::WallTable;
use crate::{Aabb, FluidConfig, FluidSettings, Kernel, Solver, World, kernel};
use glam::{DVec3, Vec3};

pub(super) fn config(solver: Solver) -> FluidConfig {
    let world = World {
        bounds: Aabb { min: DVec3::splat(-1.0), max: DVec3::splat(1.0) },
        pools: vec![Aabb { min: DVec3::ZERO, max: DVec3::splat(0.1) }],
        ..World::default()
    };
    let settings =
        FluidSettings { solver, viscosity: 0.3, surface_tension: 0.07, ..FluidSettings::default() };
    FluidConfig { settings, world, frame_hz: 60.0, threads: 1 }
}

/// A dense lump with thin spray round it.
fn cloud(spacing: f32) -> Particles {
    let mut seed = 7_u32;
    let mut random = || {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (seed >> 8) as f32 / (1 << 23) as f32 - 1.0
    };
    let mut born = Vec::new();
    for k in 0..700 {
        let lattice = Vec3::new((k % 8) as f32, (k / 8 % 8) as f32, (k / 64) as f32) * spacing;
        let scatter = if k < 512 { 0.2 * spacing } else { 12.0 * spacing };
        let position = lattice + Vec3::new(random(), random(), random()) * scatter;
        let velocity = Vec3::new(random(), random(), random());
        born.push(Newborn { position, velocity, pressure: random().abs() * 3.0, ..Newborn::default() });
    }
    let mut particles = Particles::new();
    particles.extend(&born);
    particles
}

pub(super) fn twins(p: &Particles, density: impl Fn(usize) -> f64) -> Vec<Twin> {
    let twin = |i: usize| Twin {
        x: p.position(i).as_dvec3(),
        v: p.velocity(i).as_dvec3(),
        p: p.p[i].into(),
        density: density(i),
    };
    (0..p.len()).map(twin).collect()
}

/// Sorted cloud and a pass over it on each kind of processor at hand.
pub(super) fn each_pass(
    config: &FluidConfig,
    check: impl Fn(&mut Particles, &dyn Fn(&Particles, &dyn Fn(Pass<'_>))),
) {
    let support = config.settings.support_length();
    for arch in Arch::all() {
        let (mut particles, mut grid) = (cloud(config.settings.spacing as f32), Grid::default());
        let n = particles.len();
        let spacing = config.settings.spacing as f32;
        grid.sort(&mut particles, spacing, support as f32, &vec![false; n]);
        let mut neighbours = Neighbours::default();
        neighbours.find(arch, &grid, &particles, spacing, [support as f32, 0.0]);
        let (walls, plane) =
            (Walls::new(&config.world, &config.settings), WallTable::plane(config.settings.kernel, support));
        let tables = BodyTables::new(&[], crate::Kernel::Wendland, 0.027);
        check(&mut particles, &|particles, run| {
            let solids = Solids { walls: &walls, bodies: &[], plane: &plane, tables: &tables };
            let mut meetings = Meetings::default();
            meetings.find(particles, &solids, support as f32);
            run(Pass { arch, particles, neighbours: &neighbours, meetings: &meetings });
        });
    }
}

fn assert_close(got: DVec3, expected: DVec3, scale: f64, what: &str) {
    assert!((got - expected).length() < 2e-4 * scale, "{what}: {got} instead of {expected} (scale {scale})");
}

pub(super) fn vector(row: &[f32; 4]) -> DVec3 {
    Vec3::new(row[0], row[1], row[2]).as_dvec3()
}

#[test]
fn muller_passes_equal_the_twin() {
    let config = config(Solver::Muller);
    let s = &config.settings;
    let h = s.support_length();
    let twin = MullerTwin {
        h,
        mass: s.particle_mass(),
        viscosity: config.effective_viscosity(),
        tension: s.surface_tension,
        inside: 0.5 / h,
    };
    let solver = Muller::new(&config);
    each_pass(&config, |particles, with_pass| {
        let rows = std::cell::RefCell::new(Rows::new());
        with_pass(particles, &|pass| solver.densities(pass, &mut Scratch::default(), &mut rows.borrow_mut()));
        solver.take_densities(particles, &rows.borrow(), false, 1e-3);
        let all = twins(particles, |i| 1.0 / f64::from(particles.aux[i]));
        for i in 0..all.len() {
            let expected = twin.density(&all, i);
            assert!((f64::from(rows.borrow()[i][0]) / expected - 1.0).abs() < 1e-5);
        }
        with_pass(particles, &|pass| {
            solver.accelerations(pass, &mut Scratch::default(), &mut rows.borrow_mut())
        });
        let expected: Vec<_> = (0..all.len()).map(|i| twin.acceleration(&all, i)).collect();
        let scale = expected.iter().map(|a| a.length()).fold(0.0, f64::max);
        for (row, expected) in rows.borrow().iter().zip(expected) {
            assert_close(vector(row), expected, scale, "acceleration");
        }
    });
}

#[test]
fn wcsph_passes_equal_the_twin() {
    for kernel in [Kernel::Wendland, Kernel::Cubic, Kernel::LowPass] {
        let mut config = config(Solver::Wcsph);
        config.settings.kernel = kernel;
        hold_wcsph_against_the_twin(&config);
    }
}

fn hold_wcsph_against_the_twin(config: &FluidConfig) {
    let s = &config.settings;
    let (dx, h, c) = (s.spacing, s.support_length(), config.sound_speed());
    let twin = WcsphTwin {
        kernel: s.kernel,
        h,
        volume: dx.powi(3) / s.kernel.lattice_moment(dx, h),
        viscosity: s.kinematic_viscosity(),
        filter: super::wcsph::noise_filter(config),
        gravity: s.gravity,
    };
    let solver = Wcsph::new(config);
    each_pass(config, |particles, with_pass| {
        let rates = std::cell::RefCell::new(Vec::new());
        let all = twins(particles, |_| 1000.0);
        let each = |f: &dyn Fn(usize) -> DVec3| (0..all.len()).map(f).collect::<Vec<_>>();
        with_pass(particles, &|pass| solver.rates(pass, &mut Scratch::default(), &mut rates.borrow_mut()));
        let scalars = each(&|i| {
            let diffusion = s.density_diffusion * 0.5 * h * c * twin.diffusion(&all, i);
            DVec3::new(twin.divergence(&all, i), diffusion, 0.0)
        });
        let laplacians = each(&|i| twin.laplacian(&all, i, |k| all[k].v));
        let crowdings = each(&|i| twin.crowding(&all, i));
        let got = rates.borrow();
        assert_rows(
            got.iter().map(|r| DVec3::new(r.divergence.into(), 0.0, 0.0)),
            scalars.iter().map(|s| s.with_y(0.0)),
        );
        assert_rows(
            got.iter().map(|r| DVec3::new(0.0, r.diffusion.into(), 0.0)),
            scalars.iter().map(|s| s.with_x(0.0)),
        );
        assert_rows(got.iter().map(|r| r.laplacian.as_dvec3()), laplacians.iter().copied());
        assert_rows(got.iter().map(|r| r.crowding.as_dvec3()), crowdings.iter().copied());
        drop(got);
        particles.aux = particles.p.clone();
        for (i, r) in rates.borrow().iter().enumerate() {
            (particles.lx[i], particles.ly[i], particles.lz[i]) = r.laplacian.into();
        }
        let rows = std::cell::RefCell::new(Rows::new());
        with_pass(particles, &|pass| {
            solver.accelerations(
                pass,
                &rates.borrow(),
                &mut Scratch::default(),
                &mut rows.borrow_mut(),
                &mut [],
            );
        });
        let expected = each(&|i| twin.acceleration(&all, &laplacians, i));
        assert_rows(rows.borrow().iter().map(vector), expected.into_iter());
        with_pass(particles, &|pass| solver.packing(pass, &mut Scratch::default(), &mut rows.borrow_mut()));
        let fill = |i: usize| twin.sum(&all, i) / s.kernel.lattice_sum(dx, h) * dx.powi(3);
        assert_rows(rows.borrow().iter().map(vector), each(&|i| DVec3::X * fill(i)).into_iter());
    });
}

/// Normals and curvatures are the twin's, and whatever they are, what they do sums to nothing.
#[test]
fn surface_tension_equals_the_twin_and_sums_to_nothing() {
    let config = config(Solver::Wcsph);
    let s = &config.settings;
    let (dx, h) = (s.spacing, s.support_length());
    let volume = dx.powi(3) / kernel::poly6_lattice_moment(dx, h);
    let twin = TensionTwin { h, volume, strength: 2.0 * s.surface_tension / s.rest_density };
    let tension = Tension::new(&config).unwrap();
    each_pass(&config, |particles, with_pass| {
        let (mut normals, pulls) = (Rows::new(), std::cell::RefCell::new(Vec::new()));
        let found = std::cell::RefCell::new(Rows::new());
        with_pass(particles, &|pass| {
            tension.normals(pass, &mut Scratch::default(), &mut found.borrow_mut());
        });
        normals.clone_from(&found.borrow());
        with_pass(particles, &|pass| {
            tension.pulls(pass, &normals, &mut Scratch::default(), &mut pulls.borrow_mut(), &mut []);
        });
        let all = twins(particles, |_| 1000.0);
        let expected: Vec<_> = (0..all.len()).map(|i| twin.normal(&all, i)).collect();
        assert_rows(normals.iter().map(|n| vector(n) * f64::from(n[3])), expected.iter().copied());
        // Spray has nobody along it: there the curvature is cut off.
        let smooth = |a: DVec3, n: DVec3| a.length() < 2.0 / dx * twin.strength * n.length();
        let pulls = pulls.into_inner();
        let scale = twin.strength / (dx * h);
        for (i, pull) in pulls.iter().enumerate() {
            let a = twin.acceleration(&all, &expected, i);
            if smooth(a, expected[i]) && expected[i].length() > 0.1 / h {
                assert_close(pull.curvature.as_dvec3(), a, 5.0 * scale, "curvature");
            }
        }
        let mut rows = vec![[0.0; 4]; pulls.len()];
        tension.add(particles, &normals, &pulls, &mut rows);
        let size: f64 = rows.iter().map(|r| vector(r).length()).sum();
        let sum: DVec3 = rows.iter().map(vector).sum();
        assert!(size > 0.0 && sum.length() < 1e-5 * size, "{sum} of {size}");
    });
}

/// The velocities that are solved for are those whose friction, by the twin, leads to them.
#[test]
fn implicit_viscosity_is_backward_euler_of_the_twin() {
    let mut config = config(Solver::Wcsph);
    config.settings.viscosity = 300.0;
    let s = &config.settings;
    let (dx, h, dt) = (s.spacing, s.support_length(), 1e-3);
    let twin = WcsphTwin {
        kernel: s.kernel,
        h,
        volume: dx.powi(3) / s.kernel.lattice_moment(dx, h),
        viscosity: s.kinematic_viscosity(),
        filter: 0.0,
        gravity: s.gravity,
    };
    let viscosity = Viscosity::new(&config).unwrap();
    each_pass(&config, |particles, with_pass| {
        let found = std::cell::RefCell::new(vec![[1.0, 2.0, 3.0, 0.0]; particles.len()]);
        let mut all = twins(particles, |_| 1000.0);
        let others = DVec3::new(1.0, 2.0, 3.0) + s.gravity;
        let before: Vec<_> = all.iter().map(|a| a.v + dt * others).collect();
        with_pass(particles, &|pass| {
            let (mut room, mut scratch) = (Room::default(), Scratch::default());
            let rows = &mut found.borrow_mut();
            assert!(viscosity.solve(pass, dt as f32, &mut room, &mut scratch, rows, &mut []));
        });
        for (a, row) in all.iter_mut().zip(found.borrow().iter()) {
            a.v += dt * (vector(row) + s.gravity);
        }
        let friction = |i: usize| dt * twin.viscosity * twin.laplacian(&all, i, |k| all[k].v);
        let back: Vec<_> = (0..all.len()).map(|i| all[i].v - friction(i)).collect();
        assert!(all.iter().zip(&before).any(|(a, b)| (a.v - *b).length() > 0.5), "it must do something");
        assert_rows(back.into_iter(), before.iter().copied());
    });
}

#[test]
fn a_force_that_is_no_number_spoils_nobody_elses_velocity() {
    let mut config = config(Solver::Wcsph);
    config.settings.viscosity = 3000.0;
    let viscosity = Viscosity::new(&config).unwrap();
    each_pass(&config, |particles, with_pass| {
        let rows = std::cell::RefCell::new(vec![[1.0, 2.0, 3.0, 0.0]; particles.len()]);
        rows.borrow_mut()[7][0] = f32::NAN;
        with_pass(particles, &|pass| {
            let (mut room, mut scratch) = (Room::default(), Scratch::default());
            assert!(!viscosity.solve(pass, 1e-3, &mut room, &mut scratch, &mut rows.borrow_mut(), &mut []));
        });
        let whole = rows.borrow().iter().filter(|row| row.iter().all(|x| x.is_finite())).count();
        assert_eq!(whole, particles.len() - 1);
    });
}

/// Whoever touches a particle is in its list, once, and every particle has one, of whole vectors.
#[test]
fn lists_hold_every_neighbour() {
    let config = config(Solver::Wcsph);
    let support = config.settings.support_length() as f32;
    each_pass(&config, |particles, with_pass| {
        with_pass(particles, &|pass| {
            let mut next = 0;
            for chunk in 0..pass.neighbours.chunks() {
                let own = pass.neighbours.particles(chunk);
                assert_eq!((own.start, own.len()), (next, pass.neighbours.lists(chunk).count()));
                for (i, list) in own.clone().zip(pass.neighbours.lists(chunk)) {
                    let apart = |j: u32| particles.position(i).distance(particles.position(j as usize));
                    let mut found: Vec<_> = list.to_vec();
                    found.retain(|&j| j as usize != particles.len());
                    assert!(list.len() < found.len() + WIDEST);
                    assert!(found.iter().all(|&j| apart(j) < 1.001 * support), "{i}");
                    found.retain(|&j| apart(j) < support);
                    found.sort_unstable();
                    let all = 0..particles.len() as u32;
                    assert_eq!(found, all.filter(|&j| apart(j) < support).collect::<Vec<_>>(), "{i}");
                }
                next = own.end;
            }
            assert_eq!(next, particles.len());
        });
    });
}

/// Lists with leeway hold all that touch until one has gone farther.
#[test]
fn lists_hold_while_none_has_gone_far() {
    let (spacing, support, leeway) = (0.01_f32, 0.027, 0.001);
    let (mut p, mut grid, mut neighbours) = (cloud(spacing), Grid::default(), Neighbours::default());
    let dead = vec![false; p.len()];
    grid.sort(&mut p, spacing, support, &dead);
    neighbours.find(Arch::best(), &grid, &p, spacing, [support, leeway]);
    for i in 0..p.len() {
        let way = Vec3::new(1.0, 0.0, 0.0) * if i % 2 == 0 { 0.99 * leeway } else { -0.99 * leeway };
        p.set_position(i, p.position(i) + way);
    }
    assert!(neighbours.hold(&p));
    for chunk in 0..neighbours.chunks() {
        for (i, list) in neighbours.particles(chunk).zip(neighbours.lists(chunk)) {
            let near = |j: &usize| p.position(i).distance(p.position(*j)) < support;
            assert!((0..p.len()).filter(near).all(|j| list.contains(&(j as u32))));
        }
    }
    p.set_position(7, p.position(7) + Vec3::splat(leeway));
    assert!(!neighbours.hold(&p));
    p.set_position(7, Vec3::NAN);
    assert!(!neighbours.hold(&p));
    neighbours.find(Arch::best(), &grid, &p, spacing, [support, leeway]);
    p.extend(&[]);
    assert!(!neighbours.hold(&p));
}

/// Each row within 2e-4 of the largest expected one.
pub(super) fn assert_rows(got: impl Iterator<Item = DVec3>, expected: impl Iterator<Item = DVec3> + Clone) {
    let scale = expected.clone().map(|e| e.length()).fold(0.0, f64::max);
    for (got, expected) in got.zip(expected) {
        assert_close(got, expected, scale, "row");
    }
}

/// Pairs give no momentum and turn nothing, and viscosity and the noise filter only take energy away.
#[test]
fn pair_forces_sum_to_nothing() {
    for pressure in [true, false] {
        let mut config = config(Solver::Wcsph);
        config.settings.viscosity = if pressure { 0.0 } else { 0.3 };
        config.settings.artificial_viscosity = if pressure { 0.0 } else { 0.1 };
        let solver = Wcsph::new(&config);
        each_pass(&config, |particles, with_pass| {
            let rates = std::cell::RefCell::new(Vec::new());
            let rows = std::cell::RefCell::new(Rows::new());
            with_pass(particles, &|pass| {
                solver.rates(pass, &mut Scratch::default(), &mut rates.borrow_mut())
            });
            for (i, r) in rates.borrow().iter().enumerate() {
                (particles.lx[i], particles.ly[i], particles.lz[i]) = r.laplacian.into();
                particles.aux[i] = if pressure { particles.p[i] } else { 0.0 };
            }
            with_pass(particles, &|pass| {
                solver.accelerations(
                    pass,
                    &rates.borrow(),
                    &mut Scratch::default(),
                    &mut rows.borrow_mut(),
                    &mut [],
                );
            });
            let got: Vec<_> = rows.borrow().iter().map(vector).collect();
            let size: f64 = got.iter().map(|a| a.length()).sum();
            let sum: DVec3 = got.iter().sum();
            assert!(size > 0.0 && sum.length() < 1e-5 * size, "{sum} of {size}");
            let turns: Vec<_> =
                got.iter().enumerate().map(|(i, a)| particles.position(i).as_dvec3().cross(*a)).collect();
            let (turn, reach) =
                (turns.iter().sum::<DVec3>().length(), turns.iter().map(|t| t.length()).sum::<f64>());
            assert!(turn < 1e-4 * reach, "{turn} of {reach}");
            let power: f64 =
                got.iter().enumerate().map(|(i, a)| a.dot(particles.velocity(i).as_dvec3())).sum();
            assert!(pressure || power < 0.0, "{power}");
        });
    }
}
