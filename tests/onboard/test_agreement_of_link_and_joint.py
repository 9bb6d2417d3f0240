"""The radio link and the joint, which are no scalar machines, mean the same in CPython and as lifted terms.

Every function of kernel, world and claims is called as the witnesses call it, and with a few things changed
in its arguments; the formulas are made in a finite scope of just the identifiers that occur.
"""

from __future__ import annotations

import ast
import dataclasses
import inspect
import sys
import textwrap
import typing
from collections import Counter
from collections.abc import Callable, Mapping
from enum import Enum
from functools import cache
from random import Random
from types import FrameType, ModuleType
from typing import Any

import pytest

import kernel.link
import kernel.onboard.authority_end
import models.link
import models.onboard.joint
import proofs.onboard.joint
import proofs.onboard.link
from kernel.link import Outcome
from proofs.lift import Lifter, concretise, embed
from proofs.lift.kinds import (
    BOOL,
    INT,
    Kind,
    MapKind,
    OptionKind,
    RecordKind,
    Scalar,
    SetKind,
    TupleKind,
    fields_of,
    kind_of_type,
)
from proofs.mutants.plays import witnesses
from proofs.mutants.steps import SmallScope, identifiers
from proofs.mutated import Sources, running
from proofs.theories import THEORIES
from tests.lift.differential import PARTIAL, QuantifiedScope, can_fail
from tests.onboard.agree import functions

Code = Callable[..., Any]
Arguments = tuple[Any, ...]
Pool = dict[Kind, dict[Any, None]]
"""The scalars and tuples that occur in some arguments, by kind, each once."""

MODULES: dict[str, tuple[ModuleType, ...]] = {
    "link": (kernel.link, models.link, proofs.onboard.link),
    "joint": (kernel.onboard.authority_end, models.onboard.joint, proofs.onboard.joint),
}
"""By theory: kernel, world and claims."""
FUNCTIONS = {
    f"{theory}.{name}": function
    for theory, modules in MODULES.items()
    for module in modules
    for name, function in functions(module).items()
}
DRAWS = {
    kernel.link: 720,
    kernel.onboard.authority_end: 40,
    models.link: 60,
    models.onboard.joint: 14,
    proofs.onboard.link: 60,
    proofs.onboard.joint: 14,
}
"""So many arguments are drawn for each function of a module; states of the world are large."""
CANDIDATES = 300
"""From so many, evaluated in CPython, those are chosen that come out differently."""
WITH_QUANTIFIERS = 12
"""Each so manyth truth is asked with its quantifiers kept, too."""


def theory_of(name: str) -> str:
    """The theory of a function."""
    return name.partition(".")[0]


# ---- arguments


@cache
def calls(theory: str) -> Mapping[str, list[Arguments]]:
    """The arguments of every call of a function while the witnesses of a theory are played."""
    named = {name: function for name, function in FUNCTIONS.items() if name.startswith(f"{theory}.")}
    by_code = {function.__code__: (name, inspect.signature(function)) for name, function in named.items()}
    found: dict[str, list[Arguments]] = {name: [] for name in named}

    def note(frame: FrameType, event: str, _: Any) -> None:
        if event == "call" and frame.f_code in by_code:
            name, signature = by_code[frame.f_code]
            found[name].append(tuple(frame.f_locals[each] for each in signature.parameters))

    before = sys.getprofile()
    sys.setprofile(note)
    try:
        for witness in witnesses(theory).values():
            witness()
    finally:
        sys.setprofile(before)
    return found


def types_of(function: Code) -> tuple[list[Any], Any]:
    """The types of a function's parameters, and of its result."""
    hints = typing.get_type_hints(function)
    result = hints.pop("return")
    return list(hints.values()), result


def gather(kind: Kind, value: Any, pool: Pool) -> Pool:
    """Note a value, and all that it is made of."""
    if isinstance(kind, Scalar | TupleKind):
        pool.setdefault(kind, {})[value] = None
    for part, item in parts_of(kind, value):
        gather(part, item, pool)
    return pool


def parts_of(kind: Kind, value: Any) -> list[tuple[Kind, Any]]:
    """What a value is made of, by kind; nothing, if it is one thing."""
    match kind:
        case OptionKind(inner):
            return [] if value is None else [(inner, value)]
        case TupleKind(items):
            return list(zip(items, value, strict=True))
        case SetKind(element):
            return [(element, item) for item in value]
        case MapKind(key, inner):
            return [*((key, each) for each in value), *((inner, item) for item in value.values())]
        case RecordKind(cls):
            return [(part, getattr(value, name)) for name, part in fields_of(cls).items()]
        case Scalar() if kind.is_named_tuple:
            return [(part, getattr(value, name)) for name, part in fields_of(kind.source).items()]
    return []


class Shaker:
    """Changes a few things in a value: ints, truths, identifiers for others that occur, members of sets and maps."""

    def __init__(self, random: Random, pool: Mapping[Kind, list[Any]], rate: float) -> None:
        self._random, self._pool, self._rate = random, pool, rate

    def _now(self) -> bool:
        return self._random.random() < self._rate

    def shaken(self, kind: Kind, value: Any) -> Any:
        """Give a value of this kind that is the same, or a little different."""
        match kind:
            case Scalar():
                return self._scalar(kind, value) if self._now() else value
            case OptionKind(inner):
                if self._now():
                    return None if value is not None else self._random.choice(self._pool.get(inner) or [None])
                return None if value is None else self.shaken(inner, value)
            case TupleKind(items):
                return tuple(self.shaken(part, item) for item, part in zip(value, items, strict=True))
            case SetKind(element):
                known = self._pool.get(element)
                more = [self._random.choice(known)] if known and self._now() else []
                kept = [each for each in sorted(value, key=repr) if not self._now()]
                return frozenset([*(self.shaken(element, each) for each in kept), *more])
            case MapKind(key, inner):
                left = [each for each in sorted(value, key=repr) if not self._now()]
                return {self.shaken(key, each): self.shaken(inner, value[each]) for each in left}
            case RecordKind(cls):
                fields = fields_of(cls).items()
                return cls(**{name: self.shaken(part, getattr(value, name)) for name, part in fields})

    def _scalar(self, kind: Scalar, value: Any) -> Any:
        if kind == BOOL:
            return not value
        if kind == INT:
            near = self._random.choice([value, *self._pool[INT]])
            return near + self._random.choice((-10_000, -100, -1, 0, 0, 0, 1, 100, 10_000))
        if kind.is_enum:
            return self._random.choice(list(kind.source))
        if kind.is_named_tuple and self._random.random() < 0.5:
            name, part = self._random.choice(list(fields_of(kind.source).items()))
            return value._replace(**{name: self._scalar(typing.cast(Scalar, part), getattr(value, name))})
        return self._random.choice(self._pool[kind])


def sort_of(arguments: Arguments, result: Any) -> Any:
    """Say what sort of result this is: the truth, the outcome, how many, or which fields are other than before."""
    if isinstance(result, bool | Enum):
        return result
    if isinstance(result, Exception):
        return Exception
    if isinstance(result, frozenset):
        return len(result)
    if not dataclasses.is_dataclass(result):
        return "a value"
    of_the_type = [each for each in arguments if type(each) is type(result)]
    if not of_the_type:
        return "a value"
    fields = [each.name for each in dataclasses.fields(result)]
    return tuple(name for name in fields if getattr(result, name) != getattr(of_the_type[0], name))


def starts(name: str) -> list[Arguments]:
    """What a function is called with by the witnesses; what is said of the start is asked of any state."""
    theory, _, last = name.partition(".")
    found = list(calls(theory)[name])
    if last in THEORIES[theory].initial:
        found += calls(theory)[f"{theory}.{next(iter(THEORIES[theory].invariants))}"]
    return found


def draws_of(function: Code) -> int:
    """How many arguments are drawn for a function."""
    return DRAWS[sys.modules[function.__module__]]


@cache
def draws(name: str) -> list[Arguments]:
    """Draw arguments: the witnesses' own, and those with a few things changed; each sort of result in turn.

    Beside them as many again by half of the witnesses' own, those that were asked least often.
    """
    function, random = FUNCTIONS[name], Random(name)
    kinds = [kind_of_type(each) for each in types_of(function)[0]]
    called = starts(name)
    assert called, f"no witness comes to {name}"
    sorts: dict[Any, list[Arguments]] = {}
    for number in range(CANDIDATES):
        arguments = random.choice(called)
        if number % 3:
            arguments = shaken(random, kinds, arguments)
        sorts.setdefault(sort_of(arguments, called_with(function, arguments)), []).append(arguments)
    for arguments in called:
        sorts.setdefault(sort_of(arguments, function(*arguments)), []).append(arguments)
    asked: dict[str, list[Arguments]] = {}
    for arguments in called:
        asked.setdefault(repr(arguments[-2:]), []).append(arguments)
    own = [same[0] for same in sorted(asked.values(), key=len)][: draws_of(function) // 2]
    return [random.choice(list(sorts.values())[number % len(sorts)]) for number in range(draws_of(function))] + own


def shaken(random: Random, kinds: list[Kind], arguments: Arguments) -> Arguments:
    """Change a few things in arguments."""
    pool: Pool = {}
    for kind, value in zip(kinds, arguments, strict=True):
        gather(kind, value, pool)
    known = {kind: sorted(found, key=repr) for kind, found in pool.items()}
    size = sum(map(len, known.values()))
    shaker = Shaker(random, known, min(0.3, random.choice((1, 2, 4)) / size))
    return tuple(shaker.shaken(kind, value) for kind, value in zip(kinds, arguments, strict=True))


def called_with(function: Code, arguments: Arguments) -> Any:
    """Call a function in CPython; give its result, or the error that it raises."""
    try:
        return function(*arguments)
    except PARTIAL as error:
        return error


# ---- agreement


def universe_of(types: list[Any], values: Arguments) -> tuple[dict[Any, list[Any]], list[int]]:
    """The identifiers that occur, at least one of each type, and the ints."""
    pool: Pool = {}
    for type_, value in zip(types, values, strict=True):
        gather(kind_of_type(type_), value, pool)
    for source in sorted(identifiers(*types), key=lambda each: isinstance(each, type)):
        scalar = Scalar(source)
        if scalar not in pool:
            gather(scalar, example(scalar, pool), pool)
    listed = {
        kind.source: list(found) for kind, found in pool.items() if isinstance(kind, Scalar) and kind.is_identifier
    }
    return listed, [-1, *pool.get(INT, ())]


def example(scalar: Scalar, pool: Pool) -> Any:
    """A value of a scalar of which none occurs."""
    if scalar in pool:
        return next(iter(pool[scalar]))
    if scalar.is_named_tuple:
        parts = {name: typing.cast(Scalar, part) for name, part in fields_of(scalar.source).items()}
        return scalar.source(**{name: example(part, pool) for name, part in parts.items()})
    if scalar.is_enum:
        return next(iter(scalar.source))
    return 0 if scalar.is_ordered or scalar == INT else False if scalar == BOOL else "none"


def agree(name: str, wrong: Sources | None = None, wrong_in_logic: Sources | None = None) -> Counter[Any]:
    """Compare a function with its terms on what is drawn; count the sorts of results."""
    function, seen = FUNCTIONS[name], Counter[Any]()
    types, result = types_of(function)
    for number, arguments in enumerate(draws(name)):
        universe, ints = universe_of(types, arguments)
        scope = SmallScope.of_universe(universe)
        assert isinstance(scope, SmallScope)
        lifter = Lifter(scope, wrong_in_logic, collect=True)
        values = [embed(scope, argument, each) for argument, each in zip(arguments, types, strict=True)]
        lifted = lifter.call(function, *values)
        with running(wrong or {}):
            expected = called_with(function, arguments)
        if isinstance(expected, Exception):
            assert any(can_fail(each.claim) for each in lifter.obligations), f"{name}: an error without obligation"
            seen[Exception] += 1
            continue
        if isinstance(expected, frozenset):
            scope.numerals = sorted({*ints, *gather(kind_of_type(result), expected, {}).get(INT, ())})
        found = concretise(None, scope, lifted, result)
        assert found == expected, f"{name}{arguments}: {expected}, lifted {found}"
        if result is bool and number % WITH_QUANTIFIERS == 0:
            quantified = QuantifiedScope.of_universe(universe)
            again = [embed(quantified, argument, each) for argument, each in zip(arguments, types, strict=True)]
            formula = Lifter(quantified, wrong_in_logic).formula(function, *again)
            assert not can_fail(formula == expected), f"{name}{arguments}: {expected}, with quantifiers otherwise"
        seen[sort_of(arguments, expected)] += 1
    return seen


def wanted(name: str) -> set[Any]:
    """The sorts of results that must be among those compared."""
    if FUNCTIONS[name] is kernel.link.judge:
        return set(Outcome)
    if FUNCTIONS[name] is kernel.onboard.authority_end.ends_mm:
        return {0, 1}
    return {True, False} if types_of(FUNCTIONS[name])[1] is bool else set()


def test_every_transition_premise_and_claim_is_compared() -> None:
    for theory in map(THEORIES.__getitem__, MODULES):
        assert {*theory.steps, *theory.read} <= {name.partition(".")[2] for name in FUNCTIONS}
        assert {*theory.steps.values(), *theory.read.values()} <= set(FUNCTIONS.values())


@pytest.mark.sampled(8)
@pytest.mark.parametrize("name", FUNCTIONS)
def test_cpython_and_lifted_terms_agree(name: str) -> None:
    seen = agree(name)
    compared = {sort: count for sort, count in seen.items() if sort is not Exception}
    assert sum(compared.values()) >= draws_of(FUNCTIONS[name]) // 2, f"hardly compared: {seen}"
    assert wanted(name) <= set(compared), f"not all is compared: {seen}"
    assert any(sort != () for sort in compared), f"nothing changes: {seen}"


# ---- a function with another meaning is noticed

PLANTED: dict[str, tuple[str, Code, str, str]] = {
    "a number may come twice": (
        "link.judge",
        kernel.link.judge,
        "telegram.sequence <= newest_sequence",
        "telegram.sequence < newest_sequence",
    ),
    "the difference of clocks once": ("link.judge", kernel.link.judge, "2 * limits.offset_ms", "limits.offset_ms"),
    "a life is met again": ("link.meet", kernel.link.meet, "life <= link.peer_life", "life < link.peer_life"),
    "what is missed is not counted": (
        "link.take",
        kernel.link.take,
        "met.missed + telegram.sequence",
        "telegram.sequence",
    ),
    "silence by a clock that went back": (
        "link.is_silent",
        kernel.link.is_silent,
        "now_ms < link.clock_ms",
        "now_ms <= link.clock_ms",
    ),
    "another's session, through two calls": (
        "link.arrive",
        kernel.link.is_of_the_session,
        "not telegram.greeting",
        "telegram.greeting",
    ),
    "every telegram, for some": (
        "link.delivered_never_twice",
        proofs.onboard.link.delivered_never_twice,
        "all(",
        "any(",
    ),
    "the end at the front": (
        "joint.ends_mm",
        kernel.onboard.authority_end.ends_mm,
        "if end_mm >= front_least_mm",
        "if end_mm > front_least_mm",
    ),
    "the farthest end": (
        "joint.ends_mm",
        kernel.onboard.authority_end.ends_mm,
        "end_mm <= other_mm",
        "end_mm >= other_mm",
    ),
    "the old brake is kept": (
        "joint.ask_for_the_end",
        models.onboard.joint.ask_for_the_end,
        "system.brake | {train: brake}",
        "{train: brake} | system.brake",
    ),
    "the head stays": (
        "joint.head_runs",
        models.onboard.joint.head_runs,
        "{train: to_mm}",
        "{train: system.head_mm[train]}",
    ),
}
"""By what is wrong: what is compared, the function that is changed, and the change."""


def changed(function: Code, old: str, new: str) -> Sources:
    """A function with one piece of its source replaced."""
    source = textwrap.dedent(inspect.getsource(function))
    assert source.count(old) == 1, f"{old} is not once in {function.__name__}"
    tree = ast.parse(source.replace(old, new)).body[0]
    assert isinstance(tree, ast.FunctionDef)
    return {function: tree}


@pytest.mark.parametrize("what", PLANTED)
def test_another_meaning_is_noticed_in_the_terms(what: str) -> None:
    name, function, old, new = PLANTED[what]
    with pytest.raises(AssertionError, match=r"lifted|with quantifiers|without obligation"):
        agree(name, wrong_in_logic=changed(function, old, new))


@pytest.mark.parametrize("what", PLANTED)
def test_another_meaning_is_noticed_in_cpython(what: str) -> None:
    name, function, old, new = PLANTED[what]
    with pytest.raises(AssertionError, match=r"lifted|with quantifiers|without obligation"):
        agree(name, wrong=changed(function, old, new))
