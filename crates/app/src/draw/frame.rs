//! Pictures of the fluid, the tool and the container.

use glam::Vec3;

use super::arrow::Arrow;
use super::camera::Camera;
use super::field::Field;
use super::floor::Floor;
use super::font::Pen;
use super::glass::Glass;
use super::image::Image;
use super::kernels::{REACH, kernels};
use super::material::{LACQUER, Material, STEEL};
use super::mirror::{Mote, add_images};
use super::photons::{LightMap, Shade};
use super::scene::{Box3, Nozzle, Scene3d, Tool};
use super::solid::{Form, Solid};
use super::tracer::Tracer;
use hapflow_fluid::Shape;

/// Light that water swallows along the diagonal of the picture: red, green, blue.
const MURK: Vec3 = Vec3::new(8.0, 1.8, 0.8);
/// How fast the water's own colour comes up along the diagonal.
const HAZE: f32 = 1.1;
/// Difference between neighbouring pixels that asks for more rays.
const ROUGH: f32 = 0.035;
/// Where the further rays of a rough pixel pass, from its middle.
const MORE: [(f32, f32); 4] = [(-0.375, -0.125), (0.125, -0.375), (0.375, 0.125), (-0.125, 0.375)];
/// Colour of lettering.
const INK: [u8; 3] = [28, 42, 54];

/// Draws `scene` as a picture of `width` by `height` pixels.
pub fn render(scene: &Scene3d, width: u32, height: u32) -> Image {
    let (width, height) = (width.clamp(1, 16_384), height.clamp(1, 16_384));
    let (low, high) = scene.framed();
    let size = (high - low).length();
    let camera = Camera::framing(low, high, width, height);
    let arrow = Arrow::new(scene, size);
    let tracer = tracer(scene, &camera, arrow.as_ref(), size);
    let light = trace(&tracer, &camera, width, height);
    let mut image = Image::filled(width, height, [0; 3]);
    for (pixel, light) in image.pixels.iter_mut().zip(light) {
        *pixel = (light * 255.0 + 0.5).as_u8vec3().to_array();
    }
    label(&mut image, scene, &camera, arrow.as_ref(), &tracer);
    image
}

/// Builds everything that sends light.
fn tracer(scene: &Scene3d, camera: &Camera, arrow: Option<&Arrow>, size: f32) -> Tracer {
    let (low, high) = scene.framed();
    let field = field(scene, low, high);
    let glass = Glass::new(scene.containers, size, camera.pixel_angle());
    let solids = solids(scene);
    let murk = MURK / size;
    let half = 0.5 * size;
    let ground = scene.ground_y.filter(|y| y.is_finite());
    let floor = ground.map(|y| {
        let centre = (0.5 * (low + high)).with_y(y);
        let shade = Shade { field: &field, solids: &solids, glass: &glass, murk };
        Floor::new(centre, half, LightMap::new(shade, centre, 1.8 * half), camera.pixel_angle())
    });
    let arrow = arrow.map_or(vec![], |arrow| arrow.solids.clone());
    Tracer { field, solids, arrow, glass, floor, murk, haze: HAZE / size }
}

/// The fluid, cut off well outside the picture.
fn field(scene: &Scene3d, low: Vec3, high: Vec3) -> Field {
    let spacing = scene.safe_spacing();
    let margin = Vec3::splat(0.3 * (high - low).length() + 4.0 * spacing);
    let (low, high) = (low - margin, high + margin);
    let mut motes = Vec::new();
    for (i, particle) in scene.particles.iter().enumerate() {
        let place = Vec3::from(*particle);
        if place.cmpge(low).all() && place.cmple(high).all() {
            let speed = scene.speeds.get(i).copied().unwrap_or(0.0).abs();
            motes.push(Mote { place, speed: if speed.is_finite() { speed } else { 0.0 }, behind: None });
        }
    }
    let walls = walls(scene);
    add_images(&mut motes, &walls, REACH * spacing);
    let least = motes.iter().map(|mote| mote.place).reduce(Vec3::min).unwrap_or(low);
    let most = motes.iter().map(|mote| mote.place).reduce(Vec3::max).unwrap_or(low);
    let rim = Vec3::splat(4.0 * spacing);
    let tool: Vec<Solid> = solid(&scene.tool, LACQUER).into_iter().collect();
    Field::new(&kernels(&motes, spacing), spacing, (least - rim, most + rim), &walls, &tool)
}

/// The boxes that hold the fluid, and the ground as one without sides.
fn walls(scene: &Scene3d) -> Vec<Box3> {
    let sane = |b: &&Box3| Vec3::from(b.min).cmplt(Vec3::from(b.max)).all();
    let mut walls: Vec<Box3> = scene.containers.iter().filter(sane).copied().collect();
    if let Some(y) = scene.ground_y.filter(|y| y.is_finite()) {
        walls.push(Box3 { min: [-1e9, y, -1e9], max: [1e9, 1e9, 1e9] });
    }
    walls
}

/// The tool, the obstacles and the taps.
fn solids(scene: &Scene3d) -> Vec<Solid> {
    let mut solids: Vec<Solid> = scene.sources.iter().flat_map(Nozzle::solids).collect();
    solids.extend(solid(&scene.tool, LACQUER));
    solids.extend(scene.obstacles.iter().filter_map(|o| solid(o, STEEL)));
    solids
}

fn solid(tool: &Tool, material: Material) -> Option<Solid> {
    let centre = Vec3::from(tool.position);
    let reach = tool.shape.bounding_radius();
    let form = match tool.shape {
        Shape::Sphere { radius } => Form::Ball { centre, radius: radius as f32 },
        Shape::Disc { radius, thickness } => {
            let axis = (tool.turn() * Vec3::Y).normalize_or(Vec3::Y);
            Form::Cone {
                base: centre - axis * (0.5 * thickness as f32),
                axis,
                length: thickness as f32,
                radii: [radius as f32; 2],
            }
        }
        ref shape => Form::Shaped { shape: shape.clone(), centre, turn: tool.turn() },
    };
    (centre.is_finite() && reach.is_finite() && reach > 0.0).then_some(Solid { form, material })
}

/// Traces every pixel, and those at edges several times; the result is ready for the screen, 0 to 1.
fn trace(tracer: &Tracer, camera: &Camera, width: u32, height: u32) -> Vec<Vec3> {
    let (w, h) = (width as usize, height as usize);
    let place = |i: usize| ((i % w) as f32 + 0.5, (i / w) as f32 + 0.5);
    let first: Vec<Vec3> = (0..w * h)
        .map(|i| {
            let (x, y) = place(i);
            screen(tracer.look(camera.ray(x, y)))
        })
        .collect();
    let mut result = first.clone();
    for (i, pixel) in result.iter_mut().enumerate() {
        if !rough(&first, w, h, i) {
            continue;
        }
        let (x, y) = place(i);
        let more = MORE.iter().map(|(dx, dy)| screen(tracer.look(camera.ray(x + dx, y + dy)))).sum::<Vec3>();
        *pixel = (more + 0.5 * *pixel) / (MORE.len() as f32 + 0.5);
    }
    result
}

/// Whether a pixel differs much from one beside it.
fn rough(light: &[Vec3], w: usize, h: usize, i: usize) -> bool {
    let (x, y) = (i % w, i / w);
    let differs = |j: usize| (light[j] - light[i]).abs().max_element() > ROUGH;
    (x > 0 && differs(i - 1))
        || (x + 1 < w && differs(i + 1))
        || (y > 0 && differs(i - w))
        || (y + 1 < h && differs(i + w))
}

/// Takes linear light to the screen's scale: bright light rolls off, then the sRGB curve.
fn screen(light: Vec3) -> Vec3 {
    let light = if light.is_finite() { light.max(Vec3::ZERO) } else { Vec3::ZERO };
    let knee = 0.75;
    let rolled = light
        .map(|x| if x > knee { knee + (1.0 - knee) * (1.0 - (-(x - knee) / (1.0 - knee)).exp()) } else { x });
    rolled.map(|x| if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 })
}

/// Writes the caption, the scale of the grid and the size of the force.
fn label(image: &mut Image, scene: &Scene3d, camera: &Camera, arrow: Option<&Arrow>, tracer: &Tracer) {
    let size = (image.height as f32 / 36.0).max(9.0);
    let Some(pen) = Pen::new(size) else { return };
    let (margin, base) = (1.2 * size, image.height as f32 - 1.3 * size);
    if !scene.caption.is_empty() {
        note(image, &pen, size, margin, base, scene.caption);
    }
    if let Some(floor) = &tracer.floor {
        let text = format!("grid {} mm", (floor.step * 1e4).round() / 10.0);
        let x = image.width as f32 - margin - pen.width(&text);
        note(image, &pen, size, x, base, &text);
    }
    if let Some((arrow, at)) = arrow.and_then(|a| camera.project(a.tip).map(|at| (a, at))) {
        note(image, &pen, size, at.x + 0.9 * size, at.y + 0.3 * size, &format!("{:.2} N", arrow.force));
    }
}

/// Writes a line on a pale ground.
fn note(image: &mut Image, pen: &Pen, size: f32, x: f32, y: f32, text: &str) {
    let (left, right) = (x - 0.5 * size, x + pen.width(text) + 0.5 * size);
    let (top, bottom) = (y - 0.98 * size, y + 0.42 * size);
    let round = 0.35 * size;
    for py in top as i64 - 1..=bottom as i64 + 1 {
        for px in left as i64 - 1..=right as i64 + 1 {
            let (cx, cy) = (px as f32 + 0.5, py as f32 + 0.5);
            let (dx, dy) = (
                (left + round - cx).max(cx - right + round).max(0.0),
                (top + round - cy).max(cy - bottom + round).max(0.0),
            );
            let cover = (round + 0.5 - dx.hypot(dy)).clamp(0.0, 1.0);
            image.blend(px, py, [250, 252, 253], 0.62 * cover);
        }
    }
    pen.write(image, x, y, text, INK);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scene<'a>(particles: &'a [[f32; 3]], containers: &'a [Box3], sources: &'a [Nozzle]) -> Scene3d<'a> {
        Scene3d {
            particles,
            speeds: &[],
            spacing: 0.01,
            tool: Tool {
                shape: Shape::Sphere { radius: 0.02 },
                position: [0.0; 3],
                orientation: [0.0, 0.0, 0.0, 1.0],
            },
            containers,
            ground_y: Some(-0.1),
            sources,
            obstacles: &[],
            force: Some([0.0, 1.0, 0.0]),
            bounds: ([-0.1; 3], [0.1; 3]),
            caption: "a caption",
        }
    }

    fn cube(half: f32, spacing: f32) -> Vec<[f32; 3]> {
        let n = (2.0 * half / spacing) as i32;
        let at = |i: i32| -half + (i as f32 + 0.5) * spacing;
        (0..n * n * n).map(|i| [at(i % n), at(i / n % n), at(i / n / n)]).collect()
    }

    #[test]
    fn an_empty_scene_shows_the_red_tool() {
        let image = render(&scene(&[], &[], &[]), 160, 90);
        let red = image.pixels.iter().filter(|[r, g, b]| *r > 120 && *g < 70 && *b < 70).count();
        assert!(red > 40, "{red}");
    }

    #[test]
    fn fluid_colours_the_picture() {
        let mut only_fluid = scene(&[], &[], &[]);
        let particles = cube(0.06, 0.01);
        only_fluid.particles = &particles;
        only_fluid.tool.position = [9.0; 3];
        let image = render(&only_fluid, 160, 90);
        let blue =
            image.pixels.iter().filter(|[r, _, b]| *b > 60 && i32::from(*b) > i32::from(*r) + 50).count();
        assert!(blue > 500, "{blue}");
    }

    #[test]
    fn senseless_input_is_drawn() {
        let nan = f32::NAN;
        let particles = [[nan; 3], [f32::INFINITY; 3], [0.0; 3], [0.0; 3], [1e30; 3], [0.0, nan, 0.0]];
        let boxes = [Box3 { min: [nan; 3], max: [1.0; 3] }, Box3 { min: [0.1; 3], max: [-0.1; 3] }];
        let taps = [Nozzle { position: [nan; 3], direction: [0.0; 3], diameter: -1.0 }];
        let mut odd = scene(&particles, &boxes, &taps);
        for (spacing, bound, ground) in [(0.0, nan, Some(nan)), (nan, 0.0, None), (1e-9, 1e20, Some(1e9))] {
            (odd.spacing, odd.ground_y) = (spacing, ground);
            odd.bounds = ([-bound; 3], [bound; 3]);
            odd.force = Some([bound; 3]);
            odd.tool.position = [bound; 3];
            odd.tool.orientation = [0.0; 4];
            odd.tool.shape = Shape::Disc { radius: f64::from(bound), thickness: 0.0 };
            assert_eq!(render(&odd, 32, 18).pixels.len(), 32 * 18);
        }
        assert_eq!(render(&odd, 0, 0).pixels.len(), 1);
    }

    #[test]
    fn a_camera_in_the_fluid_sees_something() {
        let particles = cube(0.5, 0.05);
        let mut inside = scene(&particles, &[], &[]);
        (inside.spacing, inside.bounds) = (0.05, ([-0.01; 3], [0.01; 3]));
        let image = render(&inside, 64, 36);
        assert!(image.pixels.iter().any(|pixel| pixel.iter().any(|c| *c > 20)));
    }
}
