//! A 3Dconnexion cap that moves the tool.

use super::{Gone, MotionReport, Reports, system};
use crate::{DeviceError, HapticDevice, Pacing};
use glam::{DQuat, DVec3};
use hapflow_haptics::{GatedWrench, ToolState};

const NAME: &str = "spacemouse";
/// Longest report that is read, bytes.
const REPORT_BYTES: usize = 64;
/// Most reports that one reading takes: a device sends some hundred a second.
const REPORTS_AT_ONCE: u32 = 16;
/// A cap that says nothing for so long counts as let go, s: while it is deflected it never is silent.
const SILENT_S: f64 = 0.2;
/// Longest time that counts between two readings, s.
const MAX_STEP_S: f64 = 0.05;

/// A SpaceMouse or its like: a cap whose deflection is a velocity. It gives no force.
pub struct SpaceMouse {
    reports: Box<dyn Reports>,
    cap: MotionReport,
    start: DVec3,
    state: ToolState,
    /// When it was read last, and when it last said something, s.
    times: Option<(f64, f64)>,
    closed: bool,
}

impl std::fmt::Debug for SpaceMouse {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("SpaceMouse").field("state", &self.state).finish_non_exhaustive()
    }
}

impl SpaceMouse {
    /// Speed at full deflection, m/s.
    pub const SPEED_M_PER_S: f64 = 0.2;
    /// Angular velocity at full deflection, rad/s.
    pub const TURN_RAD_PER_S: f64 = 1.5;
    /// How far it moves from its start along each axis, m.
    pub const REACH_M: f64 = 0.1;

    /// The first one that is plugged in; it begins at `start`, m. Thread: main.
    ///
    /// # Errors
    /// [`DeviceError`] if there is none, or it may not be opened.
    pub fn open(start: DVec3) -> Result<Self, DeviceError> {
        Ok(Self::over(system::open(NAME)?, start))
    }

    /// The one that makes these reports.
    pub fn over(reports: Box<dyn Reports>, start: DVec3) -> Self {
        let (cap, state) = (MotionReport::default(), ToolState::at(start));
        Self { reports, cap, start, state, times: None, closed: false }
    }

    /// Takes the reports that have come, and says whether there were any.
    fn listen(&mut self) -> Result<bool, DeviceError> {
        let mut report = [0; REPORT_BYTES];
        for n in 0..REPORTS_AT_ONCE {
            match self.reports.next(&mut report) {
                Ok(0) => return Ok(n > 0),
                Ok(len) => self.cap.take(&report[..len.min(REPORT_BYTES)]),
                Err(Gone) => {
                    let (cause, remedy) = ("its cable is out", "plug it in, and start again");
                    return Err(DeviceError::Lost { device: NAME, cause, remedy });
                }
            }
        }
        Ok(true)
    }

    /// Moves on as the cap says.
    fn advance(&mut self, dt_s: f64) {
        let to = self.state.position + self.cap.shift * Self::SPEED_M_PER_S * dt_s;
        let reach = DVec3::splat(Self::REACH_M);
        let position = to.clamp(self.start - reach, self.start + reach);
        let angular_velocity = self.cap.turn * Self::TURN_RAD_PER_S;
        let turned = DQuat::from_scaled_axis(angular_velocity * dt_s) * self.state.orientation;
        self.state = ToolState {
            velocity: if dt_s > 0.0 { (position - self.state.position) / dt_s } else { DVec3::ZERO },
            position,
            orientation: turned.normalize(),
            angular_velocity,
            buttons: self.cap.buttons,
        };
    }
}

impl HapticDevice for SpaceMouse {
    fn name(&self) -> &str {
        NAME
    }

    fn pacing(&self) -> Pacing {
        Pacing::Timer
    }

    fn read(&mut self, time_s: f64) -> Result<ToolState, DeviceError> {
        DeviceError::if_closed(self.closed, NAME)?;
        let heard = self.listen()?;
        let (last, mut spoke) = self.times.unwrap_or((time_s, time_s));
        if heard {
            spoke = time_s;
        } else if time_s - spoke > SILENT_S {
            self.cap = MotionReport { buttons: self.cap.buttons, ..MotionReport::default() };
        }
        self.times = Some((time_s.max(last), spoke));
        self.advance((time_s - last).clamp(0.0, MAX_STEP_S));
        Ok(self.state)
    }

    fn write(&mut self, _wrench: GatedWrench, _dt_s: f64) -> Result<(), DeviceError> {
        DeviceError::if_closed(self.closed, NAME)
    }

    fn close(&mut self) {
        self.closed = true;
    }
}
