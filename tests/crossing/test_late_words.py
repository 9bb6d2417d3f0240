"""Terminals whose words are under way for seconds, come twice, out of order or never, and that fail meanwhile (X3)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from random import Random

import pytest

from kernel.crossing import crossing as machine
from kernel.crossing.crossing import Crossing, CrossingTrack, Settings, Train
from kernel.restarts import restart_crossing

SETTINGS = Settings(
    cycle_ms=1_000,
    warning_cycles=30,
    bell_cycles=5,
    lowering_cycles=10,
    least_down_cycles=15,
    lifting_cycles=5,
    reopening_cycles=20,
    silence_cycles=6,
    start_cycles=38,
)
"""No start point is farther than it has to be."""
UP, DOWN = CrossingTrack("up"), CrossingTrack("down")
WHOLE_S = 600
NoteHeard = Callable[[Crossing, CrossingTrack, int], Crossing]


@dataclass(frozen=True)
class Word:
    """Spoken at ``spoke_s`` and heard at ``heard_s``: who has struck by then, and that there is no more to tell."""

    spoke_s: int
    heard_s: int
    struck: tuple[Train, ...]


@dataclass
class Terminal:
    """Of a start point; silent from ``fails_s`` on, until somebody comes at ``mended_s``."""

    track: CrossingTrack
    fails_s: int
    mended_s: int
    strikes: dict[Train, int] = field(default_factory=dict)
    under_way: list[Word] = field(default_factory=list)

    def speak(self, random: Random, now_s: int, most_s: int) -> None:
        """Say what there is to say, once or twice; some of it gets lost."""
        if self.fails_s <= now_s < self.mended_s:
            return
        for _ in range(random.choice((0, 1, 1, 1, 2))):
            self.under_way.append(Word(now_s, now_s + random.randint(0, most_s), tuple(self.strikes)))

    def heard(self, now_s: int) -> list[Word]:
        """What comes now."""
        return [word for word in self.under_way if word.heard_s == now_s]


@dataclass
class Found:
    """What came of the trains of a world: for how long each was warned of, and for how many seconds it was open."""

    warned_s: list[int] = field(default_factory=list)
    open_s: int = 0
    failed_under_way: int = 0


def played(number: int, note_heard: NoteHeard = machine.note_heard) -> Found:
    """A line on which trains without radio come at the greatest speed, many of them as their terminal fails."""
    random, found = Random(f"late words {number}"), Found()
    most_s = random.randint(0, SETTINGS.silence_cycles)
    tracks = []
    for track in (UP, DOWN):
        fails_s = random.randint(60, 300)
        tracks.append(Terminal(track, fails_s, fails_s + random.randint(60, 200)))
    comes = {
        Train(f"{each.track} {at_s}"): (each, at_s)
        for each in tracks
        for at_s in {each.fails_s + random.randint(-4, 2), each.fails_s + 150, random.randint(10, 400)}
    }
    crossing, warned_s = restart_crossing(SETTINGS, frozenset((UP, DOWN)), 1), 0
    for track in (UP, DOWN):
        crossing = machine.note_empty(crossing, track, machine.look_of(crossing, track))
    for now_s in range(WHOLE_S):
        for train, (terminal, at_s) in comes.items():
            if at_s == now_s:
                terminal.strikes[train] = now_s
        for terminal in tracks:
            terminal.speak(random, now_s, most_s)
            for word in terminal.heard(now_s):
                for train in word.struck:
                    crossing = machine.note_struck(crossing, train)
                crossing = note_heard(crossing, terminal.track, now_s - word.spoke_s)
                found.failed_under_way += terminal.fails_s <= now_s and word.spoke_s < terminal.fails_s
        crossing = machine.decide(SETTINGS, crossing, {})
        for train, (terminal, at_s) in comes.items():
            if now_s == at_s + SETTINGS.start_cycles:
                found.warned_s.append(warned_s)
            if now_s == at_s + SETTINGS.start_cycles + 20:
                terminal.strikes.pop(train, None)
                terminal.under_way = [word for word in terminal.under_way if train not in word.struck]
                crossing = machine.note_released(crossing, train, machine.number_of(crossing, train))
        warned_s = warned_s + 1 if crossing.warns else 0
        found.open_s += not crossing.warns
        crossing = machine.aged(crossing)
    return found


def judge(number: int) -> Found:
    found = played(number)
    assert len(found.warned_s) >= 4
    assert min(found.warned_s) > SETTINGS.warning_cycles
    return found


def test_the_settings_are_lawful_and_leave_nothing_over() -> None:
    assert machine.are_lawful(SETTINGS)
    assert SETTINGS.start_cycles == SETTINGS.warning_cycles + SETTINGS.silence_cycles + 2


@pytest.mark.parametrize("number", range(20))
def test_every_train_is_warned_of_in_time(number: int) -> None:
    assert judge(number).open_s > 60


def test_words_are_under_way_as_terminals_fail() -> None:
    assert sum(played(number).failed_under_way for number in range(20)) > 40


@pytest.mark.slow
def test_a_thousand_worlds_at_random() -> None:
    for number in range(20, 1_020):
        judge(number)


def as_of_now(crossing: Crossing, track: CrossingTrack, _age_cycles: int) -> Crossing:
    """Every word counts as one of now."""
    return machine.note_heard(crossing, track, 0)


def test_who_takes_a_word_for_one_of_now_is_seen() -> None:
    assert any(min(played(number, as_of_now).warned_s) <= SETTINGS.warning_cycles for number in range(20))
