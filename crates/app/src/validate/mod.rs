//! `hapflow validate`: runs the cases, tells what came of them, and judges.

pub mod plot;
pub mod table;

use crate::cli::ValidateArgs;
use crate::cores::cores;
use crate::run::Failure;
use hapflow_validation::{CASES, Case, Plan, Row, Setup, Shortfall, find, shortfalls};
use std::io::Write;

/// Runs what was asked for; true when every goal is met, but for the known shortfalls unless they count.
pub fn validate(args: &ValidateArgs) -> Result<bool, Failure> {
    let cases = chosen(args)?;
    if args.list {
        say(&table::list(&cases));
        return Ok(true);
    }
    plot::make_folder(args.plot.as_deref())?;
    let threads = cores();
    let plan = Plan::new(&cases, &settings(args), args.dx.clone(), args.quick, threads)?;
    let known = shortfalls();
    let (mut good, mut refused) = (true, None);
    if !args.json {
        say(&table::head());
    }
    for case in cases {
        let rows = match plan.run_case(case, progress) {
            // One case that cannot be run must not cost the others.
            Err(error) if args.cases.len() != 1 => {
                eprintln!("{} is left out: {error}", case.name);
                let expected = args.cases.is_empty() && error.is_unsupported();
                refused = refused.or((!expected).then_some(error));
                continue;
            }
            rows => rows?,
        };
        tell(args, &rows, &known);
        let mut judged = rows.iter().filter(|row| row.is_judged());
        good &= judged.all(|row| row.pass() != Some(false) || (!args.strict && is_known(row, &known)));
        let spaced = rows.iter().any(|row| row.measure.felt.is_none());
        if let Some(folder) = args.plot.as_ref().filter(|_| spaced) {
            plot::save(&rows, &folder.join(format!("{}.png", case.name)))?;
        }
    }
    refused.map_or(Ok(good), |error| Err(error.into()))
}

/// The cases that were named, in the order of the table; all if none was.
fn chosen(args: &ValidateArgs) -> Result<Vec<&'static Case>, Failure> {
    let named: Vec<_> = args.cases.iter().map(|name| find(name)).collect::<Result<_, _>>()?;
    let wanted = |case: &&Case| named.is_empty() || named.iter().any(|n| n.name == case.name);
    Ok(CASES.iter().filter(wanted).collect())
}

/// Everything that was set, that with a word of its own first.
fn settings(args: &ValidateArgs) -> Vec<String> {
    let solver = args.solver.iter().map(|s| format!("fluid.solver={s}"));
    let delay = args.fluid_delay.iter().map(|frames| format!("fluid_delay={frames}"));
    solver.chain(delay).chain(args.set.iter().cloned()).collect()
}

fn progress(setup: &Setup<'_>) {
    eprintln!("{} at dx = {:.4} mm ...", setup.case.name, 1e3 * setup.dx);
}

/// Prints a line; a closed pipe is no reason to fail.
fn say(line: &str) {
    let _ = writeln!(std::io::stdout(), "{line}");
}

fn tell(args: &ValidateArgs, rows: &[Row], known: &[Shortfall]) {
    for row in rows {
        let line = if args.json { row.json().to_string() } else { table::line(row, is_known(row, known)) };
        say(&line);
    }
}

fn is_known(row: &Row, known: &[Shortfall]) -> bool {
    known.iter().any(|s| s.case == row.case && s.quantity == row.measure.quantity)
}
