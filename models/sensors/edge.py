"""The edge between the models' floats and the kernel's integers (P1, P2, P5).

Whatever a float is, something defined comes out, and nothing is raised: no number, an infinite one and one
out of the range that the kernel takes are *not valid*, and read 0 (no number) or the nearest end of the range.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from models.sensors.draws import Singles
from models.sensors.dynamics import Bools
from models.sensors.track import Ints, Places

LEAST, MOST = -(2**63), 2**63 - 1
"""The ends of int64, which the compiled machines reckon in."""

AnyFloats = npt.NDArray[np.float32] | npt.NDArray[np.float64]


def whole(values: AnyFloats, per_unit: float, least: int = LEAST, most: int = MOST) -> tuple[Places, Bools]:
    """Round values, times ``per_unit`` (1000 makes mm of m), half to even; and tell which are valid (P1).

    ``least`` and ``most``: the range that counts as a reading, within int64.
    """
    with np.errstate(all="ignore"):
        scaled = np.rint(np.multiply(values, per_unit, dtype=np.float64))
    valid = (scaled >= least) & (scaled <= most)
    if valid.all() and least > -(2**53) and most < 2**53:
        return scaled.astype(np.int64), valid
    valid &= (scaled >= -(2.0**63)) & (scaled < 2.0**63)
    low, high = scaled < least, scaled > most
    low |= scaled < -(2.0**63)
    high |= scaled >= 2.0**63
    numbers = np.where(valid, scaled, 0.0).astype(np.int64)
    numbers[low], numbers[high] = max(least, LEAST), min(most, MOST)
    return numbers, valid


def narrow(values: Singles, per_unit: float, least: int, most: int) -> tuple[Ints, Bools]:
    """Do the same in 32 bits, in half the memory, for ranges within ±2**24, where float32 has every integer (P1)."""
    assert -(2**24) <= least <= 0 <= most <= 2**24, "a range that float32 does not count through"
    with np.errstate(all="ignore"):
        scaled = values * np.float32(per_unit)
        np.rint(scaled, out=scaled)
    valid = scaled >= least
    valid &= scaled <= most
    if not valid.all():
        np.nan_to_num(scaled, copy=False, nan=0.0)
        np.clip(scaled, least, most, out=scaled)
    return scaled.astype(np.int32), valid


def whole_one(value: float, per_unit: float, least: int = LEAST, most: int = MOST) -> tuple[int, bool]:
    """One value, as :func:`whole` does it."""
    numbers, valid = whole(np.array([value], np.float64), per_unit, least, most)
    return int(numbers[0]), bool(valid[0])
