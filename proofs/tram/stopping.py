"""What is claimed of stopping: who stands stands at that stop, and neither GPS nor jitter turns anything back (G2)."""

from __future__ import annotations

from models.measures import apart
from models.tram.stopping import (
    Ride,
    Street,
    restart,
    run_on,
    take_fix,
)
from proofs.theory import Theory, by_name

# ---- the start


def it_begins_at_a_stop(site: Street, system: Ride) -> bool:
    """The unit begins at a stop of its way, or behind it, and does not take itself to stand."""
    return (
        system.at_mm >= system.here_mm - site.limits.near_mm - site.error_mm
        and not system.stopping.left
        and not system.stopping.stands
        and system.stopping.stop == system.here
        and not system.wandered
        and not system.fell_back
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
    """The tram is at the stop that it is said to have reached, or farther on (G2)."""
    return system.at_mm >= system.here_mm - site.limits.near_mm - site.error_mm


def stops_are_counted_one_by_one(site: Street, system: Ride) -> bool:
    """The number of the stop that is told is that of the place in the table by which it was reached (G2)."""
    return system.stopping.stop == system.here


def what_was_left_is_behind(site: Street, system: Ride) -> bool:
    """The tram is beyond the stop that it is said to have left, on the line itself and not by its fixes (G2, G5)."""
    return not system.stopping.left or system.at_mm > system.here_mm


def a_standing_tram_never_seems_to_run(site: Street, system: Ride) -> bool:
    """No error of GPS moves a tram that has not moved (002, 3.1.2 and 5.1; G2)."""
    return not system.wandered


def no_tram_falls_back(site: Street, system: Ride) -> bool:
    """No fix puts a tram behind where it has been (002, 3.1.2; G2)."""
    return not system.fell_back


# ---- what it rests on


def it_began_to_stand_near_the_stop(site: Street, system: Ride) -> bool:
    """Where a tram began to stand was near, and it was not told to have left (G2)."""
    return not system.stopping.stands or (
        apart(system.stood_at_mm, system.here_mm) <= site.limits.near_mm + site.error_mm
        and system.at_mm >= system.stood_at_mm
        and not system.stopping.left
    )


INITIAL = (it_begins_at_a_stop,)
SAFETY = (
    who_stands_is_at_that_stop,
    who_stands_was_slow,
    what_was_reached_was_reached,
    stops_are_counted_one_by_one,
    what_was_left_is_behind,
    a_standing_tram_never_seems_to_run,
    no_tram_falls_back,
)
INVARIANTS = (*SAFETY, it_began_to_stand_near_the_stop)
STEPS = (run_on, take_fix, restart)

THEORY = Theory(
    "stopping",
    Street,
    Ride,
    by_name(STEPS),
    by_name(INITIAL),
    by_name(INVARIANTS),
    by_name(SAFETY),
)
