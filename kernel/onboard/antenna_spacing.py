"""Antenna spacing: head and tail read the same tag one antenna distance apart (T13, T3).

What the tail antenna reads proves something only if it is the train's last antenna.  After a split the
rear cab of what remains may pose as the tail; it follows the head too closely.  So every read of the
tail is held against the head's read of the same tag, by the odometry between them and the preset
distance (paper 000, 3.5.2); only then does it count.

Ours: a train may be longer than the ways between its tags, so the head's last eight reads are
remembered: tags lie in pairs, so that is four boundaries within one train.  To remember only the nearest
would leave the tail's other reads unchecked.  A read that cannot be compared, or only by a way known worse
than is written, makes the line not healthy, until one can be; one that does not fit, or comes before the
head's, is latched until staff presets the distance anew.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.onboard.way import UNKNOWN, Way, between, is_within_width


@dataclass(frozen=True)
class SpacingLimits:
    """The written limits, 0 or more (T13, T16).

    ``tolerance_mm``: how far from the preset distance the way between the two reads of a tag may be: the
    error of presetting, and the read window (513 mm: half of it at either antenna).
    ``width_mm``: how wide the odometry's range of that way may be for the two reads to be compared.
    """

    tolerance_mm: int
    width_mm: int


@dataclass(frozen=True)
class HeadRead:
    """A tag that the head has read: its number, and where the train was; unknown if there was none (T13)."""

    uid: int
    at: Way


NOTHING_READ = HeadRead(uid=0, at=UNKNOWN)


@dataclass(frozen=True)
class HeadReads:
    """The head's last eight reads, the newest first (T13)."""

    first: HeadRead
    second: HeadRead
    third: HeadRead
    fourth: HeadRead
    fifth: HeadRead
    sixth: HeadRead
    seventh: HeadRead
    eighth: HeadRead


@dataclass(frozen=True)
class Spacing:
    """What is known of the two antennas (T3, T13).

    ``preset_mm``: from the head antenna to the tail antenna.
    ``reads``: of the head, since it was preset.
    ``tail_read``, ``tail_uid``: the tail has read since then, and this tag last.
    ``checked``: that read could be compared.  ``broken``: latched; one did not fit, or tail came before head.
    """

    preset_mm: int
    reads: HeadReads
    tail_read: bool
    tail_uid: int
    checked: bool
    broken: bool


def preset(preset_mm: int) -> Spacing:
    """Begin with the antenna distance that staff has preset: at a system boundary, after coupling, splitting (T3)."""
    return Spacing(
        preset_mm=preset_mm,
        reads=HeadReads(
            first=NOTHING_READ,
            second=NOTHING_READ,
            third=NOTHING_READ,
            fourth=NOTHING_READ,
            fifth=NOTHING_READ,
            sixth=NOTHING_READ,
            seventh=NOTHING_READ,
            eighth=NOTHING_READ,
        ),
        tail_read=False,
        tail_uid=0,
        checked=False,
        broken=False,
    )


def turned(spacing: Spacing) -> Spacing:
    """Begin after a change of ends, or at another place: what was read counts no more, a false tail stays one (T3)."""
    return replace(preset(spacing.preset_mm), broken=spacing.broken)


def restarted() -> Spacing:
    """Begin after a restart: the distance, and whether it fitted, are forgotten (T13, T8)."""
    return replace(preset(0), broken=True)


def place_of_read(reads: HeadReads, uid: int) -> Way:
    """Give where the train was when the head read a tag last; unknown if it is not remembered (T13)."""
    if reads.first.uid == uid:
        return reads.first.at
    if reads.second.uid == uid:
        return reads.second.at
    if reads.third.uid == uid:
        return reads.third.at
    if reads.fourth.uid == uid:
        return reads.fourth.at
    if reads.fifth.uid == uid:
        return reads.fifth.at
    if reads.sixth.uid == uid:
        return reads.sixth.at
    if reads.seventh.uid == uid:
        return reads.seventh.at
    if reads.eighth.uid == uid:
        return reads.eighth.at
    return UNKNOWN


def with_newest(reads: HeadReads, newest: HeadRead) -> HeadReads:
    """Put a read in front and drop the oldest; the same tag again, as at a standstill, is one read (T13)."""
    if newest.uid == reads.first.uid:
        return replace(reads, first=newest)
    return HeadReads(
        first=newest,
        second=reads.first,
        third=reads.second,
        fourth=reads.third,
        fifth=reads.fourth,
        sixth=reads.fifth,
        seventh=reads.sixth,
        eighth=reads.seventh,
    )


def note_head_read(spacing: Spacing, uid: int, at: Way) -> Spacing:
    """Remember a tag that the head has read, and where the train is; the tail must not have been there first (T13).

    A tail whose read was held against an earlier one of the head's was not: the train has come round on a loop.
    """
    tail_came_first = spacing.tail_read and spacing.tail_uid == uid and not spacing.checked
    return replace(
        spacing,
        reads=with_newest(spacing.reads, HeadRead(uid=uid, at=at)),
        broken=spacing.broken or tail_came_first,
    )


def fits(limits: SpacingLimits, preset_mm: int, way: Way) -> bool:
    """Tell whether the way from the head's read to the tail's may be the antenna distance (T13)."""
    return way.least_mm <= preset_mm + limits.tolerance_mm and way.most_mm >= preset_mm - limits.tolerance_mm


def note_tail_read(limits: SpacingLimits, spacing: Spacing, uid: int, at: Way) -> Spacing:
    """Hold a tag that the tail has read against the head's read of it (T3, T13)."""
    way = between(place_of_read(spacing.reads, uid), at)
    checked = way.known and is_within_width(way, limits.width_mm)
    return replace(
        spacing,
        tail_read=True,
        tail_uid=uid,
        checked=checked,
        broken=spacing.broken or (checked and not fits(limits, spacing.preset_mm, way)),
    )


def is_healthy(spacing: Spacing) -> bool:
    """Tell whether the tail's newest read was that of the train's last antenna (T13, T2)."""
    return spacing.checked and not spacing.broken
