"""Invariants as logic: all of them, nothing left out, and true when Python is true."""

from __future__ import annotations

import ast
import inspect
import re
from collections.abc import Mapping
from itertools import product

import pytest
from hypothesis import given
from hypothesis import strategies as st

from evidence.report.logic import Predicate, Unread, called, heading, notation, term_of, words
from evidence.report.terms import lines
from models.onboard import train_nature
from models.world import truth
from proofs.mutants.edits import mutants_of
from proofs.theories import THEORIES

INVARIANTS = {f"{theory.name}.{name}": one for theory in THEORIES.values() for name, one in theory.invariants.items()}
PYTHON = re.compile(r"==|!=|<=|>=|\[|\.get\(|\b(and|or|not|is|for|None|True|False|return|frozenset|system\.system)\b")


def test_every_invariant_and_every_word_is_logic_and_nothing_in_it_is_python() -> None:
    vocabulary = words(list(INVARIANTS.values()))
    assert len(INVARIANTS) > 200
    assert len(vocabulary) > 50
    for function in (*INVARIANTS.values(), *vocabulary):
        told = " ".join(notation(function))
        assert PYTHON.search(told) is None, f"{function.__module__}.{function.__name__}: {told}"


def test_what_is_dropped_in_an_invariant_or_a_word_is_seen_in_its_notation() -> None:
    tried = 0
    said_in = {f"{word.__module__}.{word.__name__}": word for word in words(list(INVARIANTS.values()))}
    for name, function in (INVARIANTS | said_in).items():
        own = notation(function)
        for mutant in mutants_of(function):
            tried += 1
            assert notation(function, mutant.tree) != own, f"{name}: {mutant.name}"
    assert tried > 1000


def test_a_quantifier_says_what_it_ranges_over_and_what_it_excludes() -> None:
    assert notation(truth.no_block_holds_two_trains) == [
        "∀ car ∈ at, block ∈ at(car), other ∈ at:",
        "    block ∈ at(other)",
        "  → formation.train_of(car) = formation.train_of(other)",
    ]


def test_a_record_is_written_with_its_fields() -> None:
    assert notation(train_nature.watched_over) == ["Vehicle(bounds = limits.train.brake)"]
    assert notation(train_nature.running) == ["before with (motion = computer.known.motion)"]


def test_words_are_called_as_they_are_written() -> None:
    function = INVARIANTS["interlocking.reach_is_exclusive"]
    (reaches,) = called(function)
    assert heading(reaches) == "reaches(run, block)"
    assert "reaches(run, block)" in " ".join(notation(function))


# ---- what Python means


def among(a: bool, b: bool, c: bool, d: bool) -> bool:
    """Stands for a function of four names; its tree is drawn."""
    return a and b and c and d


NAMES = tuple(inspect.signature(among).parameters)
conditions = st.recursive(
    st.sampled_from(NAMES),
    lambda below: st.one_of(
        st.lists(below, min_size=2, max_size=3).map(lambda each: f"({' and '.join(each)})"),
        st.lists(below, min_size=2, max_size=3).map(lambda each: f"({' or '.join(each)})"),
        below.map(lambda one: f"(not {one})"),
        st.tuples(below, below).map(lambda two: f"({two[0]} != {two[1]})"),
        st.tuples(below, below, below).map(lambda three: f"({three[0]} if {three[1]} else {three[2]})"),
    ),
    max_leaves=8,
)
branches = st.tuples(conditions, st.one_of(conditions, st.sampled_from(["True", "False"])))


@given(st.lists(branches, max_size=2), conditions)
def test_what_it_says_is_true_where_python_is(early: list[tuple[str, str]], last: str) -> None:
    body = "".join(f"    if {test}:\n        return {value}\n" for test, value in early) + f"    return {last}\n"
    source = f"def among({', '.join(NAMES)}):\n{body}"
    namespace: dict[str, Predicate] = {}
    exec(source, namespace)
    tree = ast.parse(source).body[0]
    assert isinstance(tree, ast.FunctionDef)
    term = term_of(among, tree)
    for values in product((False, True), repeat=len(NAMES)):
        known = dict(zip(NAMES, values, strict=True))
        assert Truth(term.flat(), known).whole() == bool(namespace["among"](*values)), f"{source}{term.flat()}"
    narrow = " ".join(lines(term, 20))
    assert re.findall(r"\w+", narrow) == re.findall(r"\w+", term.flat())


class Truth:
    """Reads the notation by its rules: not, relations, and, or, arrow, choice, each less tight than the one before."""

    def __init__(self, text: str, known: Mapping[str, bool]) -> None:
        self.tokens = re.findall(r"\w+|[()¬∧∨→≠=]", text)
        self.known = known

    def whole(self) -> bool:
        value = self.arrow()
        assert self.tokens == []
        return value

    def taken(self, token: str) -> bool:
        if self.tokens[:1] != [token]:
            return False
        self.tokens.pop(0)
        return True

    def arrow(self) -> bool:
        if self.taken("if"):
            test, _ = self.arrow(), self.taken("then")
            then, _ = self.arrow(), self.taken("else")
            other = self.arrow()
            return then if test else other
        values = [self.joined(0)]
        while self.taken("→"):
            values.append(self.joined(0))
        return values[-1] or not all(values[:-1])

    def joined(self, level: int) -> bool:
        if level == 2:
            return self.related()
        sign, fold = (("∨", any), ("∧", all))[level]
        values = [self.joined(level + 1)]
        while self.taken(sign):
            values.append(self.joined(level + 1))
        return fold(values)

    def related(self) -> bool:
        left = self.single()
        if self.taken("≠"):
            return left != self.single()
        return left == self.single() if self.taken("=") else left

    def single(self) -> bool:
        if self.taken("¬"):
            return not self.single()
        if self.taken("("):
            value = self.arrow()
            assert self.taken(")")
            return value
        return self.known[self.tokens.pop(0)]


# ---- what has no notation


def listed(a: bool, b: bool) -> bool:
    """Says it with a list."""
    return len([a, b]) == 2


def looping(a: bool, b: bool) -> bool:
    """Says it with a loop."""
    for each in (a, b):
        a = a != each
    return a


@pytest.mark.parametrize(("function", "construct"), [(listed, "Call"), (looping, "For")])
def test_what_has_no_notation_is_named_with_its_line(function: Predicate, construct: str) -> None:
    line = inspect.getsourcelines(function)[1] + 2
    with pytest.raises(
        Unread, match=rf"test_report_logic\.py:{line}: {function.__name__}: no notation for {construct}"
    ):
        notation(function)
