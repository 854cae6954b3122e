//! The checks as a table for people and as JSON for programs.

use super::check::{Check, State};
use serde_json::{Value, json};

/// Columns that the table takes.
const WIDTH: usize = 80;
/// Columns before the texts: indent, state, name and the gaps between them.
const MARGIN: usize = 21;
/// Ends a line of a command that goes on in the next one, for shells and for udev.
const GOES_ON: &str = " \\";

/// As an array of `{check, state, found, advice}`; `advice` is empty if there is nothing to do.
pub fn json(checks: &[Check]) -> Value {
    let one =
        |c: &Check| json!({ "check": c.name, "state": c.state.word(), "found": c.found, "advice": c.advice });
    checks.iter().map(one).collect()
}

/// As a table of at most 80 columns, where no single word is longer, and the outcome below it.
pub fn table(checks: &[Check]) -> String {
    let mut text = String::new();
    for check in checks {
        let head = format!("  {:<7}  {:<8}  ", check.state.word(), check.name);
        text += &block(&head, &check.found);
        if !check.advice.is_empty() {
            text += &block(&format!("{:MARGIN$}→ ", ""), &check.advice);
        }
    }
    text + "\n" + &outcome(checks) + "\n"
}

/// The last line.
fn outcome(checks: &[Check]) -> String {
    let named = |state| checks.iter().filter(|c| c.state == state).map(|c| c.name).collect::<Vec<_>>();
    let (missing, warnings) = (named(State::Missing), named(State::Warning));
    match (missing.as_slice(), warnings.len()) {
        ([], 0) => "All is as it should be.".into(),
        ([], 1) => "hapflow runs here; see the warning.".into(),
        ([], n) => format!("hapflow runs here; see the {n} warnings."),
        (names, _) => format!("hapflow does not run here; see to: {}.", names.join(", ")),
    }
}

/// `text` after `head`, its further lines as far in as the first.
fn block(head: &str, text: &str) -> String {
    let indent = head.chars().count();
    let lines = wrap(text, WIDTH.saturating_sub(indent));
    let mut out = head.to_string();
    out += &lines.join(&format!("\n{:indent$}", ""));
    out + "\n"
}

/// Breaks a text into lines of at most `width` characters, at spaces.
fn wrap(text: &str, width: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for part in words(text).iter().flat_map(|word| parts(word, width)) {
        match lines.last_mut() {
            Some(line) if !line.ends_with(GOES_ON) && length(line) + 1 + length(&part) <= width => {
                line.push(' ');
                line.push_str(&part);
            }
            _ => lines.push(part),
        }
    }
    lines
}

/// The words of a text; what stands between backticks is one word.
fn words(text: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut quoted = false;
    for c in text.chars() {
        quoted ^= c == '`';
        match words.last_mut() {
            Some(word) if quoted || !c.is_whitespace() => word.push(c),
            _ => words.push(String::new()),
        }
    }
    words.retain(|w| !w.is_empty());
    words
}

/// A word, broken at its spaces if it is a command that fits on no line.
///
/// A backslash ends each part but the last, so that it still means the same to a shell and in a file of udev rules.
/// A command with single quotes stays whole: in them it would not.
fn parts(word: &str, width: usize) -> Vec<String> {
    if length(word) <= width || word.contains('\'') {
        return vec![word.to_string()];
    }
    let room = width.saturating_sub(length(GOES_ON));
    let mut parts: Vec<String> = Vec::new();
    for piece in word.split(' ') {
        match parts.last_mut() {
            Some(part) if length(part) + 1 + length(piece) <= room => {
                part.push(' ');
                part.push_str(piece);
            }
            Some(part) => {
                part.push_str(GOES_ON);
                parts.push(piece.to_string());
            }
            None => parts.push(piece.to_string()),
        }
    }
    parts
}

/// Columns of a text; all of its characters take one.
fn length(text: &str) -> usize {
    text.chars().count()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample() -> Vec<Check> {
        vec![
            Check::ok("cores", "2: one for the servo, the rest for the fluid"),
            Check::warning("priority", "refused, ".repeat(20), "run `sudo setcap cap_sys_nice=ep hapflow`"),
            Check::missing("output", "`out` cannot be written", "choose another folder"),
        ]
    }

    #[test]
    fn the_table_is_aligned_and_narrow() {
        let text = table(&sample());
        assert!(
            text.starts_with("  ok       cores     2: one for the servo, the rest for the fluid\n"),
            "{text}"
        );
        assert!(text.contains("\n  missing  output    `out` cannot be written\n"), "{text}");
        assert!(text.contains("\n                     → choose another folder\n"), "{text}");
        assert!(text.lines().all(|l| length(l) <= WIDTH), "{text}");
        assert!(
            text.lines()
                .filter(|l| l.contains("refused"))
                .skip(1)
                .all(|l| l.starts_with(&" ".repeat(MARGIN)))
        );
    }

    #[test]
    fn the_outcome_names_what_is_missing() {
        let mut checks = sample();
        assert_eq!(outcome(&checks), "hapflow does not run here; see to: output.");
        checks.pop();
        assert_eq!(outcome(&checks), "hapflow runs here; see the warning.");
        checks.push(checks[1].clone());
        assert_eq!(outcome(&checks), "hapflow runs here; see the 2 warnings.");
        assert_eq!(outcome(&checks[..1]), "All is as it should be.");
    }

    #[test]
    fn json_has_four_texts_each() {
        let value = json(&sample());
        assert_eq!(value[0]["check"], "cores");
        assert_eq!(value[0]["advice"], "");
        assert_eq!(value[1]["state"], "warning");
        assert_eq!(value[2]["found"], "`out` cannot be written");
        assert!(
            value
                .as_array()
                .is_some_and(|a| a.len() == 3 && a.iter().all(|c| c.as_object().unwrap().len() == 4))
        );
        assert_eq!(json(&[]), json!([]));
    }

    #[test]
    fn commands_stay_whole_where_they_fit() {
        assert_eq!(wrap("now run `a b c`, then rest", 12), ["now run", "`a b c`,", "then rest"]);
        assert_eq!(wrap("", 12), Vec::<String>::new());
        assert_eq!(wrap("toolongforaline ok", 5), ["toolongforaline", "ok"]);
    }

    #[test]
    fn a_command_longer_than_a_line_goes_on_after_a_backslash() {
        assert_eq!(wrap("run `aaa bbb ccc ddd` now", 12), ["run", "`aaa bbb \\", "ccc ddd` now"]);
        assert_eq!(wrap("run `aaa 'bbb ccc' ddd`", 12), ["run", "`aaa 'bbb ccc' ddd`"]);
    }
}
