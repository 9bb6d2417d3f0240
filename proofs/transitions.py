"""Every transition of the world, in the order of the matrix; each is a function of site, system and an event."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache
from typing import Any, get_type_hints

from models.world import at_a_point, at_the_centre, nature, on_board, radio
from models.world.state import System

Transition = Callable[..., System]

TRANSITIONS: tuple[Transition, ...] = (
    at_the_centre.request,
    at_the_centre.note_confirmation,
    at_the_centre.open_first_loop,
    at_the_centre.note_echo,
    at_the_centre.release_block,
    at_the_centre.release_overlap,
    at_the_centre.retire,
    at_the_centre.withdraw,
    at_the_centre.cancel,
    at_the_centre.note_given_back,
    at_the_centre.restart_centre,
    at_the_centre.note_standing,
    at_the_centre.recover_block,
    at_the_centre.recover_point,
    at_the_centre.note_terminal_life,
    at_the_centre.adopt_point,
    at_the_centre.open_procedure,
    at_the_centre.note_statement,
    at_the_centre.note_statement_confirmed,
    on_board.take_offer,
    on_board.take_permit,
    on_board.give_back,
    on_board.take_standing,
    on_board.head_reads,
    on_board.window_passes,
    on_board.tail_reads,
    on_board.note_stopped,
    on_board.answer,
    on_board.restart_unit,
    at_a_point.obey_order,
    at_a_point.answer_enquiry,
    at_a_point.lock,
    at_a_point.restart_terminal,
    at_a_point.drift,
    radio.send_order,
    radio.relay_order,
    radio.send_enquiry,
    radio.relay_enquiry,
    radio.send_confirmation,
    radio.relay_confirmation,
    radio.send_offer,
    radio.send_echo,
    radio.send_permit,
    radio.send_recall,
    radio.send_return,
    radio.send_tail_report,
    radio.send_stop,
    radio.send_challenge,
    radio.send_standing,
    radio.send_standing_run,
    radio.send_terminal_life,
    nature.start_rolling,
    nature.overrun,
    nature.come_to_rest,
    nature.change_ends,
    nature.head_misses,
    nature.car_moves,
    nature.car_follows,
    nature.car_leaves,
    nature.part,
    nature.take_over,
    nature.confirm_statement,
)


@cache
def event_types(function: Callable[..., Any]) -> Mapping[str, Any]:
    """Give the names and types of what a transition's event carries, or a predicate asks, beside site and system."""
    hints = get_type_hints(function)
    return {name: kind for name, kind in hints.items() if name not in ("site", "system", "return")}
