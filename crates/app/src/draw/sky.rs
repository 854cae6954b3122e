//! The light round the scene.

use glam::Vec3;

/// Light of the low sky, linear.
const HORIZON: Vec3 = Vec3::new(0.80, 0.86, 0.90);
/// Light of the high sky.
const ZENITH: Vec3 = Vec3::new(0.22, 0.42, 0.66);
/// Light from below where there is no ground.
const BELOW: Vec3 = Vec3::new(0.62, 0.66, 0.70);
/// Light of the sun on a surface that faces it.
pub(crate) const SUN: Vec3 = Vec3::new(0.80, 0.76, 0.70);

/// The direction towards the sun.
pub(crate) fn sun_direction() -> Vec3 {
    Vec3::new(-0.42, 0.85, 0.32).normalize()
}

/// The plain sky in a direction.
pub(crate) fn sky(direction: Vec3) -> Vec3 {
    if direction.y >= 0.0 {
        HORIZON.lerp(ZENITH, smooth(0.0, 0.9, direction.y))
    } else {
        HORIZON.lerp(BELOW, smooth(0.0, 0.6, -direction.y))
    }
}

/// The sky with the lamps that glossy things mirror.
pub(crate) fn mirrored(direction: Vec3) -> Vec3 {
    let towards = direction.dot(sun_direction());
    let lamp = 14.0 * smooth(0.968, 0.985, towards) + 0.8 * smooth(0.75, 1.0, towards);
    let side = Vec3::new(0.92, 0.30, 0.25).normalize().dot(direction);
    let strip = 1.6 * smooth(0.90, 0.97, side);
    sky(direction) * card(direction) + Vec3::splat(lamp) + Vec3::new(0.9, 0.95, 1.0) * strip
}

/// Dark cards round the studio, which give metal and water their contrast.
fn card(direction: Vec3) -> f32 {
    let round = direction.x.atan2(direction.z);
    1.0 - 0.62 * smooth(0.1, 0.9, (2.0 * round + 0.3).sin()) * (1.0 - smooth(0.15, 0.8, direction.y.abs()))
}

/// What glossy things mirror of a ground whose light is `glow`.
pub(crate) fn mirrored_ground(direction: Vec3, glow: Vec3) -> Vec3 {
    sky(direction).lerp(glow, smooth(0.0, 0.35, -direction.y)) * card(direction)
}

/// Light that the sky sheds on a surface with this normal.
pub(crate) fn ambient(normal: Vec3) -> Vec3 {
    Vec3::splat(0.30).lerp(Vec3::new(0.50, 0.56, 0.62), 0.5 + 0.5 * normal.y)
}

/// 0 below `from`, 1 above `to`, smooth between.
pub(crate) fn smooth(from: f32, to: f32, x: f32) -> f32 {
    let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// Share of light that a surface mirrors when looked at under `cosine`, from `facing` when looked at head on.
pub(crate) fn fresnel(facing: f32, cosine: f32) -> f32 {
    facing + (1.0 - facing) * (1.0 - cosine.clamp(0.0, 1.0)).powi(5)
}

/// What the eye sees far behind the scene.
pub(crate) fn backdrop(direction: Vec3) -> Vec3 {
    Vec3::new(0.79, 0.83, 0.86).lerp(Vec3::new(0.36, 0.50, 0.62), smooth(-0.75, 0.12, direction.y))
}
