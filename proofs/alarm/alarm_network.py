"""What is claimed of a register's ways and lines: no track is shorter, and each place is of one line (A1)."""

from __future__ import annotations

from dataclasses import replace

from kernel.alarm.extents import are_surveyed, has_joins_on_lines
from kernel.alarm.least_ways import has_least_ways
from models.alarm.alarm_network import Tracks, Walk, begin, cross, is_on, leave, load, walk_on
from models.alarm.along import beyond_um, is_by_figures, told_far_um
from models.measures import UM_A_MM, apart
from proofs.theory import Theory, by_name

# ---- the start


def nothing_was_loaded(site: Tracks, system: Walk) -> bool:
    """At the start no register is loaded, and no walk has begun."""
    return not system.is_accepted and not system.is_under_way and not system.has_left


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


def what_is_told_of_a_place_is_of_one_line(site: Tracks, system: Walk) -> bool:
    """Wherever one comes to, its figure is of one line, and what is told of it is farther from all others (A1, A2).

    By at least as much again as may be told beyond the ends of those, and yet agree with what is told there.
    """
    return (
        not system.is_accepted
        or not system.is_under_way
        or any(
            is_on(extent, system.at_um)
            and all(
                other == line
                or not is_by_figures(beside.from_mm, beside.to_mm, system.at_um, 2 * beyond_um(site.register))
                for other, beside in site.lines.items()
            )
            for line, extent in site.lines.items()
        )
    )


def who_leaves_a_line_by_an_end_is_at_a_join_or_an_opening(site: Tracks, system: Walk) -> bool:
    """Where track goes on beyond the end of a line the register has another figure for it, or an opening (A1)."""
    return (
        not system.is_accepted
        or not system.has_left
        or any(
            (system.at_um == UM_A_MM * place.one_mm or system.at_um == UM_A_MM * place.other_mm)
            and place.one_mm != place.other_mm
            for _join, place in site.joins.items()
        )
        or any(system.at_um == UM_A_MM * open_mm for _opening, open_mm in site.register.openings.items())
    )


# ---- what it rests on


def who_has_left_is_no_longer_under_way(site: Tracks, system: Walk) -> bool:
    """Who has left a line by an end goes no farther (A1)."""
    return not system.has_left or not system.is_under_way


def what_is_accepted_has_the_least_ways(site: Tracks, system: Walk) -> bool:
    """A register is loaded only if the kernel finds no way in it missing or too long (A1)."""
    return not system.is_accepted or has_least_ways(replace(site.register, ways=system.ways), site.joins)


def what_is_accepted_has_surveyed_lines(site: Tracks, system: Walk) -> bool:
    """And only if each of its lines has figures of its own, and ends as written (A1)."""
    return not system.is_accepted or are_surveyed(site.register, site.joins, site.lines)


def what_is_accepted_has_its_joins_on_lines(site: Tracks, system: Walk) -> bool:
    """And only if lines have the figures of its equations (A1)."""
    return not system.is_accepted or has_joins_on_lines(site.joins, site.lines)


INITIAL = (nothing_was_loaded,)
SAFETY = (
    no_track_is_shorter_than_the_registers_ways,
    what_is_told_of_a_place_is_of_one_line,
    who_leaves_a_line_by_an_end_is_at_a_join_or_an_opening,
)
INVARIANTS = (
    *SAFETY,
    who_has_left_is_no_longer_under_way,
    what_is_accepted_has_the_least_ways,
    what_is_accepted_has_surveyed_lines,
    what_is_accepted_has_its_joins_on_lines,
)
STEPS = (load, begin, walk_on, cross, leave)

THEORY = Theory(
    "alarm_network",
    Tracks,
    Walk,
    by_name(STEPS),
    by_name(INITIAL),
    by_name(INVARIANTS),
    by_name(SAFETY),
)
