"""What is claimed of a promised ceiling: the crossing never reckons with less than the train may run (X2)."""

from __future__ import annotations

from models.crossing import promise as world
from models.crossing.promise import Line, Promising
from proofs.theory import Theory, by_name


def nothing_is_promised(site: Line, system: Promising) -> bool:
    """At the start the train has promised nothing, and nothing was told or acknowledged (X2)."""
    return (
        system.speed_mm_s <= site.line_mm_s
        and system.held.number == 0
        and system.held.ceiling_mm_s == site.line_mm_s
        and system.held.asked_mm_s == site.line_mm_s
        and system.noted.number == 0
        and system.noted.ceiling_mm_s == site.line_mm_s
        and system.noted.asked_mm_s == site.line_mm_s
        and all(False for _told in system.told)
        and all(False for _number in system.acknowledged)
    )


# ---- safety


def no_train_is_faster_than_the_crossing_holds_it_to_be(site: Line, system: Promising) -> bool:
    """Whatever is lost, late, repeated or forgotten (X2)."""
    return system.speed_mm_s <= system.noted.ceiling_mm_s


# ---- what it rests on


def the_train_keeps_its_ceiling(site: Line, system: Promising) -> bool:
    """It is no faster than what it holds to (X2)."""
    return system.speed_mm_s <= system.held.ceiling_mm_s


def the_crossing_holds_it_to_no_less(site: Line, system: Promising) -> bool:
    """Than what the train holds to (X2)."""
    return system.held.ceiling_mm_s <= system.noted.ceiling_mm_s


def nobody_is_promised_or_asked_beyond_the_line(site: Line, system: Promising) -> bool:
    """What is asked for is no less than the ceiling, and no more than the line's, which counts without promise (X2)."""
    return (
        system.held.ceiling_mm_s <= system.held.asked_mm_s <= site.line_mm_s
        and system.noted.ceiling_mm_s <= system.noted.asked_mm_s
        and (
            system.noted.number != 0
            or (system.noted.ceiling_mm_s == site.line_mm_s and system.noted.asked_mm_s == site.line_mm_s)
        )
        and all(told.ceiling_mm_s <= told.asked_mm_s <= site.line_mm_s for told in system.told)
    )


def numbers_are_the_trains(site: Line, system: Promising) -> bool:
    """No number is noted, told or acknowledged that the train has not made (X2)."""
    return (
        0 <= system.noted.number <= system.held.number
        and all(0 <= told.number <= system.held.number for told in system.told)
        and all(0 <= number <= system.held.number for number in system.acknowledged)
    )


def what_is_noted_under_a_number_is_what_is_asked_under_it(site: Line, system: Promising) -> bool:
    """A number stands for one ask (X2)."""
    return (system.noted.number != system.held.number or system.noted.asked_mm_s == system.held.asked_mm_s) and all(
        told.number != system.held.number or told.asked_mm_s == system.held.asked_mm_s for told in system.told
    )


def what_is_told_and_not_yet_noted_is_no_less(site: Line, system: Promising) -> bool:
    """Than what the train holds to: by what is newer than what was noted the crossing is not misled (X2)."""
    return all(
        system.held.ceiling_mm_s <= (told.asked_mm_s if told.number in system.acknowledged else told.ceiling_mm_s)
        for told in system.told
        if told.number > system.noted.number
    )


def only_what_is_heard_first_may_have_been_acknowledged(site: Line, system: Promising) -> bool:
    """Before the crossing started; what is told after something else was made after that start (X3)."""
    return all(
        other.number not in system.acknowledged
        for other in system.told
        if other.number > system.noted.number
        and (system.noted.number != 0 or any(one.number < other.number for one in system.told))
    )


def what_was_acknowledged_is_noted(site: Line, system: Promising) -> bool:
    """While an acknowledgement can still be heard the crossing holds the train to no less than was asked (X2).

    One from before a start as well: then this ask was noted since, as if acknowledged, or the train told nothing else.
    """
    return system.held.number not in system.acknowledged or (
        system.held.asked_mm_s <= system.noted.ceiling_mm_s
        and (
            system.noted.number == system.held.number
            or (system.noted.number == 0 and all(told.number == system.held.number for told in system.told))
        )
    )


INITIAL = (nothing_is_promised,)
SAFETY = (no_train_is_faster_than_the_crossing_holds_it_to_be,)
INVARIANTS = (
    *SAFETY,
    the_train_keeps_its_ceiling,
    the_crossing_holds_it_to_no_less,
    nobody_is_promised_or_asked_beyond_the_line,
    numbers_are_the_trains,
    what_is_noted_under_a_number_is_what_is_asked_under_it,
    what_is_told_and_not_yet_noted_is_no_less,
    only_what_is_heard_first_may_have_been_acknowledged,
    what_was_acknowledged_is_noted,
)
STEPS = (
    world.run,
    world.lower,
    world.ask,
    world.tell,
    world.hear_promise,
    world.acknowledge,
    world.hear_acknowledgement,
    world.restart_crossing,
)

THEORY = Theory(
    "promise",
    Line,
    Promising,
    by_name(STEPS),
    by_name(INITIAL),
    by_name(INVARIANTS),
    by_name(SAFETY),
    quantified=True,
)
