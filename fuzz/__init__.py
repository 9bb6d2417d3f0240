"""Campaigns: faults drawn by the million, run through the compiled kernel, with the invariants as oracles."""
