//! What goes over the wire once the firmware runs: 16 bytes there, 16 bytes back.
//!
//! `<`, fourteen bytes of value + 0x41, `>`. Numbers are 16-bit two's complement in four of them, the least nibble
//! first. Then a byte of bits, and one without a known meaning.

/// Bytes of a packet, either way.
pub const PACKET_BYTES: usize = 16;

const BEGIN: u8 = b'<';
const END: u8 = b'>';
/// The inner bytes' zero.
const ZERO: u8 = b'A';

/// Lights of the ring, any of three.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Leds(u8);

impl Leds {
    /// Dark.
    pub const NONE: Self = Self(0);
    /// Green.
    pub const GREEN: Self = Self(0x02);
    /// Blue.
    pub const BLUE: Self = Self(0x04);
    /// Red.
    pub const RED: Self = Self(0x08);

    /// The lights of this mask: green 2, blue 4, red 8; nothing for any other bit.
    pub const fn from_mask(mask: u8) -> Option<Self> {
        if mask & !0x0E == 0 { Some(Self(mask)) } else { None }
    }

    /// Their mask.
    pub const fn mask(self) -> u8 {
        self.0
    }
}

/// From the host to the device.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Command {
    /// Motors: top, right, left, as seen from the front. A positive count pulls its arm in.
    pub motors: [i16; 3],
    /// The arms are to find their marks.
    pub homing: bool,
    /// Lights.
    pub leds: Leds,
}

impl Command {
    /// As bytes.
    pub fn encode(&self) -> [u8; PACKET_BYTES] {
        frame(self.motors, self.leds.0 | u8::from(self.homing))
    }

    /// From bytes; nothing if they are no command.
    pub fn decode(bytes: &[u8; PACKET_BYTES]) -> Option<Self> {
        let (motors, bits) = unframe(bytes)?;
        Some(Self { motors, homing: bits & 1 != 0, leds: Leds::from_mask(bits & !1)? })
    }
}

/// From the device to the host.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Reply {
    /// Encoders: top, right, left. Counts grow as their arm goes out.
    pub encoders: [i16; 3],
    /// Arms that have found their marks: bit 0 top, 1 right, 2 left.
    pub homed: u8,
    /// Buttons that are down: bit 0 plus, 1 forward, 2 centre, 3 minus.
    pub buttons: u8,
}

impl Reply {
    /// All arms have found their marks.
    pub const HOMED: u8 = 7;

    /// From bytes; nothing if they are no reply. The last inner byte may be anything: nobody knows what it means.
    pub fn decode(bytes: &[u8; PACKET_BYTES]) -> Option<Self> {
        let (encoders, bits) = unframe(bytes)?;
        (bits <= 0x7F).then_some(Self { encoders, homed: bits >> 4, buttons: bits & 15 })
    }

    /// As bytes. Of `homed` three bits are taken, of `buttons` four.
    pub fn encode(&self) -> [u8; PACKET_BYTES] {
        frame(self.encoders, (self.homed & 7) << 4 | self.buttons & 15)
    }
}

fn frame(numbers: [i16; 3], bits: u8) -> [u8; PACKET_BYTES] {
    let mut bytes = [ZERO; PACKET_BYTES];
    bytes[0] = BEGIN;
    for (four, number) in bytes[1..13].chunks_exact_mut(4).zip(numbers) {
        for (n, byte) in four.iter_mut().enumerate() {
            *byte = ZERO + (number >> (4 * n) & 15) as u8;
        }
    }
    bytes[13] = ZERO + bits;
    bytes[15] = END;
    bytes
}

fn unframe(bytes: &[u8; PACKET_BYTES]) -> Option<([i16; 3], u8)> {
    if bytes[0] != BEGIN || bytes[15] != END {
        return None;
    }
    let mut numbers = [0; 3];
    for (number, four) in numbers.iter_mut().zip(bytes[1..13].chunks_exact(4)) {
        for (n, byte) in four.iter().enumerate() {
            let nibble = byte.checked_sub(ZERO).filter(|nibble| *nibble < 16)?;
            *number |= i16::from(nibble) << (4 * n);
        }
    }
    Some((numbers, bytes[13].checked_sub(ZERO)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_number_comes_back() {
        for number in i16::MIN..=i16::MAX {
            let motors = [number, number.wrapping_add(77), !number];
            let command = Command { motors, homing: number & 1 == 0, leds: Leds::RED };
            assert_eq!(Command::decode(&command.encode()), Some(command));
            let reply = Reply { encoders: motors, homed: 5, buttons: 9 };
            assert_eq!(Reply::decode(&reply.encode()), Some(reply));
        }
    }

    #[test]
    fn every_bit_comes_back() {
        for bits in 0..=127 {
            let reply = Reply { encoders: [1, -2, 3], homed: bits >> 4, buttons: bits & 15 };
            assert_eq!(Reply::decode(&reply.encode()), Some(reply));
        }
        for mask in 0..=255 {
            let leds = Leds::from_mask(mask);
            assert_eq!(leds.is_some(), mask < 16 && mask % 2 == 0);
            for homing in [false, true] {
                let command = Command { motors: [0; 3], homing, leds: leds.unwrap_or_default() };
                assert_eq!(Command::decode(&command.encode()), Some(command));
            }
        }
    }

    #[test]
    fn a_byte_outside_its_range_is_refused() {
        let sound = Reply { encoders: [0, 16, -1], homed: 7, buttons: 15 }.encode();
        for (at, low, high) in
            (1..13).map(|at| (at, 0x41, 0x50)).chain([(0, 0x3C, 0x3C), (13, 0x41, 0xC0), (15, 0x3E, 0x3E)])
        {
            for byte in 0..=255 {
                let mut bytes = sound;
                bytes[at] = byte;
                assert_eq!(
                    Reply::decode(&bytes).is_some(),
                    (low..=high).contains(&byte),
                    "byte {at} = {byte:#x}"
                );
            }
        }
        for byte in 0..=255 {
            let mut bytes = sound;
            bytes[14] = byte;
            assert!(Reply::decode(&bytes).is_some());
        }
    }
}
