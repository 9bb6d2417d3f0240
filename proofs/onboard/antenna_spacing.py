"""What is claimed of the antennas' spacing: only the train's last antenna counts as its tail (T13, T3)."""

from __future__ import annotations

from kernel.onboard import antenna_spacing as machine
from kernel.onboard.antenna_spacing import HeadRead, HeadReads
from models.onboard import antenna_spacing as world
from models.onboard.antenna_spacing import (
    Track,
    Trailing,
    come_apart,
    head_reads,
    preset,
    restart,
    run,
    tail_reads,
    the_tolerance_covers_preset_and_read_window,
    turn,
)
from models.onboard.units import NM_A_MM
from proofs.theory import Theory, by_name

# ---- the start


def the_unit_has_just_started(site: Track, system: Trailing) -> bool:
    """At the start the antenna distance has yet to be preset (T3, T8)."""
    return (
        system.spacing == machine.restarted()
        and not system.is_preset
        and not system.whole
        and not system.head_has_read
        and not system.tail_has_read
        and not system.tail_is_on
        and not system.tail_came_after
        and not system.caught
    )


# ---- safety


def a_false_tail_is_found(site: Track, system: Trailing) -> bool:
    """Healthy: at the tail's newest read it was as far behind as preset, but for tolerance, window and width (T13).

    A rear cab that poses as the tail of a split train, and a train that has stretched, are beyond that.
    """
    off_nm = system.tail_nm - NM_A_MM * system.spacing.preset_mm
    return not machine.is_healthy(system.spacing) or not world.is_off(site, off_nm)


def unhealthy_is_latched(site: Track, system: Trailing) -> bool:
    """Once a false tail was compared, or tail came before head, the line is not healthy until preset anew (T13)."""
    return not system.caught or not machine.is_healthy(system.spacing)


def healthy_only_after_a_check(site: Track, system: Trailing) -> bool:
    """Healthy: the tail has read since the preset, and its newest tag, any one, the head had read before (T13)."""
    return not machine.is_healthy(system.spacing) or (
        system.tail_has_read and (not system.tail_is_on or system.head_has_read)
    )


def healthy_only_after_a_preset(site: Track, system: Trailing) -> bool:
    """Healthy: staff has preset the distance since the unit started; a restart forgets that it fitted (T3, T8)."""
    return system.is_preset or not machine.is_healthy(system.spacing)


# ---- service: without it the rest would be claimed of a machine that always refuses


def a_whole_train_is_never_accused(site: Track, system: Trailing) -> bool:
    """While the train is as it was preset, and runs forward, every read fits, however bad the odometry (T13)."""
    return not (system.whole and system.forward) or not system.spacing.broken


# ---- what they rest on


def what_is_not_preset_is_broken(site: Track, system: Trailing) -> bool:
    """Until staff presets the distance no read puts right what a restart has latched (T8, T13)."""
    return system.is_preset or system.spacing.broken


def what_is_caught_is_broken(site: Track, system: Trailing) -> bool:
    """What was latched is still latched (T13)."""
    return not system.caught or system.spacing.broken


def a_whole_train_is_near_its_preset(site: Track, system: Trailing) -> bool:
    """While the train is as it was preset, its antennas are as far apart as that, and farther than a window (T3)."""
    off_nm = NM_A_MM * system.spacing.preset_mm - system.apart_nm
    return not system.whole or (
        -NM_A_MM * site.preset_error_mm <= off_nm <= NM_A_MM * site.preset_error_mm
        and system.apart_nm > 2 * NM_A_MM * site.read_within_mm
    )


def a_whole_train_has_passed_what_its_tail_read(site: Track, system: Trailing) -> bool:
    """The tag that the tail of a train that runs forward has read is behind its head by the antenna distance (T13)."""
    return (
        not (system.whole and system.forward)
        or not system.spacing.tail_read
        or world.tail_nm(site, system) - NM_A_MM * system.spacing.tail_uid >= -NM_A_MM * site.read_within_mm
    )


def is_a_read(site: Track, system: Trailing, read: HeadRead) -> bool:
    """Tell whether what is remembered is where the head truly read a tag, as well as the odometry knew."""
    return not read.at.known or (
        (read.uid != site.tag or system.head_has_read)
        and read.uid + site.antenna_mm - read.at.most_mm <= site.read_within_mm
        and read.at.least_mm - read.uid - site.antenna_mm <= site.read_within_mm
    )


def what_is_remembered_was_read(site: Track, system: Trailing) -> bool:
    """Every read that is remembered was one, in its place (T13)."""
    reads = system.spacing.reads
    return (
        is_a_read(site, system, reads.first)
        and is_a_read(site, system, reads.second)
        and is_a_read(site, system, reads.third)
        and is_a_read(site, system, reads.fourth)
        and is_a_read(site, system, reads.fifth)
        and is_a_read(site, system, reads.sixth)
        and is_a_read(site, system, reads.seventh)
        and is_a_read(site, system, reads.eighth)
    )


def the_tails_newest_read_is_noted(site: Track, system: Trailing) -> bool:
    """The machine knows whether the tail has read, and which tag last, compared only if the head had read it (T13)."""
    return (
        system.spacing.tail_read == system.tail_has_read
        and (not system.tail_has_read or system.tail_is_on == (system.spacing.tail_uid == site.tag))
        and (system.tail_has_read or not system.tail_is_on)
        and (not system.tail_is_on or system.tail_came_after or not system.spacing.checked)
    )


def is_the_newest_of(site: Track, system: Trailing, read: HeadRead) -> bool:
    """Tell whether what is remembered is the head's newest read of the one tag."""
    return read.uid == site.tag and (
        read.at.known and read.at.least_mm == system.least_mm and read.at.most_mm == system.most_mm
        if system.known
        else True
    )


def stands_at_its_place(site: Track, system: Trailing, reads: HeadReads) -> bool:
    """Tell whether the one tag is remembered behind as many others as the head has read since."""
    tag, since = site.tag, system.since
    return (
        (reads.first.uid == tag) == (since == 0)
        and (since != 0 or is_the_newest_of(site, system, reads.first))
        and (since < 2 or reads.second.uid != tag)
        and (since != 1 or is_the_newest_of(site, system, reads.second))
        and (since < 3 or reads.third.uid != tag)
        and (since != 2 or is_the_newest_of(site, system, reads.third))
        and (since < 4 or reads.fourth.uid != tag)
        and (since != 3 or is_the_newest_of(site, system, reads.fourth))
        and (since < 5 or reads.fifth.uid != tag)
        and (since != 4 or is_the_newest_of(site, system, reads.fifth))
        and (since < 6 or reads.sixth.uid != tag)
        and (since != 5 or is_the_newest_of(site, system, reads.sixth))
        and (since < 7 or reads.seventh.uid != tag)
        and (since != 6 or is_the_newest_of(site, system, reads.seventh))
        and (since != 7 or is_the_newest_of(site, system, reads.eighth))
    )


def the_heads_last_eight_are_remembered(site: Track, system: Trailing) -> bool:
    """The one tag, if it is among the head's last eight, is remembered as it was read last (T13)."""
    reads = system.spacing.reads
    return not system.head_has_read or (
        system.since >= 0
        and reads.first.uid == system.head_newest
        and (
            not system.known or -world.FARTHEST_KNOWN_MM <= system.least_mm <= system.most_mm <= world.FARTHEST_KNOWN_MM
        )
        and stands_at_its_place(site, system, reads)
    )


INITIAL = (the_unit_has_just_started,)
SAFETY = (
    a_false_tail_is_found,
    unhealthy_is_latched,
    healthy_only_after_a_check,
    healthy_only_after_a_preset,
    a_whole_train_is_never_accused,
)
INVARIANTS = (
    *SAFETY,
    what_is_not_preset_is_broken,
    what_is_caught_is_broken,
    a_whole_train_is_near_its_preset,
    a_whole_train_has_passed_what_its_tail_read,
    what_is_remembered_was_read,
    the_tails_newest_read_is_noted,
    the_heads_last_eight_are_remembered,
)
PREMISES = (the_tolerance_covers_preset_and_read_window,)
STEPS = (run, come_apart, head_reads, tail_reads, preset, turn, restart)

THEORY = Theory(
    "antenna_spacing",
    Track,
    Trailing,
    by_name(STEPS),
    by_name(INITIAL),
    by_name(INVARIANTS),
    by_name(SAFETY),
    by_name(PREMISES),
)
