"""The worlds of the approach alarm: trains and workers on a line, and what is told of them (paper 004)."""
