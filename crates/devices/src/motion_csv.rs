//! Motions as CSV files: a header with `time_s,x_m,y_m,z_m` in any order, one sample a line.
//!
//! Other columns are ignored, so recordings with more in them can be read; lines that begin with `#` are
//! remarks.

use crate::MotionSample;
use crate::file::ShortLines;
use csv::{ErrorKind, Reader, ReaderBuilder, StringRecord, Trim};
use glam::DVec3;
use std::io::Read;

/// Most samples of a motion: almost three hours at 1 kHz, 720 MB.
pub const MAX_SAMPLES: usize = 10_000_000;

/// Longest line of a file, bytes.
const MAX_LINE_BYTES: usize = 65_536;

const COLUMNS: [&str; 4] = ["time_s", "x_m", "y_m", "z_m"];
/// Largest size of a number in each of them: eleven days, and more than any hand reaches.
const LARGEST: [f64; 4] = [1e6, 10.0, 10.0, 10.0];
/// Shortest time between two samples, s: closer ones would give velocities without meaning.
pub(crate) const MIN_STEP_S: f64 = 1e-6;

/// Why a motion was refused. Lines count from 1, the header's.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MotionError {
    /// The file cannot be opened.
    #[error("motion {file} cannot be opened, {cause}: check the path")]
    Open {
        /// The file.
        file: String,
        /// What the system says.
        cause: String,
    },
    /// A line is no CSV, or the file cannot be read on.
    #[error("motion {file}, line {line}: {cause}; every line must have as many columns as the header")]
    Line {
        /// The file.
        file: String,
        /// The line.
        line: u64,
        /// What is wrong with it.
        cause: String,
    },
    /// The header lacks a column.
    #[error(
        "motion {file}, line 1: no column {column}; needed are time_s, x_m, y_m and z_m, found are {found}"
    )]
    Column {
        /// The file.
        file: String,
        /// The column that is missing.
        column: &'static str,
        /// The columns that are there.
        found: String,
    },
    /// A value is no number, or outside its range.
    #[error("motion {file}, line {line}: {column} = \"{value}\" must be a number from {min} to {max}")]
    Value {
        /// The file.
        file: String,
        /// The line.
        line: u64,
        /// The column.
        column: &'static str,
        /// What is written there.
        value: String,
        /// Smallest allowed.
        min: f64,
        /// Largest allowed.
        max: f64,
    },
    /// A time is not later than the one before.
    #[error("motion {file}, line {line}: time_s = {time_s} must be at least 0.000001 s after {previous_s}")]
    Order {
        /// The file.
        file: String,
        /// The line; for samples that came from no file, their number plus one.
        line: u64,
        /// The time, s.
        time_s: f64,
        /// The one before, s.
        previous_s: f64,
    },
    /// Fewer than two samples, or more than [`MAX_SAMPLES`].
    #[error("motion {file} has {samples} samples: it needs 2 to 10000000")]
    Length {
        /// The file.
        file: String,
        /// Its samples.
        samples: usize,
    },
    /// It is to repeat, but does not end where it begins.
    #[error("motion {file} ends {gap_m} m from where it begins: let it end there, or let it hold at its end")]
    NotClosed {
        /// The file.
        file: String,
        /// Distance from end to beginning, m.
        gap_m: f64,
    },
}

/// Reads samples; `file` is for the errors.
pub(crate) fn read_samples(source: impl Read, file: &str) -> Result<Vec<MotionSample>, MotionError> {
    let source = ShortLines::new(source, MAX_LINE_BYTES);
    let mut reader = ReaderBuilder::new().trim(Trim::All).comment(Some(b'#')).from_reader(source);
    let columns = find_columns(&mut reader, file)?;
    let mut samples: Vec<MotionSample> = Vec::new();
    for record in reader.records() {
        let record = record.map_err(|error| line_error(file, &error))?;
        let line = record.position().map_or(0, |position| position.line());
        let sample = read_sample(&record, columns, file, line)?;
        if let Some(previous) = samples.last() {
            check_order(previous.time_s, sample.time_s, file, line)?;
        }
        if samples.len() == MAX_SAMPLES {
            return Err(MotionError::Length { file: file.to_owned(), samples: MAX_SAMPLES + 1 });
        }
        samples.push(sample);
    }
    Ok(samples)
}

/// Refuses a time that is not later than the one before.
pub(crate) fn check_order(previous_s: f64, time_s: f64, file: &str, line: u64) -> Result<(), MotionError> {
    // Half a step of slack: times on the allowed grid are not exact in binary.
    if time_s - previous_s >= 0.5 * MIN_STEP_S {
        return Ok(());
    }
    Err(MotionError::Order { file: file.to_owned(), line, time_s, previous_s })
}

/// Refuses a sample with a number outside its range.
pub(crate) fn check_sample(sample: &MotionSample, file: &str, line: u64) -> Result<(), MotionError> {
    let p = sample.position;
    for (n, value) in [sample.time_s, p.x, p.y, p.z].into_iter().enumerate() {
        if value.is_nan() || value.abs() > LARGEST[n] {
            return Err(value_error(n, &value.to_string(), file, line));
        }
    }
    Ok(())
}

fn find_columns(reader: &mut Reader<impl Read>, file: &str) -> Result<[usize; 4], MotionError> {
    let header = reader.headers().map_err(|error| line_error(file, &error))?;
    let mut columns = [0; 4];
    for (column, name) in columns.iter_mut().zip(COLUMNS) {
        *column = header.iter().position(|found| found == name).ok_or_else(|| MotionError::Column {
            file: file.to_owned(),
            column: name,
            found: header.iter().collect::<Vec<_>>().join(", "),
        })?;
    }
    Ok(columns)
}

fn read_sample(
    record: &StringRecord,
    columns: [usize; 4],
    file: &str,
    line: u64,
) -> Result<MotionSample, MotionError> {
    let mut numbers = [0.0; 4];
    for (n, number) in numbers.iter_mut().enumerate() {
        let text = record.get(columns[n]).unwrap_or_default();
        *number = text.parse().map_err(|_| value_error(n, text, file, line))?;
    }
    let [time_s, x, y, z] = numbers;
    let sample = MotionSample { time_s, position: DVec3::new(x, y, z) };
    check_sample(&sample, file, line)?;
    Ok(sample)
}

fn value_error(n: usize, value: &str, file: &str, line: u64) -> MotionError {
    let (column, max) = (COLUMNS[n], LARGEST[n]);
    MotionError::Value { file: file.to_owned(), line, column, value: value.to_owned(), min: -max, max }
}

fn line_error(file: &str, error: &csv::Error) -> MotionError {
    let cause = match error.kind() {
        ErrorKind::UnequalLengths { expected_len, len, .. } => {
            format!("{len} columns where the header has {expected_len}")
        }
        ErrorKind::Utf8 { .. } => "it is not UTF-8 text".to_owned(),
        _ => error.to_string(),
    };
    let line = error.position().map_or(1, |position| position.line());
    MotionError::Line { file: file.to_owned(), line, cause }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Vec<MotionSample>, MotionError> {
        read_samples(text.as_bytes(), "m.csv")
    }

    fn refusal(text: &str) -> String {
        read(text).unwrap_err().to_string()
    }

    #[test]
    fn columns_are_found_by_name_and_remarks_are_skipped() {
        let text = "# made by hand\nz_m, force_n ,time_s,x_m,y_m\n3,99,0,1,2\n\n-3,x,0.5,-1,-2\n";
        let samples = read(text).unwrap();
        let sample = |time_s, position| MotionSample { time_s, position };
        let (a, b) = (DVec3::new(1.0, 2.0, 3.0), DVec3::new(-1.0, -2.0, -3.0));
        assert_eq!(samples, [sample(0.0, a), sample(0.5, b)]);
    }

    #[test]
    fn a_missing_column_is_named() {
        assert_eq!(
            refusal("time_s,x_m,y\n0,0,0\n"),
            "motion m.csv, line 1: no column y_m; needed are time_s, x_m, y_m and z_m, found are time_s, x_m, y"
        );
        assert!(refusal("").contains("no column time_s"));
    }

    #[test]
    fn a_bad_value_is_named_with_its_line_and_column() {
        let header = "time_s,x_m,y_m,z_m\n0,0,0,0\n";
        assert_eq!(
            refusal(&format!("{header}0.1,0,oops,0\n")),
            "motion m.csv, line 3: y_m = \"oops\" must be a number from -10 to 10"
        );
        for (row, column) in
            [("1e7,0,0,0", "time_s"), ("1,NaN,0,0", "x_m"), ("1,0,0,10.1", "z_m"), ("1,0,,0", "y_m")]
        {
            let text = refusal(&format!("{header}{row}\n"));
            assert!(text.contains(column) && text.contains("line 3"), "{text}");
        }
    }

    #[test]
    fn times_must_grow() {
        let header = "time_s,x_m,y_m,z_m\n0,0,0,0\n0.5,0,0,0\n";
        assert_eq!(
            refusal(&format!("{header}0.5,0,0,0\n")),
            "motion m.csv, line 4: time_s = 0.5 must be at least 0.000001 s after 0.5"
        );
        assert!(read(&format!("{header}0.4,0,0,0\n")).is_err());
        assert!(read(&format!("{header}0.500001,0,0,0\n")).is_ok());
    }

    #[test]
    fn a_ragged_line_is_named() {
        let text = refusal("time_s,x_m,y_m,z_m\n0,0,0,0\n1,0,0\n");
        assert!(text.starts_with("motion m.csv, line 3: 3 columns where the header has 4"), "{text}");
        let bad = read_samples(&b"time_s,x_m,y_m,z_m\n0,0,0,\xff\n"[..], "m.csv").unwrap_err();
        assert!(bad.to_string().contains("not UTF-8"), "{bad}");
    }
}
