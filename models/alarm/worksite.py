"""A worker's site, all trains of its line, and what was told of them; what that amounts to by the register alone."""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.alarm.distance import Direction, TrainFix, WorkerFix
from kernel.alarm.network import Opening, Way
from kernel.alarm.sections import NoUse, Reason
from kernel.alarm.tone import Display, Handset, Register, Tone, Train
from kernel.alarm.train_list import Entry, Server
from kernel.maps import Map
from models.alarm.along import is_along, is_over
from models.measures import UM_A_MM, apart, greater


@dataclass(frozen=True)
class Railway:
    """What does not change: the register of the line (A1 to A6)."""

    register: Register


@dataclass(frozen=True)
class Body:
    """A train as it is.

    ``is_on``: its antenna is on the worker's line; else on another line of the register, and neither place nor heading
    says anything.
    ``antenna_um``, ``heading``: where its antenna is, and which way it runs, or ran last if it stands.
    ``below_mm``, ``above_mm``: how far it reaches from there.
    ``ways_um``: how far its antenna is from where connections end, along lines of the register and onto his line there.
    ``next_um``, ``next_heading``, ``next_ways_um``: what it will have done when time has passed.
    ``fix_is_right``: the last fix told of those that fitted was within its error, and in figures of the register.
    ``passed_ms``: how long ago it was last where lines join; more than an hour where it never was.
    ``came_by``, ``came_ms``: by which opening it came onto the register's lines, and how long ago; more than an hour
    where it was made up on them, or came longer ago.
    """

    is_on: bool

    antenna_um: int
    heading: Direction
    below_mm: int
    above_mm: int
    ways_um: Map[Way, int]
    next_um: int
    next_heading: Direction
    next_ways_um: Map[Way, int]
    fix_is_right: bool
    passed_ms: int
    came_by: Opening
    came_ms: int


@dataclass(frozen=True)
class OfTrain:
    """What was told of a train since the list named it, as old as it truly is by the ages told (A1, A2).

    ``fix``: the last of its fixes that fitted the one before.  ``jumped``: the last one of all, ``newest``, did not.
    """

    fix: TrainFix
    display: Display
    jumped: bool
    newest: TrainFix


NOTHING_TOLD = OfTrain(
    fix=TrainFix(place_mm=1_000_000_001, age_ms=3_600_001, direction=Direction.UNKNOWN, is_running=False),
    display=Display(from_mm=0, to_mm=0, age_ms=3_600_001, other_from_mm=1_000_000_001, other_to_mm=1_000_000_001),
    jumped=False,
    newest=TrainFix(place_mm=1_000_000_001, age_ms=3_600_001, direction=Direction.UNKNOWN, is_running=False),
)
"""Of a train that the list has just named."""


@dataclass(frozen=True)
class OfList:
    """What was told of the list of one life of the server: entries read, what it said, and who is on it (A1, A2)."""

    life_ms: int
    taken: int
    count: int
    is_whole: bool
    named: Map[Train, int]


@dataclass(frozen=True)
class Told:
    """A history: all that was told to the handset, by itself and by the servers, the last of each (A1, A8)."""

    worker: WorkerFix
    list_age_ms: int
    servers_well: bool
    battery_well: bool
    listing: OfList
    trains: Map[Train, OfTrain]


NOTHING_LISTED = OfList(life_ms=-1, taken=0, count=0, is_whole=False, named={})
"""Before the first word of the server (A8)."""


def nothing_told_to_the_handset() -> Told:
    """Give what was told to a handset that has just started (A8)."""
    return Told(
        worker=WorkerFix(place_mm=0, age_ms=3_600_001),
        list_age_ms=3_600_001,
        servers_well=False,
        battery_well=False,
        listing=NOTHING_LISTED,
        trains={},
    )


@dataclass(frozen=True)
class Near:
    """By which ways some train was within a distance of the worker (A3).

    ``along_his_line``: and had not departed there.  ``over_other_lines``: from where another line joins his.
    ``by_an_opening``: from beyond it.
    """

    along_his_line: bool
    over_other_lines: bool
    by_an_opening: bool


@dataclass(frozen=True)
class Heard:
    """A history: a tone, and what was so when the worker heard it.

    ``within_3000``, ``within_1500``: by which ways some train was, in m.
    ``matched_within_1500``: one of which both sources agreed, while the worker had a fix; none that had just come.
    ``unknown``: some train was not on the list, or not known as it should be, or the worker's place was not.
    ``astray``: of some train on the list the last fix jumped, or the last that fitted is too old, and the display alone
    is not enough for it.
    ``beyond_a_tunnel``: one was on its way through a section without GPS, as far as the handset knew, and the worker,
    who had a fix, less than 1500 m beyond the end by which it would come out.
    ``not_to_be_used``: the worker was in a section that is not to be used, and had a fix.
    ``jumped_within_1500``: of some train on the list the last fix jumped, and the train may be within 1500 m of the
    worker, who had a fix, by that one.
    """

    tone: Tone
    within_3000: Near
    within_1500: Near
    matched_within_1500: Near
    unknown: bool
    astray: bool
    beyond_a_tunnel: bool
    not_to_be_used: bool
    jumped_within_1500: bool


NOWHERE_NEAR = Near(along_his_line=False, over_other_lines=False, by_an_opening=False)
NOBODY_NEAR = Heard(
    tone=Tone.FAULT,
    within_3000=NOWHERE_NEAR,
    within_1500=NOWHERE_NEAR,
    matched_within_1500=NOWHERE_NEAR,
    unknown=False,
    astray=False,
    beyond_a_tunnel=False,
    not_to_be_used=False,
    jumped_within_1500=False,
)
"""A tone before which nothing was so."""


@dataclass(frozen=True)
class LetOn:
    """A train that is on the line or let onto it, as its dispatcher knows (A2).

    ``age_ms``: how long ago its number was entered, and shown by the server.
    ``is_entered``: it was since the server's last start.
    """

    age_ms: int
    is_entered: bool


@dataclass(frozen=True)
class Lists:
    """A history: the server's lives, who was let onto the line, and what was told to it and sent by it (A1, A2).

    ``let_on``: who is on the line or let onto it.  ``reported``: the trains that were entered or told of in this life
    and are not accounted for, and how long ago they were first reported to have left since then; more than an hour
    where they were not.  ``entries``: those sent, by life and number.
    ``summaries``: those sent that said the list was whole, by life and count, and how long ago the last one was.
    ``open_since``: which trains each life has on its list, or had at its end and no later one has taken off since, by
    the number of the entry.
    ``confirmed``: the lives in which a person has confirmed the list.
    """

    let_on: Map[Train, LetOn]
    reported: Map[Train, int]
    entries: Map[tuple[int, int], Entry]
    summaries: Map[tuple[int, int], int]
    open_since: Map[tuple[int, Train], int]
    confirmed: frozenset[int]


@dataclass(frozen=True)
class Worksite:
    """One moment: the worker, every train of the line, server and lists, what was told, known and heard.

    ``newest_ms``: a history: the time of the server's last start.
    """

    worker_um: int
    bodies: Map[Train, Body]
    server: Server
    newest_ms: int
    lists: Lists
    told: Told
    handset: Handset
    heard: Heard


def gap_um(body: Body, worker_um: int) -> int:
    """Give how far a train's nearer end is from the worker; below 0 where it stands over him."""
    below_um = body.antenna_um - UM_A_MM * body.below_mm
    above_um = body.antenna_um + UM_A_MM * body.above_mm
    return greater(below_um - worker_um, worker_um - above_um)


def has_departed(body: Body, worker_um: int) -> bool:
    """Tell whether a train is past by 100 m (004, 3.3), from end to end, and ran last away from the worker (A3)."""
    away = Direction.DOWN if body.antenna_um > worker_um else Direction.UP
    return gap_um(body, worker_um) >= UM_A_MM * 100_000 and body.heading == away


def comes_over(site: Railway, body: Body, way: Way, worker_um: int, limit_mm: int) -> bool:
    """Tell whether a train's nearest part may be that near, the limit included, over other lines by a way (A3)."""
    reach_um = UM_A_MM * limit_mm + UM_A_MM * greater(body.below_mm, body.above_mm)
    return (
        way in body.ways_um
        and way in site.register.ways
        and apart(worker_um, UM_A_MM * site.register.ways[way].to_mm) + body.ways_um[way] <= reach_um
    )


def comes_along(body: Body, worker_um: int, limit_mm: int) -> bool:
    """Tell whether a train is that near, the limit included, on the worker's line, and has not departed there (A3)."""
    return body.is_on and gap_um(body, worker_um) <= UM_A_MM * limit_mm and not has_departed(body, worker_um)


def has_just_come(site: Railway, body: Body) -> bool:
    """Tell whether what was told of a train before it came onto the register's lines may still be fresh (A1)."""
    fresh = site.register.fresh
    return body.came_ms <= 3_600_000 and body.came_ms <= greater(fresh.fix_ms, fresh.display_ms)


def is_of_the_register(body: Body, age_ms: int) -> bool:
    """Tell whether a report was made while its train was on the register's lines, and so is in their figures (A1)."""
    return age_ms < body.came_ms


# ---- what was told, by the register of the line alone


def is_report(place_mm: int, age_ms: int) -> bool:
    """Tell whether a report can be of a line: within 1000 km of its origin, and an hour old at the most (ours; A1)."""
    return -1_000_000_000 <= place_mm <= 1_000_000_000 and 0 <= age_ms <= 3_600_000


def age_after_ms(age_ms: int, elapsed_ms: int) -> int:
    """Give an age after some time; more than an hour where it was, or where the clock goes back or leaps (ours; A1)."""
    return age_ms + elapsed_ms if 0 <= age_ms <= 3_600_000 and 0 <= elapsed_ms <= 3_600_000 else 3_600_001


def of_train_after(of: OfTrain, elapsed_ms: int) -> OfTrain:
    """Give what was told of a train after some time (A1)."""
    return replace(
        of,
        fix=replace(of.fix, age_ms=age_after_ms(of.fix.age_ms, elapsed_ms)),
        display=replace(of.display, age_ms=age_after_ms(of.display.age_ms, elapsed_ms)),
        newest=replace(of.newest, age_ms=age_after_ms(of.newest.age_ms, elapsed_ms)),
    )


def told_after(told: Told, elapsed_ms: int) -> Told:
    """Give what was told after some time (A1)."""
    return replace(
        told,
        worker=replace(told.worker, age_ms=age_after_ms(told.worker.age_ms, elapsed_ms)),
        list_age_ms=age_after_ms(told.list_age_ms, elapsed_ms),
        trains={train: of_train_after(of, elapsed_ms) for train, of in told.trains.items()},
    )


def fits(site: Railway, before: TrainFix, fix: TrainFix) -> bool:
    """Tell whether a train can have been near both places, as far as fixes err, within the line's speed (A1)."""
    if not is_report(before.place_mm, before.age_ms):
        return True
    register, then_mm, now_mm = site.register, before.place_mm, fix.place_mm
    run_um = register.bounds.train_mm_s * apart(fix.age_ms, before.age_ms)
    within_um = run_um + 2 * UM_A_MM * register.bounds.train_error_mm
    return is_along(register, then_mm, then_mm, UM_A_MM * now_mm, within_um) or is_over(
        register, now_mm, now_mm, UM_A_MM * then_mm, within_um
    )


def may_be_within(site: Railway, fix: TrainFix, worker: WorkerFix, limit_mm: int) -> bool:
    """Tell whether two reports, as old as they are, leave it open that a train is that near the worker (A1)."""
    bounds = site.register.bounds
    train_um = UM_A_MM * (bounds.train_error_mm + bounds.length_mm) + bounds.train_mm_s * fix.age_ms
    worker_um = UM_A_MM * bounds.worker_error_mm + bounds.worker_mm_s * worker.age_ms
    within_um = UM_A_MM * limit_mm + train_um + worker_um
    return is_report(fix.place_mm, fix.age_ms) and (
        is_along(site.register, fix.place_mm, fix.place_mm, UM_A_MM * worker.place_mm, within_um)
    )


def with_battery(told: Told, battery_well: bool) -> Told:
    """Give what was told after a look at the battery (A8)."""
    return replace(told, battery_well=battery_well)


def with_fix(site: Railway, of: OfTrain, fix: TrainFix) -> OfTrain:
    """Give what was told of a train after one more report of GPS; what is none says nothing (A1, A2)."""
    if not is_report(fix.place_mm, fix.age_ms):
        return of
    told = replace(of, newest=fix)
    return replace(told, fix=fix, jumped=False) if fits(site, of.fix, fix) else replace(told, jumped=True)


def has_fresh_fix(site: Railway, of: OfTrain) -> bool:
    """Tell whether there is a fix, no older than is written (A1)."""
    return is_report(of.fix.place_mm, of.fix.age_ms) and of.fix.age_ms <= site.register.fresh.fix_ms


def has_another_part(display: Display) -> bool:
    """Tell whether the display shows a stretch in two parts, each in the figures of its line (A1)."""
    return display.other_from_mm != 1_000_000_001 or display.other_to_mm != 1_000_000_001


def is_in_a_stretch(display: Display) -> bool:
    """Tell whether the display shows a stretch of a line, or of two, lower ends first (A1)."""
    is_of_a_line = is_report(display.from_mm, display.age_ms) and is_report(display.to_mm, display.age_ms)
    is_of_another = is_report(display.other_from_mm, 0) and is_report(display.other_to_mm, 0)
    return (
        is_of_a_line
        and display.from_mm <= display.to_mm
        and (not has_another_part(display) or (is_of_another and display.other_from_mm <= display.other_to_mm))
    )


def is_shown(site: Railway, of: OfTrain) -> bool:
    """Tell whether the display shows a train, no longer ago than is written (A1)."""
    return is_in_a_stretch(of.display) and of.display.age_ms <= site.register.fresh.display_ms


def is_where_shown(site: Railway, of: OfTrain) -> bool:
    """Tell whether the fix is in the stretch shown, or as near to it as is written (A2)."""
    shown, place_mm, tolerance_mm = of.display, of.fix.place_mm, site.register.tolerance_mm
    return shown.from_mm - tolerance_mm <= place_mm <= shown.to_mm + tolerance_mm or (
        has_another_part(shown) and shown.other_from_mm - tolerance_mm <= place_mm <= shown.other_to_mm + tolerance_mm
    )


def is_told_alike(site: Railway, of: OfTrain) -> bool:
    """Tell whether both sources tell freshly of a train, and alike (A2)."""
    return has_fresh_fix(site, of) and is_shown(site, of) and is_where_shown(site, of)


def is_in(section: NoUse, place_mm: int) -> bool:
    """Tell whether a place is in a section, its ends included (A4, A5)."""
    return section.from_mm <= place_mm <= section.to_mm


def shunts(site: Railway, of: OfTrain) -> bool:
    """Tell whether a train is not on the display, and its fix is where trains shunt (004, 4.2; A5)."""
    return not is_shown(site, of) and any(
        section.reason == Reason.SHUNTING and is_in(section, of.fix.place_mm)
        for _name, section in site.register.sections.items()
    )


def heads(fix: TrainFix, way: Direction) -> bool:
    """Tell whether a fix tells of a train that runs that way (A3)."""
    return fix.is_running and fix.direction == way


def is_on_its_way_through(section: NoUse, fix: TrainFix) -> bool:
    """Tell whether a train was last seen in a section without GPS, and not in zone B of it (004, 4.1; A4)."""
    is_leaving_down = heads(fix, Direction.DOWN) and fix.place_mm > section.to_mm - section.zone_mm
    is_leaving_up = heads(fix, Direction.UP) and fix.place_mm < section.from_mm + section.zone_mm
    return (
        section.reason == Reason.WITHOUT_GPS
        and is_in(section, fix.place_mm)
        and not is_leaving_down
        and not is_leaving_up
    )


def is_between_the_ends(section: NoUse, worker_um: int) -> bool:
    """Tell whether the worker is in a section, whichever end of it is written first (A4, A5, A6)."""
    one_um, other_um = UM_A_MM * section.from_mm, UM_A_MM * section.to_mm
    return one_um <= worker_um <= other_um or other_um <= worker_um <= one_um


def is_known_by_one(site: Railway, train: Train, of: OfTrain) -> bool:
    """Tell whether one source alone tells of a train where that is registered: shunting, tunnel, roster (A4 to A6)."""
    if has_fresh_fix(site, of):
        return shunts(site, of)
    is_lost = is_report(of.fix.place_mm, of.fix.age_ms) and any(
        is_on_its_way_through(section, of.fix) for _name, section in site.register.sections.items()
    )
    is_stabled = any(
        section.reason == Reason.STABLING
        and (train, name) in site.register.stabled
        and is_in(section, of.display.from_mm)
        and is_in(section, of.display.to_mm)
        and not has_another_part(of.display)
        for name, section in site.register.sections.items()
    )
    return is_shown(site, of) and (is_lost or is_stabled)


def is_known(site: Railway, train: Train, told: Told) -> bool:
    """Tell whether a train is on the list, and known by both sources, or by one as registered (A2, A4 to A6)."""
    return train in told.trains and (
        is_told_alike(site, told.trains[train]) or is_known_by_one(site, train, told.trains[train])
    )


def is_listed(told: Told, train: Train) -> bool:
    """Tell whether the list has a train (A2)."""
    return train in told.trains


def has_listed_fix(site: Railway, told: Told, train: Train) -> bool:
    """Tell whether GPS tells freshly of a train that is on the list (A1, A2)."""
    return is_listed(told, train) and has_fresh_fix(site, told.trains[train])


def has_place(site: Railway, told: Told) -> bool:
    """Tell whether the worker's own place is told, no longer ago than is written (A8)."""
    worker = told.worker
    return is_report(worker.place_mm, worker.age_ms) and worker.age_ms <= site.register.fresh.worker_ms


def is_list_whole(listing: OfList) -> bool:
    """Tell whether the list was said to be whole, and as many entries were read as it has (A1)."""
    return listing.is_whole and listing.taken >= listing.count


def is_list_fresh(site: Railway, told: Told) -> bool:
    """Tell whether the list is whole and no older than is written, and the servers said to be well (A1, A8)."""
    is_young = 0 <= told.list_age_ms <= site.register.fresh.server_ms
    return is_young and told.servers_well and is_list_whole(told.listing)


def is_accounted_for(left_ms: int) -> bool:
    """Tell whether a train was reported to have left, and since then neither source told of it for 6 s (ours; A2)."""
    return 6_000 <= left_ms <= 3_600_000


def is_just_beyond(section: NoUse, fix: TrainFix, worker_um: int) -> bool:
    """Tell whether the worker is within 1500 m (004, 3.3) of an end by which a train may come out of a section (A4)."""
    down_um, up_um = worker_um - UM_A_MM * section.to_mm, UM_A_MM * section.from_mm - worker_um
    return (not heads(fix, Direction.UP) and 0 <= down_um <= UM_A_MM * 1_500_000) or (
        not heads(fix, Direction.DOWN) and 0 <= up_um <= UM_A_MM * 1_500_000
    )


def may_come_out_at(site: Railway, of: OfTrain, worker_um: int) -> bool:
    """Tell whether a train, on the display, is on its way through a section towards the worker (A4)."""
    return (
        is_shown(site, of)
        and (is_where_shown(site, of) or not has_fresh_fix(site, of))
        and any(
            is_on_its_way_through(section, of.fix) and is_just_beyond(section, of.fix, worker_um)
            for _name, section in site.register.sections.items()
        )
    )
