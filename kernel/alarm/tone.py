"""The tone that a track worker's handset sounds, for all trains of the line (A2 to A6, A8).

Every train is known by two sources: its GPS, and the traffic display (TID).  Where both are fresh and
agree, the train is where its GPS says.  Where they do not, the tone is the fault tone, except for three
things that are registered beforehand, for the paper's reason that they happen every day (004, 4):

- a stretch without GPS, tunnel and both zones beside it: from its entry, zone A, on the train may be anywhere from
  its last fix to the outer end of the other zone, B, and counts at the end of that which is nearest the worker;
  seen in zone B, and on the display there, it is known as any other;
- shunting in a station: GPS alone, and the direction is not believed;
- a stabled train on the roster, its engine off: the display alone.

All three lie in sections that are not to be used: a handset there does not sound the normal tone.

Distance is the least way along the track that the register has: the difference of two figures, or over a connection
from the figures of one line to those of another (`kernel.alarm.network`).  Where the register ends stands an opening:
trains come by it that no list has, or that are told in other figures.  Near one the handset does not sound a mild tone
(ours).

A fix that its train cannot have reached since the one before, nor left before it, by the line's speed and what GPS
errs, is not taken, and the fault tone sounds until one comes that fits: one of the two was wrong (ours).  Where either
of them puts the train near, the alarm sounds.

The order is alarm, fault, caution, normal.  The alarm comes first because it is what has to be obeyed at
once, whatever else does not work.  The fault tone comes before caution because caution also says that all
other trains are far, and that is not known then.  Nothing is kept from one decision to the next: the tone
follows from what is known now, so no train's tone hides another's.

A train lost without GPS also counts by the stretch that the display shows, which the paper does not do: the ends of
the section say where it is only while it neither turns in the tunnel nor leaves it unseen, and the display says so
whatever it does.  It may be the nearer of both, and is for a worker behind the train; that is the price.  That its
last fix is far takes nothing from it: that fix may be in the figures of a branch, or from before a break.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import Enum
from typing import NewType

from kernel.alarm import distance
from kernel.alarm.distance import (
    GREATEST_AGE_MS,
    GREATEST_PLACE_MM,
    NO_TRAIN_FIX,
    NO_WORKER_FIX,
    UM_A_MM,
    AlarmBounds,
    TrainFix,
    WorkerFix,
    is_fix,
    older_ms,
    train_off_um,
    worker_off_um,
)
from kernel.alarm.network import (
    Connection,
    Opening,
    Way,
    is_over_within,
    jumps,
    may_be_told_across_a_join,
    may_come_over,
    may_have_passed_a_join,
)
from kernel.alarm.sections import (
    NoUse,
    Reason,
    Section,
    from_stretch_um,
    from_way_through_um,
    is_put_forward,
    is_within,
)
from kernel.maps import Map
from kernel.onboard.arithmetic import larger

ALARM_MM = 1_500_000
CAUTION_MM = 3_000_000
"""004, 3.3; the limits belong to what they limit (A3, ours)."""

Train = NewType("Train", str)
"""A train number (A2)."""


class Tone(Enum):
    """What the worker hears, the most severe first (A3)."""

    ALARM = 0
    FAULT = 1
    CAUTION = 2
    NORMAL = 3


@dataclass(frozen=True)
class Freshness:
    """How old what is told may be, in ms (A1, A8; ours).

    ``fix_ms``: a train's GPS, sent every 2 s.  ``display_ms``: the traffic display, every 3 s.
    ``server_ms``: the server's list of trains.  ``worker_ms``: the worker's own GPS, every 1 s.
    """

    fix_ms: int
    display_ms: int
    server_ms: int
    worker_ms: int


@dataclass(frozen=True)
class Register:
    """What is written for a line (A1 to A6).

    ``display_error_mm``: a train's antenna is no farther outside of the stretch that the display shows.
    ``tolerance_mm``: GPS and display agree when the fix is no farther outside.
    ``stabled``: which train may be stabled in which section: the roster.
    ``ways``: from the figures of one line to those of another; ``openings``: where all that ends, on any of the lines.
    ``edition``: another number whenever it was written anew; by another one the same figure may be another place.
    """

    bounds: AlarmBounds
    fresh: Freshness
    display_error_mm: int
    tolerance_mm: int
    sections: Map[Section, NoUse]
    stabled: frozenset[tuple[Train, Section]]
    ways: Map[Way, Connection]
    openings: Map[Opening, int]
    edition: int


NO_FIGURE_MM = GREATEST_PLACE_MM + 1
"""In the place of an end of a stretch's other part: it has none (A1)."""


@dataclass(frozen=True)
class Display:
    """A train on the traffic display: the stretch that it occupied, lower end first, and how long ago (A1, A2).

    ``other_from_mm``, ``other_to_mm``: of a stretch that reaches over a join its part in other figures.
    """

    from_mm: int
    to_mm: int
    age_ms: int
    other_from_mm: int = NO_FIGURE_MM
    other_to_mm: int = NO_FIGURE_MM


@dataclass(frozen=True)
class Known:
    """What both sources say of a train (A2).

    ``fix``: the last that fitted the one before it.  ``newest``: the last one; ``jumped``: it did not fit (ours).
    """

    fix: TrainFix
    display: Display
    jumped: bool
    newest: TrainFix


NO_DISPLAY = Display(from_mm=0, to_mm=0, age_ms=GREATEST_AGE_MS + 1)
NOTHING_KNOWN = Known(fix=NO_TRAIN_FIX, display=NO_DISPLAY, jumped=False, newest=NO_TRAIN_FIX)
"""Of a train that the server names, and no source has told anything of (A2)."""


@dataclass(frozen=True)
class Listing:
    """How far the handset has read the list of one life of the server (A1, A2; `kernel.alarm.train_list`).

    ``life_ms``: that life.  ``taken``: entries read.  ``count``, ``is_whole``: what the server said last.
    ``named``: the trains that these entries have on the list, by the number of the entry.
    """

    life_ms: int
    taken: int
    count: int
    is_whole: bool
    named: Map[Train, int]


@dataclass(frozen=True)
class Handset:
    """All that a worker's handset decides from (A1, A8).

    ``worker``: its own fix.  ``server_age_ms``: how long ago the server said how its list is; ``servers_well``: the
    monitoring server says so.  ``battery_well``: the battery lasts.  ``listing``: the server's list, as far as read.
    ``trains``: every train of it, and those from before a restart of the server, until its list is whole.
    """

    worker: WorkerFix
    server_age_ms: int
    servers_well: bool
    battery_well: bool
    listing: Listing
    trains: Map[Train, Known]


def switched_on() -> Handset:
    """Give a handset that has just started: nothing is known, so no tone is mild (A8)."""
    return Handset(
        worker=NO_WORKER_FIX,
        server_age_ms=GREATEST_AGE_MS + 1,
        servers_well=False,
        battery_well=False,
        listing=Listing(life_ms=-1, taken=0, count=0, is_whole=False, named={}),
        trains={},
    )


# ---- what becomes of what is known


def older(handset: Handset, elapsed_ms: int) -> Handset:
    """Let all that is known grow older (A1)."""
    return replace(
        handset,
        worker=distance.older_worker(handset.worker, elapsed_ms),
        server_age_ms=older_ms(handset.server_age_ms, elapsed_ms),
        trains={train: older_known(known, elapsed_ms) for train, known in handset.trains.items()},
    )


def older_known(known: Known, elapsed_ms: int) -> Known:
    """Let what is known of a train grow older (A1)."""
    return replace(
        known,
        fix=distance.older_train(known.fix, elapsed_ms),
        display=replace(known.display, age_ms=older_ms(known.display.age_ms, elapsed_ms)),
        newest=distance.older_train(known.newest, elapsed_ms),
    )


def note_fix(register: Register, handset: Handset, train: Train, fix: TrainFix, edition: int) -> Handset:
    """Note where GPS says that a train is; one that is not on the list stays unknown (A2).

    ``edition``: in the figures of which one it is told.  In another's it says nothing here: after track was moved the
    worker may have a register from before, or the server.
    A fix that jumps is not taken, and it is kept that it did.  What is no fix, as a unit tells after its start, changes
    nothing: the last fix grows too old by itself, and the next one is held against it.
    """
    if edition != register.edition or train not in handset.trains or not is_fix(fix.place_mm, fix.age_ms):
        return handset
    known = handset.trains[train]
    if jumps(register.bounds, register.ways, known.fix, fix):
        return replace(handset, trains=handset.trains | {train: replace(known, jumped=True, newest=fix)})
    return replace(handset, trains=handset.trains | {train: replace(known, fix=fix, jumped=False, newest=fix)})


def note_display(register: Register, handset: Handset, train: Train, display: Display, edition: int) -> Handset:
    """Note where the display shows a train, in figures of an edition; one not on the list stays unknown (A2)."""
    if edition != register.edition or train not in handset.trains:
        return handset
    return replace(handset, trains=handset.trains | {train: replace(handset.trains[train], display=display)})


def note_worker(handset: Handset, fix: WorkerFix) -> Handset:
    """Note where the handset's own GPS says that the worker is (A1)."""
    return replace(handset, worker=fix)


def note_battery(handset: Handset, is_well: bool) -> Handset:
    """Note whether the battery lasts (A8)."""
    return replace(handset, battery_well=is_well)


# ---- one train


def has_fix(register: Register, known: Known) -> bool:
    """Tell whether GPS is there, and fresh (A1)."""
    return is_fix(known.fix.place_mm, known.fix.age_ms) and known.fix.age_ms <= register.fresh.fix_ms


def is_stretch(from_mm: int, to_mm: int) -> bool:
    """Tell whether two ends are a stretch, lower end first, within the ranges of reports (A1).

    Told in running order, as of an up train, it would be measured to its far ends.
    """
    return is_fix(from_mm, 0) and is_fix(to_mm, 0) and from_mm <= to_mm


def has_other_part(display: Display) -> bool:
    """Tell whether a record of the display has a part in other figures, or in what are none (A1)."""
    return display.other_from_mm != NO_FIGURE_MM or display.other_to_mm != NO_FIGURE_MM


def is_display(display: Display) -> bool:
    """Tell whether a record of the display shows a train: each part that it has is a stretch (A1)."""
    return (
        is_fix(display.from_mm, display.age_ms)
        and is_stretch(display.from_mm, display.to_mm)
        and (not has_other_part(display) or is_stretch(display.other_from_mm, display.other_to_mm))
    )


def has_display(register: Register, known: Known) -> bool:
    """Tell whether the display shows the train, and freshly (A1)."""
    return is_display(known.display) and known.display.age_ms <= register.fresh.display_ms


def agree(register: Register, known: Known) -> bool:
    """Tell whether GPS puts a train where the display does, in either part of what it shows (A2)."""
    display, place_mm, tolerance_mm = known.display, known.fix.place_mm, register.tolerance_mm
    return display.from_mm - tolerance_mm <= place_mm <= display.to_mm + tolerance_mm or (
        has_other_part(display)
        and display.other_from_mm - tolerance_mm <= place_mm <= display.other_to_mm + tolerance_mm
    )


def is_matched(register: Register, known: Known) -> bool:
    """Tell whether both sources are fresh and agree (A2)."""
    return has_fix(register, known) and has_display(register, known) and agree(register, known)


def is_shunting(register: Register, known: Known) -> bool:
    """Tell whether a train is not on the display, and GPS puts it where trains shunt (004, 4.2; A5)."""
    return not has_display(register, known) and any(
        section.reason == Reason.SHUNTING and is_within(section, known.fix.place_mm)
        for _name, section in register.sections.items()
    )


def is_registered(register: Register, train: Train, known: Known) -> bool:
    """Tell whether it is registered that one source alone knows of a train (A4, A5, A6)."""
    if has_fix(register, known):
        return is_shunting(register, known)
    return has_display(register, known) and (
        was_lost_without_gps(register, known)
        or any(
            section.reason == Reason.STABLING
            and (train, name) in register.stabled
            and is_within(section, known.display.from_mm)
            and is_within(section, known.display.to_mm)
            and not has_other_part(known.display)
            for name, section in register.sections.items()
        )
    )


def was_lost_without_gps(register: Register, known: Known) -> bool:
    """Tell whether the last fix, an hour old at most, was on the way through a section without GPS (A4)."""
    return is_fix(known.fix.place_mm, known.fix.age_ms) and any(
        is_put_forward(section, known.fix) for _name, section in register.sections.items()
    )


def stretch_may_be_near(register: Register, from_mm: int, to_mm: int, worker: WorkerFix, within_um: int) -> bool:
    """Tell whether any part of a train may be that near the worker, if it is in a stretch (A3, A4, A6)."""
    return from_stretch_um(register.bounds, from_mm, to_mm, worker) <= within_um or may_come_over(
        register.bounds, register.ways, from_mm, to_mm, worker, within_um
    )


def shown_may_be_near(register: Register, display: Display, worker: WorkerFix, limit_mm: int) -> bool:
    """Tell whether a train may be that near the worker, by the display (A4, A6)."""
    within_um = UM_A_MM * (limit_mm + register.display_error_mm) + register.bounds.train_mm_s * display.age_ms
    return stretch_may_be_near(register, display.from_mm, display.to_mm, worker, within_um) or (
        has_other_part(display)
        and stretch_may_be_near(register, display.other_from_mm, display.other_to_mm, worker, within_um)
    )


def told_may_be_near(register: Register, fix: TrainFix, worker: WorkerFix, limit_mm: int) -> bool:
    """Tell whether a train may be that near the worker, by a fix, whichever way it runs (A3)."""
    reckoned_um = distance.nearest_um(register.bounds, fix, worker)
    return reckoned_um <= UM_A_MM * limit_mm or comes_over(register, fix, worker, limit_mm)


def comes_over(register: Register, fix: TrainFix, worker: WorkerFix, limit_mm: int) -> bool:
    """Tell whether a train may be that near over a connection, by a fix, whichever way it runs (A3)."""
    within_um = UM_A_MM * limit_mm + train_off_um(register.bounds, fix)
    return may_come_over(register.bounds, register.ways, fix.place_mm, fix.place_mm, worker, within_um)


def is_departing(register: Register, fix: TrainFix, worker: WorkerFix) -> bool:
    """Tell whether a train is past the worker, all of it, and runs on away along his line (A3).

    That it runs away is not believed where lines may join, nor of a worker who may be there.
    """
    bounds, ways = register.bounds, register.ways
    is_at_a_join = may_have_passed_a_join(bounds, ways, fix) or may_be_told_across_a_join(bounds, ways, worker)
    return distance.is_departing(bounds, fix, worker) and not is_at_a_join


def may_be_on_its_way_through(register: Register, known: Known, worker: WorkerFix, limit_mm: int) -> bool:
    """Tell whether a train on its way through a section without GPS may be that near (004, 4.1; A4)."""
    return any(
        is_put_forward(section, known.fix)
        and from_way_through_um(register.bounds, section, known.fix, worker) <= UM_A_MM * limit_mm
        for _name, section in register.sections.items()
    )


def may_be_near(register: Register, known: Known, worker: WorkerFix, limit_mm: int) -> bool:
    """Tell whether a train may be that near and not departing, as far as a source is fresh (A3 to A6).

    The direction counts only where both sources agree, and on the worker's line.  Of a fix that jumped the place alone
    counts.
    """
    if known.jumped and told_may_be_near(register, known.newest, worker, limit_mm):
        return True
    if is_matched(register, known) and is_departing(register, known.fix, worker):
        return comes_over(register, known.fix, worker, limit_mm)
    if has_fix(register, known):
        return told_may_be_near(register, known.fix, worker, limit_mm) or (
            is_matched(register, known) and may_be_on_its_way_through(register, known, worker, limit_mm)
        )
    return has_display(register, known) and (
        shown_may_be_near(register, known.display, worker, limit_mm)
        or may_be_on_its_way_through(register, known, worker, limit_mm)
    )


# ---- the tone


def has_worker(register: Register, handset: Handset) -> bool:
    """Tell whether the worker's own place is known, and fresh (A8)."""
    worker = handset.worker
    return is_fix(worker.place_mm, worker.age_ms) and worker.age_ms <= register.fresh.worker_ms


def has_whole_list(listing: Listing) -> bool:
    """Tell whether the server says that its list is whole, and no entry of it is missing (A1)."""
    return listing.is_whole and listing.taken >= listing.count


def is_linked(register: Register, handset: Handset) -> bool:
    """Tell whether the server's list is fresh and whole, and the servers well (A1, A8)."""
    return (
        0 <= handset.server_age_ms <= register.fresh.server_ms
        and handset.servers_well
        and has_whole_list(handset.listing)
    )


def is_not_to_be_used(register: Register, worker: WorkerFix) -> bool:
    """Tell whether the worker may be in a section that is not to be used: then the handset says so (A4, A5, A6).

    Where lines join he may be told on another line than he is on.
    """
    off_um = worker_off_um(register.bounds, worker)
    return any(
        UM_A_MM * section.from_mm - off_um <= UM_A_MM * worker.place_mm <= UM_A_MM * section.to_mm + off_um
        or is_over_within(register.ways, section.from_mm, section.to_mm, worker.place_mm, off_um)
        for _name, section in register.sections.items()
    )


def has_a_section_backwards(register: Register) -> bool:
    """Tell whether a section is written upper end first: no place is in it, so nobody would hear of it (A4, A5, A6)."""
    return any(section.from_mm > section.to_mm for _name, section in register.sections.items())


def is_near_an_opening(register: Register, worker: WorkerFix) -> bool:
    """Tell whether a train may be within 3000 m of the worker by an opening, unknown or in foreign figures (A1, A3).

    Beyond it any train may stand.  One that has come by it may be told in the figures from before as long as those
    are fresh, and has run on meanwhile.
    """
    bounds, fresh = register.bounds, register.fresh
    within_um = UM_A_MM * CAUTION_MM + bounds.train_mm_s * larger(fresh.fix_ms, fresh.display_ms)
    return any(
        stretch_may_be_near(register, place_mm, place_mm, worker, within_um)
        for _name, place_mm in register.openings.items()
    )


def is_faulty(register: Register, handset: Handset) -> bool:
    """Tell whether anything is not known that the normal tone rests on (A2, A8)."""
    return (
        not handset.battery_well
        or not has_worker(register, handset)
        or not is_linked(register, handset)
        or has_a_section_backwards(register)
        or is_not_to_be_used(register, handset.worker)
        or is_near_an_opening(register, handset.worker)
        or any(
            known.jumped or (not is_matched(register, known) and not is_registered(register, train, known))
            for train, known in handset.trains.items()
        )
    )


def any_may_be_near(register: Register, handset: Handset, limit_mm: int) -> bool:
    """Tell whether any train may be that near the worker, as far as he has a fix (A3)."""
    return is_fix(handset.worker.place_mm, handset.worker.age_ms) and any(
        may_be_near(register, known, handset.worker, limit_mm) for _train, known in handset.trains.items()
    )


def tone(register: Register, handset: Handset) -> Tone:
    """Give the tone (A2, A3, A8)."""
    if any_may_be_near(register, handset, ALARM_MM):
        return Tone.ALARM
    if is_faulty(register, handset):
        return Tone.FAULT
    return Tone.CAUTION if any_may_be_near(register, handset, CAUTION_MM) else Tone.NORMAL
