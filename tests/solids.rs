//! Solids are felt: ground, container and obstacles, through a whole session.
#![allow(clippy::unwrap_used, clippy::panic)]

mod common;

use common::open;
use glam::{DQuat, DVec3};
use hapflow::engine::{FluidUnit, ObstacleMover, Scene, ServoUnit, Session, Value, parse, settings};
use hapflow::haptics::{SolidKind, ToolState, Touching};

/// A ball of 10 mm above a ground, with a plate beside it, and no water.
const DRY: &str = r#"
name = "dry"
ground = 0.0
[run]
backend = "analytic-jet"
device = "null"
filter = "butterworth:20"
[bounds]
min = [-0.2, -0.1, -0.2]
max = [0.2, 0.2, 0.2]
[tool]
radius = 0.01
position = [0.0, 0.05, 0.0]
solid_stiffness = 400.0
[[obstacle]]
name = "plate"
shape = "disc"
radius = 0.03
thickness = 0.002
position = [0.1, 0.1, 0.0]
[gate]
ramp_in = 0.0
max_slew = 1e6
"#;

fn dry(changes: &[(&str, Value)]) -> Scene {
    let mut scene = parse(DRY, "dry").unwrap();
    for (path, value) in changes {
        settings::set(&mut scene, path, value).unwrap();
    }
    scene
}

struct Hand {
    session: Session,
    servo: ServoUnit,
    fluid: FluidUnit,
    mover: ObstacleMover,
    tick: u32,
}

impl Hand {
    fn new(scene: &Scene) -> Self {
        let mut session = open(scene, 1);
        let (servo, fluid) = (session.take_servo().unwrap(), session.take_fluid().unwrap());
        let mover = session.take_obstacles().unwrap();
        Self { session, servo, fluid, mover, tick: 0 }
    }

    /// One tick at `place`; what is sent.
    fn at(&mut self, place: DVec3) -> DVec3 {
        let t = f64::from(self.tick) * 1e-3;
        if self.tick.is_multiple_of(10) {
            self.fluid.publish(t);
            self.fluid.compute(t);
        }
        self.tick += 1;
        self.servo.tick(&ToolState::at(place), t, 1e-3).force()
    }

    /// Goes evenly to `place`; the last force.
    fn go(&mut self, to: DVec3, ticks: u32) -> DVec3 {
        let from = self.servo.newest().tool.position;
        (1..=ticks).fold(DVec3::ZERO, |_, n| self.at(from.lerp(to, f64::from(n) / f64::from(ticks))))
    }

    fn touching(&mut self) -> Touching {
        self.session.touching_of(0).unwrap()
    }
}

fn close(a: DVec3, b: DVec3) {
    assert!((a - b).length() < 1e-6, "{a} is not {b}");
}

#[test]
fn the_ground_is_felt_at_once_whatever_the_filter_does() {
    let mut hand = Hand::new(&dry(&[]));
    let above = DVec3::new(0.0, 0.05, 0.0);
    hand.at(above);
    close(hand.go(above, 20), DVec3::ZERO);
    let force = hand.at(DVec3::new(0.0, 0.006, 0.0));
    close(force, DVec3::Y * 400.0 * 0.004);
    let touching = hand.touching();
    close(touching.proxy, DVec3::new(0.0, 0.01, 0.0));
    assert_eq!((touching.contacts().len(), touching.contacts()[0].kind), (1, SolidKind::Ground));
    // The fluid has the tool where it can be, and not in the ground.
    hand.go(DVec3::new(0.0, 0.006, 0.0), 40);
    close(hand.servo.newest().body, DVec3::new(0.0, 0.01, 0.0));
    close(hand.servo.newest().tool.position, DVec3::new(0.0, 0.006, 0.0));
}

#[test]
fn a_plate_that_the_host_moves_lifts_a_hand_that_rests() {
    let mut hand = Hand::new(&dry(&[]));
    let place = DVec3::new(0.1, 0.15, 0.0);
    let mut last = 0.0;
    hand.at(place);
    for frame in 0..60 {
        // From 39 mm below the ball's skin to 4 mm above it, at 0.1 m/s.
        let height = (0.1 + 1e-3 * f64::from(frame)).min(0.143);
        assert!(hand.mover.set(0, DVec3::new(0.1, height, 0.0), DQuat::IDENTITY));
        hand.mover.publish();
        for _ in 0..10 {
            let force = hand.at(place).y;
            assert!(force >= last - 1e-9 && force - last < 400.0 * 1.1e-4 + 1e-9, "{last} to {force}");
            last = force;
        }
    }
    close(DVec3::Y * last, DVec3::Y * 400.0 * 0.004);
    let contact = hand.touching().contacts()[0];
    assert_eq!((contact.kind, contact.index), (SolidKind::Obstacle, 0));
    close(contact.point, DVec3::new(0.1, 0.144, 0.0));
}

#[test]
fn a_plate_that_is_swung_through_the_tool_takes_it_along() {
    // 60 mm in a fluid frame: six times the ball's radius, thirty times the plate's thickness.
    let mut hand = Hand::new(&dry(&[]));
    let place = DVec3::new(0.1, 0.125, 0.0);
    hand.at(place);
    hand.go(place, 30);
    assert!(hand.mover.set(0, DVec3::new(0.1, 0.16, 0.0), DQuat::IDENTITY));
    hand.mover.publish();
    hand.go(place, 30);
    let touching = hand.touching();
    close(touching.proxy, DVec3::new(0.1, 0.171, 0.0));
    assert!(touching.force().y > 0.0);
}

#[test]
fn a_plate_that_the_host_turns_takes_the_tool_along() {
    let mut hand = Hand::new(&dry(&[]));
    // Above the plate, near its edge, which then comes up: a quarter turn in a fluid frame.
    let place = DVec3::new(0.12, 0.115, 0.0);
    hand.at(place);
    hand.go(place, 30);
    let turn = DQuat::from_rotation_z(std::f64::consts::FRAC_PI_2);
    assert!(hand.mover.set(0, DVec3::new(0.1, 0.1, 0.0), turn));
    hand.mover.publish();
    for _ in 0..40 {
        hand.at(place);
    }
    let touching = hand.touching();
    // The plate stands, and the tool is on the side that was its upper one.
    close(touching.proxy, DVec3::new(0.1 - 0.011, 0.115, 0.0));
    close(touching.contacts()[0].normal, DVec3::NEG_X);
}

#[test]
fn after_a_fault_the_tool_is_where_the_hand_is() {
    let mut hand = Hand::new(&dry(&[]));
    let below = DVec3::new(0.1, 0.05, 0.0);
    hand.at(DVec3::new(0.1, 0.15, 0.0));
    let pushed = hand.go(below, 20);
    assert!(pushed.y > 3.9, "held by the plate: {pushed}");
    hand.session.control().emergency_stop();
    close(hand.at(below), DVec3::ZERO);
    hand.session.control().clear_faults();
    close(hand.go(below, 3), DVec3::ZERO);
    close(hand.touching().proxy, below);
    // Neither does a broken time take the solids away.
    hand.servo.tick(&ToolState::at(below), f64::NAN, f64::NAN);
    hand.session.control().clear_faults();
    hand.go(DVec3::new(0.1, 0.09, 0.0), 10);
    close(hand.touching().proxy, DVec3::new(0.1, 0.089, 0.0));
}

#[test]
fn where_solids_are_not_felt_the_proxy_is_the_tools_body() {
    let mut hand = Hand::new(&dry(&[("tool.solid_stiffness", Value::Number(0.0))]));
    let inside = DVec3::new(0.0, 0.002, 0.0);
    close(hand.go(inside, 100), DVec3::ZERO);
    let body = hand.servo.newest().body;
    assert_eq!((hand.touching().proxy, hand.touching().contacts().len()), (body, 0));
    assert!(hand.session.touching_of(1).is_none());
}

#[test]
fn a_larger_tool_stands_higher_and_stiffness_holds_for_the_session() {
    let mut hand = Hand::new(&dry(&[]));
    hand.at(DVec3::new(0.0, 0.05, 0.0));
    hand.go(DVec3::new(0.0, 0.01, 0.0), 20);
    hand.session.set("tool.radius", &Value::Number(0.015)).unwrap();
    close(hand.at(DVec3::new(0.0, 0.01, 0.0)), DVec3::Y * 400.0 * 0.005);
    assert!(hand.session.set("tool.solid_stiffness", &Value::Number(100.0)).is_err());
    let refused = settings::set(&mut dry(&[]), "tool.solid_stiffness", &Value::Number(2e4)).unwrap_err();
    assert!(refused.to_string().contains("a number from 0 to 10000 N/m"), "{refused}");
}
