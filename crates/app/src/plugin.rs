//! `hapflow plugin check`, and what `hapflow run --plugin` takes.

use crate::cli::PluginCommand;
use crate::run::Failure;
use hapflow_engine::Parts;
use hapflow_host::{Extensions, Finding, Plugin, PluginCoupling, PluginFluid, check, find};
use std::collections::BTreeMap;
use std::io::Write;
use std::sync::Arc;

/// Plugins, and what they bring.
#[derive(Default)]
pub struct Plugins {
    /// By name.
    pub parts: Parts,
    loaded: Vec<Extensions>,
}

impl Plugins {
    /// Loads each by its file or name.
    pub fn load(names: &[String]) -> Result<Self, Failure> {
        let mut plugins = Self::default();
        let path = std::env::var_os("HAPFLOW_PLUGIN_PATH");
        for name in names {
            let found = find(name, path.as_deref()).and_then(|file| Extensions::load(&file));
            plugins.add(found.map_err(|e| Failure::Word(format!("--plugin {e}")))?)?;
        }
        Ok(plugins)
    }

    fn add(&mut self, plugin: Extensions) -> Result<(), Failure> {
        if let Some(fluid) = plugin.fluid.clone() {
            let name = fluid.name();
            put(&mut self.parts.backends, "fluid", name, Arc::new(move |config| fluid.create(config)))?;
        }
        if let Some(coupling) = plugin.coupling.clone() {
            let name = coupling.name();
            put(&mut self.parts.couplings, "coupling", name, Arc::new(move || coupling.create()))?;
        }
        if let Some(device) = plugin.device.clone() {
            let name = device.name();
            put(&mut self.parts.devices, "device", name, Arc::new(move |origin| device.open(origin)))?;
        }
        self.loaded.push(plugin);
        Ok(())
    }

    /// Why one of them failed while it ran.
    pub fn failure(&self) -> Option<String> {
        let reason = |plugin: &Extensions| {
            let fluid = plugin.fluid.as_ref().and_then(PluginFluid::failure);
            let coupling = plugin.coupling.as_ref().and_then(PluginCoupling::failure);
            fluid.or(coupling).map(str::to_string)
        };
        self.loaded.iter().find_map(reason)
    }
}

fn put<M>(parts: &mut BTreeMap<String, M>, what: &str, name: &str, make: M) -> Result<(), Failure> {
    match parts.insert(name.into(), make) {
        None => Ok(()),
        Some(_) => Err(Failure::Word(format!("--plugin: two plugins bring a {what} named {name}"))),
    }
}

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
