//! `hapflow bench`: what the fluid costs.

mod felt;
mod filters;

use crate::cli::{Bench, BenchArgs, WorkPrecisionArgs};
use crate::cores::cores;
use crate::draw::chart::{self, Chart, Series};
use crate::run::Failure;
use hapflow_validation::bench::{self, Machine, Point, Saving, Speed};
use std::io::Write;

/// Width of the plot, and height of a panel, pixels.
const WIDTH: u32 = 1400;
const PANEL: u32 = 420;

/// Measures what was asked for.
pub fn bench(args: &BenchArgs) -> Result<(), Failure> {
    match &args.which {
        Bench::Skip(format) => skip(format.json),
        Bench::Speed(format) => speed(format.json),
        Bench::WorkPrecision(args) => work_precision(args),
        Bench::Felt(args) => felt::felt(args),
        Bench::Filters(args) => filters::filters(args),
    }
}

/// Prints a line; a closed pipe is no reason to fail.
fn say(line: &str) {
    let _ = writeln!(std::io::stdout(), "{line}");
}

fn skip(json: bool) -> Result<(), Failure> {
    eprintln!("costs by ratio, in turns within this run; about two minutes");
    if !json {
        say(&format!("{:<16} {:>10} {:<2} {:>7} {:<4} against", "what", "measured", "", "goal", "met"));
    }
    bench::skip(|saving| say(&if json { saving.json().to_string() } else { line(saving) }))?;
    Ok(())
}

/// A line of the table.
fn line(s: &Saving) -> String {
    let goal = s.goal.map_or("-".into(), |g| format!("{g}"));
    let met = s.met().map_or("", |met| if met { "yes" } else { "NO" });
    format!("{:<16} {:>10.4} {:<2} {goal:>7} {met:<4} {}", s.name, s.value, s.unit, s.about)
}

fn speed(json: bool) -> Result<(), Failure> {
    eprintln!(
        "the machine's bounds, then two scenes of 1000 to 100 000 particles on one and two threads; about two minutes"
    );
    let bounds = |m: &Machine| say(&if json { m.json().to_string() } else { bound_line(m) });
    let mut begun = false;
    bench::speed(bounds, |s| {
        if !json && !std::mem::replace(&mut begun, true) {
            say(&speed_head());
        }
        say(&if json { s.json().to_string() } else { speed_line(s) });
    })?;
    Ok(())
}

fn bound_line(m: &Machine) -> String {
    let (flop, bytes) = (1e-9 * m.flop_per_s, 1e-9 * m.bytes_per_s);
    format!("{} threads can do {flop:.1} GFLOP/s in registers, and {bytes:.1} GB/s from memory", m.threads)
}

fn speed_head() -> String {
    let stages = "sort neighbours walls pairs move";
    format!(
        "{:<10} {:>9} {:>3} {:>9} {:>9} {:>6} {:>6} {:>6} {:>6}  shares of {stages}",
        "scene", "particles", "thr", "M p-s/s", "per core", "pairs", "FMA", "memory", "growth"
    )
}

/// A line of the table.
fn speed_line(s: &Speed) -> String {
    let percent = |share: f64| format!("{:.1} %", 100.0 * share);
    let stages: Vec<_> = s.stages.iter().map(|(_, share)| percent(*share)).collect();
    let growth = s.growth.map_or("-".into(), |g| format!("{g:.2}"));
    format!(
        "{:<10} {:>9} {:>3} {:>9.3} {:>9.3} {:>6.1} {:>6} {:>6} {growth:>6}  {}",
        s.scene,
        s.particles,
        s.threads,
        1e-6 * s.rate,
        1e-6 * s.rate_per_core,
        s.pairs,
        percent(s.shares[0]),
        percent(s.shares[1]),
        stages.join(", ")
    )
}

fn work_precision(args: &WorkPrecisionArgs) -> Result<(), Failure> {
    eprintln!("four cases with ten choices of settings each, at one resolution or three; up to an hour");
    let threads = cores();
    let mut charts = Vec::new();
    if !args.json {
        say(&format!(
            "{:<10} {:<26} {:>9} {:>10} {:>12} {:<6} measured",
            "case", "who", "particles", "error", "CPU s/s", "front"
        ));
    }
    let progress = |what: &str| eprintln!("{what} ...");
    bench::work_precision(args.quick, threads, progress, |points| {
        for point in points {
            say(&if args.json { point.json().to_string() } else { point_line(point) });
        }
        charts.push(panel(points));
    })?;
    if let Some(path) = &args.plot {
        chart::save(&charts, path, WIDTH, PANEL * charts.len() as u32)?;
    }
    Ok(())
}

/// A line of the table.
fn point_line(p: &Point) -> String {
    let front = p.front.map_or("", |front| if front { "yes" } else { "no" });
    format!(
        "{:<10} {:<26} {:>9} {:>9.4} % {:>12.3} {front:<6} {}",
        p.case,
        p.who,
        p.particles,
        100.0 * p.error,
        p.cost,
        p.date.unwrap_or("now")
    )
}

/// One case: the front of hapflow's choices, every choice pale, and the peers.
fn panel(points: &[Point]) -> Chart {
    let place = |p: &Point| [p.cost, 100.0 * p.error];
    let line = |of: &dyn Fn(&Point) -> bool| {
        let mut line: Vec<_> = points.iter().filter(|p| of(p)).map(place).collect();
        line.sort_by(|a, b| a[0].total_cmp(&b[0]));
        line
    };
    let mut who: Vec<_> = points.iter().map(|p| &p.who).collect();
    who.dedup();
    let each = who.into_iter().map(|w| {
        let peer = points.iter().any(|p| p.who == *w && p.front.is_none());
        let series =
            Series::new("", crosses(&line(&|p| p.who == *w))).coloured(if peer { PEERS } else { OURS });
        if peer { series } else { series.faint() }
    });
    let named = |name: &str, colour| Series::new(name, Vec::new()).coloured(colour);
    let front = Series::new("front", line(&|p| p.front == Some(true))).coloured(OURS);
    let peers = points.iter().find(|p| p.front.is_none()).map(|_| {
        let date = points.iter().find_map(|p| p.date);
        named(&date.map_or("peers".into(), |date| format!("peers (dated: {date})")), PEERS)
    });
    Chart {
        title: points.first().map_or(String::new(), |p| p.case.clone()),
        x_label: "CPU time for a simulated second (s)".into(),
        y_label: "error (%)".into(),
        series: each.chain([front]).chain(peers).collect(),
        log: true,
    }
}

/// Colours of hapflow and of its peers.
const OURS: [u8; 3] = [0, 114, 178];
const PEERS: [u8; 3] = [213, 94, 0];

/// A cross at each of the points, and a line from one to the next.
fn crosses(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let arm = 1.06;
    let cross = |&[x, y]: &[f64; 2]| [[x / arm, y], [x * arm, y], [x, y], [x, y * arm], [x, y / arm], [x, y]];
    points.iter().flat_map(cross).collect()
}
