"""References of compiled code are counted by plain additions.

What numba compiles holds the interpreter's lock while it runs, so that no two threads count at once.  It counts by
locked instructions all the same, and machines whose maps are handed on by value spent three quarters of a day's time
in them.  ``tests/compiled/test_references.py`` asks that what nobody refers to is freed as before.
"""

from __future__ import annotations

from typing import Any

from llvmlite import ir
from numba.core.runtime import nrtdynmod

made_of_numba: Any = nrtdynmod


def count_by_one_thread() -> None:
    """Have numba's runtime count without locks; to be called before the first function of a process is compiled."""
    made_of_numba._define_atomic_inc_dec = _counting


def _counting(module: Any, op: str, ordering: str) -> Any:
    """Define the function that counts one up (``add``) or down (``sub``) and gives what it comes to."""
    word: Any = made_of_numba._word_type
    function = ir.Function(module, ir.FunctionType(word, [word.as_pointer()]), name=f"nrt_atomic_{op}")
    builder = ir.IRBuilder(function.append_basic_block())
    (place,) = function.args
    after = getattr(builder, op)(builder.load(place), ir.Constant(word, 1))
    builder.store(after, place)
    builder.ret(after)
    return function
