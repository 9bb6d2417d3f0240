"""The on-board unit's machines that reckon: position, length, integrity, brake, reader; integers only.

All of them work in cycles of :data:`kernel.onboard.arithmetic.CYCLE_MS`.  States and readings are frozen
dataclasses of ints, bools, enumerations, fixed tuples and one another; nothing optional, no sets, no
maps (but in ``authority_end``, which speaks of blocks).  So the same source is run, proved, and compiled.
"""
