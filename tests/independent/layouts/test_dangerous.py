"""Of every file that is dangerous on the track, the verdict says so: by a violation, a remark or a refusal."""

from __future__ import annotations

import re
import tomllib

import pytest

from models.layouts import BadInput, check, load_text
from tests.independent.compare import disagreements
from tests.independent.layouts.dangerous import DANGERS
from tests.independent.layouts.dangerous_routes import DANGEROUS_ROUTES, ROUTES_THAT_HOLD
from tests.independent.layouts.dangerous_tracks import DANGEROUS_TRACKS, TRACKS_THAT_HOLD
from tests.independent.layouts.mutants import WITHOUT_DANGER, says_a_danger
from tests.independent.raw_native import enumerate_data

REFUSED = {name for name, danger in DANGERS.items() if not danger.elements} - {"no train.toml"}
"""Files that are no layout; of a train that is none there is no element to name."""


@pytest.mark.parametrize("name", DANGERS)
def test_the_danger_is_said_of_the_elements(name: str) -> None:
    danger = DANGERS[name]
    if name in REFUSED:
        with pytest.raises(BadInput, match=re.escape(danger.said)):
            load_text(name, danger.text)
        return
    assert danger.is_said(load_text(name, danger.text)), danger.danger


@pytest.mark.parametrize("name", [name for name in DANGERS if "not read" in DANGERS[name].said])
def test_a_strict_verdict_does_not_rest_on_what_is_not_read(name: str) -> None:
    result = check(load_text(name, DANGERS[name].text), strict=True)
    refused = {str(element) for each in result.violations for element in each.elements if "not read" in each.text}
    assert refused >= DANGERS[name].elements


WITHOUT = [each for group in WITHOUT_DANGER for each in group.items()]


@pytest.mark.parametrize(("name", "text"), WITHOUT)
def test_without_its_danger_nothing_of_the_kind_is_said(name: str, text: str) -> None:
    result = check(load_text(name, text))
    assert result.verdict == "holds"
    assert not says_a_danger(result)


ROUND = "0 mm to the next tag, and not 500000"
"""Where a way goes round as well as on, the importer writes no distance; the walk goes round no ring."""
NUMBERED = "block numbers fit their tags"
"""The walk compares numbers as they are, and has no rule of how many there may be."""
TRACK_FILES = [
    *((name, DANGERS[name].text) for name in DANGEROUS_TRACKS | DANGEROUS_ROUTES if name not in REFUSED),
    *(TRACKS_THAT_HOLD | ROUTES_THAT_HOLD).items(),
]


@pytest.mark.parametrize(("name", "text"), TRACK_FILES)
def test_a_plain_walk_finds_the_same_of_tracks(name: str, text: str) -> None:
    imported = load_text(name, text)
    found = disagreements(imported, check(imported), enumerate_data(tomllib.loads(text)))
    unlike = [each for each in found if not (name == "ring in a block.toml" and each.endswith(ROUND))]
    assert [each for each in unlike if NUMBERED not in each] == []
