//! A scene that is built by calls: every part is checked as it comes, by the same table as in a scene file.

use crate::scene::{Change, FreeBody, MAX_BODIES, MAX_OBSTACLES, MAX_TOOLS, Obstacle, Scene, ToolSettings};
use crate::settings::{self, Named};
use crate::{SceneError, Value};
use hapflow_fluid::{Aabb, Source};

/// Farthest that a corner or the ground may be from the origin, m.
pub(crate) const FARTHEST_M: f64 = 100.0;
/// Latest time of a change, s.
pub(crate) const LATEST_S: f64 = 3600.0;
/// Most boxes of a kind, sources and changes: more is a mistake.
const MOST_PARTS: usize = 1000;

/// Whatever is added or set here is refused, with field, value and range, if it cannot be by itself; the scene then
/// stays as it was. Whether all of it can be run together, [`Scene::check`] says.
impl Scene {
    /// Adds a source, and gives its number. One without a name is called by its number; likewise all that has a name.
    ///
    /// # Errors
    /// A value outside its range, a name that is there, or too many.
    pub fn add_source(&mut self, source: Source) -> Result<usize, SceneError> {
        add_named(&mut self.sources, source, 0, MOST_PARTS)
    }

    /// Adds an obstacle, and gives its number.
    ///
    /// # Errors
    /// As [`add_source`](Self::add_source).
    pub fn add_obstacle(&mut self, obstacle: Obstacle) -> Result<usize, SceneError> {
        add_named(&mut self.obstacles, obstacle, 0, MAX_OBSTACLES)
    }

    /// Adds a free body, and gives its number.
    ///
    /// # Errors
    /// As [`add_source`](Self::add_source).
    pub fn add_body(&mut self, body: FreeBody) -> Result<usize, SceneError> {
        add_named(&mut self.bodies, body, 0, MAX_BODIES)
    }

    /// Adds a tool to the first, which every scene has, and gives its number.
    ///
    /// # Errors
    /// As [`add_source`](Self::add_source).
    pub fn add_tool(&mut self, tool: ToolSettings) -> Result<usize, SceneError> {
        if tool.name == self.tool.name {
            return Err(taken::<ToolSettings>(&tool.name));
        }
        add_named(&mut self.more_tools, tool, 1, MAX_TOOLS)
    }

    /// Adds a box filled with fluid at the start, and gives its number.
    ///
    /// # Errors
    /// A corner that is too far away or not below the other, or too many.
    pub fn add_pool(&mut self, pool: Aabb) -> Result<usize, SceneError> {
        add_box(&mut self.pools, pool, "pool")
    }

    /// Adds a box in which particles vanish, and gives its number.
    ///
    /// # Errors
    /// As [`add_pool`](Self::add_pool).
    pub fn add_sink(&mut self, sink: Aabb) -> Result<usize, SceneError> {
        add_box(&mut self.sinks, sink, "sink")
    }

    /// Adds new values for settings at a time (s, 0 to 3600), after those of the same time.
    ///
    /// # Errors
    /// A time outside its range, or what [`settings::set_live`] refuses.
    pub fn add_change(&mut self, at_s: f64, settings: &[(String, Value)]) -> Result<(), SceneError> {
        check("change.at_s", at_s, 0.0, LATEST_S)?;
        room("change", self.changes.len(), MOST_PARTS)?;
        let mut after = self.clone();
        settings.iter().try_for_each(|(path, value)| settings::set_live(&mut after, path, value))?;
        self.changes.push(Change::new(at_s, settings.to_vec()));
        self.changes.sort_by(|a, b| a.at_s.total_cmp(&b.at_s));
        Ok(())
    }

    /// Sets the box outside of which particles vanish.
    ///
    /// # Errors
    /// As [`add_pool`](Self::add_pool).
    pub fn set_bounds(&mut self, bounds: Aabb) -> Result<(), SceneError> {
        self.bounds = checked_box("bounds", bounds)?;
        Ok(())
    }

    /// Sets the height of the ground (m, within 100), or takes it away.
    ///
    /// # Errors
    /// A height outside its range.
    pub fn set_ground(&mut self, height: Option<f64>) -> Result<(), SceneError> {
        height.map_or(Ok(()), |y| check("ground", y, -FARTHEST_M, FARTHEST_M))?;
        self.ground = height;
        Ok(())
    }

    /// Sets the inner corners of the container, or takes it away; its shape is the setting `container.shape`.
    ///
    /// # Errors
    /// As [`add_pool`](Self::add_pool).
    pub fn set_container(&mut self, inner: Option<Aabb>) -> Result<(), SceneError> {
        self.container = inner.map(|b| checked_box("container", b)).transpose()?;
        Ok(())
    }
}

/// Adds to `list`, whose first is number `first`.
fn add_named<T: Named>(
    list: &mut Vec<T>,
    mut thing: T,
    first: usize,
    most: usize,
) -> Result<usize, SceneError> {
    let number = first + list.len();
    room(T::KIND, number, most)?;
    if thing.name().is_empty() {
        thing.rename(number.to_string());
    }
    if list.iter().any(|known| known.name() == thing.name()) {
        return Err(taken::<T>(thing.name()));
    }
    for setting in T::TABLE {
        let (value, path) = (setting.get(&thing), format!("{}.{}.{}", T::KIND, thing.name(), setting.path));
        setting.put(&mut thing, &path, &value, false)?;
    }
    list.push(thing);
    Ok(number)
}

fn add_box(list: &mut Vec<Aabb>, b: Aabb, kind: &str) -> Result<usize, SceneError> {
    room(kind, list.len(), MOST_PARTS)?;
    list.push(checked_box(kind, b)?);
    Ok(list.len() - 1)
}

fn checked_box(kind: &str, b: Aabb) -> Result<Aabb, SceneError> {
    for (end, corner) in [("min", b.min), ("max", b.max)] {
        for coordinate in corner.to_array() {
            check(&format!("{kind}.{end}"), coordinate, -FARTHEST_M, FARTHEST_M)?;
        }
    }
    if b.is_valid() {
        return Ok(b);
    }
    let (path, value) = (format!("{kind}.min"), Value::Vector(b.min).to_string());
    Err(SceneError::BadValue { path, value, expected: format!("below max = {}", Value::Vector(b.max)) })
}

fn check(path: &str, value: f64, min: f64, max: f64) -> Result<(), SceneError> {
    if value >= min && value <= max {
        return Ok(());
    }
    let expected = format!("a number from {min} to {max}");
    Err(SceneError::BadValue { path: path.into(), value: value.to_string(), expected })
}

fn room(kind: &str, there: usize, most: usize) -> Result<(), SceneError> {
    if there < most {
        return Ok(());
    }
    let value = (there + 1).to_string();
    Err(SceneError::BadValue { path: format!("{kind}s"), value, expected: format!("at most {most}") })
}

fn taken<T: Named>(name: &str) -> SceneError {
    SceneError::BadValue {
        path: format!("{}.name", T::KIND),
        value: Value::Text(name.into()).to_string(),
        expected: "a name that no other has".into(),
    }
}
