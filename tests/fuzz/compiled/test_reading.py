"""What the compiler of the interlocking's text would read wrongly it refuses, by the same checks as the lifter."""

from __future__ import annotations

from itertools import product
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import pytest

from fuzz.compiled.emitter import Emitter
from fuzz.compiled.memory import Memory
from fuzz.compiled.reading import NotCompilable, Reader
from fuzz.compiled.values import Both, Exists, Fixed, Not, Truth, Word, constant
from fuzz.compiled.values import Test as Comparison
from proofs.lift import OutsideSubset
from proofs.lift.kinds import Scalar
from tests.lift.attacks import PREAMBLE
from tests.lift.written import module_of

REFUSED = {
    "a local unset on one path": "def f(a: int) -> int:\n    if a > 1:\n        LIMIT = a\n    return LIMIT  # here\n",
    "a name of nothing": "def f(a: int) -> int:\n    return missing  # here\n",
    "a map put over an entry": "def f(a: int) -> bool:\n    return a in {a: 1, **{a: 2}}  # here\n",
    "two maps in one": "def f(a: int) -> bool:\n    return a in {**{a: 1}, **{2: 2}}  # here\n",
    "an argument by name only": "def f(*, a: int) -> int:  # here\n    return a\n",
    "an argument that is none": (
        "def g(a: int) -> int:\n    return a\ndef f(a: int) -> int:\n    return g(a, b=a)  # here\n"
    ),
    "an argument too many": (
        "def g(a: int) -> int:\n    return a\ndef f(a: int) -> int:\n    return g(a, a)  # here\n"
    ),
    "a field left out of comparison": (
        "@dataclass(frozen=True)  # here\nclass Part:\n    a: int = field(compare=False)\n"
        "def f(a: int) -> int:\n    return Part(a).a\n"
    ),
    "an enumeration of numbers": (
        "class Own(IntEnum):  # here\n    A = 1\ndef f(a: int) -> bool:\n    return Own.A is Own.A\n"
    ),
}

READ = {
    "a key with a name of the outside": (
        "def f(a: int, b: int) -> bool:\n    return (a, b) in {(b, x) for x in (a, 1)}\n"
    ),
    "a default evaluated once": (
        "MOST = 1\ndef g(a: int, b: int = MOST) -> bool:\n    return a == b\nMOST = 2\n"
        "def f(a: int, b: int) -> bool:\n    return g(a)\n"
    ),
    "any by another name": "all = any\ndef f(a: int, b: int) -> bool:\n    return a == b\n",
}


def reader() -> Reader:
    """A reader of functions that look at no state."""
    return Reader(cast(Memory, SimpleNamespace()))


def given(module: Any, *numbers: int) -> Any:
    """What is read of a module's ``f`` for known numbers."""
    words = (Word(Scalar(int), (constant(number),)) for number in numbers)
    return reader().call(module.f, dict(zip("ab", words, strict=False)))


def holds(truth: Truth) -> bool:
    """Work out a condition between constants, of which no code need be made."""
    match truth:
        case Fixed(holds=known):
            return known
        case Not(of=part):
            return not holds(part)
        case Both(one=one, other=other):
            return holds(one) and holds(other)
        case Comparison(bit=bit):
            return bool(bit(cast(Emitter, SimpleNamespace(equal=lambda a, b: a.constant == b.constant))))
    raise AssertionError(truth)


@pytest.mark.parametrize("what", REFUSED)
def test_refused_with_file_and_line(what: str, tmp_path: Path) -> None:
    module = module_of(PREAMBLE + REFUSED[what], tmp_path)
    (marked,) = (line for line, each in enumerate((PREAMBLE + REFUSED[what]).splitlines(), 1) if "# here" in each)
    with pytest.raises((NotCompilable, OutsideSubset)) as refusal:
        given(module, 1)
    assert str(refusal.value).startswith(f"{module.__file__}:{marked}: ")


@pytest.mark.parametrize("what", READ)
def test_read_as_python_runs_it(what: str, tmp_path: Path) -> None:
    module = module_of(PREAMBLE + READ[what], tmp_path)
    for numbers in product((1, 2), repeat=2):
        assert holds(given(module, *numbers)) == module.f(*numbers), numbers


def test_a_key_with_a_value_of_the_map_is_looked_for(tmp_path: Path) -> None:
    text = "def f(a: int, b: int) -> bool:\n    return (a, b) in {(k, v) for k, v in {1: 2}.items()}\n"
    assert isinstance(given(module_of(PREAMBLE + text, tmp_path), 1, 3), Exists)
