"""A line with a tunnel, a yard and a siding, a worker with a handset, and what both sources tell (A1 to A8)."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from kernel.alarm import tone as machine
from kernel.alarm import train_list
from kernel.alarm.distance import (
    GREATEST_AGE_MS,
    NO_TRAIN_FIX,
    UM_A_MM,
    Direction,
    TrainFix,
    WorkerFix,
)
from kernel.alarm.network import Opening, Way
from kernel.alarm.sections import NoUse, Reason, Section
from kernel.alarm.tone import NO_DISPLAY, NOTHING_KNOWN, Display, Handset, Known, Listing, Register, Tone, Train
from kernel.maps import Map
from models.alarm.line import BOUNDS, FRESH
from models.alarm.worksite import (
    NOBODY_NEAR,
    NOWHERE_NEAR,
    Body,
    Heard,
    Lists,
    Near,
    Railway,
    Worksite,
    nothing_told_to_the_handset,
)
from proofs.alarm.alarm_tone import THEORY
from proofs.onboard.witnesses.play import Play

DOWN, UP, UNKNOWN = Direction.DOWN, Direction.UP, Direction.UNKNOWN
ALARM, FAULT, CAUTION, NORMAL = Tone.ALARM, Tone.FAULT, Tone.CAUTION, Tone.NORMAL
TUNNEL, YARD, SIDING = Section("tunnel"), Section("yard"), Section("siding")
BRANCH, NOWHERE = Opening("branch"), Opening("nowhere")
ACROSS, NO_WAY = Way("across"), Way("none")
KM = 1_000_000
REGISTER = Register(
    BOUNDS,
    FRESH,
    display_error_mm=10_000,
    tolerance_mm=50_000,
    sections={
        TUNNEL: NoUse(Reason.WITHOUT_GPS, 20 * KM, 23 * KM, zone_mm=400_000),
        YARD: NoUse(Reason.SHUNTING, 40 * KM, 41 * KM, zone_mm=0),
        SIDING: NoUse(Reason.STABLING, 60 * KM, 61 * KM, zone_mm=0),
    },
    stabled=frozenset({(Train("9D"), SIDING)}),
    ways={},
    openings={BRANCH: 90 * KM},
    edition=1,
)
SITE = Railway(REGISTER)
WORKER_MM = 10 * KM
OFF_MM = 60_000 + 20_000 + 15_000
"""Taken off with new fixes: length and both errors."""
HUGE = 2**62
READ = Listing(life_ms=1, taken=0, count=0, is_whole=True, named={})
"""A list that is whole, and has been read."""
ON_HIS_LINE = replace(NOWHERE_NEAR, along_his_line=True)
FIRST, OTHER, STABLED = Train("1D"), Train("2U"), Train("9D")


def known(place_mm: int, heading: Direction = UNKNOWN, *, age_ms: int = 0, shown: bool = True) -> Known:
    """Both sources say the same, but for a display that shows nothing."""
    fix = TrainFix(place_mm, age_ms, heading, heading != UNKNOWN)
    return Known(
        fix,
        Display(place_mm - 2 * KM, place_mm + 2 * KM, age_ms) if shown else NO_DISPLAY,
        jumped=False,
        newest=NO_TRAIN_FIX,
    )


def handset(*trains: Known, worker_mm: int = WORKER_MM) -> Handset:
    """All is well."""
    names = (FIRST, OTHER)
    return Handset(WorkerFix(worker_mm, 0), 0, True, True, READ, dict(zip(names, trains, strict=False)))


def tone(*trains: Known, worker_mm: int = WORKER_MM) -> Tone:
    """The tone, all else being well."""
    return machine.tone(REGISTER, handset(*trains, worker_mm=worker_mm))


def stabled(display: Display, fix: TrainFix = NO_TRAIN_FIX, name: Train = STABLED, worker_mm: int = 50 * KM) -> Tone:
    """The tone with one train on the display alone."""
    return machine.tone(
        REGISTER,
        replace(handset(worker_mm=worker_mm), trains={name: Known(fix, display, jumped=False, newest=NO_TRAIN_FIX)}),
    )


def on_the_line(at_um: int, heading: Direction, below_mm: int = 58_000, above_mm: int = 2_000) -> Body:
    """A train that was made up on the worker's line, and comes to it over no other one."""
    return Body(
        True, at_um, heading, below_mm, above_mm, {}, at_um, heading, {}, True, GREATEST_AGE_MS + 1, NOWHERE,
        GREATEST_AGE_MS + 1,
    )  # fmt: skip


def both(one: Heard, other: Heard) -> Heard:
    """Put together what was so at one moment, by two steps that listened then."""
    either: dict[str, Any] = {
        name: said or vars(other)[name] for name, said in vars(one).items() if isinstance(said, bool)
    }
    return replace(
        one,
        within_3000=near_by_either(one.within_3000, other.within_3000),
        within_1500=near_by_either(one.within_1500, other.within_1500),
        matched_within_1500=near_by_either(one.matched_within_1500, other.matched_within_1500),
        **either,
    )


def near_by_either(one: Near, other: Near) -> Near:
    """Put together by which ways some train was near."""
    return Near(**{name: said or vars(other)[name] for name, said in vars(one).items()})


class Day(Play[Railway, Worksite]):
    """A worker who stands at 10 km, and hears the tone after each step."""

    def __init__(self, worker_mm: int = WORKER_MM, register: Register = REGISTER) -> None:
        """Begin: the server and the handset have started, nothing was told, and no train is there."""
        server, lists = train_list.started(0), Lists({}, {}, {}, {}, {}, frozenset())
        told, nothing = nothing_told_to_the_handset(), machine.switched_on()
        site, self.heard = Railway(register), NOBODY_NEAR
        super().__init__(THEORY, site, Worksite(UM_A_MM * worker_mm, {}, server, 0, lists, told, nothing, NOBODY_NEAR))
        self.step("look_at_the_battery", battery_well=True)

    def tone(self) -> Tone:
        """Listen."""
        return self.tone_with(NOWHERE, 0)

    def tone_with(self, opening: Opening, beyond_mm: int) -> Tone:
        """Listen while a train is beyond an opening; all that was so goes into ``heard``."""
        self.heard = self.listen("listen", opening=opening, beyond_um=UM_A_MM * beyond_mm)
        for train in self.system.bodies:
            for way in (*self.site.register.ways, NO_WAY):
                for kind in ("that_came", "with_a_fix", "without_a_fix"):
                    seen = self.listen(f"listen_for_one_{kind}", train=train, way=way)
                    self.heard = both(self.heard, seen)
        return self.heard.tone

    def listen(self, step: str, **event: Any) -> Heard:
        """Take one of the steps that listen, from a moment before which nothing was so."""
        before = replace(self.system, heard=replace(NOBODY_NEAR, tone=self.system.heard.tone))
        self.system = before
        self.step(step, **event)
        assert replace(self.system, heard=before.heard) == before
        return self.system.heard

    def hear(self, *, age_ms: int = 0, well: bool = True) -> None:
        """The server's list comes, confirmed if it can be, and the worker's own fix."""
        self.step("confirm_the_list")
        self.step("hear_confirmation", life_ms=self.system.server.life_ms)
        self.step("send_summary")
        self.summary(age_ms=age_ms, well=well)
        self.entries()
        self.summary(age_ms=age_ms, well=well)
        self.locate()
        assert (self.system.handset.server_age_ms, self.system.handset.servers_well) == (age_ms, well)

    def locate(self) -> None:
        """The handset takes a fix of its own."""
        self.step("take_worker_fix", fix=WorkerFix(self.system.worker_um // UM_A_MM, 0), at_um=self.system.worker_um)

    def summary(self, *, age_ms: int = 0, well: bool = True) -> None:
        """What the server says of its list comes."""
        said = train_list.summary(self.system.server)
        self.step(
            "hear_summary",
            life_ms=said.life_ms,
            count=said.count,
            is_whole=said.is_whole,
            age_ms=age_ms,
            servers_well=well,
        )

    def entries(self) -> None:
        """All entries that the server has written are sent, and come."""
        for number in range(1, self.system.server.count + 1):
            self.step("send_entry", number=number)
            self.step("hear_entry", life_ms=self.system.server.life_ms, number=number)

    def name(self, train: Train) -> None:
        """A number is entered, and the handset has read it."""
        self.step("enter", train=train)
        self.step("send_summary")
        self.summary()
        self.entries()
        assert self.system.handset.trains[train] == NOTHING_KNOWN

    def let_on(self, train: Train) -> None:
        """A train is entered, longer ago than a list stays fresh; all others stand meanwhile."""
        self.name(train)
        self.run(REGISTER.fresh.server_ms + 1)
        self.hear()

    def come(self, train: Train, at_mm: int, heading: Direction = DOWN) -> None:
        """A train is made up on the line, after it was let on."""
        self.let_on(train)
        at_um = UM_A_MM * at_mm
        body = replace(on_the_line(at_um, heading), fix_is_right=False, passed_ms=0, came_ms=0)
        self.step("come", train=train, body=body)
        assert self.system.bodies[train] == on_the_line(at_um, heading)

    def go(self, train: Train) -> None:
        """A train leaves, is reported to have left, and neither source tells of it; others stand meanwhile."""
        self.step("leave", train=train)
        self.step("report_left", train=train)
        self.run(6_000)
        self.step("strike_off", train=train)
        self.hear()
        assert train not in self.system.server.trains
        assert train not in self.system.handset.trains

    def tell(self, train: Train, heading: Direction = UNKNOWN, *, off_mm: int = 0, display: bool = True) -> Known:
        """Both sources tell of a train, or GPS alone; ``off_mm``: how wrong the fix is."""
        at_um = self.system.bodies[train].antenna_um
        fix = TrainFix(at_um // UM_A_MM + off_mm, 0, heading, heading != UNKNOWN)
        if display:
            shown = Display(at_um // UM_A_MM - 2 * KM, at_um // UM_A_MM + 2 * KM, 0)
            self.step("take_display", train=train, display=shown, at_um=at_um)
            assert self.system.handset.trains[train].display == shown
        right, was_right = abs(off_mm) <= BOUNDS.train_error_mm, self.system.bodies[train].fix_is_right
        before = self.system.handset.trains[train]
        self.step("take_fix", train=train, fix=fix, at_um=at_um, is_right=right)
        jumped = self.system.handset.trains[train].jumped
        assert self.system.handset.trains[train].fix == (before.fix if jumped else fix)
        assert self.system.bodies[train].fix_is_right == (was_right if jumped else right)
        return self.system.handset.trains[train]

    def intend(self, train: Train, to_um: int, heading: Direction, ways_um: Map[Way, int] | None = None) -> Worksite:
        """A driver intends something; from the line no other leads back to it, if nothing else is said."""
        body = self.system.bodies.get(train)
        stays = {} if body is None or body.is_on else body.ways_um
        return self.step(
            "intend", train=train, to_um=to_um, heading=heading, ways_um=stays if ways_um is None else ways_um
        )

    def run(self, elapsed_ms: int, *moves: tuple[Train, Direction], walks_mm_s: int = 0) -> None:
        """Time passes; trains named run at the line's speed."""
        for train, way in moves:
            heading = self.system.bodies[train].heading if way == UNKNOWN else way
            way_um = {DOWN: 27_000, UP: -27_000, UNKNOWN: 0}[way] * elapsed_ms
            to_um = self.system.bodies[train].antenna_um + way_um
            self.intend(train, to_um, heading)
            assert self.system.bodies[train].next_um == to_um
            assert self.system.bodies[train].next_heading == heading
        worker_to_um = self.system.worker_um + walks_mm_s * elapsed_ms
        self.step("pass_time", elapsed_ms=elapsed_ms, worker_to_um=worker_to_um)
        assert self.system.worker_um == worker_to_um
        for train, _ in moves:
            body = self.system.bodies[train]
            assert (body.antenna_um, body.heading) == (body.next_um, body.next_heading)
        for train, _ in moves:
            body = self.system.bodies[train]
            self.intend(train, body.antenna_um, body.heading)
