"""What is claimed of a start point's terminal: no strike is put down to a train that did not make it (X3, T14)."""

from __future__ import annotations

from kernel.crossing import start_point as machine
from models.crossing import start_point as world
from models.crossing.start_point import AtStartPoint, Place
from proofs.theory import Theory, by_name

# ---- the start


def it_is_not_in_service(site: Place, system: AtStartPoint) -> bool:
    """At the start the settings are not checked, nobody is before the detector, and nothing was told (X3)."""
    return (
        not system.in_service
        and not system.has_power
        and system.passed_cycles == 0
        and system.struck_cycles == 0
        and not system.is_before
        and system.missed == 0
        and not system.told.is_any
    )


# ---- safety


def a_strike_is_put_down_to_who_made_it(site: Place, system: AtStartPoint) -> bool:
    """Or it is told by a name that nobody has had; whatever was told late, again, or of another track (X3, T14)."""
    return not system.told.is_any or system.told.name == system.told.by or system.told.name == system.told.new


def a_strike_that_was_missed_is_told_of(site: Place, system: AtStartPoint) -> bool:
    """While any strike without power is untold the terminal owes it to the crossing, once it has power (X3, T14)."""
    return system.missed == 0 or not system.has_power or system.point.owes


# ---- what it rests on


def in_service_the_settings_are_lawful(site: Place, system: AtStartPoint) -> bool:
    """They were checked, and do not change (X3)."""
    return not system.in_service or machine.are_lawful(site.settings)


def the_terminal_counts_from_the_last_strike(site: Place, system: AtStartPoint) -> bool:
    """Or from its start, which was later (X3)."""
    return system.struck_cycles >= 0 and (not system.has_power or system.point.struck_cycles <= system.struck_cycles)


def who_has_struck_did_so_after_the_tag(site: Place, system: AtStartPoint) -> bool:
    """The detector lies beyond the tag (X3)."""
    return system.passed_cycles >= 0 and (system.is_before or system.struck_cycles <= system.passed_cycles)


def what_waits_is_of_who_is_before_the_detector(site: Place, system: AtStartPoint) -> bool:
    """And waits no longer than another train needs to come there (X3, T14)."""
    return (
        not system.has_power
        or system.point.left_cycles <= 0
        or (
            system.is_before
            and system.point.reader == system.last
            and system.passed_cycles + system.point.left_cycles
            <= site.settings.told_cycles + site.settings.waits_cycles
        )
    )


INITIAL = (it_is_not_in_service,)
SAFETY = (a_strike_is_put_down_to_who_made_it, a_strike_that_was_missed_is_told_of)
INVARIANTS = (
    *SAFETY,
    in_service_the_settings_are_lawful,
    the_terminal_counts_from_the_last_strike,
    who_has_struck_did_so_after_the_tag,
    what_waits_is_of_who_is_before_the_detector,
)
STEPS = (
    world.put_into_service,
    world.lose_power,
    world.restart,
    world.pass_tag,
    world.hear_read,
    world.strike,
    world.strike_without_power,
    world.tell_what_may_be_missed,
    world.run_a_cycle,
)

THEORY = Theory(
    "start_point",
    Place,
    AtStartPoint,
    by_name(STEPS),
    by_name(INITIAL),
    by_name(INVARIANTS),
    by_name(SAFETY),
)
