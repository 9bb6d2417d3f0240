"""The faults of a day of trams as data, each with its range and its chance; and what is always so (G3, G6)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from models.tram.line import CLOSE_S, OPEN_S, STOPS, TRAMS

NEVER_S = 10**7


@dataclass(frozen=True)
class Fault:
    """One thing that goes wrong on some days: what, how long or how much (from, to, unit), and why so.

    ``breaks``: the assumption that it breaks; such a fault comes only where it is asked for.
    """

    says: str
    least: float
    most: float
    unit: str
    chance: float
    why: str
    breaks: str = ""


FAULTS = {
    "canyon": Fault("GPS is lost all day along one stretch", 50, 600, "m", 0.5, "ours: high buildings on both sides"),
    "gps_outage": Fault("no tram has GPS for some time", 30, 900, "s", 0.2, "ours: corrections or satellites lost"),
    "station_deaf": Fault(
        "one station loses this share of its frames all day", 0.3, 1.0, "1", 0.5, "002, 4.2 (3): no line of sight"
    ),
    "tram_deaf": Fault("one tram's radio is dead for some hours", 1, 17, "h", 0.3, "ours: an aerial lost"),
    "centre_slow": Fault(
        "the link to the centre takes this much longer for an hour", 3, 60, "s", 0.3, "002, 5.2: up to 7 s, and worse"
    ),
    "repeats": Fault("this share of reports and orders comes once more, later", 0.01, 0.2, "1", 0.3, "ours: relays"),
    "speed_lost": Fault("one tram has no speed for some time", 60, 7_200, "s", 0.2, "ours: found by its own diagnosis"),
    "breakdown": Fault("one tram stands still for some time", 120, 1_200, "s", 0.4, "practice"),
    "heedless": Fault("one tram's driver heeds no hold", 1, 1, "1", 0.3, "ours: it is an aid"),
    "from_depot": Fault("trams come from the depot midway, so many", 1, 4, "1", 0.3, "practice: a defect is replaced"),
    "wrong_destination": Fault(
        "one tram is set to another destination", 0, 23, "stop", 0.2, "practice: a wrong setting"
    ),
    "by_hand": Fault("the dispatcher orders by hand this share of times", 0.01, 0.3, "1", 0.5, "002, 3.2"),
    "centre_restart": Fault("the centre starts anew, so many times", 1, 3, "1", 0.3, "ours: a defect, a new version"),
    "late_at_terminus": Fault(
        "this share of runs begins minutes late after it was confirmed, another one before it",
        0.05,
        0.3,
        "1",
        0.3,
        "practice: a driver who is late, trams that change places",
    ),
    "both_ways": Fault(
        "trams turn at the far terminus in so long, and come back on the other way", 120, 600, "s", 0.5, "practice"
    ),
    "junction": Fault(
        "trams of the other line come back so much later, and join at the junction", 10, 40, "min", 0.5, "practice"
    ),
    "order_from_the_future": Fault(
        "one station's clock is so far ahead, and it writes orders by that",
        20,
        3_600,
        "s",
        0.0,
        "ours: a restart",
        "the_frame_carries_the_order",
    ),
    "asked_anew": Fault(
        "so often the dispatcher asks to take up a tram that is on the way", 1, 9, "1", 0.3, "practice: a wrong number"
    ),
    "number_of_another": Fault(
        "one tram tells the number of the second one behind it for some time, and takes orders for that",
        600,
        7_200,
        "s",
        0.0,
        "practice: a wrong setting",
        "a_report_tells_where_it_is",
    ),
    "wrong_way": Fault(
        "so often a unit starts anew under way, and is set to the other way for minutes, now and then too soon",
        1,
        9,
        "1",
        0.3,
        "practice: a wrong setting",
    ),
}
"""By name, in the order in which they are drawn."""
DRAWN_APART = ("both_ways", "junction")
"""What else is drawn of a day is the same with these and without."""
DRAWN_ALONE = ("order_from_the_future", "asked_anew", "number_of_another", "wrong_way")
"""And so it is with each of these, where it is too: further ones stand at the end."""

FRAMES_LOST = (0.0, 0.1)
"""From, to: the share of frames lost at any station, of each day.  Practice: low-power radio with line of sight."""


def alone(apart: np.random.Generator) -> dict[str, np.random.Generator]:
    """Give a source of its own to each fault that is drawn alone; it takes nothing from ``apart``."""
    return dict(zip(DRAWN_ALONE, apart.spawn(len(DRAWN_ALONE)), strict=True))


def draw(
    chance: np.random.Generator,
    apart: np.random.Generator,
    own: Mapping[str, np.random.Generator],
    present: frozenset[str] | None = None,
    beyond: frozenset[str] = frozenset(),
) -> dict[str, float]:
    """Draw a day's faults; 0 is none.  ``present``: those that the day has instead, whatever the chance.

    ``own``: as :func:`alone` gives it.  ``beyond``: those that the day has besides.
    """
    drawn = {}
    for name, fault in FAULTS.items():
        source = own.get(name, apart if name in DRAWN_APART else chance)
        has = bool(source.random() < fault.chance)
        value = float(source.uniform(fault.least, fault.most))
        is_there = name in beyond or (has if present is None else name in present)
        drawn[name] = value if is_there else 0.0
    return drawn


class Where(NamedTuple):
    """Where and when a day's faults are: stops, trams, and seconds of the day; compiled code takes it as it is."""

    canyon_mm: int
    outage_s: int
    station: int
    deaf_tram: int
    deaf_s: int
    slow_s: int
    speed_tram: int
    speed_s: int
    broken_tram: int
    broken_s: int
    heedless_tram: int
    depot_s: int
    destination_tram: int
    frames_lost: float
    restart_s: int
    ahead_station: int
    anew_s: int
    number_tram: int
    number_s: int
    wrong_place: int
    wrong_s: int


def place(chance: np.random.Generator, own: Mapping[str, np.random.Generator], line_mm: int) -> Where:
    """Draw where and when; ``own``: as :func:`alone` gives it."""

    def second(source: np.random.Generator = chance) -> int:
        return int(source.integers(OPEN_S, CLOSE_S))

    def tram(source: np.random.Generator = chance) -> int:
        return int(source.integers(0, TRAMS // 2))

    return Where(
        canyon_mm=int(chance.integers(0, line_mm)),
        outage_s=second(),
        station=int(chance.integers(1, STOPS - 1)),
        deaf_tram=tram(),
        deaf_s=second(),
        slow_s=second(),
        speed_tram=tram(),
        speed_s=second(),
        broken_tram=tram(),
        broken_s=second(),
        heedless_tram=tram(),
        depot_s=second(),
        destination_tram=tram(),
        frames_lost=float(chance.uniform(*FRAMES_LOST)),
        restart_s=second(),
        ahead_station=int(own["order_from_the_future"].integers(0, STOPS - 1)),
        anew_s=second(own["asked_anew"]),
        number_tram=tram(own["number_of_another"]),
        number_s=second(own["number_of_another"]),
        wrong_place=tram(own["wrong_way"]),
        wrong_s=second(own["wrong_way"]),
    )
