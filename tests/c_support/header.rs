//! The headers, read as far as the tests need it.

use super::root;
use std::fs;

/// A header of the interface, by its name without `.h`.
fn read(name: &str) -> String {
    fs::read_to_string(root().join(format!("include/hapflow/{name}.h"))).unwrap()
}

/// Names of all headers that `hapflow.h` includes, in its order.
pub fn included() -> Vec<String> {
    let name = |line: &str| Some(line.strip_prefix("#include <hapflow/")?.strip_suffix(".h>")?.to_string());
    read("hapflow").lines().filter_map(name).collect()
}

/// Names of all headers that there are, sorted.
pub fn there() -> Vec<String> {
    let name = |file: fs::DirEntry| Some(file.file_name().to_str()?.strip_suffix(".h")?.to_string());
    let folder = fs::read_dir(root().join("include/hapflow")).unwrap();
    let mut names: Vec<_> = folder.filter_map(|file| name(file.unwrap())).collect();
    names.sort();
    names
}

/// The text of all headers that `hapflow.h` includes, in its order.
pub fn text() -> String {
    included().iter().map(|name| read(name)).collect()
}

/// A function of a header.
pub struct Prototype {
    pub name: String,
    /// As it is declared, on one line, without what marks it as exported.
    pub declared: String,
    /// The comment above, on one line.
    pub comment: String,
}

/// A struct of a header.
pub struct Struct {
    pub name: String,
    /// Names of its fields, in order.
    pub fields: Vec<String>,
}

fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Every function.
pub fn prototypes() -> Vec<Prototype> {
    const MARK: &str = "\nHAPFLOW_API ";
    let header = text();
    let prototype = |at: usize| {
        let declared = header[at + MARK.len()..].split_once(';').unwrap().0;
        let name = declared.split_once('(').unwrap().0.rsplit([' ', '*']).next().unwrap();
        let comment = header[..at].rsplit_once("/*").unwrap().1;
        let comment: String = comment.trim_end().trim_end_matches("*/").replace("\n *", "\n");
        Prototype { name: name.into(), declared: one_line(declared), comment: one_line(&comment) }
    };
    header.match_indices(MARK).map(|(at, _)| prototype(at)).collect()
}

/// The text without its comments.
fn uncommented(text: &str) -> String {
    let mut parts = text.split("/*");
    let first = parts.next().unwrap().to_string();
    parts.fold(first, |all, part| all + part.split_once("*/").unwrap().1)
}

/// Every struct.
pub fn structs() -> Vec<Struct> {
    let code = uncommented(&text());
    let one = |part: &str| {
        let (name, body) = part.split_once('{').unwrap();
        let body = body.split_once('}').unwrap().0;
        let field = |line: &str| match line.split_once("(*") {
            // A pointer to a function.
            Some((_, rest)) => rest.split_once(')').unwrap().0.to_string(),
            None => line.rsplit([' ', '*']).next().unwrap().split('[').next().unwrap().to_string(),
        };
        let fields = body.split(';').map(str::trim).filter(|l| !l.is_empty()).map(field).collect();
        Struct { name: name.trim().into(), fields }
    };
    code.split("typedef struct ").skip(1).map(one).collect()
}

/// Names of every constant: those of enumerations, and macros with a number.
pub fn constants() -> Vec<String> {
    let code = uncommented(&text());
    let of_line = |line: &str| {
        let line = line.trim();
        match line.strip_prefix("#define ") {
            Some(rest) => rest.split_once(' ').filter(|(_, v)| v.trim().ends_with('u')).map(|(name, _)| name),
            None => line.split_once(" = ").map(|(name, _)| name),
        }
        .filter(|name| name.starts_with("HAPFLOW_"))
        .map(String::from)
    };
    code.lines().filter_map(of_line).collect()
}
