//! CSV files with a header: columns are read by name, and others are added.

use csv::{ErrorKind, ReaderBuilder, StringRecord, Trim, Writer};
use hapflow_devices::read_at_most;
use std::fmt::Display;
use std::path::Path;

/// The largest file that is read, bytes: some million rows.
const MAX_FILE_BYTES: u64 = 1 << 28;

/// Why a table was refused. Lines count from 1, the header's.
#[derive(Debug, thiserror::Error)]
pub enum TableError {
    /// The file cannot be opened.
    #[error("{file} cannot be opened, {cause}: check the path")]
    Open {
        /// The file.
        file: String,
        /// What the system says.
        cause: String,
    },
    /// A line is no CSV.
    #[error("{file}, line {line}: {cause}; every line must have as many columns as the header")]
    Line {
        /// The file.
        file: String,
        /// The line.
        line: u64,
        /// What is wrong with it.
        cause: String,
    },
    /// The header lacks a column, or has it twice.
    #[error("{file}, line 1: {problem} column {column}; found are {found}")]
    Column {
        /// The file.
        file: String,
        /// What is wrong with it.
        problem: &'static str,
        /// The column.
        column: String,
        /// The columns that are there.
        found: String,
    },
    /// A value that cannot be used.
    #[error("{file}, line {line}: {column} = \"{value}\" must be {allowed}")]
    Value {
        /// The file.
        file: String,
        /// The line.
        line: u64,
        /// The column.
        column: String,
        /// What is written there.
        value: String,
        /// What may be.
        allowed: String,
    },
    /// Values that are sound by themselves, but not together.
    #[error("{file}, line {line}: {columns}: {cause}")]
    Row {
        /// The file.
        file: String,
        /// The line.
        line: u64,
        /// The columns.
        columns: &'static str,
        /// What is wrong with them.
        cause: String,
    },
}

/// A whole CSV file.
pub struct Table {
    file: String,
    header: StringRecord,
    rows: Vec<StringRecord>,
}

/// One row of it.
pub struct Row<'a> {
    table: &'a Table,
    cells: &'a StringRecord,
}

impl Table {
    /// Reads a file.
    pub fn read(path: &Path) -> Result<Self, TableError> {
        let file = path.display().to_string();
        let text = read_at_most(path, MAX_FILE_BYTES)
            .map_err(|cause| TableError::Open { file: file.clone(), cause: cause.to_string() })?;
        Self::parse(&text, file)
    }

    fn parse(text: &[u8], file: String) -> Result<Self, TableError> {
        let mut reader = ReaderBuilder::new().trim(Trim::All).from_reader(text);
        let line_error = |error: csv::Error| TableError::Line {
            file: file.clone(),
            line: error.position().map_or(1, csv::Position::line),
            cause: cause(&error),
        };
        let header = reader.headers().map_err(line_error)?.clone();
        let rows = reader.records().collect::<Result<_, _>>().map_err(line_error)?;
        Ok(Self { file, header, rows })
    }

    /// What `take` makes of each row; the columns that it `needs` must be there even where there are no rows.
    pub fn rows<T>(
        &self,
        needs: &[&str],
        take: impl Fn(&Row<'_>) -> Result<T, TableError>,
    ) -> Result<Vec<T>, TableError> {
        self.check(needs)?;
        self.rows.iter().map(|cells| take(&Row { table: self, cells })).collect()
    }

    /// The table with `added` columns, whose cells `fill` makes of each row. A column that has one of these names already
    /// is filled anew in its place; all others stay as they are. The columns that `fill` `needs` must be there even where there are no
    /// rows.
    pub fn with(
        &self,
        needs: &[&str],
        added: &[&str],
        mut fill: impl FnMut(&Row<'_>) -> Result<Vec<String>, TableError>,
    ) -> Result<Vec<u8>, TableError> {
        self.check(needs)?;
        let places: Vec<Option<usize>> =
            added.iter().map(|name| self.header.iter().position(|known| known == *name)).collect();
        let mut lines = vec![merge(&self.header, &places, added.iter().map(|name| (*name).to_owned()))];
        for cells in &self.rows {
            let new = fill(&Row { table: self, cells })?;
            lines.push(merge(cells, &places, new.into_iter()));
        }
        let mut writer = Writer::from_writer(Vec::new());
        let written = lines.iter().try_for_each(|line| writer.write_record(line));
        let failed = |cause: String| TableError::Line { file: self.file.clone(), line: 0, cause };
        written.map_err(|error| failed(error.to_string()))?;
        writer.into_inner().map_err(|error| failed(error.to_string()))
    }

    fn check(&self, needs: &[&str]) -> Result<(), TableError> {
        needs.iter().try_for_each(|column| self.place(column).map(drop))
    }

    /// Where `column` stands.
    fn place(&self, column: &str) -> Result<usize, TableError> {
        let mut places = self.header.iter().enumerate().filter(|(_, name)| *name == column);
        let problem = match (places.next(), places.next()) {
            (Some((at, _)), None) => return Ok(at),
            (None, _) => "no",
            (Some(_), Some(_)) => "more than one",
        };
        Err(TableError::Column {
            file: self.file.clone(),
            problem,
            column: column.to_owned(),
            found: if self.header.is_empty() {
                "none".into()
            } else {
                self.header.iter().collect::<Vec<_>>().join(", ")
            },
        })
    }
}

/// A line with new cells in their places, and behind it those that have none.
fn merge(old: &StringRecord, places: &[Option<usize>], new: impl Iterator<Item = String>) -> Vec<String> {
    let mut cells: Vec<String> = old.iter().map(str::to_owned).collect();
    for (place, cell) in places.iter().zip(new) {
        match place {
            Some(at) => cells[*at] = cell,
            None => cells.push(cell),
        }
    }
    cells
}

fn cause(error: &csv::Error) -> String {
    match error.kind() {
        ErrorKind::Utf8 { .. } => "it is not UTF-8".into(),
        ErrorKind::UnequalLengths { expected_len, len, .. } => {
            format!("{len} columns in place of {expected_len}")
        }
        _ => error.to_string(),
    }
}

impl Row<'_> {
    /// The text in `column`.
    pub fn text(&self, column: &str) -> Result<&str, TableError> {
        Ok(self.cells.get(self.table.place(column)?).unwrap_or_default())
    }

    /// The number in `column`, finite and from `-limit` to `limit`.
    pub fn number(&self, column: &str, limit: f64) -> Result<f64, TableError> {
        self.between(column, -limit, limit)
    }

    /// The number in `column`, from `min` to `max`.
    pub fn between(&self, column: &str, min: f64, max: f64) -> Result<f64, TableError> {
        let text = self.text(column)?;
        let number = text.parse().ok().filter(|number| (min..=max).contains(number));
        number.ok_or_else(|| self.refuse(column, text, &format!("a number from {min} to {max}")))
    }

    /// The whole number in `column`, from `min` to `max`.
    pub fn whole<N: TryFrom<i64> + PartialOrd + Display>(
        &self,
        column: &str,
        min: N,
        max: N,
    ) -> Result<N, TableError> {
        let text = self.text(column)?;
        let number = text.parse().ok().or_else(|| text.parse().ok().and_then(whole));
        let number = number.and_then(|n: i64| N::try_from(n).ok()).filter(|n| *n >= min && *n <= max);
        number.ok_or_else(|| self.refuse(column, text, &format!("a whole number from {min} to {max}")))
    }

    /// The error for a value.
    pub fn refuse(&self, column: &str, value: &str, allowed: &str) -> TableError {
        TableError::Value {
            file: self.table.file.clone(),
            line: self.line(),
            column: column.to_owned(),
            value: value.to_owned(),
            allowed: allowed.to_owned(),
        }
    }

    /// The error for values that do not go together.
    pub fn refuse_row(&self, columns: &'static str, cause: impl Display) -> TableError {
        TableError::Row {
            file: self.table.file.clone(),
            line: self.line(),
            columns,
            cause: cause.to_string(),
        }
    }

    fn line(&self) -> u64 {
        self.cells.position().map_or(0, csv::Position::line)
    }
}

/// A number without a fraction, as "12.0" is.
fn whole(number: f64) -> Option<i64> {
    (number.fract() == 0.0 && number.abs() < 1e15).then_some(number as i64)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(text: &str) -> Table {
        Table::parse(text.as_bytes(), "t.csv".into()).unwrap()
    }

    #[test]
    fn columns_are_added_or_filled_anew() {
        let twice = |row: &Row<'_>| Ok(vec![format!("{}", 2.0 * row.number("a", 10.0)?)]);
        let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
        let table = table("a, note\n1,\"x, y\"\n2.5,\n");
        assert_eq!(text(table.with(&["a"], &["b"], twice).unwrap()), "a,note,b\n1,\"x, y\",2\n2.5,,5\n");
        assert_eq!(text(table.with(&["a"], &["note"], twice).unwrap()), "a,note\n1,2\n2.5,5\n");
    }

    #[test]
    fn errors_name_file_line_column_and_range() {
        let error = |text: &str| {
            let read = Table::parse(text.as_bytes(), "t.csv".into());
            let filled = read
                .and_then(|t| t.with(&["a"], &["b"], |row| Ok(vec![row.whole("a", -5, 5_i16)?.to_string()])));
            filled.unwrap_err().to_string()
        };
        let range = "must be a whole number from -5 to 5";
        assert_eq!(error("a\n1\n6\n"), format!("t.csv, line 3: a = \"6\" {range}"));
        assert_eq!(error("a\n1.5\n"), format!("t.csv, line 2: a = \"1.5\" {range}"));
        assert_eq!(error("a\nnan\n"), format!("t.csv, line 2: a = \"nan\" {range}"));
        assert_eq!(
            error("a\n99999999999999999999\n"),
            format!("t.csv, line 2: a = \"99999999999999999999\" {range}")
        );
        assert_eq!(error("c,d\n"), "t.csv, line 1: no column a; found are c, d");
        assert_eq!(error(""), "t.csv, line 1: no column a; found are none");
        assert_eq!(error("c,d\n1,2\n"), "t.csv, line 1: no column a; found are c, d");
        assert_eq!(error("a,a\n1,2\n"), "t.csv, line 1: more than one column a; found are a, a");
        let expected =
            "t.csv, line 3: 2 columns in place of 1; every line must have as many columns as the header";
        assert_eq!(error("a\n1\n1,2\n"), expected);
    }

    #[test]
    fn a_number_must_be_one_and_in_range() {
        let read = |text: &str| {
            table(&format!("a\n{text}\n")).with(&[], &[], |row| row.number("a", 2.0).map(|_| vec![]))
        };
        assert!(read("-2").is_ok() && read("1e-3").is_ok());
        for text in ["\"\"", "x", "nan", "inf", "2.1"] {
            assert!(read(text).unwrap_err().to_string().ends_with("must be a number from -2 to 2"), "{text}");
        }
    }
}
