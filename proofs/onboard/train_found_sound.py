"""What was found of one train: nothing of it is forgotten, and nothing is found of itself, without its staff (T3, T12).

A start forgets; what it forgets counts as found.
"""

from __future__ import annotations

from kernel.onboard import computer
from kernel.standstill import is_braked, is_whole
from models.onboard.train_nature import Train, Whole, watched, watched_over
from proofs.onboard import brake_watch

# ---- the start


def nobody_has_inspected_its_brake(site: Train, system: Whole) -> bool:
    """Nor its motors: whether they had broken a bound is not known (T8, T12)."""
    return system.watched.watch.broken and not system.watched.inspected


# ---- safety


def no_brake_counts_as_sound_before_it_was_inspected(site: Train, system: Whole) -> bool:
    """Since the computer began: that a bound was broken is not forgotten by switching it off and on (T8, T12)."""
    return brake_watch.no_brake_counts_as_sound_before_it_was_inspected(watched_over(site), watched(system))


def a_brake_found_wanting_holds_nobody(site: Train, system: Whole) -> bool:
    """Who has broken a bound of motors or brake, or rolled back too far, is not told to be held (T8, T12)."""
    known = system.computer.known
    return not is_braked(computer.standstill(site.limits, system.computer)) or (
        not known.watch.broken and not known.movement.reversed
    )


def no_train_is_whole_before_it_was_found_so(site: Train, system: Whole) -> bool:
    """Since its computer was started staff has found it whole, or it counts as split: it may have been (P5, T8)."""
    return system.trailing.is_preset or system.computer.known.wholeness.split


def a_train_that_was_found_split_is_not_whole(site: Train, system: Whole) -> bool:
    """Until staff has found it whole (P5)."""
    line = computer.through_line(site.limits, system.computer, True)
    return not system.computer.known.wholeness.split or not is_whole(line)


def a_train_whose_tail_was_a_false_one_is_not_whole(site: Train, system: Whole) -> bool:
    """Once another antenna was caught speaking for its tail, until staff has found the train whole (T3, T13)."""
    return not system.trailing.caught or not is_whole(computer.through_line(site.limits, system.computer, True))


SAFETY = (
    no_brake_counts_as_sound_before_it_was_inspected,
    a_brake_found_wanting_holds_nobody,
    no_train_is_whole_before_it_was_found_so,
    a_train_that_was_found_split_is_not_whole,
    a_train_whose_tail_was_a_false_one_is_not_whole,
)
