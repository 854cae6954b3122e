//! What a run leaves in its folder: force.csv, force.png, summary.json and frame-*.png.

use crate::draw::chart::{self, Chart, Series};
use crate::draw::error::DrawError;
use crate::draw::scene::{Box3, Nozzle, Scene3d, Tool};
use crate::draw::{frame, image};
use crate::summary::{Summary, in_use};
use glam::DVec3;
use hapflow_engine::run::{Outcome, Picture};
use hapflow_engine::{Row, Scene, SceneError, settings};
use hapflow_fluid::ContainerForm;
use std::path::Path;

/// Size of a frame picture.
const FRAME: (u32, u32) = (1280, 720);
/// Size of the force chart.
const CHART: (u32, u32) = (1280, 900);

/// Something that could not be written.
#[derive(Debug, thiserror::Error)]
pub enum OutputError {
    /// The recording.
    #[error(transparent)]
    Recording(#[from] SceneError),
    /// A picture.
    #[error(transparent)]
    Picture(#[from] DrawError),
    /// The summary.
    #[error("{0}: {1}")]
    Summary(String, std::io::Error),
}

/// Writes everything into `folder`.
pub fn write(folder: &Path, scene: &Scene, outcome: &Outcome, summary: &Summary) -> Result<(), OutputError> {
    outcome.recording.write_csv(&folder.join("force.csv"))?;
    let text = format!("{:#}\n", summary.json());
    let path = folder.join("summary.json");
    std::fs::write(&path, text).map_err(|e| OutputError::Summary(path.display().to_string(), e))?;
    chart::save(&force_charts(scene, &outcome.recording.rows), &folder.join("force.png"), CHART.0, CHART.1)?;
    write_pictures(folder, scene, &outcome.pictures)
}

/// Each picture on a thread of its own: the run is over, and all cores are free.
fn write_pictures(folder: &Path, scene: &Scene, pictures: &[Picture]) -> Result<(), OutputError> {
    let write = |k: usize, picture: &Picture| {
        image::save_png(&draw(scene, picture), &folder.join(format!("frame-{}.png", k + 1)))
    };
    std::thread::scope(|scope| {
        let threads: Vec<_> =
            pictures.iter().enumerate().map(|(k, p)| scope.spawn(move || write(k, p))).collect();
        threads.into_iter().try_for_each(|thread| match thread.join() {
            Ok(written) => Ok(written?),
            Err(panic) => std::panic::resume_unwind(panic),
        })
    })
}

/// The scene with the changes that have been made until `time_s`.
fn scene_at(scene: &Scene, time_s: f64) -> Scene {
    let mut now = scene.clone();
    for change in scene.changes.iter().filter(|c| c.at_s <= time_s) {
        for (path, value) in &change.settings {
            // Each was checked when the scene was read.
            let _ = settings::set_live(&mut now, path, value);
        }
    }
    now
}

fn draw(scene: &Scene, picture: &Picture) -> image::Image {
    let scene = &scene_at(scene, picture.time_s);
    let view = &picture.particles;
    let speeds: Vec<f32> = view.velocities.iter().map(|v| glam::Vec3::from(*v).length()).collect();
    let containers: Vec<Box3> = scene
        .container
        .iter()
        // Round glass is not drawn; the water shows it.
        .filter(|_| scene.container_form == ContainerForm::Box)
        .map(|c| Box3 { min: c.min.as_vec3().to_array(), max: c.max.as_vec3().to_array() })
        .collect();
    let sources: Vec<Nozzle> = scene
        .sources
        .iter()
        .map(|s| Nozzle {
            position: s.position.as_vec3().to_array(),
            direction: s.direction.as_vec3().to_array(),
            diameter: s.diameter as f32,
        })
        .collect();
    // In the order of the reports; the first tool is where the servo has it.
    let forms = scene.more_tools.iter().map(|t| &t.form).chain(scene.obstacles.iter().map(|o| &o.form));
    let forms = forms.chain(scene.bodies.iter().map(|b| &b.form));
    let obstacles: Vec<Tool> = forms
        .zip(picture.bodies.iter().skip(1))
        .map(|(form, body)| Tool {
            shape: form.shape(),
            position: body.state.position.as_vec3().to_array(),
            orientation: body.state.orientation.as_quat().to_array(),
        })
        .collect();
    let caption =
        format!("{}   t = {:.2} s   {} particles", scene.name, picture.time_s, view.positions.len());
    let tool = &picture.servo.tool;
    frame::render(
        &Scene3d {
            particles: &view.positions,
            speeds: &speeds,
            spacing: scene.fluid.spacing as f32,
            tool: Tool {
                shape: scene.tool.form.shape(),
                position: tool.position.as_vec3().to_array(),
                orientation: tool.orientation.as_quat().to_array(),
            },
            obstacles: &obstacles,
            containers: &containers,
            ground_y: scene.ground.map(|y| y as f32),
            sources: &sources,
            force: Some(picture.servo.sent.force.as_vec3().to_array()),
            bounds: framed(scene),
            caption: &caption,
        },
        FRAME.0,
        FRAME.1,
    )
}

/// What the camera must show: container, tool, pools and taps, not all of the bounds.
fn framed(scene: &Scene) -> ([f32; 3], [f32; 3]) {
    let (r, at) = (DVec3::splat(scene.tool.form.shape().bounding_radius()), scene.tool.position);
    let (mut low, mut high) = (at - 2.0 * r, at + 2.0 * r);
    let mut include = |a: DVec3, b: DVec3| (low, high) = (low.min(a), high.max(b));
    if let Some(c) = scene.container {
        include(c.min, c.max);
    }
    let obstacles = scene.obstacles.iter().map(|o| (&o.form, o.position));
    for (form, position) in obstacles.chain(scene.bodies.iter().map(|b| (&b.form, b.position))) {
        let reach = DVec3::splat(form.shape().bounding_radius());
        include(position - reach, position + reach);
    }
    for pool in &scene.pools {
        include(pool.min, pool.max);
    }
    for s in &scene.sources {
        // The drawn tap stands two diameters above its mouth.
        let reach = DVec3::splat(0.6 * s.diameter);
        include(s.position - reach, s.position + reach - s.direction.normalize_or_zero() * 2.0 * s.diameter);
    }
    if let Some(y) = scene.ground {
        include(DVec3::new(at.x, y, at.z), at);
    }
    let (low, high) = (low.max(scene.bounds.min - r), high.min(scene.bounds.max + 4.0 * r));
    (low.as_vec3().to_array(), high.as_vec3().to_array())
}

fn force_charts(scene: &Scene, rows: &[Row]) -> Vec<Chart> {
    let series = |label: &str, value: &dyn Fn(&Row) -> f64| {
        Series::new(label, rows.iter().map(|r| [r.time_s, value(r)]).collect::<Vec<_>>())
    };
    let raw = series("raw |F|", &|r| r.raw.force.length()).coloured([120, 130, 140]).faint();
    let force = Chart {
        title: format!(
            "{}: force on the hand ({}, {})",
            scene.name,
            in_use(scene, "coupling"),
            scene.filter()
        ),
        y_label: "force (N)".into(),
        series: vec![
            raw,
            series("Fx sent", &|r| r.sent.force.x),
            series("Fy sent", &|r| r.sent.force.y),
            series("Fz sent", &|r| r.sent.force.z),
        ],
        ..Chart::default()
    };
    let place = Chart {
        title: "position of the tool".into(),
        x_label: "time (s)".into(),
        y_label: "position (mm)".into(),
        series: vec![
            series("x", &|r| 1e3 * r.tool.position.x),
            series("y", &|r| 1e3 * r.tool.position.y),
            series("z", &|r| 1e3 * r.tool.position.z),
        ],
        ..Chart::default()
    };
    vec![force, place]
}
