"""The page of a simulation: track, time-distance diagram and block occupation, to be stepped through by keys."""
