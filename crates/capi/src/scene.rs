//! The functions of a scene that is built by calls.

use crate::body_config::BodyConfig;
use crate::caller::{Buffer, In, Out, Text};
use crate::code::{Code, Failure};
use crate::fence::fence_main;
use crate::generated as c;
use crate::handle::SceneHandle;
use crate::hooks;
use crate::obstacle_config::ObstacleConfig;
use crate::part::Part;
use crate::scene_source::assignments;
use crate::session::finite;
use crate::source_config::SourceConfig;
use crate::table::LIBRARY;
use crate::tool_config::ToolConfig;
use glam::DVec3;
use hapflow_engine::{Scene, SceneError, Value, load, parse, settings, write};
use hapflow_fluid::Aabb;
use std::ffi::c_char;

/// A corner of a box.
type Corner = In<[f64; 3]>;

fn make(scene: Out<SceneHandle>, read: impl FnOnce() -> Result<Scene, Failure>) -> Code {
    fence_main(|| {
        LIBRARY.negotiated()?;
        scene.check()?;
        hooks::panic_if_asked();
        scene.put(LIBRARY.scenes.place(read()?)?)?;
        Ok(Code::OK)
    })
}

fn with_scene(scene: SceneHandle, body: impl FnOnce(&mut Scene) -> Result<Code, Failure>) -> Code {
    fence_main(|| {
        let mut side = LIBRARY.scenes.enter(scene)?;
        hooks::panic_if_asked();
        body(side.scene()?)
    })
}

/// The same for what gives no remark.
fn change_scene(scene: SceneHandle, body: impl FnOnce(&mut Scene) -> Result<(), Failure>) -> Code {
    with_scene(scene, |scene| body(scene).map(|()| Code::OK))
}

/// Adds what `config` says by the engine's function for it.
fn add<P: Part>(
    scene: SceneHandle,
    config: In<P>,
    index: Out<u32>,
    add: impl FnOnce(&mut Scene, P::Thing) -> Result<usize, SceneError>,
) -> Code {
    change_scene(scene, |scene| {
        index.offer(add(scene, config.read(P::DEFAULT)?.thing()?)? as u32);
        Ok(())
    })
}

fn add_box(
    scene: SceneHandle,
    [min, max]: [Corner; 2],
    index: Out<u32>,
    add: impl FnOnce(&mut Scene, Aabb) -> Result<usize, SceneError>,
) -> Code {
    change_scene(scene, |scene| {
        index.offer(add(scene, corners(min.whole()?, max.whole()?)?)? as u32);
        Ok(())
    })
}

fn corners(min: [f64; 3], max: [f64; 3]) -> Result<Aabb, Failure> {
    finite("min", &min)?;
    finite("max", &max)?;
    Ok(Aabb { min: DVec3::from(min), max: DVec3::from(max) })
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_scene_create(scene: Out<SceneHandle>) -> Code {
    make(scene, || Ok(Scene::default()))
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_scene_load(name: Text, scene: Out<SceneHandle>) -> Code {
    make(scene, || Ok(load(name.read()?)?))
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_scene_parse(toml: Text, length: usize, scene: Out<SceneHandle>) -> Code {
    make(scene, || Ok(parse(toml.read_bytes(length)?, "toml")?))
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_scene_destroy(scene: SceneHandle) -> Code {
    fence_main(|| {
        LIBRARY.scenes.remove(scene)?;
        Ok(Code::OK)
    })
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_scene_set(scene: SceneHandle, path: Text, value: f64) -> Code {
    change_scene(scene, |scene| {
        let path = path.read()?;
        finite(path, &[value])?;
        Ok(settings::set(scene, path, &Value::Number(value))?)
    })
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_scene_set_vector(scene: SceneHandle, path: Text, value: In<[f64; 3]>) -> Code {
    change_scene(scene, |scene| {
        let (path, value) = (path.read()?, value.whole()?);
        finite(path, &value)?;
        Ok(settings::set(scene, path, &Value::Vector(DVec3::from(value)))?)
    })
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_scene_set_text(scene: SceneHandle, path: Text, value: Text) -> Code {
    change_scene(scene, |scene| Ok(settings::set(scene, path.read()?, &Value::parse(value.read()?))?))
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_scene_set_bounds(scene: SceneHandle, min: Corner, max: Corner) -> Code {
    change_scene(scene, |scene| Ok(scene.set_bounds(corners(min.whole()?, max.whole()?)?)?))
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_scene_set_periodic(scene: SceneHandle, axes: u32) -> Code {
    change_scene(scene, |scene| {
        let known = [c::HAPFLOW_AXIS_X, c::HAPFLOW_AXIS_Y, c::HAPFLOW_AXIS_Z];
        if axes & !known.iter().sum::<u32>() != 0 {
            let text = format!("axes = {axes}: must be a sum of HAPFLOW_AXIS_X, _Y and _Z, 0 to 7");
            return Err(Failure { code: Code::ERROR_UNSUPPORTED, text });
        }
        scene.periodic = known.map(|axis| axes & axis != 0);
        Ok(())
    })
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_scene_set_ground(scene: SceneHandle, height: In<f64>) -> Code {
    change_scene(scene, |scene| {
        let height = height.if_given();
        finite("height", height.as_slice())?;
        Ok(scene.set_ground(height)?)
    })
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_scene_set_container(scene: SceneHandle, min: Corner, max: Corner) -> Code {
    change_scene(scene, |scene| {
        let inner = match (min.if_given(), max.if_given()) {
            (None, None) => None,
            (Some(min), Some(max)) => Some(corners(min, max)?),
            _ => return Err(Code::ERROR_NULL.into()),
        };
        Ok(scene.set_container(inner)?)
    })
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_scene_add_source(
    scene: SceneHandle,
    config: In<SourceConfig>,
    index: Out<u32>,
) -> Code {
    add(scene, config, index, Scene::add_source)
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_scene_add_obstacle(
    scene: SceneHandle,
    config: In<ObstacleConfig>,
    index: Out<u32>,
) -> Code {
    add(scene, config, index, Scene::add_obstacle)
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_scene_add_tool(
    scene: SceneHandle,
    config: In<ToolConfig>,
    index: Out<u32>,
) -> Code {
    add(scene, config, index, Scene::add_tool)
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_scene_add_body(
    scene: SceneHandle,
    config: In<BodyConfig>,
    index: Out<u32>,
) -> Code {
    add(scene, config, index, Scene::add_body)
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_scene_add_pool(
    scene: SceneHandle,
    min: Corner,
    max: Corner,
    index: Out<u32>,
) -> Code {
    add_box(scene, [min, max], index, Scene::add_pool)
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_scene_add_sink(
    scene: SceneHandle,
    min: Corner,
    max: Corner,
    index: Out<u32>,
) -> Code {
    add_box(scene, [min, max], index, Scene::add_sink)
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_scene_add_change(scene: SceneHandle, at_s: f64, settings: Text) -> Code {
    change_scene(scene, |scene| {
        finite("at_s", &[at_s])?;
        Ok(scene.add_change(at_s, &assignments(settings.read()?)?)?)
    })
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_scene_check(scene: SceneHandle) -> Code {
    change_scene(scene, |scene| Ok(scene.check()?))
}

/// See the header.
#[unsafe(no_mangle)]
pub extern "C" fn hapflow_scene_write(
    scene: SceneHandle,
    text: Buffer<c_char>,
    capacity: usize,
    length: Out<usize>,
) -> Code {
    with_scene(scene, |scene| Ok(text.enumerate_text(capacity, length, &write(scene))?))
}
