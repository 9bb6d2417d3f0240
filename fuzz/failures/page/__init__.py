"""The page of a replayed trace: one HTML file with a time–distance diagram, every step, and the loops' states."""
