//! What can go wrong when a picture is made.

use std::path::PathBuf;

/// Why a picture could not be drawn or saved.
#[derive(Debug, thiserror::Error)]
pub enum DrawError {
    /// The file could not be written.
    #[error("cannot write the picture {path}: {source}")]
    Write {
        /// The file.
        path: PathBuf,
        /// The reason.
        source: std::io::Error,
    },
    /// The picture could not be encoded.
    #[error("cannot encode the picture {path}: {source}")]
    Encode {
        /// The file.
        path: PathBuf,
        /// The reason.
        source: png::EncodingError,
    },
    /// The chart could not be laid out or drawn.
    #[error("cannot draw the chart: {0}")]
    Chart(String),
}
