//! Bytes as they come, from which packets are picked.

use crate::falcon::PACKET_BYTES;

/// More than two full USB packets of payload.
const CAPACITY: usize = 256;

/// A stream of bytes in which packets are found wherever they begin: bytes that are lost, added or changed cost the
/// packets that they are in, and no more. Allocates nothing.
#[derive(Clone, Debug)]
pub struct ByteStream {
    bytes: [u8; CAPACITY],
    len: usize,
    dropped: u64,
}

impl Default for ByteStream {
    fn default() -> Self {
        Self { bytes: [0; CAPACITY], len: 0, dropped: 0 }
    }
}

impl ByteStream {
    /// Takes bytes; where there is no room, the oldest go.
    pub fn push(&mut self, bytes: &[u8]) {
        for part in bytes.chunks(CAPACITY) {
            let over = (self.len + part.len()).saturating_sub(CAPACITY);
            self.drop_front(over, over);
            self.bytes[self.len..self.len + part.len()].copy_from_slice(part);
            self.len += part.len();
        }
    }

    /// The next packet that `decode` takes; what stands before it is dropped, and counted.
    pub fn next<T>(&mut self, decode: impl Fn(&[u8; PACKET_BYTES]) -> Option<T>) -> Option<T> {
        let windows = self.bytes[..self.len].windows(PACKET_BYTES);
        let found = windows.enumerate().find_map(|(at, w)| Some((at, decode(w.try_into().ok()?)?)));
        let Some((at, packet)) = found else {
            // The last bytes may be the beginning of one.
            let hopeless = self.len.saturating_sub(PACKET_BYTES - 1);
            self.drop_front(hopeless, hopeless);
            return None;
        };
        self.drop_front(at + PACKET_BYTES, at);
        Some(packet)
    }

    /// Forgets what it holds.
    pub fn clear(&mut self) {
        self.len = 0;
    }

    /// Bytes so far that belonged to no packet.
    pub fn dropped(&self) -> u64 {
        self.dropped
    }

    /// Takes `count` bytes from the front, of which `lost` are to no use.
    fn drop_front(&mut self, count: usize, lost: usize) {
        self.bytes.copy_within(count..self.len, 0);
        self.len -= count;
        self.dropped += lost as u64;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::falcon::Reply;

    fn reply(n: i16) -> Reply {
        Reply { encoders: [n, -n, 3 * n], homed: 7, buttons: (n & 15) as u8 }
    }

    fn all(stream: &mut ByteStream) -> Vec<Reply> {
        std::iter::from_fn(|| stream.next(Reply::decode)).collect()
    }

    #[test]
    fn packets_come_out_however_they_are_cut() {
        let bytes: Vec<u8> = (0..9).flat_map(|n| reply(n).encode()).collect();
        for cut in 1..bytes.len() {
            let (mut stream, mut found) = (ByteStream::default(), Vec::new());
            for part in bytes.chunks(cut) {
                stream.push(part);
                found.extend(all(&mut stream));
            }
            assert_eq!(found, (0..9).map(reply).collect::<Vec<_>>());
            assert_eq!(stream.dropped(), 0);
        }
    }

    #[test]
    fn a_lost_byte_costs_its_packet_and_no_more() {
        let bytes: Vec<u8> = (0..5).flat_map(|n| reply(n).encode()).collect();
        for at in 16..32 {
            let mut spoilt = bytes.clone();
            spoilt.remove(at);
            let mut stream = ByteStream::default();
            stream.push(&spoilt);
            assert_eq!(all(&mut stream), [0, 2, 3, 4].map(reply), "without byte {at}");
            assert_eq!(stream.dropped(), 15);
        }
    }

    #[test]
    fn noise_between_packets_is_dropped() {
        let mut stream = ByteStream::default();
        stream.push(b"<<<>A<");
        stream.push(&reply(4).encode());
        stream.push(&[0xFF; 700]);
        assert_eq!(all(&mut stream), []);
        stream.push(&reply(5).encode());
        assert_eq!(all(&mut stream), [reply(5)]);
        assert_eq!(stream.dropped(), 6 + 16 + 700);
        stream.push(b"<AA");
        stream.clear();
        stream.push(&reply(6).encode());
        assert_eq!(all(&mut stream), [reply(6)]);
    }
}
