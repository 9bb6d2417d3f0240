"""Functions compiled twice at most: for compiled code that calls them, and for Python, if it ever does."""

from __future__ import annotations

from typing import Any

from numba.core import registry

from models.compiled.holding import Compiler

CPUDispatcher: Any = registry.CPUDispatcher


class Inner(CPUDispatcher):  # type: ignore[misc]
    """A function as compiled code calls it; Python is given ``outer``, compiled of the same when it first calls.

    The ways in from Python and from C, which numba makes of each function with its code, take as long to compile as
    all the rest; of hundreds of functions two or three are called from there.
    """

    def __init__(self, outer: Any) -> None:
        without = {"no_cpython_wrapper": True, "no_cfunc_wrapper": True}
        super().__init__(outer.py_func, targetoptions={**outer.targetoptions, **without}, pipeline_class=Compiler)
        self.outer = outer

    def add_overload(self, cres: Any) -> None:
        """Keep code for compiled callers alone: there is no way into it from Python."""
        self.overloads[tuple(cres.signature.args)] = cres

    def _compile_for_args(self, *given: Any, **named: Any) -> Any:
        """Have the way in from Python compiled, for values of these types; the next such call finds it at once."""
        found = self.outer._compile_for_args(*given, **named)
        for types, made in self.outer.overloads.items():
            if made.entry_point is found:
                self._insert([each._code for each in types], found, False)
        return found
