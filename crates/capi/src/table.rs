//! Sessions by their handles, and what else lasts: a static. (Others are the devices, and what a thread has of its own:
//! its last error, and the logs that it is in.)

use crate::catalog::Catalog;
use crate::code::{Code, Failure};
use crate::fluid::FluidSide;
use crate::generated::{HAPFLOW_MAX_SESSIONS, HAPFLOW_MAX_TOOLS};
use crate::handle::{Handle, Id, next_generation};
use crate::obstacle::ObstacleSide;
use crate::scene_table::Scenes;
use crate::servo::ServoSide;
use crate::session::{AnySide, MainSide};
use hapflow_realtime::{Alone, Claimed, Lane, Refused, Sharing};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU32, Ordering};

/// Sessions at once: `HAPFLOW_MAX_SESSIONS`.
pub const MAX_SESSIONS: usize = HAPFLOW_MAX_SESSIONS as usize;

/// Tools of a session: `HAPFLOW_MAX_TOOLS`.
const MAX_TOOLS: usize = HAPFLOW_MAX_TOOLS as usize;

const _: () = assert!(MAX_TOOLS == hapflow_engine::MAX_TOOLS);

/// A session in its parts, one a thread class; of the servo, one a tool. Lanes of tools that there are not stay
/// vacant.
struct Slot {
    main: Lane<MainSide>,
    servos: [Lane<ServoSide>; MAX_TOOLS],
    fluid: Lane<FluidSide>,
    obstacle: Lane<ObstacleSide>,
    any: Lane<AnySide>,
}

/// What [`Library::place`] places and [`Library::remove`] gives back.
pub struct Parts {
    pub main: MainSide,
    pub servos: Vec<ServoSide>,
    pub fluid: FluidSide,
    pub obstacle: ObstacleSide,
    pub any: AnySide,
}

/// All that lasts: the version that was agreed on, the texts on what the build has, the scenes, and the sessions.
pub struct Library {
    version: AtomicU32,
    catalog: OnceLock<Catalog>,
    pub scenes: Scenes,
    slots: [Slot; MAX_SESSIONS],
}

pub static LIBRARY: Library = Library::new();

impl From<Refused> for Code {
    fn from(refused: Refused) -> Self {
        match refused {
            Refused::Stale => Self::ERROR_HANDLE,
            Refused::Busy => Self::ERROR_BUSY,
        }
    }
}

impl Library {
    const fn new() -> Self {
        let slots = [const { Slot::vacant() }; MAX_SESSIONS];
        Self { version: AtomicU32::new(0), catalog: OnceLock::new(), scenes: Scenes::new(), slots }
    }

    /// Notes the version that was agreed on.
    pub fn agree(&self, version: u32) {
        self.version.store(version, Ordering::Release);
    }

    /// Refuses while no version was agreed on.
    pub fn negotiated(&self) -> Result<(), Code> {
        if self.version.load(Ordering::Acquire) == 0 { Err(Code::ERROR_NOT_NEGOTIATED) } else { Ok(()) }
    }

    /// What the build has; made when it is first asked for.
    pub fn catalog(&self) -> &Catalog {
        self.catalog.get_or_init(Catalog::new)
    }

    /// Puts the session that `open` gives into a vacant slot, which is kept for it meanwhile.
    pub fn place(&self, open: impl FnOnce() -> Result<Parts, Failure>) -> Result<Handle, Failure> {
        let mut slots = self.slots.iter().enumerate();
        let vacant = slots.find_map(|(index, slot)| Some((index, slot.claim()?)));
        let (index, claimed) = vacant.ok_or(Code::ERROR_FULL)?;
        Ok(Handle { id: Id::new(index, claimed.open(open()?)) })
    }

    /// Takes a session out, once nobody is in it.
    pub fn remove(&self, handle: Handle) -> Result<Parts, Code> {
        let (slot, generation) = (self.slot(handle)?, handle.id.generation());
        // The one who closes main first is the one who closes all.
        let mut main = slot.main.close(generation)?;
        let mut servos: Vec<_> = slot.servos.iter().filter_map(|lane| lane.close(generation).ok()).collect();
        let mut fluid = slot.fluid.close(generation)?;
        let mut obstacle = slot.obstacle.close(generation)?;
        let mut any = slot.any.close(generation)?;
        let servos = servos.iter_mut().filter_map(Claimed::take).collect();
        match (main.take(), fluid.take(), obstacle.take(), any.take()) {
            (Some(main), Some(fluid), Some(obstacle), Some(any)) => {
                Ok(Parts { main, servos, fluid, obstacle, any })
            }
            _ => Err(Code::ERROR_HANDLE),
        }
    }

    pub fn main(&self, handle: Handle) -> Result<Alone<'_, MainSide>, Code> {
        Ok(self.slot(handle)?.main.enter(handle.id.generation())?)
    }

    pub fn servo(&self, handle: Handle, tool: u32) -> Result<Alone<'_, ServoSide>, Code> {
        let lane = self.slot(handle)?.servos.get(tool as usize);
        match lane.map_or(Err(Refused::Stale), |lane| lane.enter(handle.id.generation())) {
            // Another session, or another number of tools?
            Err(Refused::Stale) if tool >= self.any(handle)?.tools() => Err(Code::ERROR_INDEX),
            entered => Ok(entered?),
        }
    }

    pub fn fluid(&self, handle: Handle) -> Result<Alone<'_, FluidSide>, Code> {
        Ok(self.slot(handle)?.fluid.enter(handle.id.generation())?)
    }

    pub fn obstacles(&self, handle: Handle) -> Result<Alone<'_, ObstacleSide>, Code> {
        Ok(self.slot(handle)?.obstacle.enter(handle.id.generation())?)
    }

    pub fn any(&self, handle: Handle) -> Result<Sharing<'_, AnySide>, Code> {
        Ok(self.slot(handle)?.any.share(handle.id.generation())?)
    }

    fn slot(&self, handle: Handle) -> Result<&Slot, Code> {
        handle.id.of(&self.slots)
    }
}

impl Slot {
    const fn vacant() -> Self {
        let servos = [const { Lane::vacant() }; MAX_TOOLS];
        Self {
            main: Lane::vacant(),
            servos,
            fluid: Lane::vacant(),
            obstacle: Lane::vacant(),
            any: Lane::vacant(),
        }
    }

    /// Main first: it decides between two who want the slot.
    fn claim(&self) -> Option<ClaimedSlot<'_>> {
        let main = self.main.claim()?;
        Some(ClaimedSlot {
            servos: self.servos.iter().map(Lane::claim).collect::<Option<_>>()?,
            fluid: self.fluid.claim()?,
            obstacle: self.obstacle.claim()?,
            any: self.any.claim()?,
            main,
        })
    }
}

/// A slot that nobody can enter; dropped, it is vacant.
struct ClaimedSlot<'a> {
    servos: Vec<Claimed<'a, ServoSide>>,
    fluid: Claimed<'a, FluidSide>,
    obstacle: Claimed<'a, ObstacleSide>,
    any: Claimed<'a, AnySide>,
    /// Dropped last: who finds it vacant finds all of them so.
    main: Claimed<'a, MainSide>,
}

impl ClaimedSlot<'_> {
    /// Fills it, and says with which generation.
    fn open(self, parts: Parts) -> u32 {
        let generation = next_generation(self.main.generation());
        self.any.open(generation, parts.any);
        self.obstacle.open(generation, parts.obstacle);
        self.fluid.open(generation, parts.fluid);
        self.servos.into_iter().zip(parts.servos).for_each(|(lane, tool)| lane.open(generation, tool));
        self.main.open(generation, parts.main);
        generation
    }
}
