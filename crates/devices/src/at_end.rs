//! What comes after the end.

/// What a motion or a script does once it is over.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum AtEnd {
    /// It stays at its last place, at rest.
    #[default]
    Hold,
    /// It begins again. Only for what ends where it began: a hand does not jump.
    Repeat,
}
