//! One check: what was found, and what to do about it.

/// What is said of a thing that only Linux tells.
pub const NOT_KNOWN: &str = "not known on this system";

/// How a check came out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    /// As it should be.
    Ok,
    /// hapflow runs, but slower or with late ticks, or something will be lacking later.
    Warning,
    /// hapflow needs this to run, and it is not there.
    Missing,
}

impl State {
    /// Its word, in the table and in JSON.
    pub fn word(self) -> &'static str {
        match self {
            Self::Ok => "ok",
            Self::Warning => "warning",
            Self::Missing => "missing",
        }
    }
}

/// A check and its outcome.
///
/// In both texts, what stands between backticks is to be typed or written as it is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Check {
    /// One word.
    pub name: &'static str,
    /// How it came out.
    pub state: State,
    /// What was found, on one line.
    pub found: String,
    /// What to do, on one line; empty if nothing.
    pub advice: String,
}

impl Check {
    /// As it should be; nothing to do.
    pub fn ok(name: &'static str, found: impl Into<String>) -> Self {
        Self { name, state: State::Ok, found: found.into(), advice: String::new() }
    }

    /// hapflow runs all the same.
    pub fn warning(name: &'static str, found: impl Into<String>, advice: impl Into<String>) -> Self {
        Self { name, state: State::Warning, found: found.into(), advice: advice.into() }
    }

    /// hapflow does not run without.
    pub fn missing(name: &'static str, found: impl Into<String>, advice: impl Into<String>) -> Self {
        Self { name, state: State::Missing, found: found.into(), advice: advice.into() }
    }

    /// The same with something to say although all is well.
    pub fn and(mut self, advice: impl Into<String>) -> Self {
        self.advice = advice.into();
        self
    }
}

/// `text` on Linux, whose commands and files it names; [`NOT_KNOWN`] elsewhere.
pub fn on_linux(text: impl Into<String>) -> String {
    if cfg!(target_os = "linux") { text.into() } else { NOT_KNOWN.into() }
}
