"""Reading words and bits of both memories, drawing, and calling the compiled kernel."""

from __future__ import annotations

from typing import Any

from numba import types
from numba.core import cgutils

from fuzz.traffic.compiling import built_in, compiled
from fuzz.traffic.places import BY, DRAWN, PLACES, PRESENT, RANDOM

GOLDEN = 0x9E3779B97F4A7C15 - (1 << 64)
SPREAD = 0xBF58476D1CE4E5B9 - (1 << 64)
MIX = 0x94D049BB133111EB - (1 << 64)
LOW_34, LOW_37, LOW_33, LOW_32 = (1 << 34) - 1, (1 << 37) - 1, (1 << 33) - 1, (1 << 32) - 1


@built_in
def lowest(typingctx: Any, word: Any) -> Any:
    """The number of the lowest bit that is set; the word is not 0."""
    del typingctx, word

    def lower(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        return builder.cttz(args[0], cgutils.true_bit)

    return types.int64(types.int64), lower


@built_in
def leading(typingctx: Any, word: Any) -> Any:
    """How many zeros a word begins with; 64 for 0."""
    del typingctx, word

    def lower(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        return builder.ctlz(args[0], cgutils.false_bit)

    return types.int64(types.int64), lower


def _wrapping(instruction: str) -> Any:
    """An instruction on two words, modulo 2**64: numba's own on signed words must not overflow."""

    def typed(typingctx: Any, one: Any, other: Any) -> Any:
        del typingctx, one, other

        def lower(context: Any, builder: Any, signature: Any, args: Any) -> Any:
            return getattr(builder, instruction)(*args)

        return types.int64(types.int64, types.int64), lower

    return built_in(typed)


times, plus, minus = (_wrapping(each) for each in ("mul", "add", "sub"))


# ---- drawing


@compiled
def mixed(word: Any) -> Any:
    """Spread a word over all its bits (splitmix64's end)."""
    word = times(word ^ ((word >> 30) & LOW_34), SPREAD)
    word = times(word ^ ((word >> 27) & LOW_37), MIX)
    return word ^ ((word >> 31) & LOW_33)


@compiled
def draw(desk: Any) -> Any:
    """The next word of the trace's own sequence (splitmix64)."""
    desk[RANDOM] = plus(desk[RANDOM], GOLDEN)
    return mixed(desk[RANDOM])


@compiled
def below(desk: Any, bound: Any) -> Any:
    """Draw a number from 0 up to, and without, ``bound`` (1 at least, less than 2**31)."""
    return (((draw(desk) >> 32) & LOW_32) * bound) >> 32


@compiled
def between(desk: Any, least: Any, most: Any) -> Any:
    """Draw a number, both bounds included."""
    return least + below(desk, most - least + 1)


@compiled
def chance(desk: Any, parts: Any) -> Any:
    """Draw whether something of so many parts of 2**32 happens."""
    return (draw(desk) & LOW_32) < parts


@compiled
def one_in(desk: Any, count: Any) -> Any:
    """Draw whether something happens that does once in so many times."""
    return below(desk, count) == 0


@compiled
def happens(desk: Any, fault: Any) -> Any:
    """Draw whether a fault of this trace happens now; it is at work then in the next step."""
    if desk[PRESENT + fault] == 0 or not chance(desk, desk[PRESENT + fault]):
        return False
    desk[DRAWN + fault] += 1
    desk[BY] = fault
    return True


# ---- words and bits


@compiled
def base(desk: Any, place: Any) -> Any:
    """Where an array begins."""
    return desk[PLACES + 4 * place]


@compiled
def row(desk: Any, place: Any, first: Any) -> Any:
    """Where a row of an array begins."""
    return desk[PLACES + 4 * place] + first * desk[PLACES + 4 * place + 1]


@compiled
def cell(desk: Any, place: Any, first: Any, second: Any) -> Any:
    """Where a cell of an array, or a row two axes down, begins."""
    return row(desk, place, first) + second * desk[PLACES + 4 * place + 2]


@compiled
def get(memory: Any, desk: Any, place: Any) -> Any:
    """The one word of an array of the state."""
    return memory[base(desk, place)]


@compiled
def get1(memory: Any, desk: Any, place: Any, first: Any) -> Any:
    """A word of a row of the state."""
    return memory[row(desk, place, first)]


@compiled
def get2(memory: Any, desk: Any, place: Any, first: Any, second: Any) -> Any:
    """A word of an array of the state with two axes."""
    return memory[cell(desk, place, first, second)]


@compiled
def get3(memory: Any, desk: Any, place: Any, first: Any, second: Any, third: Any) -> Any:
    """A word of an array of the state with three axes."""
    return memory[cell(desk, place, first, second) + third]


@compiled
def bit(array: Any, at: Any, number: Any) -> Any:
    """Whether a bit of the set that begins at a word is set."""
    return (array[at + (number >> 6)] >> (number & 63)) & 1 == 1


@compiled
def has(memory: Any, desk: Any, place: Any, number: Any) -> Any:
    """Whether a set of the state has an element."""
    return bit(memory, base(desk, place), number)


@compiled
def has1(memory: Any, desk: Any, place: Any, first: Any, number: Any) -> Any:
    """Whether a set in a row of the state has an element."""
    return bit(memory, row(desk, place, first), number)


@compiled
def of(desk: Any, place: Any, first: Any) -> Any:
    """A word of a table of the desk with one axis."""
    return desk[row(desk, place, first)]


@compiled
def of2(desk: Any, place: Any, first: Any, second: Any) -> Any:
    """A word of a table of the desk with two axes."""
    return desk[cell(desk, place, first, second)]


@compiled
def in_table(desk: Any, place: Any, first: Any, number: Any) -> Any:
    """Whether a set in a row of a table has an element."""
    return bit(desk, row(desk, place, first), number)
