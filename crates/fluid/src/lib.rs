//! The fluid of hapflow: SPH solvers, boundaries, sources and backends.
