"""Everything that can go wrong with traffic, as data: what it does, how often, and whether the proof allows for it.

A trace draws for each fault whether it is present, and its rate from the named distribution.  Faults of wheels,
tachometers, IMU and GPS show here only by what the unit then says: that it does not know where it is, that a tag
came outside its window, that it is overdue.  The rides have these sensors themselves.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from fuzz.traffic.distributions import Distribution, fixed, log_uniform, uniform

Per = Literal["message", "tag", "second", "procedure", "order", "boundary", "stop"]


@dataclass(frozen=True)
class Fault:
    """One way in which things go wrong.

    ``present``: how many of all traces have it.  ``rate``: its chance ``per`` occasion, in a trace that has it.
    ``breaks``: the assumptions (``models.world.assumptions``) that are false then; none within the declared ones.
    """

    name: str
    says: str
    per: Per
    rate: Distribution
    present: float = 0.12
    breaks: tuple[str, ...] = ()

    @property
    def beyond(self) -> bool:
        """Whether it is beyond the declared assumptions."""
        return bool(self.breaks)


WITHIN: tuple[Fault, ...] = (
    Fault(
        "radio loss",
        "A telegram does not arrive, or arrives corrupt and is dropped.",
        "message",
        uniform(0.02, 0.6),
        0.3,
    ),
    Fault("radio repetition", "A telegram arrives, and once more within 2 min.", "message", log_uniform(0.01, 0.5)),
    Fault(
        "radio reordering",
        "A telegram arrives after the ones that follow within 5 s.",
        "message",
        log_uniform(0.01, 0.5),
    ),
    Fault(
        "lists mixed up",
        "A unit keeps another tag list than it was sent.",
        "message",
        log_uniform(0.005, 0.1),
    ),
    Fault("radio delay", "A telegram arrives only after 10 s to 10 min.", "message", log_uniform(0.01, 0.3)),
    Fault(
        "stale message",
        "Any telegram ever sent arrives again, of old lives and epochs too.",
        "second",
        log_uniform(0.005, 0.3),
        0.3,
    ),
    Fault("missed tag at the head", "The head antenna passes a tag and reads nothing.", "tag", log_uniform(0.002, 0.2)),
    Fault("missed tag at the tail", "The tail antenna passes a tag and reads nothing.", "tag", log_uniform(0.002, 0.2)),
    Fault("repeated tag", "An antenna reads the same tag twice.", "tag", log_uniform(0.01, 0.3)),
    Fault(
        "swapped tags", "An antenna reads the pair of a boundary in the wrong order.", "tag", log_uniform(0.002, 0.1)
    ),
    Fault("foreign tag", "An antenna reads a tag that is on no plan.", "tag", log_uniform(0.001, 0.1)),
    Fault("corrupt record", "The tail reads a tag whose record is destroyed.", "tag", log_uniform(0.002, 0.2)),
    Fault(
        "copied tag",
        "The tail reads the UID of another tag, with a record that is not that one's.",
        "tag",
        log_uniform(0.002, 0.1),
    ),
    Fault("dead antenna", "An antenna reads nothing for 1 to 10 min.", "second", log_uniform(2e-4, 1e-2)),
    Fault(
        "early tag",
        "A tag comes before its window by the odometer (slip, diameter, dropout).",
        "tag",
        log_uniform(0.001, 0.1),
    ),
    Fault(
        "late tag",
        "A tag comes after its window by the odometer (slide, diameter, dropout).",
        "tag",
        log_uniform(0.001, 0.1),
    ),
    Fault(
        "overdue tag",
        "The odometer says that the next tag is overdue (slip, drift, or the tag is gone).",
        "second",
        log_uniform(1e-4, 1e-2),
    ),
    Fault(
        "broken line", "The through line does not reach the tail for 1 to 10 min.", "second", log_uniform(2e-4, 1e-2)
    ),
    Fault(
        "place not known",
        "Odometer and GPS do not say that the train stands short, or within, though it does.",
        "stop",
        uniform(0.1, 0.9),
    ),
    Fault("unit restart", "An on-board unit restarts.", "second", log_uniform(1e-4, 1e-2)),
    Fault("centre restart", "The centre restarts.", "second", log_uniform(5e-5, 2e-3)),
    Fault(
        "terminal restart", "A point's terminal restarts, locked, throwing or idle.", "second", log_uniform(1e-4, 2e-2)
    ),
    Fault("split", "A coupling breaks; the cars behind it stay where they are.", "second", log_uniform(1e-4, 5e-3)),
    Fault("coupling", "Cars left behind are fetched, and run with their train again.", "second", fixed(0.02), 0.5),
    Fault(
        "slip into the overlap", "A train brakes too late and slips, inside its overlap.", "stop", uniform(0.05, 0.8)
    ),
    Fault("late point detection", "The contacts show the new position only later.", "order", uniform(0.05, 0.8)),
    Fault("no point detection", "The contacts show nothing as an order comes.", "order", uniform(0.05, 0.8)),
    Fault("point does not move", "The motor does not reach the position.", "order", log_uniform(0.01, 0.5)),
    Fault("point drifts", "An unlocked point moves by itself.", "second", log_uniform(1e-3, 0.1)),
    Fault(
        "cancellation",
        "The signaller wants a run back that the train has been told of.",
        "second",
        log_uniform(1e-3, 5e-2),
    ),
    Fault(
        "withdrawal",
        "The signaller takes a run back that the train has not been told of.",
        "second",
        log_uniform(1e-3, 5e-2),
    ),
    Fault(
        "absurd request",
        "A run is asked for that cannot be: no such route, an old number, another train's base.",
        "second",
        log_uniform(1e-3, 0.1),
    ),
    Fault(
        "supervised procedure",
        "Two persons account for a train though its unit could.",
        "procedure",
        uniform(0.05, 0.8),
    ),
    Fault(
        "wrong statement",
        "The first person states wrong blocks; the second does not confirm them, or the first corrects himself.",
        "procedure",
        uniform(0.1, 0.9),
        0.3,
    ),
    Fault(
        "change of ends on the line",
        "A driver stops anywhere, astride boundaries too, and changes ends; he goes back to the first, or stays.",
        "second",
        log_uniform(1e-4, 1e-2),
    ),
    Fault("stop on the line", "A train comes to rest anywhere, and goes on later.", "boundary", log_uniform(0.01, 0.3)),
    Fault(
        "plausible adversary",
        "An event of this trace happens again, with one thing in it changed or none.",
        "second",
        log_uniform(0.005, 0.5),
        0.3,
    ),
    Fault(
        "random adversary", "An event of any kind happens, with anything in it.", "second", log_uniform(0.005, 0.5), 0.3
    ),
)
"""Within the declared assumptions: none of these may ever make an invariant false."""

BEYOND: tuple[Fault, ...] = (
    Fault(
        "false point detection",
        "The contacts show the position wanted, and the point lies otherwise.",
        "order",
        uniform(0.2, 1.0),
        0.1,
        ("detection_is_true",),
    ),
    Fault(
        "read ahead of leaving",
        "The tail reads both tags of a boundary, and its car is still before it.",
        "boundary",
        log_uniform(0.02, 0.5),
        0.1,
        ("a_pair_passed_in_order_proves_the_exit",),
    ),
    Fault(
        "tag of elsewhere at the head",
        "The head reads the UID of a tag that lies elsewhere, in place of the one there.",
        "tag",
        log_uniform(0.01, 0.3),
        0.1,
        ("a_tag_is_read_where_it_lies",),
    ),
    Fault(
        "overdue too late",
        "The head misses a tag, and the tail reads before it is found overdue.",
        "tag",
        log_uniform(0.01, 0.3),
        0.1,
        ("a_missed_tag_is_overdue_before_the_tail_comes",),
    ),
    Fault(
        "line healed falsely",
        "A train has lost cars, and its through line says that it is whole.",
        "second",
        log_uniform(1e-3, 3e-2),
        0.1,
        ("a_healthy_line_reaches_the_tail",),
    ),
    Fault(
        "passed end of authority",
        "A train at rest without authority moves on into the next block.",
        "second",
        log_uniform(1e-3, 3e-2),
        0.1,
        ("a_train_obeys_its_authority",),
    ),
    Fault(
        "false standstill",
        "A train tells blocks in which it does not stand, or rolls.",
        "procedure",
        uniform(0.2, 1.0),
        0.1,
        ("a_located_train_stands_where_it_says",),
    ),
    Fault(
        "both persons err",
        "The second person confirms a statement that is wrong.",
        "procedure",
        uniform(0.2, 1.0),
        0.1,
        ("two_persons_do_not_both_err",),
    ),
    Fault(
        "falsely short of the run",
        "A train that rolls into a run says that its brake holds the end before it.",
        "boundary",
        uniform(0.05, 0.5),
        0.1,
        ("a_head_runs_no_farther_than_its_brake_lets_it",),
    ),
    Fault(
        "falsely within the destination",
        "A train that slips says that it stands in its destination.",
        "stop",
        uniform(0.2, 1.0),
        0.1,
        ("a_train_within_its_destination_is_not_beyond",),
    ),
    Fault(
        "led elsewhere",
        "A car gets to a block to which its points do not lead.",
        "boundary",
        log_uniform(0.01, 0.3),
        0.1,
        ("rails_lead",),
    ),
    Fault(
        "rolled back",
        "The last car has left a block, its antenna has read both tags there, and it rolls back into that block.",
        "boundary",
        log_uniform(0.02, 0.5),
        0.1,
        ("a_train_runs_forward_along_its_run", "rails_lead", "a_train_obeys_its_authority"),
    ),
    Fault(
        "pair read back to front",
        "The head reads the pair of a boundary in the order in which it would be read on the way back.",
        "boundary",
        log_uniform(0.02, 0.5),
        0.1,
        ("a_run_is_led_by_its_front",),
    ),
)
"""Beyond them: a trace has at most one of these, and names the assumption that it breaks."""

FAULTS: tuple[Fault, ...] = WITHIN + BEYOND
"""All of them; a fault's number is its place, and weights are given in this order."""
BEYOND_ONE_IN = 8
"""One trace in so many is drawn with a fault beyond the declared assumptions."""
_NUMBERS = {fault.name: number for number, fault in enumerate(FAULTS)}


def number(name: str) -> int:
    """The number of a fault."""
    return _NUMBERS[name]


def families() -> tuple[str, ...]:
    """The names that weights are for, in order."""
    return tuple(fault.name for fault in FAULTS)
