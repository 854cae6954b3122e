//! What people may write on the command line.

use clap::{Args, Parser, Subcommand, ValueEnum};
use std::path::PathBuf;
use std::process::ExitCode;

/// hapflow lets a hand feel a fluid.
///
/// A scene goes in, a fluid runs, a hand (simulated, recorded or real) moves in it at 1 kHz, and the force that
/// it feels comes out: as a table here, and as force.csv, force.png, summary.json and pictures in out/SCENE.
#[derive(Debug, Parser)]
#[command(name = "hapflow", version, after_help = EXAMPLES)]
pub struct Cli {
    /// What to do; without a word, the scene `tap` is run.
    #[command(subcommand)]
    pub command: Option<Command>,
}

const EXAMPLES: &str = "\
Examples:
  hapflow                                     run the scene `tap`, results in out/tap
  hapflow run tank --duration 3               stir a tank for three seconds
  hapflow run tap --coupling momentum         the thesis's baseline, with its own filter
  hapflow run tap --filter butterworth:50     another filter
  hapflow run tap --set fluid.viscosity=0.1 --set source.tap.speed=2
  hapflow run tap --motion tremor             a recorded hand instead of the simulated one
  hapflow run my-scene.toml --realtime        your own scene, in real time
  hapflow run tap --device auto               with the haptic device that is plugged in
  hapflow run tap --coupling direct --plugin ./libmine.so    another's fluid, device or coupling
  hapflow scenes --settings                   every setting with its unit, range and default
  hapflow validate jet-plate --set speed=2    the fluid's forces against their known answers
  hapflow stress --trials 2000                shake random scenes, and say what does not hold
  hapflow stress felt                         shake hand, device and fluid, and see that the force is safe
  hapflow bench skip                          what is paid for what is not used
  hapflow doctor                              check this machine, and say what to do";

/// The commands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Run a scene and write what the hand felt.
    Run(Box<RunArgs>),
    /// List the shipped scenes, or all settings.
    Scenes(ScenesArgs),
    /// List the devices that can move the tool, and say which are there.
    Devices(DevicesArgs),
    /// Run the fluid's cases with known answers, and say how far off it is and what it costs.
    Validate(ValidateArgs),
    /// Shake random scenes by all means, and say what does not hold: all finite, nobody lost, speed, energy and force bounded.
    Stress(StressArgs),
    /// Measure what the fluid costs, by ratios within one run.
    Bench(BenchArgs),
    /// The Novint Falcon: find, load, home and test it, and its mathematics on files.
    #[command(subcommand)]
    Falcon(FalconCommand),
    /// Libraries that claim hapflow's C interface.
    #[command(subcommand)]
    Plugin(PluginCommand),
    /// Check this machine and say what to do: cores, SIMD, real-time rights, timer, USB, output.
    Doctor(DoctorArgs),
}

impl Default for Command {
    fn default() -> Self {
        Self::Run(Box::new(RunArgs { scene: "tap".into(), ..RunArgs::default() }))
    }
}

/// Arguments of `run`.
#[derive(Debug, Default, Args)]
pub struct RunArgs {
    /// A shipped scene (see `hapflow scenes`) or a TOML file.
    #[arg(default_value = "tap")]
    pub scene: String,
    /// Simulated seconds; the scene's own if left out.
    #[arg(long, value_name = "S")]
    pub duration: Option<f64>,
    /// What moves the tool, by a name of `hapflow devices`; auto takes the first real one that is there, else
    /// the hand. A real device runs in real time.
    #[arg(long, value_name = "NAME", conflicts_with = "motion")]
    pub device: Option<String>,
    /// Replay a recorded motion instead of the scene's device: a CSV file (time_s,x_m,y_m,z_m) or a shipped name.
    #[arg(long, value_name = "FILE|NAME")]
    pub motion: Option<String>,
    /// Take the fluid, device or coupling that a plugin brings in place of the scene's; may be repeated. A file, or the NAME
    /// of a libNAME.so in a folder of HAPFLOW_PLUGIN_PATH. It runs in this process. A plugin's device runs in real time.
    #[arg(long, value_name = "FILE|NAME")]
    pub plugin: Vec<String>,
    /// How tool and fluid meet: local, direct, momentum (the thesis's).
    #[arg(long, value_name = "NAME")]
    pub coupling: Option<String>,
    /// What smooths the force: none, bartlett-hann:11@fluid, boxcar:10@servo, butterworth:50, one-euro:5:0.5, a preset (jet,
    /// crossing, stirring), or auto.
    #[arg(long, value_name = "NAME")]
    pub filter: Option<String>,
    /// How the fluid is solved: wcsph, dfsph, muller (the thesis's).
    #[arg(long, value_name = "NAME")]
    pub solver: Option<String>,
    /// Fluid frames a second.
    #[arg(long, value_name = "N")]
    pub fluid_hz: Option<f64>,
    /// Time that a fluid frame takes to compute, in frames, 0 to 1, where the run is not in real time.
    #[arg(long, value_name = "FRAMES")]
    pub fluid_delay: Option<f64>,
    /// Run in real time, with a live force meter; else as fast as it goes, the same each time.
    #[arg(long)]
    pub realtime: bool,
    /// Worker threads of the fluid; 0 takes all cores, in real time all but one (of two both).
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub threads: usize,
    /// Set any setting; may be repeated. `hapflow scenes --settings` lists them.
    #[arg(long, value_name = "path.to.setting=VALUE")]
    pub set: Vec<String>,
    /// Folder for the results, made if absent [default: out/SCENE].
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Also write every tick to this CSV file as it comes; `--motion FILE --set run.motion_origin=scene` replays it.
    #[arg(long, value_name = "FILE")]
    pub record: Option<PathBuf>,
    /// Print the summary as JSON and nothing else.
    #[arg(long)]
    pub json: bool,
}

/// What to do with a library.
#[derive(Debug, Subcommand)]
pub enum PluginCommand {
    /// Put a library through its paces: versions, misuse, NaN, threads, timing, memory. Exit code 0 only if all holds.
    Check {
        /// The library, as target/release/libhapflow.so. It runs in this process.
        file: PathBuf,
    },
}

/// Arguments of `devices`.
#[derive(Debug, Args)]
pub struct DevicesArgs {
    /// Print a JSON array instead.
    #[arg(long)]
    pub json: bool,
}

/// Arguments of `scenes`.
#[derive(Debug, Args)]
pub struct ScenesArgs {
    /// List every setting with its unit, range and default instead.
    #[arg(long)]
    pub settings: bool,
}

/// Arguments of `validate`.
#[derive(Debug, Args)]
pub struct ValidateArgs {
    /// Cases to run; all if none is named.
    #[arg(value_name = "CASE")]
    pub cases: Vec<String>,
    /// List the cases with their references and parameters instead.
    #[arg(long)]
    pub list: bool,
    /// How the fluid is solved: wcsph, dfsph, muller.
    #[arg(long, value_name = "NAME")]
    pub solver: Option<String>,
    /// Particle spacings in m, in place of each case's own three.
    #[arg(long, value_name = "A[,B,C]", value_delimiter = ',', allow_negative_numbers = true)]
    pub dx: Option<Vec<f64>>,
    /// Set a parameter of all cases that have it (NAME), of one (CASE.NAME), or of the fluid (fluid.…); may be
    /// repeated.
    #[arg(long, value_name = "NAME=VALUE")]
    pub set: Vec<String>,
    /// Time that a fluid frame takes to compute in the felt cases, in frames, 0 to 1 [default: 1].
    #[arg(long, value_name = "FRAMES", allow_negative_numbers = true)]
    pub fluid_delay: Option<f64>,
    /// Each case at its coarsest spacing and with its defaults only.
    #[arg(long)]
    pub quick: bool,
    /// Exit code 1 for any goal that is missed, known shortfalls too.
    #[arg(long)]
    pub strict: bool,
    /// Print one line of JSON for each case, quantity and spacing instead of the table.
    #[arg(long)]
    pub json: bool,
    /// Folder for a picture of each case's convergence, made if absent.
    #[arg(long, value_name = "DIR")]
    pub plot: Option<PathBuf>,
}

/// Arguments of `stress`.
#[derive(Debug, Args)]
pub struct StressArgs {
    /// What is tried: the fluid, or the force that a hand feels while devices, fluids and people do what they must not.
    #[arg(value_name = "WHAT", default_value = "fluid")]
    pub what: Stressed,
    /// How many trials.
    #[arg(long, value_name = "N", default_value_t = 1000, value_parser = clap::value_parser!(u64).range(1..=10_000_000))]
    pub trials: u64,
    /// Seed of the first trial; the next has the next.
    #[arg(long, value_name = "S", default_value_t = 0)]
    pub seed: u64,
    /// Instead, find the longest steps at which a tank stays calm, against stiffness and viscosity, and draw them.
    #[arg(long, value_name = "FILE.png", conflicts_with_all = ["json", "what"])]
    pub map: Option<PathBuf>,
    /// Print one line of JSON for each trial (trial, seed, pass, reason, repeat) instead of those that fail.
    #[arg(long)]
    pub json: bool,
}

/// What `stress` tries.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Stressed {
    /// Random scenes.
    Fluid,
    /// Random hands.
    Felt,
}

/// The words after `falcon`. Those on files print CSV and nothing else: the file's columns, and those that are added.
#[derive(Debug, Subcommand)]
pub enum FalconCommand {
    /// Say which Falcons are plugged in, and what state the chosen one is in. Gives no force.
    Info(FalconArgs),
    /// Load a firmware image, after a check of its structure. The Falcon keeps it until it is unplugged.
    Firmware {
        /// The image, such as nvent_firmware.bin of libnifalcon.
        file: PathBuf,
        /// The Falcon.
        #[command(flatten)]
        falcon: FalconArgs,
    },
    /// Lead through homing.
    Home(FalconArgs),
    /// Home, then exchange without force for some seconds, and say how well that goes.
    Test {
        /// For how long, s.
        #[arg(long, value_name = "S", default_value_t = 5.0)]
        seconds: f64,
        /// The Falcon.
        #[command(flatten)]
        falcon: FalconArgs,
    },
    /// Find this unit's zero angles and motor counts a newton metre, and print the parameter file (or write it, with --out), which
    /// --geometry takes.
    Calibrate(CalibrateArgs),
    /// Write the udev rule with which Linux lets its users have a Falcon (as root).
    Udev,
    /// Encoder counts to places: reads enc0_counts, enc1_counts, enc2_counts; adds x_m, y_m, z_m.
    Fk(KinematicsArgs),
    /// Forces to motor counts: reads x_m, y_m, z_m, fx_N, fy_N, fz_N; adds motor0_counts to 2 (within 4095 either way, all
    /// scaled alike) and tau0_Nm to 2 (the torques that this force needs).
    Force(KinematicsArgs),
    /// Packets of the device to what they say: reads bytes_hex; adds accepted, enc0_counts to 2, homing_bits, button_bits.
    Decode(FileArgs),
    /// Packets for the device: reads motor0_counts to 2, led_mask (green 2, blue 4, red 8), homing; adds bytes_hex.
    Encode(FileArgs),
}

/// What a calibration is taken from.
#[derive(Debug, Args)]
#[command(group(clap::ArgGroup::new("readings").required(true).multiple(true).args(["at", "mass", "places", "masses"])))]
pub struct CalibrateArgs {
    /// Home, and take the zero angles from the grip as it is held at this place, in the Falcon's frame (origin: middle of the
    /// base's front, x right, y up, z towards the user), m.
    #[arg(long, value_name = "X,Y,Z", value_delimiter = ',', allow_negative_numbers = true)]
    pub at: Option<Vec<f64>>,
    /// Home, and take the counts a newton metre from what the motors give to carry the bare grip, and then the grip with this
    /// mass hung on it, 0.02 to 0.5 kg. Gives force: up to 8 N.
    #[arg(long, value_name = "KG", allow_negative_numbers = true)]
    pub mass: Option<f64>,
    /// Take the zero angles from readings: enc0_counts to 2, x_m, y_m, z_m.
    #[arg(long, value_name = "FILE.csv", conflicts_with = "at")]
    pub places: Option<PathBuf>,
    /// Take the counts a newton metre from readings at rest: enc0_counts to 2, motor0_counts to 2, mass_kg.
    #[arg(long, value_name = "FILE.csv", conflicts_with = "mass")]
    pub masses: Option<PathBuf>,
    /// Write the parameter file here, and not to the terminal.
    #[arg(long, value_name = "FILE.toml")]
    pub out: Option<PathBuf>,
    /// The Falcon.
    #[command(flatten)]
    pub falcon: FalconArgs,
}

/// A file.
#[derive(Debug, Args)]
pub struct FileArgs {
    /// A CSV file with a header.
    pub file: PathBuf,
}

/// A file, and the Falcon that it is about.
#[derive(Debug, Args)]
pub struct KinematicsArgs {
    /// A CSV file with a header.
    pub file: PathBuf,
    /// The Falcon.
    #[command(flatten)]
    pub geometry: GeometryArgs,
}

/// A Falcon.
#[derive(Debug, Args)]
pub struct FalconArgs {
    /// Its serial number, where there are several.
    #[arg(long, value_name = "TEXT")]
    pub serial: Option<String>,
    /// Firmware image to load if none runs.
    #[arg(long, value_name = "FILE")]
    pub load: Option<PathBuf>,
    /// Take one that is emulated down to USB transfers, in a simulated hand.
    #[arg(long)]
    pub emulated: bool,
    /// Its lengths and strengths.
    #[command(flatten)]
    pub geometry: GeometryArgs,
}

/// A Falcon's lengths and strengths.
#[derive(Debug, Args)]
pub struct GeometryArgs {
    /// Lengths and angles: libnifalcon, martin, or a parameter file.
    #[arg(long, value_name = "NAME|FILE", default_value = "libnifalcon")]
    pub geometry: String,
    /// Motor counts a newton metre, in place of the geometry's own.
    #[arg(long, value_name = "K", allow_negative_numbers = true)]
    pub counts_per_nm: Option<f64>,
}

/// What is measured.
#[derive(Debug, Args)]
pub struct BenchArgs {
    /// Which benchmark.
    #[command(subcommand)]
    pub which: Bench,
}

/// The benchmarks.
#[derive(Debug, Subcommand)]
pub enum Bench {
    /// What each thing costs where it is used and where it is not, and what sleeps; about two minutes.
    Skip(BenchFormat),
    /// Steps of a particle a second, by stage, and their share of what this machine can do; about two minutes.
    Speed(BenchFormat),
    /// Error against CPU time for each solver, resolution, tolerance and step, with dated figures of other codes; up to an
    /// hour.
    WorkPrecision(WorkPrecisionArgs),
    /// Every coupling with every filter at fluid rates of 30 to 250 Hz: the felt figures, spectra, what an error costs, what a
    /// tick costs; half an hour to an hour on two cores.
    Felt(FeltArgs),
    /// Each filter and window against ripple, lag and overshoot, in a jet, crossing one, and stirring; two minutes.
    Filters(FiltersArgs),
}

/// Arguments of `bench felt`.
#[derive(Debug, Args)]
pub struct FeltArgs {
    /// Print one line of JSON for each figure, as `validate` does, each spectrum and each point instead of the table.
    #[arg(long)]
    pub json: bool,
    /// Folder for pictures of the crossing, the spectra, and error against cost, made if absent.
    #[arg(long, value_name = "DIR")]
    pub plot: Option<PathBuf>,
    /// Couplings with their own filters at 60 Hz only, and a truth of two seeds.
    #[arg(long)]
    pub quick: bool,
}

/// Arguments of `bench filters`.
#[derive(Debug, Args)]
pub struct FiltersArgs {
    /// Print one line of JSON for each use, coupling and filter instead of the table.
    #[arg(long)]
    pub json: bool,
    /// Folder for a picture, filters.png: ripple against lag, one panel a use; made if absent.
    #[arg(long, value_name = "DIR")]
    pub plot: Option<PathBuf>,
}

/// Arguments of `bench work-precision`.
#[derive(Debug, Args)]
pub struct WorkPrecisionArgs {
    /// Print one line of JSON for each point instead of the table.
    #[arg(long)]
    pub json: bool,
    /// Draw error against cost of each case, with the fronts.
    #[arg(long, value_name = "FILE.png")]
    pub plot: Option<PathBuf>,
    /// Each case at its coarsest spacing only: a fifth of the time.
    #[arg(long)]
    pub quick: bool,
}

/// How a benchmark tells what it found.
#[derive(Debug, Args)]
pub struct BenchFormat {
    /// Print one line of JSON for each number instead of the table.
    #[arg(long)]
    pub json: bool,
}

/// Arguments of `doctor`.
#[derive(Debug, Args)]
pub struct DoctorArgs {
    /// Print a JSON array of {check, state, found, advice} instead; state is ok, warning or missing.
    #[arg(long)]
    pub json: bool,
}

/// Help and version go to the reader whole; anything else is one clear line and exit code 2.
pub fn explain(error: &clap::Error) -> ExitCode {
    if !error.use_stderr() {
        let _ = error.print();
        return ExitCode::SUCCESS;
    }
    let text = error.to_string();
    let mut lines = text.lines().map(str::trim);
    // What is missing stands in lines of its own, up to the first empty one.
    let first = lines.by_ref().take_while(|line| !line.is_empty()).collect::<Vec<_>>().join(" ");
    let first = first.trim_start_matches("error: ");
    let tip = lines.find(|line| line.starts_with("tip:")).map(|line| format!("; {line}")).unwrap_or_default();
    eprintln!("hapflow: {first}{tip} (hapflow --help tells more)");
    ExitCode::from(2)
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_words_are_consistent() {
        Cli::command().debug_assert();
    }

    #[test]
    fn doctor_takes_json() {
        let parsed = Cli::try_parse_from(["hapflow", "doctor", "--json"]).unwrap();
        assert!(matches!(parsed.command, Some(Command::Doctor(DoctorArgs { json: true }))));
    }
}
