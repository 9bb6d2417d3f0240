"""Registers that are loaded or refused, by their ways and their lines, and walks from line to line (A1)."""

from __future__ import annotations

from dataclasses import replace

from kernel.alarm.distance import UM_A_MM
from kernel.alarm.extents import End, Extent, Line, has_joins_on_lines
from kernel.alarm.least_ways import Equation, Join, far_um, has_least_ways
from kernel.alarm.limits import is_lawful
from kernel.alarm.network import Connection, Opening, Way
from kernel.alarm.sections import NoUse, Reason, Section
from kernel.alarm.tone import Register
from models.alarm.alarm_network import Tracks, Walk
from models.alarm.along import told_far_um as far_by_the_requirement_um
from models.alarm.connections import connections
from models.alarm.line import REGISTER as LINE
from proofs.alarm.alarm_network import THEORY
from proofs.onboard.witnesses.play import Play

KM = 1_000_000
WEST, EAST = Join("west"), Join("east")
JOINS = {WEST: Equation(10 * KM, 100 * KM), EAST: Equation(102 * KM, 14 * KM)}
"""A loop of 2 km leaves a line at 10 km and comes back at 14 km."""
WAYS = {
    Way("in at west"): Connection(100 * KM, 10 * KM, 0),
    Way("out at west"): Connection(10 * KM, 100 * KM, 0),
    Way("in at east"): Connection(102 * KM, 14 * KM, 0),
    Way("out at east"): Connection(14 * KM, 102 * KM, 0),
    Way("round to west"): Connection(14 * KM, 10 * KM, 2 * KM),
    Way("round to east"): Connection(10 * KM, 14 * KM, 2 * KM),
}
MAIN, LOOP, NORTH = Line("main"), Line("loop"), Opening("north")
JOIN, OPENING, BUFFER_STOP = End.JOIN, End.OPENING, End.BUFFER_STOP
LINES = {MAIN: Extent(0, 40 * KM, BUFFER_STOP, OPENING), LOOP: Extent(100 * KM, 102 * KM, JOIN, JOIN)}
"""The line ends at 0; beyond 40 km it goes on off the register."""
SURVEYED = replace(LINE, openings={NORTH: 40 * KM})
REGISTER = replace(SURVEYED, ways=WAYS)
SITE = Tracks(SURVEYED, JOINS, LINES)


class Walking(Play[Tracks, Walk]):
    """A walk, before it begins."""

    def __init__(self) -> None:
        """Begin with nothing loaded."""
        super().__init__(THEORY, SITE, Walk({}, False, False, 0, 0, 0, False))


def round_the_loop_and_back() -> None:
    """In at the west, over the loop, out at the east, on along the line: never nearer than the register has it."""
    walk = Walking()
    assert walk.step("load", ways=WAYS).is_accepted
    walk.step("begin", join=WEST, is_turned=False)
    assert walk.system == Walk(WAYS, True, True, 10 * KM, UM_A_MM * 100 * KM, 0, False)
    before = walk.system
    assert walk.step("cross", join=EAST, is_turned=False) == before
    walk.step("walk_on", to_um=UM_A_MM * 102 * KM)
    walk.step("cross", join=EAST, is_turned=False)
    assert walk.system == Walk(WAYS, True, True, 10 * KM, UM_A_MM * 14 * KM, UM_A_MM * 2 * KM, False)
    walk.step("walk_on", to_um=UM_A_MM * 13 * KM)
    assert walk.system.walked_um == UM_A_MM * 3 * KM
    walk.step("walk_on", to_um=UM_A_MM * 10 * KM)
    assert walk.system.walked_um > far_um(REGISTER)
    walk.step("begin", join=WEST, is_turned=False)
    walk.step("cross", join=WEST, is_turned=True)
    assert walk.system == Walk(WAYS, True, False, 10 * KM, UM_A_MM * 10 * KM, 0, False)
    walk.step("begin", join=EAST, is_turned=True)
    assert (walk.system.start_mm, walk.system.at_um) == (14 * KM, UM_A_MM * 102 * KM)
    assert walk.step("begin", join=Join("nowhere"), is_turned=True).start_mm == 14 * KM


def what_is_missing_or_too_long_is_refused() -> None:
    """Each connection that another does not make up for, to the mm (A1)."""
    assert has_least_ways(REGISTER, JOINS)
    assert has_least_ways(REGISTER, {})
    for way, connection in WAYS.items():
        longer = replace(connection, between_mm=connection.between_mm + 1)
        fewer = {other: each for other, each in WAYS.items() if other != way}
        for ways in (WAYS | {way: longer}, fewer):
            assert not has_least_ways(replace(REGISTER, ways=ways), JOINS), way
            assert not Walking().step("load", ways=ways).is_accepted
        shorter = replace(connection, between_mm=connection.between_mm - 1)
        assert shorter not in WAYS.values()


def what_is_far_need_not_be_written() -> None:
    """3000 m, a train's length, what it and the worker run while they are told, and what they are told too far (A1)."""
    alone_mm = 3_060_000 + 15_000 + 2 * 5_000
    far_mm = alone_mm + 27 * 12_000 + 100_000
    assert far_um(REGISTER) == far_by_the_requirement_um(REGISTER) == UM_A_MM * far_mm
    for other, more_mm in (
        (replace(REGISTER, fresh=replace(REGISTER.fresh, fix_ms=20_000)), 27 * 8_000),
        (replace(REGISTER, bounds=replace(REGISTER.bounds, train_error_mm=130_000)), 30_000),
        (replace(REGISTER, bounds=replace(REGISTER.bounds, worker_error_mm=15_001)), 1),
        (replace(REGISTER, fresh=replace(REGISTER.fresh, worker_ms=5_001)), 2),
    ):
        assert far_um(other) == far_by_the_requirement_um(other) == UM_A_MM * (far_mm + more_mm)
    joins = {WEST: Equation(10 * KM, 100 * KM), EAST: Equation(100 * KM + far_mm, 200 * KM)}
    ways = {
        Way("in"): Connection(100 * KM, 10 * KM, 0),
        Way("out"): Connection(10 * KM, 100 * KM, 0),
        Way("in beyond"): Connection(200 * KM, 100 * KM + far_mm, 0),
        Way("out beyond"): Connection(100 * KM + far_mm, 200 * KM, 0),
    }
    assert not has_least_ways(replace(REGISTER, ways=ways), joins)
    farther = joins | {EAST: Equation(100 * KM + far_mm + 1, 200 * KM)}
    beyond = {
        Way("in beyond"): Connection(200 * KM, 100 * KM + far_mm + 1, 0),
        Way("out beyond"): Connection(100 * KM + far_mm + 1, 200 * KM, 0),
    }
    assert has_least_ways(replace(REGISTER, ways=ways | beyond), farther)


# ---- lines


def is_refused(
    register: Register | None = None, joins: dict[Join, Equation] | None = None, lines: dict[Line, Extent] | None = None
) -> bool:
    """Tell whether one may not use a register: with something else in it, or in its survey."""
    return not is_lawful(register or REGISTER, JOINS if joins is None else joins, LINES if lines is None else lines)


def two_lines_that_begin_with_0_where_they_join_are_refused() -> None:
    """Nobody writes an equation, or he writes one of 0 with 0; a line that is written twice is refused too (A1)."""
    other = Line("other")
    plain = replace(LINE, ways={}, sections={})
    for end in (BUFFER_STOP, JOIN):
        both = {MAIN: Extent(0, 40 * KM, end, BUFFER_STOP), other: Extent(0, 30 * KM, end, BUFFER_STOP)}
        assert is_refused(plain, {}, both)
        zero = Equation(0, 0)
        assert is_refused(replace(plain, ways={Way("0"): Connection(0, 0, 0)}), {WEST: zero}, both)
        assert is_refused(plain, {}, {MAIN: both[MAIN], other: both[MAIN]})
    alone = {MAIN: Extent(0, 40 * KM, BUFFER_STOP, BUFFER_STOP)}
    assert not is_refused(plain, {}, alone)
    assert not is_refused(plain, {}, alone | {other: Extent(100 * KM, 130 * KM, BUFFER_STOP, BUFFER_STOP)})


def lines_lie_as_far_apart_as_what_is_told_beyond_both_their_ends() -> None:
    """Twice the greatest of what GPS and display err and how far they may disagree, either way, to the mm (A1, A2)."""
    plain, other = replace(LINE, sections={}), Line("other")
    bounds = plain.bounds
    for register, reach_mm in (
        (plain, 150_000),
        (replace(plain, tolerance_mm=0), 100_000),
        (replace(plain, tolerance_mm=0, display_error_mm=0), 20_000),
        (replace(plain, tolerance_mm=0, display_error_mm=0, bounds=replace(bounds, train_error_mm=0)), 15_000),
    ):
        for apart_mm, refused in ((2 * reach_mm, True), (2 * reach_mm + 1, False)):
            lines = {MAIN: Extent(0, KM, BUFFER_STOP, BUFFER_STOP)}
            after = Extent(KM + apart_mm, 2 * KM, BUFFER_STOP, BUFFER_STOP)
            before = Extent(-KM, -apart_mm, BUFFER_STOP, BUFFER_STOP)
            assert is_refused(register, {}, lines | {other: after}) == refused
            assert is_refused(register, {}, lines | {other: before}) == refused
    backwards = {MAIN: Extent(40 * KM, 0, BUFFER_STOP, BUFFER_STOP)}
    assert is_refused(plain, {}, backwards)
    assert is_refused(plain, {}, backwards | {other: Extent(10 * KM, 30 * KM, BUFFER_STOP, BUFFER_STOP)})
    assert is_refused(plain, {}, {})


def ends_are_as_written() -> None:
    """A join has an equation there, an opening is one, to the mm; at buffer stops is neither (A1)."""
    assert not is_refused()
    main, loop = LINES[MAIN], LINES[LOOP]
    for line in (
        replace(main, from_end=JOIN),
        replace(main, from_end=OPENING),
        replace(main, to_end=JOIN),
        replace(main, to_end=BUFFER_STOP),
        replace(main, to_mm=main.to_mm + 1),
    ):
        assert is_refused(lines=LINES | {MAIN: line}), line
    for line in (
        replace(loop, from_end=BUFFER_STOP),
        replace(loop, to_end=BUFFER_STOP),
        replace(loop, from_end=OPENING),
        replace(loop, to_end=OPENING),
        replace(loop, from_mm=loop.from_mm - 1),
        replace(loop, to_mm=loop.to_mm + 1),
    ):
        assert is_refused(lines=LINES | {LOOP: line}), line
    assert is_refused(replace(REGISTER, openings={}))
    mirrored = {MAIN: replace(main, from_end=OPENING, to_end=BUFFER_STOP), LOOP: loop}
    assert not is_refused(replace(REGISTER, openings={NORTH: 0}), lines=mirrored)
    turned = {MAIN: Extent(-40 * KM, 40 * KM, OPENING, OPENING), LOOP: loop}
    both = replace(REGISTER, openings={NORTH: 40 * KM, Opening("south"): -40 * KM})
    assert not is_refused(both, lines=turned)
    assert is_refused(both, lines=turned | {MAIN: replace(turned[MAIN], from_end=BUFFER_STOP)})
    zero = {Way("0"): Connection(40 * KM, 40 * KM, 0)}
    itself = JOINS | {Join("itself"): Equation(40 * KM, 40 * KM)}
    assert is_refused(
        replace(REGISTER, openings={}, ways=WAYS | zero), itself, LINES | {MAIN: replace(main, to_end=JOIN)}
    )


def each_figure_is_one_that_a_line_has() -> None:
    """An equation, opening, section or connection of which a figure lies on no line, or on two, is refused (A1)."""
    for off_mm in (-1, 40 * KM + 1, 70 * KM):
        for place in (Equation(off_mm, 101 * KM), Equation(101 * KM, off_mm)):
            joins = JOINS | {Join("typed"): place}
            register = replace(SURVEYED, ways=connections(SURVEYED, joins))
            assert has_least_ways(register, joins)
            assert not has_joins_on_lines(joins, LINES)
            assert is_refused(register, joins)
        for typed in (Connection(off_mm, 14 * KM, 8 * KM), Connection(14 * KM, off_mm, 8 * KM)):
            assert is_refused(replace(REGISTER, ways=WAYS | {Way("typed"): typed}))
        assert is_refused(replace(REGISTER, openings=REGISTER.openings | {Opening("typed"): off_mm}))
    right = JOINS | {Join("typed"): Equation(20 * KM, 101 * KM)}
    assert not is_refused(replace(SURVEYED, ways=connections(SURVEYED, right)), right)
    for from_mm, to_mm in ((-1, KM), (39 * KM, 40 * KM + 1), (70 * KM, 71 * KM), (30 * KM, 101 * KM)):
        section = {Section("typed"): NoUse(Reason.SHUNTING, from_mm, to_mm, 0)}
        assert is_refused(replace(REGISTER, sections=REGISTER.sections | section))
    whole = {Section("whole"): NoUse(Reason.SHUNTING, 0, 40 * KM, 0)}
    assert not is_refused(replace(REGISTER, sections=whole))
    stops = Connection(0, 14 * KM, KM)
    assert not is_refused(replace(REGISTER, ways=WAYS | {Way("too many"): stops}))


def who_leaves_a_line_does_so_where_track_goes_on() -> None:
    """At its ends, but for buffer stops; within it nobody leaves it, nor gets beyond its figures (A1)."""
    walk = Walking()
    walk.step("load", ways=WAYS)
    kept = walk.system
    assert walk.step("leave", line=MAIN) == kept
    walk.step("begin", join=WEST, is_turned=True)
    for to_mm in (-1, 40 * KM + 1, 101 * KM):
        kept = walk.system
        assert walk.step("walk_on", to_um=UM_A_MM * to_mm) == kept
    for to_mm, line, leaves in (
        (20 * KM, MAIN, False),
        (0, MAIN, False),
        (40 * KM, Line("none"), False),
        (40 * KM, LOOP, False),
        (40 * KM, MAIN, True),
    ):
        walk.step("walk_on", to_um=UM_A_MM * to_mm)
        assert walk.system.at_um == UM_A_MM * to_mm
        kept = walk.system
        after = walk.step("leave", line=line)
        assert after == (replace(kept, is_under_way=False, has_left=True) if leaves else kept)
    kept = walk.system
    assert walk.step("walk_on", to_um=0) == walk.step("cross", join=WEST, is_turned=False) == kept
    for is_turned, at_mm in ((False, 100 * KM), (True, 10 * KM)):
        walk.step("begin", join=WEST, is_turned=is_turned)
        assert walk.system.at_um == UM_A_MM * at_mm
        assert walk.step("leave", line=LOOP).has_left == (at_mm == 100 * KM)


WITNESSES = (
    round_the_loop_and_back,
    what_is_missing_or_too_long_is_refused,
    what_is_far_need_not_be_written,
    two_lines_that_begin_with_0_where_they_join_are_refused,
    lines_lie_as_far_apart_as_what_is_told_beyond_both_their_ends,
    ends_are_as_written,
    each_figure_is_one_that_a_line_has,
    who_leaves_a_line_does_so_where_track_goes_on,
)
