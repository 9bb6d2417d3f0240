"""What is claimed of an end point's terminal: nobody is told gone who is inside, nor of whom a part is (X4, T14)."""

from __future__ import annotations

from kernel.crossing import end_point as machine
from models.crossing import end_point as world
from models.crossing.end_point import OUT, AtEndPoint, Place
from proofs.theory import Theory, by_name

# ---- the start


def it_is_not_in_service(site: Place, system: AtEndPoint) -> bool:
    """At the start the settings are not checked, and no tail has read these tags, nor told so (X4)."""
    return (
        not system.in_service
        and system.last != site.settings.inner
        and system.last != site.settings.outer
        and system.last_at <= system.now
        and not system.is_told
        and not system.gone
        and not system.wrong
    )


# ---- safety


def nobody_is_told_gone_who_is_inside(site: Place, system: AtEndPoint) -> bool:
    """Nor anybody of whom a part is; whatever is told late, or again, or was read on the way in (X4, T14)."""
    return not system.wrong


# ---- what it rests on


def in_service_the_settings_are_lawful(site: Place, system: AtEndPoint) -> bool:
    """They were checked, and do not change (X4)."""
    return not system.in_service or machine.are_lawful(site.settings)


def before_service_these_tags_are_not_read(site: Place, system: AtEndPoint) -> bool:
    """Nobody comes to them, nor tells of them (X4)."""
    return system.in_service or (
        system.last != site.settings.inner
        and system.last != site.settings.outer
        and (not system.is_told or system.told.read.last != site.settings.outer)
    )


def what_was_read_last_was_read_by_now(site: Place, system: AtEndPoint) -> bool:
    """Not later than now (X4)."""
    return system.last_at <= system.now


def a_tail_that_read_the_inner_tag_passed_it(site: Place, system: AtEndPoint) -> bool:
    """Then, or once more since (X4)."""
    return system.last != site.settings.inner or system.last_at <= system.inner_at


def who_has_read_both_tags_is_out(site: Place, system: AtEndPoint) -> bool:
    """In this order and within the time written: or that is so long ago that it may be back (X4, T14)."""
    return (
        system.before != site.settings.inner
        or system.last != site.settings.outer
        or system.last_at - system.before_at > site.settings.changes_cycles
        or system.now - system.last_at > site.settings.changes_cycles
        or (system.end == OUT and system.last_at <= system.out_at)
    )


def who_has_told_so_is_out(site: Place, system: AtEndPoint) -> bool:
    """Whoever has told that of its tail, whole: or that is too old to count (X4, T14)."""
    told = system.told
    return (
        not system.is_told
        or told.read.before != site.settings.inner
        or told.read.last != site.settings.outer
        or told.read.apart_cycles > site.settings.changes_cycles
        or not told.read.is_whole
        or system.now - told.read_at > site.settings.changes_cycles
        or (system.end == OUT and told.read_at <= system.out_at and not system.left_behind)
    )


INITIAL = (it_is_not_in_service,)
SAFETY = (nobody_is_told_gone_who_is_inside,)
INVARIANTS = (
    *SAFETY,
    in_service_the_settings_are_lawful,
    before_service_these_tags_are_not_read,
    what_was_read_last_was_read_by_now,
    a_tail_that_read_the_inner_tag_passed_it,
    who_has_read_both_tags_is_out,
    who_has_told_so_is_out,
)
STEPS = (
    world.put_into_service,
    world.pass_inner_tag_out,
    world.pass_outer_tag_out,
    world.come_back,
    world.come_in_over_the_outer_tag,
    world.come_in_over_the_inner_tag,
    world.read_elsewhere,
    world.part,
    world.tell,
    world.hear,
    world.run_a_cycle,
)

THEORY = Theory(
    "end_point",
    Place,
    AtEndPoint,
    by_name(STEPS),
    by_name(INITIAL),
    by_name(INVARIANTS),
    by_name(SAFETY),
)
