"""What compiled code refers to is counted without locks, by few, and freed when nobody refers to it."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numba
import numpy as np
import pytest
from numba.core.runtime import nrt

from models.compiled import compiled, kept

rtsys: Any = nrt.rtsys
type_of: Any = numba.typeof
counted: Any = vars(nrt)["_nrt"]
ROOT = Path(__file__).parents[2]


@pytest.fixture
def _what_is_allocated_is_counted() -> Iterator[None]:
    counted.memsys_enable_stats()
    yield
    counted.memsys_disable_stats()


@compiled
def handed_on(places: Any, times: int) -> int:
    """Make lists, hand them on by value, and drop them."""
    kept = places
    for _ in range(times):
        other = numba.typed.List([(1, 2), (3, 4)])
        kept, other = other, kept
    return len(kept) + len(places)


@compiled
def given_back(places: Any) -> Any:
    """Give back a list that was handed on."""
    return places


@compiled
def number_of(places: Any) -> int:
    """Give back a number."""
    return len(places)


@compiled
def new_or_old(places: Any, is_new: bool) -> Any:
    """Give a list back that is made here, or one that two calls handed back."""
    again = given_back(given_back(places))
    if not is_new:
        return again, len(again)
    return numba.typed.List([(5, len(again))]), 1


@compiled
def chosen(places: Any, is_new: bool) -> Any:
    """Give back in a record what was given, and drop what else was."""
    one, _ = new_or_old(places, is_new)
    if is_new:
        dropped, _ = new_or_old(one, True)
        return one, dropped[0][1]
    return one, 0


@compiled
def chosen_often(places: Any, times: int) -> int:
    """Have lists made and given back, each from the one before."""
    kept = places
    sums = 0
    for number in range(times):
        kept, more = chosen(kept, number % 3 == 0)
        sums += more + len(kept)
    return int(sums + kept[0][0] + len(places))


@compiled
def made() -> Any:
    """Give a list that outlives the call, and an array within a tuple."""
    return numba.typed.List([(5, 6)]), np.zeros(7)


@pytest.mark.usefixtures("_what_is_allocated_is_counted")
def test_what_nobody_refers_to_is_freed() -> None:
    handed_on(numba.typed.List([(7, 8)]), 1)
    made()
    chosen_often(numba.typed.List([(7, 8)]), 1)
    before = rtsys.get_allocation_stats()
    places = numba.typed.List([(7, 8)])
    assert handed_on(places, 1_000) == 3
    assert chosen_often(places, 999) == 999 + 333 + 5 + 1
    assert list(places) == [(7, 8)]
    listed, row = made()
    assert list(listed) == [(5, 6)]
    assert row.sum() == 0
    del places, listed, row
    after = rtsys.get_allocation_stats()
    assert after.mi_alloc - before.mi_alloc > 1_000
    assert after.mi_alloc - before.mi_alloc == after.mi_free - before.mi_free
    assert after.alloc - before.alloc == after.free - before.free


def test_what_only_looks_counts_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    """As it is compiled here and now, whatever was kept."""
    monkeypatch.setattr(kept, "kept_folder", lambda _name: None)
    places = numba.typed.List([(1, 2), (3, 4)])

    def assembly(function: Any) -> str:
        again: Any = compiled(function.py_func)
        again.compile((type_of(places),))
        (found,) = again.inspect_asm().values()
        return str(found)

    assert "NRT_incref" not in assembly(number_of)
    assert "NRT_incref" in assembly(given_back)


def test_compiled_code_counts_without_locks() -> None:
    handed_on(numba.typed.List([(7, 8)]), 1)
    assembly = rtsys.library.get_asm_str()
    counting = [part.split("\n\n")[0] for part in assembly.split("NRT_incref:")[1:] + assembly.split("NRT_decref:")[1:]]
    assert len(counting) == 2
    assert not [part for part in counting if "lock" in part.split("_cas")[0]]


def test_compiled_code_holds_the_interpreters_lock() -> None:
    """That is why nobody else counts at once."""
    sources = [path for folder in ("models", "fuzz", "tests") for path in (ROOT / folder).rglob("*.py")]
    assert len(sources) > 100
    letting_go = ("no" + "gil=", "parallel" + "=True")
    assert not [path for path in sources if any(option in path.read_text("utf-8") for option in letting_go)]
