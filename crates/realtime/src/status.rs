//! What the system granted a real-time thread, and what to do about what it refused.

use std::fmt;

use thiserror::Error;

/// Why the system refused something, in words that say what to do about it.
///
/// None of these is fatal: a thread goes on at ordinary priority, only later at times.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum Refusal {
    /// This system has real-time threads or memory locks, but not here yet; or it has none.
    #[error("not supported on this system")]
    NotSupported,
    /// The priority is not one of the system's real-time priorities.
    #[error("real-time priority {priority} is not in 1..=99")]
    OutOfRange {
        /// What was asked for.
        priority: u8,
    },
    /// The user may not have this priority.
    #[error(
        "real-time priority {priority} is not allowed: the limit (`ulimit -r`) is {limit}; add the line \
         `@realtime - rtprio {priority}` to /etc/security/limits.conf, join the group `realtime` and log in anew, or \
         give the program CAP_SYS_NICE"
    )]
    Priority {
        /// What was asked for.
        priority: u8,
        /// The highest priority that the user may have; 0: none.
        limit: u64,
    },
    /// The user may not lock all memory of the process.
    #[error(
        "locking all memory is not allowed: the limit (`ulimit -Hl`) is {limit_kib} KiB; add the line \
         `@realtime - memlock unlimited` to /etc/security/limits.conf, join the group `realtime` and log in anew"
    )]
    MemoryLimit {
        /// How much the user may lock, KiB.
        limit_kib: u64,
    },
    /// Another error of the system.
    #[error("the system refused: {}", std::io::Error::from_raw_os_error(*code))]
    System {
        /// The system's error number.
        code: i32,
    },
}

/// The answer of the system to one wish.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Grant {
    /// Nobody asked, as for a thread that a host owns.
    #[default]
    NotAsked,
    /// The system complied.
    Granted,
    /// The system did not comply; all goes on without.
    Refused(Refusal),
}

impl Grant {
    /// Whether the system complied.
    #[must_use]
    pub fn is_granted(&self) -> bool {
        *self == Self::Granted
    }
}

impl From<Result<(), Refusal>> for Grant {
    fn from(answer: Result<(), Refusal>) -> Self {
        match answer {
            Ok(()) => Self::Granted,
            Err(refusal) => Self::Refused(refusal),
        }
    }
}

impl fmt::Display for Grant {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotAsked => f.write_str("not asked for"),
            Self::Granted => f.write_str("granted"),
            Self::Refused(refusal) => write!(f, "refused: {refusal}"),
        }
    }
}

/// How real-time a thread is; for reports.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct RealtimeStatus {
    /// Of the thread. Set by [`spawn_realtime`](crate::spawn_realtime).
    pub priority: Grant,
    /// Of the whole process. Set by the owner of the threads, who calls [`lock_memory`](crate::lock_memory) once.
    pub memory: Grant,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn refusals_say_what_to_do() {
        let text = Grant::from(Err(Refusal::Priority { priority: 60, limit: 0 })).to_string();
        assert!(
            text.starts_with(
                "refused: real-time priority 60 is not allowed: the limit (`ulimit -r`) is 0; add"
            )
        );
        assert!(text.contains("`@realtime - rtprio 60` to /etc/security/limits.conf, join"));
        assert_eq!(Grant::from(Ok(())).to_string(), "granted");
    }

    #[test]
    fn at_first_nothing_was_asked() {
        let status = RealtimeStatus::default();
        assert_eq!(status.priority, Grant::NotAsked);
        assert!(!status.memory.is_granted());
    }
}
