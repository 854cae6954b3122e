//! What a hand feels of solids, with known answers.

use super::*;
use crate::{Pose, SolidShape, ground, open_box};
use glam::DQuat;

const R: f64 = 0.01;
const T: f64 = 1e-3;
const FEEL: SolidFeel = SolidFeel { stiffness_n_per_m: 500.0, damping_n_s_per_m: 0.0 };

fn obstacle(shape: SolidShape, pose: Pose) -> Solid {
    Solid::at_rest(SolidKind::Obstacle, 3, shape, pose)
}

fn v(x: f64, y: f64, z: f64) -> DVec3 {
    DVec3::new(x, y, z)
}

/// The proxy after a hand went along `way` in `ticks` steps.
fn along(way: &[DVec3], ticks: usize, solids: &[Solid]) -> (Proxy, Touching) {
    let mut proxy = Proxy::default();
    proxy.follow(way[0], R, solids);
    for leg in way.windows(2) {
        for n in 1..=ticks {
            proxy.follow(leg[0].lerp(leg[1], n as f64 / ticks as f64), R, solids);
        }
    }
    let touching = proxy.touch(&ToolState::at(way[way.len() - 1]), R, solids, FEEL);
    (proxy, touching)
}

fn close(a: DVec3, b: DVec3) {
    assert!((a - b).length() < 1e-9, "{a} is not {b}");
}

#[test]
fn a_ball_pressed_on_the_ground_feels_stiffness_times_depth() {
    let solids = [ground(0.05)];
    for ticks in [1, 7, 100] {
        let (_, touching) = along(&[v(0.1, 0.2, 0.3), v(0.1, 0.056, 0.3)], ticks, &solids);
        close(touching.proxy, v(0.1, 0.06, 0.3));
        close(touching.force(), DVec3::Y * 500.0 * 0.004);
        let [contact] = touching.contacts() else { panic!("{touching:?}") };
        close(contact.point, v(0.1, 0.05, 0.3));
        assert!((contact.depth_m - 0.004).abs() < 1e-12 && contact.normal == DVec3::Y);
        assert_eq!((contact.kind, contact.index), (SolidKind::Ground, 0));
    }
}

#[test]
fn what_does_not_touch_is_not_felt_and_the_proxy_is_the_hand() {
    let solids = [ground(0.0), obstacle(SolidShape::Sphere { radius: 0.02 }, Pose::at(v(0.05, 0.05, 0.0)))];
    // Past the ball, as close as a millimetre.
    let (_, touching) = along(&[v(-0.1, 0.081, 0.0), v(0.2, 0.081, 0.0)], 60, &solids);
    assert_eq!((touching.proxy, touching.contacts().len()), (v(0.2, 0.081, 0.0), 0));
}

#[test]
fn it_slides_along_a_wall_without_friction_and_into_a_corner() {
    let walls = open_box(DVec3::ZERO, v(0.2, 0.1, 0.2), 0.01);
    let way = [v(0.1, 0.05, 0.1), v(-0.003, 0.05, 0.1), v(-0.003, 0.05, 0.17)];
    let (_, sliding) = along(&way, 100, &walls);
    close(sliding.proxy, v(R, 0.05, 0.17));
    close(sliding.force(), DVec3::X * 500.0 * 0.013);
    let way = [&way[..], &[v(-0.003, -0.002, 0.195)]].concat();
    let (_, corner) = along(&way, 100, &walls);
    close(corner.proxy, v(R, R, 0.2 - R));
    close(corner.force(), v(0.013, 0.012, -0.005) * 500.0);
    let mut touched: Vec<_> = corner.contacts().iter().map(|c| (c.kind, c.index)).collect();
    touched.sort_by_key(|c| c.1);
    assert_eq!(touched, [0, 1, 4].map(|wall| (SolidKind::Container, wall)));
}

#[test]
fn the_box_is_felt_from_outside_and_over_its_rim() {
    let walls = open_box(DVec3::ZERO, v(0.2, 0.1, 0.2), 0.01);
    let (_, outside) = along(&[v(-0.1, 0.05, 0.1), v(0.05, 0.05, 0.1)], 50, &walls);
    close(outside.proxy, v(-0.01 - R, 0.05, 0.1));
    // Up, over the rim and down into the box: it is inside then, and free.
    let over = [v(-0.1, 0.05, 0.1), v(-0.1, 0.2, 0.1), v(0.1, 0.2, 0.1), v(0.1, 0.05, 0.1)];
    let (_, inside) = along(&over, 50, &walls);
    assert_eq!((inside.proxy, inside.contacts().len()), (over[3], 0));
}

#[test]
fn planes_that_are_not_square_are_solved_exactly() {
    // A wedge of two slopes of 45 degrees.
    let slope = |turn: f64| {
        let pose = Pose { position: DVec3::ZERO, orientation: DQuat::from_rotation_z(turn) };
        Solid::at_rest(SolidKind::Obstacle, 0, SolidShape::HalfSpace, pose)
    };
    let turn = std::f64::consts::FRAC_PI_4;
    let solids = [slope(turn), slope(-turn), ground(-1.0)];
    let (_, touching) = along(&[v(0.0, 0.1, 0.0), v(0.001, -0.02, 0.0)], 30, &solids);
    close(touching.proxy, v(0.0, R * 2.0_f64.sqrt(), 0.0));
    close(touching.force(), (touching.proxy - v(0.001, -0.02, 0.0)) * 500.0);
    // Only one of them is pressed when the hand is far to its side.
    let (_, touching) = along(&[v(0.0, 0.1, 0.0), v(0.08, 0.07, 0.0)], 30, &solids);
    assert_eq!(touching.contacts().len(), 1);
    close(touching.force().normalize(), v(-1.0, 1.0, 0.0).normalize());
}

#[test]
fn on_a_ball_it_finds_the_place_above_the_hand() {
    let ball = [obstacle(SolidShape::Sphere { radius: 0.03 }, Pose::at(v(0.0, 0.1, 0.0)))];
    let hand = v(0.0, 0.1, 0.0) + v(0.6, 0.8, 0.0) * 0.036;
    let (_, touching) = along(&[v(-0.02, 0.2, 0.0), v(-0.005, 0.14, 0.0), hand], 40, &ball);
    close(touching.proxy, v(0.0, 0.1, 0.0) + v(0.6, 0.8, 0.0) * 0.04);
    assert!((touching.force() - v(0.6, 0.8, 0.0) * 500.0 * 0.004).length() < 1e-6);
    assert_eq!(touching.contacts()[0].index, 3);
}

/// A hand that comes fast, and never gets through.
fn strike(from: DVec3, velocity: DVec3, plate: Pose) -> DVec3 {
    let solids = [obstacle(SolidShape::Disc { radius: 0.08, thickness: 0.001 }, plate)];
    let mut proxy = Proxy::default();
    for n in 0..40 {
        let hand = from + velocity * (T * f64::from(n));
        proxy.follow(hand, R, &solids);
        let touching = proxy.touch(&ToolState::at(hand), R, &solids, FEEL);
        let (distance, _) = solids[0].distance(touching.proxy);
        assert!(distance >= R - 1e-9, "tick {n}: {distance}");
    }
    proxy.position.unwrap()
}

#[test]
fn a_thin_disc_is_never_passed_through_at_5_m_s() {
    let flat = Pose::at(v(0.0, 0.05, 0.0));
    assert!(strike(v(0.0, 0.15, 0.0), DVec3::NEG_Y * 5.0, flat).y > 0.06);
    assert!(strike(v(0.01, -0.05, 0.02), DVec3::Y * 5.0, flat).y < 0.04);
    for n in 0..64 {
        // From all sides on a tilted plate, straight at its middle.
        let turn = DQuat::from_euler(glam::EulerRot::XYZ, 0.3 * f64::from(n), 0.7 * f64::from(n), 0.0);
        let plate = Pose { position: flat.position, orientation: turn };
        let side = turn * v(0.02, 0.1, -0.01);
        let end = strike(flat.position + side, -side.normalize() * 5.0, plate);
        assert!((turn.conjugate() * (end - flat.position)).y > 0.0, "case {n}: {end}");
    }
}

#[test]
fn a_moving_solid_pushes_a_hand_that_rests_and_its_damper_knows_its_speed() {
    let feel = SolidFeel { damping_n_s_per_m: 2.0, ..FEEL };
    let hand = ToolState::at(v(0.0, 0.1, 0.0));
    let mut proxy = Proxy::default();
    let mut plate =
        obstacle(SolidShape::Disc { radius: 0.05, thickness: 0.002 }, Pose::at(v(0.0, 0.08, 0.0)));
    plate.velocity = DVec3::Y * 0.2;
    for n in 0..=100 {
        plate.pose.position.y = 0.08 + 0.2 * T * f64::from(n);
        proxy.follow(hand.position, R, &[plate]);
        let touching = proxy.touch(&hand, R, &[plate], feel);
        let depth = plate.pose.position.y + 0.001 + R - 0.1;
        if depth > 1e-9 {
            close(touching.force(), DVec3::Y * (500.0 * depth + 2.0 * 0.2));
            close(touching.velocity, DVec3::Y * 0.2);
        } else if depth < -1e-9 {
            assert_eq!(touching, Touching::nothing(&hand));
        }
    }
}

#[test]
fn a_damper_slows_and_never_holds() {
    let feel = SolidFeel { damping_n_s_per_m: 10.0, ..FEEL };
    let solids = [ground(0.0)];
    let felt = |velocity: DVec3| {
        let (proxy, _) = along(&[v(0.0, 0.05, 0.0), v(0.0, 0.006, 0.0)], 20, &solids);
        let hand = ToolState { velocity, ..ToolState::at(v(0.0, 0.006, 0.0)) };
        proxy.touch(&hand, R, &solids, feel)
    };
    close(felt(DVec3::NEG_Y * 0.1).force(), DVec3::Y * (2.0 + 1.0));
    close(felt(DVec3::Y * 0.1).force(), DVec3::Y * (2.0 - 1.0));
    assert_eq!(felt(DVec3::Y * 9.0).force(), DVec3::ZERO);
    // Across the surface nothing is felt, and the proxy goes with the hand.
    close(felt(v(0.3, -0.1, 0.0)).velocity, v(0.3, 0.0, 0.0));
}

/// splitmix64, as numbers from -1 to 1.
fn random(state: &mut u64) -> f64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let z = (*state ^ (*state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}

#[test]
fn however_a_hand_moves_the_proxy_is_in_no_solid_and_every_contact_pushes_out() {
    let mut touched = 0;
    for seed in 0..60 {
        let mut state = seed;
        let mut vector = |size: f64| DVec3::from_array(std::array::from_fn(|_| size * random(&mut state)));
        let mut solids: Vec<Solid> = open_box(v(-0.15, 0.0, -0.15), v(0.15, 0.08, 0.15), 0.01).into();
        solids.push(ground(-0.05));
        for shape in
            [SolidShape::Sphere { radius: 0.03 }, SolidShape::Disc { radius: 0.05, thickness: 0.002 }]
        {
            let orientation = DQuat::from_scaled_axis(vector(3.0));
            solids.push(obstacle(shape, Pose { position: vector(0.1) + v(0.0, 0.2, 0.0), orientation }));
        }
        let mut proxy = Proxy::default();
        let mut hand = v(0.0, 0.4, 0.0);
        for tick in 0..2000 {
            // Mostly as a hand, at times as nothing moves.
            hand += vector(if tick % 100 == 99 { 0.5 } else { 0.004 });
            hand = hand.clamp(DVec3::splat(-0.3), DVec3::splat(0.4));
            proxy.follow(hand, R, &solids);
            let touching = proxy.touch(&ToolState::at(hand), R, &solids, FEEL);
            let nearest = solids.iter().map(|s| s.distance(touching.proxy).0).fold(f64::INFINITY, f64::min);
            assert!(nearest >= R - 1e-9, "seed {seed} tick {tick}: {} inside", R - nearest);
            for contact in touching.contacts() {
                assert!(contact.force.dot(contact.normal) >= 0.0 && contact.force.is_finite());
                assert!((contact.normal.length() - 1.0).abs() < 1e-12);
            }
            touched += usize::from(!touching.contacts().is_empty());
        }
    }
    assert!(touched > 10_000, "{touched}");
}

#[test]
fn where_there_is_no_room_it_stays_and_the_force_is_finite() {
    let ceiling =
        Pose { position: v(0.0, 0.015, 0.0), orientation: DQuat::from_rotation_x(std::f64::consts::PI) };
    let solids = [ground(0.0), Solid::at_rest(SolidKind::Obstacle, 0, SolidShape::HalfSpace, ceiling)];
    let (_, touching) = along(&[v(0.0, 0.007, 0.0), v(0.1, 0.007, 0.0)], 10, &solids);
    assert!(touching.proxy.is_finite() && touching.force().is_finite());
}

#[test]
fn after_a_reset_it_begins_at_the_hand() {
    let solids = [ground(0.0)];
    let (mut proxy, _) = along(&[v(0.0, 0.05, 0.0), v(0.0, 0.006, 0.0)], 20, &solids);
    proxy.reset();
    proxy.follow(v(1.0, 0.5, 0.0), R, &solids);
    assert_eq!(proxy.position, Some(v(1.0, 0.5, 0.0)));
}

/// Kinetic energy with which a mass of 0.2 kg leaves the ground, for each joule with which it comes: its force is held
/// for a tick at a time, and `damping` is the device's own, N·s/m.
fn rebound(stiffness: f64, damping: f64, speed: f64, phase: f64) -> f64 {
    const STEPS: usize = 200;
    let feel = SolidFeel { stiffness_n_per_m: stiffness, ..FEEL };
    let (mass, dt) = (0.2, T / STEPS as f64);
    let (mut y, mut velocity) = (R + speed * T * phase, -speed);
    let mut proxy = Proxy::default();
    for _ in 0..2000 {
        proxy.follow(v(0.0, y, 0.0), R, &[ground(0.0)]);
        let hand = ToolState { velocity: DVec3::Y * velocity, ..ToolState::at(v(0.0, y, 0.0)) };
        let force = proxy.touch(&hand, R, &[ground(0.0)], feel).force().y;
        for _ in 0..STEPS {
            velocity += (force - damping * velocity) / mass * dt;
            y += velocity * dt;
        }
        if velocity > 0.0 && y > R {
            return (velocity / speed).powi(2);
        }
    }
    0.0
}

#[test]
fn a_solid_gives_back_no_more_than_it_took_within_the_passivity_bound() {
    for stiffness in [200.0, 1000.0, 4000.0] {
        let bound = stiffness * T / 2.0;
        let mut without = 0.0_f64;
        for k in 0..20 {
            let phase = f64::from(k) / 20.0;
            for speed in [0.05, 0.3, 1.0] {
                let gain = rebound(stiffness, 1.001 * bound, speed, phase);
                assert!(gain <= 1.0, "{stiffness} N/m at {speed} m/s, phase {phase}: {gain}");
                without = without.max(rebound(stiffness, 0.0, speed, phase));
            }
        }
        // Held for a tick, the spring alone does give energy: the bound is needed.
        assert!(without > 1.001, "{stiffness} N/m: {without}");
    }
}
