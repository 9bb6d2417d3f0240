"""Slots of a radio channel: witnesses, drawn worlds of the theory, and where it is used (X1)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from kernel.crossing.crossing import Train
from kernel.crossing.ranging_schedule import ChannelSettings, Pair, are_in_time
from models.crossing.sites import CHANNEL, TRIALS, refusal
from proofs.crossing.witnesses.ranging_schedule import BOUNDS, EAST, ONE, ONE_EAST, SITE, THREE, TWO, WITNESSES, Played


@pytest.mark.parametrize("witness", WITNESSES)
def test_witness(witness: Callable[[], None]) -> None:
    assert witness.__doc__
    witness()


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 2**32))
def test_drawn_worlds_keep_every_invariant(seed: int) -> None:
    """Whatever comes, goes, is lost or late, and whoever restarts; every invariant is looked at in each step."""
    chance = Random(seed)
    channel = Played()
    pairs = (ONE, TWO, THREE, ONE_EAST, Pair(Train("2"), EAST))
    for _ in range(300):
        event = chance.randrange(16)
        newest = channel.system.schedule.number
        number = chance.choice((newest, newest, newest - 1, chance.randrange(newest + 2)))
        if event == 0:
            channel.step("register", pair=chance.choice(pairs))
        elif event == 1 and chance.random() < 0.3:
            channel.step("leave", gone=chance.choice(pairs))
        elif event == 2 and chance.random() < 0.05:
            channel.step("restart", number=newest + chance.randrange(3))
        elif event < 5:
            channel.step("begin_ranging", number=number)
        elif event < 7:
            channel.step("hear_answer", pair=chance.choice(pairs), number=number)
        elif event < 9:
            for pair in channel.ordered():
                channel.step("send_order", pair=pair)
        else:
            for under_way in channel.system.under_way:
                sent = channel.system.sent[under_way]
                if chance.random() < 0.3 or sent.since_ms + 10 >= SITE.over_ms:
                    channel.step("end_ranging", number=under_way)
            channel.tick()
    assert len(channel.system.under_way) <= 1


# ---- where it is used


def test_the_simulated_crossings_have_time_for_all_their_pairs() -> None:
    for trial in TRIALS:
        for kind in (trial.express, trial.local):
            assert are_in_time(CHANNEL, trial.bounds(kind))
            assert not are_in_time(replace(CHANNEL, most_pairs=CHANNEL.most_pairs + 1), trial.bounds(kind))


@pytest.mark.parametrize(
    ("channel", "words"),
    [
        (ChannelSettings(10, 105, 3), ""),
        (
            ChannelSettings(10, 106, 3),
            (
                "3 pairs in slots of 106 ms: rangings up to 604 ms old, but they count for 600 ms: write fewer pairs or"
                " shorter slots"
            ),
        ),
        (
            ChannelSettings(1, 1, 225),
            (
                "225 pairs in slots of 1 ms: rangings up to 601 ms old, but they count for 600 ms: write fewer pairs or"
                " shorter slots"
            ),
        ),
        (ChannelSettings(0, 105, 3), "tick 0 ms, slot 105 ms: both must be longer than 0 ms"),
        (ChannelSettings(10, 0, 3), "tick 10 ms, slot 0 ms: both must be longer than 0 ms"),
    ],
)
def test_settings_that_leave_no_time_are_refused_in_one_line(channel: ChannelSettings, words: str) -> None:
    assert refusal(channel, replace(BOUNDS, cycle_ms=150)) == words
