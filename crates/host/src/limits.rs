//! What a plugin may say: numbers, and no farther and faster than the header lets a tool be (`hapflow_tool_state`).

/// Farthest along an axis, m.
pub const FARTHEST: f64 = 1000.0;
/// Fastest along an axis, m/s.
pub const FASTEST: f64 = 1000.0;
/// Fastest turn about an axis, rad/s.
pub const FASTEST_TURN: f64 = 1e5;
/// Largest error of the length of a quaternion.
pub const UNIT: f64 = 1e-3;

/// Whether these are numbers up to `most` in size.
pub fn within(numbers: impl IntoIterator<Item = f64>, most: f64) -> bool {
    numbers.into_iter().all(|n| n.abs() <= most)
}
