//! Reads what Linux writes into `/proc`, `/sys` and `/etc`. Nothing here opens a file.

use std::path::{Path, PathBuf};

/// The trimmed text, if there is any.
pub fn word(text: &str) -> Option<String> {
    Some(text.trim()).filter(|w| !w.is_empty()).map(Into::into)
}

/// The name for people in `/etc/os-release` (`os-release(5)`).
pub fn os_name(os_release: &str) -> Option<String> {
    value(os_release, "PRETTY_NAME").and_then(|v| word(v.trim_matches(['"', '\''])))
}

/// The driver in the `uevent` file of a device.
pub fn driver(uevent: &str) -> Option<String> {
    value(uevent, "DRIVER").and_then(word)
}

/// Whether the text of `/proc/version` is that of a real-time kernel.
pub fn is_realtime_kernel(version: &str) -> bool {
    version.split_whitespace().any(|w| w == "PREEMPT_RT")
}

/// The value in the first line `key=value`.
fn value<'a>(text: &'a str, key: &str) -> Option<&'a str> {
    text.lines().find_map(|line| line.trim().strip_prefix(key)?.strip_prefix('=')).map(str::trim)
}

/// How much memory may be locked, in the words of `ulimit -l`: KiB or `unlimited`; from `/proc/self/limits`.
pub fn memory_limit(limits: &str) -> Option<String> {
    let soft = limits.lines().find_map(|l| l.strip_prefix("Max locked memory"))?.split_whitespace().next()?;
    match soft.parse::<u64>() {
        Ok(bytes) => Some(format!("{} KiB", bytes / 1024)),
        Err(_) => word(soft),
    }
}

/// A vendor's or product's number in an `idVendor` or `idProduct` file: four hexadecimal digits.
pub fn usb_id(text: &str) -> Option<u16> {
    u16::from_str_radix(text.trim(), 16).ok()
}

/// The device file of a USB device, from its `busnum` and `devnum` files.
pub fn usb_node(dev: &Path, busnum: &str, devnum: &str) -> Option<PathBuf> {
    let number = |text: &str| text.trim().parse::<u16>().ok();
    Some(dev.join(format!("{:03}", number(busnum)?)).join(format!("{:03}", number(devnum)?)))
}

/// The vector level in the name that pulp gives its choice, such as `V3` of `V3(V3 { .. })`.
pub fn simd_level(arch: &str) -> &str {
    arch.split(|c: char| !c.is_ascii_alphanumeric()).next().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn os_release_with_and_without_quotes() {
        let text = "NAME=\"Debian GNU/Linux\"\nPRETTY_NAME=\"Debian GNU/Linux 12 (bookworm)\"\n";
        assert_eq!(os_name(text).as_deref(), Some("Debian GNU/Linux 12 (bookworm)"));
        assert_eq!(os_name("PRETTY_NAME=Arch\n").as_deref(), Some("Arch"));
        assert_eq!(os_name("PRETTY_NAME=\"\"\n"), None);
        assert_eq!(os_name("PRETTY_NAMES=x\n"), None);
    }

    #[test]
    fn a_driver_is_in_its_uevent() {
        assert_eq!(driver("DRIVER=i915\nPCI_CLASS=30000\n").as_deref(), Some("i915"));
        assert_eq!(driver("PCI_CLASS=30000\n"), None);
    }

    #[test]
    fn a_realtime_kernel_says_so() {
        assert!(is_realtime_kernel("Linux version 6.12.1 (a@b) #1 SMP PREEMPT_RT Mon"));
        assert!(!is_realtime_kernel("Linux version 6.12.1 (a@b) #1 SMP PREEMPT_DYNAMIC Mon"));
    }

    #[test]
    fn limits_in_the_words_of_ulimit() {
        let head = "Limit                     Soft Limit           Hard Limit           Units     \n";
        let line = |soft: &str| format!("{head}Max locked memory         {soft}   8388608   bytes     \n");
        assert_eq!(memory_limit(&line("8388608")).as_deref(), Some("8192 KiB"));
        assert_eq!(memory_limit(&line("unlimited")).as_deref(), Some("unlimited"));
        assert_eq!(memory_limit(head), None);
        assert_eq!(memory_limit("Max locked memory"), None);
    }

    #[test]
    fn usb_numbers_and_files() {
        assert_eq!(usb_id("0403\n"), Some(0x0403));
        assert_eq!(usb_id("cb48\n"), Some(0xcb48));
        assert_eq!(usb_id("nothing"), None);
        let node = |bus, dev| usb_node(Path::new("/dev/bus/usb"), bus, dev);
        assert_eq!(node("1\n", "12\n"), Some(PathBuf::from("/dev/bus/usb/001/012")));
        assert_eq!(node("", "12\n"), None);
        assert_eq!(node("../1", "12\n"), None);
    }

    #[test]
    fn the_vector_level_is_the_first_word() {
        assert_eq!(simd_level("V3(V3 { sse: .. })"), "V3");
        assert_eq!(simd_level("Scalar"), "Scalar");
        assert_eq!(simd_level(""), "");
    }
}
