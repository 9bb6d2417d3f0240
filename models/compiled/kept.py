"""Compiled functions, kept from one process for the next by what they are made of.

Compiling a day of a system takes half a minute, reading it a fraction of a second.  What is kept is named by the
digest of its contents (``contents.py``), so a changed source, or a planted fault, is compiled anew.  A file that is
not whole, or was written by something else, is compiled over; where nothing can be written nothing is kept.
"""

from __future__ import annotations

import hashlib
import io
import os
import pickle
import secrets
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress
from functools import cache, reduce
from operator import getitem
from pathlib import Path
from typing import Any, TypeVar, overload

import numba
from numba import core as numba_core
from numba.core.caching import NullCache
from numba.core.serialize import NumbaPickler

from models.compiled.called import Inner
from models.compiled.contents import Unknown, digest_of, digest_of_types
from models.compiled.references import count_by_one_thread
from models.kept_folder import kept_folder
from models.names_apart import name_apart

Code = TypeVar("Code", bound=Callable[..., Any])
core: Any = numba_core
DIGEST_BYTES = hashlib.sha256().digest_size
UNUSED_S = 30 * 24 * 3_600
"""What nobody has read for so long is deleted."""
Place = tuple[int, ...]
"""Where among arguments something is: which argument; if that is a tuple, which of its members; and so on."""


@overload
def compiled(function: Code, /, **options: Any) -> Code: ...
@overload
def compiled(**options: Any) -> Callable[[Code], Code]: ...
def compiled(function: Any = None, /, **options: Any) -> Any:
    """Compile a function by numba, with its options, when it is first called; the next process reads it."""
    if function is None:
        return lambda named: compiled(named, **options)
    outer: Any = numba.njit(function, **options)
    if not isinstance(outer, core.dispatcher.Dispatcher):
        return outer
    made = Inner(outer)
    for each in (outer, made):
        each._cache = Keeping(each)
    return made


class Keeping(NullCache):
    """What numba asks for the code of one function, and gives it to, in place of its own cache."""

    def __init__(self, dispatcher: Any) -> None:
        self._dispatcher = dispatcher
        self._met: tuple[str, list[Any]] | None = None
        self._is_lost = False

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        """Return the code for arguments of these types, if it is kept."""
        arguments, _ = core.sigutils.normalize_signature(sig)
        target_context.refresh()
        path = self._path(arguments)
        return None if path is None else _read(path, arguments, target_context)

    def save_overload(self, sig: Any, data: Any) -> None:
        """Keep code that was just compiled."""
        arguments, _ = core.sigutils.normalize_signature(sig)
        path = self._path(arguments)
        if path is not None and not data.lifted and not data.library.has_dynamic_globals:
            _write(path, arguments, data)

    def meet(self, own: str, callees: Sequence[Any]) -> None:
        """Refuse a function that is not what it was: this process may have compiled it as it was, or as it is."""
        before, self._met = self._met, (own, list(callees))
        if before is not None and (before[0] != own or list(map(id, before[1])) != list(map(id, callees))):
            self._is_lost = True
        if self._is_lost:
            raise Unknown(f"{self._dispatcher} has changed, or was not known once")

    def _path(self, arguments: Sequence[Any]) -> Path | None:
        """Where the code is kept, none if it cannot be."""
        try:
            own = digest_of(self._dispatcher, _meet)
        except Unknown:
            # It is compiled here and now of something that no digest tells of; whatever calls it has that in it.
            self._is_lost = True
            return None
        try:
            given = digest_of_types(arguments, _meet)
        except Unknown:
            return None
        folder = kept_folder("compiled")
        return None if folder is None else folder / hashlib.sha256(f"{own} {given}".encode()).hexdigest()


def _meet(dispatcher: Any, own: str, callees: Sequence[Any]) -> None:
    keeping = dispatcher._cache
    if not isinstance(keeping, Keeping):
        raise Unknown(f"{dispatcher} is not kept")
    keeping.meet(own, callees)


# ---- files


def _read(path: Path, arguments: Sequence[Any], target_context: Any) -> Any:
    """Read code; none if there is none, or none that can be used."""
    try:
        digest, kept = (text := path.read_bytes())[:DIGEST_BYTES], text[DIGEST_BYTES:]
        if hashlib.sha256(kept).digest() != digest:
            return None
        found = core.compiler.CompileResult._rebuild(target_context, *_Unpickler(kept, arguments).load())
    except Exception:
        # Whatever is wrong with a file, and with what it names: what is compiled anew is right.
        return None
    with suppress(OSError):
        os.utime(path)
    return found._replace(signature=core.typing.signature(found.signature.return_type, *arguments))


def _write(path: Path, arguments: Sequence[Any], data: Any) -> None:
    """Write code whole or not at all; another process may write the same at once."""
    pickled = io.BytesIO()
    made: Any = _Pickler
    pickler = made(pickled)
    pickler.arguments = arguments
    try:
        pickler.dump(data._reduce())
    except (pickle.PicklingError, TypeError, ValueError):
        return
    kept = pickled.getvalue()
    beside = path.with_name(f"{path.name}.{secrets.token_hex(8)}")
    try:
        beside.write_bytes(hashlib.sha256(kept).digest() + kept)
        beside.replace(path)
        _forget(path.parent)
    except OSError:
        beside.unlink(missing_ok=True)


@cache
def _forget(folder: Path) -> None:
    """Delete what nobody has read for long; once in a process."""
    for path in folder.iterdir():
        with suppress(OSError):
            if path.stat().st_mtime < time.time() - UNUSED_S:
                path.unlink()


class _Pickler(NumbaPickler):
    """A function that is an argument is named by its place: it is one of this process, and not to be made anew."""

    arguments: Sequence[Any]

    def persistent_id(self, value: Any) -> Place | None:
        """The place of a function among the arguments."""
        if not isinstance(value, core.types.Dispatcher):
            return None
        for place, each in _functions(self.arguments):
            if each == value:
                return place
        raise pickle.PicklingError(f"{value} is not among the arguments")


class _Unpickler(pickle.Unpickler):
    def __init__(self, kept: bytes, arguments: Sequence[Any]) -> None:
        super().__init__(io.BytesIO(kept))
        self._arguments = arguments

    def persistent_load(self, place: Any) -> Any:
        """The function that is now in its place."""
        return reduce(getitem, place, self._arguments)


def _functions(arguments: Iterable[Any], within: Place = ()) -> Iterator[tuple[Place, Any]]:
    """Every function among arguments, and in tuples among them however deep, with its place."""
    for number, each in enumerate(arguments):
        place = (*within, number)
        if isinstance(each, core.types.Dispatcher):
            yield place, each
        elif isinstance(each, core.types.BaseTuple):
            yield from _functions(each, place)


name_apart()
count_by_one_thread()
