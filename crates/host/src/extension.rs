//! A plugin, and the tables of functions that it brings.

use crate::generated::{
    hapflow_coupling_extension, hapflow_device_extension, hapflow_fluid_backend_extension,
};
use crate::{PluginCoupling, PluginDevice, PluginError, PluginFluid};
use std::ffi::{CStr, OsStr, c_char, c_void};
use std::path::{Path, PathBuf};

/// What a plugin brings: a library with a `hapflow_extension` of its own.
#[derive(Clone)]
pub struct Extensions {
    /// A fluid.
    pub fluid: Option<PluginFluid>,
    /// A device.
    pub device: Option<PluginDevice>,
    /// A coupling.
    pub coupling: Option<PluginCoupling>,
}

impl Extensions {
    /// Loads a plugin, for as long as the process lasts.
    ///
    /// # Errors
    /// [`PluginError`] with the file, and what is wrong or missing. What a library does while it is loaded nobody can check.
    pub fn load(file: &Path) -> Result<Self, PluginError> {
        let library = Library::load(file)?;
        let brought = Self {
            fluid: PluginFluid::of(&library)?,
            device: PluginDevice::of(&library)?,
            coupling: PluginCoupling::of(&library)?,
        };
        if brought.fluid.is_none() && brought.device.is_none() && brought.coupling.is_none() {
            let known = [
                hapflow_fluid_backend_extension::name(),
                hapflow_device_extension::name(),
                hapflow_coupling_extension::name(),
            ];
            return Err(library.refused(format!("it brings none of {}", known.join(", "))));
        }
        Ok(brought)
    }
}

type GetExtension = unsafe extern "C" fn(*const c_char) -> *const c_void;

/// The library of a plugin. It stays loaded as long as the process.
pub(crate) struct Library {
    file: PathBuf,
    get: GetExtension,
}

/// The struct of a table, which begins with its size.
///
/// # Safety
/// It is one of `include/hapflow/`, of nothing but numbers and pointers that may be null.
pub(crate) unsafe trait Table: Copy {
    /// Its name and revision.
    const NAME: &'static [u8];

    /// The same as a text.
    fn name() -> String {
        String::from_utf8_lossy(Self::NAME.strip_suffix(b"\0").unwrap_or(Self::NAME)).into_owned()
    }
}

impl Library {
    fn load(file: &Path) -> Result<Self, PluginError> {
        let failed = |e| PluginError::Load(file.display().to_string(), e);
        // SAFETY: the caller names a library that is to run in this process; it is never unloaded.
        let library = unsafe { libloading::Library::new(file) }.map_err(failed)?;
        // SAFETY: the one function of a plugin, as extension.h declares it.
        let get = *unsafe { library.get::<GetExtension>(b"hapflow_extension\0") }.map_err(failed)?;
        std::mem::forget(library);
        Ok(Self { file: file.into(), get })
    }

    /// The table of that kind, if the plugin has it.
    pub fn table<T: Table>(&self) -> Result<Option<T>, PluginError> {
        // SAFETY: the name ends with a NUL, and what comes back is null or a table that lasts as long as the library.
        let table = unsafe { (self.get)(T::NAME.as_ptr().cast()) };
        if table.is_null() {
            return Ok(None);
        }
        // SAFETY: every table begins with its size.
        let size = unsafe { table.cast::<u32>().read_unaligned() };
        if (size as usize) < size_of::<T>() {
            let (name, least) = (T::name(), size_of::<T>());
            return Err(self.refused(format!("its table {name} has {size} bytes and must have {least}")));
        }
        // SAFETY: it is as long as its size says, and any bytes are a value of it.
        Ok(Some(unsafe { table.cast::<T>().read_unaligned() }))
    }

    /// A function that must be there.
    pub fn required<F>(&self, function: Option<F>, name: &str) -> Result<F, PluginError> {
        function.ok_or_else(|| self.refused(format!("its function {name} is null")))
    }

    /// The name that a table gives itself: kept for the process, as the library is.
    pub fn name(&self, name: *const c_char) -> Result<&'static str, PluginError> {
        if name.is_null() {
            return Err(self.refused("its name is null".into()));
        }
        // SAFETY: a text that lasts as long as the process.
        let name: &'static CStr = unsafe { CStr::from_ptr(name) };
        match name.to_str() {
            Ok("") => Err(self.refused("its name is empty".into())),
            Ok(name) => Ok(name),
            Err(_) => Err(self.refused("its name is not UTF-8".into())),
        }
    }

    /// The name of its file, without what all libraries have.
    pub fn word(&self) -> String {
        let stem = self.file.file_stem().unwrap_or_default().to_string_lossy();
        stem.strip_prefix(std::env::consts::DLL_PREFIX).unwrap_or(&stem).into()
    }

    fn refused(&self, what: String) -> PluginError {
        PluginError::Refused(self.file.display().to_string(), what)
    }
}

/// A plugin's file: `name` itself or, where that is a word alone, `libNAME.so` in the first folder of `path` that has it.
///
/// # Errors
/// A word that no folder has.
pub fn find(name: &str, path: Option<&OsStr>) -> Result<PathBuf, PluginError> {
    // With a folder before it, or the system would look where its own libraries are.
    let here = Path::new(".");
    let given = Path::new(name);
    if given.components().count() > 1 || given.extension().is_some() {
        return Ok(here.join(given));
    }
    let file = format!("{}{name}{}", std::env::consts::DLL_PREFIX, std::env::consts::DLL_SUFFIX);
    let folders: Vec<PathBuf> = path.map(|path| std::env::split_paths(path).collect()).unwrap_or_default();
    let mut files = folders.iter().map(|folder| here.join(folder).join(&file));
    files.find(|file| file.is_file()).ok_or_else(|| {
        let folders: Vec<_> = folders.iter().map(|f| f.display().to_string()).collect();
        let searched = if folders.is_empty() { "which is not set".into() } else { folders.join(", ") };
        let what = format!("no {file} in HAPFLOW_PLUGIN_PATH ({searched}): name a file, or its folder there");
        PluginError::Refused(name.into(), what)
    })
}
