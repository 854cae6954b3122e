//! Why a part of a plugin failed.

use std::sync::{Arc, OnceLock};

/// The first reason, which stays: told by the thread that calls the plugin (the fluid's, never a servo's), read by any.
#[derive(Clone, Default)]
pub(crate) struct Failure(Arc<OnceLock<String>>);

impl Failure {
    pub fn tell(&self, reason: impl FnOnce() -> String) {
        self.0.get_or_init(reason);
    }

    pub fn reason(&self) -> Option<&str> {
        self.0.get().map(String::as_str)
    }
}
