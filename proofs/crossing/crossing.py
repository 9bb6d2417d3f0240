"""What is claimed of a crossing: warned and closed long enough before every arrival, of any train (X2 to X5)."""

from __future__ import annotations

from kernel.crossing import crossing as machine
from models.crossing import crossing as world
from models.crossing.level import Level, Road
from models.measures import greater
from proofs.theory import Theory, by_name

# ---- the start


def nothing_has_happened(site: Road, system: Level) -> bool:
    """Nobody is on the way, every terminal has just been heard, and the road is open (X5)."""
    return (
        all(False for _train in system.bodies)
        and all(
            track in system.unheard_cycles
            and track in system.crossing.silent_cycles
            and system.unheard_cycles[track] == 0
            and system.crossing.silent_cycles[track] == 0
            for track in site.tracks
        )
        and not system.crossing.warns
        and system.crossing.warned_cycles == 0
        and system.warned_cycles == 0
        and not system.restarted
        and not system.decided
        and system.lowered_cycles == 0
        and system.down_cycles == 0
        and not system.last.is_any
    )


def it_is_not_in_service(site: Road, system: Level) -> bool:
    """At the start the settings are not checked, nothing has happened, and nobody is known (X5)."""
    return (
        not system.in_service
        and nothing_has_happened(site, system)
        and system.crossing.number == system.newest
        and all(False for _train in system.told)
        and all(False for _train in system.starting)
        and all(False for _train in system.crossing.starts)
        and all(False for _train in system.crossing.numbers)
        and all(False for _track in system.crossing.looks)
        and all(False for _track in system.asked)
        and all(False for _train in system.crossing.asks)
        and all(False for _track in system.accounted)
        and all(False for _track, _unaccounted in system.crossing.unaccounted.items())
    )


# ---- safety


def warned_long_enough_before_every_arrival(site: Road, system: Level) -> bool:
    """When a head is at the crossing the warning had lasted the warning time as that cycle began (X2, X5)."""
    return not system.last.is_any or system.last.warned_cycles > site.settings.warning_cycles


def barriers_are_down_long_enough_before_every_arrival(site: Road, system: Level) -> bool:
    """And the arms had been down as long as is written, as that cycle began: 15 s (003, 2.1, note 2) or more (X5)."""
    return not system.last.is_any or (
        system.last.down_cycles > site.settings.least_down_cycles
        and site.settings.cycle_ms * (system.last.down_cycles - 1) >= 15_000
    )


def barriers_stay_down_between_close_trains(site: Road, system: Level) -> bool:
    """No train known when the crossing opened arrives sooner than the least opening and a warning (X4, X5).

    In the least opening the arms can rise and come down again.
    """
    return (
        not system.last.is_any
        or not system.last.was_known
        or (
            system.last.opened_cycles > site.settings.warning_cycles + site.settings.reopening_cycles
            and site.settings.reopening_cycles >= site.settings.lifting_cycles + site.settings.lowering_cycles
        )
    )


def silence_warns(site: Road, system: Level) -> bool:
    """Once a start point's terminal has been silent for too long, the next decision warns (X3, T14)."""
    late_cycles = 0 if system.decided else 1
    return (
        not system.in_service
        or system.crossing.warns
        or all(
            system.unheard_cycles[track] <= site.settings.silence_cycles + late_cycles
            for track in site.tracks
            if track in system.unheard_cycles
        )
    )


def warning_ends_only_with_the_rear_past(site: Road, system: Level) -> bool:
    """While a train that was warned of is in the approach, or a part of it, the warning lasts (X4).

    Through restarts, too, if it had passed its start point by then, and where a terminal without power has missed it.
    One that stands at a starting signal before the road, whole, and promises to stand until it is let go, is not in the
    approach.
    """
    return system.crossing.warns or all(not body.has_asked for _train, body in system.bodies.items())


def arms_fall_after_the_bell(site: Road, system: Level) -> bool:
    """Lamps and bells come first, for their time, and that is some; without a warning no arm is lowered (X5).

    But in a warning in which the crossing restarts.
    """
    has_opened = system.decided and not system.crossing.warns
    return (
        not system.in_service
        or has_opened
        or system.restarted
        or (
            system.lowered_cycles == greater(0, system.warned_cycles - site.settings.bell_cycles)
            and (system.lowered_cycles == 0 or system.lowered_cycles < system.warned_cycles)
        )
    )


def after_a_restart_arms_are_held_down(site: Road, system: Level) -> bool:
    """Until its warning ends: they may be down already, with a train behind them (X3, X5)."""
    return not system.restarted or machine.arms_are_to_be_down(site.settings, system.crossing)


def a_track_that_nobody_accounted_for_warns(site: Road, system: Level) -> bool:
    """From a restart on until a person has seen each track empty, and from the decision after one of a terminal (X3).

    And a track that settings leave out, from the decision after its terminal was heard.
    """
    return not system.in_service or system.crossing.warns or not system.unseen


# ---- what it rests on


def who_was_told_of_is_known(site: Road, system: Level) -> bool:
    """The crossing knows those of whom it was told and not yet that they are gone, and nobody else (X1, X3)."""
    return all(train in system.crossing.asks for train in system.told) and all(
        train in system.told for train, _asks in system.crossing.asks.items()
    )


def what_is_noted_has_its_number(site: Road, system: Level) -> bool:
    """A train by which it was told of, a track by which a person was asked to look (X3, X4)."""
    return (
        system.crossing.number == system.newest
        and all(
            train in system.crossing.numbers and system.crossing.numbers[train] == number
            for train, number in system.told.items()
        )
        and all(train in system.told for train in system.crossing.numbers)
        and all(
            track in system.crossing.looks and system.crossing.looks[track] == number
            for track, number in system.asked.items()
        )
        and all(track in system.asked for track in system.crossing.looks)
        and all(number <= system.newest for _track, number in system.asked.items())
        and all(track in system.crossing.unaccounted for track in system.asked)
        and all(track in system.asked for track, _unaccounted in system.crossing.unaccounted.items())
    )


def a_train_is_noted_after_it_came(site: Road, system: Level) -> bool:
    """By a number that none of its earlier runs has had (X4)."""
    return all(
        body.came_at <= system.newest + 1 and (train not in system.told or body.came_at <= system.told[train])
        for train, body in system.bodies.items()
    )


def who_was_forgotten_is_looked_for_by_a_later_number(site: Road, system: Level) -> bool:
    """What a person had seen before does not tell of it (X3)."""
    return all(
        body.track in system.asked and body.forgotten_at <= system.asked[body.track]
        for _train, body in system.bodies.items()
        if body.forgotten
    )


def who_asks_to_start_is_known(site: Road, system: Level) -> bool:
    """The crossing knows who has asked to start, and from where, and for each of them it warns (X3)."""
    return all(train in system.crossing.starts for train in system.starting) and all(
        train in system.starting
        and system.starting[train] == run_cycles
        and train in system.crossing.asks
        and system.crossing.asks[train]
        for train, run_cycles in system.crossing.starts.items()
    )


def who_struck_out_of_contact_asks(site: Road, system: Level) -> bool:
    """Of whom a start point told, and nothing else had, that one asks for the warning (X3)."""
    return all(
        train in system.crossing.asks and system.crossing.asks[train]
        for train, body in system.bodies.items()
        if body.was_struck
    )


def before_service_nothing_happens(site: Road, system: Level) -> bool:
    """Neither a train nor a decision (X5)."""
    return system.in_service or nothing_has_happened(site, system)


def in_service_the_settings_are_lawful(site: Road, system: Level) -> bool:
    """They were checked, and do not change (X5)."""
    return not system.in_service or machine.are_lawful(site.settings)


def every_terminal_is_listened_to(site: Road, system: Level) -> bool:
    """The crossing knows how long each start point's terminal has been silent, or takes that for too long (X3)."""
    return all(
        track in system.unheard_cycles
        and track in system.crossing.silent_cycles
        and system.unheard_cycles[track] >= 0
        and (
            system.unheard_cycles[track] <= system.crossing.silent_cycles[track]
            or system.crossing.silent_cycles[track] > site.settings.silence_cycles
        )
        for track in site.tracks
    )


def every_track_is_to_be_accounted_for(site: Road, system: Level) -> bool:
    """Those of the settings, and others whose terminals were heard (X3)."""
    return not system.in_service or (
        all(track in system.crossing.unaccounted for track in site.tracks)
        and all(track in system.crossing.unaccounted for track, _cycles in system.unheard_cycles.items())
    )


def only_a_person_accounts_for_a_track(site: Road, system: Level) -> bool:
    """What the crossing takes for seen was seen since its last restart (X3)."""
    return all(unaccounted or track in system.accounted for track, unaccounted in system.crossing.unaccounted.items())


def who_was_forgotten_keeps_its_track_unaccounted(site: Road, system: Level) -> bool:
    """Nobody has seen a track empty on which there is somebody whom a restart has forgotten or missed (X3)."""
    return all(body.track not in system.accounted for _train, body in system.bodies.items() if body.forgotten)


def every_train_is_on_a_track(site: Road, system: Level) -> bool:
    """Start points lie on each (X3)."""
    return all(body.track in site.tracks for _train, body in system.bodies.items())


def an_untold_train_comes_from_its_start_point(site: Road, system: Level) -> bool:
    """Who has passed a start point untold since the restart is as far as that, less what it has run since (X3)."""
    return all(
        body.left_cycles + body.inside_cycles >= site.settings.start_cycles
        for train, body in system.bodies.items()
        if body.inside and not body.forgotten and train not in system.told
    )


def an_untold_train_is_far(site: Road, system: Level) -> bool:
    """Who has passed a start point untold since the restart did so since its terminal spoke last (X3)."""
    return all(
        body.left_cycles + system.unheard_cycles[body.track] >= site.settings.start_cycles
        for train, body in system.bodies.items()
        if body.inside and not body.forgotten and train not in system.told and body.track in system.unheard_cycles
    )


def what_is_not_warned_of_is_left(site: Road, system: Level) -> bool:
    """For each train inside, the warning and what is left last the warning time and the cycle of arrival (X2)."""
    begun_cycles = 1 if system.decided and not system.crossing.warns else 0
    return all(
        system.warned_cycles + body.left_cycles >= site.settings.warning_cycles + 1 + begun_cycles
        for _train, body in system.bodies.items()
        if body.inside
    )


def who_was_warned_of_still_asks(site: Road, system: Level) -> bool:
    """A train asks until its rear is proved past, unless a restart has forgotten it (X4)."""
    return all(
        train in system.crossing.asks and system.crossing.asks[train]
        for train, body in system.bodies.items()
        if body.has_asked and not body.forgotten
    )


def who_was_known_when_it_opened_was_far(site: Road, system: Level) -> bool:
    """What has passed since the opening, and what is left, make the least opening and a warning (X4)."""
    return all(
        system.opened_cycles + body.left_cycles >= site.settings.warning_cycles + site.settings.reopening_cycles + 2
        for _train, body in system.bodies.items()
        if body.was_known
    )


def the_crossing_counts_its_warning(site: Road, system: Level) -> bool:
    """To the cycle, if it did not restart in it (X2, X5)."""
    return (
        system.warned_cycles >= 0
        and (system.crossing.warns or system.warned_cycles == 0)
        and (system.restarted or system.crossing.warned_cycles == system.warned_cycles)
    )


def a_restart_adds_no_more_than_the_bell_to_a_warning(site: Road, system: Level) -> bool:
    """What the crossing counts of a warning is longer than the warning by that at most (X3, X5)."""
    return not system.in_service or system.crossing.warned_cycles <= system.warned_cycles + site.settings.bell_cycles


def arms_wait_no_longer_than_for_the_bell(site: Road, system: Level) -> bool:
    """They have been lowered for all of the warning but its beginning (X5)."""
    has_opened = system.decided and not system.crossing.warns
    return system.lowered_cycles >= 0 and (
        not system.in_service or has_opened or system.lowered_cycles >= system.warned_cycles - site.settings.bell_cycles
    )


def lowered_arms_are_down(site: Road, system: Level) -> bool:
    """After their time they are down, and have been since (X5)."""
    late_cycles = system.lowered_cycles - site.settings.lowering_cycles
    return not system.in_service or (
        system.down_cycles >= 0 and (late_cycles < 0 or (system.are_down and system.down_cycles >= late_cycles))
    )


INITIAL = (it_is_not_in_service,)
SAFETY = (
    warned_long_enough_before_every_arrival,
    barriers_are_down_long_enough_before_every_arrival,
    barriers_stay_down_between_close_trains,
    silence_warns,
    warning_ends_only_with_the_rear_past,
    arms_fall_after_the_bell,
    after_a_restart_arms_are_held_down,
    a_track_that_nobody_accounted_for_warns,
)
INVARIANTS = (
    *SAFETY,
    who_was_told_of_is_known,
    what_is_noted_has_its_number,
    a_train_is_noted_after_it_came,
    who_was_forgotten_is_looked_for_by_a_later_number,
    who_asks_to_start_is_known,
    who_struck_out_of_contact_asks,
    before_service_nothing_happens,
    in_service_the_settings_are_lawful,
    every_terminal_is_listened_to,
    every_track_is_to_be_accounted_for,
    only_a_person_accounts_for_a_track,
    who_was_forgotten_keeps_its_track_unaccounted,
    every_train_is_on_a_track,
    an_untold_train_comes_from_its_start_point,
    an_untold_train_is_far,
    what_is_not_warned_of_is_left,
    who_was_warned_of_still_asks,
    who_was_known_when_it_opened_was_far,
    the_crossing_counts_its_warning,
    a_restart_adds_no_more_than_the_bell_to_a_warning,
    arms_wait_no_longer_than_for_the_bell,
    lowered_arms_are_down,
)
STEPS = (
    world.put_into_service,
    world.restart,
    world.decide,
    world.run_a_cycle,
    world.arrive,
    world.come,
    world.pass_start_point,
    world.leave,
    world.part,
    world.come_to_stand,
    world.promise_to_stand,
    world.ask_to_start,
    world.let_go,
    world.make_contact,
    world.hear_strike,
    world.hear_terminal,
    world.hear_what_may_be_missed,
    world.tell_gone,
    world.release,
    world.account,
)

THEORY = Theory(
    "crossing",
    Road,
    Level,
    by_name(STEPS),
    by_name(INITIAL),
    by_name(INVARIANTS),
    by_name(SAFETY),
    quantified=True,
)
