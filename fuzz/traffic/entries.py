"""Functions of the driver that are called by address, so that none of them is compiled into all that call it.

numba compiles what a function calls into it, at every level anew; a driver of many levels would take minutes.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable
from functools import lru_cache
from typing import Any

import numba
from llvmlite import ir
from numba import cfunc, types

from fuzz.traffic.compiling import KEPT, built_in, compiled
from fuzz.traffic.places import DESK, ENTRIES, MEMORY, MOST_ENTRIES

_numba: Any = numba
carray = _numba.carray
FAR = 1 << 40
"""Arrays come as addresses, without their sizes; no index is as large."""
_ENTRIES: list[Callable[..., Any]] = []
_WORD = types.int64
_pointer: Any = types.CPointer
_WORDS = _pointer(types.int64)


@built_in
def call(typingctx: Any, address: Any, words: Any) -> Any:
    """Call the function at an address with a tuple of words; it gives one back."""
    del typingctx, address

    def lower(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        word = ir.IntType(64)
        given = [builder.extract_value(args[1], at) for at in range(len(words))]
        function = builder.inttoptr(args[0], ir.FunctionType(word, [word] * len(given)).as_pointer())
        return builder.call(function, given)

    return _WORD(_WORD, words), lower


@compiled
def both(memory_at: Any, desk_at: Any) -> Any:
    """The arrays at two addresses."""
    return carray(memory_at, (FAR,)), carray(desk_at, (FAR,))


def entry(function: Callable[..., Any]) -> Any:
    """Make a function of both arrays' addresses and up to four words an entry; gives how compiled code calls it."""
    _ENTRIES.append(function)
    assert len(_ENTRIES) <= MOST_ENTRIES
    return compiled(_caller(ENTRIES + len(_ENTRIES) - 1, len(inspect.signature(function).parameters) - 2))


@lru_cache(maxsize=1)
def callbacks() -> tuple[Any, ...]:
    """Compile every entry of the modules imported so far; the desk has their addresses from ``ENTRIES`` on."""
    made = []
    with KEPT.one_at_a_time():
        for function in _ENTRIES:
            extra = len(inspect.signature(function).parameters) - 2
            with KEPT.kept_in() as kept:
                made.append(cfunc(_WORD(_WORDS, _WORDS, *([_WORD] * extra)), cache=kept)(function))
    return tuple(made)


def _caller(slot: int, extra: int) -> Callable[..., Any]:
    """A function that calls the entry in this slot of the desk, with so many words."""

    def none(memory: Any, desk: Any) -> Any:
        return call(desk[slot], (desk[MEMORY], desk[DESK]))

    def one(memory: Any, desk: Any, first: Any) -> Any:
        return call(desk[slot], (desk[MEMORY], desk[DESK], int(first)))

    def two(memory: Any, desk: Any, first: Any, second: Any) -> Any:
        return call(desk[slot], (desk[MEMORY], desk[DESK], int(first), int(second)))

    def three(memory: Any, desk: Any, first: Any, second: Any, third: Any) -> Any:
        return call(desk[slot], (desk[MEMORY], desk[DESK], int(first), int(second), int(third)))

    def four(memory: Any, desk: Any, first: Any, second: Any, third: Any, fourth: Any) -> Any:
        return call(desk[slot], (desk[MEMORY], desk[DESK], int(first), int(second), int(third), int(fourth)))

    return (none, one, two, three, four)[extra]
