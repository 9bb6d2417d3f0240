"""What is claimed of a register's ways: no track is shorter than they are (A1)."""

from __future__ import annotations

from dataclasses import replace

from kernel.alarm import limits
from models.alarm.alarm_network import Tracks, Walk, begin, cross, load, walk_on
from models.alarm.along import told_far_um
from models.measures import UM_A_MM, apart
from proofs.theory import Theory, by_name

# ---- the start


def nothing_was_loaded(site: Tracks, system: Walk) -> bool:
    """At the start no register is loaded, and no walk has begun."""
    return not system.is_accepted and not system.is_under_way


# ---- safety


def no_track_is_shorter_than_the_registers_ways(site: Tracks, system: Walk) -> bool:
    """From where lines join, by any tracks, it is no nearer to any place than over a connection there (A1).

    Unless it is farther than that matters.
    """
    return (
        not system.is_accepted
        or not system.is_under_way
        or system.walked_um > told_far_um(site.register)
        or any(
            connection.to_mm == system.start_mm
            and apart(system.at_um, UM_A_MM * connection.from_mm) + UM_A_MM * connection.between_mm <= system.walked_um
            for _way, connection in system.ways.items()
        )
    )


# ---- what it rests on


def what_is_accepted_is_lawful(site: Tracks, system: Walk) -> bool:
    """A register is loaded only if the kernel finds that it may be used (A1)."""
    return not system.is_accepted or limits.is_lawful(replace(site.register, ways=system.ways), site.joins)


INITIAL = (nothing_was_loaded,)
SAFETY = (no_track_is_shorter_than_the_registers_ways,)
INVARIANTS = (*SAFETY, what_is_accepted_is_lawful)
STEPS = (load, begin, walk_on, cross)

THEORY = Theory(
    "alarm_network",
    Tracks,
    Walk,
    by_name(STEPS),
    by_name(INITIAL),
    by_name(INVARIANTS),
    by_name(SAFETY),
    quantified=True,
)
