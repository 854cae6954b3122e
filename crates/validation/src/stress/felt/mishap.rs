//! What may go wrong.

use crate::stress::dice::Dice;
use glam::DVec3;

/// When the first may happen, and the last, s.
const FIRST_S: f64 = 0.2;
pub(super) const LAST_S: f64 = 1.5;
/// How long a fluid's thread hangs, s.
pub(super) const STALL_S: f64 = 1.0;
/// How far a device jumps, m: farther than any hand goes in a tick.
const FARTHEST: [f64; 2] = [0.03, 1.0];
/// Most of them in a trial.
const MOST: usize = 6;

/// Something that goes wrong at a time.
#[derive(Clone, Debug)]
pub(super) struct Mishap {
    pub at_s: f64,
    pub what: What,
}

/// What goes wrong.
#[derive(Clone, Debug)]
pub(super) enum What {
    /// The device is elsewhere at once, m.
    Jump(DVec3),
    /// For so many ticks the device says places that are no numbers.
    Blind(usize),
    /// The servo is not ticked, s.
    Pause(f64),
    /// The fluid's thread hangs, s.
    Stall(f64),
    /// A frame comes out like this.
    Spoilt(Spoilt),
    /// Somebody asks for no force.
    Stop,
    /// The factor on the force is so many times what it was at the start.
    Gain(f64),
    /// The largest force is lowered to this share.
    Limit(f64),
}

/// What a fluid's frame may give that exploded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Spoilt {
    /// Loads that are no numbers.
    Nan,
    /// Infinite ones.
    Infinite,
    /// A blow, N.
    Blow(f64),
    /// A look at the fluid that has no place.
    Nowhere,
}

/// Those of a trial, the last first.
pub(super) fn draw(dice: &mut Dice) -> Vec<Mishap> {
    let count = dice.whole(0, MOST);
    let mut all: Vec<_> =
        (0..count).map(|_| Mishap { at_s: dice.within(FIRST_S, LAST_S), what: one(dice) }).collect();
    all.sort_by(|a, b| b.at_s.total_cmp(&a.at_s));
    all
}

fn one(dice: &mut Dice) -> What {
    match dice.whole(0, 8) {
        0 | 1 => What::Jump(dice.direction() * dice.scale(FARTHEST[0], FARTHEST[1])),
        2 => What::Blind(dice.whole(1, 5)),
        3 => What::Pause(dice.scale(1e-3, 0.3)),
        4 => What::Stall(STALL_S),
        5 => What::Stop,
        6 => What::Gain(dice.scale(0.1, 10.0)),
        7 => What::Limit(dice.unit()),
        _ => What::Spoilt(match dice.whole(0, 3) {
            0 => Spoilt::Nan,
            1 => Spoilt::Infinite,
            2 => Spoilt::Nowhere,
            _ => Spoilt::Blow(dice.scale(1.0, 1e6)),
        }),
    }
}
