//! Haptic devices of hapflow: null, replay and a simulated hand.
