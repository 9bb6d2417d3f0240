"""The tone in drawn days beside the truth, and that more trains or less knowledge never make it milder (A2 to A8)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from kernel.alarm import tone as machine
from kernel.alarm.distance import GREATEST_AGE_MS, UM_A_MM, Direction, TrainFix, WorkerFix
from kernel.alarm.tone import NOTHING_KNOWN, Display, Handset, Known, Listing, Tone, Train
from models.alarm.worksite import comes_along
from proofs.alarm.witnesses.alarm_tone import WITNESSES
from proofs.alarm.witnesses.worksite import KM, REGISTER, STABLED, Day

DOWN, UP = Direction.DOWN, Direction.UP
HUGE = 2**62
PLACES = st.one_of(st.integers(0, 70 * KM), st.sampled_from((-HUGE, -1, 20 * KM, 41 * KM, 60 * KM, HUGE)))
AGES = st.one_of(st.integers(0, 20_000), st.sampled_from((-1, GREATEST_AGE_MS, GREATEST_AGE_MS + 1, HUGE)))
FIXES = st.builds(TrainFix, PLACES, AGES, st.sampled_from(Direction), st.booleans())
STRETCHES = st.builds(
    lambda from_mm, way_mm, age_ms: Display(from_mm, from_mm + way_mm, age_ms), PLACES, st.integers(0, 6 * KM), AGES
)
KNOWN = st.builds(Known, FIXES, STRETCHES, st.booleans(), FIXES)
TRAINS = st.sampled_from([Train("1D"), Train("2U"), STABLED, Train("4U")])
HANDSETS = st.builds(
    Handset,
    worker=st.builds(WorkerFix, PLACES, AGES),
    server_age_ms=AGES,
    servers_well=st.booleans(),
    battery_well=st.booleans(),
    listing=st.builds(
        Listing, st.just(0), st.integers(0, 2), st.integers(0, 2), st.booleans(), st.dictionaries(TRAINS, st.just(1))
    ),
    trains=st.dictionaries(TRAINS, KNOWN),
)


@pytest.mark.parametrize("witness", WITNESSES)
def test_witness(witness: Callable[[], None]) -> None:
    assert witness.__doc__
    witness()


@given(HANDSETS, TRAINS, KNOWN)
def test_another_train_never_makes_the_tone_milder(handset: Handset, train: Train, known: Known) -> None:
    """No train masks another, whatever is known of it (A3)."""
    if train not in handset.trains:
        more = replace(handset, trains={**dict(handset.trains.items()), train: known})
        assert machine.tone(REGISTER, more).value <= machine.tone(REGISTER, handset).value


@given(HANDSETS)
def test_what_is_lost_never_makes_a_mild_tone(handset: Handset) -> None:
    """Battery, servers, the worker's fix, any train: then it is the fault tone, or the alarm (A8)."""
    losses = [
        replace(handset, battery_well=False),
        replace(handset, servers_well=False),
        replace(handset, server_age_ms=GREATEST_AGE_MS),
        replace(handset, worker=WorkerFix(0, GREATEST_AGE_MS + 1)),
    ]
    losses += [replace(handset, listing=replace(handset.listing, is_whole=False))]
    losses += [replace(handset, listing=replace(handset.listing, count=handset.listing.taken + 1))]
    losses += [
        replace(handset, trains={**dict(handset.trains.items()), train: NOTHING_KNOWN}) for train in handset.trains
    ]
    for lost in losses:
        assert machine.tone(REGISTER, lost) in (Tone.ALARM, Tone.FAULT)


@given(HANDSETS)
def test_a_clock_that_leaps_is_never_normal(handset: Handset) -> None:
    for elapsed_ms in (-1, GREATEST_AGE_MS + 1, -HUGE, HUGE):
        assert machine.tone(REGISTER, machine.older(handset, elapsed_ms)) == Tone.FAULT


@given(HANDSETS)
def test_the_normal_tone_knows_every_train(handset: Handset) -> None:
    """Reckoned here anew: both sources there, or one in a registered section (A2, A4 to A6)."""
    if machine.tone(REGISTER, handset) == Tone.NORMAL:
        for train, known in handset.trains.items():
            fix, shown = 0 <= known.fix.age_ms <= 10_000, 0 <= known.display.age_ms <= 12_000
            assert fix or shown
            if fix and not shown:
                assert 40 * KM <= known.fix.place_mm <= 41 * KM
            if shown and not fix:
                in_siding = train == STABLED and 60 * KM <= known.display.from_mm <= known.display.to_mm <= 61 * KM
                assert in_siding or 20 * KM <= known.fix.place_mm <= 23 * KM
            if shown and fix:
                assert known.display.from_mm - 50_000 <= known.fix.place_mm <= known.display.to_mm + 50_000


# ---- days


class Drawn:
    """A day with a few trains, drawn, in which sources fail and come back."""

    def __init__(self, seed: int) -> None:
        """Begin, with the trains on the line."""
        self.chance = Random(seed)
        self.day = Day(worker_mm=30 * KM)
        self.day.hear()
        self.trains = [Train("1D"), Train("2U"), STABLED]
        self.ways = {train: self.chance.choice((DOWN, UP)) for train in self.trains}
        for train in self.trains:
            self.day.come(train, self.chance.randrange(24 * KM, 36 * KM), self.ways[train])

    def disturb(self, train: Train) -> None:
        """The handset restarts, or the server does, or somebody reports wrongly that a train has left."""
        step = self.chance.choice(("restart_handset", "start_server", "report_left"))
        match step:
            case "restart_handset":
                self.day.step(step)
                self.day.step("look_at_the_battery", battery_well=True)
            case "start_server":
                self.day.step(step, now_ms=self.day.system.newest_ms + 1)
                for each in self.trains[: self.chance.randrange(4)]:
                    self.day.step("enter", train=each)
            case _:
                self.day.step(step, train=train)
                self.day.step("strike_off", train=train)

    def second(self) -> None:
        """Let a second pass, tell what is told, and listen."""
        self.day.run(1_000, *((train, way) for train, way in self.ways.items() if self.chance.random() < 0.9))
        if self.chance.random() < 0.9:
            self.day.hear()
        if self.chance.random() < 0.1:
            for train in self.trains:
                self.day.step("enter", train=train)
        for train in self.trains:
            drawn = self.chance.random()
            if train not in self.day.system.handset.trains:
                continue
            if drawn < 0.6:
                self.day.tell(train, self.ways[train])
            elif drawn < 0.63:
                self.day.tell(train, self.ways[train], off_mm=self.chance.choice((-9, 9)) * KM)
            elif drawn < 0.65:
                self.disturb(train)
        tone, system = self.day.tone(), self.day.system
        near = any(comes_along(body, system.worker_um, 3 * KM) for _train, body in system.bodies.items())
        assert tone != Tone.NORMAL or not near


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 2**32))
def test_in_drawn_days_the_normal_tone_means_no_train_near(seed: int) -> None:
    drawn = Drawn(seed)
    for _ in range(150):
        drawn.second()


def test_drawn_days_hear_every_tone() -> None:
    """Else the test above would show nothing."""
    heard = set()
    for seed in range(12):
        drawn = Drawn(seed)
        for _ in range(150):
            drawn.second()
            heard.add(drawn.day.system.heard.tone)
    assert heard == set(Tone)


def test_reports_that_repeat_or_come_late_are_taken_for_what_they_are() -> None:
    """The age that they are told with counts; the same report again is older (A1)."""
    day = Day()
    day.hear()
    day.come(Train("1D"), 4 * KM)
    first = day.tell(Train("1D"), DOWN)
    for elapsed_ms in (1_000, 2_000, 3_000):
        day.run(1_000, (Train("1D"), DOWN))
        again = replace(first.fix, age_ms=elapsed_ms)
        day.step("take_fix", train=Train("1D"), fix=again, at_um=UM_A_MM * 4 * KM, is_right=True)
        assert day.system.handset.trains[Train("1D")].fix == again
    assert NOTHING_KNOWN not in dict(day.system.handset.trains.items()).values()
