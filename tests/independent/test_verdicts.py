"""What ``heisoku check`` says of samples and real layouts is what a plain walk over the raw file says.

The walk (``raw_*.py``) uses nothing of the project.  Its verdicts and violation lists are written down in
``expected/``; of the routes of files that are not ours only a digest is, and they are walked again here.
"""

from __future__ import annotations

from collections import Counter
from functools import cache

import pytest

from models.layouts import BadInput, Imported, check, load
from tests.independent.compare import (
    differing_ground,
    differing_routes,
    enumerated_spans,
    imported_spans,
    listed_remarks,
    listed_violations,
)
from tests.independent.files import (
    FOLDER,
    OTHERS,
    SAMPLES,
    WITHOUT_ROUTES,
    Enumerated,
    blocks_of,
    enumerated,
    network_of,
    path_of,
    to_write_down,
    written_down,
)
from tests.independent.raw_records import differing_records

WHY = f"the layouts of others are not at {FOLDER} (HEISOKU_LAYOUTS names another folder)"
needs_folder = pytest.mark.skipif(not FOLDER.is_dir(), reason=WHY)
every_file = pytest.mark.parametrize("name", [*SAMPLES, *(pytest.param(name, marks=needs_folder) for name in OTHERS)])


@cache
def walked(name: str) -> Enumerated:
    return enumerated(name)


@cache
def imported(name: str) -> Imported:
    return load(path_of(name))


@every_file
def test_enumeration_is_as_written_down(name: str) -> None:
    assert to_write_down(name) == written_down(name)


@every_file
def test_verdict_and_violations_are_as_written_down(name: str) -> None:
    result, expected = check(imported(name)), written_down(name)
    layout = imported(name).layout
    assert result.verdict == expected["verdict"]
    assert listed_violations(result) == Counter(
        (violation["rule"], tuple(violation["elements"])) for violation in expected["violations"]
    )
    assert {"blocks": len(layout.blocks), "routes": len(layout.routes)} == expected["counts"]


@every_file
def test_remarks_are_as_written_down(name: str) -> None:
    expected = Counter(tuple(remark["elements"]) for remark in written_down(name)["remarks"])
    assert listed_remarks(check(imported(name)), walked(name)) == expected


@every_file
def test_every_route_is_imported_as_walked(name: str) -> None:
    assert differing_routes(imported(name), walked(name)) == {}


@every_file
def test_every_block_lies_where_the_walk_finds_it(name: str) -> None:
    assert imported(name).layout.blocks == blocks_of(walked(name))
    network = network_of(walked(name))
    assert imported_spans(imported(name)) == ({} if network is None else enumerated_spans(network))


@every_file
def test_ground_is_as_walked(name: str) -> None:
    assert differing_ground(imported(name), walked(name)) == []


@every_file
def test_tags_say_what_the_walk_reckons(name: str) -> None:
    assert list(differing_records(imported(name), walked(name))) == []


@needs_folder
def test_a_layout_without_routes_is_named_as_such() -> None:
    with pytest.raises(BadInput, match="no routes") as refusal:
        load(path_of(WITHOUT_ROUTES))
    assert "\n" not in str(refusal.value)
    assert WITHOUT_ROUTES in refusal.value.file
