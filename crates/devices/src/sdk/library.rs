//! A maker's library.

use crate::DeviceError;
use libloading::Library;
use std::path::Path;

/// A library that stays loaded to the end: not all of them stand being unloaded.
pub struct MakersLibrary {
    library: &'static Library,
    device: &'static str,
    remedy: &'static str,
}

impl MakersLibrary {
    /// The first of these files that the system finds.
    pub fn load(
        device: &'static str,
        files: &[&Path],
        cause: &'static str,
        remedy: &'static str,
    ) -> Result<Self, DeviceError> {
        // SAFETY: a maker's library, which the user has installed or named, runs its own start when it is loaded.
        let found = files.iter().find_map(|file| unsafe { Library::new(*file) }.ok());
        let library = found.ok_or(DeviceError::Unavailable { device, cause, remedy })?;
        Ok(Self { library: Box::leak(Box::new(library)), device, remedy })
    }

    /// The function of that name.
    ///
    /// # Safety
    /// `F` must be the type of a pointer to that function.
    pub unsafe fn function<F: Copy>(&self, name: &'static str) -> Result<F, DeviceError> {
        let refused = |_| DeviceError::Refused {
            device: self.device,
            cause: format!("its library has no function {name}"),
            remedy: self.remedy,
        };
        // SAFETY: as the caller has it.
        unsafe { self.library.get::<F>(name.as_bytes()) }.map(|function| *function).map_err(refused)
    }
}
