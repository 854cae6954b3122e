//! Files that a user names, which may be anything.

use std::io::{Error, Read, Result};
use std::path::Path;

/// The bytes of a file, which may have at most `most`. Also of one without an end, as `/dev/zero` is.
///
/// # Errors
/// What the system says, or that it is longer.
pub fn read_at_most(path: &Path, most: u64) -> Result<Vec<u8>> {
    let mut bytes = Vec::new();
    std::fs::File::open(path)?.take(most + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most {
        return Err(Error::other(format!("it is longer than {most} bytes")));
    }
    Ok(bytes)
}

/// Likewise its text.
///
/// # Errors
/// As [`read_at_most`], or that it is not UTF-8.
pub fn read_text_at_most(path: &Path, most: u64) -> Result<String> {
    String::from_utf8(read_at_most(path, most)?).map_err(|_| Error::other("it is not UTF-8"))
}

/// A source whose lines may have at most so many bytes: what has no line ends fills no memory.
pub(crate) struct ShortLines<R> {
    source: R,
    most: usize,
    since_end: usize,
}

impl<R> ShortLines<R> {
    /// `source`, with lines of at most `most` bytes.
    pub(crate) fn new(source: R, most: usize) -> Self {
        Self { source, most, since_end: 0 }
    }
}

impl<R: Read> Read for ShortLines<R> {
    fn read(&mut self, buffer: &mut [u8]) -> Result<usize> {
        let len = self.source.read(buffer)?;
        for byte in &buffer[..len] {
            self.since_end = if *byte == b'\n' { 0 } else { self.since_end + 1 };
            if self.since_end > self.most {
                return Err(Error::other(format!("a line is longer than {} bytes", self.most)));
            }
        }
        Ok(len)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_too_long_is_refused() {
        let path = std::env::temp_dir().join(format!("hapflow-file-{}", std::process::id()));
        std::fs::write(&path, "four").unwrap();
        assert_eq!(read_text_at_most(&path, 4).unwrap(), "four");
        assert_eq!(read_at_most(&path, 3).unwrap_err().to_string(), "it is longer than 3 bytes");
        std::fs::write(&path, [0xFF]).unwrap();
        assert_eq!(read_text_at_most(&path, 4).unwrap_err().to_string(), "it is not UTF-8");
        std::fs::remove_file(path).unwrap();
    }

    #[test]
    fn lines_must_end() {
        let mut text = String::new();
        ShortLines::new(&b"abc\nde\n\nfgh"[..], 3).read_to_string(&mut text).unwrap();
        assert_eq!(text, "abc\nde\n\nfgh");
        let endless = std::io::repeat(0);
        assert!(ShortLines::new(endless, 1000).read_to_end(&mut Vec::new()).is_err());
    }
}
