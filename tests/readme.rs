//! The README tells the truth: its settings table is the engine's, its scenes are the shipped ones.

const README: &str = include_str!("../README.md");

#[test]
fn the_settings_table_is_the_engines() {
    for line in hapflow::engine::settings::table().lines() {
        assert!(
            README.contains(line),
            "README lacks: {line}\nrun `hapflow scenes --settings` and paste its table"
        );
    }
}

#[test]
fn every_shipped_scene_is_in_the_table() {
    for (name, _) in hapflow::engine::shipped() {
        assert!(README.contains(&format!("| `{name}` |")), "{name}");
    }
}
