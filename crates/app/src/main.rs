//! The program `hapflow`: runs scenes, lists scenes and devices.
//!
//! Exit codes: 0 done, 1 a run that failed, 2 words, values or folders that cannot be used.
#![forbid(unsafe_code)]

mod cli;
mod draw;
mod list;
mod meter;
mod outputs;
mod run;
mod summary;

use clap::Parser;
use std::process::ExitCode;

fn main() -> ExitCode {
    let cli = match cli::Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) => return cli::explain(&error),
    };
    match dispatch(cli) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("hapflow: {failure}");
            ExitCode::from(failure.code())
        }
    }
}

fn dispatch(cli: cli::Cli) -> Result<(), run::Failure> {
    match cli.command.unwrap_or_default() {
        cli::Command::Run(args) => run::run(&args),
        cli::Command::Scenes(args) => {
            list::scenes(args.settings);
            Ok(())
        }
        cli::Command::Devices => {
            list::devices();
            Ok(())
        }
    }
}
