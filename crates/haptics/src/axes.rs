//! How a device's axes lie in the scene.

use glam::{DMat3, DQuat, DVec3};
use std::fmt;
use std::str::FromStr;

/// Why axes were refused.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum AxesError {
    /// Not three words of x, y, z, -x, -y, -z.
    #[error("axes \"{text}\": write three of x, y, z, -x, -y, -z with spaces between, such as \"x y z\"")]
    Words {
        /// What was written.
        text: String,
    },
    /// One axis twice, so another is missing.
    #[error("axes \"{text}\": each of x, y and z must be there once")]
    Repeated {
        /// What was written.
        text: String,
    },
    /// A mirror image: a right hand would become a left one.
    #[error("axes \"{text}\" are left-handed: turn the sign of one axis, or of all three")]
    LeftHanded {
        /// What was written.
        text: String,
    },
}

/// A turn of the device frame by right angles into the scene frame, written as three signed axes: which
/// device axis is the scene's x, y and z. So `-z y x` is scene x = −device z, y = device y, z = device x.
/// Default `x y z`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axes {
    /// Row n holds scene axis n in device axes.
    rows: [DVec3; 3],
    rotation: DQuat,
}

impl Axes {
    /// The device's axes are the scene's.
    pub const IDENTITY: Self = Self { rows: [DVec3::X, DVec3::Y, DVec3::Z], rotation: DQuat::IDENTITY };

    /// A vector of the device frame, in the scene frame. Exact: signs and places only.
    pub fn to_scene(&self, v: DVec3) -> DVec3 {
        DVec3::new(self.rows[0].dot(v), self.rows[1].dot(v), self.rows[2].dot(v))
    }

    /// A vector of the scene frame, in the device frame.
    pub fn to_device(&self, v: DVec3) -> DVec3 {
        self.rows[0] * v.x + self.rows[1] * v.y + self.rows[2] * v.z
    }

    /// The same turn as a quaternion, device frame to scene frame.
    pub fn rotation(&self) -> DQuat {
        self.rotation
    }
}

impl Default for Axes {
    fn default() -> Self {
        Self::IDENTITY
    }
}

impl FromStr for Axes {
    type Err = AxesError;
    fn from_str(text: &str) -> Result<Self, AxesError> {
        let rows = parse_rows(text).ok_or_else(|| AxesError::Words { text: text.to_owned() })?;
        let matrix = DMat3::from_cols(rows[0], rows[1], rows[2]).transpose();
        match matrix.determinant() {
            d if d > 0.5 => Ok(Self { rows, rotation: DQuat::from_mat3(&matrix) }),
            d if d < -0.5 => Err(AxesError::LeftHanded { text: text.to_owned() }),
            _ => Err(AxesError::Repeated { text: text.to_owned() }),
        }
    }
}

impl fmt::Display for Axes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y, z] = self.rows.map(word);
        write!(f, "{x} {y} {z}")
    }
}

const WORDS: [(&str, DVec3); 6] = [
    ("x", DVec3::X),
    ("y", DVec3::Y),
    ("z", DVec3::Z),
    ("-x", DVec3::NEG_X),
    ("-y", DVec3::NEG_Y),
    ("-z", DVec3::NEG_Z),
];

fn word(axis: DVec3) -> &'static str {
    WORDS.iter().find(|(_, v)| *v == axis).map_or("?", |(word, _)| word)
}

fn parse_rows(text: &str) -> Option<[DVec3; 3]> {
    let mut words =
        text.split_whitespace().map(|word| WORDS.iter().find(|(w, _)| *w == word).map(|(_, v)| *v));
    let rows = [words.next()??, words.next()??, words.next()??];
    words.next().is_none().then_some(rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    const RIGHT: [&str; 5] = ["x y z", "-z y x", "y z x", "-x -y z", "-x z y"];

    #[test]
    fn the_example_turns_as_it_says() {
        let axes: Axes = "-z y x".parse().unwrap();
        assert_eq!(axes.to_scene(DVec3::new(1.0, 2.0, 3.0)), DVec3::new(-3.0, 2.0, 1.0));
        assert_eq!(axes.to_device(DVec3::new(-3.0, 2.0, 1.0)), DVec3::new(1.0, 2.0, 3.0));
    }

    #[test]
    fn of_the_48_signed_permutations_24_are_taken() {
        let words: Vec<&str> = WORDS.iter().map(|(word, _)| *word).collect();
        let (mut right, mut left, mut repeated) = (0, 0, 0);
        for text in words.iter().flat_map(|a| words.iter().map(move |b| format!("{a} {b}"))) {
            for third in &words {
                match format!("{text} {third}").parse::<Axes>() {
                    Ok(axes) => {
                        right += 1;
                        let turned = axes.to_scene(DVec3::X).cross(axes.to_scene(DVec3::Y));
                        assert_eq!(turned, axes.to_scene(DVec3::Z));
                    }
                    Err(AxesError::LeftHanded { .. }) => left += 1,
                    Err(AxesError::Repeated { .. }) => repeated += 1,
                    Err(error) => panic!("{error}"),
                }
            }
        }
        assert_eq!((right, left, repeated), (24, 24, 216 - 48));
    }

    #[test]
    fn the_quaternion_turns_alike_and_the_text_comes_back() {
        for text in RIGHT {
            let axes: Axes = text.parse().unwrap();
            assert_eq!(axes.to_string(), text);
            let v = DVec3::new(0.3, -1.2, 2.5);
            assert!((axes.rotation() * v - axes.to_scene(v)).length() < 1e-12);
            assert_eq!(axes.to_device(axes.to_scene(v)), v);
        }
    }

    #[test]
    fn other_words_are_refused() {
        for text in ["", "x y", "x y z x", "x y w", "+x y z", "xyz", "X Y Z"] {
            assert!(matches!(text.parse::<Axes>(), Err(AxesError::Words { .. })), "{text}");
        }
        let error = "x z y".parse::<Axes>().unwrap_err().to_string();
        assert_eq!(error, "axes \"x z y\" are left-handed: turn the sign of one axis, or of all three");
    }
}
