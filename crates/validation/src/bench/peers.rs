//! What other codes were measured at on the same cases, with the date: SPlisHSPlasH 2.19.0 (its Python wheel) and salva3d
//! 0.11.0, on two cores of a shared Xeon. The tank of the case `buoyancy` and the column of `dam-break`, particles on the same
//! lattice; support two spacings, cubic spline, walls of one layer of samples. Costs are process CPU time.

use serde_json::Value;
use std::path::Path;
use std::process::{Command, Stdio};

/// The script that runs a peer, from the folder of the repository; who its interpreter is, and the peer's methods.
const SCRIPT: &str = "benches/peers/splish.py";
const PYTHON: &str = "HAPFLOW_PEERS_PYTHON";
const METHODS: [&str; 2] = ["DFSPH", "WCSPH"];

/// A figure of a peer.
#[derive(Clone, Debug)]
pub(super) struct Figure {
    pub case: String,
    pub who: String,
    pub particles: usize,
    /// Relative error of the force, or lead of the front in units of the case.
    pub error: f64,
    /// CPU time for a simulated second, s.
    pub cost: f64,
    /// When it was measured, elsewhere; none of what was measured in this run.
    pub date: Option<&'static str>,
}

type Dated = (&'static str, &'static str, usize, f64, f64);

const DATE: &str = "2026-11-23";
const FIGURES: [Dated; 13] = [
    ("buoyancy", "SPlisHSPlasH DFSPH 0.05 %", 10_216, 0.059, 30.0),
    ("buoyancy", "SPlisHSPlasH DFSPH 0.05 %", 28_650, 0.046, 137.0),
    ("buoyancy", "SPlisHSPlasH DFSPH 0.01 %", 10_216, 0.061, 86.0),
    ("buoyancy", "SPlisHSPlasH IISPH 0.05 %", 10_216, 0.089, 66.0),
    ("buoyancy", "SPlisHSPlasH WCSPH", 10_216, 0.154, 103.0),
    ("buoyancy", "SPlisHSPlasH WCSPH", 28_650, 0.113, 372.0),
    ("buoyancy", "SPlisHSPlasH PBF", 10_216, 0.104, 128.0),
    ("buoyancy", "salva DFSPH 0.05 %", 10_216, 0.045, 127.0),
    ("buoyancy", "salva IISPH 0.05 %", 10_216, 0.059, 242.0),
    // Step costs over their fixed steps: 71, 27.9 and 126 ms on two threads, 207 ms on one.
    ("dam-break", "SPlisHSPlasH DFSPH 0.05 %", 10_976, 0.125, 71.0 / 2.23),
    ("dam-break", "SPlisHSPlasH WCSPH", 10_976, 0.102, 27.9 / 0.228),
    ("dam-break", "SPlisHSPlasH IISPH 0.05 %", 10_976, 0.121, 126.0 / 2.23),
    ("dam-break", "salva DFSPH 0.05 %", 10_976, 0.168, 207.0 / 2.23),
];

/// What is known of a case: measured now where the peer can be run, else then.
pub(super) fn figures(case: &str, begin: &mut impl FnMut(&str)) -> Vec<Figure> {
    let mut now = Vec::new();
    if case == "buoyancy" && Path::new(SCRIPT).exists() {
        begin("buoyancy: SPlisHSPlasH, where it is installed");
        now.extend(METHODS.iter().filter_map(|method| run(method)));
    }
    let known = |who: &str| now.iter().any(|f| f.who == who);
    let then = FIGURES.iter().filter(|f| f.0 == case && !known(f.1)).map(dated);
    let then: Vec<_> = then.collect();
    now.into_iter().chain(then).collect()
}

fn dated(&(case, who, particles, error, cost): &Dated) -> Figure {
    Figure { case: case.into(), who: who.into(), particles, error, cost, date: Some(DATE) }
}

/// Runs a method of the peer; none where that does not work.
fn run(method: &str) -> Option<Figure> {
    let python = std::env::var(PYTHON).unwrap_or_else(|_| "python3".into());
    let output = Command::new(python).args([SCRIPT, method]).stderr(Stdio::null()).output().ok()?;
    figure(&serde_json::from_slice(&output.stdout).ok()?)
}

fn figure(line: &Value) -> Option<Figure> {
    Some(Figure {
        case: line["case"].as_str()?.into(),
        who: line["who"].as_str()?.into(),
        particles: line["particles"].as_u64()? as usize,
        error: line["error"].as_f64()?,
        cost: line["cpu_s_per_sim_s"].as_f64()?,
        date: None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn a_line_of_the_script_is_a_figure_of_now() {
        let line = json!({
            "case": "buoyancy", "who": "SPlisHSPlasH WCSPH", "particles": 10216, "error": 0.15, "noise": 0.5,
            "cpu_s_per_sim_s": 103.0, "simulated_s": 1.0
        });
        let f = figure(&line).unwrap();
        assert!(
            f.date.is_none()
                && f.particles == 10216
                && f.cost == 103.0
                && FIGURES.iter().any(|d| d.1 == f.who)
        );
        assert!(figure(&json!({ "case": "buoyancy" })).is_none());
    }
}
