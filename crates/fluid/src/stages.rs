//! Where the time of a sub-step goes.

use std::time::Instant;

/// A stage of a sub-step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// New particles, bodies on their way, the dead dropped and the rest sorted.
    Sort,
    /// Who is near whom.
    Neighbours,
    /// Who is near which wall.
    Walls,
    /// All that particles do to each other: the solver's passes, viscosity, surface tension.
    Pairs,
    /// Particles and bodies move on.
    Move,
}

impl Stage {
    /// All of them, in order.
    pub const ALL: [Self; 5] = [Self::Sort, Self::Neighbours, Self::Walls, Self::Pairs, Self::Move];
}

/// Times of the stages, on the wall, s.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StageTimes([f64; Stage::ALL.len()]);

impl StageTimes {
    /// Time of `stage`, s.
    pub fn of(&self, stage: Stage) -> f64 {
        self.0[stage as usize]
    }
}

/// Takes the times, once it is asked to.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Stopwatch {
    pub times: StageTimes,
    /// When the last stage ended; none while nobody asks.
    last: Option<Instant>,
}

impl Stopwatch {
    /// Starts from nothing.
    pub fn start(&mut self) {
        *self = Self { times: StageTimes::default(), last: Some(Instant::now()) };
    }

    /// A sub-step begins.
    pub fn begin(&mut self) {
        if let Some(last) = &mut self.last {
            *last = Instant::now();
        }
    }

    /// A stage has ended.
    pub fn lap(&mut self, stage: Stage) {
        if let Some(last) = &mut self.last {
            self.times.0[stage as usize] += last.elapsed().as_secs_f64();
            *last = Instant::now();
        }
    }
}
