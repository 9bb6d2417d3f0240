"""Who waits for whom for ever: the greatest set of trains whose every way on is barred from within it."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import combinations

from hypothesis import given
from hypothesis import strategies as st

from kernel.names import Route, Train
from kernel.refusal import Refusal
from models.simulation.waiting import Barred, deadlocked, explained

TRAINS = [Train(name) for name in "ABCDE"]


def way(*by: str, at: str = "block") -> Barred:
    return Barred(Route(f"past {','.join(by)}"), Refusal.BLOCK_HELD_FOR_ANOTHER, frozenset(map(Train, by)), (at,))


def waiting(ways: Mapping[str, list[Barred]]) -> dict[Train, tuple[Barred, ...]]:
    return {Train(train): tuple(some) for train, some in ways.items()}


def test_two_trains_that_face_each_other_are_told_with_what_each_wants() -> None:
    waits = waiting({"A": [way("B", at="single line")], "B": [way("A", at="station")], "C": [way("A")]})
    assert deadlocked(waits, set()) == {"A", "B", "C"}
    facing, behind = explained(waits, set())
    assert facing == (
        "trains facing each other: A wants 'past B', held up by B at single line;"
        " B wants 'past A', held up by A at station"
    )
    assert behind.startswith("C: behind A")


def test_a_train_with_one_way_open_is_in_no_deadlock() -> None:
    waits = waiting({"A": [way("B"), way("D")], "B": [way("A")]})
    assert deadlocked(waits, set()) == frozenset()
    assert explained(waits, set()) == []


def test_a_train_behind_one_that_is_gone_waits_for_ever() -> None:
    assert explained(waiting({"A": [way("D")]}), {Train("D")}) == ["A: behind D, which do not move"]


def test_what_is_lost_since_a_restart_is_no_deadlock() -> None:
    assert deadlocked(waiting({"A": [way()]}), set()) == frozenset()


@given(
    st.dictionaries(
        st.sampled_from(TRAINS),
        st.lists(st.frozensets(st.sampled_from(TRAINS), min_size=1, max_size=3), min_size=1, max_size=3),
    ),
    st.frozensets(st.sampled_from(TRAINS), max_size=2),
)
def test_it_is_the_greatest_such_set(by: dict[Train, list[frozenset[Train]]], gone: frozenset[Train]) -> None:
    waits = {train: tuple(way(*some) for some in ways) for train, ways in by.items()}
    sound = [
        frozenset(group)
        for size in range(len(waits) + 1)
        for group in combinations(waits, size)
        if all(each.by & (frozenset(group) | gone) for train in group for each in waits[train])
    ]
    assert deadlocked(waits, gone) == frozenset().union(*sound)
