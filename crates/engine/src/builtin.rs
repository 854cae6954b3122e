//! The shipped scenes and meshes, and scenes by name or path.

use crate::{Scene, SceneError, scene_file};
use hapflow_devices::read_text_at_most;
use std::path::Path;

/// The largest scene file, bytes.
const MOST_BYTES: u64 = 16 << 20;

const SHIPPED: &[(&str, &str)] = &[
    ("tap", include_str!("../../../scenes/tap.toml")),
    ("tap-intermittent", include_str!("../../../scenes/tap-intermittent.toml")),
    ("waterfall", include_str!("../../../scenes/waterfall.toml")),
    ("tank", include_str!("../../../scenes/tank.toml")),
    ("paddle", include_str!("../../../scenes/paddle.toml")),
    ("bowl", include_str!("../../../scenes/bowl.toml")),
    ("stir-water", include_str!("../../../scenes/stir-water.toml")),
    ("stir-honey", include_str!("../../../scenes/stir-honey.toml")),
    ("dip", include_str!("../../../scenes/dip.toml")),
    ("pour", include_str!("../../../scenes/pour.toml")),
];

/// Shipped meshes, as Wavefront OBJ.
const MESHES: &[(&str, &str)] = &[("cup", include_str!("../../../scenes/cup.obj"))];

/// The text of the shipped mesh of that name.
pub(crate) fn mesh(name: &str) -> Option<&'static str> {
    MESHES.iter().find(|(known, _)| *known == name).map(|(_, text)| *text)
}

/// Names and texts of the shipped scenes.
pub fn shipped() -> &'static [(&'static str, &'static str)] {
    SHIPPED
}

/// The scene of that name, or in the file of that path.
///
/// # Errors
/// Neither, or something wrong in it.
pub fn load(name: &str) -> Result<Scene, SceneError> {
    if let Some((_, text)) = SHIPPED.iter().find(|(known, _)| *known == name) {
        return scene_file::parse(text, name);
    }
    let text = read_text_at_most(Path::new(name), MOST_BYTES).map_err(|cause| SceneError::NotFound {
        name: name.into(),
        shipped: SHIPPED.iter().map(|s| s.0).collect::<Vec<_>>().join(", "),
        cause,
    })?;
    scene_file::parse(&text, name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_shipped_scene_is_sound_and_bears_its_name() {
        for (name, _) in SHIPPED {
            let scene = load(name).unwrap_or_else(|e| panic!("{e}"));
            assert_eq!(scene.name, *name);
            assert!(!scene.about.is_empty());
        }
    }

    #[test]
    fn an_unknown_scene_lists_the_known_ones() {
        let text = load("tapp").unwrap_err().to_string();
        assert!(text.contains("tapp") && text.contains("waterfall"), "{text}");
    }
}
