"""A compiled function is the same to compiled code and to Python, and has no more ways in than are used."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from numba.core.errors import TypingError

from models.compiled import compiled


@pytest.fixture(name="functions")
def new_functions(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> tuple[Any, Any]:
    """A function, and another that calls it, of which nothing is compiled yet, nor kept."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))

    @compiled
    def below(value: Any, by: Any = 3) -> Any:
        return value // by

    @compiled
    def twice(value: Any) -> Any:
        return below(value), below(value, 7)

    return below, twice


@pytest.mark.parametrize("python_is_first", [True, False])
def test_it_is_called_from_both_in_either_order(functions: tuple[Any, Any], python_is_first: bool) -> None:
    below, twice = functions
    if python_is_first:
        assert below(20) == 6
    assert twice(20) == (6, 2)
    assert [below(20), below(20, 7), below(value=20, by=7), below(21.5), below(20)] == [6, 2, 2, 7.0, 6]
    assert twice(-20.0) == (-7.0, -3.0)


def test_only_what_python_calls_has_a_way_in_from_there(functions: tuple[Any, Any]) -> None:
    below, twice = functions
    twice(20)
    assert (len(below.overloads), len(below.outer.overloads)) == (2, 0)
    assert (len(twice.overloads), len(twice.outer.overloads)) == (0, 1)
    below(20)
    assert (len(below.overloads), len(below.outer.overloads)) == (2, 1)


def test_what_is_refused_is_refused_from_python_too(functions: tuple[Any, Any]) -> None:
    below, twice = functions
    twice(20)
    for _ in range(2):
        with pytest.raises(TypingError):
            below("twenty")
        with pytest.raises(TypeError, match="argument"):
            below(1, 2, 3)
    assert below(20) == 6


def test_python_is_led_in_once_for_each_types(functions: tuple[Any, Any], monkeypatch: pytest.MonkeyPatch) -> None:
    """From the second call on nobody looks for the way in again."""
    below, _ = functions
    assert (below(20), below(20.0)) == (6, 6.0)
    monkeypatch.setattr(below, "outer", None)
    assert (below(21), below(21.5)) == (7, 7.0)
