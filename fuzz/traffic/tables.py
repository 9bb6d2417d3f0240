"""The world's transitions as numbers: which they are, and what the words of their events mean."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, get_origin, get_type_hints

from kernel.names import (
    Block,
    Cab,
    Car,
    Epoch,
    Point,
    Position,
    Read,
    Record,
    Run,
    Tag,
    TagList,
    TerminalLife,
    Train,
    UnitLife,
)
from kernel.standstill import Standstill, ThroughLine
from proofs.transitions import TRANSITIONS, event_types

NAMES = tuple(transition.__name__ for transition in TRANSITIONS)
NUMBERS: Mapping[str, int] = {name: number for number, name in enumerate(NAMES)}
KINDS = len(NAMES)

REQUEST = NUMBERS["request"]
NOTE_CONFIRMATION = NUMBERS["note_confirmation"]
OPEN_FIRST_LOOP = NUMBERS["open_first_loop"]
NOTE_ECHO = NUMBERS["note_echo"]
RELEASE_BLOCK = NUMBERS["release_block"]
RELEASE_OVERLAP = NUMBERS["release_overlap"]
RETIRE = NUMBERS["retire"]
WITHDRAW = NUMBERS["withdraw"]
CANCEL = NUMBERS["cancel"]
NOTE_GIVEN_BACK = NUMBERS["note_given_back"]
RESTART_CENTRE = NUMBERS["restart_centre"]
NOTE_STANDING = NUMBERS["note_standing"]
RECOVER_BLOCK = NUMBERS["recover_block"]
RECOVER_POINT = NUMBERS["recover_point"]
NOTE_TERMINAL_LIFE = NUMBERS["note_terminal_life"]
ADOPT_POINT = NUMBERS["adopt_point"]
OPEN_PROCEDURE = NUMBERS["open_procedure"]
NOTE_STATEMENT = NUMBERS["note_statement"]
NOTE_STATEMENT_CONFIRMED = NUMBERS["note_statement_confirmed"]
TAKE_OFFER = NUMBERS["take_offer"]
TAKE_PERMIT = NUMBERS["take_permit"]
RECALL = NUMBERS["recall"]
GIVE_BACK = NUMBERS["give_back"]
TAKE_STANDING = NUMBERS["take_standing"]
HEAD_READS = NUMBERS["head_reads"]
WINDOW_PASSES = NUMBERS["window_passes"]
TAIL_READS = NUMBERS["tail_reads"]
NOTE_STOPPED = NUMBERS["note_stopped"]
ANSWER = NUMBERS["answer"]
RESTART_UNIT = NUMBERS["restart_unit"]
OBEY_ORDER = NUMBERS["obey_order"]
ANSWER_ENQUIRY = NUMBERS["answer_enquiry"]
LOCK = NUMBERS["lock"]
RESTART_TERMINAL = NUMBERS["restart_terminal"]
DRIFT = NUMBERS["drift"]
SEND_ORDER = NUMBERS["send_order"]
RELAY_ORDER = NUMBERS["relay_order"]
SEND_ENQUIRY = NUMBERS["send_enquiry"]
RELAY_ENQUIRY = NUMBERS["relay_enquiry"]
SEND_CONFIRMATION = NUMBERS["send_confirmation"]
RELAY_CONFIRMATION = NUMBERS["relay_confirmation"]
SEND_OFFER = NUMBERS["send_offer"]
SEND_ECHO = NUMBERS["send_echo"]
SEND_PERMIT = NUMBERS["send_permit"]
SEND_RECALL = NUMBERS["send_recall"]
SEND_RETURN = NUMBERS["send_return"]
SEND_TAIL_REPORT = NUMBERS["send_tail_report"]
SEND_STOP = NUMBERS["send_stop"]
SEND_CHALLENGE = NUMBERS["send_challenge"]
SEND_STANDING = NUMBERS["send_standing"]
SEND_STANDING_RUN = NUMBERS["send_standing_run"]
SEND_TERMINAL_LIFE = NUMBERS["send_terminal_life"]
START_ROLLING = NUMBERS["start_rolling"]
OVERRUN = NUMBERS["overrun"]
COME_TO_REST = NUMBERS["come_to_rest"]
CHANGE_ENDS = NUMBERS["change_ends"]
HEAD_MISSES = NUMBERS["head_misses"]
CAR_MOVES = NUMBERS["car_moves"]
CAR_FOLLOWS = NUMBERS["car_follows"]
CAR_LEAVES = NUMBERS["car_leaves"]
PART = NUMBERS["part"]
TAKE_OVER = NUMBERS["take_over"]
CONFIRM_STATEMENT = NUMBERS["confirm_statement"]
CORRECT_STATEMENT = NUMBERS["correct_statement"]

# ---- what a word of an event is

(
    IS_RUN,
    IS_TRAIN,
    IS_EPOCH,
    IS_UNIT_LIFE,
    IS_TERMINAL_LIFE,
    IS_BLOCK,
    IS_POINT,
    IS_POSITION,
    IS_TAG,
    IS_RECORD,
    IS_TAG_LIST,
    IS_CAR,
    IS_CAB,
    IS_BOOL,
    IS_MM,
    IS_BLOCKS,
) = range(16)
_TYPES: Mapping[Any, tuple[int, ...]] = {
    Run: (IS_RUN,),
    Train: (IS_TRAIN,),
    Epoch: (IS_EPOCH,),
    UnitLife: (IS_UNIT_LIFE,),
    TerminalLife: (IS_TERMINAL_LIFE,),
    Block: (IS_BLOCK,),
    Point: (IS_POINT,),
    Position: (IS_POSITION,),
    Tag: (IS_TAG,),
    TagList: (IS_TAG_LIST,),
    Record: (IS_RECORD,),
    Read: (IS_TAG, IS_RECORD),
    Car: (IS_CAR,),
    Cab: (IS_CAB,),
    bool: (IS_BOOL,),
    int: (IS_MM,),
    **{
        sensed: tuple(IS_BOOL if kind is bool else IS_MM for kind in get_type_hints(sensed).values())
        for sensed in (Standstill, ThroughLine)
    },
}


def word_types(kind: int, block_words: int) -> tuple[int, ...]:
    """What each word of an event of this kind is; a set of blocks has ``block_words``."""
    found: list[int] = []
    for value in event_types(TRANSITIONS[kind]).values():
        found.extend((IS_BLOCKS,) * block_words if get_origin(value) is frozenset else _TYPES[value])
    return tuple(found)


MOST_WORDS = 12
"""A telegram brings no more words; a wider layout's sets of blocks need more of them."""

ARRIVALS: tuple[tuple[str, str, tuple[int, ...], int], ...] = (
    ("relay_order", "radio_orders", (1, 2), 0),
    ("obey_order", "radio_relayed_orders", (1, 2), 0),
    ("relay_enquiry", "radio_enquiries", (1, 2), 0),
    ("answer_enquiry", "radio_relayed_enquiries", (1, 2), 0),
    ("relay_confirmation", "radio_confirmed", (1, 2), 0),
    ("note_confirmation", "radio_confirmations", (1, 2), 0),
    ("adopt_point", "radio_confirmations", (1, 2), 0),
    ("take_offer", "radio_offers", (), 0),
    ("note_echo", "radio_echoes", (), 0),
    ("take_permit", "radio_permits", (), 0),
    ("recall", "radio_recalls", (), 0),
    ("note_given_back", "radio_returns", (), 0),
    ("release_overlap", "radio_stops", (), 0),
    ("take_standing", "radio_standing_runs", (), 0),
    ("note_terminal_life", "radio_terminal_lives", (0,), 1),
    ("note_standing", "radio_standings", (0, 1), 2),
    ("note_statement", "radio_statements", (0, 1), 2),
    ("note_statement_confirmed", "radio_confirmed_statements", (0, 1), 2),
)
"""How a telegram arrives: the transition, the set it is in, and the words for the set's axes and its bits."""
