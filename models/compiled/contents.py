"""Whatever a compiled function is made of, as a digest: another content, another digest.

numba's own cache looks at the file of a function and at its byte code; not at its constants, nor at what it calls, nor
at a value that a test or a plan has put there.  Here everything is looked at that compiled code is made of: byte code
and constants of the function and of all that it calls, the values of the globals that they read, options, the types
of the arguments, the versions of all that compiles, and the processor.  What is not known is refused: it is compiled
in each process, as if nothing were kept.
"""

from __future__ import annotations

import builtins
import dis
import hashlib
import platform
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from enum import Enum
from functools import cache
from pathlib import Path
from types import BuiltinFunctionType, CodeType, FunctionType, ModuleType
from typing import Any

import llvmlite
import numba
import numpy as np
from numba import types as known_types
from numba.core import config as settings
from numba.core.dispatcher import Dispatcher

types: Any = known_types
config: Any = settings

LIBRARIES = frozenset({"builtins", "math", "numba", "numpy"})
"""What comes from there is known by its name; their versions are part of the digest."""
WRITTEN_OUT = (
    *(types.Boolean, types.Integer, types.Float, types.NoneType, types.Literal, types.NumPyRandomGeneratorType),
    *(types.Array, types.Record, types.NestedArray),
)
"""numba's types whose names say all of them."""
NOT_OF_CODE = ("CACHE", "COLOR", "CUDA", "DEBUG_", "DUMP", "FUNCTION_CACHE", "NUMBA_", "THREADING")
"""Settings of numba that begin so do not change what is compiled."""


Meet = Callable[[Any, str, Sequence[Any]], None]
"""Is told of each function that goes into a digest: the function, its own part, and what it calls."""


class Unknown(Exception):
    """Something of which nobody can say here what it is made of."""


class Contents:
    """What a function itself is made of, in words; what it calls is in ``callees``, by its place there."""

    def __init__(self) -> None:
        self.callees: list[Any] = []

    def of_function(self, function: FunctionType) -> str:
        """A plain function's code, defaults, and whatever it reads from around it."""
        cells = [cell.cell_contents for cell in function.__closure__ or ()]
        around = [self.of(each) for each in (function.__defaults__, *cells)]
        around += [self.of(each) for each in sorted((function.__kwdefaults__ or {}).items())]
        reads = [f"{name}.{member}={self._read(function, name, member)}" for name, member in loaded(function.__code__)]
        return "\n".join([self._of_code(function.__code__), *around, *reads])

    def of_dispatcher(self, dispatcher: Any) -> str:
        """A compiled function's own part, with its options."""
        options = sorted((name, repr(value)) for name, value in dispatcher.targetoptions.items())
        if dispatcher.locals:
            raise Unknown(f"{dispatcher} has types of its own")
        return f"{options}\n{self.of_function(dispatcher.py_func)}"

    def of_type(self, given: Any) -> str:
        """An argument's type."""
        if isinstance(given, types.Dispatcher):
            return self.of(given.dispatcher)
        if isinstance(given, types.Omitted):
            return f"omitted {self.of(given.value)}"
        if isinstance(given, types.ListType):
            return f"list of {self.of_type(given.item_type)}"
        if isinstance(given, types.BaseTuple):
            of = place_of(given.instance_class) if isinstance(given, types.BaseNamedTuple) else "tuple"
            return f"{of} ({', '.join(map(self.of_type, given))})"
        if isinstance(given, WRITTEN_OUT):
            return f"{type(given).__name__} {given}"
        raise Unknown(f"the type {given}")

    def of(self, value: Any) -> str:
        """A value that compiled code has as a constant, or calls."""
        for kind, said in SAID.items():
            if isinstance(value, kind):
                return said(self, value)
        if value is None or type(value) in (bool, int, float, str, bytes):
            return f"{type(value).__name__} {value!r}"
        return self._of_library(value)

    def _of_called(self, dispatcher: Any) -> str:
        place = next((at for at, each in enumerate(self.callees) if each is dispatcher), len(self.callees))
        if place == len(self.callees):
            self.callees.append(dispatcher)
        return f"function {place}"

    def _of_tuple(self, value: tuple[Any, ...]) -> str:
        of = "tuple" if type(value) is tuple else place_of(type(value))
        return f"{of} ({', '.join(map(self.of, value))})"

    def _of_class(self, cls: Any) -> str:
        if issubclass(cls, Enum):
            return f"{place_of(cls)} {[self.of(member) for member in cls]}"
        if issubclass(cls, tuple) and hasattr(cls, "_fields"):
            return f"{place_of(cls)} {cls._fields} {self.of(tuple(cls._field_defaults.items()))}"
        return self._of_library(cls)

    def _of_plain(self, function: FunctionType) -> str:
        """What only stands for something that is overloaded, here or in a library."""
        if str(function.__module__).startswith(f"{__package__}."):
            return self.of_function(function)
        return self._of_library(function)

    def _of_code(self, code: CodeType) -> str:
        consts = [self._of_code(each) if isinstance(each, CodeType) else self.of(each) for each in code.co_consts]
        names = (code.co_names, code.co_varnames, code.co_freevars, code.co_cellvars)
        counts = (code.co_argcount, code.co_kwonlyargcount, code.co_posonlyargcount, code.co_flags)
        return f"{code.co_code.hex()} {code.co_exceptiontable.hex()} {names} {counts} {consts}"

    def _read(self, function: FunctionType, name: str, member: str) -> str:
        known = function.__globals__
        if name not in known:
            return f"built in: {hasattr(builtins, name)}"
        value = known[name]
        if not isinstance(value, ModuleType):
            return self.of(value)
        if value.__name__.partition(".")[0] in LIBRARIES:
            return value.__name__
        if not hasattr(value, member):
            raise Unknown(f"{value.__name__} is not only looked into")
        return self.of(getattr(value, member))

    def _of_library(self, value: Any) -> str:
        module = str(getattr(value, "__module__", None) or type(value).__module__)
        name = getattr(value, "__qualname__", None) or getattr(value, "__name__", None)
        if module.partition(".")[0] not in LIBRARIES or not isinstance(name, str):
            raise Unknown(f"{value!r}")
        return f"{module} {name}"


SAID: dict[type | tuple[type, ...], Callable[[Contents, Any], str]] = {
    Dispatcher: Contents._of_called,
    np.ndarray: lambda self, value: (
        f"{value.dtype!r} {value.shape} {value.strides} {hashlib.sha256(value.tobytes()).hexdigest()}"
    ),
    np.generic: lambda self, value: f"{value.dtype!r} {value.tobytes().hex()}",
    np.dtype: lambda self, value: repr(value),
    Enum: lambda self, value: f"{place_of(type(value))} {value.name} {self.of(value.value)}",
    tuple: Contents._of_tuple,
    frozenset: lambda self, value: f"set {sorted(map(self.of, value))}",
    type: Contents._of_class,
    FunctionType: Contents._of_plain,
    BuiltinFunctionType: Contents._of_library,
    types.Type: Contents.of_type,
}
"""How values of each kind are put into words; of a value that is of two kinds, the first."""


def digest_of(dispatcher: Any, meet: Meet) -> str:
    """The digest of a compiled function, for this process's processor and versions.

    Raises:
        Unknown: something that it is made of is not known; or ``meet`` knows why.
    """
    return _digest([*_around(dispatcher)], [dispatcher], meet)


def digest_of_types(arguments: Sequence[Any], meet: Meet) -> str:
    """The digest of the types of a call's arguments; where one is a function, of that.

    Raises:
        Unknown: one of them is not known.
    """
    given = Contents()
    return _digest([given.of_type(each) for each in arguments], given.callees, meet)


def _digest(said: Iterable[str], functions: Sequence[Any], meet: Meet) -> str:
    digest = hashlib.sha256("\n".join(said).encode())
    todo = list(functions)
    numbers = {id(each): number for number, each in enumerate(todo)}
    for each in todo:
        own = Contents()
        part = own.of_dispatcher(each)
        meet(each, part, own.callees)
        for callee in own.callees:
            if id(callee) not in numbers:
                numbers[id(callee)] = len(todo)
                todo.append(callee)
        digest.update(f"\n{part}\n{[numbers[id(callee)] for callee in own.callees]}".encode())
    return digest.hexdigest()


def place_of(cls: Any) -> str:
    """Where a class is found again in another process."""
    module = sys.modules.get(cls.__module__)
    is_there = getattr(module, cls.__qualname__, None) is cls
    if module is None or module.__spec__ is None or not is_there:
        raise Unknown(f"{cls} cannot be found again")
    return f"{cls.__module__} {cls.__qualname__}"


@cache
def loaded(code: CodeType) -> tuple[tuple[str, str], ...]:
    """Every global name that code reads, with the attribute that is taken of it at once, if any."""
    return tuple(sorted(set(_loaded(code))))


def _loaded(code: CodeType) -> Iterator[tuple[str, str]]:
    steps = [each for each in dis.get_instructions(code) if each.opname not in ("CACHE", "EXTENDED_ARG")]
    for step, after in zip(steps, [*steps[1:], None], strict=True):
        if step.opname in ("LOAD_GLOBAL", "LOAD_NAME"):
            taken = after is not None and after.opname in ("LOAD_ATTR", "LOAD_METHOD")
            yield step.argval, after.argval if after is not None and taken else ""
    for each in code.co_consts:
        if isinstance(each, CodeType):
            yield from _loaded(each)


def _around(dispatcher: Any) -> Iterable[str]:
    yield from _versions()
    yield repr(dispatcher.targetctx.codegen().magic_tuple())
    for name in sorted(dir(config)):
        if name.isupper() and not name.startswith(NOT_OF_CODE):
            yield f"{name}={getattr(config, name)!r}"


@cache
def _versions() -> tuple[str, ...]:
    sources = b"".join(path.read_bytes() for path in sorted(Path(__file__).parent.glob("*.py")))
    return (
        f"{platform.python_implementation()} {sys.version}",
        f"{numba.__version__} {llvmlite.__version__} {np.__version__}",
        hashlib.sha256(sources).hexdigest(),
    )
