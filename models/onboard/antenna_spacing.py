"""A train that may come apart, the antennas of its ends, and the tags that both read (T13, T3).

Places are on the line's kilometrage, where trains are in nm as in ``models.onboard.odometry``.  A tag's number is
unique, and the machine only asks whether two numbers are equal; so here a tag is numbered by the place where it truly
lies, in mm, and any other numbering would be the same to the machine.  A line on which a train comes by the same
tag again without turning round, a circle, is outside this world.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.onboard import antenna_spacing as machine
from kernel.onboard.antenna_spacing import Spacing, SpacingLimits
from kernel.onboard.way import Way
from models.onboard.units import NM_A_MM

FARTHEST_KNOWN_MM = 1_000_000_000
"""The odometry claims no place beyond 1,000 km from where the line begins."""
REMEMBERED = 8
"""Tags lie in pairs at each boundary (T2), and four boundaries may lie within one train (T13; ours)."""


@dataclass(frozen=True)
class Track:
    """What does not change (T13, T16).

    ``limits``: as written.
    ``tag``: one tag, any one, that history looks at.
    ``antenna_mm``: how far behind the front the head's antenna is.
    ``read_within_mm``: how far from a tag an antenna may read it: half its read window.
    ``preset_error_mm``: how far a preset antenna distance may be from the true one.
    """

    limits: SpacingLimits
    tag: int
    antenna_mm: int
    read_within_mm: int
    preset_error_mm: int


@dataclass(frozen=True)
class Trailing:
    """One moment of a train and its two antennas.

    ``spacing``: what the machine knows.
    ``front_nm``: where its front is.
    ``apart_nm``: how far behind the head's antenna is the one that speaks for the tail.
    The rest is history, since the distance was preset or the unit restarted.
    ``is_preset``: staff has preset it since the unit started.
    ``whole``: it was preset, and the antenna for the tail is still the same, and where it was.
    ``forward``: since it was preset the train has run forward alone, and has not rolled back by anything.
    ``head_newest``: the tag that the head has read last, of any number before the first.
    ``head_has_read``: the head has read the one tag; ``since``: as many others since, not counting the same
    twice running; by the odometry it was between ``least_mm`` and ``most_mm`` then, if that was known at all.
    ``tail_has_read``: the tail has read some tag; ``tail_is_on``: the last was the one tag.
    ``tail_came_after``: and the head had read that tag before.
    ``tail_nm``: how far apart the two antennas were at the tail's newest read.
    ``caught``: a tail that was false has read the one tag, which was among the head's last eight, where the
    odometry knew the way between as well as is written; or the head has read it after the tail.
    """

    spacing: Spacing
    front_nm: int
    apart_nm: int
    is_preset: bool
    whole: bool
    forward: bool
    head_newest: int
    head_has_read: bool
    since: int
    known: bool
    least_mm: int
    most_mm: int
    tail_has_read: bool
    tail_is_on: bool
    tail_came_after: bool
    tail_nm: int
    caught: bool


# ---- premises


def the_tolerance_covers_preset_and_read_window(site: Track) -> bool:
    """The written tolerance is at least the error of presetting and the antennas' read window together (T3, T16)."""
    return site.preset_error_mm >= 0 and site.preset_error_mm + 2 * site.read_within_mm <= site.limits.tolerance_mm


# ---- where the antennas are


def head_nm(site: Track, system: Trailing) -> int:
    """Give where the head's antenna is."""
    return system.front_nm - NM_A_MM * site.antenna_mm


def tail_nm(site: Track, system: Trailing) -> int:
    """Give where the one is that speaks for the tail."""
    return head_nm(site, system) - system.apart_nm


# ---- assumptions


def a_tag_is_read_in_the_read_window(site: Track, antenna_nm: int, uid: int) -> bool:
    """An antenna reads a tag only near the place where the one tag of this number lies (paper 000, 5; T1, T16)."""
    return -NM_A_MM * site.read_within_mm <= antenna_nm - NM_A_MM * uid <= NM_A_MM * site.read_within_mm


def the_odometer_contains_the_way(front_nm: int, at: Way) -> bool:
    """A range that the odometry claims contains the front; what it proves of itself (P7)."""
    return not at.known or NM_A_MM * at.least_mm <= front_nm <= NM_A_MM * at.most_mm


def the_preset_is_near(site: Track, system: Trailing, preset_mm: int) -> bool:
    """The distance is measured at a supervised place, within its error (paper 000, 3.5; T3)."""
    off_nm = NM_A_MM * preset_mm - system.apart_nm
    return -NM_A_MM * site.preset_error_mm <= off_nm <= NM_A_MM * site.preset_error_mm


def the_antennas_lie_apart(site: Track, apart_nm: int) -> bool:
    """A whole train is so long that no tag is in the windows of both its antennas (T3, T16)."""
    return apart_nm > 2 * NM_A_MM * site.read_within_mm


# ---- what happens


def run(site: Track, system: Trailing, to_nm: int) -> Trailing:
    """The train runs on, or back (T13)."""
    return replace(system, front_nm=to_nm, forward=system.forward and to_nm >= system.front_nm)


def come_apart(site: Track, system: Trailing, apart_nm: int) -> Trailing:
    """From now on another antenna speaks for the tail, or the same farther behind: split, stretched, miswired (T3).

    Anywhere, even ahead of the head's.
    """
    return replace(system, apart_nm=apart_nm, whole=False)


def is_false(site: Track, system: Trailing) -> bool:
    """Tell whether the tail is farther from the preset distance than could pass unseen (T13)."""
    return is_off(site, system.apart_nm - NM_A_MM * system.spacing.preset_mm)


def is_off(site: Track, off_nm: int) -> bool:
    """Tell whether a distance is off by more than tolerance, read windows and width together (T13)."""
    unseen_nm = NM_A_MM * (site.limits.tolerance_mm + 2 * site.read_within_mm + site.limits.width_mm)
    return off_nm > unseen_nm or off_nm < -unseen_nm


def is_told(at: Way) -> bool:
    """Tell whether the odometry claims a place within its own limits."""
    return at.known and -FARTHEST_KNOWN_MM <= at.least_mm <= at.most_mm <= FARTHEST_KNOWN_MM


def can_be_compared(site: Track, system: Trailing, uid: int, at: Way) -> bool:
    """Tell whether the tail reads the one tag, and how far the train has run since the head read it is known."""
    return (
        uid == site.tag
        and system.head_has_read
        and system.since < REMEMBERED
        and system.known
        and is_told(at)
        and at.most_mm - at.least_mm + system.most_mm - system.least_mm <= site.limits.width_mm
    )


def head_reads(site: Track, system: Trailing, uid: int, at: Way) -> Trailing:
    """The head antenna reads a tag; the odometry tells where the train is (T13)."""
    antenna_nm = head_nm(site, system)
    if not a_tag_is_read_in_the_read_window(site, antenna_nm, uid):
        return system
    if not the_odometer_contains_the_way(system.front_nm, at):
        return system
    ours = uid == site.tag
    return replace(
        system,
        spacing=machine.note_head_read(system.spacing, uid, at),
        head_newest=uid,
        head_has_read=system.head_has_read or ours,
        since=0 if ours else (system.since if uid == system.head_newest else system.since + 1),
        known=is_told(at) if ours else system.known,
        least_mm=at.least_mm if ours else system.least_mm,
        most_mm=at.most_mm if ours else system.most_mm,
        caught=system.caught or (ours and system.tail_is_on and not system.tail_came_after),
    )


def tail_reads(site: Track, system: Trailing, uid: int, at: Way) -> Trailing:
    """The antenna that speaks for the tail reads a tag (T13)."""
    antenna_nm = tail_nm(site, system)
    if not a_tag_is_read_in_the_read_window(site, antenna_nm, uid):
        return system
    if not the_odometer_contains_the_way(system.front_nm, at):
        return system
    return replace(
        system,
        spacing=machine.note_tail_read(site.limits, system.spacing, uid, at),
        tail_has_read=True,
        tail_is_on=uid == site.tag,
        tail_came_after=system.head_has_read,
        tail_nm=system.apart_nm,
        caught=system.caught or (can_be_compared(site, system, uid, at) and is_false(site, system)),
    )


def preset(site: Track, system: Trailing, preset_mm: int) -> Trailing:
    """Staff makes up the train, finds it whole, and presets the antenna distance; supervised (T3)."""
    if not the_preset_is_near(site, system, preset_mm):
        return system
    if not the_antennas_lie_apart(site, system.apart_nm):
        return system
    return replace(begun(system), spacing=machine.preset(preset_mm), is_preset=True, whole=True, forward=True)


def turn(site: Track, system: Trailing, front_nm: int) -> Trailing:
    """The train changes ends, or is found to be elsewhere: tags lie otherwise ahead of it; nobody presets it anew (T3).

    What was caught before is not forgotten.
    """
    return replace(
        begun(system),
        spacing=machine.turned(system.spacing),
        front_nm=front_nm,
        is_preset=system.is_preset,
        whole=system.whole,
        caught=system.caught,
    )


def restart(site: Track, system: Trailing) -> Trailing:
    """The unit restarts; what was found before is still to be known (T13, T8)."""
    return replace(begun(system), spacing=machine.restarted())


def begun(system: Trailing) -> Trailing:
    """Begin the history anew."""
    return replace(
        system,
        is_preset=False,
        whole=False,
        head_newest=0,
        head_has_read=False,
        since=0,
        known=False,
        least_mm=0,
        most_mm=0,
        tail_has_read=False,
        tail_is_on=False,
        tail_came_after=False,
        caught=False,
    )
