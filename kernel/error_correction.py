"""Error-correcting code of the radio's telegrams: extended Hamming (8, 4), laid so that bursts are mended (T11).

The paper asks for such a code and names none (000, 3.5.3); the choice is ours.  It doubles the length,
as the tram radio does (paper 002, 2.3.4: two bytes after every two).

**Layout.** The data of ``n`` bytes, ``8n`` bits, are cut into four rows of ``2n`` bits, and four rows of
parity follow, as many bytes again.  A *column*, the bits in one place of all eight rows, is one code
word; its bits lie ``2n`` apart in the telegram.

**Promise.** Corrected: any errors of which no column has more than one, so any single bit, and any burst
of up to ``2n`` bits.  Found out: any errors of which no column has more than two, so any two bits, and any
burst of up to ``4n`` bits; nothing is mended then, the telegram is given up.  Beyond that a column may be
taken for another one; the CRC and the code of authentication decide (``kernel.telegram``).
"""

from __future__ import annotations

from enum import Enum
from typing import NamedTuple

ROWS_OF_DATA = 4


class Damaged(Enum):
    """Why a telegram cannot be restored (T11)."""

    ODD_LENGTH = "not as many bytes of parity as of data"
    TWO_ERRORS = "two errors in one column"


class Rows(NamedTuple):
    """The four rows of data, at the places 3, 5, 6 and 7 of a Hamming word (T11)."""

    three: int
    five: int
    six: int
    seven: int


class Parity(NamedTuple):
    """The four rows of parity: over the odd places, over 2, 3, 6, 7, over 4 to 7, and over all (T11)."""

    one: int
    two: int
    four: int
    whole: int


def rows_of(number: int, row_bits: int) -> Rows:
    """Cut four rows of bits into themselves, the first one in front (T11)."""
    mask = (1 << row_bits) - 1
    return Rows(number >> 3 * row_bits, number >> 2 * row_bits & mask, number >> row_bits & mask, number & mask)


def joined(first: int, second: int, third: int, fourth: int, row_bits: int) -> int:
    """Put four rows behind one another (T11)."""
    return ((first << row_bits | second) << row_bits | third) << row_bits | fourth


def parity_of(data: Rows) -> Parity:
    """Give the rows of parity that make every column a word of the code; all columns at once (T11)."""
    one = data.three ^ data.five ^ data.seven
    two = data.three ^ data.six ^ data.seven
    four = data.five ^ data.six ^ data.seven
    return Parity(one, two, four, one ^ two ^ four ^ data.three ^ data.five ^ data.six ^ data.seven)


def mended(data: Rows, odd: int, one: int, two: int, four: int) -> Rows:
    """Turn round the bit of data in each column whose checks point to one (T11).

    ``odd``: columns with an odd number of ones; ``one``, ``two``, ``four``: columns in which that check
    fails, which name the wrong place in binary.
    """
    return Rows(
        data.three ^ (odd & one & two & ~four),
        data.five ^ (odd & one & ~two & four),
        data.six ^ (odd & ~one & two & four),
        data.seven ^ (odd & one & two & four),
    )


def protect(data: bytes) -> bytes:
    """Give the data and as many bytes of parity behind them (T11)."""
    row_bits = 2 * len(data)
    parity = parity_of(rows_of(int.from_bytes(data, "big"), row_bits))
    return data + joined(*parity, row_bits).to_bytes(len(data), "big")


def restore(coded: bytes) -> bytes | Damaged:
    """Give the data back, mended where one bit of a column is wrong, or say why not; never raises (T11)."""
    if len(coded) % 2 != 0:
        return Damaged.ODD_LENGTH
    size = len(coded) // 2
    row_bits = 2 * size
    data = rows_of(int.from_bytes(coded[:size], "big"), row_bits)
    told = Parity(*rows_of(int.from_bytes(coded[size:], "big"), row_bits))
    due = parity_of(data)
    one, two, four = told.one ^ due.one, told.two ^ due.two, told.four ^ due.four
    # Over the whole column as it came: the parity of its data and of what it tells.
    odd = told.whole ^ told.one ^ told.two ^ told.four ^ data.three ^ data.five ^ data.six ^ data.seven
    if (one | two | four) & ~odd != 0:
        return Damaged.TWO_ERRORS
    return joined(*mended(data, odd, one, two, four), row_bits).to_bytes(size, "big")
