"""A decision of the importer made otherwise is noticed, from the rails or by a plain walk, or it is listed why not."""

from __future__ import annotations

import tomllib
from dataclasses import replace
from functools import cache
from itertools import islice
from pathlib import Path

import pytest

from models.layouts.railml import topology
from tests.independent.layouts.dangerous import DANGERS
from tests.independent.layouts.dangerous_routes import ROUTES_THAT_HOLD
from tests.independent.layouts.mutants import FOLLOWS, File, corpus, mutants, reads, who_notices
from tests.independent.test_verdicts import needs_folder

LISTED = tomllib.loads((Path(__file__).parent / "mutants_left.toml").read_text(encoding="utf-8"))
"""Module -> mutants that nobody notices, each with the reason."""
SAMPLE_FILES, SAMPLE_MUTANTS = 12, 12


@cache
def known() -> tuple[File, ...]:
    return tuple(file for file in corpus() if file.is_of_use)


def left(module: str) -> set[str]:
    concerned = [file for file in known() if reads(module, file)]
    return {mutant.name for mutant in mutants(module) if not who_notices(mutant, concerned)}


@needs_folder
@pytest.mark.slow
@pytest.mark.parametrize("module", sorted(LISTED))
def test_what_nobody_notices_is_listed(module: str) -> None:
    assert left(module) == set(LISTED[module])
    assert all(reason.strip() for reason in LISTED[module].values())


def differing(files: list[File]) -> list[tuple[str, str, list[str]]]:
    """What follows from a file otherwise than from the plain walk, though the importer is as it is."""
    compared = [file for file in files if file.loads and not file.unlike]
    found = [(file.name, module, file.follows(ask)) for file in compared for module, ask in FOLLOWS.items()]
    assert compared
    return [each for each in found if each[2]]


def test_the_same_follows_from_routes_as_from_the_plain_walk() -> None:
    assert differing([*(File(*each) for each in ROUTES_THAT_HOLD.items()), *islice(corpus(), SAMPLE_FILES)]) == []


@needs_folder
@pytest.mark.slow
def test_the_same_follows_from_every_file_as_from_the_plain_walk() -> None:
    assert differing(list(known())) == []


def test_what_changes_nothing_is_noticed_by_nobody_whatever_was_tried_before() -> None:
    turned = next(each for each in mutants("railml.topology") if each.name == "railml.topology._micro: not (unlisted)")
    nothing = replace(turned, code=topology._micro.__code__)
    closed = File("closed.railml", DANGERS["closed.railml"].text)
    assert closed.is_of_use
    assert [who_notices(each, [closed]) for each in (turned, nothing)] == ["walk", None]


def test_of_the_first_mutants_of_the_track_a_few_files_notice_most() -> None:
    files = [file for file, _ in zip(corpus(), range(SAMPLE_FILES), strict=False) if file.loads]
    tried = [mutant for mutant, _ in zip(mutants("track"), range(SAMPLE_MUTANTS), strict=False)]
    noticed = [mutant.name for mutant in tried if who_notices(mutant, files)]
    assert len(noticed) >= SAMPLE_MUTANTS // 2
