"""A crossing with any number of trains on any number of tracks, its start points, and its arms (X2 to X5, T14).

Trains are no bodies here but what is secured of them: within how many cycles a train cannot arrive.  A start
point gives that by its place, and so does a starting signal inside, at which a train waits to be let go;
``arrival`` gives it by its guarantee, of which the answers here are the two halves.
All else a train may do as it likes: stop short, turn back, part, follow another as closely as signals let it.
"""

from __future__ import annotations

from dataclasses import replace

from kernel.crossing import crossing as machine
from kernel.crossing.crossing import CrossingTrack, Due, Signal, Standing, Train
from kernel.maps import Map
from kernel.restarts import restart_crossing
from models.crossing.level import (
    Arrived,
    Body,
    Level,
    Road,
    a_decision_begins_each_cycle,
    a_person_accounts_for_a_track_seen_empty,
    a_person_releases_what_is_gone,
    a_start_goes_on_from_the_last_number,
    a_start_point_is_passed_once,
    a_train_comes_as_new,
    a_train_comes_on_a_track,
    a_whole_train_told_gone_is_gone,
    nobody_arrives_before_he_can,
    nobody_comes_before_the_check,
    only_who_stands_promises_to_stand,
    the_arms_come_down_in_time,
    the_terminal_tells_every_strike_first,
    who_arrives_has_passed_the_start_point,
    who_stands_at_a_starting_signal_was_not_let_go,
    who_stands_before_the_road_is_not_on_it,
)
from models.measures import greater, lesser

# ---- transitions


def put_into_service(site: Road, system: Level, number: int) -> Level:
    """The settings of a crossing are checked, and refused if they are not lawful; then it starts (X5)."""
    if not machine.are_lawful(site.settings) or not a_start_goes_on_from_the_last_number(system, number):
        return system
    return restarted(site, replace(system, in_service=True), number)


def restart(site: Road, system: Level, number: int) -> Level:
    """Its power fails and is back, or a spare takes its place: all that it was told is lost (X3).

    Without power lamps, bells and arms do what the start state asks for; so while power is away it restarts in each
    cycle.
    """
    if not nobody_comes_before_the_check(system) or not a_start_goes_on_from_the_last_number(system, number):
        return system
    return restarted(site, system, number)


def restarted(site: Road, system: Level, number: int) -> Level:
    """What a start leaves: whoever is inside is forgotten, and whoever is not may be told of again (X3)."""
    started = replace(
        system,
        crossing=restart_crossing(site.settings, site.tracks, number),
        asked={track: number for track in site.tracks},  # noqa: C420
        newest=number,
    )
    return replace(
        started,
        bodies={
            train: replace(
                body,
                was_struck=False,
                has_asked=body.has_asked and body.inside,
                forgotten=body.inside,
                forgotten_at=started.newest,
            )
            for train, body in system.bodies.items()
        },
        told={},
        starting={},
        accounted=frozenset(),
        restarted=True,
        unseen=True,
        decided=False,
        unheard_cycles={track: cycles for track, cycles in system.unheard_cycles.items() if track in site.tracks},
    )


# ---- trains


def come(site: Road, system: Level, train: Train, track: CrossingTrack, left_cycles: int) -> Level:
    """A train comes, or is made up; it is before the start point (X3)."""
    if not nobody_comes_before_the_check(system) or not a_train_comes_on_a_track(site, track):
        return system
    if not a_train_comes_as_new(system, train):
        return system
    body = Body(
        track,
        inside=False,
        left_cycles=left_cycles,
        came_at=system.newest + 1,
        is_on_road=False,
        is_whole=True,
        inside_cycles=0,
        was_struck=False,
        has_asked=False,
        was_known=False,
        forgotten=False,
        forgotten_at=system.newest,
    )
    return replace(system, bodies=system.bodies | {train: body})


def pass_start_point(site: Road, system: Level, train: Train) -> Level:
    """A train passes its start point, which lies so far away that it cannot arrive sooner (X3)."""
    if not a_start_point_is_passed_once(system, train):
        return system
    body = system.bodies[train]
    left_cycles = greater(body.left_cycles, site.settings.start_cycles)
    inside = replace(body, inside=True, inside_cycles=0, left_cycles=left_cycles)
    return replace(system, bodies=system.bodies | {train: inside})


def arrive(site: Road, system: Level, train: Train) -> Level:
    """A train's head is met at the crossing (X2)."""
    if not who_arrives_has_passed_the_start_point(system, train) or not nobody_arrives_before_he_can(system, train):
        return system
    body = system.bodies[train]
    last = Arrived(True, system.warned_cycles, system.down_cycles, body.was_known, system.opened_cycles)
    bodies = system.bodies | {train: replace(body, is_on_road=True)}
    return replace(system, bodies=bodies, last=last)


def part(site: Road, system: Level, train: Train) -> Level:
    """A coupling breaks; what is left behind may be anywhere, and run (X4)."""
    return replace(
        system,
        bodies={
            other: replace(body, is_whole=body.is_whole and other != train) for other, body in system.bodies.items()
        },
    )


def leave(site: Road, system: Level, gone: Train) -> Level:
    """A train's rear is past the crossing, or it has turned back; all of it (X4)."""
    return replace(system, bodies={train: body for train, body in system.bodies.items() if train != gone})


# ---- starting signals inside the start points


def without(known: Map[Train, int], gone: Train) -> Map[Train, int]:
    """Give all that are known but for one."""
    return {train: number for train, number in known.items() if train != gone}


def told_of(system: Level, train: Train) -> Map[Train, int]:
    """Give whom the crossing was told of, with one more if it did not know that one."""
    return system.told if train in system.told else system.told | {train: system.newest + 1}


def come_to_stand(site: Road, system: Level, train: Train, signal: Signal) -> Level:
    """A train stands at a starting signal, inside its start point: from there it is not on its way (X3).

    At another road's signal it is as much on its way as anywhere, and so is one that has parted.
    """
    if not who_stands_at_a_starting_signal_was_not_let_go(system, train):
        return system
    if not who_stands_before_the_road_is_not_on_it(site, system, train, signal):
        return system
    body = system.bodies[train]
    is_clear = signal in site.signals.before and body.is_whole
    stands = replace(
        body,
        inside=body.inside and not is_clear,
        has_asked=body.has_asked and not (body.forgotten and is_clear),
        forgotten=body.forgotten and not is_clear,
    )
    return replace(system, bodies=system.bodies | {train: stands})


def promise_to_stand(site: Road, system: Level, train: Train, standing: Standing) -> Level:
    """It promises to stand there until it is let go, again and again; or an old promise of it comes (X4)."""
    if not only_who_stands_promises_to_stand(site, system, train, standing):
        return system
    counts = standing.signal in site.signals.before and standing.is_whole and train not in system.starting
    return replace(
        system,
        bodies={
            other: replace(body, was_struck=False, has_asked=False) if other == train and counts else body
            for other, body in system.bodies.items()
        },
        told=without(system.told, train) if counts else system.told,
        crossing=machine.note_standing(site.signals, system.crossing, train, standing),
    )


def ask_to_start(site: Road, system: Level, train: Train, run_cycles: int) -> Level:
    """A train asks to start at a signal so many cycles away; one that is there, or none (X3)."""
    return replace(
        system,
        bodies={
            other: replace(body, was_struck=body.was_struck or other == train) for other, body in system.bodies.items()
        },
        told=told_of(system, train),
        newest=newest_with(system, train),
        starting=system.starting | {train: run_cycles},
        crossing=machine.note_start(system.crossing, train, run_cycles),
    )


def let_go(site: Road, system: Level, train: Train) -> Level:
    """The crossing lets a train start; from then on it is on its way (X5)."""
    if not machine.may_start(site.settings, system.crossing, train):
        return system
    if not a_start_point_is_passed_once(system, train):
        return system
    body = system.bodies[train]
    left_cycles = greater(body.left_cycles, system.starting[train])
    return replace(system, bodies=system.bodies | {train: replace(body, inside=True, left_cycles=left_cycles)})


# ---- what the crossing is told


def newest_with(system: Level, train: Train) -> int:
    """Give the newest number once the crossing was told of a train; one that is known has its own."""
    return system.newest if train in system.told else system.newest + 1


def make_contact(site: Road, system: Level, train: Train) -> Level:
    """Radio contact with a train begins (003, 2.3)."""
    return replace(
        system,
        told=told_of(system, train),
        newest=newest_with(system, train),
        crossing=machine.note_contact(system.crossing, train),
    )


def hear_strike(site: Road, system: Level, train: Train) -> Level:
    """A terminal tells of a train at its start point; of one that is there, or of none (X3, T14)."""
    is_new = train not in system.told
    return replace(
        system,
        bodies={
            other: replace(body, was_struck=body.was_struck or (other == train and is_new))
            for other, body in system.bodies.items()
        },
        told=told_of(system, train),
        newest=newest_with(system, train),
        crossing=machine.note_struck(system.crossing, train),
    )


def last_spoke(system: Level, track: CrossingTrack, age_cycles: int) -> int:
    """Give how long ago a terminal spoke, with a word of this age."""
    if track not in system.unheard_cycles:
        return age_cycles
    return lesser(age_cycles, system.unheard_cycles[track])


def hear_terminal(site: Road, system: Level, track: CrossingTrack, age_cycles: int) -> Level:
    """A terminal is heard, by a word that it spoke so long ago, when it had no more to tell (X3, T14)."""
    if not the_terminal_tells_every_strike_first(system, track, age_cycles):
        return system
    heard = replace(system, crossing=machine.note_heard(system.crossing, track, age_cycles))
    if age_cycles < 0:
        return heard
    return replace(
        heard,
        asked=system.asked if track in system.asked else system.asked | {track: system.newest + 1},
        newest=system.newest if track in system.asked else system.newest + 1,
        unheard_cycles=system.unheard_cycles | {track: last_spoke(system, track, age_cycles)},
    )


def hear_what_may_be_missed(site: Road, system: Level, track: CrossingTrack) -> Level:
    """A terminal has started, and tells that it may have missed strikes: nobody knows whose, or how many (X3, T14)."""
    return replace(
        system,
        bodies={
            train: replace(body, forgotten=True, forgotten_at=system.newest + 1)
            if body.track == track and body.inside and train not in system.told
            else body
            for train, body in system.bodies.items()
        },
        accounted=system.accounted - {track},
        asked=system.asked | {track: system.newest + 1},
        newest=system.newest + 1,
        crossing=machine.note_missed(system.crossing, track),
    )


def is_of_now(system: Level, gone: Train, number: int) -> bool:
    """Tell whether a word is of what the crossing was told last of a train."""
    return gone in system.told and system.told[gone] == number


def tell_gone(site: Road, system: Level, gone: Train, number: int, is_whole: bool) -> Level:
    """A rear is proved out of the approach, or who turned back comes as new; or that is late, or again (X4, T14)."""
    if not a_whole_train_told_gone_is_gone(system, gone, number, is_whole):
        return system
    counts = is_whole and is_of_now(system, gone, number)
    return replace(
        system,
        bodies={
            train: replace(body, came_at=system.newest + 1, was_struck=False, has_asked=False)
            if train == gone and counts
            else body
            for train, body in system.bodies.items()
        },
        told=without(system.told, gone) if counts else system.told,
        starting=without(system.starting, gone) if counts else system.starting,
        crossing=machine.note_gone(system.crossing, gone, number, is_whole),
    )


def release(site: Road, system: Level, gone: Train, number: int) -> Level:
    """A person on site releases a train that does not come any more; or that comes late, or again (X4)."""
    if not a_person_releases_what_is_gone(system, gone, number):
        return system
    counts = is_of_now(system, gone, number)
    return replace(
        system,
        told=without(system.told, gone) if counts else system.told,
        starting=without(system.starting, gone) if counts else system.starting,
        crossing=machine.note_released(system.crossing, gone, number),
    )


def account(site: Road, system: Level, track: CrossingTrack, number: int) -> Level:
    """A person on site has seen a track to be empty; or that comes late, or again (X3)."""
    if not a_person_accounts_for_a_track_seen_empty(system, track, number):
        return system
    counts = track in system.asked and system.asked[track] == number
    return replace(
        system,
        accounted=system.accounted | {track} if counts else system.accounted,
        crossing=machine.note_empty(system.crossing, track, number),
    )


# ---- cycles


def secured_cycles(warning_cycles: int, reopening_cycles: int, due: Due) -> int:
    """Give within how many cycles a train that is not due cannot arrive: what ``due`` proves (X2, X4)."""
    if due == Due.NEAR:
        return warning_cycles + 2
    return warning_cycles + reopening_cycles + 2


def decide(site: Road, system: Level, dues: Map[Train, Due]) -> Level:
    """The crossing decides; what the answers guarantee is so from now on (X2)."""
    if not system.in_service or not a_decision_begins_each_cycle(system):
        return system
    crossing = machine.decide(site.settings, system.crossing, dues)
    opens = system.crossing.warns and not crossing.warns
    warning_cycles, reopening_cycles = site.settings.warning_cycles, site.settings.reopening_cycles
    return replace(
        system,
        bodies={
            train: replace(
                body,
                left_cycles=greater(body.left_cycles, secured_cycles(warning_cycles, reopening_cycles, dues[train]))
                if train in dues and dues[train] != Due.NOW
                else body.left_cycles,
                has_asked=body.has_asked
                or body.forgotten
                or (train in system.told and (body.was_struck or train not in dues or dues[train] == Due.NOW)),
                was_known=train in system.told if opens else body.was_known,
            )
            for train, body in system.bodies.items()
        },
        crossing=crossing,
        restarted=system.restarted and crossing.warns,
        unseen=any(track not in system.accounted for track, _cycles in system.unheard_cycles.items()),
        decided=True,
        warned_cycles=system.warned_cycles if crossing.warns else 0,
        opened_cycles=0 if opens else system.opened_cycles,
    )


def run_a_cycle(site: Road, system: Level, are_down: bool) -> Level:
    """A cycle passes, for trains, arms and terminals (X2, X5)."""
    if a_decision_begins_each_cycle(system):
        return system
    lowered_cycles = system.lowered_cycles + 1 if machine.arms_are_to_be_down(site.settings, system.crossing) else 0
    if not the_arms_come_down_in_time(site, lowered_cycles, are_down):
        return system
    return replace(
        system,
        bodies={
            train: replace(body, left_cycles=body.left_cycles - 1, inside_cycles=body.inside_cycles + 1)
            for train, body in system.bodies.items()
        },
        crossing=machine.aged(system.crossing),
        decided=False,
        warned_cycles=system.warned_cycles + 1 if system.crossing.warns else 0,
        lowered_cycles=lowered_cycles,
        are_down=are_down,
        down_cycles=system.down_cycles + 1 if system.are_down and are_down else 0,
        opened_cycles=system.opened_cycles + 1,
        unheard_cycles={track: cycles + 1 for track, cycles in system.unheard_cycles.items()},
    )
