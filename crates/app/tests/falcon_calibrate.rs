//! `hapflow falcon calibrate`, at an emulated Falcon in real time and from files of readings.
#![allow(clippy::unwrap_used, clippy::panic)]

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn hapflow(words: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_hapflow")).arg("falcon").args(words).output().unwrap()
}

fn path(name: &str) -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join(name)
}

fn file(name: &str, text: &str) -> String {
    std::fs::write(path(name), text).unwrap();
    path(name).to_str().unwrap().to_owned()
}

fn told(output: &Output) -> (String, String) {
    let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).unwrap();
    (text(&output.stdout), text(&output.stderr))
}

/// The numbers of a key in a parameter file.
fn numbers(text: &str, key: &str) -> Vec<f64> {
    let line = text.lines().find(|line| line.starts_with(&format!("{key} = "))).unwrap();
    let values = line.split_once('=').unwrap().1.trim_matches([' ', '[', ']']);
    values.split(", ").map(|value| value.parse().unwrap()).collect()
}

/// The default set, with other zero angles and another strength.
fn wrong(name: &str) -> String {
    let set = include_str!("../../devices/falcon/libnifalcon.toml");
    let changed: Vec<_> = set
        .lines()
        .map(|line| match line.split(" = ").next() {
            Some("zero_deg") => "zero_deg = [38.0, 33.5, 36.2]",
            Some("counts_per_nm") => "counts_per_nm = 9000",
            _ => line,
        })
        .collect();
    file(name, &changed.join("\n"))
}

/// The emulated Falcon is the default set's, and the driver is told another: the default's numbers are found, and written to
/// a file that another command takes.
#[test]
fn a_wrong_set_is_put_right() {
    let (wrong, out) = (wrong("wrong.toml"), path("found.toml"));
    let words = ["calibrate", "--emulated", "--geometry", &wrong, "--at", "0,0,0.125", "--mass", "0.2"];
    let output = hapflow(&[&words[..], &["--out", out.to_str().unwrap()]].concat());
    let (said, asked) = told(&output);
    assert!(output.status.success() && said.is_empty(), "{output:?}");
    let order =
        ["homed\n", "hold the grip still\n", "let go of the grip", "hang 0.2 kg", "take hold of the grip"];
    assert!(order.map(|text| asked.find(text).unwrap()).is_sorted(), "{asked}");
    let found = std::fs::read_to_string(&out).unwrap();
    assert!(numbers(&found, "zero_deg").into_iter().all(|zero| (zero - 35.0).abs() < 0.037), "{found}");
    assert!((numbers(&found, "counts_per_nm")[0] / 6616.0 - 1.0).abs() < 0.01, "{found}");
    assert!(found.contains("--set mapping.carried_mass=0.1"), "{found}");
    let rest = file("rest.csv", "enc0_counts,enc1_counts,enc2_counts\n0,0,0\n");
    let (places, _) = told(&hapflow(&["fk", &rest, "--geometry", out.to_str().unwrap()]));
    let height: f64 = places.trim().rsplit(',').next().unwrap().parse().unwrap();
    assert!((height - 0.1346).abs() < 1e-4, "{places}");
}

#[test]
fn readings_in_files_need_no_falcon() {
    let counts = "enc0_counts,enc1_counts,enc2_counts";
    let set = wrong("readings.toml");
    let (fk, _) = told(&hapflow(&[
        "fk",
        &file("held.csv", &format!("{counts}\n0,0,0\n-300,150,40.0\n")),
        "--geometry",
        &set,
    ]));
    let places = file("places.csv", &fk);
    let at = fk.lines().nth(1).unwrap().split_once("0,0,0,").unwrap().1;
    let rows: Vec<_> = [0.0, 0.1, 0.3]
        .into_iter()
        .map(|mass: f64| format!("{mass},0,0,0,{at},0,{},0", (0.15 + mass) * 9.80665))
        .collect();
    let asked =
        file("asked.csv", &format!("mass_kg,{counts},x_m,y_m,z_m,fx_N,fy_N,fz_N\n{}\n", rows.join("\n")));
    let (force, _) = told(&hapflow(&["force", &asked, "--geometry", &set, "--counts-per-nm", "7000"]));
    let masses = file("masses.csv", &force);
    let output = hapflow(&["calibrate", "--places", &places, "--masses", &masses]);
    let (found, err) = told(&output);
    assert!(output.status.success() && err.is_empty(), "{err}");
    for (found, truth) in numbers(&found, "zero_deg").into_iter().zip([38.0, 33.5, 36.2]) {
        assert!((found - truth).abs() < 1e-6, "{found} in place of {truth}");
    }
    assert!((numbers(&found, "counts_per_nm")[0] / 7000.0 - 1.0).abs() < 2e-3, "{found}");
    assert!(found.contains("zero_deg: 2 held") && found.contains("grip weighs 0.15"), "{found}");
}

#[test]
fn what_cannot_be_is_refused() {
    let header = "enc0_counts,enc1_counts,enc2_counts,motor0_counts,motor1_counts,motor2_counts,mass_kg\n";
    let refused = |words: &[&str], expected: &str| {
        let output = hapflow(&[&["calibrate", "--emulated"], words].concat());
        let (out, err) = told(&output);
        assert_eq!(output.status.code(), Some(2), "{err}");
        assert!(out.is_empty() && err.lines().count() == 1 && err.contains(expected), "{err}");
    };
    let masses = |name: &str, rows: &str| file(name, &format!("{header}{rows}"));
    refused(&[], "--at <X,Y,Z>|--mass <KG>|--places <FILE.csv>|--masses <FILE.csv>");
    refused(&["--at", "0,0"], "--at: write it as X,Y,Z, in metres");
    refused(&["--at", "0,0,0.3"], "--at: (0, 0, 0.3) m is out of reach");
    refused(&["--at", "nan,0,0"], "--at: it is not finite");
    refused(&["--mass", "0.6"], "--mass = 0.6 is outside its range 0.02 to 0.5");
    refused(&["--masses", &masses("none.csv", "")], "loads must differ");
    refused(
        &["--masses", &masses("nan.csv", "0,0,0,1,1,1,nan\n")],
        "line 2: mass_kg = \"nan\" must be a number from 0 to 0.5",
    );
    refused(
        &["--masses", &masses("far.csv", "9000,0,0,1,1,1,0\n")],
        "line 2: enc0_counts, enc1_counts, enc2_counts: the arms at",
    );
    refused(
        &["--masses", &masses("still.csv", "0,0,0,0,0,0,0\n0,0,0,0,0,0,0.2\n")],
        "counts_per_nm = 0 is outside its range",
    );
    refused(
        &["--masses", &masses("down.csv", "0,0,0,0,0,0,0\n0,0,0,-2481,669,1691,0.2\n")],
        "off the vertical",
    );
    refused(&["--places", &file("empty.csv", "")], "line 1: no column");
}
