"""The speed limit at its edges, and in drawn worlds against a line laid out in full (T12)."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from kernel.onboard import speed_limit as machine
from kernel.onboard.speed_limit import UNKNOWN, SpeedLimit, SpeedTable
from kernel.onboard.tag_kind import is_curve, is_turnout
from kernel.tags import Kind, traits
from models.onboard.units import NM_A_MM
from proofs.onboard.witnesses.sixty_four_bits import GREATEST, LEAST, Wrapped, with_ints
from proofs.onboard.witnesses.speed_limit import (
    TABLE,
    WITNESSES,
    Train,
    a_curve_ends_when_the_rear_has_left_it,
)

NUMBERS = st.integers(-50_000, 50_000) | st.sampled_from((0, -1, GREATEST, LEAST))
LIMITS = st.builds(SpeedLimit, st.booleans(), st.booleans(), NUMBERS, NUMBERS)
KINDS = tuple(Kind)


@pytest.mark.parametrize("witness", WITNESSES)
def test_witness(witness: Callable[[], None]) -> None:
    assert witness.__doc__
    witness()


@pytest.mark.parametrize("code", [0, 10, 15, -1, 16, GREATEST])
def test_an_unknown_kind_is_the_worst_case(code: int) -> None:
    kind = traits(code)
    assert machine.permitted_mm_s(TABLE, kind.in_curve, kind.at_turnout) == TABLE.turnout_mm_s


def test_each_kind_has_its_speed() -> None:
    speeds = {
        kind: machine.permitted_mm_s(TABLE, traits(kind.value).in_curve, traits(kind.value).at_turnout) for kind in Kind
    }
    assert [kind for kind, speed in speeds.items() if speed == TABLE.curve_mm_s] == [
        Kind.CURVE,
        Kind.GRADIENT_AND_CURVE,
    ]
    assert [kind for kind, speed in speeds.items() if speed == TABLE.turnout_mm_s] == [
        Kind.TURNOUT,
        Kind.TURNOUT_ON_GRADIENT,
        Kind.UNKNOWN,
    ]


@settings(max_examples=100, deadline=None)
@given(
    st.lists(st.tuples(st.integers(1, 90_000), st.sampled_from(KINDS), st.booleans()), min_size=1, max_size=15),
    st.integers(0, 2_000),
    st.lists(st.integers(0, 40_000), min_size=4, max_size=4),
)
def test_the_whole_train_counts_in_drawn_worlds(
    line: list[tuple[int, Kind, bool]], off_mm: int, speeds: list[int]
) -> None:
    """Against every stretch of the line that the train is on: never faster unbraked, and no limit for nothing."""
    train = Train()
    train.runs(1_000_000, 0)
    stretches: list[tuple[int, int, int]] = [(0, 0, TABLE.turnout_mm_s)]
    for way_mm, kind, worst in line:
        begins_mm, lies = train.system.front_nm // NM_A_MM, traits(kind.value)
        written = Kind.UNKNOWN if worst else kind
        train.tag(curve=lies.in_curve, turnout=lies.at_turnout, kind=written.value, off_mm=off_mm)
        told = machine.permitted_mm_s(TABLE, traits(written.value).in_curve, traits(written.value).at_turnout)
        stretches.append((begins_mm, begins_mm + way_mm, told))
        stretches[-2] = (stretches[-2][0], begins_mm, stretches[-2][2])
        for part, speed_mm_s in enumerate(speeds, 1):
            front_mm = begins_mm + way_mm * part // len(speeds)
            brakes = train.runs(front_mm, speed_mm_s, off_mm=off_mm)
            rear_mm = front_mm - train.site.length_mm
            under = [told for _, ends_mm, told in stretches[:-1] if ends_mm >= rear_mm] + [stretches[-1][2]]
            near = [told for _, ends_mm, told in stretches[:-1] if ends_mm >= rear_mm - 2 * off_mm] + [stretches[-1][2]]
            assert brakes or speed_mm_s <= min(under)
            assert not brakes or speed_mm_s + off_mm > min(near)


@given(st.builds(SpeedTable, NUMBERS, NUMBERS, NUMBERS), LIMITS, st.integers(-1, 16), NUMBERS, NUMBERS, NUMBERS)
def test_any_numbers_whatever_are_answered_alike_in_64_bits(
    table: SpeedTable, limit: SpeedLimit, kind: int, front_mm: int, rear_mm: int, speed_mm_s: int
) -> None:
    after = machine.note_tag(limit, kind, True, front_mm)
    wrapped = machine.note_tag(with_ints(Wrapped, limit), Wrapped(kind), True, Wrapped(front_mm))
    assert wrapped == after
    assert machine.is_overspeed(table, wrapped, True, rear_mm, speed_mm_s) == machine.is_overspeed(
        table, after, True, rear_mm, speed_mm_s
    )
    assert machine.limit_mm_s(table, UNKNOWN, rear_mm) == min(table.line_mm_s, table.curve_mm_s, table.turnout_mm_s)


@given(LIMITS, NUMBERS, NUMBERS)
def test_a_rear_further_on_is_never_slower(limit: SpeedLimit, rear_mm: int, on_mm: int) -> None:
    one, other = sorted((rear_mm, on_mm))
    assert machine.limit_mm_s(TABLE, limit, one) <= machine.limit_mm_s(TABLE, limit, other)


def test_a_broken_machine_is_caught(monkeypatch: pytest.MonkeyPatch) -> None:
    """The invariants do find a machine that lets a restriction end with the head."""

    def forgets(limit: SpeedLimit, kind: int, known: bool, read_most_mm: int) -> SpeedLimit:
        return SpeedLimit(is_curve(kind), is_turnout(kind), limit.curve_until_mm, limit.turnout_until_mm)

    monkeypatch.setattr(machine, "note_tag", forgets)
    with pytest.raises(AssertionError, match="does not hold"):
        a_curve_ends_when_the_rear_has_left_it()
