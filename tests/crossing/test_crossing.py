"""The crossing in drawn days, with every invariant in each step; and what never makes it less careful (X2 to X5)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from kernel.crossing import crossing as machine
from kernel.crossing.crossing import Crossing, CrossingTrack, Due, Train
from proofs.crossing.witnesses.crossing import WITNESSES
from proofs.crossing.witnesses.crossing_day import DOWN, SETTINGS, UP, Day

TRAINS = [Train(str(number)) for number in range(6)]
DUES = st.dictionaries(st.sampled_from(TRAINS), st.sampled_from(Due))
CROSSINGS = st.builds(
    Crossing,
    asks=st.dictionaries(st.sampled_from(TRAINS), st.booleans()),
    starts=st.dictionaries(st.sampled_from(TRAINS), st.integers(0, 60)),
    silent_cycles=st.dictionaries(st.sampled_from([UP, DOWN]), st.integers(0, 4)),
    unaccounted=st.dictionaries(st.sampled_from([UP, DOWN]), st.booleans()),
    numbers=st.just({}),
    looks=st.just({}),
    number=st.just(0),
    warns=st.booleans(),
    warned_cycles=st.integers(0, 100),
)


@pytest.mark.parametrize("witness", WITNESSES)
def test_witness(witness: Callable[[], None]) -> None:
    assert witness.__doc__
    witness()


@given(CROSSINGS, DUES, st.sampled_from(TRAINS))
def test_another_train_never_ends_a_warning(crossing: Crossing, dues: dict[Train, Due], train: Train) -> None:
    """Nor does it keep one from beginning (X4)."""
    without = machine.decide(SETTINGS, crossing, dues)
    for note in (machine.note_contact, machine.note_struck):
        assert machine.decide(SETTINGS, note(crossing, train), dues).warns >= without.warns


@given(CROSSINGS, DUES, st.sampled_from(TRAINS))
def test_an_answer_that_is_lost_is_as_good_as_now(crossing: Crossing, dues: dict[Train, Due], train: Train) -> None:
    lost = {each: due for each, due in dues.items() if each != train}
    assert machine.decide(SETTINGS, crossing, lost) == machine.decide(SETTINGS, crossing, {**lost, train: Due.NOW})
    assert machine.decide(SETTINGS, crossing, lost).warns >= machine.decide(SETTINGS, crossing, dues).warns


@given(CROSSINGS, DUES, st.sampled_from([UP, DOWN]))
def test_silence_never_ends_a_warning(crossing: Crossing, dues: dict[Train, Due], track: CrossingTrack) -> None:
    silent = replace(crossing, silent_cycles={**dict(crossing.silent_cycles.items()), track: 3})
    assert machine.decide(SETTINGS, silent, dues).warns
    assert machine.decide(SETTINGS, crossing, dues).warns >= machine.must_warn(SETTINGS, crossing)


@given(CROSSINGS, DUES)
def test_a_warning_begins_only_where_it_must(crossing: Crossing, dues: dict[Train, Due]) -> None:
    """Reckoned here anew: an open road is closed for who asks, is due, or may have come unheard or unseen (X2, X3)."""
    decided = machine.decide(SETTINGS, replace(crossing, warns=False), dues)
    due_now = any(asks or dues.get(train, Due.NOW) == Due.NOW for train, asks in crossing.asks.items())
    silent = any(silent > 2 for _track, silent in crossing.silent_cycles.items())
    assert decided.warns == (due_now or silent or True in dict(crossing.unaccounted.items()).values())


# ---- days


class Drawn:
    """A day on two tracks: trains come, pass, turn back, part and are released; terminals fall silent."""

    def __init__(self, seed: int) -> None:
        """Begin."""
        self.chance = Random(seed)
        self.day = Day()
        self.names = iter(range(1_000))
        self.arrivals = 0

    def cycle(self) -> None:
        """Let trains do something, terminals tell or not, and a cycle pass."""
        chance, day = self.chance, self.day
        if chance.random() < 0.1:
            day.come(Train(str(next(self.names))), chance.choice((UP, DOWN)), contact=chance.random() < 0.7)
        for train, body in list(day.system.bodies.items()):
            if chance.random() < 0.05 and not body.inside:
                day.strike(train)
            if body.inside and body.left_cycles <= 0 and chance.random() < 0.5:
                day.arrive(train)
                self.arrivals += 1
                self.go(train)
            elif chance.random() < 0.005:
                self.go(train)
        for train, body in day.system.bodies.items():
            if body.inside and chance.random() < 0.8:
                day.step("hear_strike", train=train)
        dues = {train: chance.choice((Due.FAR, Due.NEAR, Due.NEAR)) for train in day.system.crossing.asks}
        dues |= {train: Due.NOW for train, body in day.system.bodies.items() if body.inside and body.left_cycles < 42}
        for track in (UP, DOWN):
            if chance.random() < 0.7:
                day.step("hear_terminal", track=track, age_cycles=0)
        day.cycle(*dues.items(), heard=())

    def go(self, train: Train) -> None:
        """A train is gone; its rear is proved, or somebody has looked."""
        number = self.chance.choice((self.day.number(train), self.chance.randint(0, self.day.system.crossing.number)))
        self.day.step("tell_gone", gone=train, number=number, is_whole=self.chance.random() < 0.5)
        self.day.step("leave", gone=train)
        if self.chance.random() < 0.5:
            self.day.step("release", gone=train, number=self.day.number(train))


@settings(max_examples=20, deadline=None)
@given(st.integers(0, 2**32))
def test_in_drawn_days_every_arrival_is_warned_of(seed: int) -> None:
    drawn = Drawn(seed)
    for _ in range(300):
        drawn.cycle()
        assert not drawn.day.system.last.is_any or drawn.day.system.last.down_cycles > 20


def test_drawn_days_have_arrivals_openings_and_silence() -> None:
    """Else the test above would show nothing."""
    arrivals, warned, opened = 0, 0, 0
    for seed in range(12):
        drawn = Drawn(seed)
        for _ in range(300):
            before = drawn.day.warns()
            drawn.cycle()
            warned += drawn.day.warns()
            opened += before and not drawn.day.warns()
        arrivals += drawn.arrivals
    assert arrivals > 10
    assert opened > 5
    assert 0 < warned < 12 * 300
