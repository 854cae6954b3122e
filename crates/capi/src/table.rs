//! Handles, and the table of sessions behind them: the library's one static. (What else lasts is a thread's own
//! last error.)

use crate::catalog::Catalog;
use crate::code::Code;
use crate::contract::as_in_header;
use crate::fluid::FluidSide;
use crate::generated::{HAPFLOW_MAX_SESSIONS, HAPFLOW_MAX_TOOLS};
use crate::lane::{Alone, Claimed, Lane, Refused, Sharing};
use crate::obstacle::ObstacleSide;
use crate::servo::ServoSide;
use crate::session::{AnySide, MainSide};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU32, Ordering};

/// Sessions at once: `HAPFLOW_MAX_SESSIONS`.
pub const MAX_SESSIONS: usize = HAPFLOW_MAX_SESSIONS as usize;

/// Tools of a session: `HAPFLOW_MAX_TOOLS`.
const MAX_TOOLS: usize = HAPFLOW_MAX_TOOLS as usize;

const _: () = assert!(MAX_TOOLS == hapflow_engine::MAX_TOOLS);

/// `hapflow_session`: slot + 1 in the lower half, generation in the upper; 0 is null.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Handle {
    id: u64,
}

as_in_header!(Handle = hapflow_session { id });

impl Handle {
    fn new(slot: usize, generation: u32) -> Self {
        Self { id: u64::from(generation) << 32 | (slot as u64 + 1) }
    }

    fn generation(self) -> u32 {
        (self.id >> 32) as u32
    }
}

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

/// All that lasts: the version that was agreed on, the texts on what the build has, and the sessions.
pub struct Library {
    version: AtomicU32,
    catalog: OnceLock<Catalog>,
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
        Self { version: AtomicU32::new(0), catalog: OnceLock::new(), slots }
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

    /// Puts a session into the first vacant slot.
    pub fn place(&self, parts: Parts) -> Result<Handle, Code> {
        for (index, slot) in self.slots.iter().enumerate() {
            if let Some(claimed) = slot.claim() {
                return Ok(Handle::new(index, claimed.open(parts)));
            }
        }
        Err(Code::ERROR_FULL)
    }

    /// Takes a session out, once nobody is in it.
    pub fn remove(&self, handle: Handle) -> Result<Parts, Code> {
        let (slot, generation) = (self.slot(handle)?, handle.generation());
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
        Ok(self.slot(handle)?.main.enter(handle.generation())?)
    }

    pub fn servo(&self, handle: Handle, tool: u32) -> Result<Alone<'_, ServoSide>, Code> {
        let lane = self.slot(handle)?.servos.get(tool as usize);
        match lane.map_or(Err(Refused::Stale), |lane| lane.enter(handle.generation())) {
            // Another session, or another number of tools?
            Err(Refused::Stale) if tool >= self.any(handle)?.tools() => Err(Code::ERROR_INDEX),
            entered => Ok(entered?),
        }
    }

    pub fn fluid(&self, handle: Handle) -> Result<Alone<'_, FluidSide>, Code> {
        Ok(self.slot(handle)?.fluid.enter(handle.generation())?)
    }

    pub fn obstacles(&self, handle: Handle) -> Result<Alone<'_, ObstacleSide>, Code> {
        Ok(self.slot(handle)?.obstacle.enter(handle.generation())?)
    }

    pub fn any(&self, handle: Handle) -> Result<Sharing<'_, AnySide>, Code> {
        Ok(self.slot(handle)?.any.share(handle.generation())?)
    }

    fn slot(&self, handle: Handle) -> Result<&Slot, Code> {
        let index = (handle.id & u64::from(u32::MAX)).wrapping_sub(1);
        usize::try_from(index).ok().and_then(|i| self.slots.get(i)).ok_or(Code::ERROR_HANDLE)
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

struct ClaimedSlot<'a> {
    main: Claimed<'a, MainSide>,
    servos: Vec<Claimed<'a, ServoSide>>,
    fluid: Claimed<'a, FluidSide>,
    obstacle: Claimed<'a, ObstacleSide>,
    any: Claimed<'a, AnySide>,
}

impl ClaimedSlot<'_> {
    /// Fills it, and says with which generation; never 0, so that no handle is null.
    fn open(self, parts: Parts) -> u32 {
        let generation = self.main.generation().checked_add(1).unwrap_or(1);
        self.any.open(generation, parts.any);
        self.obstacle.open(generation, parts.obstacle);
        self.fluid.open(generation, parts.fluid);
        self.servos.into_iter().zip(parts.servos).for_each(|(lane, tool)| lane.open(generation, tool));
        self.main.open(generation, parts.main);
        generation
    }
}
