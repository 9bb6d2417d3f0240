"""What is claimed of one display, whatever orders come: none outlasts its time, none blocks others (G3, G6)."""

from __future__ import annotations

from models.tram.display import Cab, Shown, hear, pass_time, restart, take_place
from proofs.theory import Theory, by_name

# ---- the start


def nothing_is_shown(site: Cab, system: Shown) -> bool:
    """A unit begins with nothing shown."""
    return (
        system.display.now_ms == system.now_ms
        and system.display.made_ms == system.now_ms
        and not system.display.holds
        and not system.display.recovers
    )


# ---- safety


def what_is_shown_was_taken_lately(site: Cab, system: Shown) -> bool:
    """What a standing tram is shown it has taken no longer ago than an order counts (G3, G6)."""
    return (
        not system.display.stands
        or not (system.display.holds or system.display.recovers)
        or system.now_ms - system.taken_ms <= site.limits.order_ms
    )


def no_order_blocks_those_made_later(site: Cab, system: Shown) -> bool:
    """The last order taken is not of the future: one that is made later than now is newer (G6)."""
    return system.display.made_ms <= system.now_ms


# ---- what it rests on


def the_clock_is_right(site: Cab, system: Shown) -> bool:
    """The unit keeps GPS time (G3)."""
    return system.display.now_ms == system.now_ms


def what_is_shown_was_made_before_it_was_taken(site: Cab, system: Shown) -> bool:
    """An order that is shown was made by the time at which it was taken (G3)."""
    return not (system.display.holds or system.display.recovers) or system.display.made_ms <= system.taken_ms


INITIAL = (nothing_is_shown,)
SAFETY = (what_is_shown_was_taken_lately, no_order_blocks_those_made_later)
INVARIANTS = (*SAFETY, the_clock_is_right, what_is_shown_was_made_before_it_was_taken)
STEPS = (pass_time, take_place, hear, restart)

THEORY = Theory(
    "display", Cab, Shown, by_name(STEPS), by_name(INITIAL), by_name(INVARIANTS), by_name(SAFETY), by_name(())
)
