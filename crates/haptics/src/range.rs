//! Numbers outside their range, said the same way everywhere.

/// A number that is outside its range, or not a number at all.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("{field} = {value} is outside its range {min} to {max}")]
pub struct RangeError {
    /// Name of the setting, with its unit at the end where it has one.
    pub field: &'static str,
    /// Its value, in the unit that its name says.
    pub value: f64,
    /// Smallest allowed.
    pub min: f64,
    /// Largest allowed.
    pub max: f64,
}

/// Gives `value` back if it lies in `min..=max`.
///
/// # Errors
/// [`RangeError`] if it does not; NaN never does.
pub fn check_range(field: &'static str, value: f64, min: f64, max: f64) -> Result<f64, RangeError> {
    if (min..=max).contains(&value) { Ok(value) } else { Err(RangeError { field, value, min, max }) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_ends_belong_to_the_range() {
        assert_eq!(check_range("a_m", 1.0, 1.0, 2.0), Ok(1.0));
        assert_eq!(check_range("a_m", 2.0, 1.0, 2.0), Ok(2.0));
    }

    #[test]
    fn outside_and_nan_are_refused_by_name() {
        let error = check_range("a_m", 2.5, 1.0, 2.0).unwrap_err();
        assert_eq!(error.to_string(), "a_m = 2.5 is outside its range 1 to 2");
        assert!(check_range("a_m", f64::NAN, 1.0, 2.0).is_err());
        assert!(check_range("a_m", f64::INFINITY, 1.0, 2.0).is_err());
    }
}
