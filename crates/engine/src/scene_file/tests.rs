use super::*;

const SMALL: &str = r#"
name = "small"
[run]
fluid_hz = 60
[fluid]
spacing = 0.01
[[source]]
name = "tap"
position = [0.0, 0.1, 0.0]
speed = 1.5
[[change]]
at_s = 2.0
fluid.viscosity = 0.1
source.tap.speed = 2.0
[[change]]
at_s = 1.0
fluid.mode = "mixed"
"#;

fn error(text: &str) -> String {
    parse(text, "my.toml").map(|_| String::new()).unwrap_or_else(|e| e.to_string())
}

#[test]
fn a_scene_is_read_whole() {
    let scene = parse(SMALL, "small.toml").unwrap();
    assert_eq!((scene.name.as_str(), scene.run.fluid_hz, scene.fluid.spacing), ("small", 60.0, 0.01));
    assert_eq!((scene.sources[0].name.as_str(), scene.sources[0].speed), ("tap", 1.5));
    // Changes come in order of time, their nested keys as paths.
    assert_eq!((scene.changes[0].at_s, scene.changes[1].at_s), (1.0, 2.0));
    let mut paths: Vec<_> = scene.changes[1].settings.iter().map(|s| s.0.as_str()).collect();
    paths.sort_unstable();
    assert_eq!(paths, ["fluid.viscosity", "source.tap.speed"]);
}

#[test]
fn a_wrong_file_is_told_by_file_line_field_value_and_range() {
    for (text, expected) in [
        (
            "[fluid]\nspacing = 0.01\nviscosity = -2\n",
            "my.toml:3: fluid.viscosity = -2: must be a number from 0 to 10000 Pa·s",
        ),
        (
            "[fluid]\nsolver = \"sph\"\n",
            "my.toml:2: fluid.solver = \"sph\": must be one of wcsph, dfsph, muller",
        ),
        (
            "\n[fluid]\nviscosty = 1\n",
            "my.toml:3: no setting \"fluid.viscosty\"; did you mean fluid.viscosity?",
        ),
        ("[fliud]\nspacing = 1\n", "my.toml:2: no setting \"fliud.spacing\"; did you mean fluid.spacing?"),
        ("colour = 3\n", "my.toml:1: \"colour\" is unknown"),
        ("[[source]]\nspeed = 99\n", "my.toml:2: source.speed = 99: must be a number from 0 to 20 m/s"),
        ("[[source]]\nsped = 1\n", "my.toml:2: no setting \"source.sped\"; there are position"),
        ("[container]\nmin = [0, 0, 0]\n", "my.toml:1: container needs min and max"),
        ("[container]\nmin = [0, 0, 0]\nmax = [1, -1, 1]\n", "my.toml:1: container: each coordinate of min"),
        ("[[change]]\nfluid.viscosity = 1\n", "my.toml:1: change needs at_s"),
        (
            "[[change]]\nat_s = 1\nrun.fluid_hz = 60\n",
            "my.toml:3: run.fluid_hz cannot change while a session runs",
        ),
        ("[hand]\npreset = \"iron\"\n", "my.toml:2: hand.preset = \"iron\": must be one of free"),
        ("[hand]\nscript = [{ hodl = 1 }]\n", "my.toml:2: hand.script: \"hodl\" is unknown"),
        ("[hand]\nscript = [{ move = [1, 2, 3] }]\n", "my.toml:2: hand.script: \"in\" is missing"),
        ("[run]\nfilter = \"hann:0\"\n", "my.toml:2: run.filter = \"hann:0\""),
        ("[tool]\nposition = [1, 2]\n", "my.toml:2: a number, a text, true, false or [x, y, z] expected"),
        ("[fluid]\nspacing = nan\n", "my.toml:2: fluid.spacing = NaN: must be a number"),
        ("[fluid\n", "my.toml:1: "),
        ("fluid = 3\n", "my.toml:1: \"fluid\" must be written as a table, [fluid]"),
        ("source = 3\n", "my.toml:1: \"source\" must be written as a table, [[source]]"),
    ] {
        let told = error(text);
        assert!(told.starts_with(expected), "{text}\n told: {told}\n  not: {expected}");
        assert_eq!(told.lines().count(), 1, "{told}");
    }
}

#[test]
fn what_cannot_be_stable_is_refused_with_its_line_and_reason() {
    let told = error("[fluid]\nsolver = \"muller\"\nspacing = 0.002\nviscosity = 5000\n");
    assert!(told.starts_with("my.toml:") && told.contains("fluid.viscosity is too high"), "{told}");
    let told = error("[[change]]\nat_s = 1\nfluid.viscosity = 9000\nfluid.solver = \"muller\"\n");
    assert!(told.contains("change at 1 s") && told.contains("fluid.viscosity"), "{told}");
}

#[test]
fn no_text_makes_the_reader_panic() {
    let whole = SMALL.to_string() + include_str!("../../../../scenes/tap.toml");
    for cut in 0..whole.len() {
        if whole.is_char_boundary(cut) {
            let _ = parse(&whole[..cut], "cut.toml");
        }
    }
    // Every value replaced by one of another kind.
    for junk in ["3", "\"x\"", "[]", "[1]", "{}", "true", "1979-05-27", "[[1]]", "inf"] {
        for line in SMALL.lines().filter(|l| l.contains('=')) {
            let (key, _) = line.split_once('=').unwrap();
            let _ = parse(&SMALL.replace(line, &format!("{key} = {junk}")), "junk.toml");
        }
    }
}

/// A liquid comes before the single values of its table or its change, wherever it stands in them.
#[test]
fn a_liquid_is_taken_before_the_values_that_are_set_over_it() {
    let scene = parse(
        "[fluid]\nviscosity = 5.0\nliquid = \"honey\"\n[[change]]\nat_s = 1.0\n\
         fluid.rest_density = 900.0\nfluid.liquid = \"oil\"\n",
        "my.toml",
    )
    .unwrap();
    assert_eq!((scene.fluid.rest_density, scene.fluid.viscosity), (1430.0, 5.0));
    let mut later = scene.clone();
    for (path, value) in &scene.changes[0].settings {
        settings::set_live(&mut later, path, value).unwrap();
    }
    assert_eq!((later.fluid.rest_density, later.fluid.viscosity), (900.0, 0.084));
    assert_eq!(settings::get(&later, "fluid.liquid").unwrap(), Value::Text("custom".into()));
}
