//! Worlds that several cases stand in.

use glam::DVec3;
use hapflow_fluid::{Aabb, BodyConfig, Container, Shape, Source, World};

/// Nothing, within `bounds`.
pub(crate) fn empty(bounds: Aabb) -> World {
    World { bounds, ..World::default() }
}

/// The box of `size` (m) round the y axis, its floor at y = 0.
pub(crate) fn upright(size: DVec3) -> Aabb {
    let half = DVec3::new(0.5 * size.x, 0.0, 0.5 * size.z);
    Aabb { min: -half, max: half + DVec3::Y * size.y }
}

/// A container of `size` (m), open above, its floor at y = 0; nothing in it.
pub(crate) fn container(size: DVec3) -> World {
    let inner = upright(size);
    let room = DVec3::splat(0.1 * size.max_element());
    let bounds = Aabb { min: inner.min - room, max: inner.max + room + DVec3::Y * size.y };
    World { container: Some(Container::open_box(inner)), ..empty(bounds) }
}

/// A container filled to `water` (m), its walls twice as high.
pub(crate) fn tank(water: DVec3) -> World {
    World { pools: vec![upright(water)], ..container(water * DVec3::new(1.0, 2.0, 1.0)) }
}

/// Least period of a world that repeats, in spacings: three supports of 2.7, and a little.
const PERIOD: f64 = 9.0;

/// A layer of fluid between the planes y = 0 and y = `gap` (m), without end in x and z: its first body is the wall
/// below, the second the wall above.
pub(crate) fn layer(gap: f64, dx: f64) -> World {
    let half = 0.5 * PERIOD * dx;
    let span =
        |low: f64, high: f64| Aabb { min: DVec3::new(-half, low, -half), max: DVec3::new(half, high, half) };
    let thickness = gap;
    let slab = |y: f64| body(Shape::Slab { thickness }, DVec3::Y * y);
    World {
        periodic: [true, false, true],
        pools: vec![span(0.0, gap)],
        bodies: vec![slab(-0.5 * thickness), slab(gap + 0.5 * thickness)],
        ..empty(span(-thickness, gap + thickness))
    }
}

/// The fluid in a drum of `radius` (m) round the y axis, without end in y; the drum is the first body. Also the
/// length of its period, m.
pub(crate) fn drum(radius: f64, dx: f64) -> (World, f64) {
    let length = PERIOD * dx;
    let inside = upright(DVec3::new(2.0 * radius, length, 2.0 * radius));
    let room = DVec3::new(radius, 0.0, radius);
    let world = World {
        periodic: [false, true, false],
        pools: vec![inside],
        bodies: vec![body(Shape::Drum { radius }, DVec3::ZERO)],
        ..empty(Aabb { min: inside.min - room, max: inside.max + room })
    };
    (world, length)
}

/// A body that the case moves, or leaves where it is.
pub(crate) fn body(shape: Shape, position: DVec3) -> BodyConfig {
    BodyConfig { shape, position, ..BodyConfig::default() }
}

/// A steady round jet straight down from `height` (m).
pub(crate) fn jet(height: f64, diameter: f64, speed: f64) -> Source {
    Source { position: DVec3::Y * height, diameter, speed, ..Source::default() }
}
