"""What goes wrong on a simulated line, as data: how often, how long, and the lawful way out.

All of these are within the assumptions of the proofs.  Which of them come, and how often, a file may say: a table a
fault, ``[unit_restart]``, with ``rate``, ``least`` and ``most`` where they are to differ, and ``at_s`` for certain
times.  A fault that the file does not name does not come.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from random import Random
from typing import Any, Literal

from models.layouts.results import BadInput
from models.simulation.tables import number_of, tables_of

Per = Literal["telegram", "tag", "order", "train hour", "point hour", "crossing hour", "hour"]
MOST_TIMES = 1_000


@dataclass(frozen=True)
class Fault:
    """One way in which things go wrong.

    ``rate``: its chance a telegram or a tag, else how often an hour, ``per`` train, point, crossing or line.
    ``least`` to ``most``: how long or how large, in ``unit``; 0 where it has no size.
    ``way_out``: what staff and system do, lawfully, until traffic runs again.
    """

    name: str
    says: str
    per: Per
    rate: float
    unit: str
    least: float
    most: float
    way_out: str

    @property
    def is_share(self) -> bool:
        """Whether the rate is a chance each time; such a fault has no times of its own."""
        return self.per in ("telegram", "tag", "order")


TELLS_ANEW = "it brakes, tells at rest in a new life where it stands, and goes on by the rest of its route"

FAULTS: tuple[Fault, ...] = (
    Fault("radio_loss", "a telegram is lost", "telegram", 0.05, "s", 0, 0, "it is sent again"),
    Fault(
        "radio_delay", "a telegram comes late", "telegram", 0.02, "s", 2, 30,
        "it is refused as too old, or as overtaken, and sent again",
    ),
    Fault(
        "radio_repetition", "a telegram comes once more", "telegram", 0.02, "s", 0.1, 4,
        "nothing: it is refused as repeated, or as too old",
    ),
    Fault(
        "radio_corruption", "bits of a telegram are turned round", "telegram", 0.03, "bits", 1, 60,
        "few are mended; with many it is refused, and sent again",
    ),
    Fault(
        "radio_forgery", "a stranger sends a telegram with a wrong key, throws one back, or takes it elsewhere",
        "telegram", 0.003, "s", 0, 0, "nothing: it is refused",
    ),
    Fault(
        "radio_replay", "a stranger sends an old telegram again, of an earlier session if there was one",
        "telegram", 0.003, "s", 0, 0, "nothing: it is refused",
    ),
    Fault(
        "radio_outage", "a train is out of coverage", "train hour", 0.4, "s", 20, 180,
        "it runs to the end of its authority; its reports come when there is coverage again",
    ),
    Fault("tag_missed_head", "the head antenna passes a tag and reads nothing", "tag", 0.002, "s", 0, 0, TELLS_ANEW),
    Fault(
        "tag_missed_tail", "the tail antenna passes a tag and reads nothing", "tag", 0.003, "s", 0, 0,
        "what it left stays held; at rest it tells in a new life where it stands",
    ),
    Fault("tag_foreign", "the head reads a tag that is on no plan", "tag", 0.001, "s", 0, 0, TELLS_ANEW),
    Fault(
        "wheel_slip", "the wheel slips or slides, up to 6 m/s off", "train hour", 1.0, "s", 1, 8,
        "the inertial sensor carries on; the next tag narrows the range",
    ),
    Fault(
        "tachometer_silent", "the tachometer gives nothing", "train hour", 0.2, "s", 1, 20,
        "the inertial sensor carries on; where the range gets too wide it stops and is located anew",
    ),
    Fault(
        "inertial_silent", "the inertial sensor gives nothing", "train hour", 0.2, "s", 1, 20,
        "the range widens by what motors and brakes can do; the next tag narrows it",
    ),
    Fault(
        "line_broken", "the through line does not reach the tail", "train hour", 0.3, "s", 10, 120,
        "what it left meanwhile stays held; at rest it tells in a new life where it stands",
    ),
    Fault("unit_restart", "an on-board unit restarts", "train hour", 0.1, "s", 0, 0, TELLS_ANEW),
    Fault(
        "centre_restart", "the centre restarts", "hour", 0.3, "s", 0, 0,
        "everything is lost; every train stops, tells where it stands, and all is found again",
    ),
    Fault(
        "terminal_restart", "a point's terminal restarts", "point hour", 0.05, "s", 0, 0,
        "the centre hears its new life and orders again",
    ),
    Fault(
        "point_undetected", "the contacts of a point show nothing as an order comes", "order", 0.05, "s", 0, 0,
        "a locked point stays locked, and the order comes again",
    ),
    Fault(
        "point_stuck", "a point does not reach its position", "point hour", 0.1, "s", 10, 120,
        "it moves when it is freed; the route is set later, or withdrawn",
    ),
    Fault(
        "train_parts", "a coupling breaks and the rear stays behind", "train hour", 0.02, "s", 0, 0,
        "it stops; two persons state where all of it stands (supervised release), and again once it is taken off",
    ),
    Fault("stop_on_line", "a train stops anywhere", "train hour", 0.3, "s", 20, 120, "it goes on under its authority"),
    Fault(
        "route_cancelled", "the signaller wants a set route back", "train hour", 0.2, "s", 0, 0,
        "a train that stands short of it gives it back; one that has entered runs it",
    ),
    Fault(
        "start_point_silent", "the terminal of a crossing's start points is not heard", "crossing hour",
        0.3, "s", 1, 120, "the road is closed until it is heard; every strike is told first then",
    ),
    Fault(
        "crossing_radio_silent", "a crossing's radio hears no train", "crossing hour", 0.3, "s", 3, 300,
        "the road is closed for the trains that it knew, until they are heard again and past; others strike",
    ),
)  # fmt: skip
"""Rates are ours, and high: an hour shows most of them."""

BY_NAME: Mapping[str, Fault] = {fault.name: fault for fault in FAULTS}


@dataclass(frozen=True)
class Setting:
    """How a fault comes in one simulation; ``at_s``: at these times beside its rate."""

    rate: float
    least: float
    most: float
    at_s: tuple[float, ...] = ()


Chosen = Mapping[str, Setting]
EVERY_FAULT: Chosen = {fault.name: Setting(fault.rate, fault.least, fault.most) for fault in FAULTS}
NO_FAULT: Chosen = {}


def happens(fault: str, chosen: Chosen, random: Random, seen: Counter[str]) -> bool:
    """Draw whether a fault of single telegrams, tags or orders comes now, if it is chosen, and count it."""
    so = fault in chosen and random.random() < chosen[fault].rate
    seen[fault] += so
    return so


def read_faults(path: Path) -> Chosen:
    """Read which faults come, and how.

    Raises:
        BadInput: the file cannot be read, names no fault of the table, or gives a number that cannot be.
    """
    return {name: _setting(str(path), name, value) for name, value in tables_of(path).items()}


def _setting(file: str, name: str, given: Any) -> Setting:
    """One table of the file."""
    if name not in BY_NAME:
        raise BadInput(file, f"'{name}'", "there is no such fault", f"name some of {', '.join(BY_NAME)}")
    if not isinstance(given, dict):
        raise BadInput(file, f"'{name}'", "is not a table", f"write [{name}]")
    fault = BY_NAME[name]
    usual = {"rate": fault.rate, "least": fault.least, "most": fault.most}
    for key in given:
        if key not in (*usual, "at_s"):
            raise BadInput(file, f"'{name}.{key}'", "there is no such key", "use rate, least, most or at_s")
    numbers = {key: number_of(file, f"'{name}.{key}'", given.get(key, number)) for key, number in usual.items()}
    if fault.is_share and numbers["rate"] > 1:
        raise BadInput(file, f"'{name}.rate'", f"{numbers['rate']:g} is no chance", "give a number from 0 to 1")
    if numbers["least"] > numbers["most"]:
        raise BadInput(file, f"'{name}.least'", "is above 'most'", f"give {fault.unit} from the least to the most")
    return Setting(**numbers, at_s=_times(file, fault, given.get("at_s", [])))


def _times(file: str, fault: Fault, given: Any) -> tuple[float, ...]:
    place = f"{fault.name}.at_s"
    if not isinstance(given, list) or len(given) > MOST_TIMES:
        raise BadInput(file, f"'{place}'", "is not a list of times", f"give at most {MOST_TIMES} in s, as [600.0]")
    if given and fault.is_share:
        raise BadInput(file, f"'{place}'", f"comes by its chance a {fault.per}", "give its rate")
    return tuple(number_of(file, f"'{place}'", each) for each in given)
