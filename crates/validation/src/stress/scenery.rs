//! A random scene, small enough that a trial is cheap.

use super::dice::Dice;
use super::draw::{addresses, fitting};
use glam::DVec3;
use hapflow_engine::settings;
use hapflow_engine::{Form, FormKind, FreeBody, Obstacle, Scene, ToolSettings, Value};
use hapflow_fluid::{Aabb, ContainerForm, FluidConfig, Mesh, Shape, Source};
use std::sync::{Arc, LazyLock};

/// Most particles of a trial.
const MOST_PARTICLES: usize = 1500;
/// Widest outlet, in spacings: a layer of it is as many particles.
const WIDEST_OUTLET: f64 = 5.0;
/// Share of the settings that are drawn from their whole ranges, in a tame scene and in a wild one.
const DRAWN: [f64; 2] = [0.03, 0.4];

/// Share of the bodies that are meshes, whose tables cost more than all else.
const MESHES: f64 = 0.05;

/// A random scene. Meshes come from files there, and from here in a trial.
#[derive(Clone, Debug)]
pub(super) struct Scenery {
    pub scene: Scene,
    /// Bodies that are a mesh as large as their ball, in the order of the fluid's.
    meshes: Vec<bool>,
}

impl Scenery {
    /// Draws one. It may well be refused.
    pub fn draw(dice: &mut Dice) -> Self {
        let mut scene = Scene::default();
        scene.fluid.spacing = if dice.chance(0.5) { dice.scale(1e-4, 1.0) } else { dice.scale(2e-3, 2e-2) };
        furnish(&mut scene, dice);
        let share = dice.scale(DRAWN[0], DRAWN[1]);
        for address in addresses(&scene) {
            let dice = &mut dice.of(&address.path);
            let always = ["fluid.solver", "fluid.mode", "run.coupling"].contains(&address.path.as_str());
            if !placed(&address.path) && dice.chance(if always { 0.7 } else { share }) {
                change(&mut scene, &address.path, &address.kind, dice);
            }
        }
        let meshes = scene.fluid_config(1).world.bodies.iter().map(|_| dice.chance(MESHES)).collect();
        Self { scene: affordable(scene), meshes }
    }

    /// The fluid of it.
    pub fn config(&self) -> FluidConfig {
        let mut config = self.scene.fluid_config(1);
        for (body, _) in config.world.bodies.iter_mut().zip(&self.meshes).filter(|(_, mesh)| **mesh) {
            body.shape = octahedron(body.shape.bounding_radius());
        }
        config
    }

    /// The same with a live setting drawn anew; none where that is refused. Also which.
    pub fn changed(&self, dice: &mut Dice) -> Option<(Self, String)> {
        let live: Vec<_> = addresses(&self.scene).into_iter().filter(|a| a.live).collect();
        let address = dice.pick_named(&live, |a| &a.path)?;
        let mut scene = self.scene.clone();
        let value = fitting(&address.kind, dice)?;
        settings::set_live(&mut scene, &address.path, &value).ok()?;
        let scene = affordable(scene);
        let told = format!("{} = {value}", address.path);
        scene.check().ok().map(|()| (Self { scene, meshes: self.meshes.clone() }, told))
    }
}

/// Whether the furnishing says where it is.
fn placed(path: &str) -> bool {
    path.ends_with(".position") || path.ends_with(".file") || path == "fluid.spacing"
}

/// Draws a setting anew; what cannot be stays as it is.
fn change(scene: &mut Scene, path: &str, kind: &settings::Kind, dice: &mut Dice) {
    let value = fitting(kind, dice);
    let fits = value.filter(|v| *v != Value::Text("mesh".into()));
    let _ = fits.map(|v| settings::set(scene, path, &v));
}

/// What a trial can pay for: few particles, and sources that make few.
fn affordable(mut scene: Scene) -> Scene {
    let widest = WIDEST_OUTLET * scene.fluid.spacing;
    scene.fluid.max_particles = scene.fluid.max_particles.min(MOST_PARTICLES);
    scene.sources.iter_mut().for_each(|s| s.diameter = s.diameter.min(widest));
    scene
}

/// Container, pools, sources, tools and all else, in units of the spacing.
fn furnish(scene: &mut Scene, dice: &mut Dice) {
    let dx = scene.fluid.spacing;
    let inner = vessel(scene, dice, dx);
    scene.pools = (0..dice.whole(0, 2)).map(|_| pool(&inner, dice)).collect();
    if dice.chance(0.8) {
        let top = DVec3 { y: dice.within(0.3, 0.7) * (inner.max.y - inner.min.y) + inner.min.y, ..inner.max };
        scene.pools.insert(0, Aabb { min: inner.min, max: top });
        scene.pools.truncate(2);
    }
    scene.sources = (0..dice.whole(0, 2)).map(|k| source(k, &inner, dx, dice)).collect();
    if dice.chance(0.1) {
        scene.sinks.push(pool(&inner, dice));
    }
    let somewhere = |dice: &mut Dice| {
        let room = if dice.chance(0.2) { 4.0 * dx } else { 0.0 };
        dice.place(inner.min - room, inner.max + room).clamp(DVec3::splat(-10.0), DVec3::splat(10.0))
    };
    let name = |k: usize| format!("s{k}");
    scene.tool = ToolSettings { form: form(dx, dice), position: somewhere(dice), ..ToolSettings::default() };
    let tool = |k, dice: &mut Dice| ToolSettings {
        name: name(k),
        form: form(dx, dice),
        position: somewhere(dice),
        ..ToolSettings::default()
    };
    scene.more_tools = (0..dice.whole(0, 5) / 4).map(|k| tool(k, dice)).collect();
    scene.obstacles = (0..dice.whole(0, 4) / 3)
        .map(|k| Obstacle { name: name(k), form: form(dx, dice), position: somewhere(dice) })
        .collect();
    let body = |k, dice: &mut Dice| FreeBody {
        name: name(k),
        form: form(dx, dice),
        density: scene.fluid.rest_density * dice.scale(0.05, 20.0),
        position: somewhere(dice),
    };
    scene.bodies = (0..dice.whole(0, 5) / 3).map(|k| body(k, dice)).collect();
}

/// What holds the fluid: a container of any form, closed to the top of the world or not; a ground; or sides that repeat.
/// The room in it.
fn vessel(scene: &mut Scene, dice: &mut Dice, dx: f64) -> Aabb {
    let (cells, low) = (dice.within(4.0, 9.0), dice.whole(0, 1) as f64 * dx);
    let half = DVec3::new(0.5 * cells, 0.0, 0.5 * cells) * dx;
    let mut inner = Aabb { min: DVec3::Y * low - half, max: DVec3::Y * (low + 1.3 * cells * dx) + half };
    let room = DVec3::new(3.0, 2.0, 3.0) * dx;
    match dice.whole(0, 9) {
        0 => {
            // Three supports of four spacings, the longest.
            let wide = DVec3::new(6.1, 0.0, 6.1) * dx;
            scene.periodic = [true, false, dice.chance(0.5)];
            (inner.min, inner.max) = (DVec3::Y * low - wide, DVec3::Y * (low + 6.0 * dx) + wide);
            scene.bounds = inner;
        }
        1 => scene.bounds = Aabb { min: inner.min - room, max: inner.max + room },
        _ => {
            if dice.chance(0.4) {
                scene.container_form = ContainerForm::Cylinder;
            } else if dice.chance(0.4) {
                scene.container_form = ContainerForm::Bowl;
                inner.max.y = low + dice.within(0.3, 0.5) * cells * dx;
            }
            scene.container = Some(inner);
            scene.bounds = Aabb { min: inner.min - room, max: inner.max + room };
            if dice.chance(0.7) {
                scene.bounds.max.y = inner.max.y;
            }
        }
    }
    scene.ground = dice.chance(0.5).then_some(low - dice.within(0.0, 2.0) * dx);
    inner
}

/// A box of fluid somewhere within.
fn pool(inner: &Aabb, dice: &mut Dice) -> Aabb {
    let (a, b) = (dice.place(inner.min, inner.max), dice.place(inner.min, inner.max));
    // However thin, a box has a size.
    Aabb { min: a.min(b), max: a.max(b) + 1e-9 }
}

fn source(k: usize, inner: &Aabb, dx: f64, dice: &mut Dice) -> Source {
    Source {
        name: format!("s{k}"),
        position: dice.place(inner.min, inner.max),
        direction: dice.direction(),
        diameter: dx * dice.within(0.5, WIDEST_OUTLET),
        speed: dice.scale(0.01, 20.0),
        on: dice.chance(0.8),
        period: if dice.chance(0.3) { dice.scale(1e-3, 1.0) } else { 0.0 },
        duty: dice.unit(),
    }
}

/// A shape of some spacings, as far as it may be as small or as large.
fn form(dx: f64, dice: &mut Dice) -> Form {
    const KINDS: [FormKind; 5] =
        [FormKind::Sphere, FormKind::Disc, FormKind::Cylinder, FormKind::Capsule, FormKind::Box];
    let length = |dice: &mut Dice| (dx * dice.within(0.3, 3.0)).clamp(1e-3, 0.5);
    let mut form = Form::ball(length(dice));
    form.kind = dice.pick(&KINDS).copied().unwrap_or(FormKind::Sphere);
    form.thickness = length(dice);
    form.length = length(dice);
    form.size = DVec3::new(length(dice), length(dice), length(dice));
    form
}

/// A mesh within a ball of `radius` (m).
fn octahedron(radius: f64) -> Shape {
    static UNIT: LazyLock<Option<Mesh>> = LazyLock::new(|| {
        let axes = [DVec3::X, DVec3::Y, DVec3::Z];
        let corners: Vec<_> = axes.into_iter().chain(axes.map(|a| -a)).collect();
        let faces = [[0, 1, 2], [1, 3, 2], [3, 4, 2], [4, 0, 2], [1, 0, 5], [3, 1, 5], [4, 3, 5], [0, 4, 5]];
        Mesh::new(&corners, &faces).ok()
    });
    UNIT.as_ref().map_or(Shape::Sphere { radius }, |unit| Shape::Mesh(Arc::new(unit.scaled(radius))))
}
