"""`heisoku reproduce 002`: the paper's figures beside ours, small (G1 to G7)."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from kernel.tram.cycle import CYCLE_MS, SLOTS
from models.reproduce import PAPERS, paper_002
from models.reproduce.pictures import png
from models.reproduce.tables import Reproduction, table_as_text
from models.tram.bunching import deviation
from models.tram.gps import PLAN
from models.tram.radio import LINK, TESTS
from models.tram.radio import SLOTS as SLOT_TIMES


@cache
def small() -> Reproduction:
    """Three days each."""
    return paper_002.reproduce(3, 3, lambda done, total, what: None)


def test_a_reproduction_has_rows_pictures_and_parameters() -> None:
    found = small()
    assert PAPERS["002"].reproduce is paper_002.reproduce
    assert all(row.paper and row.ours and row.criterion for row in found.rows)
    assert len(found.sensitivities) >= 5
    assert len({picture.name for picture in found.pictures}) == len(found.pictures) == 5
    assert all(picture.name.startswith("002_") for picture in found.pictures)
    assert "calibrated" in table_as_text(found)
    assert all(found.parameters.values())


def test_every_figure_that_can_be_compared_agrees() -> None:
    rows = {row.what: row for row in small().rows}
    assert [what for what, row in rows.items() if row.agrees is False] == []
    assert sum(row.agrees is True for row in rows.values()) >= 9
    assert rows["wrong orders by the kernel, radio in trouble"].ours.startswith("0 of ")


def test_pictures_can_be_drawn() -> None:
    for picture in small().pictures:
        assert png(picture).startswith(b"\x89PNG")


def test_the_same_seed_gives_the_same_fixes_and_transfers() -> None:
    one, other = (paper_002.measured(5, PLAN) for _ in range(2))
    assert (one.corrections_m == other.corrections_m).all()
    assert (paper_002.measured(6, PLAN).corrections_m[:100] != one.corrections_m[:100]).any()


def test_what_is_corrected_is_across_the_track_alone() -> None:
    """Without errors along the track the place is exact, but for the line's bends (4.1; G7)."""
    fixes = paper_002.measured(1, replace(PLAN, slow_m=0.0, multipath_m=0.0, reflected=0.0))
    assert np.max(fixes.across_m) <= 0.002
    assert np.median(np.abs(fixes.along_m)) < 0.01
    assert np.percentile(fixes.corrections_m, 90) == pytest.approx(9.5, abs=0.01)
    assert fixes.refused == 0


def test_transfers_are_those_of_table_2() -> None:
    tests = paper_002.transferred(1, LINK)
    assert [len(each) for each in tests] == list(TESTS)
    assert sum(TESTS) == 1_735
    assert 152 * sum(TESTS) == 263_720
    assert all((each <= 7.0).all() for each in tests)


def test_a_cycle_has_time_for_four_trams_and_the_centre() -> None:
    """About 4 s and about 3 s (2.3.4; G3)."""
    trams_ms = SLOT_TIMES.request_ms + SLOTS * SLOT_TIMES.slot_ms
    assert trams_ms == 4_000
    assert CYCLE_MS - trams_ms == 3_000


def test_even_intervals_have_no_spread() -> None:
    assert deviation(np.full(60, 240.0)) == 0.0
    assert deviation(np.tile([100.0, 380.0], 30)) > 0.5
