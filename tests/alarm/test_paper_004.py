"""Paper 004 reproduced, small: tables, pictures, a record; distances measured from a trace made by hand."""

from __future__ import annotations

import json

import numpy as np
import pytest

from kernel.alarm.sections import Reason
from kernel.alarm.tone import Tone
from models.compiled import packed
from models.reproduce import PAPERS, paper_004
from models.reproduce.pictures import png
from models.reproduce.tables import table_as_text

ALARM, FAULT, CAUTION, NORMAL = (packed(each) for each in (Tone.ALARM, Tone.FAULT, Tone.CAUTION, Tone.NORMAL))


@pytest.mark.slow
def test_the_paper_is_reproduced() -> None:
    told: list[tuple[int, int, str]] = []
    found = PAPERS["004"].reproduce(3, 2, lambda done, total, what: told.append((done, total, what)))
    record = json.loads(json.dumps(found.record()))
    rows = {row["what"]: row for row in record["rows"]}
    assert rows["caution begins at"]["agrees"] is True
    assert rows["alarm begins at"]["agrees"] is True
    assert rows["alarm ends past"]["agrees"] is True
    assert rows["fault tone, all three treatments"]["agrees"] is True
    assert rows[paper_004.MILDER]["agrees"] is True
    assert all(row["paper"] and row["ours"] for row in record["rows"])
    assert len(found.sensitivities) >= 5
    assert found.parameters["calibrated"] == "nothing"
    assert "Paper 004" in table_as_text(found)
    assert all(png(picture).startswith(b"\x89PNG") for picture in found.pictures)
    assert [done for done, _total, _what in told] == sorted(done for done, _total, _what in told)


def test_a_passing_is_measured_from_fix_to_fix_and_past_by_the_rear() -> None:
    ahead_m = np.arange(-4_000.0, 3_000.0, 10.0)
    tones = np.full(ahead_m.size, NORMAL)
    tones[(ahead_m >= -3_050) & (ahead_m < -1_520)] = CAUTION
    tones[(ahead_m >= -1_520) & (ahead_m < 200)] = ALARM
    tones[(ahead_m >= 1_000) & (ahead_m < 1_100)] = ALARM
    found = paper_004.passing(tones, ahead_m, 40.0)
    assert found == paper_004.Passing(True, 3_050.0, 1_520.0, 160.0, 10)
    assert paper_004.passing(tones, -ahead_m, 40.0) == paper_004.Passing(False, 3_050.0, 1_520.0, 160.0, 10)
    silent = paper_004.passing(np.full(ahead_m.size, FAULT), ahead_m, 40.0)
    assert np.isnan(silent.caution_m)
    assert np.isnan(silent.end_m)


def test_a_tone_that_comes_late_does_not_agree() -> None:
    assert paper_004.begins("alarm", 1_500.0, [1_500.0, 1_600.0]).agrees is True
    assert paper_004.begins("alarm", 1_500.0, [1_499.0, 1_600.0]).agrees is False
    assert paper_004.begins("alarm", 1_500.0, [1_900.0]).agrees is False
    assert paper_004.begins("alarm", 1_500.0, []).agrees is False


def test_each_treatment_is_left_out_by_itself() -> None:
    found = paper_004.registers()
    assert len(found["all three"].sections) == 4
    for what, reason in paper_004.TREATMENTS.items():
        rest = {each.reason for _name, each in found[f"without that for {what}"].sections.items()}
        assert rest == set(Reason) - {reason}
    assert not found["none"].sections
