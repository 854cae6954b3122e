//! Wait-free hand-overs, clocks and real-time threads of hapflow.
