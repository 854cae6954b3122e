//! The program `hapflow`.
fn main() {}
