//! What is known not to meet its goal, with the best figure and the reason.

use serde::Deserialize;

/// A goal that is known not to be met.
#[derive(Clone, Debug, Deserialize, PartialEq)]
pub struct Shortfall {
    /// The case.
    pub case: String,
    /// The quantity.
    pub quantity: String,
    /// The best error so far.
    pub best: f64,
    /// Why it is no better.
    pub reason: String,
}

/// All of them, from `shortfalls.json`; the file is part of the program, and a test reads it.
pub fn shortfalls() -> Vec<Shortfall> {
    serde_json::from_str(include_str!("../shortfalls.json")).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_shortfall_is_one_of_a_case_and_has_a_reason() {
        let list: Vec<Shortfall> = serde_json::from_str(include_str!("../shortfalls.json")).unwrap();
        for s in &list {
            assert!(crate::find(&s.case).is_ok(), "{}", s.case);
            assert!(s.best.is_finite() && s.reason.len() > 20, "{s:?}");
        }
        assert_eq!(list, shortfalls());
    }
}
