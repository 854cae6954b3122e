//! Meshes from files: Wavefront OBJ, and STL in text and in binary.

use crate::builtin;
use glam::DVec3;
use hapflow_devices::read_at_most;
use hapflow_fluid::{MAX_TRIANGLES, Mesh};
use std::path::Path;

/// Largest file, bytes.
const MOST_BYTES: u64 = 64 << 20;
/// Head of a binary STL, and each of its triangles, bytes.
const STL_HEAD: usize = 84;
const STL_TRIANGLE: usize = 50;

/// Corners, and the corners of each triangle.
type Triangles = (Vec<DVec3>, Vec<[u32; 3]>);

/// The shipped mesh of that name, or the one in the file at `path`. What is wrong is told with file and line.
pub(crate) fn read(path: &Path) -> Result<Mesh, String> {
    let name = path.display();
    let told = |what: &dyn std::fmt::Display| format!("a closed mesh (OBJ or STL); {name}: {what}");
    let found = match path.to_str().and_then(builtin::mesh) {
        Some(text) => obj(text),
        None => parse(path, &load(path).map_err(|what| told(&what))?),
    };
    let (vertices, triangles) = found.map_err(|(line, what)| match line {
        0 => told(&what),
        _ => format!("a closed mesh (OBJ or STL); {name}:{line}: {what}"),
    })?;
    Mesh::new(&vertices, &triangles).map_err(|e| told(&e))
}

fn load(path: &Path) -> Result<Vec<u8>, String> {
    read_at_most(path, MOST_BYTES).map_err(|e| e.to_string())
}

/// Line (from 1, or 0 for none) and fault.
type Fault = (usize, String);

fn parse(path: &Path, bytes: &[u8]) -> Result<Triangles, Fault> {
    let ending = path.extension().and_then(|e| e.to_str()).unwrap_or("").to_ascii_lowercase();
    match ending.as_str() {
        "obj" => obj(text(bytes)?),
        "stl" if is_binary_stl(bytes) => Ok(binary_stl(bytes)),
        "stl" => text_stl(text(bytes)?),
        other => Err((0, format!("its name must end in .obj or .stl, not \".{other}\""))),
    }
}

fn text(bytes: &[u8]) -> Result<&str, Fault> {
    std::str::from_utf8(bytes).map_err(|e| {
        let line = 1 + bytes[..e.valid_up_to()].iter().filter(|b| **b == b'\n').count();
        (line, "it is no text".into())
    })
}

/// Three coordinates.
fn place<'a>(mut words: impl Iterator<Item = &'a str>, line: usize) -> Result<DVec3, Fault> {
    let mut v = DVec3::NAN;
    for axis in 0..3 {
        let word = words.next().unwrap_or("");
        let number = word.parse().ok().filter(|n: &f64| n.is_finite());
        v[axis] = number.ok_or_else(|| (line, format!("three numbers expected, not \"{word}\"")))?;
    }
    Ok(v)
}

fn too_many(line: usize) -> Fault {
    (line, format!("more than {MAX_TRIANGLES} triangles"))
}

/// Lines `v x y z` and `f a b c …`, whose corners count from 1, or back from −1; faces of more corners become fans.
fn obj(text: &str) -> Result<Triangles, Fault> {
    let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
    for (k, line) in text.lines().enumerate() {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => vertices.push(place(words, k + 1)?),
            Some("f") => {
                let corners: Vec<_> =
                    words.map(|w| obj_corner(w, vertices.len(), k + 1)).collect::<Result<_, _>>()?;
                if corners.len() < 3 {
                    return Err((k + 1, "a face of at least three corners expected".into()));
                }
                triangles.extend((2..corners.len()).map(|n| [corners[0], corners[n - 1], corners[n]]));
                if triangles.len() > MAX_TRIANGLES {
                    return Err(too_many(k + 1));
                }
            }
            _ => {}
        }
    }
    Ok((vertices, triangles))
}

/// `7`, `7/1`, `7//3` or `-1`.
fn obj_corner(word: &str, known: usize, line: usize) -> Result<u32, Fault> {
    let number = word.split('/').next().and_then(|n| n.parse::<i64>().ok());
    let from_start = number.map(|n| if n < 0 { known as i64 + n } else { n - 1 });
    let there = from_start.filter(|n| (0..known as i64).contains(n));
    there.map(|n| n as u32).ok_or_else(|| (line, format!("corner \"{word}\": there are {known} so far")))
}

/// Its length says so: a text that begins as it likes has another.
fn is_binary_stl(bytes: &[u8]) -> bool {
    let count = bytes.get(80..STL_HEAD).and_then(|b| b.try_into().ok()).map(u32::from_le_bytes);
    count.is_some_and(|n| bytes.len() as u64 == STL_HEAD as u64 + u64::from(n) * STL_TRIANGLE as u64)
}

fn binary_stl(bytes: &[u8]) -> Triangles {
    let number = |b: &[u8]| b.try_into().map_or(f64::NAN, |b| f64::from(f32::from_le_bytes(b)));
    let corner = |b: &[u8]| DVec3::new(number(&b[..4]), number(&b[4..8]), number(&b[8..12]));
    let triangles = bytes[STL_HEAD..].chunks_exact(STL_TRIANGLE);
    // After the normal.
    loose(triangles.flat_map(|t| t[12..48].chunks_exact(12).map(corner)).collect())
}

/// Lines `vertex x y z`, three a triangle.
fn text_stl(text: &str) -> Result<Triangles, Fault> {
    let mut corners = Vec::new();
    let mut last = 0;
    for (k, line) in text.lines().enumerate() {
        let mut words = line.split_whitespace();
        if words.next() == Some("vertex") {
            corners.push(place(words, k + 1)?);
            last = k + 1;
        }
        if corners.len() > 3 * MAX_TRIANGLES {
            return Err(too_many(k + 1));
        }
    }
    if corners.len() % 3 != 0 {
        return Err((last, "the last triangle has not three corners".into()));
    }
    Ok(loose(corners))
}

/// Every three corners are a triangle.
fn loose(corners: Vec<DVec3>) -> Triangles {
    let triangles = (0..corners.len() as u32 / 3).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
    (corners, triangles)
}

#[cfg(test)]
mod tests {
    use super::*;

    const TETRAHEDRON: &str = "# a corner\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvn 0 0 1\n\
        f 1 3 2\nf 1/1 2/1 4/1\nf 2//1 3//1 4//1\nf -4 -1 -2\n";

    fn corners() -> Vec<[[f32; 3]; 3]> {
        let v = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]].iter().map(|t| t.map(|k: usize| v[k])).collect()
    }

    fn parsed(name: &str, bytes: &[u8]) -> Result<f64, Fault> {
        let (vertices, triangles) = parse(Path::new(name), bytes)?;
        Mesh::new(&vertices, &triangles).map(|m| m.volume()).map_err(|e| (0, e.to_string()))
    }

    #[test]
    fn all_three_formats_hold_the_same_body() {
        let mut binary = vec![b' '; 80];
        binary.extend(4_u32.to_le_bytes());
        let mut text = String::from("solid corner\n");
        for t in corners() {
            binary.extend([0; 12]);
            binary.extend(t.as_flattened().iter().flat_map(|c| c.to_le_bytes()));
            binary.extend([0; 2]);
            text += "facet normal 0 0 0\n outer loop\n";
            t.iter().for_each(|v| text += &format!("  vertex {} {} {}\n", v[0], v[1], v[2]));
            text += " endloop\nendfacet\n";
        }
        for (name, bytes) in
            [("a.obj", TETRAHEDRON.as_bytes()), ("a.stl", &binary[..]), ("a.STL", text.as_bytes())]
        {
            let volume = parsed(name, bytes);
            assert!(volume.clone().is_ok_and(|v| (v - 1.0 / 6.0).abs() < 1e-9), "{name}: {volume:?}");
        }
    }

    #[test]
    fn what_is_wrong_is_told_with_its_line() {
        let open = TETRAHEDRON.replace("f 1 3 2\n", "");
        for (name, text, line, what) in [
            ("a.obj", "v 0 0 0\nv 0 x 1\n", 2, "three numbers expected, not \"x\""),
            ("a.obj", "v 0 0 nan\n", 1, "three numbers"),
            ("a.obj", "v 0 0\n", 1, "not \"\""),
            ("a.obj", "v 0 0 0\n\nf 1 2 3\n", 3, "corner \"2\": there are 1 so far"),
            ("a.obj", "v 0 0 0\nf 1 1\n", 2, "at least three corners"),
            ("a.obj", "f 0 0 0\n", 1, "corner \"0\""),
            ("a.obj", "", 0, "no triangle"),
            ("a.obj", &open, 0, "not closed: 3 of its edges"),
            ("a.stl", "solid x\nvertex 0 0 0\nvertex 1 0 0\n", 3, "not three corners"),
            ("a.ply", "", 0, "must end in .obj or .stl"),
        ] {
            let told = parsed(name, text.as_bytes());
            assert!(told.clone().is_err_and(|e| e.0 == line && e.1.contains(what)), "{text}: {told:?}");
        }
        assert!(read(Path::new("/nowhere.obj")).is_err_and(|e| e.contains("/nowhere.obj")));
        assert!(parsed("a.obj", b"v 0 0 0\n\xff\n").is_err_and(|e| e.0 == 2));
    }

    #[test]
    fn no_bytes_make_the_reader_panic() {
        for cut in 0..TETRAHEDRON.len() {
            let _ = parsed("a.obj", &TETRAHEDRON.as_bytes()[..cut]);
            let _ = parsed("a.stl", &TETRAHEDRON.as_bytes()[..cut]);
        }
        let mut bytes = vec![0xff; STL_HEAD + STL_TRIANGLE];
        bytes[80..STL_HEAD].copy_from_slice(&1_u32.to_le_bytes());
        assert!(parsed("a.stl", &bytes).is_err());
    }
}
