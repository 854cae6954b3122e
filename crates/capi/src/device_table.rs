//! Devices by their handles: a static.

use crate::code::{Code, Failure};
use crate::device::DeviceSide;
use crate::generated::HAPFLOW_MAX_DEVICES;
use crate::handle::{DeviceHandle, Id, next_generation};
use hapflow_realtime::{Alone, Claimed, Lane, SharedFlags, Sharing};

/// Devices at once: `HAPFLOW_MAX_DEVICES`.
const MAX_DEVICES: usize = HAPFLOW_MAX_DEVICES as usize;

/// A device in its parts: what its servo has, and what any thread may reach.
struct Slot {
    servo: Lane<DeviceSide>,
    /// Raised to clear its faults.
    clear: Lane<SharedFlags>,
}

/// The devices that are open, those of sessions apart.
pub struct Devices {
    slots: [Slot; MAX_DEVICES],
}

/// All devices of the process.
pub static DEVICES: Devices = Devices::new();

impl Devices {
    const fn new() -> Self {
        Self { slots: [const { Slot { servo: Lane::vacant(), clear: Lane::vacant() } }; MAX_DEVICES] }
    }

    /// Puts the device that `open` gives into a vacant slot, which is kept for it meanwhile.
    pub fn place(&self, open: impl FnOnce() -> Result<DeviceSide, Failure>) -> Result<DeviceHandle, Failure> {
        let mut slots = self.slots.iter().enumerate();
        let vacant = slots.find_map(|(index, slot)| Some((index, slot.claim()?)));
        let (index, claimed) = vacant.ok_or(Code::ERROR_FULL)?;
        Ok(DeviceHandle { id: Id::new(index, claimed.open(open()?)) })
    }

    /// Shuts a device, once nobody is in it.
    pub fn claim(&self, handle: DeviceHandle) -> Result<ClaimedDevice<'_>, Code> {
        let (slot, generation) = (handle.id.of(&self.slots)?, handle.id.generation());
        // The one who closes the servo's part first is the one who closes both.
        let servo = slot.servo.close(generation)?;
        Ok(ClaimedDevice { clear: slot.clear.close(generation)?, servo })
    }

    /// Takes all of these out, or none.
    pub fn take(&self, handles: &[DeviceHandle]) -> Result<Vec<DeviceSide>, Code> {
        let mut claimed = Vec::new();
        for handle in handles {
            match self.claim(*handle) {
                Ok(device) => claimed.push(device),
                Err(refused) => {
                    claimed.into_iter().for_each(ClaimedDevice::put_back);
                    return Err(refused);
                }
            }
        }
        claimed.into_iter().map(ClaimedDevice::take).collect()
    }

    pub fn enter(&self, handle: DeviceHandle) -> Result<Alone<'_, DeviceSide>, Code> {
        Ok(handle.id.of(&self.slots)?.servo.enter(handle.id.generation())?)
    }

    pub fn clear(&self, handle: DeviceHandle) -> Result<Sharing<'_, SharedFlags>, Code> {
        Ok(handle.id.of(&self.slots)?.clear.share(handle.id.generation())?)
    }
}

impl Slot {
    /// The servo's part first: it decides between two who want the slot.
    fn claim(&self) -> Option<ClaimedDevice<'_>> {
        let servo = self.servo.claim()?;
        Some(ClaimedDevice { clear: self.clear.claim()?, servo })
    }
}

/// A slot that nobody can enter; dropped, it is vacant.
pub struct ClaimedDevice<'a> {
    clear: Claimed<'a, SharedFlags>,
    /// Dropped last: who finds it vacant finds both so.
    servo: Claimed<'a, DeviceSide>,
}

impl ClaimedDevice<'_> {
    /// Fills it, and says with which generation.
    fn open(self, device: DeviceSide) -> u32 {
        let generation = next_generation(self.servo.generation());
        self.clear.open(generation, device.clear_flag());
        self.servo.open(generation, device);
        generation
    }

    /// Lets its handle in again.
    fn put_back(self) {
        self.clear.reopen();
        self.servo.reopen();
    }

    /// Empties it; it is vacant then.
    pub fn take(mut self) -> Result<DeviceSide, Code> {
        self.servo.take().ok_or(Code::ERROR_HANDLE)
    }
}
