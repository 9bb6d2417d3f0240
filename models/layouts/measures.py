"""How near things may lie to each other on the track: tags, boundaries, fouling points, ends of overlaps."""

from __future__ import annotations

ANTENNA_MM = 2_000
"""From the outer end of a car to the antenna below its cab: the overhang."""
WINDOW_MM = 513
"""Along the track, how far an antenna reads (paper 000, 5)."""
ERROR_MM = 200
"""How far a tag may lie from where it was planned."""
TAG_MM = ANTENNA_MM + WINDOW_MM + ERROR_MM
"""From a boundary to the tag on either side: at least overhang, read window and error (T2)."""
SHORTEST_BLOCK_MM = 2 * TAG_MM + WINDOW_MM + 2 * ERROR_MM
"""From boundary to boundary: room for the tag of each, so far apart that no antenna reads both at once (T2)."""

CLEARANCE_MM = 20_000
"""A boundary nearer to a point than this is foul of the other leg, where a file does not say otherwise.

Two tracks that part are clear of each other where their centre lines are 3.5 m apart.  From the tips of a turnout of
radius r that is sqrt(2 · 3.5 m · r), from its geometric centre 3.5 m times n for one of 1:n.  At 20 m no turnout
of more than 57 m radius, or flatter than 1:6, is clear.  So what is nearer is wrong on a railway; what is farther need
not be right, and stays among what a verdict rests on until the file tells it.
"""
LEAST_CLEARANCE_MM = 2_475
"""No leg is told to be clear nearer than this: centre lines 3.5 m apart are that far from where two tracks cross at
right angles, and no two legs meet at more."""

STANDS_MM_S = 700
"""So fast a train may still be that tells that it stands (T12)."""
GAINS_MM_S2 = 1_500
SLOWS_MM_S2 = 600
RESPONSE_MS = 1_500
"""What an emergency brake does at the least, and how late; until then motors may pull (as in rides)."""


def slips_mm(speed_mm_s: int) -> int:
    """How far a train runs on whose brake is called for at a speed, at the worst that the brake's bounds allow."""
    fastest_mm_s = speed_mm_s + GAINS_MM_S2 * RESPONSE_MS // 1_000
    pulling_mm = (speed_mm_s + fastest_mm_s) * RESPONSE_MS // 2_000
    return pulling_mm + -(-fastest_mm_s * fastest_mm_s // (2 * SLOWS_MM_S2))


SHORTEST_OVERLAP_MM = slips_mm(STANDS_MM_S)
"""An overlap is at least what the pattern's own bounds need of it, at the speed that counts as standing: 10 m.

How much more is needed for poor adhesion is the duty of whoever lays it out (``the_overlap_is_long_enough``).
"""
SHORTEST_VEHICLE_MM = 20_000
"""No block as long as one vehicle in a whole file: the unit is wrong."""
SHORTEST_TRAIN_MM = 5_000
"""No train that a unit fits into is shorter: the unit is wrong."""
LONGEST_BLOCK_MM = 100_000_000
"""A block of more than 100 km: the unit is wrong, or a boundary is missing."""
