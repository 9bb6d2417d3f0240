"""Functions of compiled code that count references only of what they are given and give back.

A function may look at what it was handed without counting: whoever called it holds all that until it returns.  So
most functions of the machines need count only what they are given by those that they call, which they hold until they
return, and what they give back.  Counting each record on its way, once for each map in it, took most of their time.
Which functions can be compiled so is read off their steps and types.
"""

from __future__ import annotations

from typing import Any

from numba import core as numba_core
from numba.core.runtime import context

core: Any = numba_core
of_counting: Any = context

LOOKED_AT = frozenset({"getattr", "build_tuple", "cast", "phi", "exhaust_iter", "getiter"})
"""Steps whose result is, or is made of, what is held already."""


def has_references(given: Any) -> bool:
    """Tell whether values of a type refer to what is counted."""
    return bool(core.datamodel.default_manager.lookup(given).contains_nrt_meminfo())


def is_looked_at(value: Any, typed: dict[str, Any]) -> bool:
    """Tell whether a step gives nothing but what is held already, a record of it, or a row of an array."""
    if not isinstance(value, core.ir.Expr) or value.op in LOOKED_AT:
        return True
    if value.op == "static_getitem" and isinstance(typed[value.value.name], core.types.BaseTuple):
        return True
    if value.op in ("getitem", "static_getitem"):
        number = typed[(value.index if value.op == "getitem" else value.index_var).name]
        return isinstance(typed[value.value.name], core.types.Array) and isinstance(number, core.types.Integer)
    return value.op == "call" and isinstance(typed[value.func.name], core.types.NamedTupleClass)


def is_given(value: Any, typed: dict[str, Any]) -> bool:
    """Tell whether a step has a function of ours called, or an item of a list taken, and so gives what is to be held.

    ``typed``: the types of the variables around it.
    """
    if value.op == "call":
        called = typed[value.func.name]
        return isinstance(called, core.types.Dispatcher) or (
            isinstance(called, core.types.Function)
            and all(issubclass(each, core.typing.templates._OverloadFunctionTemplate) for each in called.templates)
        )
    return value.op in ("getitem", "static_getitem") and isinstance(typed[value.value.name], core.types.ListType)


def in_loops(function: Any) -> frozenset[int]:
    """Give the blocks of a function that may run more than once."""
    return frozenset(
        block for loop in core.analysis.compute_cfg_from_blocks(function.blocks).loops().values() for block in loop.body
    )


def held(function: Any, typed: dict[str, Any]) -> frozenset[str] | None:
    """Give the variables that hold what a function is given, until it returns; None if it has to count each step.

    It has to if it makes anything that has references by other steps, or is given any in a loop, where the variable
    holds the next one before it returns.
    """
    found: list[str] = []
    repeated = in_loops(function)
    for number, block in function.blocks.items():
        for step in block.find_insts(core.ir.Assign):
            if has_references(typed[step.target.name]) and not is_looked_at(step.value, typed):
                if number in repeated or not is_given(step.value, typed):
                    return None
                found.append(step.target.name)
    return frozenset(found) if len(found) == len(set(found)) else None


class Lowering(core.lowering.Lower):  # type: ignore[misc]
    """Lays out a function's code; where it need not count each step, counts what it is given and gives back."""

    def pre_lower(self) -> None:
        """Know what is to be held."""
        super().pre_lower()
        self._held: dict[str, Any] = {}
        chosen = None if self.context.enable_nrt else held(self.func_ir, self.fndesc.typemap)
        self._to_hold: frozenset[str] = frozenset() if chosen is None else chosen

    def storevar(self, value: Any, name: str, argidx: int | None = None) -> None:
        """Hold what a function was given, beside the variable, which is empty again after its last use."""
        super().storevar(value, name, argidx)
        if name in self._to_hold:
            self.builder.store(value, self._slots()[name])

    def _slots(self) -> dict[str, Any]:
        """Give the places for what is to be held; empty when the function begins."""
        for name in sorted(self._to_hold - self._held.keys()):
            kept = self.context.get_value_type(self.typeof(name))
            self._held[name] = core.cgutils.alloca_once(self.builder, kept, name=f"held.{name}")
        return self._held

    def lower_inst(self, inst: Any) -> None:
        """Count what is given back, and then let go what was held."""
        if isinstance(inst, core.ir.Return) and not self.context.enable_nrt:
            counted = of_counting.NRTContext(self.context, True)
            counted.incref(self.builder, self.typeof(inst.value.name), self.loadvar(inst.value.name))
            for name, slot in self._slots().items():
                counted.decref(self.builder, self.typeof(name), self.builder.load(slot))
        super().lower_inst(inst)


@core.compiler_machinery.register_pass(mutates_CFG=False, analysis_only=True)
class CountLess(core.compiler_machinery.AnalysisPass):  # type: ignore[misc]
    """Chooses which functions need not count each step."""

    _name = "count_less"

    def __init__(self) -> None:
        core.compiler_machinery.AnalysisPass.__init__(self)

    def run_pass(self, state: Any) -> bool:
        """Choose, once types are known; a way in from Python counts what it makes of Python's values, and stays."""
        if state.flags.no_cpython_wrapper and held(state.func_ir, state.typemap) is not None:
            state.targetctx = state.targetctx.subtarget(enable_nrt=False)
        return False


@core.compiler_machinery.register_pass(mutates_CFG=True, analysis_only=False)
class Lower(core.typed_passes.BaseNativeLowering):  # type: ignore[misc]
    """Has a function laid out as above."""

    _name = "lower_counting_less"

    @property
    def lowering_class(self) -> Any:
        """Give who lays it out."""
        return Lowering


class Compiler(core.compiler.CompilerBase):  # type: ignore[misc]
    """numba's own passes, with these two among them."""

    def define_pipelines(self) -> list[Any]:
        """Give the one order of passes."""
        made = core.compiler.DefaultPassBuilder.define_nopython_pipeline(self.state)
        own = core.typed_passes.NativeLowering
        made.passes = [(Lower if each is own else each, name) for each, name in made.passes]
        made.add_pass_after(CountLess, core.typed_passes.NopythonTypeInference)
        made.finalize()
        return [made]
