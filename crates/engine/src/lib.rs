//! The session of hapflow: scenes, servo loop, fluid loop, reports.
