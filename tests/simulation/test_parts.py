"""A tag list in several telegrams: whole once every part has come, in any order, however often (T4, T11)."""

from __future__ import annotations

from random import Random

from hypothesis import given
from hypothesis import strategies as st

from kernel.names import Route, Run, Serial, TagList, Train, UnitLife
from models.simulation.parts import PART_BYTES, Joined, in_parts

RUN, OTHER = (Run(Serial(serial), Train("T1"), UnitLife(1), Route("out")) for serial in (7, 8))
LISTS = st.text(max_size=3 * PART_BYTES).map(TagList)


@given(LISTS, st.randoms())
def test_a_list_is_joined_from_its_parts_in_any_order(tag_list: TagList, random: Random) -> None:
    parts = list(in_parts(RUN, tag_list))
    assert all(len(part["text"]) <= PART_BYTES for part in parts)
    random.shuffle(parts)
    joined = Joined()
    assert [joined.take(**part) for part in parts] == [None] * (len(parts) - 1) + [tag_list]


@given(LISTS, LISTS)
def test_a_part_that_is_missing_is_waited_for_and_another_runs_do_not_fill_in(one: TagList, other: TagList) -> None:
    first, joined = list(in_parts(RUN, one)), Joined()
    assert all(joined.take(**part) is None for part in [*first[1:], *first[1:]])
    assert [joined.take(**part) for part in in_parts(OTHER, other)][-1] == other
    assert joined.take(**first[0]) == one


def test_a_list_with_nothing_in_it_is_one_part() -> None:
    assert [part["text"] for part in in_parts(RUN, TagList(""))] == [b""]
