//! Scenes that are built by calls, by their handles.

use crate::code::Code;
use crate::generated::HAPFLOW_MAX_SCENES;
use crate::handle::{Id, SceneHandle, next_generation};
use hapflow_engine::Scene;
use hapflow_realtime::{Alone, Faultable, Lane};

/// Scenes at once: `HAPFLOW_MAX_SCENES`.
const MAX_SCENES: usize = HAPFLOW_MAX_SCENES as usize;

/// A scene while it is built; none once a call on it has panicked.
pub struct SceneSide(Option<Box<Scene>>);

impl Faultable for SceneSide {
    fn fault(&mut self) {
        self.0 = None;
    }
}

impl SceneSide {
    pub fn scene(&mut self) -> Result<&mut Scene, Code> {
        self.0.as_deref_mut().ok_or(Code::ERROR_FAULTED)
    }
}

/// The scenes that there are.
pub struct Scenes {
    slots: [Lane<SceneSide>; MAX_SCENES],
}

impl Scenes {
    pub const fn new() -> Self {
        Self { slots: [const { Lane::vacant() }; MAX_SCENES] }
    }

    /// Puts a scene into a vacant slot.
    pub fn place(&self, scene: Scene) -> Result<SceneHandle, Code> {
        let mut slots = self.slots.iter().enumerate();
        let vacant = slots.find_map(|(index, slot)| Some((index, slot.claim()?)));
        let (index, claimed) = vacant.ok_or(Code::ERROR_FULL)?;
        let generation = next_generation(claimed.generation());
        claimed.open(generation, SceneSide(Some(Box::new(scene))));
        Ok(SceneHandle { id: Id::new(index, generation) })
    }

    /// Takes a scene out, once nobody is in it.
    pub fn remove(&self, handle: SceneHandle) -> Result<(), Code> {
        let mut claimed = handle.id.of(&self.slots)?.close(handle.id.generation())?;
        drop(claimed.take());
        Ok(())
    }

    pub fn enter(&self, handle: SceneHandle) -> Result<Alone<'_, SceneSide>, Code> {
        Ok(handle.id.of(&self.slots)?.enter(handle.id.generation())?)
    }
}
