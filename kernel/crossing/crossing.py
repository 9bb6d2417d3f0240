"""A crossing's own machine: when its warning begins and ends, and its arms fall and rise (X2 to X5, T14).

Any number of trains on any number of tracks.  A train is known to the crossing by one of two ways:

- it is in contact, and once before each cycle the ground unit reckons by its rangings when it may arrive at
  the earliest (``arrival``).  Of all that only an answer of three values comes in here, :class:`Due`;
- or the terminal of its track's start point tells of it (conventional control, X3, and start tags, T14).

A train that begins its run inside the start points, or turns back there, stands at a starting signal.  It promises
to stand until it is let go, asks to start, and is let go once that leaves road users their time (ours).

So the joint between the two machines is a contract: a train that is not due cannot arrive within
``warning_cycles`` + 1 after the decision, and one that is far not within ``reopening_cycles`` more.  It is what
``arrival`` proves, for any warning time; so reckoning and combining are proved apart, each in its own terms.

Whoever has asked for the warning asks for it until its rear is proved past (X4, ours).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import Enum
from typing import NewType

from kernel.crossing import arrival
from kernel.crossing.arrival import ArrivalBounds, Followed
from kernel.maps import Map
from kernel.onboard.arithmetic import smaller

LEAST_DOWN_MS = 15_000
"""From barriers down to the arrival, never less (003, 2.1, note 2; X5)."""
NONE = 0
"""The number of nothing that the crossing has noted."""

Signal = NewType("Signal", str)
"""A starting signal, at which trains stand until they are let go (X4)."""
Train = NewType("Train", str)
"""A train in contact, or one that a terminal has told of: it gives each a name that nobody has had (X1, X3)."""
CrossingTrack = NewType("CrossingTrack", str)
"""A track over the crossing; there is a start point on it for each direction that trains come from (X3)."""


class Due(Enum):
    """When a train in contact may arrive, seen from one decision (X2, X4)."""

    FAR = 0
    """Were the arms let up now, they would be up and down again before it arrives."""
    NEAR = 1
    """They would not; but it need not be warned of yet."""
    NOW = 2


@dataclass(frozen=True)
class Settings:
    """What is written for a crossing, in cycles of ``cycle_ms`` (X5).

    ``warning_cycles``: its warning time, from the warning to the arrival.
    ``bell_cycles``: lamps and bells alone, before the arms fall.  ``lowering_cycles``: until they are down then.
    ``least_down_cycles``: from then to the arrival, at least.
    ``lifting_cycles``: until the arms are up.
    ``reopening_cycles``: for less time than this the road is not opened.
    ``silence_cycles``: so long a start point's terminal may be silent.
    ``start_cycles``: from its start point no train arrives within so many cycles, at the line's greatest speed.
    """

    cycle_ms: int
    warning_cycles: int
    bell_cycles: int
    lowering_cycles: int
    least_down_cycles: int
    lifting_cycles: int
    reopening_cycles: int
    silence_cycles: int
    start_cycles: int


@dataclass(frozen=True)
class Signals:
    """What is written of starting signals for a road.

    ``before``: those whose train faces the road, and that lie between the two.
    """

    before: frozenset[Signal]


@dataclass(frozen=True)
class Standing:
    """What a train tells that promises to stand: at which signal, and whether it is whole (T3, X4)."""

    signal: Signal
    is_whole: bool


@dataclass(frozen=True)
class Crossing:
    """What a crossing knows and does.

    ``asks``: each train that it knows of, and whether that has asked for the warning.
    ``starts``: those that have asked to start at a signal inside the start points, and within how many cycles
    none arrives from there.
    ``silent_cycles``: how long ago each start point's terminal spoke, of what it was heard to say since.
    ``unaccounted``: each track, and whether nobody has seen it empty since the last restart, of the crossing or of a
    terminal on it; such a track warns.
    ``numbers``: by which number it has noted each train; ``looks``: by which it asks a person to look at each track.
    ``number``: the newest of them, through all starts.
    ``warns``: lamps and bells.  ``warned_cycles``: how long this warning has lasted.
    """

    asks: Map[Train, bool]
    starts: Map[Train, int]
    silent_cycles: Map[CrossingTrack, int]
    unaccounted: Map[CrossingTrack, bool]
    numbers: Map[Train, int]
    looks: Map[CrossingTrack, int]
    number: int
    warns: bool
    warned_cycles: int


def are_lawful(settings: Settings) -> bool:
    """Tell whether a crossing may be set so; if not, it is not put into service (X5).

    Some time for lamps and bells alone, in which the road clears, and some for the arms to fall (ours).

    Fifteen seconds from barriers down to the arrival; and the start points far enough for the warning time, for
    what a terminal may be silent, for the cycle until the decision and for that of the arrival.
    """
    return (
        settings.cycle_ms > 0
        and settings.bell_cycles > 0
        and settings.lowering_cycles > 0
        and settings.cycle_ms * settings.least_down_cycles >= LEAST_DOWN_MS
        and settings.bell_cycles + settings.lowering_cycles + settings.least_down_cycles <= settings.warning_cycles
        and settings.lifting_cycles >= 0
        and settings.lifting_cycles + settings.lowering_cycles <= settings.reopening_cycles
        and settings.silence_cycles >= 0
        and settings.warning_cycles + settings.silence_cycles + 2 <= settings.start_cycles
    )


def have_one_warning_time(bounds: ArrivalBounds, settings: Settings) -> bool:
    """Tell whether rangings are reckoned by lawful bounds, in the crossing's own cycle and warning time (X2, X5).

    If not, the crossing is not put into service: what an answer secures would be shorter than the arms need.
    """
    return (
        arrival.are_lawful(bounds)
        and bounds.cycle_ms == settings.cycle_ms
        and bounds.warning_cycles == settings.warning_cycles
    )


def due(bounds: ArrivalBounds, followed: Followed, reopening_cycles: int) -> Due:
    """Give when a train in contact is due, from what is known of it (X2, X4).

    Far is what need not be warned of by a warning time that is longer by ``reopening_cycles``.
    """
    if arrival.must_warn(bounds, followed):
        return Due.NOW
    longer = replace(bounds, warning_cycles=bounds.warning_cycles + reopening_cycles)
    if arrival.must_warn(longer, followed):
        return Due.NEAR
    return Due.FAR


def may_go_faster(bounds: ArrivalBounds, followed: Followed, asked_um: int, reopening_cycles: int) -> bool:
    """Tell whether a train's ask to go as fast as this is acknowledged: it is far even so (X2, ours).

    So whatever an answer has secured until now is still secured; one that is near or warned of stays with its ceiling.
    """
    if not followed.ceiling_um <= asked_um <= bounds.line_um:
        return False
    return due(bounds, arrival.held_to(bounds, followed, asked_um), reopening_cycles) == Due.FAR


# ---- numbers: whoever says later that something is over says of what


def numbered(crossing: Crossing, train: Train) -> Crossing:
    """Give a train that was not known a number that nothing has had (X4, ours)."""
    number = crossing.number + 1
    return replace(crossing, numbers=crossing.numbers | {train: number}, number=number)


def asking(crossing: Crossing, track: CrossingTrack) -> Crossing:
    """Ask a person to look at a track, by a number that nothing has had: what was seen before does not count (X3)."""
    number = crossing.number + 1
    return replace(
        crossing,
        unaccounted=crossing.unaccounted | {track: True},
        looks=crossing.looks | {track: number},
        number=number,
    )


def number_of(crossing: Crossing, train: Train) -> int:
    """Give the number by which a train is noted, as terminals are told and people on site are shown (X4, ours)."""
    if train not in crossing.numbers:
        return NONE
    return crossing.numbers[train]


def look_of(crossing: Crossing, track: CrossingTrack) -> int:
    """Give the number by which a person is asked to look at a track, as is shown on site (X3, ours)."""
    if track not in crossing.looks:
        return NONE
    return crossing.looks[track]


# ---- what the crossing is told


def note_contact(crossing: Crossing, train: Train) -> Crossing:
    """Take a train in that is in contact (003, 2.3).

    One that a start point has told of stays with conventional control until it is gone (X3).
    """
    if train in crossing.asks:
        return crossing
    return replace(numbered(crossing, train), asks=crossing.asks | {train: False})


def note_struck(crossing: Crossing, train: Train) -> Crossing:
    """A terminal tells of a train that has struck its start point (X3, T14).

    One in contact is left to its rangings; for anybody else the crossing warns.
    """
    if train in crossing.asks:
        return crossing
    return replace(numbered(crossing, train), asks=crossing.asks | {train: True})


def newest_word(crossing: Crossing, track: CrossingTrack, age_cycles: int) -> int:
    """Give how long ago a terminal spoke last, by a word of this age and by what was heard of it before (X3, ours)."""
    if track not in crossing.silent_cycles:
        return age_cycles
    return smaller(age_cycles, crossing.silent_cycles[track])


def note_heard(crossing: Crossing, track: CrossingTrack, age_cycles: int) -> Crossing:
    """A terminal is heard; every strike from before it spoke that it had not told of comes first (X3, T14).

    ``age_cycles``: how long ago it spoke, at the most.  While a word is under way, a train may strike and the terminal
    fail; so silence counts from when it spoke.  Of an age below zero there is no word (ours).

    One whose track the settings leave out has a track that nobody has accounted for (ours).
    """
    if age_cycles < 0:
        return crossing
    spoke_cycles = newest_word(crossing, track, age_cycles)
    heard = replace(crossing, silent_cycles=crossing.silent_cycles | {track: spoke_cycles})
    if track in crossing.unaccounted:
        return heard
    return asking(heard, track)


def note_missed(crossing: Crossing, track: CrossingTrack) -> Crossing:
    """A terminal has started: it may have missed strikes, nobody knows how many (X3, T14, ours).

    So a person has to see its track empty, as after a restart; whoever sees one train leave has not seen the others.
    """
    return asking(crossing, track)


def note_gone(crossing: Crossing, gone: Train, number: int, is_whole: bool) -> Crossing:
    """A train's rear is proved out of the approach, and the train is whole (X4, T14).

    By its tail's reads at an end point, beyond the road or beyond its start point (``end_point``), or by all its axles
    at the end detector.  Of one in contact that turns back before its start point, by its ranging (``arrival``).
    """
    return note_released(crossing, gone, number) if is_whole else crossing


def note_released(crossing: Crossing, gone: Train, number: int) -> Crossing:
    """A person on site has seen that a train is not in the approach, nor a part of it (X4, ours).

    ``number``: by which it was noted.  A word of an earlier run, late or again, has another one.
    """
    return forgotten(crossing, gone) if number_of(crossing, gone) == number else crossing


def forgotten(crossing: Crossing, gone: Train) -> Crossing:
    """Forget a train (X4)."""
    return replace(
        crossing,
        asks={train: asks for train, asks in crossing.asks.items() if train != gone},
        starts={train: cycles for train, cycles in crossing.starts.items() if train != gone},
        numbers={train: number for train, number in crossing.numbers.items() if train != gone},
    )


# ---- trains that begin their runs inside the start points


def note_standing(signals: Signals, crossing: Crossing, train: Train, standing: Standing) -> Crossing:
    """A train promises to stand at its starting signal until it is let go: so it is not on its way (X4, ours).

    Who stands at a signal that does not lie before this road may stand across the road, or before both; and of a train
    that is not whole a part may be on its way.

    Once it has asked to start, its promise may be an old one and counts no more; a person withdraws what it asked.
    """
    if standing.signal not in signals.before or not standing.is_whole or train in crossing.starts:
        return crossing
    return forgotten(crossing, train)


def note_start(crossing: Crossing, train: Train, run_cycles: int) -> Crossing:
    """A train asks to start at a signal inside the start points: for it the crossing warns (X3, ours).

    ``run_cycles``: as is written for its signal, no train arrives from there within so many.
    """
    known = crossing if train in crossing.asks else numbered(crossing, train)
    return replace(known, asks=crossing.asks | {train: True}, starts=crossing.starts | {train: run_cycles})


def may_start(settings: Settings, crossing: Crossing, train: Train) -> bool:
    """Tell whether a train that has asked is let go: when it arrives, road users have had their time (X5, ours).

    A warning in which the crossing restarted may have lasted less than it counts, by the bell's time; so that much is
    always waited for.
    """
    if train not in crossing.starts:
        return False
    return crossing.warned_cycles - settings.bell_cycles + crossing.starts[train] > settings.warning_cycles


# ---- tracks after a restart


def note_empty(crossing: Crossing, track: CrossingTrack, number: int) -> Crossing:
    """A person on site has seen a track empty from its start points to the road, since the last restart (X3, ours).

    ``number``: by which he was asked to look.  A word from before the restart, late or again, has another one.

    Nothing else accounts for it: who stands in the approach strikes no start point, and is not heard.
    """
    if number == NONE or look_of(crossing, track) != number:
        return crossing
    return replace(crossing, unaccounted=crossing.unaccounted | {track: False})


# ---- what the crossing does


def must_warn(settings: Settings, crossing: Crossing) -> bool:
    """Tell whether a train asks for the warning, or a terminal is silent: silence means warn (X2, X3, T14).

    So does a track that nobody has accounted for: whom a restart has forgotten or missed may still be there (ours).
    """
    return (
        any(asks for _train, asks in crossing.asks.items())
        or any(silent > settings.silence_cycles for _track, silent in crossing.silent_cycles.items())
        or any(unaccounted for _track, unaccounted in crossing.unaccounted.items())
    )


def told(dues: Map[Train, Due], train: Train) -> Due:
    """Give the answer for a train; none is as good as now (X2)."""
    if train not in dues:
        return Due.NOW
    return dues[train]


def decide(settings: Settings, crossing: Crossing, dues: Map[Train, Due]) -> Crossing:
    """Decide for the cycle that begins, with an answer for each train in contact (X2).

    A warning begins at once where it must.  It ends where it need not be and no train is near (X4).
    """
    now = replace(crossing, asks={train: asks or told(dues, train) == Due.NOW for train, asks in crossing.asks.items()})
    if must_warn(settings, now):
        return replace(now, warns=True)
    held = crossing.warns and any(told(dues, train) != Due.FAR for train, _asks in now.asks.items())
    return replace(now, warns=held, warned_cycles=crossing.warned_cycles if held else 0)


def arms_are_to_be_down(settings: Settings, crossing: Crossing) -> bool:
    """Tell whether the arms are lowered or held down; first lamps and bells alone, so that the road clears (X5)."""
    return crossing.warns and crossing.warned_cycles >= settings.bell_cycles


def aged(crossing: Crossing) -> Crossing:
    """Let a cycle pass (X2, X3)."""
    return replace(
        crossing,
        silent_cycles={track: silent + 1 for track, silent in crossing.silent_cycles.items()},
        warned_cycles=crossing.warned_cycles + 1 if crossing.warns else 0,
    )
