//! Values of settings, whoever writes them: a scene file, a command line, a C program.

use glam::DVec3;
use std::fmt;

/// A value.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A number.
    Number(f64),
    /// Yes or no.
    Bool(bool),
    /// A word or a text.
    Text(String),
    /// Three numbers.
    Vector(DVec3),
}

impl Value {
    /// Reads a value from a command line: `true`, `1.5`, `[0, -9.81, 0]`, else a text.
    pub fn parse(text: &str) -> Self {
        let text = text.trim();
        match text {
            "true" => return Self::Bool(true),
            "false" => return Self::Bool(false),
            _ => {}
        }
        if let Ok(number) = text.parse::<f64>() {
            return Self::Number(number);
        }
        parse_vector(text).map_or_else(|| Self::Text(text.trim_matches('"').to_string()), Self::Vector)
    }

    pub(crate) fn number(&self) -> f64 {
        if let Self::Number(n) = self { *n } else { f64::NAN }
    }

    pub(crate) fn bool(&self) -> bool {
        matches!(self, Self::Bool(true))
    }

    pub(crate) fn text(&self) -> &str {
        if let Self::Text(t) = self { t } else { "" }
    }

    pub(crate) fn vector(&self) -> DVec3 {
        if let Self::Vector(v) = self { *v } else { DVec3::NAN }
    }
}

fn parse_vector(text: &str) -> Option<DVec3> {
    let inner = text.strip_prefix('[')?.strip_suffix(']')?;
    let numbers: Vec<f64> = inner.split(',').map(|n| n.trim().parse().ok()).collect::<Option<_>>()?;
    <[f64; 3]>::try_from(numbers).ok().map(DVec3::from)
}

impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(n) => write!(f, "{n}"),
            Self::Bool(b) => write!(f, "{b}"),
            Self::Text(t) => write!(f, "\"{t}\""),
            Self::Vector(v) => write!(f, "[{}, {}, {}]", v.x, v.y, v.z),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_read_as_people_write_them() {
        for (text, value) in [
            ("1e-3", Value::Number(1e-3)),
            (" true", Value::Bool(true)),
            ("wcsph", Value::Text("wcsph".into())),
            ("\"a b\"", Value::Text("a b".into())),
            ("[0, -9.81,0]", Value::Vector(DVec3::new(0.0, -9.81, 0.0))),
            ("[1,2]", Value::Text("[1,2]".into())),
        ] {
            assert_eq!(Value::parse(text), value);
        }
    }
}
