//! A recording while a session runs: a thread of its own takes the ticks from the servos' tapes and writes them.

use crate::{SceneError, ServoReport, TickWriter};
use hapflow_realtime::{RingConsumer, set_normal_priority};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;
use std::time::Duration;

/// How often the tapes are emptied: they hold seconds.
const PERIOD: Duration = Duration::from_millis(20);

/// What a recording came to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Recorded {
    /// Ticks that were written, of all tools.
    pub ticks: u64,
    /// Ticks that are missing: the servo was faster than the file.
    pub lost: u64,
}

/// The ticks of one tool, in order.
pub(crate) type Tape = RingConsumer<ServoReport>;

/// A recording under way.
pub(crate) struct Recorder {
    stop: Arc<AtomicBool>,
    thread: JoinHandle<(Vec<Track>, Result<Recorded, SceneError>)>,
}

impl Recorder {
    /// Writes what comes on the `tapes` from now on to `files`, as many.
    pub fn start(tapes: Vec<Tape>, files: Vec<TickWriter>) -> Result<Self, SceneError> {
        let stop = Arc::new(AtomicBool::new(false));
        let theirs = Arc::clone(&stop);
        let mut tracks: Vec<_> =
            tapes.into_iter().zip(files).map(|(tape, file)| Track { tape, file }).collect();
        tracks.iter_mut().for_each(Track::skip);
        let thread = std::thread::Builder::new()
            .name("hapflow-recorder".into())
            .spawn(move || {
                let result = record(&mut tracks, &theirs);
                (tracks, result)
            })
            .map_err(|cause| SceneError::Thread { name: "recorder", cause })?;
        Ok(Self { stop, thread })
    }

    /// Writes what is still on the tapes and ends; gives the tapes back, unless it has panicked.
    pub fn stop(self) -> (Vec<Tape>, Result<Recorded, SceneError>) {
        self.stop.store(true, Ordering::Release);
        self.thread.thread().unpark();
        match self.thread.join() {
            Ok((tracks, result)) => (tracks.into_iter().map(|t| t.tape).collect(), result),
            Err(_) => (Vec::new(), Err(SceneError::Recording("the recorder has ended by a defect"))),
        }
    }
}

/// One tool's tape, and its file.
struct Track {
    tape: Tape,
    file: TickWriter,
}

impl Track {
    /// Leaves out what was there before the recording.
    fn skip(&mut self) {
        while self.tape.pop().is_some() {}
        self.tape.lost();
    }

    /// Writes what is on the tape.
    fn drain(&mut self, so_far: &mut Recorded) -> Result<(), SceneError> {
        while let Some(report) = self.tape.pop() {
            self.file.write(&report)?;
            so_far.ticks += 1;
        }
        so_far.lost += self.tape.lost();
        self.file.flush()
    }
}

/// Until it is to stop, or the files cannot be written: the tapes then run over, and the servos go on.
fn record(tracks: &mut [Track], stop: &AtomicBool) -> Result<Recorded, SceneError> {
    // A host's real-time thread may have begun it: the files must not take its priority.
    let _ = set_normal_priority();
    let mut so_far = Recorded::default();
    loop {
        let last = stop.load(Ordering::Acquire);
        tracks.iter_mut().try_for_each(|track| track.drain(&mut so_far))?;
        if last {
            return Ok(so_far);
        }
        std::thread::park_timeout(PERIOD);
    }
}

/// Makes a file for each of `tools` tools: `path` for the first, and that with its number before the extension for any
/// other, as `run.csv`, `run.1.csv`.
pub(crate) fn make_files(path: &Path, tools: usize) -> Result<Vec<TickWriter>, SceneError> {
    (0..tools).map(|tool| TickWriter::create(&file_of(path, tool))).collect()
}

fn file_of(path: &Path, tool: usize) -> PathBuf {
    if tool == 0 {
        return path.into();
    }
    let extension = path.extension().map(|e| format!(".{}", e.to_string_lossy())).unwrap_or_default();
    path.with_extension(format!("{tool}{extension}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_tool_has_a_file() {
        assert_eq!(file_of(Path::new("a/run.csv"), 0), Path::new("a/run.csv"));
        assert_eq!(file_of(Path::new("a/run.csv"), 2), Path::new("a/run.2.csv"));
        assert_eq!(file_of(Path::new("a.b/run"), 1), Path::new("a.b/run.1"));
    }
}
