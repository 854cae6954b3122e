//! From what was found to a [`Check`]: all thresholds and all advice. Nothing here asks the system.

use super::check::{Check, NOT_KNOWN, on_linux};
use super::timer::Lateness;
use hapflow_devices::falcon::{UDEV_RULE, UDEV_RULE_FILE};
use hapflow_realtime::{Grant, Refusal};
use std::path::{Path, PathBuf};

/// The version of the C ABI, `HAPFLOW_ABI_VERSION` in `include/hapflow/version.h`.
pub const C_ABI: u32 = 1;
/// Ticks later than this at 99 % are a warning, µs: half a tick, which a run counts as late.
const LATE_US: f64 = 500.0;
/// Vendor and product of the Novint Falcon.
pub const FALCON: (u16, u16) = (0x0403, 0xcb48);
/// What is missing where there is no Falcon.
const NO_FALCON: &str = "nothing to do: without a Falcon the simulated hand feels";
/// Makes and joins the group that the lines for `limits.conf` are about.
const JOIN: &str = "run `sudo groupadd -rf realtime` and `sudo usermod -aG realtime $USER`, log in anew";

/// What the system says of itself.
#[derive(Debug, Default)]
pub struct System {
    /// The name of the distribution or operating system.
    pub os: Option<String>,
    /// The kernel's release.
    pub kernel: Option<String>,
    /// Whether the kernel is built for real time.
    pub realtime_kernel: bool,
    /// Whether this is inside a container, whose host sets the limits.
    pub container: bool,
}

/// Versions; never wrong.
pub fn versions(system: &System) -> Check {
    let os = system.os.as_deref().unwrap_or(std::env::consts::OS);
    let kernel = system.kernel.as_deref().unwrap_or(NOT_KNOWN);
    let kind = if system.realtime_kernel { " (PREEMPT_RT)" } else { "" };
    let hapflow = env!("CARGO_PKG_VERSION");
    let machine = std::env::consts::ARCH;
    Check::ok("versions", format!("hapflow {hapflow}, C ABI {C_ABI}, {os}, {machine}, kernel {kernel}{kind}"))
}

/// Cores that this process may use.
pub fn cores(cores: Option<usize>) -> Check {
    match cores {
        None => Check::ok("cores", NOT_KNOWN),
        Some(n) if n >= 2 => Check::ok("cores", format!("{n}: one for the servo, the rest for the fluid")),
        Some(n) => Check::warning(
            "cores",
            format!("{n}: servo and fluid share it, so a run with --realtime has late ticks"),
            on_linux(
                "give this process two or more: see `nproc --all` and `taskset -p $$`, and the processors of a virtual \
                 machine or container; without --realtime one is enough",
            ),
        ),
    }
}

/// The vectors that the fluid computes in; `level` is pulp's word for them.
pub fn simd(level: &str) -> Check {
    let lanes = match level {
        "V4" => "AVX-512, 16 lanes",
        "V3" => "AVX2 and FMA, 8 lanes",
        "Neon" => "NEON, 4 lanes",
        "Simd128" | "RelaxedSimd" => "WebAssembly SIMD, 4 lanes",
        "Scalar" => {
            return Check::warning(
                "simd",
                "none that hapflow uses: the fluid is some four times slower",
                "use a processor with AVX2 and FMA, or NEON; in a virtual machine pass the host's processor on \
                 (QEMU: `-cpu host`)",
            );
        }
        other => other,
    };
    Check::ok("simd", lanes)
}

/// The priority of the servo's thread; `program` is this program's file.
pub fn priority(priority: u8, grant: &Grant, container: bool, program: Option<&Path>) -> Check {
    let refusal = match grant {
        Grant::Granted => {
            return Check::ok("priority", format!("real-time priority {priority} granted to the servo"));
        }
        Grant::NotAsked => {
            return Check::warning(
                "priority",
                "not tried, for want of a thread",
                "see to the check `timer` first",
            );
        }
        Grant::Refused(refusal) => refusal,
    };
    match refusal {
        Refusal::Priority { limit, .. } => {
            let found = format!("real-time priority {priority} refused; the limit (`ulimit -r`) is {limit}");
            Check::warning("priority", found, allow_priority(priority, *limit, container, program))
        }
        Refusal::NotSupported => Check::warning("priority", NOT_KNOWN, NOT_KNOWN),
        other => Check::warning(
            "priority",
            format!("real-time priority {priority} refused: {other}"),
            on_linux("a sandbox may forbid it: run hapflow outside of it, or see `man 7 sched`"),
        ),
    }
}

/// How a user comes by a priority. A limit that is high enough does not help where a control group has no share of
/// real time.
fn allow_priority(priority: u8, limit: u64, container: bool, program: Option<&Path>) -> String {
    if container {
        return on_linux(format!("start the container with `--cap-add SYS_NICE --ulimit rtprio={priority}`"));
    }
    if limit >= u64::from(priority) {
        return on_linux(
            "the limit would do, so a control group or sandbox forbids it: run hapflow outside of it",
        );
    }
    let program = program.map_or_else(|| "hapflow".into(), |p| shell_word(&p.display().to_string()));
    on_linux(format!(
        "add the line `@realtime - rtprio {priority}` to /etc/security/limits.conf, {JOIN}; or, until this file is \
         replaced, `sudo setcap cap_sys_nice=ep {program}`"
    ))
}

/// A file's name as a word of a shell command.
fn shell_word(name: &str) -> String {
    let plain = |c: char| c.is_alphanumeric() || "/._-+".contains(c);
    if name.chars().all(plain) { name.into() } else { format!("'{}'", name.replace('\'', r"'\''")) }
}

/// Locking all memory; `limit` is what `ulimit -l` says.
pub fn memory(grant: &Grant, limit: Option<&str>, container: bool) -> Check {
    let limit = limit.map(|l| format!("; the limit (`ulimit -l`) is {l}")).unwrap_or_default();
    let Grant::Refused(refusal) = grant else {
        return Check::ok("memory", format!("may be locked into RAM{limit}"));
    };
    match refusal {
        Refusal::MemoryLimit { .. } => {
            let advice = if container {
                "start the container with `--ulimit memlock=-1`".into()
            } else {
                format!("add the line `@realtime - memlock unlimited` to /etc/security/limits.conf, {JOIN}")
            };
            let found = format!("may not be locked into RAM, so swapping makes ticks late{limit}");
            Check::warning("memory", found, on_linux(advice))
        }
        Refusal::NotSupported => Check::warning("memory", NOT_KNOWN, NOT_KNOWN),
        other => Check::warning(
            "memory",
            format!("may not be locked into RAM: {other}{limit}"),
            on_linux("see `man 2 mlockall` for this error"),
        ),
    }
}

/// A 1 kHz loop on a thread that had real-time priority or not; or why there was no thread.
pub fn timer(measured: &Result<(Lateness, bool), String>) -> Check {
    let (late, realtime) = match measured {
        Ok(measured) => *measured,
        Err(cause) => {
            let advice = on_linux("see `ulimit -u` for the limit on threads, and end other programs");
            return Check::missing("timer", format!("no thread could be started: {cause}"), advice);
        }
    };
    let at = if realtime { "real-time" } else { "ordinary" };
    let found = format!(
        "1 kHz at {at} priority: late by {} µs median, {} µs at 99 %, {} µs at worst",
        us(late.median_us),
        us(late.p99_us),
        us(late.worst_us)
    );
    if late.p99_us <= LATE_US {
        return Check::ok("timer", found);
    }
    let advice = if realtime {
        "end other real-time programs, take the processor out of power saving, or use a kernel with PREEMPT_RT; a \
         virtual machine may never do better"
    } else {
        "see to the check `priority` first; else end other programs"
    };
    Check::warning("timer", found, on_linux(advice))
}

/// A time to two digits or to the microsecond.
fn us(us: f64) -> String {
    if us < 9.95 { format!("{us:.1}") } else { format!("{us:.0}") }
}

/// Who chooses the processor's frequency: cpufreq's governor and driver.
pub fn governor(governor: Option<&str>, driver: Option<&str>) -> Check {
    let Some(governor) = governor else {
        return Check::ok("governor", on_linux("none in sight, as in a virtual machine"));
    };
    let driver = driver.map(|d| format!(" ({d})")).unwrap_or_default();
    if governor != "powersave" {
        return Check::ok("governor", format!("{governor}{driver}"));
    }
    Check::warning(
        "governor",
        format!("powersave{driver}: the processor may wake slowly"),
        on_linux("`echo performance | sudo tee /sys/devices/system/cpu/cpu*/cpufreq/scaling_governor`"),
    )
}

/// A Falcon that is plugged in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Falcon {
    /// Its device file.
    pub node: PathBuf,
    /// Why this user cannot open it for writing, if so.
    pub refused: Option<String>,
}

/// What there is of USB.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Usb {
    /// No `/dev/bus/usb`.
    Absent,
    /// It cannot be listed, and why.
    Unreadable(String),
    /// It can.
    Readable {
        /// Devices, hubs too.
        devices: usize,
        /// The first Falcon among them.
        falcon: Option<Falcon>,
    },
}

/// Access to USB, where haptic devices are.
pub fn usb(usb: &Usb) -> Check {
    let falcon = match usb {
        Usb::Absent => {
            let found = on_linux("no /dev/bus/usb, as in a container");
            return Check::ok("usb", found).and(NO_FALCON);
        }
        Usb::Unreadable(cause) => {
            let advice = "for a Falcon: `sudo chmod a+rx /dev/bus/usb /dev/bus/usb/*`".to_owned();
            return Check::warning("usb", format!("/dev/bus/usb cannot be read: {cause}"), on_linux(advice));
        }
        Usb::Readable { devices, falcon: None } => {
            let found = format!("/dev/bus/usb readable; {devices} devices, no Novint Falcon (0403:cb48)");
            return Check::ok("usb", found).and(NO_FALCON);
        }
        Usb::Readable { falcon: Some(falcon), .. } => falcon,
    };
    let node = falcon.node.display();
    match &falcon.refused {
        None => Check::ok("usb", format!("Novint Falcon at {node}, writable"))
            .and("`hapflow falcon test` tries it, docs/falcon.md says more"),
        Some(cause) => Check::warning(
            "usb",
            format!("Novint Falcon at {node}, not writable: {cause}"),
            on_linux(format!(
                "run `sudo hapflow falcon udev`, which puts `{UDEV_RULE}` into {UDEV_RULE_FILE}, then `sudo udevadm \
                 control --reload`, and plug it in anew"
            )),
        ),
    }
}

/// Graphics processors, each with its driver if known; none is needed.
pub fn gpu(nodes: &[(String, Option<String>)]) -> Check {
    let name = |(node, driver): &(String, Option<String>)| match driver {
        Some(driver) => format!("{node} ({driver})"),
        None => node.clone(),
    };
    let found = match nodes {
        [] => on_linux("none in /dev/dri"),
        nodes => nodes.iter().map(name).collect::<Vec<_>>().join(", "),
    };
    Check::ok("gpu", found).and("nothing to do: this build computes on the CPU")
}

/// The folder that runs write into unless told otherwise; `refused` says why it cannot be written.
pub fn output(folder: &Path, refused: Option<&str>) -> Check {
    let folder = folder.display();
    match refused {
        None => Check::ok("output", format!("{folder} can be written")),
        Some(cause) => Check::missing(
            "output",
            format!("{folder} cannot be written: {cause}"),
            format!("go to another folder, choose one with `hapflow run --out DIR`, or {}", allow_writing()),
        ),
    }
}

/// How a user comes by the right to write.
fn allow_writing() -> &'static str {
    if cfg!(target_os = "linux") {
        "take a look at `ls -ld . out` and `df -h .`"
    } else {
        "change its permissions"
    }
}

#[cfg(test)]
mod tests;
