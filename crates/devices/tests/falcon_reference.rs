//! The Falcon's kinematics and packets against rows of another implementation.
//!
//! The rows come from libnifalcon's own code, run: `fk.csv` its place for encoder counts, once converged; `force.csv` its
//! motor counts and torques, once its two mistakes in the Jacobian (a wrong sine, a transpose over its own storage) were
//! repaired, at 10 000 counts per newton metre; the packets as it writes and reads them.
#![allow(clippy::unwrap_used, clippy::panic)]

use glam::DVec3;
use hapflow_devices::falcon::{
    ByteStream, Command, Firmware, Geometry, Kinematics, Leds, MAX_MOTOR_COUNTS, Reply, motor_counts,
    torques_of,
};
use std::path::Path;

const LIB_COUNTS_PER_NM: f64 = 10_000.0;

/// The rows of a file, by the names of its columns.
fn rows(name: &str) -> Vec<Row> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/falcon").join(name);
    let mut reader = csv::Reader::from_path(path).unwrap();
    let header = reader.headers().unwrap().clone();
    reader.records().map(|record| Row { header: header.clone(), record: record.unwrap() }).collect()
}

struct Row {
    header: csv::StringRecord,
    record: csv::StringRecord,
}

impl Row {
    fn text(&self, column: &str) -> &str {
        let at = self.header.iter().position(|name| name == column).unwrap_or_else(|| panic!("no {column}"));
        &self.record[at]
    }

    fn number(&self, column: &str) -> f64 {
        self.text(column).parse().unwrap()
    }

    fn three(&self, columns: [&str; 3]) -> DVec3 {
        DVec3::from_array(columns.map(|column| self.number(column)))
    }

    fn counts(&self, what: &str) -> [i16; 3] {
        [0, 1, 2].map(|n| self.text(&format!("{what}{n}_counts")).parse().unwrap())
    }

    fn bytes(&self) -> [u8; 16] {
        let byte = |text| u8::from_str_radix(text, 16).unwrap();
        self.text("bytes_hex").split(' ').map(byte).collect::<Vec<_>>().try_into().unwrap()
    }
}

fn kinematics() -> Kinematics {
    Kinematics::new(Geometry::load("libnifalcon").unwrap())
}

#[test]
fn places_are_those_of_every_row() {
    let kinematics = kinematics();
    let (mut near, mut worst) = (DVec3::Z * 0.11, 0.0_f64);
    let rows = rows("fk.csv");
    for row in &rows {
        let angles = kinematics.geometry().angles(row.counts("enc"));
        let place = kinematics.forward(angles, near).unwrap();
        let expected = row.three(["x_m", "y_m", "z_m"]);
        worst = worst.max(place.distance(expected));
        assert!(place.distance(expected) < 1e-7, "{place} in place of {expected}");
        // The other way round: the counts themselves.
        let back = kinematics.geometry().counts(kinematics.inverse(place).unwrap());
        for (back, counts) in back.into_iter().zip(row.counts("enc")) {
            assert!((back - f64::from(counts)).abs() < 1e-5, "{back} in place of {counts}");
        }
        near = place;
    }
    println!("{} rows, farthest {worst:.1e} m", rows.len());
}

#[test]
fn motor_counts_and_torques_are_those_of_every_row() {
    let kinematics = kinematics();
    let rows = rows("force.csv");
    let (mut worst, mut scaled) = (0.0_f64, 0);
    for row in &rows {
        let (place, force) = (row.three(["x_m", "y_m", "z_m"]), row.three(["fx_N", "fy_N", "fz_N"]));
        let torques = kinematics.torques(place, force).unwrap();
        let expected = row.three(["tau0_fixed_Nm", "tau1_fixed_Nm", "tau2_fixed_Nm"]);
        assert!((torques - expected).abs().max_element() < 1e-6, "{torques} in place of {expected}");
        let expected = row.three(["motor0_fixed_counts", "motor1_fixed_counts", "motor2_fixed_counts"]);
        let largest = expected.abs().max_element();
        let limit = f64::from(MAX_MOTOR_COUNTS);
        scaled += usize::from(largest > limit);
        let expected = expected * (limit / largest).min(1.0);
        let counts = motor_counts(torques, LIB_COUNTS_PER_NM);
        let off = (DVec3::from_array(counts.map(f64::from)) - expected).abs().max_element();
        assert!(off <= 2.0, "{counts:?} in place of {expected}");
        worst = worst.max(off);
    }
    println!("{} rows, {scaled} of them beyond the range, farthest {worst:.2} counts", rows.len());
}

#[test]
fn packets_are_those_of_every_row() {
    for row in rows("packets_out.csv") {
        let leds = Leds::from_mask(row.text("led_mask").parse().unwrap()).unwrap();
        let command = Command { motors: row.counts("motor"), homing: row.text("homing") == "1", leds };
        assert_eq!(command.encode(), row.bytes());
        assert_eq!(Command::decode(&row.bytes()), Some(command));
    }
    for row in rows("packets_in.csv") {
        let expected = (row.text("accepted") == "1").then(|| Reply {
            encoders: row.counts("enc"),
            homed: row.text("homing_bits").parse().unwrap(),
            buttons: row.text("button_bits").parse().unwrap(),
        });
        assert_eq!(Reply::decode(&row.bytes()), expected);
    }
    // What libnifalcon takes for the nibble 15.
    let mut bytes = Reply::default().encode();
    bytes[1] = 0x30;
    assert_eq!(Reply::decode(&bytes), None);
}

/// A grid over the free discs of the depths that a hand uses; every place on it is reached.
fn workspace() -> impl Iterator<Item = DVec3> {
    let discs = [(0.09, 0.014), (0.1, 0.04), (0.11, 0.065), (0.13, 0.065), (0.15, 0.053), (0.17, 0.025)];
    discs.into_iter().flat_map(|(z, radius)| {
        (-8..=8)
            .flat_map(move |i| (-8..=8).map(move |j| DVec3::new(f64::from(i), f64::from(j), 0.0) / 8.0))
            .filter(|p| p.length() <= 1.0)
            .map(move |p| p * radius + DVec3::Z * z)
    })
}

#[test]
fn forward_of_inverse_is_the_same_place() {
    let kinematics = kinematics();
    let mut worst = 0.0_f64;
    for place in workspace() {
        let found = kinematics.forward(kinematics.inverse(place).unwrap(), DVec3::Z * 0.11).unwrap();
        worst = worst.max(found.distance(place));
    }
    println!("farthest {worst:.1e} m");
    assert!(worst < 1e-9, "{worst}");
}

/// What the counts give is what was asked: to 0.5 % from 1 N on, below it to half a count a motor.
#[test]
fn realised_force_is_the_asked_one() {
    let kinematics = kinematics();
    let scale = kinematics.geometry().counts_per_nm;
    let (mut worst, mut beyond) = (0.0_f64, 0);
    for place in workspace() {
        for direction in DVec3::AXES.into_iter().chain([DVec3::splat(-0.577), DVec3::new(0.8, -0.6, 0.0)]) {
            for size in [0.1, 1.0, 4.0, 8.0, 100.0] {
                let asked = direction * size;
                let counts = motor_counts(kinematics.torques(place, asked).unwrap(), scale);
                let given = kinematics.force(place, torques_of(counts, scale)).unwrap();
                let half_a_count = kinematics
                    .jacobian(place)
                    .unwrap()
                    .transpose()
                    .to_cols_array_2d()
                    .iter()
                    .map(|q| DVec3::from_array(*q).length())
                    .sum::<f64>()
                    * 0.5
                    / scale;
                let saturated = counts.iter().any(|c| c.abs() == MAX_MOTOR_COUNTS);
                if saturated {
                    // Less, but no other way.
                    assert!(given.angle_between(asked) < 2e-3, "{given} for {asked} at {place}");
                    assert!(given.length() < asked.length() * 1.001);
                    beyond += 1;
                    continue;
                }
                let off = given.distance(asked);
                assert!(off <= half_a_count * (1.0 + 1e-9), "{given} for {asked} at {place}");
                if size >= 1.0 {
                    worst = worst.max(off / size);
                }
            }
        }
    }
    println!("farthest {:.2} % from 1 N on; {beyond} beyond the motors' range", 100.0 * worst);
    assert!(worst < 0.005, "{worst}");
    assert!(beyond > 100);
}

/// Numbers without a pattern (a linear congruence: Knuth's MMIX).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        self.0 >> 33
    }

    fn float(&mut self) -> f64 {
        match self.next() % 8 {
            0 => f64::from_bits(self.next() << 33 ^ self.next()),
            1 => f64::NAN,
            _ => (self.next() as f64 / (1_u64 << 31) as f64 - 0.5) * 0.5,
        }
    }

    fn vector(&mut self) -> DVec3 {
        DVec3::new(self.float(), self.float(), self.float())
    }
}

#[test]
fn no_pose_panics_and_none_gives_a_wild_force() {
    let (kinematics, mut random) = (kinematics(), Random(1));
    for _ in 0..100_000 {
        let (place, force) = (random.vector(), random.vector());
        if let Ok(torques) = kinematics.torques(place, force) {
            let counts = motor_counts(torques, random.float());
            assert!(counts.iter().all(|c| c.abs() <= MAX_MOTOR_COUNTS), "{counts:?}");
        }
    }
    for _ in 0..20_000 {
        let counts = [0; 3].map(|_: i32| random.next() as i16);
        let found = kinematics.forward(kinematics.geometry().angles(counts), random.vector());
        if let Ok(place) = found {
            let back = kinematics.geometry().counts(kinematics.inverse(place).unwrap());
            assert!(back.into_iter().zip(counts).all(|(a, b)| (a - f64::from(b)).abs() < 1e-5), "{counts:?}");
        }
    }
}

#[test]
fn no_stream_panics_and_sound_packets_are_found_in_noise() {
    let mut random = Random(2);
    let (mut stream, mut sent, mut found) = (ByteStream::default(), 0, 0);
    for n in 0..30_000_u32 {
        let noise: Vec<u8> = (0..random.next() % 40).map(|_| random.next() as u8).collect();
        stream.push(&noise);
        if n % 3 == 0 {
            // A false beginning in the noise may swallow a packet only if all of it is well-formed.
            stream.push(&Reply { encoders: [n as i16; 3], homed: 7, buttons: 0 }.encode());
            sent += 1;
        }
        while let Some(reply) = stream.next(Reply::decode) {
            found += u32::from(reply.homed == 7 && reply.encoders[0] == n as i16);
        }
    }
    assert_eq!(found, sent);
}

#[test]
fn no_firmware_file_panics() {
    let mut random = Random(3);
    for _ in 0..20_000 {
        let mut bytes: Vec<u8> = (0..random.next() % 200).map(|_| (random.next() % 5) as u8).collect();
        if bytes.len() > 2 {
            bytes[..2].copy_from_slice(&[0xAA, 0x08]);
        }
        let _ = Firmware::check(bytes);
    }
}

#[test]
fn no_parameter_file_panics() {
    let (sound, mut random) = (Geometry::load("martin").unwrap().text(), Random(4));
    for _ in 0..5_000 {
        let mut bytes = sound.clone().into_bytes();
        for _ in 0..random.next() % 4 {
            let at = random.next() as usize % bytes.len();
            bytes[at] = (random.next() % 96 + 32) as u8;
        }
        if let Ok(text) = String::from_utf8(bytes) {
            let _ = Geometry::parse(&text, "spoilt");
        }
    }
}
