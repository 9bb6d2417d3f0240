"""Trains at the start points of two tracks: a world of its own, in mm and seconds, at random and by name (X3, T14).

Nothing of models or proofs is in it but the kernel's public functions and what the days set.  Trains run, creep and
turn back; of what they tell some is lost, late or comes again; both tracks' tags are told to both terminals; power
fails at a terminal.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from random import Random

import pytest

from kernel.crossing import crossing, start_point
from kernel.crossing.crossing import Train
from kernel.crossing.start_point import StartPoint, StartPointSettings
from kernel.names import Tag
from kernel.restarts import restart_start_point
from tests.crossing.road import DOWN, SETTINGS, UP, Road

TAG_MM = 30_000
TOLD_S, WAITS_S, CHANGES_S = 2, 20, 60
NOBODY = Train("nobody")
NoteRead = Callable[[StartPointSettings, StartPoint, Train, Tag], StartPoint]


@dataclass
class Coming:
    """A train on a track: its head's way to the detector, and how it runs.

    ``turns``: it turns back between tag and detector.  ``tells``: it reads tags, and says so.
    """

    name: Train
    speed_mm_s: int
    tells: bool
    turns: bool
    way_mm: int = 200_000
    read_s: int = -1
    struck: bool = False


@dataclass
class Track:
    """A track with its start point; ``told``: strikes, by whom they were made and told."""

    tag: Tag
    trains: list[Coming]
    fails_s: int
    point: StartPoint = field(default_factory=lambda: restart_start_point(NOBODY))
    free_s: int = 0
    missed: int = 0
    owed: int = 0
    unknown: int = 0
    """Strikes that nobody noted, and that the crossing has not been told of."""
    told: list[tuple[Train, Train]] = field(default_factory=list)

    @property
    def settings(self) -> StartPointSettings:
        return StartPointSettings(self.tag, TOLD_S, WAITS_S, CHANGES_S)


@dataclass
class World:
    """Two tracks, and what is under way on the radio: when it is heard, whose it is, and of which tag."""

    tracks: Sequence[Track]
    chance: Random
    note_read: NoteRead = start_point.note_read
    lost: float = 0.0
    air: list[tuple[int, Train, Tag]] = field(default_factory=list)

    def second(self, now_s: int) -> None:
        for track in self.tracks:
            track.point = start_point.aged(track.point)
            if track.fails_s <= now_s < track.fails_s + 5:
                track.point = restart_start_point(NOBODY)
        heard = [(name, tag) for due_s, name, tag in self.air if due_s == now_s]
        for name, tag in heard:
            self.hear(name, tag)
        for track in self.tracks:
            self.run(track, now_s)
            if track.point.owes and not self.is_off(track, now_s):
                track.owed += 1
                track.unknown = 0
                track.point = start_point.note_owed(track.point)

    def is_off(self, track: Track, now_s: int) -> bool:
        return track.fails_s <= now_s < track.fails_s + 5

    def hear(self, name: Train, tag: Tag) -> None:
        for track in self.tracks:
            track.point = self.note_read(track.settings, track.point, name, tag)

    def run(self, track: Track, now_s: int) -> None:
        """Let the first train run, and the next one come from 200 m before when it has struck, or is gone."""
        if not track.trains or now_s < track.free_s:
            return
        train = track.trains[0]
        train.way_mm -= train.speed_mm_s
        if train.way_mm <= TAG_MM and train.read_s < 0:
            train.read_s = now_s
            self.tell(train, track.tag, now_s)
        if train.turns and train.way_mm <= TAG_MM:
            track.trains.pop(0)
            track.free_s = train.read_s + CHANGES_S + 1
        elif train.way_mm <= 0 and not train.struck:
            train.struck = True
            self.strike(track, train, now_s)
        if train.struck:
            track.trains.pop(0)

    def tell(self, train: Coming, tag: Tag, now_s: int) -> None:
        """Tell of a read: at once, or late, and again."""
        if train.tells and self.chance.random() >= self.lost:
            late_s = self.chance.randrange(TOLD_S + 1)
            if late_s == 0:
                self.hear(train.name, tag)
            self.air += [(now_s + late_s, train.name, tag), (now_s + TOLD_S, train.name, tag)]

    def strike(self, track: Track, train: Coming, now_s: int) -> None:
        if self.is_off(track, now_s):
            track.missed += 1
            track.unknown += 1
            return
        new = Train(f"strike of {train.name}")
        track.told.append((train.name, start_point.striker(track.point, new)))
        track.point = start_point.note_strike(track.point)


def random_world(number: int, note_read: NoteRead = start_point.note_read) -> World:
    chance = Random(number)
    tracks = []
    for side in ("up", "down"):
        trains = [
            Coming(
                Train(f"{side} {each}"), chance.randrange(3_000, 28_000), chance.random() < 0.6, chance.random() < 0.1
            )
            for each in range(20)
        ]
        tracks.append(Track(Tag(side), trains, chance.choice((-10, chance.randrange(10, 600)))))
    return World(tracks, chance, note_read, chance.choice((0.0, 0.2)))


def played(world: World, seconds: int = 900) -> World:
    for now_s in range(1, seconds):
        world.second(now_s)
    return world


def wrong(world: World) -> list[tuple[Train, Train]]:
    """Strikes that were put down to a train that did not make them."""
    return [
        (by, name) for track in world.tracks for by, name in track.told if name not in (by, Train(f"strike of {by}"))
    ]


def judge(world: World) -> None:
    assert wrong(played(world)) == []
    for track in world.tracks:
        assert track.owed == (1 if track.fails_s < 0 else 2)
        assert track.unknown == 0


@pytest.mark.parametrize("number", range(20))
def test_worlds_at_random(number: int) -> None:
    judge(random_world(number))


@pytest.mark.slow
def test_a_thousand_worlds_at_random() -> None:
    for number in range(20, 1_020):
        judge(random_world(number))


def test_strikes_are_put_down_to_who_tells_and_to_nobody_else() -> None:
    """Most trains that tell are left to their rangings; who tells nothing never is (X3)."""
    told = [each for number in range(20) for track in played(random_world(number)).tracks for each in track.told]
    own = [by for by, name in told if by == name]
    assert len(told) > 200
    assert len(own) > 0.3 * len(told)


def any_tag(settings: StartPointSettings, point: StartPoint, train: Train, _tag: Tag) -> StartPoint:
    """Take what is told of the track beside for one's own."""
    return start_point.note_read(settings, point, train, settings.tag)


def any_time(settings: StartPointSettings, point: StartPoint, train: Train, tag: Tag) -> StartPoint:
    """Take what is told after a strike as well."""
    return point if tag != settings.tag else StartPoint(train, settings.waits_cycles, point.struck_cycles, point.owes)


@pytest.mark.parametrize("careless", [any_tag, any_time])
def test_a_terminal_without_a_guard_is_seen(careless: NoteRead) -> None:
    assert any(wrong(played(random_world(number, careless))) for number in range(20))


# ---- named


def two(tells: bool, speeds_mm_s: tuple[int, int]) -> list[Coming]:
    """A train with radio, and one without behind it."""
    one, other = (Coming(Train(name), speed, False, False) for name, speed in zip("ab", speeds_mm_s, strict=True))
    one.tells = tells
    return [one, other]


def test_side_by_side() -> None:
    """One of them without radio; each strike in the same second (X3, T14)."""
    up = Track(Tag("up"), [Coming(Train("heard"), 10_000, True, False)], -10)
    down = Track(Tag("down"), [Coming(Train("unheard"), 10_000, False, False)], -10)
    world = played(World((up, down), Random(1)), 60)
    assert up.told == [("heard", "heard")]
    assert down.told == [("unheard", "strike of unheard")]
    assert wrong(world) == []


def test_close_behind() -> None:
    """What the first tells comes late and again; the strike of the second is its own (X3)."""
    track = Track(Tag("up"), two(True, (25_000, 28_000)), -10)
    played(World((track,), Random(3)), 60)
    assert [by for by, _ in track.told] == ["a", "b"]
    assert track.told[1] == ("b", "strike of b")


def test_who_creeps_for_longer_than_a_read_waits_is_warned_of() -> None:
    """From its start point, like one without radio: that is the price (X3)."""
    track = Track(Tag("up"), [Coming(Train("slow"), 1_000, True, False)], -10)
    played(World((track,), Random(1)), 300)
    assert track.told == [("slow", "strike of slow")]


def test_settings_under_which_a_read_waits_for_another_train_are_refused() -> None:
    assert start_point.are_lawful(StartPointSettings(Tag("up"), 2, 58, 60))
    assert not start_point.are_lawful(StartPointSettings(Tag("up"), 2, 59, 60))


def test_two_trains_that_a_terminal_has_missed_are_both_seen_before_the_road_opens() -> None:
    """They strike two minutes apart while it has no power, and queue; a person sees the first one leave (X3)."""
    road = Road()
    for track in (UP, DOWN):
        road.see_empty(track)
    road.hear_the_terminals()
    road.decide({})
    assert not road.crossing.warns
    for _ in range(300):
        road.crossing = crossing.note_heard(road.crossing, DOWN, 0)
        road.decide({})
    assert road.warned_s == 300 - SETTINGS.silence_cycles
    point = restart_start_point(NOBODY)
    assert point.owes
    road.crossing = crossing.note_missed(road.crossing, UP)
    point = start_point.note_owed(point)
    assert not point.owes
    road.tell_gone(Train("the first of them"))
    for _ in range(60):
        road.hear_the_terminals()
        road.decide({})
    assert road.crossing.warns
    road.see_empty(UP)
    road.decide({})
    assert not road.crossing.warns
