//! Force limits are lowered while a session runs, and never raised.
#![allow(clippy::unwrap_used, clippy::panic)]

mod common;

use common::{jet, open, word};
use hapflow::engine::{Scene, Session, Value, parse};
use hapflow::haptics::ToolState;

/// A jet whose force is cut at the scene's limit of 2 N.
fn strong() -> Scene {
    jet(&[
        ("run.backend", word("analytic-jet")),
        ("tool.force_scale", Value::Number(100.0)),
        ("gate.max_force", Value::Number(2.0)),
        ("gate.max_slew", Value::Number(500.0)),
    ])
}

/// Forces of ticks at rest, while `act` may act before each.
fn forces(scene: &Scene, ticks: u32, mut act: impl FnMut(u32, &Session)) -> Vec<f64> {
    let mut session = open(scene, 1);
    let (mut servo, mut fluid) = (session.take_servo().unwrap(), session.take_fluid().unwrap());
    let mut tick = |n: u32| {
        let t = f64::from(n) * 1e-3;
        if n.is_multiple_of(10) {
            fluid.publish(t);
            fluid.compute(t);
        }
        act(n, &session);
        servo.tick(&ToolState::default(), t, 1e-3).force().length()
    };
    (0..ticks).map(&mut tick).collect()
}

#[test]
fn it_acts_at_the_next_tick_and_for_good() {
    let felt = forces(&strong(), 400, |n, session| match n {
        200 => session.control().limit_force(0.5, 0.01).unwrap(),
        300 => session.set("gate.max_force", &Value::Number(0.4)).unwrap(),
        _ => {}
    });
    assert!(felt[199] > 1.99 && felt[150..200].iter().all(|f| *f <= 2.0));
    assert!(felt[200] <= 0.5 && felt[299] > 0.499, "{} {}", felt[200], felt[299]);
    assert!(felt[300] <= 0.4 && felt[399] > 0.399);
}

#[test]
fn a_setting_goes_back_up_to_the_limit_within_the_slew_and_no_further() {
    let felt = forces(&strong(), 400, |n, session| {
        let set = |force| session.set("gate.max_force", &Value::Number(force));
        match n {
            200 => set(0.5).unwrap(),
            300 => {
                let refused = set(2.5).unwrap_err().to_string();
                let expected =
                    "gate.max_force = 2.5: must be at most 2 N: while a session runs it may only be lowered";
                assert_eq!(refused, expected);
                set(2.0).unwrap();
            }
            _ => {}
        }
    });
    assert!(felt[200] <= 0.5 && felt[399] > 1.99 && felt[399] <= 2.0);
    assert!(felt[300..].windows(2).all(|w| w[1] - w[0] <= 0.5 + 1e-12), "slew");
}

#[test]
fn more_than_the_present_limit_is_refused_and_changes_nothing() {
    let session = open(&strong(), 1);
    let (control, limit) = (session.control(), || session.get("gate.max_force").unwrap());
    control.limit_force(1.0, 0.05).unwrap();
    for (force, torque) in [(1.1, 0.01), (0.5, 0.06), (f64::NAN, 0.01), (0.5, f64::NAN), (-0.1, 0.01)] {
        assert!(control.limit_force(force, torque).is_err(), "{force} {torque}");
        assert_eq!(limit(), Value::Number(1.0));
        assert_eq!(session.get("gate.max_torque").unwrap(), Value::Number(0.05));
    }
    assert!(control.limit_force(2.0, 0.01).unwrap_err().to_string().contains("max_force_N = 2"));
    // Settings are held by it, and others are not in its way.
    assert!(session.set("gate.max_force", &Value::Number(1.5)).is_err());
    session.set("fluid.viscosity", &Value::Number(0.01)).unwrap();
    assert_eq!(limit(), Value::Number(1.0));
    for (path, value) in [("gate.max_torque", 0.2), ("gate.max_slew", 501.0), ("gate.max_torque_slew", 26.0)]
    {
        let refused = session.set(path, &Value::Number(value)).unwrap_err().to_string();
        assert!(refused.contains(path) && refused.contains("at most"), "{refused}");
    }
}

#[test]
fn a_change_of_the_scene_cannot_raise_it_either() {
    let text = format!("{}[[change]]\nat_s = 1\ngate.max_force = 4.5\n", common::JET);
    let refused = parse(&text, "jet").unwrap_err().to_string();
    assert!(refused.contains("gate.max_force = 4.5: must be at most 4 N"), "{refused}");
    let text = format!("{}[[change]]\nat_s = 0.2\ngate.max_force = 3.0\n", common::JET);
    let mut scene = parse(&text, "jet").unwrap();
    scene.run.backend = hapflow::engine::BackendKind::AnalyticJet;
    scene.tool.force_scale = 100.0;
    let felt = forces(&scene, 300, |n, session| {
        if n == 100 {
            session.control().limit_force(1.0, 0.1).unwrap();
        }
    });
    assert!(felt[99] > 3.9 && felt[100..].iter().all(|f| *f <= 1.0), "the change found a lower limit");
}
