//! Commands and replies over the line.

use crate::falcon::serial::SerialLine;
use crate::falcon::{ByteStream, Command, LinkError, Reply};

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

    /// The newest reply that has come; where none has, the next that comes until `deadline_ns`.
    pub fn reply(&mut self, deadline_ns: u64) -> Result<Option<Reply>, LinkError> {
        loop {
            let mut newest = None;
            while let Some(reply) = self.stream.next(Reply::decode) {
                newest = Some(reply);
            }
            if newest.is_some() || self.line.now_ns() >= deadline_ns {
                return Ok(newest);
            }
            let bytes = self.line.read(deadline_ns)?;
            self.stream.push(bytes);
        }
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
