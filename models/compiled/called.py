"""Functions compiled twice at most: for compiled code that calls them, and for Python, if it ever does."""

from __future__ import annotations

from typing import Any

from numba.core import datamodel, registry

CPUDispatcher: Any = registry.CPUDispatcher
numbas_records: Any = datamodel


class FreedTooSoon(Exception):
    """A function in which no references are counted gives back what has some."""


def refuse_uncounted(function: Any, given_back: Any) -> None:
    """Refuse one that would have what it was handed freed while others still refer to it."""
    if (
        not function.targetoptions.get("_nrt", True)
        and numbas_records.default_manager.lookup(given_back).contains_nrt_meminfo()
    ):
        raise FreedTooSoon(f"{function.py_func.__qualname__} gives back {given_back}; its references must be counted")


class Inner(CPUDispatcher):  # type: ignore[misc]
    """A function as compiled code calls it; Python is given ``outer``, compiled of the same when it first calls.

    The ways in from Python and from C, which numba makes of each function with its code, take as long to compile as
    all the rest; of hundreds of functions two or three are called from there.
    """

    def __init__(self, outer: Any) -> None:
        without = {"no_cpython_wrapper": True, "no_cfunc_wrapper": True}
        super().__init__(outer.py_func, targetoptions={**outer.targetoptions, **without})
        self.outer = outer

    def add_overload(self, cres: Any) -> None:
        """Keep code for compiled callers alone: there is no way into it from Python.

        Raises:
            FreedTooSoon: no references are counted in it, and it gives back what has some.
        """
        refuse_uncounted(self, cres.signature.return_type)
        self.overloads[tuple(cres.signature.args)] = cres

    def _compile_for_args(self, *given: Any, **named: Any) -> Any:
        """Have the way in from Python compiled, for values of these types; the next such call finds it at once."""
        found = self.outer._compile_for_args(*given, **named)
        for types, made in self.outer.overloads.items():
            if made.entry_point is found:
                self._insert([each._code for each in types], found, False)
        return found
