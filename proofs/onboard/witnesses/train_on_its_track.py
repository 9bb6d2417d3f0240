"""One train and what its computer knows of the track that it is on, by the tags that it reads (T1, T12)."""

from __future__ import annotations

from dataclasses import replace

from kernel.onboard import computer
from kernel.onboard.speed_limit import UNKNOWN as NO_TRACK_KNOWN
from kernel.onboard.tag_kind import CURVE, PLAIN
from models.onboard.units import NM_A_MM
from proofs.onboard.witnesses.one_train import LIMITS, approaching, read_at
from proofs.onboard.witnesses.rolling_stock import START_MM


def the_track_is_what_the_tags_say_for_the_whole_train() -> None:
    """A tag lifts what restricts once the rear is past it, and one that is elsewhere, or of no list, nothing (T12)."""
    tag_mm = START_MM + 100_000
    ride = approaching(tag_mm)
    assert ride.system.computer.known.limit == NO_TRACK_KNOWN
    ride.step("read_a_tag", place_mm=tag_mm, **read_at(ride, tag_mm))
    ride.step("await_none")
    limit = ride.system.computer.known.limit
    assert (limit.in_curve, limit.at_turnout) == (False, False)
    at_mm = computer.place_of_read(ride.system.computer).most_mm
    assert (limit.curve_until_mm, limit.turnout_until_mm) == (at_mm, at_mm)
    passed = ride.system
    ride.step("read_unlisted", read_at_nm=ride.system.front_nm, in_curve=True, at_turnout=True)
    assert ride.system.computer.known.limit == replace(limit, in_curve=True, at_turnout=True)
    ride.system = passed
    elsewhere = read_at(ride, tag_mm) | {"uid": tag_mm + 40_000, "read_at_nm": (tag_mm + 44_000) * NM_A_MM}
    ride.step("read_a_tag", place_mm=tag_mm + 40_000, **elsewhere)
    assert ride.system == passed, "there is no such tag under it"
    other = computer.read_by_head(LIMITS, passed.computer, 1, tag_mm + 40_000, PLAIN)
    assert other.known.limit == replace(limit, in_curve=True, at_turnout=True)
    assert other.spacing == passed.computer.spacing
    assert other.known.motion == passed.computer.known.motion
    while not ride.system.computer.brake.applied:
        ride.cycle(ride.system.speed_um_s // 1_000 + 100)
    assert 14_000 < ride.system.from_um_s // 1_000 <= 15_100, "faster than a turnout allows, its rear may be on one"


def a_tag_that_hides_a_curve_is_none_of_this_world() -> None:
    """Nobody writes one (T1, T12)."""
    tag_mm = START_MM + 100_000
    ride = approaching(tag_mm)
    before = ride.system
    ride.step("read_a_tag", place_mm=tag_mm, **read_at(ride, tag_mm) | {"in_curve": True})
    assert ride.system == before
    ride.step("read_a_tag", place_mm=tag_mm, **read_at(ride, tag_mm) | {"in_curve": True, "kind": CURVE})
    assert ride.system.passing.in_curve
    assert ride.system.computer.known.limit.in_curve
    assert not ride.system.computer.known.limit.at_turnout
