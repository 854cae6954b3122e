//! `hapflow falcon fk`, `force`, `decode` and `encode`: the Falcon's mathematics on files.

use crate::falcon::table::{Row, Table, TableError};
use glam::DVec3;
use hapflow_devices::falcon::{Command, Kinematics, Leds, PACKET_BYTES, Reply, motor_counts};
use std::fmt::Write;

/// No place and no force of a hand is larger, m and N.
pub const MAX_PLACE_M: f64 = 1.0;
const MAX_FORCE_N: f64 = 1000.0;

/// Columns.
pub const ENCODERS: [&str; 3] = ["enc0_counts", "enc1_counts", "enc2_counts"];
pub const MOTORS: [&str; 3] = ["motor0_counts", "motor1_counts", "motor2_counts"];
pub const PLACE: [&str; 3] = ["x_m", "y_m", "z_m"];
const FORCE: [&str; 3] = ["fx_N", "fy_N", "fz_N"];
const TORQUES: [&str; 3] = ["tau0_Nm", "tau1_Nm", "tau2_Nm"];

/// Encoder counts to places.
pub fn fk(table: &Table, kinematics: &Kinematics) -> Result<Vec<u8>, TableError> {
    let mut near = DVec3::ZERO;
    table.with(&ENCODERS, &PLACE, |row| {
        let counts = counts(row, ENCODERS)?;
        near = kinematics
            .forward(kinematics.geometry().angles(counts), near)
            .map_err(|cause| row.refuse_row("enc0_counts, enc1_counts, enc2_counts", cause))?;
        Ok(near.to_array().map(|metres| format!("{metres:.12}")).to_vec())
    })
}

/// Places and forces to motor counts, and the torques at the arms' axes that were asked of them.
pub fn force(table: &Table, kinematics: &Kinematics) -> Result<Vec<u8>, TableError> {
    table.with(&[PLACE, FORCE].concat(), &[MOTORS, TORQUES].concat(), |row| {
        let place = vector(row, PLACE, MAX_PLACE_M)?;
        let force = vector(row, FORCE, MAX_FORCE_N)?;
        let torques =
            kinematics.torques(place, force).map_err(|cause| row.refuse_row("x_m, y_m, z_m", cause))?;
        let motors = motor_counts(torques, kinematics.geometry().counts_per_nm);
        let torques = torques.to_array().map(|torque| format!("{torque:.12}"));
        Ok(motors.map(|count| count.to_string()).into_iter().chain(torques).collect())
    })
}

/// Packets of the device to what they say. What is no packet is not accepted, and says nothing.
pub fn decode(table: &Table) -> Result<Vec<u8>, TableError> {
    let added = ["accepted", ENCODERS[0], ENCODERS[1], ENCODERS[2], "homing_bits", "button_bits"];
    table.with(&["bytes_hex"], &added, |row| {
        let text = row.text("bytes_hex")?;
        let bytes = bytes(text)
            .ok_or_else(|| row.refuse("bytes_hex", text, "bytes of two hexadecimal digits each"))?;
        let packet: Option<&[u8; PACKET_BYTES]> = bytes.as_slice().try_into().ok();
        let Some(reply) = packet.and_then(Reply::decode) else {
            return Ok(["0", "", "", "", "", ""].map(str::to_owned).to_vec());
        };
        let [a, b, c] = reply.encoders.map(|count| count.to_string());
        Ok(vec!["1".into(), a, b, c, reply.homed.to_string(), reply.buttons.to_string()])
    })
}

/// Motor counts, lights and homing to packets for the device.
pub fn encode(table: &Table) -> Result<Vec<u8>, TableError> {
    let needs = [MOTORS[0], MOTORS[1], MOTORS[2], "led_mask", "homing"];
    table.with(&needs, &["bytes_hex"], |row| {
        let motors = counts(row, MOTORS)?;
        let mask = row.whole("led_mask", 0, 14_u8)?;
        let leds = Leds::from_mask(mask).ok_or_else(|| {
            row.refuse("led_mask", &mask.to_string(), "a sum of 2 (green), 4 (blue) and 8 (red)")
        })?;
        let homing = row.whole("homing", 0, 1_u8)? == 1;
        Ok(vec![hex(&Command { motors, homing, leds }.encode())])
    })
}

fn counts(row: &Row<'_>, columns: [&str; 3]) -> Result<[i16; 3], TableError> {
    let mut counts = [0; 3];
    for (count, column) in counts.iter_mut().zip(columns) {
        *count = row.whole(column, i16::MIN, i16::MAX)?;
    }
    Ok(counts)
}

/// Three numbers, each within ±`limit`.
pub fn vector(row: &Row<'_>, columns: [&str; 3], limit: f64) -> Result<DVec3, TableError> {
    let mut numbers = [0.0; 3];
    for (number, column) in numbers.iter_mut().zip(columns) {
        *number = row.number(column, limit)?;
    }
    Ok(DVec3::from_array(numbers))
}

/// The bytes of pairs of digits, with or without blanks between them.
fn bytes(text: &str) -> Option<Vec<u8>> {
    let digits: Vec<u32> =
        text.chars().filter(|c| !c.is_whitespace()).map(|c| c.to_digit(16)).collect::<Option<_>>()?;
    let pairs = digits.chunks(2);
    pairs.map(|pair| Some((pair.first()? * 16 + pair.get(1)?) as u8)).collect()
}

fn hex(bytes: &[u8]) -> String {
    bytes.iter().fold(String::new(), |mut text, byte| {
        let _ = write!(text, "{}{byte:02x}", if text.is_empty() { "" } else { " " });
        text
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_are_written_as_they_are_read() {
        assert_eq!(bytes("3c 41 Ff"), Some(vec![0x3C, 0x41, 0xFF]));
        assert_eq!(bytes("3c41"), bytes("3c 41"));
        assert_eq!(bytes(""), Some(vec![]));
        for text in ["3", "3c4", "zz", "3c,41"] {
            assert_eq!(bytes(text), None);
        }
        assert_eq!(hex(&[0x3C, 0, 0xAB]), "3c 00 ab");
    }
}
