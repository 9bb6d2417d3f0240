"""What the code of a tag's kind says of the track from it on (T1, T12).

The paper (000, 3.2) names gradient, curve and turnout; the codes are ours.  What is not assigned is the worst case.
"""

from __future__ import annotations

PLAIN = 1
GRADIENT = 2
CURVE = 3
GRADIENT_AND_CURVE = 4
TURNOUT = 5
TURNOUT_ON_GRADIENT = 6
SYSTEM_BOUNDARY = 7
CROSSING_WARNING_STARTS = 8
CROSSING_WARNING_ENDS = 9
UNKNOWN = 0
"""Codes 0 and 10 to 15 are unassigned."""


def is_assigned(kind: int) -> bool:
    """Tell whether a code has a meaning (T1)."""
    return PLAIN <= kind <= CROSSING_WARNING_ENDS


def is_curve(kind: int) -> bool:
    """Tell whether the train may be in the line's sharpest curve from here on (T12)."""
    return not is_assigned(kind) or kind in (CURVE, GRADIENT_AND_CURVE)


def is_turnout(kind: int) -> bool:
    """Tell whether it may be on the line's sharpest turnout (T12, T10)."""
    return not is_assigned(kind) or kind in (TURNOUT, TURNOUT_ON_GRADIENT)
