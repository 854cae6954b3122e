//! What main and fluid have in common: the scene as it stands, and the particles that main has asked for.

use crate::force_limit::ForceLimit;
use crate::scene::{Scene, ToolSettings};
use crate::servo::ServoSettings;
use crate::{SceneError, Value, settings};
use hapflow_fluid::{FluidBackend, FluidConfig, ParticleView};
use hapflow_realtime::LatestWriter;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// The scene as it stands, shared by main and fluid; the servo gets its part wait-free and never waits for this
/// lock.
pub(crate) struct Shared {
    state: Mutex<State>,
    limit: ForceLimit,
    version: AtomicU64,
    threads: usize,
    wanted: AtomicBool,
    view: Mutex<ParticleView>,
    answered: AtomicU64,
}

struct State {
    scene: Scene,
    /// Changes of the scene that are done.
    changed: usize,
    /// One for each tool.
    servo: Vec<LatestWriter<ServoSettings>>,
}

impl Shared {
    /// `servo` are the ways to the tools' servos, in their order.
    pub fn new(
        scene: &Scene,
        limit: ForceLimit,
        threads: usize,
        servo: Vec<LatestWriter<ServoSettings>>,
    ) -> Self {
        Self {
            state: Mutex::new(State { scene: scene.clone(), changed: 0, servo }),
            limit,
            version: AtomicU64::new(0),
            threads,
            wanted: AtomicBool::new(false),
            view: Mutex::new(ParticleView::default()),
            answered: AtomicU64::new(0),
        }
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Sets a live setting, if it and all others are then in their ranges.
    pub fn set(&self, path: &str, value: &Value) -> Result<(), SceneError> {
        let mut state = self.state();
        let mut scene = self.as_it_stands(&state);
        settings::set_live(&mut scene, path, value)?;
        self.limit.check(&scene.gate)?;
        scene.check()?;
        self.install(&mut state, scene);
        Ok(())
    }

    /// A setting as it stands.
    pub fn get(&self, path: &str) -> Result<Value, SceneError> {
        settings::get(&self.as_it_stands(&self.state()), path)
    }

    /// The scene, with a force limit that was lowered since in place of its own.
    fn as_it_stands(&self, state: &State) -> Scene {
        Scene { gate: self.limit.applied(state.scene.gate), ..state.scene.clone() }
    }

    fn install(&self, state: &mut State, scene: Scene) {
        state.scene = scene;
        let State { scene, servo, .. } = state;
        for (writer, tool) in servo.iter_mut().zip(scene.tools()) {
            writer.write(servo_settings(scene, tool));
        }
        self.version.fetch_add(1, Ordering::Release);
    }

    /// Applies the scene's own changes that are due. They were checked when the scene was read; one that a
    /// later `set` has made impossible is passed over.
    pub fn apply_changes_until(&self, now_s: f64) {
        let mut state = self.state();
        while let Some(change) = state.scene.changes.get(state.changed).filter(|c| c.at_s <= now_s).cloned() {
            state.changed += 1;
            let mut scene = state.scene.clone();
            let done = change.settings.iter().try_for_each(|(p, v)| settings::set_live(&mut scene, p, v));
            if done.is_ok() && scene.fluid_config(1).check().is_ok() {
                self.install(&mut state, scene);
            }
        }
    }

    /// The fluid's settings, and each tool's factor on the lift, if there are newer ones than `seen`.
    pub fn newer_than(&self, seen: &mut u64) -> Option<(FluidConfig, Vec<f64>)> {
        let version = self.version.load(Ordering::Acquire);
        if version == *seen {
            return None;
        }
        *seen = version;
        let state = self.state();
        let buoyancy = state.scene.tools().map(|tool| tool.buoyancy_scale).collect();
        Some((state.scene.fluid_config(self.threads), buoyancy))
    }

    /// Asks for the particles.
    pub fn want_snapshot(&self) {
        self.wanted.store(true, Ordering::Release);
    }

    /// How often that was answered.
    pub fn answered(&self) -> u64 {
        self.answered.load(Ordering::Acquire)
    }

    /// Copies the last answer.
    pub fn snapshot(&self, view: &mut ParticleView) {
        view.clone_from(&self.view.lock().unwrap_or_else(PoisonError::into_inner));
    }

    /// Fills the view if main has asked for one.
    pub fn answer_snapshot(&self, backend: &mut dyn FluidBackend) {
        if self.wanted.swap(false, Ordering::AcqRel) {
            backend.snapshot(&mut self.view.lock().unwrap_or_else(PoisonError::into_inner));
            self.answered.fetch_add(1, Ordering::Release);
        }
    }
}

/// What the servo of `tool` has of the scene's settings.
pub(crate) fn servo_settings(scene: &Scene, tool: &ToolSettings) -> ServoSettings {
    ServoSettings {
        gate: scene.gate,
        force_scale: tool.force_scale,
        reach: tool.form.shape().bounding_radius(),
    }
}
