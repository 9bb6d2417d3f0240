"""What is claimed of stopping: who stands stands at that stop, and neither GPS nor jitter turns anything back (G2)."""

from __future__ import annotations

from models.measures import apart
from models.tram.stopping import (
    Ride,
    Street,
    come_round,
    restart,
    run_on,
    take_fix,
    turn_off,
    turn_onto,
)
from proofs.theory import Theory, by_name

# ---- the start


def it_begins_at_a_stop(site: Street, system: Ride) -> bool:
    """The unit begins at a stop of its way, or behind it, or set to another way; it has seen nothing of either."""
    return (
        (system.is_astray or system.at_mm >= system.here_mm - site.limits.near_mm - site.error_mm)
        and not system.stopping.left
        and not system.stopping.stands
        and not system.stopping.is_followed
        and not system.stopping.has_run
        and not system.has_place
        and system.stopping.stop == system.here
        and not system.wandered
        and not system.fell_back
        and not system.is_unset
        and system.was_lost
        and system.has_begun
    )


# ---- safety


def who_stands_is_at_that_stop(site: Street, system: Ride) -> bool:
    """A tram that counts as standing was, at its last fix, where places are held, within the error of GPS (G2)."""
    return not system.stopping.stands or (
        apart(system.fixed_at_mm, system.here_mm) <= site.limits.held_mm + site.error_mm
    )


def who_stands_was_slow(site: Street, system: Ride) -> bool:
    """And was below 5 km/h when that was told: the paper's threshold (002, 3.1.2), rounded up to whole mm/s (G2)."""
    return not system.stopping.stands or system.speed_mm_s < 1_389 + site.speed_error_mm_s


def what_was_reached_was_reached(site: Street, system: Ride) -> bool:
    """On the way that is set the tram is at the stop that it is said to have reached, or farther on (G2)."""
    return system.is_astray or system.is_unset or system.at_mm >= system.here_mm - site.limits.near_mm - site.error_mm


def stops_are_counted_one_by_one(site: Street, system: Ride) -> bool:
    """The number of the stop that is told is that of the place in the table by which it was reached (G2)."""
    return system.stopping.stop == system.here


def what_was_left_is_behind(site: Street, system: Ride) -> bool:
    """The tram is beyond the stop that it is said to have left, on the line itself and not by its fixes (G2, G5)."""
    return not system.stopping.left or system.is_astray or system.is_unset or system.at_mm > system.here_mm


def beside_the_way_only_what_was_left_on_it_is_told(site: Street, system: Ride) -> bool:
    """A tram beside the way tells of a stop that it has left only if it was beyond it where it turned off (G2)."""
    return not (system.stopping.left and system.is_astray) or system.is_unset or (system.turned_mm > system.here_mm)


def who_has_begun_leaves_no_stop_beside_the_way(site: Street, system: Ride) -> bool:
    """One that was set there, or seen to run back, or was lost and then told of a stop, tells of none left (G3, G5)."""
    return not (system.stopping.left and system.is_astray and system.has_begun)


def who_tells_of_a_run_before_has_left_a_stop(site: Street, system: Ride) -> bool:
    """On the way a unit that was not set anew tells of the run before only that it has left a stop (G2, ours)."""
    return not system.is_unset or system.stopping.left


def a_standing_tram_never_seems_to_run(site: Street, system: Ride) -> bool:
    """No error of GPS moves a tram that has not moved (002, 3.1.2 and 5.1; G2)."""
    return not system.wandered


def no_tram_falls_back(site: Street, system: Ride) -> bool:
    """No fix puts a tram behind where it has been, on the way that is set (002, 3.1.2; G2)."""
    return not system.fell_back


def none_is_told_far_beyond(site: Street, system: Ride) -> bool:
    """On the way or beside it no tram is told to have reached a stop beyond where it was seen, but for errors (G2)."""
    return (
        not system.has_place
        or system.stopping.stop == 0
        or system.fixed_at_mm >= system.here_mm - site.limits.held_mm - site.error_mm
    )


def who_has_left_a_stop_has_not_run_back(site: Street, system: Ride) -> bool:
    """On the way or beside it a tram that tells of a stop that it left was, where it had a place, about foremost (G2).

    It was no farther back than where it was farthest since it told so, but for the difference of the two limits for
    stops, and two errors: one that is beside the way, and runs back there, begins anew.
    """
    run_back_mm = system.farthest_mm - system.fixed_at_mm
    return not (system.stopping.left and system.has_place) or (
        run_back_mm <= site.limits.held_mm - site.limits.near_mm + 2 * site.error_mm
    )


# ---- what it rests on


def who_has_left_a_stop_was_seen_beyond(site: Street, system: Ride) -> bool:
    """The greatest place that a tram was told since it left a stop is beyond that one, and not near it (G2)."""
    return not system.stopping.left or system.stopping.most_mm > system.here_mm + site.limits.near_mm


def what_is_farthest_was_told(site: Street, system: Ride) -> bool:
    """Where a tram was farthest since it left a stop its unit was told a place, within the error of GPS (G2)."""
    return not system.stopping.left or system.stopping.most_mm >= system.farthest_mm - site.error_mm


def on_the_way_none_was_seen_farther_on(site: Street, system: Ride) -> bool:
    """A tram on the way that is set is no farther back than it was seen since it left a stop, but for errors (G2)."""
    return (
        not system.stopping.left
        or system.is_astray
        or system.is_unset
        or system.stopping.most_mm <= system.at_mm + site.error_mm
    )


def it_began_to_stand_near_the_stop(site: Street, system: Ride) -> bool:
    """Where a tram began to stand was near, and it was not told to have left (G2)."""
    return not system.stopping.stands or (
        apart(system.stood_at_mm, system.here_mm) <= site.limits.near_mm + site.error_mm and not system.stopping.left
    )


def who_was_seen_to_run_has_not_lost_the_way(site: Street, system: Ride) -> bool:
    """No tram on another way than is set is seen to run over a stop of that one, once lost or put back there (G2)."""
    return not (system.stopping.has_run and system.is_astray and system.was_lost)


def who_is_astray_was_seen_no_farther_back(site: Street, system: Ride) -> bool:
    """Beside a way that it is not on a tram was seen no farther back since it had no place, or was put back (G2)."""
    return not (system.is_astray and system.was_lost and system.stopping.is_followed) or (
        system.stopping.least_mm >= system.at_mm - site.error_mm
    )


def the_unit_knows_whether_it_has_had_a_place(site: Street, system: Ride) -> bool:
    """What was seen is forgotten with the first fix without a place (G2)."""
    return system.stopping.is_followed == system.has_place


def who_has_turned_off_was_no_farther_on(site: Street, system: Ride) -> bool:
    """Until it has no place, or is put back, one that has turned off is no farther along the way than there (G2)."""
    return not system.is_astray or system.was_lost or system.at_mm <= system.turned_mm


def who_has_no_place_has_lost_the_way(site: Street, system: Ride) -> bool:
    """A tram beside the way whose last fix had no place is lost there, wherever it was taken (G2)."""
    return not system.is_astray or system.has_place or system.was_lost


def who_was_seen_to_run_has_a_place(site: Street, system: Ride) -> bool:
    """That a tram was seen to run over a stop is forgotten with the first fix without a place (G2)."""
    return system.has_place or not system.stopping.has_run


def who_has_begun_has_lost_the_way(site: Street, system: Ride) -> bool:
    """Beside the way a unit has begun only since it had no place, or was set or put back (G2)."""
    return system.was_lost or not system.has_begun


def a_way_is_not_run_before_its_first_stop(site: Street, system: Ride) -> bool:
    """Nor by a tram whose unit is not set anew (G2)."""
    return (
        not system.is_unset or system.is_astray or system.at_mm >= site.first_mm - site.limits.near_mm - site.error_mm
    )


INITIAL = (it_begins_at_a_stop,)
SAFETY = (
    who_stands_is_at_that_stop,
    who_stands_was_slow,
    what_was_reached_was_reached,
    stops_are_counted_one_by_one,
    what_was_left_is_behind,
    beside_the_way_only_what_was_left_on_it_is_told,
    who_has_begun_leaves_no_stop_beside_the_way,
    who_tells_of_a_run_before_has_left_a_stop,
    a_standing_tram_never_seems_to_run,
    no_tram_falls_back,
    none_is_told_far_beyond,
    who_has_left_a_stop_has_not_run_back,
)
INVARIANTS = (
    *SAFETY,
    it_began_to_stand_near_the_stop,
    who_was_seen_to_run_has_not_lost_the_way,
    who_has_turned_off_was_no_farther_on,
    who_has_no_place_has_lost_the_way,
    who_was_seen_to_run_has_a_place,
    who_has_begun_has_lost_the_way,
    a_way_is_not_run_before_its_first_stop,
    who_is_astray_was_seen_no_farther_back,
    the_unit_knows_whether_it_has_had_a_place,
    who_has_left_a_stop_was_seen_beyond,
    what_is_farthest_was_told,
    on_the_way_none_was_seen_farther_on,
)
STEPS = (run_on, come_round, turn_onto, turn_off, take_fix, restart)

THEORY = Theory(
    "stopping",
    Street,
    Ride,
    by_name(STEPS),
    by_name(INITIAL),
    by_name(INVARIANTS),
    by_name(SAFETY),
)
