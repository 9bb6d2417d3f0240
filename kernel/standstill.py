"""A train at rest, and whole, as the machines on board know it: what it may tell of itself rests on this (T8, T9)."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Standstill:
    """What the odometry says of a train that may have come to rest (P7).

    ``known``: a range is claimed; if not, the rest says nothing.
    ``front_least_mm``, ``front_most_mm``: the front is between these, on the kilometrage of the tag list.
    ``speed_least_mm_s``, ``speed_most_mm_s``: so is the speed; below 0 the train may roll back.
    ``standstill_mm_s``: certainly no faster than this, either way, the train counts as standing (T12).
    ``braked_cycles``: for how many cycles on end its brake has been commanded, counted up to its response.
    ``response_cycles``: the brake holds the train once it has been commanded for so many (T12).
    ``releasable``: an acknowledgement releases it; if not, it is withheld until an end of authority is taken (T4).
    """

    known: bool
    front_least_mm: int
    front_most_mm: int
    speed_least_mm_s: int
    speed_most_mm_s: int
    standstill_mm_s: int
    braked_cycles: int
    response_cycles: int
    releasable: bool


@dataclass(frozen=True)
class ThroughLine:
    """What the unit knows of the way to its tail, from the machines that watch it (引通し線; T3, T13, P5).

    ``answers``: the tail's signal comes back over the line.
    ``is_intact``: split detection has seen no part of the train move unlike the other (`kernel.onboard.split`), its
    tail was not found a false one, and it was not measured as another than is written.
    ``fits``: head and tail antenna read the same tags as far apart as the train is long
    (`kernel.onboard.antenna_spacing`).
    """

    answers: bool
    is_intact: bool
    fits: bool


def stands(at: Standstill) -> bool:
    """Tell whether the train certainly stands (P7)."""
    return at.known and -at.standstill_mm_s <= at.speed_least_mm_s and at.speed_most_mm_s <= at.standstill_mm_s


def moves(at: Standstill) -> bool:
    """Tell whether the train certainly moves, forward or back (P7)."""
    return at.known and (at.speed_least_mm_s > at.standstill_mm_s or at.speed_most_mm_s < -at.standstill_mm_s)


def is_braked(at: Standstill) -> bool:
    """Tell whether the brake has been on for as long as it takes to respond (T12)."""
    return at.braked_cycles >= at.response_cycles


def is_held(at: Standstill) -> bool:
    """Tell whether the train certainly stands, and its brake holds it there (T8, T12)."""
    return stands(at) and is_braked(at)


def stays_held(at: Standstill) -> bool:
    """Tell whether it holds the train there until an end of authority is taken, whoever acknowledges (T4, T8, T12)."""
    return is_held(at) and not at.releasable


def is_held_between(at: Standstill, begin_mm: int, end_mm: int) -> bool:
    """Tell whether the train's brake certainly holds it with its front between two places (P7, T12)."""
    return is_held(at) and begin_mm <= at.front_least_mm and at.front_most_mm <= end_mm


def is_whole(line: ThroughLine) -> bool:
    """Tell whether nothing says that the train has parted (T3, P5)."""
    return line.answers and line.is_intact


def reaches_tail(line: ThroughLine) -> bool:
    """Tell whether an antenna that reads is the train's last: it is whole, and the antennas are where they are (T2)."""
    return is_whole(line) and line.fits
