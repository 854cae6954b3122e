//! `hapflow falcon info`, `firmware`, `home`, `test` and `udev`: a Falcon that is plugged in.

use crate::cli::FalconArgs;
use crate::run::Failure;
use crate::stop::Stop;
use glam::DVec3;
use hapflow_devices::falcon::{
    EmulatedFalcon, EmulatedHand, EmulatedTransport, Falcon, FalconError, FalconOptions, Firmware, Geometry,
    Kinematics, Transport, Trouble, UDEV_RULE, UDEV_RULE_FILE, open, plugged_in,
};
use hapflow_devices::{DeviceError, HapticDevice};
use hapflow_haptics::{GatedWrench, check_range};
use hapflow_realtime::RealClock;
use std::path::Path;
use std::sync::{Arc, Mutex};
use std::time::Instant;

/// Says what is plugged in, and what state the chosen one is in.
pub fn info(args: &FalconArgs) -> Result<(), Failure> {
    if !args.emulated {
        for falcon in plugged_in().map_err(DeviceError::from)? {
            let serial = falcon.serial.unwrap_or_else(|error| error.to_string());
            println!("bus {}, address {}: serial number {serial}", falcon.bus, falcon.address);
        }
    }
    let (mut falcon, _) = falcon(args)?;
    match falcon.start(&mut |text| eprintln!("{text}")) {
        Ok(()) => println!("its firmware runs"),
        Err(FalconError::NoFirmware) => {
            println!("it has no firmware yet: `hapflow falcon firmware FILE` loads one")
        }
        Err(error) => return Err(DeviceError::from(error).into()),
    }
    Ok(())
}

/// Loads an image.
pub fn firmware(file: &Path, args: &FalconArgs) -> Result<(), Failure> {
    let image = Firmware::load(file).map_err(|error| DeviceError::from(FalconError::from(error)))?;
    println!(
        "{}: {} bytes, entry {:#08x}, {} blocks",
        file.display(),
        image.bytes().len(),
        image.entry(),
        image.blocks().len()
    );
    let mut options = options(args)?;
    (options.firmware, options.always_load) = (Some(image), true);
    let mut falcon = Falcon::new(transport(args, &options)?.0, options)?;
    falcon.start(&mut |text| eprintln!("{text}")).map_err(DeviceError::from)?;
    println!("loaded, and it answers");
    Ok(())
}

/// Homes it.
pub fn home(args: &FalconArgs) -> Result<(), Failure> {
    ready(args).map(drop)
}

/// Homes it, and exchanges for a while.
pub fn test(seconds: f64, args: &FalconArgs) -> Result<(), Failure> {
    let seconds =
        check_range("--seconds", seconds, 0.1, 3600.0).map_err(|error| Failure::Word(error.to_string()))?;
    let (mut falcon, stop, _) = ready(args)?;
    let before = falcon.stats();
    let (begin, mut last, mut longest) = (Instant::now(), Instant::now(), 0.0_f64);
    let (mut low, mut high, mut pressed) = (DVec3::INFINITY, DVec3::NEG_INFINITY, 0);
    println!("move the grip about and press its buttons, for {seconds} s");
    while begin.elapsed().as_secs_f64() < seconds && stop.flow().is_continue() {
        let state = falcon.read(0.0)?;
        let dt = last.elapsed().as_secs_f64();
        (last, longest) = (Instant::now(), longest.max(dt));
        falcon.write(GatedWrench::ZERO, dt)?;
        (low, high, pressed) = (low.min(state.position), high.max(state.position), pressed | state.buttons);
    }
    let (stats, taken) = (falcon.stats(), begin.elapsed().as_secs_f64());
    let replies = stats.replies - before.replies;
    println!("rate             {:.0} Hz, longest gap {:.1} ms", replies as f64 / taken, 1e3 * longest);
    println!("sent again       {} of {replies}", stats.resent - before.resent);
    println!("bytes dropped    {}", stats.dropped_bytes - before.dropped_bytes);
    println!("without a pose   {}", stats.unsound - before.unsound);
    println!("line errors      {}", stats.line_errors);
    for (axis, (low, high)) in ["x", "y", "z"].iter().zip(low.to_array().into_iter().zip(high.to_array())) {
        println!("{axis}                {:+.1} to {:+.1} mm from the middle", 1e3 * low, 1e3 * high);
    }
    println!("buttons pressed  {pressed:#06b}");
    Ok(())
}

/// Writes the rule.
pub fn udev() -> Result<(), Failure> {
    let text = format!("# Lets users have a Novint Falcon.\n{UDEV_RULE}\n");
    std::fs::write(UDEV_RULE_FILE, text).map_err(|error| {
        let what = format!(
            "{UDEV_RULE_FILE} cannot be written (try `sudo hapflow falcon udev`); its rule is {UDEV_RULE}"
        );
        Failure::Write(what, error)
    })?;
    println!(
        "{UDEV_RULE_FILE} is written: now `sudo udevadm control --reload`, and plug the Falcon in again"
    );
    Ok(())
}

/// What stands behind a Falcon that is emulated.
pub type Emulated = Option<Arc<Mutex<EmulatedFalcon>>>;

/// One that is homed.
pub fn ready(args: &FalconArgs) -> Result<(Falcon, Stop, Emulated), Failure> {
    let (mut falcon, emulated) = falcon(args)?;
    let stop = Stop::arm(true);
    let mut told = String::new();
    falcon.prepare(&mut |text| {
        if told != text {
            eprintln!("{text}");
            text.clone_into(&mut told);
        }
        stop.flow()
    })?;
    Ok((falcon, stop, emulated))
}

fn falcon(args: &FalconArgs) -> Result<(Falcon, Emulated), Failure> {
    let options = options(args)?;
    let (transport, emulated) = transport(args, &options)?;
    Ok((Falcon::new(transport, options)?, emulated))
}

fn options(args: &FalconArgs) -> Result<FalconOptions, Failure> {
    let mut options = FalconOptions::new(super::geometry(&args.geometry)?);
    if let Some(file) = &args.load {
        let image = Firmware::load(file).map_err(|error| DeviceError::from(FalconError::from(error)))?;
        options.firmware = Some(image);
    }
    Ok(options)
}

fn transport(args: &FalconArgs, options: &FalconOptions) -> Result<(Box<dyn Transport>, Emulated), Failure> {
    if !args.emulated {
        return Ok((open(args.serial.as_deref()).map_err(DeviceError::from)?, None));
    }
    // Whatever the driver believes of it, it is built as the default set says.
    let kinematics = Kinematics::new(Geometry::load(Geometry::NAMES[0])?);
    let hand = EmulatedHand::new(kinematics, &[], true)?;
    let device = EmulatedFalcon::new(hand, Trouble::default(), options.firmware.is_none());
    let device = Arc::new(Mutex::new(device));
    let transport = EmulatedTransport::new(Arc::clone(&device), Arc::new(RealClock::new()));
    Ok((Box::new(transport), Some(device)))
}
