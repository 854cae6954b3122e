//! A firmware image, checked before a byte of it is sent.
//!
//! It is an 8-bit boot stream of TI's C28x family (TMS320x281x Boot ROM Reference Guide, SPRU095): little-endian words;
//! 0x08AA, eight reserved ones, the entry address (high, low), then blocks {number of words, address (high, low),
//! words} up to a block without words. hapflow ships none: the user names a file.

use std::io::Read;
use std::ops::Range;
use std::path::Path;

/// Says that the stream is 8 bits wide.
const KEY: u16 = 0x08AA;
/// The DSP's memories that a program may be loaded to: M0 and M1, L0 and L1, H0.
const RAM: [Range<u32>; 3] = [0..0x800, 0x8000..0xA000, 0x3F_8000..0x3F_A000];
/// No image is longer than all of them, with a header.
const MAX_BYTES: u64 = 65_536;

/// Why a file is no firmware.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FirmwareError {
    /// The file cannot be read.
    #[error("firmware {file} cannot be read, {cause}: check the path")]
    Open {
        /// The file.
        file: String,
        /// What the system says.
        cause: String,
    },
    /// It is not built as an image is.
    #[error(
        "firmware {file}: {problem} at byte {at}; it must be a C28x 8-bit boot stream, as nvent_firmware.bin is"
    )]
    Structure {
        /// The file.
        file: String,
        /// What is wrong.
        problem: &'static str,
        /// Where, from 0.
        at: usize,
    },
}

/// An image that is built as it must be.
#[derive(Clone, Debug, PartialEq)]
pub struct Firmware {
    bytes: Vec<u8>,
    entry: u32,
    blocks: Vec<Range<u32>>,
}

impl Firmware {
    /// Reads and checks a file.
    ///
    /// # Errors
    /// [`FirmwareError`] with what is wrong, and where.
    pub fn load(path: &Path) -> Result<Self, FirmwareError> {
        let file = path.display().to_string();
        let mut bytes = Vec::new();
        std::fs::File::open(path)
            .and_then(|source| source.take(MAX_BYTES + 1).read_to_end(&mut bytes))
            .map_err(|cause| FirmwareError::Open { file: file.clone(), cause: cause.to_string() })?;
        Self::check(bytes).map_err(|(problem, at)| FirmwareError::Structure { file, problem, at })
    }

    /// Checks the bytes of an image.
    ///
    /// # Errors
    /// What is wrong, and at which byte.
    pub fn check(bytes: Vec<u8>) -> Result<Self, (&'static str, usize)> {
        if bytes.len() as u64 > MAX_BYTES {
            return Err(("it goes on", MAX_BYTES as usize));
        }
        let mut words = Words { bytes: &bytes, at: 0 };
        if words.next()? != KEY {
            return Err(("the key AA 08 is missing", 0));
        }
        for _ in 0..8 {
            words.next()?;
        }
        let entry = words.address()?;
        let mut blocks = Vec::new();
        while let Some(block) = words.block()? {
            blocks.push(block);
        }
        if words.at != bytes.len() {
            return Err(("bytes follow the end", words.at));
        }
        if !blocks.iter().any(|block| block.contains(&entry)) {
            return Err(("the entry address is in no block", 18));
        }
        Ok(Self { bytes, entry, blocks })
    }

    /// The image as it is sent.
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// Where the program begins.
    pub fn entry(&self) -> u32 {
        self.entry
    }

    /// The addresses that it fills.
    pub fn blocks(&self) -> &[Range<u32>] {
        &self.blocks
    }
}

struct Words<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl Words<'_> {
    fn next(&mut self) -> Result<u16, (&'static str, usize)> {
        let word = self.bytes.get(self.at..self.at + 2).ok_or(("it ends early", self.bytes.len()))?;
        self.at += 2;
        Ok(u16::from_le_bytes([word[0], word[1]]))
    }

    fn address(&mut self) -> Result<u32, (&'static str, usize)> {
        Ok(u32::from(self.next()?) << 16 | u32::from(self.next()?))
    }

    /// The addresses of the next block, whose words are passed over; nothing at the end.
    fn block(&mut self) -> Result<Option<Range<u32>>, (&'static str, usize)> {
        let at = self.at;
        let words = self.next()?;
        if words == 0 {
            return Ok(None);
        }
        let begin = self.address()?;
        let block = begin..begin.saturating_add(u32::from(words));
        if !RAM.iter().any(|ram| ram.start <= block.start && block.end <= ram.end) {
            return Err(("a block lies outside the memory", at));
        }
        for _ in 0..words {
            self.next()?;
        }
        Ok(Some(block))
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// An image with blocks of these numbers of words at these addresses; the first one is the entry.
    pub(crate) fn image(blocks: &[(u16, u32)]) -> Vec<u8> {
        let halves = |address: u32| [(address >> 16) as u16, address as u16];
        let mut words = vec![KEY];
        words.extend([0; 8]);
        words.extend(halves(blocks[0].1));
        for (count, address) in blocks {
            words.push(*count);
            words.extend(halves(*address));
            words.extend((0..*count).map(|n| n.wrapping_mul(40_503)));
        }
        words.push(0);
        words.into_iter().flat_map(u16::to_le_bytes).collect()
    }

    /// The blocks of the image that is in use, with its length.
    #[test]
    fn an_image_as_known_is_taken() {
        let blocks = [(3643, 0x3F_8002), (241, 0x3F_8E3D), (336, 0x93A2), (2, 0x3F_8000)];
        let firmware = Firmware::check(image(&blocks)).unwrap();
        assert_eq!(firmware.bytes().len(), 8492);
        assert_eq!(firmware.entry(), 0x3F_8002);
        assert_eq!(firmware.blocks()[2], 0x93A2..0x93A2 + 336);
    }

    #[test]
    fn what_is_wrong_is_named_with_its_place() {
        let sound = image(&[(4, 0x3F_8000)]);
        let refuse = |bytes: &[u8]| Firmware::check(bytes.to_vec()).unwrap_err();
        assert_eq!(refuse(b"not a firmware"), ("the key AA 08 is missing", 0));
        assert_eq!(refuse(&[sound.as_slice(), &[7]].concat()), ("bytes follow the end", sound.len()));
        for len in 2..sound.len() {
            assert_eq!(refuse(&sound[..len]), ("it ends early", len), "cut to {len}");
        }
        assert_eq!(refuse(&image(&[(4, 0x3F_9FFD)])).0, "a block lies outside the memory");
        let mut elsewhere = sound.clone();
        elsewhere[20] = 9;
        assert_eq!(refuse(&elsewhere), ("the entry address is in no block", 18));
        assert_eq!(refuse(&vec![0; 70_000]).0, "it goes on");
        let absent = Firmware::load(Path::new("/nowhere/firmware.bin")).unwrap_err().to_string();
        assert!(absent.starts_with("firmware /nowhere/firmware.bin cannot be read"), "{absent}");
    }
}
