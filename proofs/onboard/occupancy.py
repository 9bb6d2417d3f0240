"""The theorem in millimetres: no two trains touch, and no point that may move is under a train (T4, T9, T10)."""

from __future__ import annotations

from models.onboard.occupancy import Occupied, Rails, a_point_stands_in_the_blocks_that_list_it, trains_move
from proofs.theory import Theory, by_name

# ---- the start


def no_train_is_on_the_line(site: Rails, system: Occupied) -> bool:
    """At the start no millimetre of rail is covered; the first movement puts trains where they stand (T8)."""
    return not any(True for train in system.covers)


# ---- safety


def no_millimetre_is_under_two_trains(site: Rails, system: Occupied) -> bool:
    """What one train covers no other covers (T4, T9)."""
    return all(
        train == other or place not in system.covers[other]
        for train in system.covers
        for place in system.covers[train]
        for other in system.covers
    )


def no_two_trains_foul_each_other(site: Rails, system: Occupied) -> bool:
    """Nor does another stand where it fouls: in a block that a block of the first one's may not be used beside (T9)."""
    return all(
        train == other or site.lies_in[beside] not in site.site.layout.fouls.get(site.lies_in[place], frozenset())
        for train in system.covers
        for place in system.covers[train]
        for other in system.covers
        for beside in system.covers[other]
    )


def no_point_under_a_train_may_move(site: Rails, system: Occupied) -> bool:
    """A point whose blades or crossing are under a train is locked (T10)."""
    return all(
        place not in system.covers[train] or (point in system.terminals and not system.terminals[point].unlocked)
        for point in site.point_at
        for place in site.point_at[point]
        for train in system.covers
    )


def what_is_covered_lies_in_a_block(site: Rails, system: Occupied) -> bool:
    """Trains are on rails of the line (T1)."""
    return all(place in site.lies_in for train in system.covers for place in system.covers[train])


INITIAL = (no_train_is_on_the_line,)
SAFETY = (
    no_millimetre_is_under_two_trains,
    no_two_trains_foul_each_other,
    no_point_under_a_train_may_move,
    what_is_covered_lies_in_a_block,
)
INVARIANTS = SAFETY
PREMISES = (a_point_stands_in_the_blocks_that_list_it,)
STEPS = (trains_move,)

THEORY = Theory(
    "occupancy",
    Rails,
    Occupied,
    by_name(STEPS),
    by_name(INITIAL),
    by_name(INVARIANTS),
    by_name(SAFETY),
    by_name(PREMISES),
    quantified=True,
)
