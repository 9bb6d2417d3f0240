"""A start point, the trains that come to its tag and its detector, what they tell, and its terminal's power (X3, T14).

Between tag and detector there is room for one head.  Of the trains there is who passed the tag last, and whether it has
struck since: it is on its way to the detector if not, or has turned back.  Telegrams come late and again, and those of
other tracks' tags come here as well.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.crossing import start_point as machine
from kernel.crossing.crossing import Train
from kernel.crossing.start_point import StartPoint, StartPointSettings
from kernel.names import Tag
from kernel.restarts import restart_start_point


@dataclass(frozen=True)
class Place:
    """What does not change: what is written for the start point (X3)."""

    settings: StartPointSettings


@dataclass(frozen=True)
class Told:
    """A history: the strike that was told last.

    ``is_any``: there was one.  ``by``: the train that made it.  ``name``: by which it was told.  ``new``: the name that
    nobody had had until then.
    """

    is_any: bool
    by: Train
    name: Train
    new: Train


@dataclass(frozen=True)
class AtStartPoint:
    """One moment.

    ``in_service``: its settings have been checked.  ``has_power``: the terminal has.
    ``last``: the train whose head passed the tag last, ``passed_cycles`` ago.  ``is_before``: it has not struck since.
    ``struck_cycles``: how long ago the last strike was, whether the terminal noted it or not.
    ``missed``: history: how many trains struck without power since the crossing was last told that some may have.
    ``told``: history: the strike that was told last.
    ``point``: the terminal.
    """

    in_service: bool
    has_power: bool
    last: Train
    passed_cycles: int
    is_before: bool
    struck_cycles: int
    missed: int
    told: Told
    point: StartPoint


# ---- assumptions


def nobody_comes_before_the_check(system: AtStartPoint) -> bool:
    """Trains come to a start point whose settings have been checked (X3)."""
    return system.in_service


def one_head_at_a_time_comes_to_a_start_point(site: Place, system: AtStartPoint, train: Train) -> bool:
    """Whose head is between tag and detector keeps others' out, and for some time after it has turned back (X3)."""
    return train == system.last or not system.is_before or system.passed_cycles > site.settings.changes_cycles


def who_strikes_has_passed_the_tag(system: AtStartPoint, train: Train) -> bool:
    """The detector is struck by the train that passed the tag last, and once (X3)."""
    return train == system.last and system.is_before


def a_read_is_told_in_time(site: Place, system: AtStartPoint, train: Train, tag: Tag) -> bool:
    """Who tells of a tag passed it, no longer ago than is written: it did so last, or has struck since (T11, T14)."""
    return (
        tag != site.settings.tag
        or (train == system.last and system.passed_cycles <= site.settings.told_cycles)
        or system.struck_cycles <= site.settings.told_cycles
    )


def a_terminal_acts_only_with_power(system: AtStartPoint) -> bool:
    """Without power it hears nothing, notes no strike, and tells of none (X3)."""
    return system.has_power


# ---- transitions


def put_into_service(site: Place, system: AtStartPoint, nobody: Train) -> AtStartPoint:
    """The settings of a start point are checked, and refused if they are not lawful; then it starts (X3)."""
    if not machine.are_lawful(site.settings):
        return system
    return replace(system, in_service=True, has_power=True, point=restart_start_point(nobody))


def lose_power(site: Place, system: AtStartPoint) -> AtStartPoint:
    """The terminal's power fails (X3)."""
    return replace(system, has_power=False)


def restart(site: Place, system: AtStartPoint, nobody: Train) -> AtStartPoint:
    """Its power is back, or it restarts (X3)."""
    if not nobody_comes_before_the_check(system):
        return system
    return replace(system, has_power=True, point=restart_start_point(nobody))


def pass_tag(site: Place, system: AtStartPoint, train: Train) -> AtStartPoint:
    """A head passes the tag, for the first time or anew; whether it reads it is another matter (T14)."""
    if not nobody_comes_before_the_check(system) or not one_head_at_a_time_comes_to_a_start_point(site, system, train):
        return system
    return replace(system, last=train, passed_cycles=0, is_before=True)


def hear_read(site: Place, system: AtStartPoint, train: Train, tag: Tag) -> AtStartPoint:
    """The terminal hears what a train tells of a tag: of this one or another, late or again (T14)."""
    if not a_terminal_acts_only_with_power(system) or not a_read_is_told_in_time(site, system, train, tag):
        return system
    return replace(system, point=machine.note_read(site.settings, system.point, train, tag))


def strike(site: Place, system: AtStartPoint, train: Train, new: Train) -> AtStartPoint:
    """A train strikes the detector, and the terminal names the strike (X3, T14)."""
    if not who_strikes_has_passed_the_tag(system, train) or not a_terminal_acts_only_with_power(system):
        return system
    name = machine.striker(system.point, new)
    told = Told(True, train, name, new)
    return replace(system, is_before=False, struck_cycles=0, told=told, point=machine.note_strike(system.point))


def strike_without_power(site: Place, system: AtStartPoint, train: Train) -> AtStartPoint:
    """A train strikes the detector, and the terminal has no power (X3)."""
    if not who_strikes_has_passed_the_tag(system, train) or system.has_power:
        return system
    return replace(system, is_before=False, struck_cycles=0, missed=system.missed + 1)


def tell_what_may_be_missed(site: Place, system: AtStartPoint) -> AtStartPoint:
    """The terminal is heard, and tells first that it may have missed strikes, however many, if it owes that (X3)."""
    if not a_terminal_acts_only_with_power(system) or not system.point.owes:
        return system
    return replace(system, missed=0, point=machine.note_owed(system.point))


def run_a_cycle(site: Place, system: AtStartPoint) -> AtStartPoint:
    """A cycle passes (X3)."""
    return replace(
        system,
        passed_cycles=system.passed_cycles + 1,
        struck_cycles=system.struck_cycles + 1,
        point=machine.aged(system.point),
    )
