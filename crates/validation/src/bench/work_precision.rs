//! What accuracy costs: error against CPU time, for each solver over resolutions, tolerances and steps.

use super::peers::{Figure, figures};
use crate::{Case, Plan, Row, Setup, ValidationError, find};
use serde_json::json;

/// A case, the quantity that counts in it, and the highest speed of its flow, m/s: the measure of sound.
struct Task {
    case: &'static str,
    quantity: &'static str,
    speed: f64,
}

const TASKS: [Task; 4] = [
    Task { case: "buoyancy", quantity: "force", speed: 2.8 },
    Task { case: "jet-plate", quantity: "normal_force", speed: 1.5 },
    Task { case: "tow", quantity: "spurious_drag", speed: 2.8 },
    Task { case: "dam-break", quantity: "front_lead", speed: 3.13 },
];

/// Settings that are tried. Of `wcsph` the speed of sound makes the step, of `dfsph` the tolerance the iterations.
fn choices(speed: f64) -> Vec<(String, Vec<String>)> {
    let set = |path: &str, value: f64| format!("{path}={value}");
    let of = |name: String, sets: Vec<String>| (name, sets);
    let solver = |name: &str| format!("fluid.solver={name}");
    let sound = |n: f64| vec![solver("wcsph"), set("fluid.sound_speed", n * speed)];
    let sounds = [3.0, 5.0, 10.0, 20.0].map(|n| of(format!("wcsph, c = {n} v"), sound(n)));
    let narrow =
        of("wcsph, c = 3 v, H = 2.3 dx".into(), [sound(3.0), vec![set("fluid.support", 2.3)]].concat());
    let tolerances = [0.1, 0.02, 0.005]
        .map(|t| of(format!("dfsph, tolerance {t}"), vec![solver("dfsph"), set("fluid.tolerance", t)]));
    let stiffnesses = [100.0, 1000.0]
        .map(|k| of(format!("muller, k = {k} m²/s²"), vec![solver("muller"), set("fluid.stiffness", k)]));
    sounds.into_iter().chain([narrow]).chain(tolerances).chain(stiffnesses).collect()
}

/// One point: a choice at a resolution.
#[derive(Clone, Debug)]
pub struct Point {
    /// The case.
    pub case: String,
    /// Whose: a choice of settings here, or a peer.
    pub who: String,
    /// Particles.
    pub particles: usize,
    /// Spacing, m; none of a peer.
    pub dx: Option<f64>,
    /// Error, relative or in the case's scale.
    pub error: f64,
    /// CPU time of all threads for a simulated second, s.
    pub cost: f64,
    /// When a peer's figure was measured, elsewhere; none of what was measured in this run.
    pub date: Option<&'static str>,
    /// Whether nothing of hapflow's is both cheaper and truer; none of a peer.
    pub front: Option<bool>,
}

impl Point {
    /// One line of JSON.
    pub fn json(&self) -> serde_json::Value {
        json!({
            "case": self.case,
            "who": self.who,
            "particles": self.particles,
            "dx": self.dx,
            "error": self.error,
            "cpu_s_per_sim_s": self.cost,
            "dated": self.date,
            "front": self.front,
        })
    }
}

/// All points of all cases, at the shipped spacings or at all; `begin` hears what is run, `tell` what came of each case.
///
/// # Errors
/// What a case refuses, but for single choices, which are left out where a case sets them otherwise.
pub fn work_precision(
    quick: bool,
    threads: usize,
    mut begin: impl FnMut(&str),
    mut tell: impl FnMut(&[Point]),
) -> Result<(), ValidationError> {
    for task in TASKS {
        let case = find(task.case)?;
        let mut points = Vec::new();
        for (who, sets) in choices(task.speed) {
            begin(&format!("{}: {who}", case.name));
            match rows(case, &sets, quick, threads) {
                Ok(rows) => points.extend(rows.iter().filter_map(|row| point(row, &who, task.quantity))),
                Err(error @ (ValidationError::Owned { .. } | ValidationError::Fluid { .. })) => {
                    begin(&format!("{}: {who}: left out: {error}", case.name));
                }
                Err(error) => return Err(error),
            }
        }
        mark_front(&mut points);
        points.extend(figures(case.name, &mut begin).into_iter().map(peer));
        tell(&points);
    }
    Ok(())
}

fn rows(case: &Case, sets: &[String], quick: bool, threads: usize) -> Result<Vec<Row>, ValidationError> {
    let shipped = Setup::new(case, threads).shipped_dx();
    let cells = if quick { &case.cells[..1] } else { &case.cells[..] };
    let spacings = cells.iter().map(|n| shipped * case.cells[0] / n).collect();
    Plan::new(&[case], sets, Some(spacings), true, threads)?.run_case(case, |_| {})
}

fn point(row: &Row, who: &str, quantity: &str) -> Option<Point> {
    (row.measure.quantity == quantity).then_some(Point {
        case: row.case.into(),
        who: who.into(),
        particles: row.particles,
        dx: Some(row.dx),
        error: row.error()?,
        cost: row.cpu_s_per_sim_s,
        date: None,
        front: None,
    })
}

fn peer(f: Figure) -> Point {
    Point {
        case: f.case,
        who: f.who,
        particles: f.particles,
        dx: None,
        error: f.error,
        cost: f.cost,
        date: f.date,
        front: None,
    }
}

/// Marks what nothing beats in both.
fn mark_front(points: &mut [Point]) {
    let all: Vec<_> = points.iter().map(|p| [p.cost, p.error]).collect();
    for (k, point) in points.iter_mut().enumerate() {
        let [cost, error] = all[k];
        let beaten = |&[c, e]: &[f64; 2]| c <= cost && e <= error && (c < cost || e < error);
        point.front = Some(error.is_finite() && !all.iter().any(beaten));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_front_is_what_nothing_beats() {
        let point = |cost: f64, error: f64| Point {
            case: "buoyancy".into(),
            who: String::new(),
            particles: 1,
            dx: None,
            error,
            cost,
            date: None,
            front: None,
        };
        let mut points =
            [point(1.0, 0.1), point(2.0, 0.05), point(3.0, 0.07), point(2.0, 0.2), point(0.5, f64::NAN)];
        mark_front(&mut points);
        assert_eq!(points.map(|p| p.front), [true, true, false, false, false].map(Some));
    }

    #[test]
    fn every_choice_is_a_setting_of_every_task() {
        for task in TASKS {
            let case = find(task.case).unwrap();
            for (_, sets) in choices(task.speed) {
                Plan::new(&[case], &sets, None, true, 1).unwrap();
            }
        }
    }
}
