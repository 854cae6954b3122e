//! The numbers of a run: `summary.json` and the table that people read.

use crate::viscosity;
use glam::DVec3;
use hapflow_engine::run::{Outcome, TICK_S};
use hapflow_engine::{Scene, signal};
use serde_json::{Value, json};

/// Parts of a run over which the force is told.
const PARTS: usize = 12;

/// The numbers of a run.
pub struct Summary {
    mean_force: DVec3,
    ripple_rms: f64,
    lag: f64,
    max_force: f64,
    viscosity: String,
    json: Value,
}

impl Summary {
    /// Takes the numbers from a run of `scene`. Everything but `timing` is the same in every run on the virtual
    /// clock.
    pub fn new(scene: &Scene, outcome: &Outcome) -> Self {
        let rows = &outcome.recording.rows;
        let sent: Vec<DVec3> = rows.iter().map(|r| r.sent.force).collect();
        let raw: Vec<DVec3> = rows.iter().map(|r| r.raw.force).collect();
        let mean_force = signal::mean(&sent);
        let ripple_rms = signal::ripple_rms(&sent);
        let lag = signal::lag_s(&raw, &sent, TICK_S);
        let max_force = sent.iter().map(|f| f.length()).fold(0.0, f64::max);
        let json = json!({
            "scene": scene.name,
            "backend": in_use(scene, "backend"),
            "coupling": in_use(scene, "coupling"),
            "filter": scene.filter().to_string(),
            "solver": hapflow_engine::settings::get(scene, "fluid.solver").ok().map(|v| text(&v)),
            "fluid_hz": scene.run.fluid_hz,
            "duration_s": outcome.timing.simulated_s,
            "mean_force_N": mean_force.to_array(),
            "ripple_rms_N": ripple_rms,
            "lag_s": lag,
            "max_force_N": max_force,
            "force_over_time_N": over_time(&sent),
            "fluid_weight_N": weight(scene, outcome.fluid.particles),
            "particles": outcome.fluid.particles,
            "fluid_steps": outcome.fluid.total_substeps,
            "fluid_frames": outcome.fluid.frame,
            "degraded_frames": outcome.fluid.degraded,
            "viscosity": viscosity::json(scene),
            "faults": outcome.faults.names().collect::<Vec<_>>(),
            "timing": timing(outcome),
        });
        Self { mean_force, ripple_rms, lag, max_force, viscosity: viscosity::told(scene), json }
    }

    /// As JSON.
    pub fn json(&self) -> &Value {
        &self.json
    }

    /// The table at the end of a run.
    pub fn table(&self, outcome: &Outcome) -> String {
        let t = &outcome.timing;
        let per_second = t.simulated_s.max(1e-9);
        let row = |name: &str, value: String| format!("  {name:<22} {value}\n");
        let f = self.mean_force;
        [
            row("mean force", format!("{:+.3} {:+.3} {:+.3} N   (|F| {:.3} N)", f.x, f.y, f.z, f.length())),
            row("largest force", format!("{:.3} N", self.max_force)),
            row("ripple above 20 Hz", format!("{:.1} mN rms", 1e3 * self.ripple_rms)),
            row("lag, sent behind raw", format!("{:.1} ms", 1e3 * self.lag)),
            row("particles at the end", format!("{}", outcome.fluid.particles)),
            row("fluid sub-steps", format!("{}", outcome.fluid.total_substeps)),
            row("viscosity", self.viscosity.clone()),
            row("faults and remarks", format!("{}", outcome.faults)),
            row(
                "time per simulated s",
                format!("{:.2} s wall, {:.2} s CPU", t.wall_s / per_second, t.cpu_s / per_second),
            ),
            row(
                "servo tick",
                format!(
                    "{:.1} µs median, {:.1} µs at 99.9 %",
                    1e6 * t.ticks.quantile_s(0.5),
                    1e6 * t.ticks.quantile_s(0.999)
                ),
            ),
        ]
        .concat()
    }
}

/// The `part` in use, `backend`, `coupling` or `device`: of a plugin, or the scene's own.
pub fn in_use(scene: &Scene, part: &str) -> String {
    let named = |room: &str| {
        hapflow_engine::settings::get(scene, &format!("{room}.{part}")).map_or(String::new(), |v| text(&v))
    };
    let plugins = named("plugin");
    if plugins.is_empty() { named("run") } else { plugins }
}

/// Means over equal parts of the run.
fn over_time(sent: &[DVec3]) -> Vec<[f64; 3]> {
    sent.chunks(sent.len().div_ceil(PARTS).max(1)).map(|part| signal::mean(part).to_array()).collect()
}

/// Weight of so many particles, N.
fn weight(scene: &Scene, particles: usize) -> f64 {
    particles as f64 * scene.fluid.particle_mass() * scene.fluid.gravity.length()
}

fn text(value: &hapflow_engine::Value) -> String {
    value.to_string().trim_matches('"').to_string()
}

fn timing(outcome: &Outcome) -> Value {
    let t = &outcome.timing;
    let per_second = t.simulated_s.max(1e-9);
    let mut timing = json!({
        "wall_s_per_sim_s": t.wall_s / per_second,
        "cpu_s_per_sim_s": t.cpu_s / per_second,
        "tick_p50_s": t.ticks.quantile_s(0.5),
        "tick_p999_s": t.ticks.quantile_s(0.999),
    });
    if let Some((status, pace)) = &outcome.realtime {
        timing["late_ticks"] = json!(t.ticks.late);
        timing["skipped_fluid_frames"] = json!(pace.skipped);
        timing["realtime_priority"] = json!(status.priority.to_string());
        timing["memory_lock"] = json!(status.memory.to_string());
    }
    timing
}
