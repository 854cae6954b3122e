//! `hapflow falcon fk|force|decode|encode` as a script uses them.
#![allow(clippy::unwrap_used, clippy::panic)]

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn reference(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../devices/tests/data/falcon").join(name)
}

fn hapflow(words: &[&str], file: &Path) -> Output {
    Command::new(env!("CARGO_BIN_EXE_hapflow"))
        .arg("falcon")
        .arg(words[0])
        .arg(file)
        .args(&words[1..])
        .output()
        .unwrap()
}

/// A table's columns, by name.
struct Columns(Vec<Vec<String>>);

impl Columns {
    fn read(text: &str) -> Self {
        Self(text.lines().map(|line| line.split(',').map(str::to_owned).collect()).collect())
    }

    fn of(&self, name: &str) -> Vec<&str> {
        let at =
            self.0[0].iter().position(|known| known == name).unwrap_or_else(|| panic!("no column {name}"));
        self.0[1..].iter().map(|row| row[at].as_str()).collect()
    }

    fn numbers(&self, name: &str) -> Vec<f64> {
        self.of(name).iter().map(|text| text.parse().unwrap()).collect()
    }
}

/// What the command makes of the reference's input columns, beside the reference.
fn both(words: &[&str], name: &str, inputs: &[&str]) -> (Columns, Columns) {
    let expected = Columns::read(&std::fs::read_to_string(reference(name)).unwrap());
    let columns: Vec<_> = inputs.iter().map(|input| expected.of(input)).collect();
    let line = |row: usize| columns.iter().map(|c| c[row]).collect::<Vec<_>>().join(",");
    let lines: Vec<String> =
        std::iter::once(inputs.join(",")).chain((0..columns[0].len()).map(line)).collect();
    let file = file(&format!("{}-{name}", words[0]), &lines.join("\n"));
    let output = hapflow(words, &file);
    assert!(output.status.success() && output.stderr.is_empty(), "{output:?}");
    (Columns::read(&String::from_utf8(output.stdout).unwrap()), expected)
}

fn file(name: &str, text: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::write(&path, text).unwrap();
    path
}

#[test]
fn fk_finds_every_place() {
    let (found, expected) = both(&["fk"], "fk.csv", &["enc0_counts", "enc1_counts", "enc2_counts"]);
    for column in ["x_m", "y_m", "z_m"] {
        for (found, expected) in found.numbers(column).into_iter().zip(expected.numbers(column)) {
            assert!((found - expected).abs() < 1e-7, "{column} = {found} in place of {expected}");
        }
    }
    assert_eq!(found.0[0], ["enc0_counts", "enc1_counts", "enc2_counts", "x_m", "y_m", "z_m"]);
}

#[test]
fn force_gives_every_count() {
    let inputs = ["x_m", "y_m", "z_m", "fx_N", "fy_N", "fz_N"];
    let (found, expected) = both(&["force", "--counts-per-nm", "10000"], "force.csv", &inputs);
    let largest = |row: usize| {
        (0..3).map(|n| expected.numbers(&format!("motor{n}_fixed_counts"))[row].abs()).fold(0.0, f64::max)
    };
    for n in 0..3 {
        let wanted = expected.numbers(&format!("motor{n}_fixed_counts"));
        for (row, found) in found.numbers(&format!("motor{n}_counts")).into_iter().enumerate() {
            let wanted = wanted[row] * (4095.0 / largest(row)).min(1.0);
            assert!((found - wanted).abs() <= 2.0, "row {row}, motor {n}: {found} in place of {wanted}");
        }
        let torques = found.numbers(&format!("tau{n}_Nm"));
        for (found, expected) in torques.into_iter().zip(expected.numbers(&format!("tau{n}_fixed_Nm"))) {
            assert!((found - expected).abs() < 1e-6);
        }
    }
}

#[test]
fn packets_are_read_and_written() {
    let (found, expected) = both(&["decode"], "packets_in.csv", &["bytes_hex"]);
    for column in ["accepted", "enc0_counts", "enc1_counts", "enc2_counts", "homing_bits", "button_bits"] {
        assert_eq!(found.of(column), expected.of(column));
    }
    let inputs = ["motor0_counts", "motor1_counts", "motor2_counts", "led_mask", "homing"];
    let (found, expected) = both(&["encode"], "packets_out.csv", &inputs);
    assert_eq!(found.of("bytes_hex"), expected.of("bytes_hex"));
}

#[test]
fn the_geometry_is_chosen() {
    let rest = file("rest.csv", "enc0_counts,enc1_counts,enc2_counts\n0,0,0\n");
    let height = |words: &[&str]| {
        Columns::read(&String::from_utf8(hapflow(words, &rest).stdout).unwrap()).numbers("z_m")[0]
    };
    assert!((height(&["fk"]) - 0.1346).abs() < 1e-4);
    assert!((height(&["fk", "--geometry", "martin"]) - 0.1565).abs() < 1e-4);
    let own = Path::new(env!("CARGO_MANIFEST_DIR")).join("../devices/falcon/martin.toml");
    assert_eq!(height(&["fk", "--geometry", own.to_str().unwrap()]), height(&["fk", "--geometry", "martin"]));
}

/// One line that says what is wrong and where, exit code 2, and nothing on stdout.
#[test]
fn what_cannot_be_is_refused() {
    let refused = |words: &[&str], text: &str, expected: &str| {
        let path = file(&format!("refused-{}.csv", expected.len()), text);
        let output = hapflow(words, &path);
        let told = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{told}");
        assert!(output.stdout.is_empty());
        assert!(
            told.starts_with("hapflow: ") && told.lines().count() == 1 && told.contains(expected),
            "{told}"
        );
    };
    let counts = "enc0_counts,enc1_counts,enc2_counts\n";
    refused(
        &["fk"],
        &format!("{counts}0,0,0\n0,x,0\n"),
        "line 3: enc1_counts = \"x\" must be a whole number from -32768",
    );
    refused(
        &["fk"],
        &format!("{counts}3000,-3000,0\n"),
        "line 2: enc0_counts, enc1_counts, enc2_counts: the arms at",
    );
    refused(&["fk"], "enc0_counts\n0\n", "line 1: no column enc1_counts; found are enc0_counts");
    refused(
        &["fk"],
        "enc0_counts,enc1_counts\n",
        "line 1: no column enc2_counts; found are enc0_counts, enc1_counts",
    );
    refused(&["fk"], "", "line 1: no column enc0_counts; found are none");
    refused(&["fk", "--geometry", "novint"], counts, "geometry novint: no shipped set has that name");
    let place = "x_m,y_m,z_m,fx_N,fy_N,fz_N\n";
    refused(
        &["force"],
        &format!("{place}0,0,0.3,0,0,1\n"),
        "line 2: x_m, y_m, z_m: (0, 0, 0.3) m is out of reach",
    );
    refused(
        &["force"],
        &format!("{place}0,0,0.12,0,0,nan\n"),
        "line 2: fz_N = \"nan\" must be a number from -1000 to 1000",
    );
    refused(
        &["force", "--counts-per-nm", "-5"],
        place,
        "--counts-per-nm = -5 is outside its range 1 to 1000000",
    );
    refused(
        &["decode"],
        "bytes_hex\n3c 4\n",
        "line 2: bytes_hex = \"3c 4\" must be bytes of two hexadecimal digits",
    );
    let motors = "motor0_counts,motor1_counts,motor2_counts,led_mask,homing\n";
    refused(
        &["encode"],
        &format!("{motors}40000,0,0,0,0\n"),
        "motor0_counts = \"40000\" must be a whole number from -32768",
    );
    refused(
        &["encode"],
        &format!("{motors}0,0,0,3,0\n"),
        "led_mask = \"3\" must be a sum of 2 (green), 4 (blue)",
    );
    let absent = hapflow(&["fk"], Path::new("/nowhere/counts.csv"));
    assert_eq!(absent.status.code(), Some(2));
}
