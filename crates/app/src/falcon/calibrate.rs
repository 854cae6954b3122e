//! `hapflow falcon calibrate`: what one Falcon's zero angles and motor strength are, as a parameter file.

use crate::cli::CalibrateArgs;
use crate::falcon::convert::{ENCODERS, MAX_PLACE_M, MOTORS, PLACE, vector};
use crate::falcon::device::{Emulated, ready};
use crate::falcon::table::{Row, Table, TableError};
use crate::run::Failure;
use crate::stop::Stop;
use glam::DVec3;
use hapflow_devices::DeviceError;
use hapflow_devices::falcon::{
    CalibrationError, Falcon, Geometry, Kinematics, LARGEST_LOAD_KG, LEAST_LOAD_KG, LoadReading,
    PlaceReading, Request, strength, zeros,
};
use hapflow_haptics::check_range;
use std::ops::ControlFlow;
use std::path::Path;
use std::sync::PoisonError;

/// No encoder or motor has counted further.
const MAX_COUNTS: f64 = 32_768.0;

/// Takes readings, at a Falcon or from files, and prints or writes the parameter file.
pub fn calibrate(args: &CalibrateArgs) -> Result<(), Failure> {
    let geometry = super::geometry(&args.falcon.geometry)?;
    let place = args.at.as_deref().map(|at| place(at, &geometry)).transpose()?;
    if let Some(load_kg) = args.mass {
        check_range("--mass", load_kg, LEAST_LOAD_KG, LARGEST_LOAD_KG)
            .map_err(|error| Failure::Word(error.to_string()))?;
    }
    let mut bench = if place.is_some() || args.mass.is_some() { Some(Bench::ready(args)?) } else { None };
    let mut found = Found::new(geometry, &args.falcon.geometry.geometry);
    if let Some(file) = &args.places {
        found.take_places(&place_readings(file)?)?;
    } else if let (Some(place), Some(bench)) = (place, &mut bench) {
        found.take_places(&[bench.place(place)?])?;
    }
    let kinematics = Kinematics::new(found.geometry.clone());
    if let Some(file) = &args.masses {
        found.take_loads(&load_readings(file, &kinematics)?)?;
    } else if let (Some(load_kg), Some(bench)) = (args.mass, &mut bench) {
        found.take_loads(&bench.loads(&kinematics, load_kg)?)?;
    }
    found.deliver(args.out.as_deref())
}

/// A parameter set as far as it is found, and a word about how.
struct Found {
    geometry: Geometry,
    about: String,
}

impl Found {
    fn new(geometry: Geometry, set: &str) -> Self {
        Self { geometry, about: format!("# By `hapflow falcon calibrate`, from the set {set:?}.\n") }
    }

    fn take_places(&mut self, readings: &[PlaceReading]) -> Result<(), CalibrationError> {
        let zeros = zeros(&self.geometry, readings)?;
        self.geometry.zero_deg = zeros.zero_deg;
        let (count, off_mm) = (readings.len(), 1e3 * zeros.off_m);
        self.about += &format!("# zero_deg: {count} held, farthest off {off_mm:.2} mm.\n");
        Ok(())
    }

    fn take_loads(&mut self, readings: &[LoadReading]) -> Result<(), CalibrationError> {
        let strength = strength(readings)?;
        self.geometry.counts_per_nm = strength.counts_per_nm;
        let (count, grip_kg) = (readings.len(), strength.grip_kg);
        self.about += &format!(
            "# counts_per_nm: {count} carried. The bare grip weighs {grip_kg:.3} kg: --set mapping.carried_mass={grip_kg:.3}\n"
        );
        Ok(())
    }

    /// To the file that was named, or to the terminal, which also gets what a file did not take.
    fn deliver(&self, file: Option<&Path>) -> Result<(), Failure> {
        let text = format!("{}{}", self.about, self.geometry.text());
        let Some(file) = file else { return super::print(text.as_bytes()) };
        let name = file.display().to_string();
        if let Err(error) = std::fs::write(file, &text) {
            super::print(text.as_bytes())?;
            return Err(Failure::Write(format!("--out {name}"), error));
        }
        eprintln!(
            "{name} is written: use it with --geometry {name}, or in a run with --set falcon.geometry={name}"
        );
        Ok(())
    }
}

/// The place that `--at` names, which the grip must reach.
fn place(at: &[f64], geometry: &Geometry) -> Result<DVec3, Failure> {
    let &[x, y, z] = at else { return Err(Failure::Word("--at: write it as X,Y,Z, in metres".into())) };
    let place = DVec3::new(x, y, z);
    let reached = Kinematics::new(geometry.clone()).inverse(place);
    reached.map(|_| place).map_err(|error| Failure::Word(format!("--at: {error}")))
}

/// Held places: encoder counts, and where that was.
fn place_readings(file: &Path) -> Result<Vec<PlaceReading>, TableError> {
    Table::read(file)?.rows(&[ENCODERS, PLACE].concat(), |row| {
        Ok(PlaceReading { counts: encoders(row)?, place: vector(row, PLACE, MAX_PLACE_M)? })
    })
}

/// Loads at rest: encoder and motor counts, and what hung on the grip.
fn load_readings(file: &Path, kinematics: &Kinematics) -> Result<Vec<LoadReading>, TableError> {
    let needs = [&ENCODERS[..], &MOTORS, &["mass_kg"]].concat();
    Table::read(file)?.rows(&needs, |row| {
        let motors = vector(row, MOTORS, MAX_COUNTS)?;
        let load_kg = row.between("mass_kg", 0.0, LARGEST_LOAD_KG)?;
        LoadReading::at(kinematics, encoders(row)?, motors.to_array(), load_kg)
            .map_err(|cause| row.refuse_row("enc0_counts, enc1_counts, enc2_counts", cause))
    })
}

fn encoders(row: &Row<'_>) -> Result<[f64; 3], TableError> {
    Ok(vector(row, ENCODERS, MAX_COUNTS)?.to_array())
}

/// A Falcon that is homed, and the person at it.
struct Bench {
    falcon: Falcon,
    person: Person,
}

struct Person {
    stop: Stop,
    emulated: Emulated,
    asked: Option<Request>,
}

impl Bench {
    fn ready(args: &CalibrateArgs) -> Result<Self, Failure> {
        let (falcon, stop, emulated) = ready(&args.falcon)?;
        Ok(Self { falcon, person: Person { stop, emulated, asked: None } })
    }

    fn place(&mut self, place: DVec3) -> Result<PlaceReading, DeviceError> {
        eprintln!("bring the grip to ({}, {}, {}) m", place.x, place.y, place.z);
        let counts = self.falcon.measure_held(&mut |request| self.person.ask(request))?;
        Ok(PlaceReading { counts, place })
    }

    fn loads(&mut self, kinematics: &Kinematics, load_kg: f64) -> Result<[LoadReading; 2], DeviceError> {
        self.falcon.measure_loads(kinematics, load_kg, &mut |request| self.person.ask(request))
    }
}

impl Person {
    /// Says what is to be done, once; the hand at an emulated Falcon does it.
    fn ask(&mut self, request: Request) -> ControlFlow<()> {
        if self.asked.replace(request) != Some(request) {
            eprintln!("{request}");
            self.obey(request);
        }
        self.stop.flow()
    }

    fn obey(&self, request: Request) {
        let load_kg = match request {
            Request::LetGo => 0.0,
            Request::Hang { load_kg } => load_kg,
            Request::HoldStill | Request::HandOver | Request::TakeHold => return,
        };
        if let Some(device) = &self.emulated {
            // The load is in range: it was checked.
            let _ = device.lock().unwrap_or_else(PoisonError::into_inner).hand().let_go(load_kg);
        }
    }
}
