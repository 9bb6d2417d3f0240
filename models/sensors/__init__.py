"""Sensors with their faults, as arrays over many runs at once: what the unit is told, beside what is true.

Floats in SI units; ``edge`` turns them into the kernel's integers.  Arrays have the shape (runs, cycles).
Every run draws from its own generator, ``SeedSequence(seed, spawn_key=(run,))``: a run is the same
whichever runs are made beside it, and can be made again alone.  Only arithmetic that is exact to the
last bit everywhere (no sine, no exponential) is applied to arrays, for the same reason.
"""
