//! What a tick of the Falcon costs but for USB: a reply decoded, the place found, a force turned into counts, a command
//! encoded. `cargo bench -p hapflow-devices --bench falcon_tick`; goal: under 3 µs.
#![allow(clippy::unwrap_used, missing_docs)]

use glam::DVec3;
use hapflow_devices::falcon::{ByteStream, Command, Geometry, Kinematics, Leds, Reply, motor_counts};
use std::hint::black_box;
use std::time::Instant;

const TICKS: i32 = 1_000_000;

fn main() {
    let kinematics = Kinematics::new(Geometry::load("libnifalcon").unwrap());
    let (mut stream, mut place) = (ByteStream::default(), DVec3::Z * 0.13);
    let begin = Instant::now();
    for n in 0..TICKS {
        // A count a tick on each arm: 30 mm/s and more.
        let wave = |phase: i32| (((n + phase) % 1200) - 600).abs() as i16 - 300;
        stream.push(&Reply { encoders: [wave(0), wave(300), wave(700)], homed: 7, buttons: 0 }.encode());
        let reply = stream.next(Reply::decode).unwrap();
        place = kinematics.forward(kinematics.geometry().angles(reply.encoders), place).unwrap();
        let torques = kinematics.torques(place, black_box(DVec3::new(1.0, -2.0, 0.5))).unwrap();
        let motors = motor_counts(torques, kinematics.geometry().counts_per_nm);
        black_box(Command { motors, homing: true, leds: Leds::BLUE }.encode());
    }
    println!("{:.2} µs a tick", 1e6 * begin.elapsed().as_secs_f64() / f64::from(TICKS));
}
