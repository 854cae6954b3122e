//! The program `hapflow`: runs scenes, lists scenes and devices, checks the machine, validates the fluid and shakes it.
//!
//! Exit codes: 0 done, 1 a run that failed, a goal that is missed, a trial that does not hold or a machine that lacks something, 2 words, values or folders that
//! cannot be used.
#![forbid(unsafe_code)]

mod bench;
mod cli;
mod cores;
mod doctor;
mod draw;
mod falcon;
mod list;
mod meter;
mod outputs;
mod plugin;
mod run;
mod stop;
mod stress;
mod summary;
mod validate;
mod viscosity;

use clap::Parser;
use std::process::ExitCode;

fn main() -> ExitCode {
    let cli = match cli::Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) => return cli::explain(&error),
    };
    match dispatch(cli) {
        Ok(code) => code,
        Err(failure) => {
            eprintln!("hapflow: {failure}");
            ExitCode::from(failure.code())
        }
    }
}

fn dispatch(cli: cli::Cli) -> Result<ExitCode, run::Failure> {
    match cli.command.unwrap_or_default() {
        cli::Command::Run(args) => run::run(&args)?,
        cli::Command::Scenes(args) => list::scenes(args.settings),
        cli::Command::Devices(args) => list::devices(args.json),
        cli::Command::Falcon(command) => falcon::falcon(&command)?,
        cli::Command::Validate(args) if validate::validate(&args)? => {}
        cli::Command::Validate(_) => return Ok(ExitCode::FAILURE),
        cli::Command::Bench(args) => bench::bench(&args)?,
        cli::Command::Stress(args) if stress::stress(&args)? => {}
        cli::Command::Stress(_) => return Ok(ExitCode::FAILURE),
        cli::Command::Plugin(command) if plugin::plugin(&command)? => {}
        cli::Command::Plugin(_) => return Ok(ExitCode::FAILURE),
        cli::Command::Doctor(args) if doctor::doctor(&args) => {}
        cli::Command::Doctor(_) => return Ok(ExitCode::FAILURE),
    }
    Ok(ExitCode::SUCCESS)
}
