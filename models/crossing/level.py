"""What there is at a crossing: its site, trains that come, what it was told, its arms, and history (X2 to X5)."""

from __future__ import annotations

from dataclasses import dataclass

from kernel.crossing.crossing import Crossing, CrossingTrack, Settings, Signals, Train
from kernel.maps import Map


@dataclass(frozen=True)
class Road:
    """What does not change: the settings of the crossing, its tracks, and the starting signals before it (X5).

    ``signals``: a train that stands at one of them faces the road, and the road lies beyond the signal.
    """

    settings: Settings
    tracks: frozenset[CrossingTrack]
    signals: Signals


@dataclass(frozen=True)
class Body:
    """A train on its way to the crossing, or a part of one, until its rear is past or it has turned back.

    ``track``: which it is on.  ``inside``: it has passed the start point, or was let go at a signal inside it.
    ``left_cycles``: within so many cycles it cannot arrive.
    ``came_at``: history: the number that the crossing was to give next when it came, or was made up.
    ``is_on_road``: it has come to the road, and its rear is not past it yet.
    ``is_whole``: nothing has parted from it.
    ``inside_cycles``: history: how long ago it passed its start point.
    ``was_struck``: history: a terminal told of it, which was not in contact.
    ``has_asked``: history: that was so at a decision, or it was due, or in contact and nothing was known of it, or it
    was forgotten.
    ``was_known``: history: the crossing knew of it when it last let the arms up.
    ``forgotten``: history: it was inside when the crossing restarted, or when a terminal told that it may have missed
    strikes, and its own had not been told: no terminal tells of it any more.  ``forgotten_at``: the crossing's number
    from then.
    """

    track: CrossingTrack
    inside: bool
    left_cycles: int
    came_at: int
    is_on_road: bool
    is_whole: bool
    inside_cycles: int
    was_struck: bool
    has_asked: bool
    was_known: bool
    forgotten: bool
    forgotten_at: int


@dataclass(frozen=True)
class Arrived:
    """A history: the arrival that was last, and what was so then.

    ``is_any``: there was one.  ``warned_cycles``, ``down_cycles``: for how long the warning had lasted, and the
    arms been down.  ``was_known``: as of the body.  ``opened_cycles``: since the arms were last let up.
    """

    is_any: bool
    warned_cycles: int
    down_cycles: int
    was_known: bool
    opened_cycles: int


@dataclass(frozen=True)
class Level:
    """One moment.

    ``in_service``: its settings have been checked.
    ``bodies``: all trains that are on their way.  ``crossing``: the machine.
    ``told``: history: whom it was told of, by contact or strike, and not yet that they are gone; and by which number.
    ``starting``: history: those of them that have asked to start at a signal inside the start points, and within
    how many cycles none arrives from there.
    ``accounted``: history: tracks that a person has seen to be empty since the last restart, also of their terminals.
    ``asked``: history: by which number a person is asked to look at each track.
    ``newest``: history: how often it has been told of anything new, or has restarted; its newest number.
    ``restarted``: history: it has restarted, and its warning has not ended since.
    ``unseen``: history: at its last decision, or its start, there was a track that nobody had accounted for.
    ``decided``: it has decided for the cycle that begins.
    ``warned_cycles``: history: for how long lamps and bells have gone, through restarts.
    ``lowered_cycles``: for how long its arms have been lowered or held down.
    ``are_down``, ``down_cycles``: they are down, and for how many whole cycles.
    ``opened_cycles``: since a warning last ended.
    ``unheard_cycles``: history: how long ago each start point's terminal spoke, of what was heard of it.
    ``last``: the last arrival.
    """

    in_service: bool
    bodies: Map[Train, Body]
    told: Map[Train, int]
    starting: Map[Train, int]
    crossing: Crossing
    accounted: frozenset[CrossingTrack]
    asked: Map[CrossingTrack, int]
    newest: int
    restarted: bool
    unseen: bool
    decided: bool
    warned_cycles: int
    lowered_cycles: int
    are_down: bool
    down_cycles: int
    opened_cycles: int
    unheard_cycles: Map[CrossingTrack, int]
    last: Arrived
