"""A train at an end point: its rear runs out, stops between the tags, comes back, comes in; tags are missed (X4, T14).

Of a train there is where its end lies that is nearest to the road, and what its tail has read, whichever end that is.
A train that leaves draws its nearest end behind it as its tail.  One that comes back runs with that end ahead, and then
its other end comes in as the tail.  What it has told may come at any later time, again and again; a terminal judges
each telegram by itself, so of all of them one is looked at, whichever.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.crossing import end_point as machine
from kernel.crossing.end_point import EndPointSettings, TailRead
from kernel.names import Tag

INSIDE, BETWEEN, OUT = 0, 1, 2
"""Where the nearest end is: not beyond the inner tag; between both; beyond the outer one, and all of the train."""


@dataclass(frozen=True)
class Place:
    """What does not change: what is written for the end point (X4)."""

    settings: EndPointSettings


@dataclass(frozen=True)
class Told:
    """A telegram that was sent, and the cycle in which its tail read the later tag."""

    read: TailRead
    read_at: int


@dataclass(frozen=True)
class AtEndPoint:
    """One moment of a train.

    ``in_service``: the settings have been checked.  ``now``: the cycle.
    ``end``: where its nearest end is.  ``left_behind``: a part of it has stayed inside.
    ``out_at``: when its nearest end passed the outer tag last.  ``inner_at``: when a tail of it passed the inner one
    last, whether it read it or not.
    ``before``, ``last``: what its tail has read last, in the cycles ``before_at`` and ``last_at``.
    ``is_told``, ``told``: one of the telegrams that it has sent, any of them.
    ``gone``, ``wrong``: history: it was told gone; it was so while it was inside, or a part of it.
    """

    in_service: bool
    now: int
    end: int
    left_behind: bool
    out_at: int
    inner_at: int
    before: Tag
    before_at: int
    last: Tag
    last_at: int
    is_told: bool
    told: Told
    gone: bool
    wrong: bool


def noted(system: AtEndPoint, tag: Tag) -> AtEndPoint:
    """Give what the train knows once its tail has read a tag."""
    return replace(system, before=system.last, before_at=system.last_at, last=tag, last_at=system.now)


# ---- assumptions


def nobody_comes_before_the_check(system: AtEndPoint) -> bool:
    """Trains come to an end point whose settings have been checked (X4)."""
    return system.in_service


def who_has_left_is_not_back_at_once(site: Place, system: AtEndPoint) -> bool:
    """Who comes back has stopped and changed ends meanwhile, or was let back (X4)."""
    return system.end != OUT or system.now - system.out_at > site.settings.changes_cycles


def whose_tail_comes_in_was_not_at_the_inner_tag_just_before(site: Place, system: AtEndPoint) -> bool:
    """A tail that comes in over the outer tag has gone out before that, and the train has changed ends since (X4)."""
    return system.now - system.inner_at > site.settings.changes_cycles


def a_tail_reads_as_it_runs_forward(system: AtEndPoint) -> bool:
    """A tail that comes in follows its train, which is inside; what is read while rolling back is not told (P7)."""
    return system.end == INSIDE


def a_tag_lies_at_one_place(site: Place, tag: Tag) -> bool:
    """The tags of other tracks and other roads are others (T1)."""
    return tag != site.settings.inner and tag != site.settings.outer


def it_tells_what_its_tail_has_read(system: AtEndPoint, told: Told) -> bool:
    """A train tells the two tags that its tail read last, in order, and the time between them (T2)."""
    return (
        told.read.before == system.before
        and told.read.last == system.last
        and told.read.apart_cycles == system.last_at - system.before_at
        and told.read_at == system.last_at
    )


def who_tells_that_it_is_whole_is(system: AtEndPoint, told: Told) -> bool:
    """The through line and the spacing of reads show it where a part has stayed behind (T3, T13, P5)."""
    return not told.read.is_whole or not system.left_behind


def only_what_was_told_is_heard(system: AtEndPoint) -> bool:
    """The radio makes no telegrams (T11)."""
    return system.is_told


def an_age_counts_from_the_read(system: AtEndPoint, age_cycles: int) -> bool:
    """The age of what is told is not made less on its way (T11)."""
    return age_cycles >= system.now - system.told.read_at


# ---- transitions


def put_into_service(site: Place, system: AtEndPoint) -> AtEndPoint:
    """The settings of an end point are checked, and refused if they are not lawful (X4)."""
    return replace(system, in_service=True) if machine.are_lawful(site.settings) else system


def pass_inner_tag_out(site: Place, system: AtEndPoint, is_read: bool) -> AtEndPoint:
    """Its rear passes the inner tag on its way out; whether the tail reads it is another matter (X4)."""
    if not nobody_comes_before_the_check(system) or system.end != INSIDE:
        return system
    there = replace(system, end=BETWEEN, inner_at=system.now)
    return noted(there, site.settings.inner) if is_read else there


def pass_outer_tag_out(site: Place, system: AtEndPoint, is_read: bool) -> AtEndPoint:
    """And the outer one: now all of the train is beyond it (X4)."""
    if not nobody_comes_before_the_check(system) or system.end != BETWEEN:
        return system
    there = replace(system, end=OUT, out_at=system.now)
    return noted(there, site.settings.outer) if is_read else there


def come_back(site: Place, system: AtEndPoint) -> AtEndPoint:
    """It comes back with that end ahead, from between the tags or from beyond; no tail reads them so (X4)."""
    if not nobody_comes_before_the_check(system) or not who_has_left_is_not_back_at_once(site, system):
        return system
    return replace(system, end=INSIDE)


def come_in_over_the_outer_tag(site: Place, system: AtEndPoint, is_read: bool) -> AtEndPoint:
    """Its other end comes in as the tail, over the outer tag (X4)."""
    if not nobody_comes_before_the_check(system) or not a_tail_reads_as_it_runs_forward(system):
        return system
    if not whose_tail_comes_in_was_not_at_the_inner_tag_just_before(site, system):
        return system
    return noted(system, site.settings.outer) if is_read else system


def come_in_over_the_inner_tag(site: Place, system: AtEndPoint, is_read: bool) -> AtEndPoint:
    """And over the inner one (X4)."""
    if not nobody_comes_before_the_check(system) or not a_tail_reads_as_it_runs_forward(system):
        return system
    there = replace(system, inner_at=system.now)
    return noted(there, site.settings.inner) if is_read else there


def read_elsewhere(site: Place, system: AtEndPoint, tag: Tag) -> AtEndPoint:
    """Its tail reads a tag of another end point, another track, another road (T1)."""
    if not a_tag_lies_at_one_place(site, tag):
        return system
    return noted(system, tag)


def part(site: Place, system: AtEndPoint) -> AtEndPoint:
    """A coupling breaks while not all of it is beyond the tags; the rear stays behind (P5)."""
    return system if system.end == OUT else replace(system, left_behind=True)


def tell(site: Place, system: AtEndPoint, told: Told) -> AtEndPoint:
    """The train tells what its tail has read; it does so again and again, and this is one of those telegrams (T14)."""
    if not it_tells_what_its_tail_has_read(system, told) or not who_tells_that_it_is_whole_is(system, told):
        return system
    return replace(system, is_told=True, told=told)


def hear(site: Place, system: AtEndPoint, age_cycles: int) -> AtEndPoint:
    """The terminal hears what was told: at once, late, or again (X4, T14)."""
    if not only_what_was_told_is_heard(system) or not an_age_counts_from_the_read(system, age_cycles):
        return system
    is_gone = machine.has_left(site.settings, system.told.read, age_cycles)
    wrong = is_gone and (system.end != OUT or system.left_behind)
    return replace(system, gone=system.gone or is_gone, wrong=system.wrong or wrong)


def run_a_cycle(site: Place, system: AtEndPoint) -> AtEndPoint:
    """A cycle passes (X4)."""
    return replace(system, now=system.now + 1)
