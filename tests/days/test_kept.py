"""Days kept as they finish: nothing is lost, nothing simulated twice, and other days are refused."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from heisoku import run
from models.days import campaign
from models.days.kept import KeptDays
from models.days.system import Numbers, System
from models.layouts import BadInput

asked: list[int] = []


def one_day(seed: int, number: int) -> Numbers:
    asked.append(number)
    return np.array([seed, number], np.int64)


SYSTEM = System("crossing", {"late": "warned late"}, {}, {"silent": "a link was silent"}, {}, {}, {}, 16.0, one_day)


@pytest.fixture(autouse=True)
def _of_the_test(monkeypatch: pytest.MonkeyPatch) -> None:
    asked.clear()
    monkeypatch.setattr(campaign, "system_of", lambda _name: SYSTEM)


def lived(path: Path, days: int, seed: int = 3) -> Numbers:
    return campaign.live_all("crossing", seed, days, 1, kept=KeptDays(path, SYSTEM, seed))


def test_what_is_kept_is_not_simulated_again_and_nothing_is_lost(tmp_path: Path) -> None:
    kept = tmp_path / "kept.days"
    whole = campaign.live_all("crossing", 3, 130, 1)
    lived(kept, 50)
    asked.clear()
    assert (lived(kept, 130) == whole).all()
    assert asked == list(range(50, 130))
    asked.clear()
    assert (lived(kept, 130) == whole).all()
    assert asked == []


@pytest.mark.parametrize("cut", [1, 9, 40])
def test_a_line_that_was_being_written_is_simulated_again(tmp_path: Path, cut: int) -> None:
    kept = tmp_path / "kept.days"
    whole = lived(kept, 75)
    kept.write_bytes(kept.read_bytes()[:-cut])
    asked.clear()
    assert (lived(kept, 75) == whole).all()
    assert asked == list(range(50, 75))
    assert KeptDays(kept, SYSTEM, 3).rows(range(75)) is not None


def test_days_of_another_seed_or_by_other_code_are_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    kept = tmp_path / "kept.days"
    lived(kept, 25)
    with pytest.raises(BadInput, match="seed 3, not 4"):
        lived(kept, 25, seed=4)
    monkeypatch.setattr("models.days.kept.code", lambda: "another")
    with pytest.raises(BadInput, match="by other code"):
        lived(kept, 25)


def test_a_day_that_was_altered_is_refused_by_its_line(tmp_path: Path) -> None:
    kept = tmp_path / "kept.days"
    lived(kept, 75)
    lines = kept.read_text("utf-8").splitlines(keepends=True)
    for altered in (lines[2].replace("30", "31", 1), lines[2].replace('"first": 25', '"first": 100')):
        kept.write_text("".join((*lines[:2], altered, *lines[3:])), "utf-8")
        with pytest.raises(BadInput, match="line 3: is not as it was kept"):
            KeptDays(kept, SYSTEM, 3)


def test_it_is_said_how_many_days_were_kept(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.undo()
    words = ["days", "tram", "--days", "1", "--jobs", "1", "--seed", "3", "--keep", str(tmp_path / "kept.days")]
    for told in (False, True):
        assert run(words) == 0
        assert ("1 of them were not simulated now" in capsys.readouterr().out) == told


@pytest.mark.parametrize("content", [b"", b"no days\n", b"[1]\n", b"\xff\xfe\n", b"half a line"])
def test_a_file_that_holds_no_days_is_refused_in_one_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], content: bytes
) -> None:
    kept = tmp_path / "kept.days"
    kept.write_bytes(content)
    assert run(["days", "tram", "--days", "1", "--keep", str(kept)]) == 2
    told = capsys.readouterr()
    assert told.err.count("\n") == 1
    assert str(kept) in told.err
    assert kept.read_bytes() == content
