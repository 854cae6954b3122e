//! What happened is written to a file, and the file is played again.
#![allow(clippy::unwrap_used, clippy::panic)]

mod common;

use common::{jet, open, word};
use glam::DVec3;
use hapflow::devices::{HapticDevice, NullDevice};
use hapflow::engine::run::{RunOptions, virtual_clock};
use hapflow::engine::{
    Drive, Parts, Recorded, Scene, SceneError, Session, SessionOptions, TickWriter, Value, open_device, parse,
};
use hapflow::haptics::ToolState;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// A file of this test's own, which is not there yet.
fn file(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("hapflow-recording-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    folder.join(name)
}

fn quick() -> Scene {
    jet(&[("run.backend", word("analytic-jet"))])
}

fn with_tape(scene: &Scene) -> Session {
    Session::open(scene, SessionOptions { threads: 1, tape: 4096, ..SessionOptions::hosted() }).unwrap()
}

/// A place with digits to its end.
fn place(n: u32) -> DVec3 {
    let t = f64::from(n) * 1e-3;
    DVec3::new(0.01 * (7.1 * t).sin(), 1.0 / 3.0 * 0.01 * (3.3 * t).cos(), -1e-9 * t)
}

/// Ticks `from..to` of every tool.
fn drive(servos: &mut [hapflow::engine::ServoUnit], from: u32, to: u32) {
    for n in from..to {
        for servo in servos.iter_mut() {
            servo.tick(&ToolState::at(place(n)), f64::from(n) * 1e-3, 1e-3);
        }
    }
}

/// The first four numbers of each line.
fn rows(path: &Path) -> Vec<[f64; 4]> {
    let text = std::fs::read_to_string(path).unwrap();
    let mut lines = text.lines();
    assert_eq!(lines.next().unwrap(), TickWriter::COLUMNS.join(","));
    let row = |line: &str| -> [f64; 4] {
        let numbers: Vec<f64> = line.split(',').map(|n| n.parse().unwrap()).collect();
        assert_eq!(numbers.len(), TickWriter::COLUMNS.len());
        numbers[..4].try_into().unwrap()
    };
    lines.map(row).collect()
}

#[test]
fn every_tick_between_start_and_stop_is_there_to_the_last_bit() {
    let mut session = with_tape(&quick());
    let mut servos = [session.take_servo().unwrap()];
    drive(&mut servos, 0, 100);
    for (name, from) in [("a.csv", 100), ("b.csv", 400)] {
        let path = file(name);
        session.record(&path).unwrap();
        drive(&mut servos, from, from + 200);
        assert_eq!(session.stop_recording().unwrap(), Recorded { ticks: 200, lost: 0 });
        drive(&mut servos, from + 200, from + 300);
        let expected = (from..from + 200).map(|n| {
            let p = place(n);
            [f64::from(n) * 1e-3, p.x, p.y, p.z].map(f64::to_bits)
        });
        assert!(rows(&path).into_iter().map(|r| r.map(f64::to_bits)).eq(expected), "{name}");
    }
}

#[test]
fn a_recording_is_played_again() {
    let path = file("played.csv");
    let mut session = with_tape(&quick());
    let mut servos = [session.take_servo().unwrap()];
    session.record(&path).unwrap();
    drive(&mut servos, 0, 300);
    session.stop_recording().unwrap();
    let again = jet(&[
        ("run.device", word("replay")),
        ("run.motion", word(&path.display().to_string())),
        ("run.motion_origin", word("scene")),
        // Else it would move the motion.
        ("tool.position", Value::Vector(DVec3::new(0.01, 0.02, 0.0))),
    ]);
    let mut device = open_device(&again).unwrap();
    for n in 0..300 {
        assert_eq!(device.read(f64::from(n) * 1e-3).unwrap().position, place(n), "{n}");
    }
    // With a mapping it is the same in the scene.
    let mut turned = again;
    turned.mapping.axes = "y z x".into();
    turned.mapping.scale = 2.0;
    turned.mapping.offset = DVec3::new(0.1, 0.0, 0.0);
    let (mut device, mut session) = (open_device(&turned).unwrap(), open(&turned, 1));
    let mut servo = session.take_servo().unwrap();
    for n in 0..300 {
        let t = f64::from(n) * 1e-3;
        servo.tick(&device.read(t).unwrap(), t, 1e-3);
        assert!((servo.newest().tool.position - place(n)).length() < 1e-15, "{n}");
    }
}

#[test]
fn each_tool_has_its_own_file_and_ticks_that_are_too_many_are_counted() {
    let two = parse(&format!("{}[[tool]]\n[[tool]]\nname = \"b\"\n", common::JET), "two").unwrap();
    let (path, second) = (file("two.csv"), file("two.1.csv"));
    let options = SessionOptions { threads: 1, tape: 16, ..SessionOptions::hosted() };
    let mut session = Session::open(&two, options).unwrap();
    let mut servos: Vec<_> = (0..2).map(|tool| session.take_servo_of(tool).unwrap()).collect();
    session.record(&path).unwrap();
    // Faster than any file: what is written and what is lost is all of it.
    drive(&mut servos, 0, 20_000);
    let recorded = session.stop_recording().unwrap();
    assert_eq!(recorded.ticks + recorded.lost, 40_000);
    assert!(recorded.lost > 0);
    let (first, second) = (rows(&path), rows(&second));
    assert_eq!((first.len() + second.len()) as u64, recorded.ticks);
    for rows in [first, second] {
        assert!(rows.windows(2).all(|w| w[0][0] < w[1][0]));
        assert_eq!(rows.last().unwrap()[0], 19.999);
    }
}

#[test]
fn an_owned_servo_is_recorded_and_closing_ends_the_file_whole() {
    let path = file("owned.csv");
    let devices: Vec<Box<dyn HapticDevice>> = vec![Box::new(NullDevice::new(DVec3::ZERO))];
    let options = SessionOptions {
        servo_drive: Drive::Owned,
        fluid_drive: Drive::Owned,
        devices,
        tape: 4096,
        ..SessionOptions::hosted()
    };
    let mut session = Session::open(&quick(), options).unwrap();
    session.record(&path).unwrap();
    while session.report().tick < 50 {
        std::thread::sleep(Duration::from_millis(1));
    }
    session.close();
    let last = session.report().time_s;
    drop(session);
    assert_eq!(rows(&path).last().unwrap()[0], last);
}

#[test]
fn what_cannot_be_recorded_is_refused_with_path_and_cause() {
    let mut session = with_tape(&quick());
    let nowhere = Path::new("/nowhere/at/all.csv");
    let refused = session.record(nowhere).unwrap_err();
    assert!(matches!(refused, SceneError::Io { .. }));
    assert!(refused.to_string().starts_with("/nowhere/at/all.csv: No such file"), "{refused}");
    assert!(matches!(session.stop_recording(), Err(SceneError::Recording(_))));
    session.record(&file("twice.csv")).unwrap();
    let refused = session.record(&file("never.csv")).unwrap_err();
    assert!(matches!(refused, SceneError::Recording(_)) && !file("never.csv").exists(), "{refused}");
    session.stop_recording().unwrap();
    let mut without = open(&quick(), 1);
    assert!(matches!(without.record(&file("never.csv")), Err(SceneError::Recording(_))));
    assert!(!file("never.csv").exists());
}

#[test]
#[cfg(target_os = "linux")]
fn a_full_disc_is_told_at_the_end_and_harms_no_tick() {
    let mut session = with_tape(&quick());
    let mut servos = [session.take_servo().unwrap()];
    session.record(Path::new("/dev/full")).unwrap();
    drive(&mut servos, 0, 10_000);
    assert_eq!(servos[0].newest().tick, 10_000);
    assert!(servos[0].newest().sent.force.is_finite());
    let told = session.stop_recording().unwrap_err().to_string();
    assert!(told.starts_with("/dev/full: No space left on device"), "{told}");
    // The tapes are there for the next one.
    session.record(&file("after.csv")).unwrap();
    drive(&mut servos, 10_000, 10_010);
    assert_eq!(session.stop_recording().unwrap(), Recorded { ticks: 10, lost: 0 });
}

#[test]
#[cfg(target_os = "linux")]
fn a_run_whose_file_is_full_ends_with_the_reason() {
    let mut progress = |_: hapflow::engine::run::Progress<'_>| ControlFlow::Continue(());
    let record = Some(Path::new("/dev/full"));
    let options = RunOptions {
        parts: Parts::default(),
        threads: 1,
        pictures_at: &[],
        record,
        guide: &mut |_| ControlFlow::Continue(()),
        progress: &mut progress,
    };
    let told = virtual_clock(&quick(), options).unwrap_err().to_string();
    assert!(told.starts_with("/dev/full: No space left on device"), "{told}");
}

#[test]
fn a_whole_run_is_written_as_it_goes_and_as_at_its_end() {
    let (streamed, whole) = (file("streamed.csv"), file("whole.csv"));
    let mut progress = |_: hapflow::engine::run::Progress<'_>| ControlFlow::Continue(());
    let options = RunOptions {
        parts: Parts::default(),
        threads: 1,
        pictures_at: &[],
        record: Some(&streamed),
        guide: &mut |_| ControlFlow::Continue(()),
        progress: &mut progress,
    };
    let outcome = virtual_clock(&quick(), options).unwrap();
    outcome.recording.write_csv(&whole).unwrap();
    assert_eq!(std::fs::read(&streamed).unwrap(), std::fs::read(&whole).unwrap());
    assert_eq!(rows(&whole).len(), 300);
}
