"""A sample of the malformed files of :mod:`tests.layouts.malformed`, and whether it notices what it looks for."""

from __future__ import annotations

import mmap
import sys
import time
from pathlib import Path

import pytest

import heisoku
from models.exit_codes import BAD_INPUT, HOLDS, UNDECIDED
from tests.layouts import malformed
from tests.layouts.malformed import bad_file, good_files, outcomes
from tests.layouts.mutations import OF_BYTES, OF_TEXT

GOODS = good_files(of_others=False)
FILES = 120


def test_malformed_files_are_refused_or_checked() -> None:
    found = list(outcomes(GOODS, 7, range(FILES), jobs=2))
    assert [(each.number, each.mutation, each.wrong) for each in found if each.wrong] == []
    assert sorted(each.number for each in found) == list(range(FILES))
    assert {each.code for each in found} >= {HOLDS, BAD_INPUT}


def test_a_seed_gives_the_same_files_and_another_one_others() -> None:
    files = [bad_file(GOODS, 1, number) for number in range(15)]
    assert files == [bad_file(GOODS, 1, number) for number in range(15)]
    assert files != [bad_file(GOODS, 2, number) for number in range(15)]


def test_every_mutation_changes_some_file() -> None:
    done = {bad_file(GOODS, 3, number)[1] for number in range(250)}
    assert done == {*OF_TEXT, *OF_BYTES}


def hangs(arguments: list[str]) -> int:
    time.sleep(60)
    return HOLDS


def takes_memory(arguments: list[str]) -> int:
    return len(bytearray(2 * malformed.BYTES))


def tells_a_traceback(arguments: list[str]) -> int:
    print("Traceback (most recent call last)", file=sys.stderr)
    return HOLDS


def says_nothing(arguments: list[str]) -> int:
    return BAD_INPUT


def is_at_fault(arguments: list[str]) -> int:
    return UNDECIDED


@pytest.mark.parametrize(
    ("fault", "said"),
    [
        (hangs, "ended with a hang"),
        (takes_memory, "ended with exit 1"),
        (tells_a_traceback, "a traceback"),
        (says_nothing, "0 lines of complaint"),
        (is_at_fault, "ended with 3"),
    ],
    ids=lambda each: getattr(each, "__name__", None),
)
def test_what_is_wrong_is_noticed(fault: object, said: str, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(malformed, "SECONDS", 1)
    monkeypatch.setattr(malformed, "WAITS", 1)
    monkeypatch.setattr(heisoku, "run", fault)
    (found,) = outcomes(GOODS, 1, [5], jobs=1)
    assert found.wrong == said


def test_what_its_parent_has_mapped_is_not_held_against_a_process() -> None:
    """A test runner maps whatever its tests need; the files that are checked have nothing of that."""
    with mmap.mmap(-1, malformed.BYTES + 2**30):
        found = list(outcomes(GOODS, 7, range(8), jobs=2))
    assert [each.wrong for each in found] == [None] * 8
