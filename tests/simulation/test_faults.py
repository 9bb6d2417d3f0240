"""The file of faults: what it leaves out does not come, and what is wrong in it is told by its key."""

from __future__ import annotations

from pathlib import Path

import pytest

from models.layouts import BadInput
from models.simulation.faults import EVERY_FAULT, FAULTS, Setting, read_faults
from models.simulation.occurrences import occurrences
from tests.simulation.lines import imported

TRAINS = sorted(imported("passing_station").layout.fleet)
POINTS = sorted(imported("passing_station").layout.points)
ROADS = ("Mill Road",)


def test_a_file_names_what_comes(tmp_path: Path) -> None:
    path = tmp_path / "faults.toml"
    path.write_text("[radio_loss]\nrate = 0.5\n[unit_restart]\nat_s = [60, 90.5]\n")
    found = read_faults(path)
    assert found == {"radio_loss": Setting(0.5, 0, 0), "unit_restart": Setting(0.1, 0, 0, (60.0, 90.5))}
    path.write_text("")
    assert read_faults(path) == {}


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("[radio_los]\n", "'radio_los': there is no such fault"),
        ("radio_loss = 1\n", "'radio_loss': is not a table"),
        ("[radio_loss]\nrates = 1\n", "'radio_loss.rates': there is no such key"),
        ("[radio_loss]\nrate = 1.5\n", "'radio_loss.rate': 1.5 is no chance"),
        ("[radio_loss]\nrate = true\n", "'radio_loss.rate': is not a number"),
        ("[radio_loss]\nrate = nan\n", "'radio_loss.rate': is not a number"),
        ("[radio_outage]\nleast = 9\nmost = 3\n", "'radio_outage.least': is above 'most'"),
        ("[unit_restart]\nat_s = 60\n", "'unit_restart.at_s': is not a list of times"),
        ("[unit_restart]\nat_s = [-1]\n", "'unit_restart.at_s': is not a number"),
        ("[radio_loss]\nat_s = [60]\n", "'radio_loss.at_s': comes by its chance a telegram"),
        ("[radio_loss\n", "is not TOML"),
        ("[radio_loss]\nrate = 1" + 400 * "0", "'radio_loss.rate': is not a number"),
        ("[radio_loss]\nrate = 1" + 5_000 * "0", "number: cannot be read"),
        ("a = " + 3_000 * "[", "nesting: is deeper"),
    ],
)
def test_what_is_wrong_is_told_in_one_line_by_its_key(tmp_path: Path, text: str, told: str) -> None:
    path = tmp_path / "faults.toml"
    path.write_text(text)
    with pytest.raises(BadInput) as bad:
        read_faults(path)
    assert told in str(bad.value)
    assert "\n" not in str(bad.value)


def test_a_fault_that_is_left_out_moves_none_of_the_others() -> None:
    whole = occurrences(EVERY_FAULT, 7, 200.0, TRAINS, POINTS, ROADS)
    for fault in FAULTS:
        some = {name: setting for name, setting in EVERY_FAULT.items() if name != fault.name}
        assert occurrences(some, 7, 200.0, TRAINS, POINTS, ROADS) == [
            each for each in whole if each.fault != fault.name
        ]
    assert {each.fault for each in whole} == {fault.name for fault in FAULTS if not fault.is_share}
    assert whole == sorted(whole, key=lambda each: each.at_ms)
