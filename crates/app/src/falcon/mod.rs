//! `hapflow falcon`.

mod calibrate;
mod convert;
mod device;
mod table;

pub use table::TableError;

use crate::cli::{FalconCommand, GeometryArgs, KinematicsArgs};
use crate::run::Failure;
use hapflow_devices::falcon::{Geometry, Kinematics};
use hapflow_haptics::check_range;
use std::io::Write;
use table::Table;

/// Does what was asked.
pub fn falcon(command: &FalconCommand) -> Result<(), Failure> {
    match command {
        FalconCommand::Info(args) => device::info(args),
        FalconCommand::Firmware { file, falcon } => device::firmware(file, falcon),
        FalconCommand::Home(args) => device::home(args),
        FalconCommand::Test { seconds, falcon } => device::test(*seconds, falcon),
        FalconCommand::Calibrate(args) => calibrate::calibrate(args),
        FalconCommand::Udev => device::udev(),
        FalconCommand::Fk(args) => print(&convert::fk(&Table::read(&args.file)?, &kinematics(args)?)?),
        FalconCommand::Force(args) => print(&convert::force(&Table::read(&args.file)?, &kinematics(args)?)?),
        FalconCommand::Decode(args) => print(&convert::decode(&Table::read(&args.file)?)?),
        FalconCommand::Encode(args) => print(&convert::encode(&Table::read(&args.file)?)?),
    }
}

/// Prints a table; a closed pipe is no reason to fail.
fn print(table: &[u8]) -> Result<(), Failure> {
    let _ = std::io::stdout().write_all(table);
    Ok(())
}

fn kinematics(args: &KinematicsArgs) -> Result<Kinematics, Failure> {
    Ok(Kinematics::new(geometry(&args.geometry)?))
}

fn geometry(args: &GeometryArgs) -> Result<Geometry, Failure> {
    let mut geometry = Geometry::load(&args.geometry)?;
    if let Some(counts) = args.counts_per_nm {
        geometry.counts_per_nm = check_range("--counts-per-nm", counts, 1.0, 1e6)
            .map_err(|error| Failure::Word(error.to_string()))?;
    }
    Ok(geometry)
}
