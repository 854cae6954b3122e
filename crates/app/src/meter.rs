//! What the terminal shows while a run is under way: a progress bar, or a live force meter.

use hapflow_engine::run::Progress;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// Cells of the force meter.
const CELLS: usize = 24;

/// The line at the bottom of the terminal; nothing where nobody looks.
pub struct Meter {
    bar: ProgressBar,
    live: bool,
    full_scale_n: f64,
    quiet: bool,
    told: String,
}

impl Meter {
    /// `live` shows the force against `full_scale_n`; `quiet` shows nothing.
    pub fn new(quiet: bool, live: bool, full_scale_n: f64) -> Self {
        let target =
            if quiet { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr_with_hz(15) };
        let bar = ProgressBar::with_draw_target(Some(1000), target);
        let template =
            if live { "{elapsed_precise} {msg}" } else { "{bar:32} {percent:>3} %  {msg}  {eta} left" };
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style.progress_chars("━╸─"));
        }
        Self { bar, live, full_scale_n, quiet, told: String::new() }
    }

    /// Tells a person what to do, once for each new text.
    pub fn guide(&mut self, text: &str) {
        if self.told != text && !self.quiet {
            self.bar.suspend(|| eprintln!("{text}"));
            self.told = text.to_owned();
        }
    }

    /// Shows where a run stands.
    pub fn show(&self, p: &Progress<'_>) {
        self.bar.set_position((1000.0 * p.time_s / p.duration_s) as u64);
        let force = p.servo.sent.force;
        if self.live {
            let share = (force.length() / self.full_scale_n.max(1e-9)).clamp(0.0, 1.0);
            let filled = (share * CELLS as f64).round() as usize;
            let (on, off) = ("█".repeat(filled), "·".repeat(CELLS - filled));
            self.bar.set_message(format!(
                "|{on}{off}| {:5.2} N  ({:+.2} {:+.2} {:+.2})  {} particles  {}",
                force.length(),
                force.x,
                force.y,
                force.z,
                p.fluid.particles,
                p.servo.faults
            ));
        } else {
            self.bar.set_message(format!(
                "{:.2} of {} s, {} particles, {:.2} N",
                p.time_s,
                p.duration_s,
                p.fluid.particles,
                force.length()
            ));
        }
    }

    /// Takes the line away.
    pub fn clear(&self) {
        self.bar.finish_and_clear();
    }
}
