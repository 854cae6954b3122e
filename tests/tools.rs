//! Several tools in one fluid: each has its own servo, path, force and settings.
#![allow(clippy::unwrap_used, clippy::panic)]

mod common;

use common::open;
use glam::DVec3;
use hapflow::devices::NullDevice;
use hapflow::engine::{Drive, Scene, ServoUnit, Session, SessionOptions, Value, parse};
use hapflow::haptics::ToolState;

/// Two jets half a hand apart, a ball under each.
const TWO: &str = r#"
name = "two"
[run]
fluid_hz = 100
filter = "none"
[fluid]
spacing = 0.006
[bounds]
min = [-0.2, -0.1, -0.1]
max = [0.2, 0.1, 0.1]
[[source]]
name = "left"
position = [-0.1, 0.05, 0.0]
speed = 1.2
[[source]]
name = "right"
position = [0.1, 0.05, 0.0]
speed = 1.8
[[tool]]
position = [-0.1, 0.0, 0.0]
[[tool]]
name = "second"
position = [0.1, 0.0, 0.0]
radius = 0.02
[gate]
ramp_in = 0.0
"#;

fn scene(backend: &str) -> Scene {
    parse(&TWO.replace("[run]", &format!("[run]\nbackend = \"{backend}\"")), "two").unwrap()
}

/// Mean raw force of each tool, stepped together with its hand at rest where `at` says.
fn forces(session: &mut Session, at: &[DVec3], frames: i32) -> Vec<DVec3> {
    let mut servos: Vec<ServoUnit> = (0..at.len()).map(|k| session.take_servo_of(k).unwrap()).collect();
    let mut fluid = session.take_fluid().unwrap();
    let mut sums = vec![DVec3::ZERO; at.len()];
    for k in 1..=frames {
        let t = f64::from(k) * 0.01;
        fluid.publish(t);
        fluid.compute(t);
        for ((servo, place), sum) in servos.iter_mut().zip(at).zip(&mut sums) {
            servo.tick(&ToolState::at(*place), t, 1e-3);
            if k > frames / 2 {
                *sum += servo.newest().raw.force / f64::from(frames - frames / 2);
            }
        }
    }
    sums
}

#[test]
fn each_tool_feels_its_own_jet() {
    let (left, right) = (DVec3::new(-0.1, 0.0, 0.0), DVec3::new(0.1, 0.0, 0.0));
    let mut session = open(&scene("analytic-jet"), 1);
    assert_eq!(session.tool_count(), 2);
    let felt = forces(&mut session, &[left, right], 20);
    let expected = |tap: usize, radius: f64, at: DVec3| {
        let s = scene("analytic-jet");
        hapflow::fluid::jet_force(&s.sources[tap], 1000.0, s.fluid.gravity, radius, at, DVec3::ZERO)
    };
    assert!((felt[0] - expected(0, 0.015, left)).length() < 1e-9);
    assert!((felt[1] - expected(1, 0.02, right)).length() < 1e-9);
    // With particles: about what each feels where the other tool is far away.
    let both = forces(&mut open(&scene("cpu"), 2), &[left, right], 60);
    let away = DVec3::new(0.0, 0.0, 0.09);
    let first = forces(&mut open(&scene("cpu"), 2), &[left, away], 60);
    let second = forces(&mut open(&scene("cpu"), 2), &[away, right], 60);
    assert!((both[0] - first[0]).length() < 0.1 * first[0].length(), "{} {}", both[0], first[0]);
    assert!((both[1] - second[1]).length() < 0.1 * second[1].length(), "{} {}", both[1], second[1]);
    assert!(both[0].y < -0.05 && both[1].y < 1.3 * both[0].y);
}

#[test]
fn settings_and_faults_reach_each_tool() {
    let mut session = open(&scene("analytic-jet"), 1);
    assert_eq!(session.get("tool.second.radius").unwrap(), Value::Number(0.02));
    session.set("tool.second.force_scale", &Value::Number(3.0)).unwrap();
    assert!(session.set("tool.second.position", &Value::Vector(DVec3::ZERO)).is_err());
    assert!(session.set("tool.third.radius", &Value::Number(0.01)).is_err());
    let control = session.control();
    let mut servos = [session.take_servo_of(0).unwrap(), session.take_servo_of(1).unwrap()];
    assert!(session.take_servo_of(2).is_none() && session.take_servo().is_none());
    let mut fluid = session.take_fluid().unwrap();
    let mut time = 0.0;
    let mut run = |servos: &mut [ServoUnit; 2]| {
        for _ in 0..50 {
            time += 0.01;
            fluid.publish(time);
            fluid.compute(time);
            for (servo, x) in servos.iter_mut().zip([-0.1, 0.1]) {
                servo.tick(&ToolState::at(DVec3::X * x), time, 0.01);
            }
        }
        [servos[0].newest().sent.force.length(), servos[1].newest().sent.force.length()]
    };
    let felt = run(&mut servos);
    assert!(felt[0] > 0.3 && felt[1] > 2.0 * felt[0], "{felt:?}");
    control.emergency_stop();
    assert_eq!(run(&mut servos), [0.0, 0.0]);
    control.clear_faults();
    let again = run(&mut servos);
    assert!(
        again.iter().zip(felt).all(|(a, b)| (a - b).abs() < 1e-9),
        "every gate is cleared: {again:?}, {felt:?}"
    );
}

#[test]
fn owned_servos_have_a_thread_each() {
    let scene = scene("analytic-jet");
    let devices = |n: usize| -> Vec<Box<dyn hapflow::devices::HapticDevice>> {
        (0..n).map(|k| Box::new(NullDevice::new(DVec3::X * (0.2 * k as f64 - 0.1))) as Box<_>).collect()
    };
    let open = |n| {
        let options = SessionOptions {
            servo_drive: Drive::Owned,
            fluid_drive: Drive::Owned,
            devices: devices(n),
            threads: 1,
            ..SessionOptions::hosted()
        };
        Session::open(&scene, options)
    };
    assert!(open(0).is_err() && open(3).is_err());
    let mut session = open(2).unwrap();
    for tool in 0..2 {
        while session.report_of(tool).unwrap().sent.force.length() < 0.1 {
            std::thread::sleep(std::time::Duration::from_millis(5));
        }
    }
    assert!(session.report_of(2).is_none());
    session.close();
}
