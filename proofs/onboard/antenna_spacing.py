"""What is claimed of the antennas' spacing: only the train's last antenna counts as its tail (T13, T3)."""

from __future__ import annotations

from kernel.onboard import antenna_spacing as machine
from kernel.onboard.antenna_spacing import HeadRead
from kernel.onboard.arithmetic import magnitude
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
from proofs.theory import Theory, by_name

# ---- the start


def the_unit_has_just_started(site: Track, system: Trailing) -> bool:
    """At the start the antenna distance has yet to be preset (T3, T8)."""
    return system.spacing == machine.restarted() and not system.whole and not system.caught


# ---- safety


def a_false_tail_is_found(site: Track, system: Trailing) -> bool:
    """Healthy: at the tail's newest read it was as far behind as preset, but for tolerance, windows and odometry (T13).

    A rear cab that poses as the tail of a split train, and a train that has stretched, are beyond that.
    """
    return (
        not machine.is_healthy(system.spacing)
        or magnitude(system.tail_mm - system.spacing.preset_mm)
        <= site.limits.tolerance_mm + site.read_mm + 2 * site.error_mm
    )


def unhealthy_is_latched(site: Track, system: Trailing) -> bool:
    """Once a false tail was compared, or tail came before head, the line is not healthy until preset anew (T13)."""
    return not system.caught or not machine.is_healthy(system.spacing)


def healthy_only_after_a_check(site: Track, system: Trailing) -> bool:
    """Healthy: the tail has read since the preset, and its newest tag, any one, the head had read before (T13)."""
    return not machine.is_healthy(system.spacing) or (
        system.spacing.tail_read and (system.spacing.tail_uid != site.tag or system.head_has_read)
    )


# ---- service: without it the rest would be claimed of a machine that always refuses


def a_whole_train_is_never_accused(site: Track, system: Trailing) -> bool:
    """While the train is as it was preset, no read is found not to fit, however bad the odometry (T13)."""
    return not system.whole or not system.spacing.broken


# ---- what they rest on


def what_is_caught_is_broken(site: Track, system: Trailing) -> bool:
    """What was latched is still latched (T13)."""
    return not system.caught or system.spacing.broken


def a_whole_train_is_near_its_preset(site: Track, system: Trailing) -> bool:
    """While the train is as it was preset, its antennas are as far apart as that, and farther than a window (T3)."""
    return not system.whole or (
        magnitude(system.spacing.preset_mm - system.apart_mm) <= site.preset_error_mm and system.apart_mm > site.read_mm
    )


def a_whole_train_has_passed_what_its_tail_read(site: Track, system: Trailing) -> bool:
    """While the train is whole, the tag that its tail has read is behind its head by the antenna distance (T13)."""
    return (
        not system.whole
        or not system.spacing.tail_read
        or (2 * (system.head_mm - system.apart_mm - system.spacing.tail_uid) >= -site.read_mm)
    )


def is_a_read(site: Track, system: Trailing, read: HeadRead) -> bool:
    """Tell whether what is remembered is where the head truly read a tag, as well as the odometry knew."""
    return not read.at.known or (
        (read.uid != site.tag or system.head_has_read)
        and 2 * (read.uid - read.at.most_mm) <= site.read_mm
        and 2 * (read.at.least_mm - read.uid) <= site.read_mm
        and read.at.most_mm - read.at.least_mm <= site.error_mm
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


INITIAL = (the_unit_has_just_started,)
SAFETY = (
    a_false_tail_is_found,
    unhealthy_is_latched,
    healthy_only_after_a_check,
    a_whole_train_is_never_accused,
)
INVARIANTS = (
    *SAFETY,
    what_is_caught_is_broken,
    a_whole_train_is_near_its_preset,
    a_whole_train_has_passed_what_its_tail_read,
    what_is_remembered_was_read,
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
