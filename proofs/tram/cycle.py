"""What is claimed of the polling cycle: what counts as fresh is, and what is not heard is not known (G3, G6)."""

from __future__ import annotations

from kernel.tram import cycle as machine
from models.tram.cycle import Air, Station, end_cycle, pass_time, receive, restart
from proofs.theory import Theory, by_name

# ---- the start


def nothing_was_heard(site: Station, system: Air) -> bool:
    """At the start no tram has answered."""
    return system.heard == machine.nothing_heard(system.slot) and not system.answered and not system.answered_last


# ---- safety


def what_is_fresh_is_no_older_than_11_s(site: Station, system: Air) -> bool:
    """Data that count are truly no older: 7 s (002, 2.3.4) until the next answer, and 4 s when it comes (ours; G3)."""
    return not machine.is_fresh(system.heard) or system.age_ms <= 11_000


def what_is_fresh_was_answered(site: Station, system: Air) -> bool:
    """The tram answered in this cycle or in the one before: damage, silence and strangers make nothing known (G6)."""
    return not machine.is_fresh(system.heard) or system.answered or system.answered_last


# ---- what it rests on


def what_is_known_is_no_older_than_it_says(site: Station, system: Air) -> bool:
    """The age that is kept is not below the true one (G3)."""
    return not system.heard.is_known or system.age_ms <= system.heard.age_ms


def the_tram_is_listened_to_in_its_slot(site: Station, system: Air) -> bool:
    """The station listens in the slot in which it asks the tram (G3)."""
    return system.heard.slot == system.slot


def an_answer_is_noted_in_its_cycle(site: Station, system: Air) -> bool:
    """The station has an answer in this cycle if the tram gave one, and then knows it (G3)."""
    return system.heard.in_this_cycle == system.answered and (system.heard.is_known or not system.answered)


INITIAL = (nothing_was_heard,)
SAFETY = (what_is_fresh_is_no_older_than_11_s, what_is_fresh_was_answered)
INVARIANTS = (
    *SAFETY,
    what_is_known_is_no_older_than_it_says,
    the_tram_is_listened_to_in_its_slot,
    an_answer_is_noted_in_its_cycle,
)
STEPS = (pass_time, receive, end_cycle, restart)

THEORY = Theory(
    "cycle", Station, Air, by_name(STEPS), by_name(INITIAL), by_name(INVARIANTS), by_name(SAFETY), by_name(())
)
