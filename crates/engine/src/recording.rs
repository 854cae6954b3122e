//! What a run leaves: one row a tick, in memory or in a file.

use crate::{SceneError, ServoReport};
use std::fs::File;
use std::path::{Path, PathBuf};

/// One tick of a recording.
pub type Row = ServoReport;

/// A run's ticks.
#[derive(Clone, Debug, Default)]
pub struct Recording {
    /// In order of time.
    pub rows: Vec<Row>,
}

impl Recording {
    /// Writes the rows as CSV, in the form of a [`TickWriter`].
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn write_csv(&self, path: &Path) -> Result<(), SceneError> {
        let mut writer = TickWriter::create(path)?;
        self.rows.iter().try_for_each(|row| writer.write(row))?;
        writer.flush()
    }
}

/// Writes the ticks of one tool as CSV. Every number reads back exactly, and the replay device plays the file with
/// the setting `run.motion_origin = "scene"`. Thread: any one that may block.
#[derive(Debug)]
pub struct TickWriter {
    path: PathBuf,
    csv: csv::Writer<File>,
}

impl TickWriter {
    /// The columns: time; tool position and velocity; raw, filtered and sent force. In the scene's frame.
    pub const COLUMNS: [&str; 16] = [
        "time_s",
        "x_m",
        "y_m",
        "z_m",
        "vx_m_s",
        "vy_m_s",
        "vz_m_s",
        "raw_fx_N",
        "raw_fy_N",
        "raw_fz_N",
        "filtered_fx_N",
        "filtered_fy_N",
        "filtered_fz_N",
        "sent_fx_N",
        "sent_fy_N",
        "sent_fz_N",
    ];

    /// Makes the file anew.
    ///
    /// # Errors
    /// A file that cannot be written, with the cause.
    pub fn create(path: &Path) -> Result<Self, SceneError> {
        let failed = |cause: csv::Error| SceneError::Io { path: path.into(), cause: cause.into() };
        let mut csv = csv::Writer::from_path(path).map_err(failed)?;
        csv.write_record(Self::COLUMNS).map_err(failed)?;
        Ok(Self { path: path.into(), csv })
    }

    /// Adds a tick; it is in the file after a [`flush`](Self::flush).
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn write(&mut self, row: &Row) -> Result<(), SceneError> {
        let vectors =
            [row.tool.position, row.tool.velocity, row.raw.force, row.filtered.force, row.sent.force];
        let numbers = std::iter::once(row.time_s).chain(vectors.iter().flat_map(|v| v.to_array()));
        let written = self.csv.write_record(numbers.map(|n| n.to_string()));
        written.map_err(|cause| SceneError::Io { path: self.path.clone(), cause: cause.into() })
    }

    /// Hands everything to the system.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn flush(&mut self) -> Result<(), SceneError> {
        self.csv.flush().map_err(|cause| SceneError::Io { path: self.path.clone(), cause })
    }
}
