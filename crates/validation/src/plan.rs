//! Which cases are run with which settings at which spacings.

use crate::case::Variant;
use crate::{Case, Row, Setup, Target, ValidationError, stats};
use hapflow_engine::{Value, settings};
use hapflow_realtime::process_cpu_s;
use std::time::Instant;

/// Spacings that a fluid may have, m.
const SPACINGS: [f64; 2] = [1e-4, 1.0];

/// What somebody asks of the suite.
#[derive(Clone, Debug)]
pub struct Plan {
    /// `NAME`, `CASE.NAME` or `fluid.…`, and values; later ones count.
    settings: Vec<(String, Value)>,
    /// Spacings, m; none takes each case's own.
    dx: Option<Vec<f64>>,
    /// Only the shipped spacing and the first variant.
    quick: bool,
    threads: usize,
}

impl Plan {
    /// A plan for `cases` with `sets` (`NAME=VALUE`), checked.
    ///
    /// # Errors
    /// A name that no case knows, or a value that does not fit.
    pub fn new(
        cases: &[&Case],
        sets: &[String],
        dx: Option<Vec<f64>>,
        quick: bool,
        threads: usize,
    ) -> Result<Self, ValidationError> {
        let split = |set: &String| {
            let (name, value) =
                set.split_once('=').ok_or_else(|| ValidationError::NotASetting(set.clone()))?;
            Ok((name.trim().to_string(), Value::parse(value)))
        };
        for dx in dx.iter().flatten() {
            if !(SPACINGS[0]..=SPACINGS[1]).contains(dx) {
                return Err(ValidationError::Spacing(*dx, SPACINGS));
            }
        }
        let settings = sets.iter().map(split).collect::<Result<Vec<_>, ValidationError>>()?;
        let plan = Self { settings, dx, quick, threads };
        for (name, _) in &plan.settings {
            if !cases.iter().any(|case| means(name, case).is_some()) {
                return Err(unknown(name, cases));
            }
        }
        for case in cases {
            plan.setups(case)?;
        }
        Ok(plan)
    }

    /// Every run of `case`: one group for each variant, of one setup for each spacing.
    ///
    /// # Errors
    /// A value that does not fit.
    pub fn setups<'a>(&self, case: &'a Case) -> Result<Vec<Vec<Setup<'a>>>, ValidationError> {
        let chosen = |name: &str| self.settings.iter().any(|(n, _)| means(n, case) == Some(name));
        let free = |variant: &&Variant| !variant.iter().any(|(name, _)| chosen(name));
        let variants = case.variants.iter().skip(1).filter(free).filter(|_| !self.quick);
        let variants: Vec<Variant> = std::iter::once::<Variant>(&[]).chain(variants.copied()).collect();
        let group = |(k, variant): (usize, &Variant)| self.group(case, variant, k == 0);
        variants.iter().enumerate().map(group).collect()
    }

    fn group<'a>(
        &self,
        case: &'a Case,
        variant: Variant,
        first: bool,
    ) -> Result<Vec<Setup<'a>>, ValidationError> {
        let mut setup = Setup::new(case, self.threads);
        for (name, text) in variant {
            setup.set(name, &Value::parse(text))?;
        }
        for (name, value) in &self.settings {
            if let Some(name) = means(name, case) {
                setup.set(name, value)?;
            }
        }
        let length = setup.number(case.length);
        let mut cells = if first && !self.quick { case.cells.to_vec() } else { vec![case.cells[0]] };
        // A case that is for one spacing only says it thrice.
        cells.dedup();
        let own = || cells.iter().map(|n| length / n).collect();
        let spacings = self.dx.clone().unwrap_or_else(own);
        Ok(spacings.into_iter().map(|dx| setup.at(dx)).collect())
    }

    /// Runs `case`; `begin` hears of each run before it starts.
    ///
    /// # Errors
    /// What the fluid refuses.
    pub fn run_case(
        &self,
        case: &Case,
        mut begin: impl FnMut(&Setup<'_>),
    ) -> Result<Vec<Row>, ValidationError> {
        let mut rows = Vec::new();
        for group in self.setups(case)? {
            let mut here = Vec::new();
            for setup in &group {
                begin(setup);
                let (cpu, wall) = (process_cpu_s(), Instant::now());
                let report = (case.run)(setup)?;
                let cost = [process_cpu_s() - cpu, wall.elapsed().as_secs_f64()];
                here.extend(Row::all(setup, report, cost));
            }
            converge(&mut here);
            rows.extend(here);
        }
        Ok(rows)
    }
}

/// Fills in what only several spacings together tell: limits and orders.
fn converge(rows: &mut [Row]) {
    let quantities: Vec<_> = rows.iter().map(|r| r.measure.quantity).collect();
    let same = |rows: &[Row], k: usize| -> Vec<Row> {
        rows.iter().filter(|r| r.measure.quantity == quantities[k]).cloned().collect()
    };
    for k in 0..rows.len() {
        let all = same(rows, k);
        if rows[k].measure.target == Target::Limit {
            let values: Vec<_> = all.iter().map(|r| [r.dx, r.measure.measured]).collect();
            rows[k].reference = stats::limit(&values);
        } else {
            let errors: Vec<_> = all.iter().filter_map(|r| Some([r.dx, r.error()?])).collect();
            rows[k].order = stats::order(&errors);
        }
    }
}

/// What `name` of a `--set` means to `case`: a parameter, a setting of the fluid, or nothing.
fn means<'n>(name: &'n str, case: &Case) -> Option<&'n str> {
    let mine = name.strip_prefix(case.name).and_then(|rest| rest.strip_prefix('.')).unwrap_or(name);
    let known = mine.starts_with("fluid.") || case.parameters.iter().any(|p| p.name == mine);
    known.then_some(mine)
}

fn unknown(name: &str, cases: &[&Case]) -> ValidationError {
    let plain = cases.iter().flat_map(|c| c.parameters.iter().map(|p| p.name.to_string()));
    let full = cases.iter().flat_map(|c| c.parameters.iter().map(|p| format!("{}.{}", c.name, p.name)));
    let hint = match settings::nearest(plain.chain(full), name) {
        Some(known) => format!("; did you mean {known}?"),
        None => "; `hapflow validate --list` lists them all".into(),
    };
    let cases = cases.iter().map(|c| c.name).collect::<Vec<_>>().join(", ");
    ValidationError::UnknownParameter { name: name.into(), cases, hint }
}
