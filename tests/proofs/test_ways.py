"""Several ways of a transition taken together, and claims lifted once for what they read."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import product
from typing import Any

import pytest
import z3
from hypothesis import given, settings
from hypothesis import strategies as st

from proofs import solvers
from proofs.lift import conjuncts
from proofs.lift.sources import definition_of
from proofs.lift.terms import not_
from proofs.lift.values import Record
from proofs.reads import Seen, noting
from proofs.theories import THEORIES
from proofs.theory import Theory
from proofs.ways import Way, together
from proofs.workbench import Workbench

TESTS = [z3.Bool(f"test{number}") for number in range(5)]
Path = tuple[Any, ...]


def paths(depth: int) -> st.SearchStrategy[list[Path]]:
    """Every way through a tree of tests, each asked once on a way."""
    if depth == len(TESTS):
        return st.just([()])
    on = paths(depth + 1)
    asked = st.builds(
        lambda yes, no: [(TESTS[depth], *path) for path in yes] + [(not_(TESTS[depth]), *path) for path in no], on, on
    )
    return st.one_of(st.just([()]), on, asked)


def holds(condition: Any, answers: dict[Any, bool]) -> bool:
    """Whether a condition holds where the tests are answered so."""
    told = z3.substitute(condition, *((test, z3.BoolVal(answer)) for test, answer in answers.items()))
    return bool(z3.is_true(z3.simplify(told)))


@settings(deadline=None)
@given(paths(0), st.data())
def test_ways_together_are_taken_where_one_of_them_is(whole: list[Path], data: st.DataObject) -> None:
    chosen = data.draw(st.lists(st.sampled_from(whole), min_size=1, unique_by=id))
    ways = [Way(z3.And(*tests), [], None, tests) for tests in chosen]
    found = together(ways)
    assert len(found) <= len(ways)
    for answers in product((True, False), repeat=len(TESTS)):
        told = dict(zip(TESTS, answers, strict=True))
        assert any(holds(each, told) for each in found) == any(holds(way.condition, told) for way in ways)


def test_what_makes_no_difference_is_not_tested() -> None:
    one, two, three = TESTS[:3]
    whole = [(one, two), (one, not_(two)), (not_(one), three), (not_(one), not_(three))]
    ways = [Way(z3.And(*tests), [], None, tests) for tests in whole]
    assert [str(each) for each in together(ways)] == ["True"]
    assert [str(each) for each in together(ways[:2])] == ["test0"]
    assert [str(each) for each in together([ways[0], *ways[2:]])] == ["And(test0, test1)", "Not(test0)"]


def test_paths_of_other_trees_stay_as_they_are() -> None:
    one, two, three = TESTS[:3]
    ways = [Way(z3.And(*tests), [], None, tests) for tests in [(one, two), (three,), (not_(one),)]]
    assert [each.get_id() for each in together(ways)] == [z3.simplify(way.condition).get_id() for way in ways]


def leaves(value: Any) -> list[Any]:
    """What stands in a record, and in the records in it."""
    if isinstance(value, Record):
        return [leaf for field in value.fields for leaf in leaves(value.fields[field])]
    return [value]


@pytest.mark.parametrize("row", [pytest.param("read_by_the_tail", marks=pytest.mark.slow), "take_end", "note_place"])
def test_a_claim_of_a_state_is_what_it_is_when_lifted_of_that_state_alone(row: str) -> None:
    """Each of another way's state is as lifted anew, though nearly all are found by what was read."""
    bench = Workbench(THEORIES["train"], named=False)
    lifted = 0
    for name, claim in bench.theory.invariants.items():
        for way in bench.ways(row):
            anew = conjuncts(bench.lifter.formula(claim, bench.site, way.after))
            assert [each.get_id() for each in bench.claim(way.after, name)] == [each.get_id() for each in anew]
        lifted += sum(map(len, bench._seen[name].lifted.values()))
    assert lifted < len(bench.theory.invariants) * len(bench.ways(row))


def test_a_state_that_differs_in_what_was_read_is_not_found() -> None:
    bench = Workbench(THEORIES["train"], named=False)
    (way, *_) = bench.ways("take_end")
    seen, read = Seen(), dict[tuple[str, ...], Any]()
    leaves(noting(bench.before, read))
    seen.note(read, "all")
    assert seen.find(bench.before) == "all"
    assert seen.find(way.after) is None
    front, part = Seen(), dict[tuple[str, ...], Any]()
    assert noting(bench.before, part).fields["front_nm"] is bench.before.fields["front_nm"]
    front.note(part, "front")
    assert front.find(way.after) == "front"


# ---- a state in which a record may be missing


@dataclass(frozen=True)
class Room:
    """What does not change."""

    doors: int


@dataclass(frozen=True)
class Alarm:
    """When it began."""

    since: int


@dataclass(frozen=True)
class Watch:
    """What a watchman knows."""

    alarm: Alarm | None
    round: int


def look(site: Room, system: Watch, smoke: bool) -> Watch:
    """Raise the alarm if there is smoke, and end it if there is none."""
    return replace(system, alarm=Alarm(3) if smoke else None)


def there_is_an_alarm(site: Room, system: Watch) -> bool:
    """Not so without smoke."""
    return system.alarm is not None


def an_alarm_began_at_three(site: Room, system: Watch) -> bool:
    """If there is one."""
    return system.alarm is None or system.alarm.since == 3


@pytest.mark.parametrize(
    ("claim", "answers"), [(there_is_an_alarm, ["unsat", "sat"]), (an_alarm_began_at_three, ["unsat"])]
)
def test_whether_there_is_a_record_is_read_too(claim: Callable[..., bool], answers: list[str]) -> None:
    name = claim.__name__
    theory = Theory("watch", Room, Watch, {"look": look}, {"start": an_alarm_began_at_three}, {name: claim}, {})
    parts = Workbench(theory, named=False).parts("look", name, [])
    assert sorted({solvers.ask("z3", part, 0).answer for part in parts}, reverse=True) == answers


def nothing_is_looked_at(site: Room, system: Watch) -> bool:
    """What stands in the place of another claim."""
    return True


def test_other_functions_stand_in_steps_and_not_in_what_holds_before_them() -> None:
    theory = Theory(
        "watch", Room, Watch, {"look": look}, {"start": an_alarm_began_at_three}, {"three": an_alarm_began_at_three}, {}
    )
    other = {an_alarm_began_at_three: definition_of(nothing_is_looked_at)}
    whole = Workbench(theory, named=False)
    replaced = Workbench(theory, named=False).replacing(other)
    assert str(replaced.invariants) == str(whole.invariants)
    assert str(replaced.initial) == str(whole.initial)
    assert str(Workbench(theory, named=False, sources=other).invariants) != str(whole.invariants)
