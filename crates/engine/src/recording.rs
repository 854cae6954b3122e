//! What a run leaves: one row a tick.

use crate::{SceneError, ServoReport};
use std::path::Path;

/// One tick of a recording.
pub type Row = ServoReport;

/// A run's ticks.
#[derive(Clone, Debug, Default)]
pub struct Recording {
    /// In order of time.
    pub rows: Vec<Row>,
}

impl Recording {
    /// Columns of [`write_csv`](Self::write_csv): time; tool position and velocity; raw, filtered and sent force.
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

    /// Writes the rows as CSV; every number reads back exactly.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn write_csv(&self, path: &Path) -> Result<(), SceneError> {
        let failed = |cause: csv::Error| SceneError::Io { path: path.into(), cause: cause.into() };
        let mut writer = csv::Writer::from_path(path).map_err(failed)?;
        writer.write_record(Self::COLUMNS).map_err(failed)?;
        for row in &self.rows {
            let vectors =
                [row.tool.position, row.tool.velocity, row.raw.force, row.filtered.force, row.sent.force];
            let numbers = std::iter::once(row.time_s).chain(vectors.iter().flat_map(|v| v.to_array()));
            writer.write_record(numbers.map(|n| n.to_string())).map_err(failed)?;
        }
        writer.flush().map_err(|cause| SceneError::Io { path: path.into(), cause })
    }
}
