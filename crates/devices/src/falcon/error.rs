//! What a Falcon cannot do, and what a person can do about it.

use crate::falcon::{FirmwareError, GeometryError, LinkError};

/// The rule with which Linux lets its users have a Falcon.
pub const UDEV_RULE: &str = "SUBSYSTEM==\"usb\", ATTR{idVendor}==\"0403\", ATTR{idProduct}==\"cb48\", MODE=\"0660\", GROUP=\"plugdev\", TAG+=\"uaccess\"";

/// Where that rule belongs.
pub const UDEV_RULE_FILE: &str = "/etc/udev/rules.d/70-novint-falcon.rules";

/// A stage of the start, as it is named in errors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// The supervisor at 9600 baud is to answer.
    Handshake,
    /// The DSP's boot loader is to find the line's speed.
    Autobaud,
    /// The image is sent, and comes back as an echo.
    Image {
        /// Bytes that came back right.
        echoed: usize,
        /// Bytes of the image.
        of: usize,
    },
    /// The firmware is to answer.
    Start,
}

impl std::fmt::Display for Stage {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Handshake => f.write_str("handshake (9600 baud)"),
            Self::Autobaud => f.write_str("autobaud (boot loader)"),
            Self::Image { echoed, of } => write!(f, "image ({echoed} of {of} bytes came back right)"),
            Self::Start => f.write_str("start (the image is loaded, but does not answer)"),
        }
    }
}

/// Why a Falcon was refused or lost. Each text says what a person can do.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FalconError {
    /// The system has no USB.
    #[error("no USB here, {cause}: a virtual machine or container must be given its host's USB devices")]
    NoUsb {
        /// What the system says.
        cause: String,
    },
    /// No Falcon, or none with that serial number.
    #[error("no Falcon found{}: plug in its USB cable; `hapflow falcon info` lists those that there are", with_serial(.serial))]
    NotFound {
        /// The serial number that was asked for.
        serial: Option<String>,
    },
    /// The system does not let this user have it.
    #[error(
        "no permission to use the Falcon: `sudo hapflow falcon udev` writes {UDEV_RULE_FILE} with the rule \
         {UDEV_RULE}; then unplug the USB cable and plug it in again"
    )]
    NoPermission,
    /// Another program has it, or on Windows another driver.
    #[error(
        "the Falcon is in use: end the other program that uses it; on Windows bind WinUSB to it (with Zadig)"
    )]
    Busy,
    /// It cannot be opened for another reason.
    #[error("the Falcon cannot be opened, {cause}: unplug its USB cable and plug it in again")]
    Open {
        /// What the system says.
        cause: String,
    },
    /// It was just plugged in, and no firmware was named.
    #[error(
        "the Falcon has no firmware yet: load one with `hapflow falcon firmware FILE`, or name it with \
         `--set falcon.firmware=FILE`; it keeps it until it is unplugged"
    )]
    NoFirmware,
    /// The file is no firmware.
    #[error(transparent)]
    Firmware(#[from] FirmwareError),
    /// The parameter set cannot be used.
    #[error(transparent)]
    Geometry(#[from] GeometryError),
    /// The firmware could not be loaded.
    #[error(
        "firmware not accepted at stage {stage}, in {attempts} attempts, {cause}: unplug USB and supply, plug both in \
         again, without a hub or with another one, and try again"
    )]
    NotAccepted {
        /// Where the last attempt ended.
        stage: Stage,
        /// How many there were.
        attempts: u32,
        /// What happened there.
        cause: &'static str,
    },
    /// It answers, but its arms stand still.
    #[error(
        "the Falcon answers but never homes, its encoders stand still: check the 30 V supply and its plug, then pull the \
         grip all the way out and push it straight in"
    )]
    NeverHomes,
    /// All marks are found, but nobody can hold the grip where its counts say.
    #[error(
        "the Falcon is homed, but no pose has its encoder counts: check the lengths and zero angles of falcon.geometry (--geometry)"
    )]
    NoPose,
    /// The user did not want to wait.
    #[error("stopped before the Falcon was homed")]
    Stopped,
    /// It is used before [`prepare`](crate::HapticDevice::prepare).
    #[error("the Falcon is not homed yet: prepare it first")]
    NotReady,
    /// While the motors carried the grip it was drawn off its path.
    #[error("the grip got away: hold it in the middle of its room, let go of it gently, and start again")]
    GotAway,
    /// It has forgotten its marks.
    #[error("the Falcon has lost its homing: check the 30 V supply, and home it again")]
    Unhomed,
    /// It does not answer any more.
    #[error("the Falcon is lost, {cause}: check both cables, and start again")]
    Lost {
        /// What happened.
        cause: LinkError,
    },
}

impl From<LinkError> for FalconError {
    fn from(cause: LinkError) -> Self {
        Self::Lost { cause }
    }
}

fn with_serial(serial: &Option<String>) -> String {
    serial.as_ref().map(|serial| format!(" with serial number {serial}")).unwrap_or_default()
}
