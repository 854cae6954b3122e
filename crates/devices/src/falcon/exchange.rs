//! Commands and replies over the line.

use crate::falcon::serial::SerialLine;
use crate::falcon::{ByteStream, Command, LinkError, Reply};

/// No more packets than this have come already when a deadline is over: the transport holds fewer. What comes after them is noise
/// that does not end.
const WAITING_PACKETS: u32 = 8;

/// The line to a firmware that runs. It answers each command, and says nothing by itself.
pub struct Exchange {
    pub line: SerialLine,
    stream: ByteStream,
}

impl Exchange {
    pub fn new(line: SerialLine) -> Self {
        Self { line, stream: ByteStream::default() }
    }

    /// Bytes so far that belonged to no reply.
    pub fn dropped_bytes(&self) -> u64 {
        self.stream.dropped()
    }

    /// Sends a command.
    pub fn send(&mut self, command: &Command) -> Result<(), LinkError> {
        self.line.write(&command.encode())
    }

    /// The newest reply that has come, however long ago; where none has, the next that comes until `deadline_ns`.
    pub fn reply(&mut self, deadline_ns: u64) -> Result<Option<Reply>, LinkError> {
        let mut late = 0;
        while late <= WAITING_PACKETS {
            let bytes = self.line.read(deadline_ns)?;
            if bytes.is_empty() {
                break;
            }
            self.stream.push(bytes);
            let replies = std::iter::from_fn(|| self.stream.next(Reply::decode));
            if let Some(newest) = replies.last() {
                return Ok(Some(newest));
            }
            late += u32::from(self.line.now_ns() >= deadline_ns);
        }
        Ok(None)
    }

    /// Lets everything pass that comes within `for_ns`.
    pub fn drain(&mut self, for_ns: u64) -> Result<(), LinkError> {
        let until = self.line.now_ns() + for_ns;
        while self.line.now_ns() < until {
            self.line.read(until)?;
        }
        self.stream.clear();
        Ok(())
    }
}
