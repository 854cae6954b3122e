//! `hapflow plugin check`.

use crate::cli::PluginCommand;
use crate::run::Failure;
use hapflow_host::{Finding, Plugin, check};
use std::io::Write;

/// Checks a library, a line a finding; whether all holds.
pub fn plugin(command: &PluginCommand) -> Result<bool, Failure> {
    let PluginCommand::Check { file } = command;
    let plugin = Plugin::load(file).map_err(|e| Failure::Word(e.to_string()))?;
    Ok(check(plugin, say))
}

/// Prints a finding; a closed pipe is no reason to fail.
fn say(finding: &Finding) {
    let (word, text) = match &finding.verdict {
        Ok(text) => ("ok  ", text),
        Err(text) => ("FAIL", text),
    };
    let _ = writeln!(std::io::stdout(), "{word}  {:<9} {text}", finding.name);
}
