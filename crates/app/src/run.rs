//! `hapflow run`: from words to a run, and from a run to a folder.

use crate::cli::RunArgs;
use crate::draw::error::DrawError;
use crate::falcon::TableError;
use crate::meter::Meter;
use crate::outputs::{self, OutputError};
use crate::plugin::Plugins;
use crate::stop::Stop;
use crate::summary::Summary;
use hapflow_devices::DeviceError;
use hapflow_devices::falcon::{CalibrationError, FalconError, GeometryError};
use hapflow_engine::run::{Outcome, Progress, RunOptions, real_time, virtual_clock};
use hapflow_engine::{Parts, Scene, SceneError, Value, load, settings};
use hapflow_validation::ValidationError;
use std::cell::RefCell;
use std::io::Write;
use std::path::{Path, PathBuf};

/// Pictures of a run.
const PICTURES: usize = 4;

/// Why a command ended badly.
#[derive(Debug, thiserror::Error)]
pub enum Failure {
    /// A word, value or file that cannot be used.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// `--set` without `=`.
    #[error("--set {0}: write it as path.to.setting=VALUE, for example fluid.viscosity=0.1")]
    Set(String),
    /// A word of another command with a value that cannot be used.
    #[error("{0}")]
    Word(String),
    /// A plugin that failed while it ran.
    #[error("plugin: {0}")]
    Plugin(String),
    /// A parameter set of a Falcon that cannot be used.
    #[error(transparent)]
    Geometry(#[from] GeometryError),
    /// Readings that give no calibration.
    #[error(transparent)]
    Calibration(#[from] CalibrationError),
    /// A device that is not there, cannot be used, or was lost.
    #[error(transparent)]
    Device(#[from] DeviceError),
    /// A file that a command could not write.
    #[error("{0}: {1}")]
    Write(String, std::io::Error),
    /// A CSV file that cannot be used.
    #[error(transparent)]
    Table(#[from] TableError),
    /// A case that cannot be run.
    #[error(transparent)]
    Validation(#[from] ValidationError),
    /// A fluid that cannot be.
    #[error(transparent)]
    Fluid(#[from] hapflow_fluid::FluidError),
    /// A folder that cannot be written.
    #[error("--out {0}: {1}; choose another folder with --out")]
    Folder(String, std::io::Error),
    /// A folder for pictures that cannot be made.
    #[error("--plot {0}: {1}; choose another folder with --plot")]
    Plot(String, std::io::Error),
    /// A picture that could not be written.
    #[error(transparent)]
    Picture(#[from] DrawError),
    /// A run that went well but could not be written.
    #[error(transparent)]
    Output(#[from] OutputError),
}

impl Failure {
    /// The program's exit code.
    pub fn code(&self) -> u8 {
        match self {
            Self::Output(_) | Self::Picture(_) | Self::Write(..) | Self::Plugin(_) => 1,
            Self::Device(error) | Self::Scene(SceneError::Device(error)) => device_code(error),
            _ => 2,
        }
    }
}

/// A device that is not there, or fails, is not the words' fault.
fn device_code(error: &DeviceError) -> u8 {
    match error {
        DeviceError::Falcon(FalconError::Firmware(_) | FalconError::Geometry(_)) => 2,
        DeviceError::Falcon(_) | DeviceError::Unavailable { .. } | DeviceError::Lost { .. } => 1,
        _ => 2,
    }
}

/// Runs a scene and writes what came of it.
pub fn run(args: &RunArgs) -> Result<(), Failure> {
    let (mut scene, plugins) = (scene(args)?, Plugins::load(&args.plugin)?);
    plugins.parts.choose(&mut scene)?;
    scene.check()?;
    let realtime = args.realtime || scene.in_a_hand();
    for caution in scene.cautions() {
        eprintln!("caution: {caution}");
    }
    let folder = args.out.clone().unwrap_or_else(|| Path::new("out").join(file_stem(&scene)));
    make_folder(&folder)?;
    let outcome = step(args, &scene, plugins.parts.clone(), realtime)?;
    let summary = Summary::new(&scene, &outcome);
    outputs::write(&folder, &scene, &outcome, &summary)?;
    tell(args, &scene, &outcome, &summary, &folder);
    match (outcome.lost, plugins.failure()) {
        (Some(lost), _) => Err(Failure::Device(lost)),
        (None, Some(reason)) => Err(Failure::Plugin(reason)),
        (None, None) => Ok(()),
    }
}

/// The device that `--device` means, and says which where it was left open.
fn device(name: &str) -> Result<&'static str, Failure> {
    if name != "auto" {
        return Ok(hapflow_devices::find(name)?.name);
    }
    let found = hapflow_devices::first_present().unwrap_or(hapflow_devices::HAND);
    eprintln!("device: {}, {}", found.name, found.about);
    Ok(found.name)
}

/// The scene with everything that the command line changes in it.
fn scene(args: &RunArgs) -> Result<Scene, Failure> {
    let mut scene = load(&args.scene)?;
    let mut put = |path: &str, value: Value| settings::set(&mut scene, path, &value);
    let words =
        [("run.coupling", &args.coupling), ("run.filter", &args.filter), ("fluid.solver", &args.solver)];
    for (path, word) in words {
        if let Some(word) = word {
            put(path, Value::Text(word.clone()))?;
        }
    }
    for (path, number) in [
        ("run.duration", args.duration),
        ("run.fluid_hz", args.fluid_hz),
        ("run.fluid_delay", args.fluid_delay),
    ] {
        if let Some(number) = number {
            put(path, Value::Number(number))?;
        }
    }
    if let Some(name) = &args.device {
        put("run.device", Value::Text(device(name)?.into()))?;
    }
    if let Some(motion) = &args.motion {
        put("run.motion", Value::Text(motion.clone()))?;
        put("run.device", Value::Text("replay".into()))?;
    }
    for set in &args.set {
        let (path, value) = set.split_once('=').ok_or_else(|| Failure::Set(set.clone()))?;
        put(path.trim(), Value::parse(value))?;
    }
    scene.check()?;
    Ok(scene)
}

/// A name for the folder: that of the scene, without what a path would take amiss.
fn file_stem(scene: &Scene) -> PathBuf {
    let name = Path::new(&scene.name).file_stem().map(PathBuf::from);
    name.filter(|n| !n.as_os_str().is_empty()).unwrap_or_else(|| "scene".into())
}

/// Makes the folder and sees that it can be written, before a long run and not after it.
fn make_folder(folder: &Path) -> Result<(), Failure> {
    let failed = |e| Failure::Folder(folder.display().to_string(), e);
    std::fs::create_dir_all(folder).map_err(failed)?;
    let probe = folder.join("summary.json");
    std::fs::OpenOptions::new().create(true).append(true).open(&probe).map_err(failed)?;
    for entry in std::fs::read_dir(folder).map_err(failed)?.flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        if name.starts_with("frame-") && name.ends_with(".png") {
            // Pictures of an earlier run would be taken for this one's.
            let _ = std::fs::remove_file(entry.path());
        }
    }
    Ok(())
}

fn step(args: &RunArgs, scene: &Scene, parts: Parts, realtime: bool) -> Result<Outcome, Failure> {
    let pictures_at: Vec<f64> =
        (1..=PICTURES).map(|k| scene.run.duration * (k as f64 - 0.35) / PICTURES as f64).collect();
    let meter = RefCell::new(Meter::new(args.json, realtime, scene.gate.max_force_n));
    let stop = Stop::arm(realtime);
    let mut guide = |text: &str| {
        meter.borrow_mut().guide(text);
        stop.flow()
    };
    let mut progress = |p: Progress<'_>| {
        meter.borrow().show(&p);
        stop.flow()
    };
    let all = crate::cores::cores();
    let threads = if args.threads == 0 && !realtime { all } else { args.threads };
    let record = args.record.as_deref();
    let options = RunOptions {
        threads,
        pictures_at: &pictures_at,
        record,
        parts,
        guide: &mut guide,
        progress: &mut progress,
    };
    let outcome = if realtime { real_time(scene, options) } else { virtual_clock(scene, options) };
    meter.borrow().clear();
    Ok(outcome?)
}

fn tell(args: &RunArgs, scene: &Scene, outcome: &Outcome, summary: &Summary, folder: &Path) {
    let mut out = std::io::stdout();
    if args.json {
        let _ = writeln!(out, "{}", summary.json());
        return;
    }
    let _ = writeln!(out, "{}: {}\n\n{}", scene.name, scene.about, summary.table(outcome));
    if let Some((status, pace)) = &outcome.realtime {
        let _ = writeln!(out, "  real-time priority     {}", status.priority);
        let _ = writeln!(out, "  memory lock            {}", status.memory);
        let late = outcome.timing.ticks.late;
        let _ = writeln!(out, "  late ticks             {late}\n  skipped fluid frames   {}\n", pace.skipped);
    }
    let _ = writeln!(
        out,
        "  force.csv, force.png, summary.json and {} pictures are in {}",
        outcome.pictures.len(),
        folder.display()
    );
}
