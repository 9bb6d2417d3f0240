"""A local line without track circuits, as the simulation has it: places, registered sections, bounds (A1 to A6).

The paper names such lines (Hachikō and Iiyama, 004, 5) and no figures of them.  What stands here is of that kind, ours,
and was written before the first figure was made.  Down and up trains pass each other anywhere, as on double track:
that is worse for a handset than trains that wait for one another.
"""

from __future__ import annotations

from kernel.alarm.distance import AlarmBounds
from kernel.alarm.sections import NoUse, Reason, Section
from kernel.alarm.tone import Freshness, Register, Train

KM = 1_000_000
LENGTH_MM = 40 * KM
STATIONS_MM = (0, 4_600_000, 9_800_000, 15_200_000, 20_300_000, 25_100_000, 30_000_000, 35_200_000, LENGTH_MM)
"""Every 5 km, as on such lines."""
STATIONS = ("Asano", "Kuroi", "Hatta", "Minami", "Tokiwa", "Oyama", "Sakai", "Nozawa", "Iida")
"""Made up."""
STATION_MM = 300_000
"""So far to either side of its middle the display shows a station as a stretch of its own; between two stations the
whole of the line is one stretch, since there are no track circuits (004, 1)."""
TUNNELS_MM = ((11_600_000, 13_600_000), (27_000_000, 27_600_000))
"""Where there is no GPS: a long and a short tunnel (004, 4.1)."""
ZONE_MM = 400_000
"""Zones A and B: 15 s at the line's speed, so that five messages fall into it (004, 4.1, figure 6; length ours)."""
YARD_MM = (20_000_000, 20_600_000)
"""A station where cars are coupled and parted (004, 4.2)."""
SIDING_MM = (34_850_000, 35_550_000)
"""A station where a train is stabled with its engine off (004, 4.3)."""

REGULAR = 32
"""Regular trains of a day, numbered from 0; then the unit that shunts, then the one that is stabled."""
SHUNTER, STABLED = REGULAR, REGULAR + 1
TRAINS = REGULAR + 2
SIDING = 3


def name(number: int) -> Train:
    """Give the train's name, which is a number in compiled code."""
    return number  # type: ignore[return-value]


def section(number: int) -> Section:
    """Give the section's name, which is a number in compiled code."""
    return number  # type: ignore[return-value]


BOUNDS = AlarmBounds(
    # 85 km/h are the most on such lines; 97 leave a margin of an eighth for the clocks by which ages are told.
    train_mm_s=27_000,
    # Nobody walks faster beside a track than 7 km/h.
    worker_mm_s=2_000,
    # Three cars of 20 m.
    length_mm=60_000,
    # GPS without correction errs by some 10 m; conversion to kilometrage adds to it (engineering practice).
    train_error_mm=20_000,
    worker_error_mm=15_000,
    # A driver changes ends in no less.
    turning_ms=30_000,
)
"""All ours, the paper names none."""
FRESH = Freshness(
    # Five, four and four periods of the paper's (004, 3.1, 3.2) may be lost on the mobile network.
    fix_ms=10_000,
    display_ms=12_000,
    server_ms=8_000,
    # Five of the handset's own.
    worker_ms=5_000,
)
REGISTER = Register(
    BOUNDS,
    FRESH,
    # 2 s of delay until the display has followed a train that is as fast as the line allows, and its overhang.
    display_error_mm=100_000,
    # That, and the errors of GPS.
    tolerance_mm=150_000,
    sections={
        section(0): NoUse(Reason.WITHOUT_GPS, TUNNELS_MM[0][0] - ZONE_MM, TUNNELS_MM[0][1] + ZONE_MM, ZONE_MM),
        section(1): NoUse(Reason.WITHOUT_GPS, TUNNELS_MM[1][0] - ZONE_MM, TUNNELS_MM[1][1] + ZONE_MM, ZONE_MM),
        section(2): NoUse(Reason.SHUNTING, *YARD_MM, 0),
        section(SIDING): NoUse(Reason.STABLING, *SIDING_MM, 0),
    },
    stabled=frozenset({(name(STABLED), section(SIDING))}),
    ways={},
    openings={},
    edition=1,
)
"""The line with its sections; trains and sections are numbered, as compiled code needs it."""

PARAMETERS = {
    "stations": "every 5 km, 40 km of line (ours, typical of the lines the paper names)",
    "trains": f"{REGULAR} a day, one an hour each way, 40 to 60 m long, 60 to 85 km/h (ours, typical)",
    "driving": "0.6 m/s² up, 0.7 m/s² down; 30 to 60 s at stations; late by 2 min at the mean (engineering practice)",
    "fixes": "every 1 s, sent every 2 s; the display every 3 s; the worker's every 1 s (paper, 3.1 and 3.2)",
    "GPS": "off by 6 m at one deviation, correlated over 20 s, 20 m at the most; worker 5 m and 15 m (practice)",
    "mobile network": "0.3 to 1 s, one message of 20 up to 3 s; ages are counted from the fix (practice)",
    "display": "shows stations, and all between two of them as one stretch; follows within 2 s (ours)",
    "tunnels": "2 km and 0.6 km, zones A and B of 400 m (ours; the paper draws them without lengths)",
}
"""What decides, and where it is from."""
