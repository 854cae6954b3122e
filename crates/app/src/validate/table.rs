//! What people read of the cases: the list of them, and the table of results.

use hapflow_engine::Value;
use hapflow_validation::{Case, Row, Setup};

/// The cases with their references and parameters.
pub fn list(cases: &[&Case]) -> String {
    let entry = |case: &&Case| {
        let dx = 1e3 * Setup::new(case, 1).shipped_dx();
        let mut text = format!(
            "{}: {}\n    reference: {}\n    shipped spacing {dx:.4} mm\n",
            case.name, case.about, case.source
        );
        for p in case.parameters {
            let allowed = p.kind.allowed(p.unit);
            text += &format!("    {:<14} {:<8} {allowed}: {}\n", p.name, p.default, p.about);
        }
        text
    };
    cases.iter().map(entry).collect::<Vec<_>>().join("\n")
}

/// The first line of the table.
pub fn head() -> String {
    format!(
        "{:<17} {:<19} {:>9} {:>12} {:>12} {:<5} {:>9} {:>6} {:>7} {:<12} {:>9} {:>9}  parameters",
        "case",
        "quantity",
        "dx (mm)",
        "reference",
        "measured",
        "unit",
        "error",
        "order",
        "goal",
        "met",
        "particles",
        "CPU s/s"
    )
}

/// A line of the table.
pub fn line(row: &Row, known: bool) -> String {
    let m = &row.measure;
    let met = match row.pass() {
        None => "",
        Some(true) if row.goal_met() == Some(false) => "yes, no goal",
        Some(true) => "yes",
        Some(false) if !row.is_judged() => "no",
        Some(false) if known => "no (known)",
        Some(false) => "NO",
    };
    let percent = |x: f64| format!("{} %", number(100.0 * x));
    let maybe = |x: Option<f64>, text: fn(f64) -> String| x.map_or("-".to_string(), text);
    format!(
        "{:<17} {:<19} {:>9.4} {:>12} {:>12} {:<5} {:>9} {:>6} {:>7} {:<12} {:>9} {:>9.2}  {}",
        row.case,
        m.quantity,
        1e3 * row.dx,
        maybe(row.reference, number),
        number(m.measured),
        m.unit,
        maybe(row.error(), percent),
        maybe(row.order, |o| format!("{o:.2}")),
        maybe(m.goal, |g| format!("{} %", (1e4 * g).round() / 100.0)),
        met,
        row.particles,
        row.cpu_s_per_sim_s,
        how(row)
    )
}

/// How it was felt, if it was, and with which parameters.
fn how(row: &Row) -> String {
    let parameters = parameters(&row.parameters);
    let Some(felt) = &row.measure.felt else { return parameters };
    let floor = felt.floor.map_or(String::new(), |f| format!(" floor={}", number(f)));
    format!("{} {}{floor} {parameters}", felt.coupling, felt.filter)
}

fn parameters(list: &[(String, Value)]) -> String {
    list.iter().map(|(name, value)| format!("{name}={value}")).collect::<Vec<_>>().join(" ")
}

/// A number with four or five digits.
fn number(x: f64) -> String {
    match x.abs() {
        0.0 => "0".into(),
        small if small < 1e-3 => format!("{x:.2e}"),
        size => {
            let places = (3.0 - size.log10().floor()).clamp(0.0, 6.0) as usize;
            format!("{x:.places$}")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_four_digits() {
        let written = [0.0, 21.039, 1962.2, 0.01054, 3.2e-6, -0.5, f64::NAN].map(number);
        assert_eq!(written, ["0", "21.04", "1962", "0.01054", "3.20e-6", "-0.5000", "NaN"]);
    }
}
