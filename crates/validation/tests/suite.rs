//! The suite from its plan to its rows, on a coarse case; and what it refuses.
#![allow(clippy::unwrap_used, clippy::panic)]

use hapflow_validation::{CASES, Plan, Row, find};

fn plan(case: &str, sets: &[&str], dx: Option<Vec<f64>>, quick: bool) -> Plan {
    let sets: Vec<String> = sets.iter().map(|s| s.to_string()).collect();
    Plan::new(&[find(case).unwrap()], &sets, dx, quick, 1).unwrap()
}

fn refused(case: &str, set: &str) -> String {
    Plan::new(&[find(case).unwrap()], &[set.to_string()], None, false, 1).unwrap_err().to_string()
}

fn rows(case: &str, sets: &[&str], dx: Vec<f64>) -> Vec<Row> {
    plan(case, sets, Some(dx), false).run_case(find(case).unwrap(), |_| {}).unwrap()
}

#[test]
fn a_line_of_json_has_the_agreed_names() {
    let rows = rows("momentum", &["density=870", "fluid.density_diffusion=0.05"], vec![0.02, 0.1 / 6.0]);
    assert_eq!(rows.len(), 2);
    let line = rows[0].json();
    let mut names: Vec<_> = line.as_object().unwrap().keys().map(String::as_str).collect();
    names.sort_unstable();
    let mut expected = [
        "case",
        "quantity",
        "unit",
        "reference",
        "measured",
        "error",
        "goal",
        "pass",
        "dx",
        "dx_shipped",
        "particles",
        "solver",
        "backend",
        "order",
        "cpu_s_per_sim_s",
        "wall_s_per_sim_s",
        "parameters",
        "scale",
    ];
    expected.sort_unstable();
    assert_eq!(names, expected);
    assert_eq!(line["solver"], "wcsph");
    assert_eq!(line["parameters"]["density"], 870.0);
    assert_eq!(line["parameters"]["fluid.density_diffusion"], 0.05);
    assert!(line["pass"].is_null() && line["dx_shipped"] == false, "no goal applies to this spacing");
    // The ball took what the water lost, to rounding.
    assert!(rows.iter().all(|r| r.error().unwrap() < 1e-3), "{rows:?}");
    assert!(rows[0].measure.measured > 0.0, "nothing was pushed: {rows:?}");
}

#[test]
fn variants_are_run_unless_their_parameters_are_chosen() {
    let case = find("jet-plate").unwrap();
    let count = |sets: &[&str], quick| {
        let groups = plan("jet-plate", sets, None, quick).setups(case).unwrap();
        groups.iter().map(Vec::len).collect::<Vec<_>>()
    };
    assert_eq!(count(&[], false), [3, 1, 1, 1, 1]);
    assert_eq!(count(&["jet-plate.speed=2"], false), [3, 1, 1, 1, 1]);
    assert_eq!(count(&["angle_deg=50"], false), [3, 1, 1]);
    assert_eq!(count(&[], true), [1]);
}

#[test]
fn bad_words_are_named_with_the_nearest() {
    assert_eq!(refused("buoyancy", "radus=0.1"), "no parameter \"radus\" in buoyancy; did you mean radius?");
    assert_eq!(
        refused("buoyancy", "start=calm"),
        "buoyancy.start = \"calm\": must be one of lattice, packed, stirred"
    );
    assert_eq!(
        refused("jet-plate", "angle_deg=120"),
        "jet-plate.angle_deg = 120: must be a number from 30 to 90 °"
    );
    assert_eq!(
        refused("jet-plate", "fluid.viscosty=1"),
        "no setting \"fluid.viscosty\"; did you mean fluid.viscosity?"
    );
    assert!(refused("jet-plate", "speed").contains("NAME=VALUE"));
    let text = Plan::new(&[&CASES[0]], &[], Some(vec![-1.0]), false, 1).unwrap_err().to_string();
    assert_eq!(text, "--dx -1: must be a number from 0.0001 to 1 m");
}

#[test]
fn a_setting_that_the_case_makes_itself_is_refused() {
    let case = find("momentum").unwrap();
    let plan = plan("momentum", &["fluid.rest_density=900"], Some(vec![0.02]), false);
    let text = plan.run_case(case, |_| {}).unwrap_err().to_string();
    assert!(text.starts_with("momentum sets fluid.rest_density = 1000 itself"), "{text}");
}

/// What of a felt crossing may be chosen, and that each choice reaches the fluid, the tool or the hand.
#[test]
fn a_felt_case_has_every_parameter_and_each_changes_something() {
    let run = |set: &str| {
        // In closed form, felt by one coupling: a second or so.
        let sets = ["backend=analytic-jet", "coupling=local", set];
        let plan = plan("felt-crossing", &sets, None, true);
        let rows = plan.run_case(find("felt-crossing").unwrap(), |_| {}).unwrap();
        rows.iter().map(|row| row.measure.measured).collect::<Vec<_>>()
    };
    let plain = run("speed=1.2");
    for set in [
        "diameter=0.016",
        "speed=1.5",
        "crossing_speed=0.3",
        "tool_radius=0.012",
        "hand_mass=0.3",
        "hand_damping=8",
        "hand_stiffness=600",
        "gain=3",
        "fluid_delay=0.5",
    ] {
        assert_ne!(run(set), plain, "{set}");
    }
    // Of a jet in closed form these are not part.
    for set in ["offset=0.01", "viscosity=0.01"] {
        plan("felt-crossing", &[set], None, true);
    }
    assert!(refused("felt-crossing", "fluid_delay=1.5").contains("fluid_delay = 1.5"));
    assert!(refused("felt-crossing", "gain=-1").contains("gain = -1"));
}
