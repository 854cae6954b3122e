//! What differs between operating systems: one file each, all with the same functions.

#[cfg(target_os = "linux")]
mod linux;
#[cfg(target_os = "linux")]
pub(crate) use linux::*;

#[cfg(not(target_os = "linux"))]
mod other;
#[cfg(not(target_os = "linux"))]
pub(crate) use other::*;

#[cfg(unix)]
#[path = "os/signals.rs"]
mod stop;
#[cfg(windows)]
#[path = "os/console.rs"]
mod stop;
#[cfg(not(any(unix, windows)))]
#[path = "os/no_stop.rs"]
mod stop;
pub(crate) use stop::catch_stop;
