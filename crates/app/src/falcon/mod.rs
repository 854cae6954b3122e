//! `hapflow falcon`.

mod convert;
mod table;

pub use table::TableError;

use crate::cli::{FalconCommand, GeometryArgs};
use crate::run::Failure;
use hapflow_devices::falcon::{Geometry, Kinematics};
use hapflow_haptics::check_range;
use std::io::Write;
use table::Table;

/// Does what was asked.
pub fn falcon(command: &FalconCommand) -> Result<(), Failure> {
    let output = match command {
        FalconCommand::Fk(args) => convert::fk(&Table::read(&args.file)?, &kinematics(&args.geometry)?)?,
        FalconCommand::Force(args) => {
            convert::force(&Table::read(&args.file)?, &kinematics(&args.geometry)?)?
        }
        FalconCommand::Decode(args) => convert::decode(&Table::read(&args.file)?)?,
        FalconCommand::Encode(args) => convert::encode(&Table::read(&args.file)?)?,
    };
    // A closed pipe is no reason to fail.
    let _ = std::io::stdout().write_all(&output);
    Ok(())
}

fn kinematics(args: &GeometryArgs) -> Result<Kinematics, Failure> {
    let mut geometry = Geometry::load(&args.geometry)?;
    if let Some(counts) = args.counts_per_nm {
        geometry.counts_per_nm = check_range("--counts-per-nm", counts, 1.0, 1e6)
            .map_err(|error| Failure::Word(error.to_string()))?;
    }
    Ok(Kinematics::new(geometry))
}
