//! One line of the table: a quantity of a case at a spacing.

use crate::{Measure, Setup, Target, run::Report};
use hapflow_engine::Value;
use hapflow_haptics::CouplingKind;
use serde_json::{Map, json};

/// A quantity of a case at a spacing.
#[derive(Clone, Debug)]
pub struct Row {
    /// The case.
    pub case: &'static str,
    /// What was measured.
    pub measure: Measure,
    /// What it should be; none where that is not known.
    pub reference: Option<f64>,
    /// Spacing, m.
    pub dx: f64,
    /// Whether this is the spacing that the goal is for.
    pub dx_shipped: bool,
    /// Particles at the end.
    pub particles: usize,
    /// The solver.
    pub solver: String,
    /// The backend.
    pub backend: &'static str,
    /// Observed order of convergence over all spacings, where there are several.
    pub order: Option<f64>,
    /// CPU time of all threads for a simulated second, s.
    pub cpu_s_per_sim_s: f64,
    /// Time on the wall for a simulated second, s.
    pub wall_s_per_sim_s: f64,
    /// The case's parameters, and all that differs from the shipped configuration.
    pub parameters: Vec<(String, Value)>,
}

impl Row {
    /// The rows of a run that took `cpu_s` and `wall_s` seconds.
    pub(crate) fn all(setup: &Setup<'_>, report: Report, [cpu_s, wall_s]: [f64; 2]) -> Vec<Self> {
        let parameters = setup.parameters(&report.config.settings);
        let scene = hapflow_engine::Scene { fluid: report.config.settings, ..Default::default() };
        let solver =
            hapflow_engine::settings::get(&scene, "fluid.solver").map_or(String::new(), |v| text(&v));
        let row = |measure: Measure| Self {
            case: setup.case.name,
            reference: match measure.target {
                Target::Value(reference) => Some(reference),
                Target::Zero { .. } => Some(0.0),
                Target::Limit => None,
            },
            measure,
            dx: setup.dx,
            dx_shipped: (setup.dx / setup.shipped_dx() - 1.0).abs() < 1e-3,
            particles: report.particles,
            solver: solver.clone(),
            backend: report.backend,
            order: None,
            cpu_s_per_sim_s: cpu_s / report.simulated_s,
            wall_s_per_sim_s: wall_s / report.simulated_s,
            parameters: parameters.clone(),
        };
        report.measures.into_iter().map(row).collect()
    }

    /// Error: relative, or in units of the scale where the reference is 0; none without a reference.
    pub fn error(&self) -> Option<f64> {
        let reference = self.reference?;
        Some(match self.measure.target {
            Target::Zero { scale } => (self.measure.measured / scale).abs(),
            _ => (self.measure.measured / reference - 1.0).abs(),
        })
    }

    /// Whether the goal is met; none where no goal applies.
    pub fn pass(&self) -> Option<bool> {
        let goal = self.measure.goal.filter(|_| self.dx_shipped)?;
        let met = |least: f64| self.order.is_none_or(|order| order >= least);
        // A number that is not finite meets no goal.
        Some(self.error()? <= goal && self.measure.least_order.is_none_or(met))
    }

    /// Whether a missed goal counts: the baselines that a felt force is compared with are measured and not judged.
    pub fn is_judged(&self) -> bool {
        self.measure.felt.as_ref().is_none_or(|felt| felt.coupling == CouplingKind::Local.name())
    }

    /// Whether the goal of a felt force is met, beyond what it must reach; none where no goal applies.
    pub fn goal_met(&self) -> Option<bool> {
        let goal = self.measure.felt.as_ref()?.goal.filter(|_| self.dx_shipped)?;
        Some(self.error()? <= goal)
    }

    /// One line of JSON.
    pub fn json(&self) -> serde_json::Value {
        let parameters: Map<_, _> = self.parameters.iter().map(|(p, v)| (p.clone(), value(v))).collect();
        let mut line = json!({
            "case": self.case,
            "quantity": self.measure.quantity,
            "unit": self.measure.unit,
            "reference": self.reference,
            "measured": self.measure.measured,
            "error": self.error(),
            "goal": self.measure.goal,
            "pass": self.pass(),
            "dx": self.dx,
            "dx_shipped": self.dx_shipped,
            "particles": self.particles,
            "solver": self.solver,
            "backend": self.backend,
            "order": self.order,
            "cpu_s_per_sim_s": self.cpu_s_per_sim_s,
            "wall_s_per_sim_s": self.wall_s_per_sim_s,
            "parameters": parameters,
        });
        if let Target::Zero { scale } = self.measure.target {
            line["scale"] = json!(scale);
        }
        if let Some(felt) = &self.measure.felt {
            line["coupling"] = json!(felt.coupling);
            line["filter"] = json!(felt.filter);
            line["fluid_hz"] = json!(felt.fluid_hz);
            line["hand"] = json!(felt.hand);
            line["floor"] = json!(felt.floor);
            (line["must"], line["goal"]) = (json!(self.measure.goal), json!(felt.goal));
            line["goal_met"] = json!(self.goal_met());
        }
        line
    }
}

fn value(value: &Value) -> serde_json::Value {
    match value {
        Value::Number(n) => json!(n),
        Value::Bool(b) => json!(b),
        Value::Text(t) => json!(t),
        Value::Vector(v) => json!(v.to_array()),
    }
}

fn text(value: &Value) -> String {
    if let Value::Text(t) = value { t.clone() } else { value.to_string() }
}
