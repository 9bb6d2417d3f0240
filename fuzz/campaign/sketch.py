"""HyperLogLog: how many distinct states were seen, from 4096 registers of one byte, to about 1.6 %.

A state's hash of 64 bits chooses a register by its upper 12 bits; the register keeps the most leading zeros
of the rest, plus one.  Registers of many batches merge by their maxima, in any order, and any number of times.
"""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np

REGISTERS = 4096
REST_BITS = 64 - 12
"""Of a hash, beside those that choose a register."""
SHARE = 0.7213 / (1 + 1.079 / REGISTERS)
"""Flajolet's correction for so many registers."""


def registers(hashes: Iterable[int]) -> bytes:
    """Make the sketch of some states from their hashes, of which the lower 64 bits count."""
    found = bytearray(REGISTERS)
    for each in hashes:
        register, rest = divmod(each & (1 << 64) - 1, 1 << REST_BITS)
        found[register] = max(found[register], REST_BITS - rest.bit_length() + 1)
    return bytes(found)


def merged(one: bytes, other: bytes) -> bytes:
    """Merge the registers of two sketches; an empty one adds nothing."""
    assert all(len(each) in (0, REGISTERS) for each in (one, other)), (len(one), len(other))
    if not one or not other:
        return one or other
    return np.maximum(np.frombuffer(one, np.uint8), np.frombuffer(other, np.uint8)).tobytes()


def estimate(registers: bytes) -> int:
    """Tell how many distinct states a sketch has seen; 0 for an empty one."""
    if not registers:
        return 0
    assert len(registers) == REGISTERS, len(registers)
    ranks = np.frombuffer(registers, np.uint8).astype(np.float64)
    found = SHARE * REGISTERS**2 / float(np.exp2(-ranks).sum())
    unused = int((ranks == 0).sum())
    if found <= 2.5 * REGISTERS and unused:
        found = REGISTERS * math.log(REGISTERS / unused)
    return round(found)
