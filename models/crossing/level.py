"""What there is at a crossing: its site, trains that come, what it was told, its arms, and history (X2 to X5).

And what is assumed of trains, terminals, people, arms and power.
"""

from __future__ import annotations

from dataclasses import dataclass

from kernel.crossing.crossing import Crossing, CrossingTrack, Settings, Signal, Signals, Standing, Train
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


# ---- assumptions


def nobody_comes_before_the_check(system: Level) -> bool:
    """Trains run over a crossing that is in service (X5)."""
    return system.in_service


def a_train_comes_as_new(system: Level, train: Train) -> bool:
    """Nobody comes under a name of which the crossing was told, and not yet that he is gone (X1)."""
    return train not in system.bodies and train not in system.told


def a_train_comes_on_a_track(site: Road, track: CrossingTrack) -> bool:
    """Each track over the crossing has its start points (X3)."""
    return track in site.tracks


def a_start_point_is_passed_once(system: Level, train: Train) -> bool:
    """Who passes a start point is on its way, and has not been inside; out again it counts as inside (X3)."""
    return train in system.bodies and not system.bodies[train].inside


def who_arrives_has_passed_the_start_point(system: Level, train: Train) -> bool:
    """Start points lie on every way to the crossing, or starting signals at which trains wait to be let go (X3)."""
    return train in system.bodies and system.bodies[train].inside


def nobody_arrives_before_he_can(system: Level, train: Train) -> bool:
    """What is secured by start point and rangings is true (X2)."""
    return system.bodies[train].left_cycles <= 0


def the_terminal_tells_every_strike_first(system: Level, track: CrossingTrack, age_cycles: int) -> bool:
    """Who had passed a start point without contact when its terminal spoke is told of when that is heard (X3).

    The word may have been under way for any time, and be no older than it is taken for.
    A strike is put down to a train in contact only if that has made it.  Strikes from before a restart are not told
    again, nor are those that a terminal without power has missed: it tells first that there may be some.
    """
    return all(
        train in system.told or body.forgotten
        for train, body in system.bodies.items()
        if body.track == track and body.inside and body.inside_cycles >= age_cycles
    )


def who_stands_at_a_starting_signal_was_not_let_go(system: Level, train: Train) -> bool:
    """Who has asked to start counts as on its way, even if it stands; nobody passes such a signal before (X3)."""
    return train in system.bodies and train not in system.starting


def who_stands_before_the_road_is_not_on_it(site: Road, system: Level, train: Train, signal: Signal) -> bool:
    """Of a whole train that stands at a signal before the road, facing it, no part is on the road (X3)."""
    body = system.bodies[train]
    return signal not in site.signals.before or not body.is_whole or not body.is_on_road


def only_who_stands_promises_to_stand(site: Road, system: Level, train: Train, standing: Standing) -> bool:
    """Who tells that it stands, whole, at a signal before this road does so, or has asked to start there since (X3).

    Who is not whole, or stands at any other signal, may tell so wherever it is.
    """
    return (
        standing.signal not in site.signals.before
        or not standing.is_whole
        or train not in system.bodies
        or not system.bodies[train].inside
        or train in system.starting
    )


def a_decision_begins_each_cycle(system: Level) -> bool:
    """The crossing decides once before each cycle, never later (X2)."""
    return not system.decided


def the_arms_come_down_in_time(site: Road, lowered_cycles: int, are_down: bool) -> bool:
    """Arms that have been lowered for their time are down, and stay so (X5)."""
    return are_down or lowered_cycles < site.settings.lowering_cycles


def a_whole_train_told_gone_is_gone(system: Level, gone: Train, number: int, is_whole: bool) -> bool:
    """Evidence of a rear is of the run that was noted by that number, and of a whole train no part is left behind (X4).

    Or the train is in contact, and has turned back before its start point; it strikes that when it comes again.
    It may come late, and again, when the train is on its way once more.
    """
    if not is_whole or gone not in system.bodies:
        return True
    return number < system.bodies[gone].came_at or not system.bodies[gone].inside


def a_person_releases_what_is_gone(system: Level, gone: Train, number: int) -> bool:
    """Who releases has looked, and no part of the train that was noted by that number is in the approach (X4).

    His word may come late, and again.
    """
    return gone not in system.bodies or number < system.bodies[gone].came_at


def a_person_accounts_for_a_track_seen_empty(system: Level, track: CrossingTrack, number: int) -> bool:
    """Who was asked by that number has seen the track empty since: nobody is left who was forgotten on it by then (X3).

    His word may come late, and again.
    """
    return all(
        not body.forgotten or number < body.forgotten_at
        for _train, body in system.bodies.items()
        if body.track == track
    )


def a_start_goes_on_from_the_last_number(system: Level, number: int) -> bool:
    """Whoever starts, the crossing or a spare in its place, has a number above each that was given out (X3, X4)."""
    return number > system.newest
