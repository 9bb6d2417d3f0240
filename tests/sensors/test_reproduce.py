"""`heisoku reproduce`: the papers' figures beside ours, small."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

import heisoku
from kernel.onboard.feature import AWAITED, Detection, Progress, Readings
from models.reproduce import fixes, lengths, paper_000, passing, tables
from models.sensors import track as tracks
from models.sensors.curves import Registering, registered
from models.sensors.tag_reader import STAND
from models.sensors.traces import Setup, traces
from models.sensors.track import feature

SMALL = {"000": "20", "001": "3"}


@pytest.mark.parametrize("paper", ["000", "001"])
def test_a_paper_is_reproduced_with_tables_pictures_and_record(
    paper: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    record = tmp_path / "new" / "record.json"
    words = [
        "reproduce",
        paper,
        "--runs",
        SMALL[paper],
        "--seed",
        "3",
        "-o",
        str(tmp_path / "o"),
        "--json",
        str(record),
    ]
    code = heisoku.run(words)
    shown, found = capsys.readouterr(), json.loads(record.read_text("utf-8"))
    assert code == {"holds": 0, "does not hold": 1}[found["verdict"]], shown.err
    assert "calibrated" in shown.out
    assert found["seed"] == 3
    assert found["versions"]["heisoku"]
    assert all(row["paper"] and row["ours"] for row in found["rows"])
    assert len(found["sensitivities"]) >= 5
    pictures = sorted(path.stem for path in (tmp_path / "o").glob("*.png"))
    assert pictures == sorted(found["pictures"])
    assert all((tmp_path / "o" / f"{name}.png").read_bytes().startswith(b"\x89PNG") for name in pictures)
    assert "Paper" in (tmp_path / "o" / f"{paper}_tables.txt").read_text("utf-8")
    safety = {
        row["what"]: row["agrees"] for row in found["rows"] if "kernel" in row["what"] or "contains" in row["what"]
    }
    assert all(agrees is not False for agrees in safety.values())


def test_the_same_seed_gives_the_same_record(tmp_path: Path) -> None:
    records = []
    for name in ("a", "b"):
        heisoku.run(["reproduce", "000", "--runs", "10", "--json", str(tmp_path / name)])
        records.append(json.loads((tmp_path / name).read_bytes()))
        assert records[-1].pop("made_at")
    assert records[0] == records[1]


@pytest.mark.parametrize(
    "words",
    [
        ["reproduce"],
        ["reproduce", "005"],
        ["reproduce", "000", "--runs", "0"],
        ["reproduce", "000", "--runs", "many"],
        ["reproduce", "000", "--seed", "-1"],
        ["reproduce", "000", "-o", str(Path(__file__))],
        ["reproduce", "000", "--json", str(Path(__file__).parent)],
    ],
)
def test_bad_usage_is_told_in_one_line(words: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert heisoku.run(words) == 2
    error = capsys.readouterr().err
    assert len(error.splitlines()) == 1
    assert "Traceback" not in error


def test_table_2_is_the_papers_at_130_km_h_and_grows_with_speed() -> None:
    ours = lengths.budget(130)
    assert (ours.sampling_m, ours.skew_m, ours.averaging_m, ours.sensor_m) == (3.612, 3.612, 0.782, 5.0)
    assert ours.total_m == pytest.approx(13.006)
    totals = [lengths.budget(speed).total_m for speed in range(0, 200, 10)]
    assert totals == sorted(totals)


def test_two_frames_are_met_at_lower_speeds_than_one() -> None:
    reader = STAND
    speeds = [paper_000.most_speed_km_h(reader, frames) for frames in (1, 2, 3, 4)]
    assert speeds == sorted(speeds, reverse=True)
    assert speeds[0] == pytest.approx(100)
    assert paper_000.exact_share(2, 0.1) == pytest.approx(0.81)
    assert paper_000.exact_share(1, 0.0) == 0
    assert paper_000.tags_needed(reader, 300) == 0


def test_only_curves_that_can_be_told_from_straight_are_registered() -> None:
    plan = Registering()
    assert registered(plan, feature(500, 50, 400, 1 / 600)) is not None
    assert registered(plan, feature(500, 80, 400, 1 / 1_800)) is None
    assert registered(plan, feature(500, 50, 60, 1 / 600)) is None
    assert registered(plan, feature(500, 50, 400, 1 / 600, vertical=True)) is None
    left, right = (registered(plan, feature(500, 50, 400, sign / 600)) for sign in (1, -1))
    assert left is not None
    assert right is not None
    assert (left.second.least, left.second.most) == (-right.second.most, -right.second.least)


def test_one_figure_that_differs_is_a_verdict() -> None:
    rows = [tables.Row("a", "1", "2", "3", agrees, "same") for agrees in (True, None, False)]
    found = tables.Reproduction("000", "t", 1, tuple(rows), (), (), {}, {})
    assert found.verdict == "does not hold"
    assert "DIFFERS" in tables.table_as_text(found)
    assert tables.Reproduction("000", "t", 1, tuple(rows[:2]), (), (), {}, {}).verdict == "holds"


def _nothing(done: int, total: int, name: str) -> None:
    """Tell nobody."""


def test_every_feature_that_is_set_counts_once_in_every_run() -> None:
    plan, (line,) = Registering(), fixes.journeys(3, 1, 2, _nothing)
    for everywhere in (False, True):
        outcomes = fixes.ridden(plan, line, everywhere=everywhere).outcomes
        curves = line.counted.track.features if everywhere else fixes.surveyed(plan, line.survey)
        begun = [curve for curve in curves if any(each.awaited.curve == curve for each in outcomes)]
        assert len(begun) >= 2
        assert [(each.awaited.curve, each.awaited.run) for each in outcomes] == [
            (curve, run) for curve in begun for run in (0, 1)
        ]
        left_out = [curve for curve in curves if curve not in begun]
        assert all(curve.begin_m < 300 or registered(plan, curve) is None for curve in left_out if not curve.vertical)


def test_the_place_on_board_is_put_right_by_a_fix_and_by_nothing_else() -> None:
    runs = passing.runs_on(tracks.line(3_000, passing.LINE_M), 3, range(3))
    yaw = passing.measured_yaw(runs)
    with_fixes = passing.ride(runs, tuple(passing.awaited(Registering(), runs, runs.track.features)), *yaw)
    without = passing.ride(runs, (), *yaw)
    fixed = 0
    for run in range(3):
        found = sorted(each.found for each in with_fixes.outcomes if each.awaited.run == run and each.fixed)
        ours, plain = (np.array(each.front_least_mm[run]) for each in (with_fixes, without))
        gained = ours - plain
        assert (ours <= 1000 * runs.head_m[run, : len(ours)] + 1).all()
        assert (gained[: found[0] if found else len(gained)] == 0).all()
        assert (np.diff(gained) > 500).sum() <= len(found)
        assert not found or gained[-1] > 1_000
        fixed += len(found)
    assert fixed >= 3


def test_the_slowest_train_reaches_the_end_of_the_slowest_line() -> None:
    curves = [feature(at, 30, 500, 1 / tracks.LEAST_RADIUS_M) for at in np.arange(150.0, 8_800.0, 710.0)]
    stops = np.arange(2_300.0, passing.LINE_M - 500, tracks.STATION_M[0])
    track = tracks.laid(passing.LINE_M, curves, [], stops)
    slowest = {"driver_share": 0.75, "traction_m_s2": 0.4, "braking_m_s2": 0.5, "dwell_s": 60.0}
    made = traces(Setup(track, passing.CYCLES, length_m=100.0, present={**passing.SOUND, **slowest}), 1, [0])
    assert made.truth.head_m[0, -1] > curves[-1].end_m + passing.BEYOND_M


def test_a_detection_that_began_late_fails_for_what_made_it_late() -> None:
    curve = registered(Registering(), feature(500, 50, 400, 1 / 600))
    assert curve is not None
    bent = Readings(
        front_least_mm=480_000,
        rolling=True,
        speed_mm_s=20_000,
        way_mm=400_000,
        yaw_valid=True,
        yaw_urad_s=33_000,
        pitch_valid=False,
        pitch_urad_s=0,
    )
    short, long = (Detection(Progress.ENTRY_STRAIGHT, 400_000 - way, 0, 0, 0) for way in (20_000, 60_000))
    slow, band, other = passing.FAILS_SLOW, passing.FAILS_BAND, passing.FAILS_OTHER
    assert passing.reason(curve, AWAITED, bent, slow) == slow
    assert passing.reason(curve, AWAITED, bent, "") == other
    assert passing.reason(curve, short, bent, slow) == slow
    assert passing.reason(curve, short, bent, "") == band
    assert passing.reason(curve, long, bent, slow) == band


def test_a_train_that_came_to_stand_a_little_short_of_its_stop_goes_on() -> None:
    track = tracks.line(302_020, passing.LINE_M)
    runs = passing.runs_on(track, 302, [83])
    stands = runs.head_m[0, np.flatnonzero(runs.speed_m_s[0] == 0)]
    assert ((stands > 6_180.7) & (stands < 6_180.8)).any(), "no longer the train that stood 0.28 m short"
    assert runs.head_m[0, -1] > 9_000
