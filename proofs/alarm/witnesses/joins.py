"""Lines that join, on the register: how far a train is over a connection, and trains that pass there (A1 to A3)."""

from __future__ import annotations

from dataclasses import replace

from kernel.alarm import tone as machine
from kernel.alarm.distance import NO_TRAIN_FIX, UM_A_MM, Direction, TrainFix
from kernel.alarm.extents import End, Extent, Line
from kernel.alarm.least_ways import Equation, Join
from kernel.alarm.limits import is_lawful
from kernel.alarm.network import Connection, Way, jumps
from kernel.alarm.sections import NoUse, Reason, Section
from kernel.alarm.tone import Display, Known
from models.alarm.connections import connections
from models.alarm.line import BOUNDS, FRESH
from proofs.alarm.witnesses.worksite import (
    ALARM,
    BRANCH,
    CAUTION,
    DOWN,
    FAULT,
    FIRST,
    KM,
    NORMAL,
    OFF_MM,
    OTHER,
    REGISTER,
    UNKNOWN,
    UP,
    Day,
    handset,
    known,
    on_the_line,
)

JOIN_MM, THERE_MM = 50 * KM, 200 * KM
BEYOND = Section("beyond")
IN, OUT, ROUND = Way("in"), Way("out"), Way("round")
JOINED = replace(
    REGISTER,
    ways={IN: Connection(THERE_MM, JOIN_MM, 0), OUT: Connection(JOIN_MM, THERE_MM, 0)},
    openings={BRANCH: THERE_MM + 10 * KM},
)
"""A branch whose figures begin with 200 km at the join, and that goes on beyond the register after 10 km."""
AHEAD_MM = 3_000_000 + 60_000 + 27 * 12_000
"""3000 m, a train's length, and its way while a display is fresh."""


def heard(*trains: Known, worker_mm: int) -> machine.Tone:
    """The tone by the branch's register, all else being well."""
    return machine.tone(JOINED, handset(*trains, worker_mm=worker_mm))


def a_train_on_a_branch_is_as_far_as_the_track_is() -> None:
    """To the join and on from there, to the mm, on either side of it, whichever way it runs (A1, A3)."""
    for limit_mm, inside, outside in ((1_500_000, ALARM, CAUTION), (3_000_000, CAUTION, NORMAL)):
        for beyond_mm in (0, 300_000, 1_000_000):
            for side in (-1, 1):
                for heading in (UP, DOWN, UNKNOWN):
                    train = known(THERE_MM + beyond_mm, heading)
                    at_mm = JOIN_MM + side * (limit_mm + OFF_MM - beyond_mm)
                    assert heard(train, worker_mm=at_mm) == inside
                    assert heard(train, worker_mm=at_mm + side) == outside
    own = known(JOIN_MM - 300_000)
    assert heard(own, worker_mm=THERE_MM + 1_200_000 + OFF_MM) == ALARM
    assert heard(own, worker_mm=THERE_MM + 1_200_000 + OFF_MM + 1) == CAUTION


def what_lies_between_two_joins_counts() -> None:
    """The track from one to the other, which is on neither line, to the mm (A1)."""
    register = replace(JOINED, ways={IN: Connection(THERE_MM, JOIN_MM, 400_000)})
    for limit_mm, inside, outside in ((1_500_000, ALARM, CAUTION), (3_000_000, CAUTION, NORMAL)):
        train, at_mm = known(THERE_MM + 300_000), JOIN_MM - limit_mm - OFF_MM + 700_000
        assert machine.tone(register, handset(train, worker_mm=at_mm)) == inside
        assert machine.tone(register, handset(train, worker_mm=at_mm - 1)) == outside


def each_source_counts_over_a_join() -> None:
    """The display alone, a fix alone and one that jumped, as far as the track is (A1 to A4).

    A stretch within which lines join is no nearer than the join.
    """
    worker_mm = JOIN_MM - 1_000_000
    far = known(THERE_MM + 9 * KM)
    for near in (
        replace(far, jumped=True, newest=known(THERE_MM + 400_000).fix),
        replace(far, fix=known(THERE_MM + 400_000).fix),
        Known(NO_TRAIN_FIX, Display(THERE_MM + 400_000, THERE_MM + 900_000, 0), jumped=False, newest=NO_TRAIN_FIX),
        Known(NO_TRAIN_FIX, Display(THERE_MM, THERE_MM + 900_000, 0), jumped=False, newest=NO_TRAIN_FIX),
    ):
        assert heard(near, worker_mm=worker_mm) == ALARM
    for place_mm, expected in ((THERE_MM + 515_000, ALARM), (THERE_MM + 515_001, FAULT)):
        shown = Known(NO_TRAIN_FIX, Display(place_mm, place_mm + KM, 0), jumped=False, newest=NO_TRAIN_FIX)
        assert heard(shown, worker_mm=JOIN_MM - 1_070_000) == expected
    astride = Known(NO_TRAIN_FIX, Display(THERE_MM - KM, THERE_MM + KM, 0), jumped=False, newest=NO_TRAIN_FIX)
    for side in (-1, 1):
        assert heard(astride, worker_mm=JOIN_MM + side * 1_585_000) == ALARM
        assert heard(astride, worker_mm=JOIN_MM + side * 1_585_001) == FAULT


def a_stretch_over_a_join_is_told_in_two_parts() -> None:
    """A fix in either of them agrees, the nearer of both counts, and one that is told backwards shows no train (A2)."""
    shown = Display(JOIN_MM - 2 * KM, JOIN_MM, 0, THERE_MM, THERE_MM + 3 * KM)
    for place_mm, expected in (
        (JOIN_MM - KM, NORMAL),
        (THERE_MM + KM, NORMAL),
        (THERE_MM + 3_050_000, NORMAL),
        (THERE_MM + 3_050_001, FAULT),
        (THERE_MM - 50_001, FAULT),
        (JOIN_MM + 50_001, FAULT),
    ):
        train = replace(known(place_mm), display=shown)
        assert heard(train, worker_mm=JOIN_MM - 6 * KM) == expected
        assert machine.is_matched(JOINED, train) == (expected == NORMAL)
    lost = Known(NO_TRAIN_FIX, shown, jumped=False, newest=NO_TRAIN_FIX)
    for worker_mm in (JOIN_MM - 3_500_000, JOIN_MM + 1_500_000, THERE_MM + 4_500_000):
        assert heard(lost, worker_mm=worker_mm) == ALARM
    for other in (
        {"other_from_mm": THERE_MM + 3 * KM, "other_to_mm": THERE_MM},
        {"other_to_mm": 10**9 + 1},
        {"other_from_mm": 10**9 + 1},
        {"other_from_mm": -(10**9) - 1},
    ):
        train = replace(known(JOIN_MM - KM), display=replace(shown, **other))
        assert heard(train, worker_mm=JOIN_MM - 6 * KM) == FAULT


def near_an_opening_of_another_line_no_tone_is_mild() -> None:
    """As far as the track is to it, over the join, or along its own line (A3)."""
    register = replace(JOINED, openings={BRANCH: THERE_MM + 500_000})
    for at_mm, side in ((JOIN_MM - AHEAD_MM - 15_000 + 500_000, -1), (JOIN_MM + AHEAD_MM + 15_000 - 500_000, 1)):
        assert machine.tone(register, handset(worker_mm=at_mm)) == FAULT
        assert machine.tone(register, handset(worker_mm=at_mm + side)) == NORMAL
    assert machine.tone(JOINED, handset(worker_mm=JOIN_MM)) == NORMAL


def no_train_departs_where_lines_join() -> None:
    """Until all of it is surely past the join, or yet before it, its direction is not believed there (A3)."""
    for way, side in ((DOWN, 1), (UP, -1)):
        for age_ms in (0, 2_000):
            off_mm = 60_000 + 20_000 + 27 * age_ms
            for before_mm, expected in ((off_mm + 1, NORMAL), (off_mm, ALARM), (-off_mm, ALARM), (-off_mm - 1, NORMAL)):
                train = known(JOIN_MM - side * before_mm, way, age_ms=age_ms)
                assert heard(train, worker_mm=JOIN_MM - side * KM) == expected
    assert heard(known(THERE_MM + 400_000, DOWN), worker_mm=JOIN_MM - KM) == ALARM
    for off_mm, expected in ((15_000, ALARM), (15_001, NORMAL)):
        for side in (-1, 1):
            assert heard(known(JOIN_MM + KM, DOWN), worker_mm=JOIN_MM + side * off_mm) == expected


def what_is_told_beyond_one_more_join_is_near_yet() -> None:
    """A register that passes has the ways from there too: of a fix, a stretch, a worker and an opening (A1)."""
    far_mm = 3_060_000 + 27 * 12_000
    for between_mm in (far_mm - 10_000, far_mm + 1, far_mm + 20_000):
        joins = {
            Join("near"): Equation(JOIN_MM, THERE_MM),
            Join("far"): Equation(THERE_MM + between_mm, 300 * KM),
            Join("own"): Equation(JOIN_MM - 3_000, 400 * KM),
        }
        register = replace(REGISTER, openings={BRANCH: 300 * KM + 1_000})
        register = replace(register, ways=connections(register, joins))
        lines = {
            Line("main"): Extent(0, 100 * KM, End.BUFFER_STOP, End.BUFFER_STOP),
            Line("branch"): Extent(THERE_MM, THERE_MM + 10 * KM, End.JOIN, End.BUFFER_STOP),
            Line("beyond"): Extent(300 * KM, 310 * KM, End.JOIN, End.BUFFER_STOP),
            Line("own"): Extent(400 * KM, 410 * KM, End.JOIN, End.BUFFER_STOP),
        }
        assert is_lawful(register, joins, lines)
        for worker_mm, more_mm in ((JOIN_MM, 0), (400 * KM + 2_000, 5_000)):
            for told, off_mm in (
                (known(300 * KM + 12_000, UP, age_ms=12_000, shown=False), 20_000 - 12_000),
                (replace(known(0), fix=NO_TRAIN_FIX, display=Display(300 * KM + 8_000, 301 * KM, 12_000)), 2_000),
            ):
                plain = replace(register, openings={})
                near = between_mm + more_mm <= far_mm + 15_000 + off_mm
                assert machine.may_be_near(plain, told, handset(worker_mm=worker_mm).worker, 3_000_000) == (
                    near and machine.has_fix(plain, told) | machine.has_display(plain, told)
                )
            assert machine.is_near_an_opening(register, handset(worker_mm=worker_mm).worker) == (
                between_mm + more_mm + 1_000 <= far_mm + 15_000
            )


def who_is_told_beyond_a_join_may_be_in_a_section() -> None:
    """A worker just within a section beyond a join, whose own fix is short of that: the handset is not used (A4)."""
    register = replace(JOINED, sections={BEYOND: NoUse(Reason.WITHOUT_GPS, THERE_MM, THERE_MM + KM, 400_000)})
    for short_mm, expected in ((15_000, FAULT), (15_001, NORMAL)):
        for side in (-1, 1):
            assert machine.tone(register, handset(worker_mm=JOIN_MM + side * short_mm)) == expected
    inside = replace(JOINED, sections={BEYOND: NoUse(Reason.SHUNTING, THERE_MM + 4_000, THERE_MM + KM, 0)})
    for short_mm, expected in ((11_000, FAULT), (11_001, NORMAL)):
        assert machine.tone(inside, handset(worker_mm=JOIN_MM - short_mm)) == expected


def no_fix_jumps_where_lines_join() -> None:
    """From one line's figures to the other's, either way: by what the train can have run, to the mm (A1, A2)."""
    for before_mm, after_mm in ((JOIN_MM - 30_000, THERE_MM + 37_000), (THERE_MM + 30_000, JOIN_MM + 37_000)):
        before, fix = known(before_mm, age_ms=1_000).fix, known(after_mm).fix
        assert not jumps(BOUNDS, JOINED.ways, before, fix)
        assert jumps(BOUNDS, JOINED.ways, before, replace(fix, place_mm=after_mm + 1))
        assert jumps(BOUNDS, {}, before, fix)
        for way in (IN, OUT):
            one_way = {way: JOINED.ways[way]}
            assert not jumps(BOUNDS, one_way, before, fix)
            assert jumps(BOUNDS, one_way, before, replace(fix, place_mm=after_mm + 1))


def joined(worker_mm: int) -> Day:
    """A worker's day beside lines that join."""
    return Day(worker_mm, JOINED)


def pass_out(day: Day) -> None:
    """A train that stands at the join passes out there."""
    day.step("pass_out", train=FIRST, way=IN)
    body = day.system.bodies[FIRST]
    assert (body.is_on, body.ways_um[IN], body.passed_ms) == (False, 0, 0)


def tell(day: Day, place_mm: int, heading: Direction = UNKNOWN) -> None:
    """Both sources tell of a train in the branch's figures."""
    fix = TrainFix(place_mm, 0, heading, heading != UNKNOWN)
    day.step("take_display", train=FIRST, display=Display(THERE_MM, THERE_MM + 4 * KM, 0), at_um=0)
    day.step("take_fix", train=FIRST, fix=fix, at_um=0, is_right=True)
    assert day.system.handset.trains[FIRST].fix == fix
    assert day.system.bodies[FIRST].fix_is_right


def run(day: Day, elapsed_ms: int, way_um: int) -> None:
    """Time passes, and a train on the branch is so far from the line then."""
    body = day.system.bodies[FIRST]
    day.intend(FIRST, body.antenna_um, body.heading, {IN: way_um})
    day.step("pass_time", elapsed_ms=elapsed_ms, worker_to_um=day.system.worker_um)
    assert day.system.bodies[FIRST].ways_um == {IN: way_um}


def a_train_passes_onto_a_branch_and_comes_back() -> None:
    """It departs, is near again at the join and on the branch, is far, and comes back onto the line (A1, A3)."""
    day = joined(JOIN_MM - KM)
    day.hear()
    day.come(FIRST, JOIN_MM - 400_000)
    day.run(1_000, (FIRST, DOWN))
    day.tell(FIRST, DOWN)
    assert day.tone() == NORMAL
    while day.system.bodies[FIRST].antenna_um < UM_A_MM * (JOIN_MM - 27_000):
        day.run(1_000, (FIRST, DOWN))
    body = day.system.bodies[FIRST]
    day.intend(FIRST, UM_A_MM * JOIN_MM, DOWN)
    day.step("pass_time", elapsed_ms=1_000, worker_to_um=day.system.worker_um)
    assert body.antenna_um < day.system.bodies[FIRST].antenna_um
    day.hear()
    day.tell(FIRST, DOWN)
    pass_out(day)
    assert day.tone() == ALARM
    assert day.heard.within_1500.over_other_lines
    run(day, 1_000, UM_A_MM * 27_000)
    assert day.tone() == ALARM
    for seconds, tone in ((10, ALARM), (5, ALARM), (20, CAUTION), (30, CAUTION), (50, NORMAL)):
        for _ in range(seconds):
            run(day, 1_000, day.system.bodies[FIRST].ways_um[IN] + UM_A_MM * 27_000)
            tell(day, THERE_MM + day.system.bodies[FIRST].ways_um[IN] // UM_A_MM, DOWN)
        day.hear()
        assert (seconds, day.tone()) == (seconds, tone)
        assert day.heard.matched_within_1500 == day.heard.within_1500
        assert day.heard.within_1500.over_other_lines == (tone == ALARM)
    while day.system.bodies[FIRST].ways_um[IN] > 0:
        run(day, 1_000, max(0, day.system.bodies[FIRST].ways_um[IN] - UM_A_MM * 27_000))
        tell(day, THERE_MM + day.system.bodies[FIRST].ways_um[IN] // UM_A_MM)
    day.hear()
    assert day.tone() == ALARM
    day.step("pass_in", train=FIRST, way=IN, at_um=UM_A_MM * JOIN_MM, heading=UP)
    body = day.system.bodies[FIRST]
    assert (body.is_on, body.antenna_um, body.heading, body.passed_ms) == (True, UM_A_MM * JOIN_MM, UP, 0)
    assert day.tone() == ALARM
    day.run(1_000, (FIRST, UP))
    day.tell(FIRST, UP)
    assert day.system.bodies[FIRST].passed_ms == 1_000
    assert day.tone() == ALARM


def a_train_comes_back_round_a_loop_without_turning() -> None:
    """It was told to run away, before it came to the join, and runs towards the worker now: the alarm (A3)."""
    day = Day(JOIN_MM - KM, replace(JOINED, ways=JOINED.ways | {ROUND: Connection(JOIN_MM + KM, JOIN_MM, 100_000)}))
    day.hear()
    day.come(FIRST, JOIN_MM - 27_000)
    day.run(1_000, (FIRST, DOWN))
    day.tell(FIRST, DOWN)
    day.step("pass_out", train=FIRST, way=IN)
    body = day.system.bodies[FIRST]
    day.intend(FIRST, body.antenna_um, UNKNOWN, {IN: 0})
    day.step("pass_time", elapsed_ms=4_000, worker_to_um=day.system.worker_um)
    day.step("pass_in", train=FIRST, way=IN, at_um=UM_A_MM * JOIN_MM, heading=UP)
    day.run(1_000, (FIRST, UP))
    day.hear()
    assert day.system.told.trains[FIRST].fix.direction == DOWN
    assert day.tone() == ALARM
    assert day.heard.matched_within_1500.along_his_line


def a_train_comes_by_an_opening_of_another_line() -> None:
    """It is no nearer than the register has that opening; near that no tone is mild (A1, A3)."""
    day = joined(JOIN_MM - KM)
    day.hear()
    day.let_on(FIRST)
    came = replace(on_the_line(0, UNKNOWN), is_on=False, ways_um={IN: UM_A_MM * AHEAD_MM}, came_by=BRANCH)
    kept = day.system
    assert day.step("come_by", train=FIRST, body=came) == kept
    day.step("come_by", train=FIRST, body=replace(came, ways_um={IN: UM_A_MM * AHEAD_MM + 1}))
    assert day.system.bodies[FIRST].came_ms == day.system.bodies[FIRST].passed_ms == 0
    day = Day(JOIN_MM - KM, replace(JOINED, openings={BRANCH: THERE_MM + KM}))
    day.hear()
    day.let_on(FIRST)
    kept = day.system
    assert day.step("come_by", train=FIRST, body=replace(came, ways_um={IN: UM_A_MM * KM - 1})) == kept
    day.step("come_by", train=FIRST, body=replace(came, ways_um={IN: UM_A_MM * KM}))
    assert day.tone() == FAULT
    assert day.heard.within_3000.over_other_lines


def no_train_passes_but_where_lines_join() -> None:
    """Nor has it been where it was not, by the register (A1)."""
    day = joined(JOIN_MM - KM)
    day.hear()
    day.come(FIRST, JOIN_MM - 1)
    day.tell(FIRST)
    kept = day.system
    for train, way in ((FIRST, IN), (FIRST, OUT), (OTHER, IN)):
        assert day.step("pass_out", train=train, way=way) == kept
        assert day.step("pass_in", train=train, way=way, at_um=UM_A_MM * JOIN_MM, heading=UP) == kept
    day.intend(FIRST, UM_A_MM * JOIN_MM, DOWN)
    day.step("pass_time", elapsed_ms=1, worker_to_um=day.system.worker_um)
    pass_out(day)
    kept = day.system
    assert day.step("pass_out", train=FIRST, way=IN) == kept
    assert day.step("pass_in", train=FIRST, way=IN, at_um=UM_A_MM * JOIN_MM + 1, heading=UP) == kept
    assert day.step("pass_in", train=FIRST, way=OUT, at_um=UM_A_MM * THERE_MM, heading=UP) == kept
    run(day, 1_000, UM_A_MM * 1_000)
    kept = day.system
    assert day.step("pass_in", train=FIRST, way=IN, at_um=UM_A_MM * JOIN_MM, heading=UP) == kept
    day.intend(FIRST, 0, UP, {IN: UM_A_MM * 1_000 - 27_000 - 1})
    kept = day.system
    assert day.step("pass_time", elapsed_ms=1, worker_to_um=kept.worker_um) == kept
    day.intend(FIRST, 0, UP, {IN: 0, OUT: 0})
    kept = day.system
    assert day.step("pass_time", elapsed_ms=1_000, worker_to_um=kept.worker_um) == kept
    day.intend(FIRST, 0, UP, {IN: UM_A_MM * 1_000})
    kept = day.system
    shown = Display(THERE_MM + 11_001, THERE_MM + KM, 0)
    assert day.step("take_display", train=FIRST, display=shown, at_um=0) == kept
    garbage = replace(shown, age_ms=-1)
    day.step("take_display", train=FIRST, display=garbage, at_um=0)
    assert day.system.told.trains[FIRST].display == garbage, "what is no report of a stretch may show any"
    day.system = kept
    for place_mm in (THERE_MM + 21_001, JOIN_MM + 21_001):
        fix = TrainFix(place_mm, 0, UNKNOWN, is_running=False)
        assert day.step("take_fix", train=FIRST, fix=fix, at_um=0, is_right=True) == kept
    day.step("take_display", train=FIRST, display=replace(shown, from_mm=THERE_MM + 11_000), at_um=0)
    assert day.system.told.trains[FIRST].display.from_mm == THERE_MM + 11_000
    tell(day, THERE_MM + 21_000)
    tell(day, THERE_MM + 19_000)
    near = TrainFix(JOIN_MM - 20_000, 0, UNKNOWN, is_running=False)
    day.step("take_fix", train=FIRST, fix=near, at_um=0, is_right=True)
    assert day.system.told.trains[FIRST].fix == near


def who_has_passed_a_join_is_where_that_lets_him_be() -> None:
    """Told on the branch, and on the line now; told on the line, and on it again (A1)."""
    day = joined(JOIN_MM - 4 * KM)
    day.hear()
    day.come(FIRST, JOIN_MM)
    day.step("pass_out", train=FIRST, way=IN)
    run(day, 1_000, UM_A_MM * 10_000)
    tell(day, THERE_MM + 10_000)
    run(day, 1_000, 0)
    day.step("pass_in", train=FIRST, way=IN, at_um=UM_A_MM * JOIN_MM, heading=UP)
    day.run(1_000, (FIRST, UP))
    day.step("restart_handset")
    day.hear()
    kept = day.system
    off_mm = 20_000 + 27 * 2_000
    for place_mm, is_there in (
        (THERE_MM + off_mm - 27_000 + 1, False),
        (THERE_MM + off_mm - 27_000, True),
        (JOIN_MM + off_mm, False),
        (JOIN_MM - off_mm - 1, False),
        (JOIN_MM - off_mm, True),
    ):
        fix = TrainFix(place_mm, 2_000, UNKNOWN, is_running=False)
        told = day.step("take_fix", train=FIRST, fix=fix, at_um=0, is_right=True)
        assert (place_mm, told.told.trains[FIRST].fix == fix) == (place_mm, is_there)
        day.system = kept
    reach_mm = 10_000 + 27 * 2_000
    for from_mm, is_there in ((THERE_MM + reach_mm - 27_000, True), (THERE_MM + reach_mm - 27_000 + 1, False)):
        shown = Display(from_mm, THERE_MM + KM, 2_000)
        after = day.step("take_display", train=FIRST, display=shown, at_um=0)
        assert (after.told.trains[FIRST].display == shown) == is_there
        day.system = kept
    assert FRESH.fix_ms > 2_000


WITNESSES = (
    a_train_on_a_branch_is_as_far_as_the_track_is,
    what_lies_between_two_joins_counts,
    each_source_counts_over_a_join,
    a_stretch_over_a_join_is_told_in_two_parts,
    near_an_opening_of_another_line_no_tone_is_mild,
    no_train_departs_where_lines_join,
    what_is_told_beyond_one_more_join_is_near_yet,
    who_is_told_beyond_a_join_may_be_in_a_section,
    no_fix_jumps_where_lines_join,
    a_train_passes_onto_a_branch_and_comes_back,
    a_train_comes_back_round_a_loop_without_turning,
    a_train_comes_by_an_opening_of_another_line,
    no_train_passes_but_where_lines_join,
    who_has_passed_a_join_is_where_that_lets_him_be,
)
