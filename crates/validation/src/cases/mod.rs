//! The cases, one a file.

mod added_mass;
mod buoyancy;
mod buoyancy_partial;
mod couette;
mod dam_break;
mod drag_sphere;
mod energy;
mod hydrostatic;
mod jet_fall;
mod jet_plate;
mod jet_sphere;
mod momentum;
mod poiseuille;
mod sloshing;
mod spin;
mod taylor_couette;
mod taylor_green;
mod terminal_velocity;
mod tow;

use crate::{Case, ValidationError, felt};
use hapflow_engine::settings;

/// All cases, in the order of the table.
pub const CASES: &[Case] = &[
    hydrostatic::CASE,
    buoyancy::CASE,
    tow::CASE,
    buoyancy_partial::CASE,
    jet_fall::CASE,
    jet_plate::CASE,
    jet_sphere::CASE,
    drag_sphere::CASE,
    added_mass::CASE,
    terminal_velocity::CASE,
    couette::CASE,
    poiseuille::CASE,
    taylor_couette::CASE,
    taylor_green::CASE,
    sloshing::CASE,
    dam_break::CASE,
    spin::CASE,
    momentum::CASE,
    energy::CASE,
    felt::CASES[0],
    felt::CASES[1],
    felt::CASES[2],
    felt::CASES[3],
    felt::CASES[4],
    felt::CASES[5],
    felt::CASES[6],
    felt::CASES[7],
];

/// The case of that name.
///
/// # Errors
/// No such case; the nearest name.
pub fn find(name: &str) -> Result<&'static Case, ValidationError> {
    CASES.iter().find(|c| c.name == name).ok_or_else(|| {
        let hint = match settings::nearest(CASES.iter().map(|c| c.name.to_string()), name) {
            Some(known) => format!("; did you mean {known}?"),
            None => "; `hapflow validate --list` lists them all".into(),
        };
        ValidationError::UnknownCase { name: name.into(), hint }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Setup;
    use hapflow_engine::Value;

    #[test]
    fn every_case_takes_its_own_defaults_and_variants() {
        for case in CASES {
            let mut setup = Setup::new(case, 1);
            assert!(setup.dx > 0.0, "{}: {} is no parameter", case.name, case.length);
            let settings = case.parameters.iter().map(|p| (p.name, p.default));
            for (name, text) in settings.chain(case.variants.iter().flat_map(|v| v.iter().copied())) {
                assert!(case.parameters.iter().any(|p| p.name == name), "{}.{name}", case.name);
                setup.set(name, &Value::parse(text)).unwrap();
            }
            assert!(case.cells.is_sorted(), "{}: the shipped spacing is the coarsest", case.name);
        }
    }

    #[test]
    fn an_unknown_case_gets_the_nearest() {
        assert_eq!(find("boyancy").unwrap_err().to_string(), "no case \"boyancy\"; did you mean buoyancy?");
        assert!(find("x").unwrap_err().to_string().contains("--list"));
    }
}
