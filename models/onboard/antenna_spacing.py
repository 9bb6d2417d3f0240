"""A train that may come apart, the antennas of its ends, and the tags that both read (T13, T3).

Places are in mm on the line's kilometrage: of the head antenna, and of tags.  A tag's number is unique, and
the machine only asks whether two numbers are equal; so here a tag is numbered by the place where it truly
lies, and any other numbering would be the same to the machine.  A line on which a train comes by the same
tag again without turning round, a circle, is outside this world.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.onboard import antenna_spacing as machine
from kernel.onboard.antenna_spacing import Spacing, SpacingLimits
from kernel.onboard.arithmetic import magnitude
from kernel.onboard.way import Way, between


@dataclass(frozen=True)
class Track:
    """What does not change (T13, T16).

    ``limits``: as written.
    ``tag``: one tag, any one, that history looks at.
    ``read_mm``: how long an antenna's read window is; a tag is read in it, half before and half behind.
    ``preset_error_mm``: how far a preset antenna distance may be from the true one.
    ``error_mm``: how wide the odometry's range of a place may be.
    """

    limits: SpacingLimits
    tag: int
    read_mm: int
    preset_error_mm: int
    error_mm: int


@dataclass(frozen=True)
class Trailing:
    """One moment of a train and its two antennas.

    ``spacing``: what the machine knows.
    ``head_mm``: the head antenna; ``apart_mm``: how far behind it is the antenna that speaks for the tail.
    The rest is history, since the distance was preset or the unit restarted.
    ``whole``: it was preset, and the antenna for the tail is still the same, and where it was.
    ``head_has_read``: the head has read the one tag.
    ``tail_mm``: how far apart the two antennas were at the tail's newest read.
    ``caught``: a tail that was false has read a tag whose read by the head was remembered; or the
    head has read a tag after the tail.
    """

    spacing: Spacing
    head_mm: int
    apart_mm: int
    whole: bool
    head_has_read: bool
    tail_mm: int
    caught: bool


# ---- premises


def the_tolerance_covers_preset_and_read_window(site: Track) -> bool:
    """The written tolerance is at least the error of presetting and the antennas' read window together (T3, T16)."""
    return site.preset_error_mm + site.read_mm <= site.limits.tolerance_mm


# ---- assumptions


def a_tag_is_read_in_the_read_window(site: Track, antenna_mm: int, uid: int) -> bool:
    """An antenna reads a tag only near the place where the one tag of this number lies (paper 000, 5; T1, T16)."""
    return 2 * magnitude(antenna_mm - uid) <= site.read_mm


def the_odometer_contains_the_way(system: Trailing, at: Way) -> bool:
    """A range that the odometry claims contains the place of the train; what it proves of itself (P7)."""
    return not at.known or at.least_mm <= system.head_mm <= at.most_mm


def the_odometer_is_fine_enough(site: Track, at: Way) -> bool:
    """A range that the odometry claims is no wider than the error reckoned with, which fixes at tags bound (P1, P7)."""
    return not at.known or at.most_mm - at.least_mm <= site.error_mm


def the_train_runs_forward(system: Trailing, to_mm: int) -> bool:
    """Between two presets the train runs one way; to turn round it changes ends, and is preset anew (P1, T3)."""
    return to_mm >= system.head_mm


def the_preset_is_near(site: Track, system: Trailing, preset_mm: int) -> bool:
    """The distance is measured at a supervised place, within its error (paper 000, 3.5; T3)."""
    return magnitude(preset_mm - system.apart_mm) <= site.preset_error_mm


def the_antennas_lie_apart(site: Track, apart_mm: int) -> bool:
    """A whole train is so long that no tag is in the windows of both its antennas (T3, T16)."""
    return apart_mm > site.read_mm


# ---- what happens


def run(site: Track, system: Trailing, to_mm: int) -> Trailing:
    """The train runs on (T13)."""
    if not the_train_runs_forward(system, to_mm):
        return system
    return replace(system, head_mm=to_mm)


def come_apart(site: Track, system: Trailing, apart_mm: int) -> Trailing:
    """From now on another antenna speaks for the tail, or the same farther behind: split, stretched, miswired (T3).

    Anywhere, even ahead of the head's.
    """
    return replace(system, apart_mm=apart_mm, whole=False)


def is_false(site: Track, system: Trailing) -> bool:
    """Tell whether the tail is farther from the preset distance than could pass unseen (T13)."""
    return (
        magnitude(system.apart_mm - system.spacing.preset_mm)
        > site.limits.tolerance_mm + site.read_mm + 2 * site.error_mm
    )


def head_reads(site: Track, system: Trailing, uid: int, at: Way) -> Trailing:
    """The head antenna reads a tag; the odometry tells where the train is (T13)."""
    if not a_tag_is_read_in_the_read_window(site, system.head_mm, uid):
        return system
    if not the_odometer_contains_the_way(system, at) or not the_odometer_is_fine_enough(site, at):
        return system
    spacing = machine.note_head_read(system.spacing, uid, at)
    return replace(
        system,
        spacing=spacing,
        head_has_read=system.head_has_read or uid == site.tag,
        caught=system.caught or (system.spacing.tail_read and system.spacing.tail_uid == uid),
    )


def tail_reads(site: Track, system: Trailing, uid: int, at: Way) -> Trailing:
    """The antenna that speaks for the tail reads a tag (T13)."""
    if not a_tag_is_read_in_the_read_window(site, system.head_mm - system.apart_mm, uid):
        return system
    if not the_odometer_contains_the_way(system, at) or not the_odometer_is_fine_enough(site, at):
        return system
    spacing = machine.note_tail_read(site.limits, system.spacing, uid, at)
    remembered = between(machine.place_of_read(system.spacing.reads, uid), at).known
    return replace(
        system,
        spacing=spacing,
        tail_mm=system.apart_mm,
        caught=system.caught or (remembered and is_false(site, system)),
    )


def preset(site: Track, system: Trailing, preset_mm: int) -> Trailing:
    """Staff makes up the train, finds it whole, and presets the antenna distance; supervised (T3)."""
    if not the_preset_is_near(site, system, preset_mm):
        return system
    if not the_antennas_lie_apart(site, system.apart_mm):
        return system
    return replace(begun(system), spacing=machine.preset(preset_mm), whole=True)


def turn(site: Track, system: Trailing, head_mm: int, apart_mm: int) -> Trailing:
    """The train changes ends or line, and is made up anew; the distance is not preset yet (T3)."""
    return replace(begun(system), spacing=machine.restarted(), head_mm=head_mm, apart_mm=apart_mm)


def restart(site: Track, system: Trailing) -> Trailing:
    """The unit restarts; what was found before is still to be known (T13, T8)."""
    return replace(begun(system), spacing=machine.restarted())


def begun(system: Trailing) -> Trailing:
    """Begin the history anew."""
    return replace(system, whole=False, head_has_read=False, caught=False)
