"""A run that is wanted back is freed at last, if its train has not entered it (T9)."""

from __future__ import annotations

from kernel.cancellation import asks_back
from kernel.first_loop import is_followed
from kernel.names import Run
from kernel.standstill import Standstill
from models.world import at_the_centre, on_board, radio
from models.world.assumptions import a_head_runs_no_farther_than_its_brake_lets_it
from models.world.state import Site, System
from models.world.truth import says_it_is_held
from proofs.promise import Link, Promise
from proofs.promises.vocabulary import can_be_told, lives, order_of


def a_run_wanted_back_is_freed(site: Site, system: System, run: Run) -> bool:
    """The centre asks no more for a run that it wants back: it is over, and holds nothing.

    Or, before it is given back, its train has entered it or the unit restarts (T9).
    """
    order = order_of(system, run)
    return not asks_back(system.centre, run) or (
        run not in system.radio.returns
        and (not lives(system, run.train, run.life) or (order is not None and order.begun))
    )


def it_is_wanted_back(site: Site, system: System, run: Run) -> bool:
    """The centre wants the run back; the train may not even have its tags."""
    return can_be_told(system, run)


def its_tags_are_on_the_way(site: Site, system: System, run: Run) -> bool:
    """The tag list was sent; only a run that the unit knows can be given back."""
    return can_be_told(system, run) and run in system.radio.offers


def it_is_known_on_board(site: Site, system: System, run: Run) -> bool:
    """The unit knows the run."""
    return order_of(system, run) is not None


def its_recall_is_in_the_air(site: Site, system: System, run: Run) -> bool:
    """The train was asked to give the run back."""
    return order_of(system, run) is not None and run in system.radio.recalls


def it_is_recalled(site: Site, system: System, run: Run) -> bool:
    """The unit knows that the run is wanted back."""
    order = order_of(system, run)
    return order is not None and order.recalled


def its_brake_keeps_it_out(
    site: Site, system: System, run: Run, at: Standstill, held_end_mm: int, start_end_mm: int
) -> bool:
    """The train stands before the run's blocks, its brake holds it and an end there, and no later run leads on."""
    return (
        says_it_is_held(at)
        and at.front_most_mm <= start_end_mm
        and held_end_mm <= start_end_mm
        and a_head_runs_no_farther_than_its_brake_lets_it(system, run, at, held_end_mm, start_end_mm)
        and run.train in system.units
        and not is_followed(site.lists, system.units[run.train], run)
    )


def it_is_given_back(site: Site, system: System, run: Run) -> bool:
    """The unit has given the run back, and says so."""
    order = order_of(system, run)
    return order is not None and order.given_back


def its_return_is_in_the_air(site: Site, system: System, run: Run) -> bool:
    """The acknowledgement was sent."""
    return run in system.radio.returns


PROMISES = (
    Promise(
        (
            Link(it_is_wanted_back, radio.send_offer),
            Link(its_tags_are_on_the_way, on_board.take_offer),
            Link(it_is_known_on_board, radio.send_recall),
            Link(its_recall_is_in_the_air, on_board.recall),
            Link(it_is_recalled, on_board.give_back, its_brake_keeps_it_out),
            Link(it_is_given_back, radio.send_return),
            Link(its_return_is_in_the_air, at_the_centre.note_given_back),
        ),
        a_run_wanted_back_is_freed,
    ),
)
"""The one that there is."""
