"""Machine code for a site: steps of the world, the invariants as oracles, and why the kernel refused."""

from __future__ import annotations

import ctypes
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import llvmlite.binding as llvm
from llvmlite import ir

from fuzz.compiled.contents import content, write
from fuzz.compiled.emitter import (
    AND_NOT,
    ENTRY_WORDS,
    FUNCTION,
    GROWN,
    I64,
    LOG_COUNT,
    OR,
    SHRUNK,
    STORE,
    Emitter,
)
from fuzz.compiled.memory import HEADER, KEYS, Ints, Memory, Packing, lay_out
from fuzz.compiled.places import Place, Planner
from fuzz.compiled.reading import Reader
from fuzz.compiled.refusals import REFUSALS
from fuzz.compiled.values import Fixed, Truth, Value, constant, flat, is_none, some, truth_of, word_if
from kernel.refusal import Refusal
from models.world import assumptions
from models.world.state import Site
from proofs.catalogue import INVARIANTS
from proofs.lift.kinds import kind_of_type
from proofs.lift.sources import Code
from proofs.mutated import Sources
from proofs.transitions import TRANSITIONS, event_types

REFUSED: tuple[Refusal, ...] = tuple(Refusal)
"""A refusal's number is its place here."""
ASSUMED: tuple[str, ...] = (
    "a_train_obeys_its_authority",
    "a_train_runs_forward_along_its_run",
    "rails_lead",
    "a_tag_is_read_where_it_lies",
    "a_run_is_led_by_its_front",
    "a_pair_passed_in_order_proves_the_exit",
    "a_missed_tag_is_overdue_before_the_tail_comes",
    "a_healthy_line_reaches_the_tail",
    "a_head_runs_no_farther_than_its_brake_lets_it",
    "a_train_within_its_destination_is_not_beyond",
    "a_located_train_stands_where_it_says",
    "two_persons_do_not_both_err",
    "detection_is_true",
)
"""What the world assumes of nature; the number of each is its bit in ``broken``."""
ASSUMPTIONS: Mapping[Code, int] = {getattr(assumptions, name): at for at, name in enumerate(ASSUMED)}
SPEED_LEVEL = 2
TWO = ir.FunctionType(I64, [I64.as_pointer(), I64])
STATE_HASH, ACCEPTED = (HEADER.index(name) for name in ("state_hash", "accepted"))
WAYS: Mapping[str, int] = {GROWN: AND_NOT, SHRUNK: OR}
"""What a part does, and the entry of the log that does the contrary."""
I32_SHIFT, FIRST_SHIFT = 32, 29


@dataclass(frozen=True)
class Native:
    """The compiled functions of a site, by address.

    ``step(memory, kind)``: take the event in the buffer; 1 if the state changed.
    ``step_beyond(memory, kind)``: the same though nature does not do so; see ``broken`` in the header.
    ``judge(memory)``: the number of the first invariant that what has changed has made false; or -1.
    ``why(memory, kind)``: the number of the kernel's refusal of the event; or -1.
    ``holds_N(memory)``: 1 if the invariant of this number holds.
    """

    memory: Memory
    addresses: Mapping[str, int]
    engine: Any = field(repr=False)
    asked_when: Mapping[str, Mapping[str, int]] = field(repr=False)

    def call(self, name: str, memory: Ints, *numbers: int) -> int:
        """Call one of the functions."""
        kind = ctypes.CFUNCTYPE(ctypes.c_int64, ctypes.c_void_p, *(ctypes.c_int64 for _ in numbers))
        return int(kind(self.addresses[name])(memory.ctypes.data, *numbers))

    def put_event(self, memory: Ints, kind: int, event: Mapping[str, Any], runs: Mapping[Any, int]) -> None:
        """Write an event into the buffer; ``runs``: the slots."""
        base = self.memory.event.base
        memory[base : base + self.memory.event.size] = 0
        packing = Packing(self.memory, memory, runs)
        for name, place in event_places(self.memory, kind).items():
            packing.put(place, (), event[name])


def native(site: Site, sources: Sources | None = None) -> Native:
    """Compile a site; ``sources``: other bodies for some functions of the kernel (planted faults)."""
    return compiled(lay_out(site), sources)


def compiled(memory: Memory, sources: Sources | None = None) -> Native:
    """Compile for a memory that is laid out."""
    building = _Building(memory, sources or {})
    text = str(building.module)
    engine = _engine(text)
    names = ("step", "step_beyond", "judge", "why", *(f"holds_{at}" for at in range(len(INVARIANTS))))
    return Native(memory, {name: engine.get_function_address(name) for name in names}, engine, building.asked_when)


def event_places(memory: Memory, kind: int) -> dict[str, Place]:
    """Where the parts of an event lie in the buffer."""
    plan = Planner(memory.domains, memory.event.base)
    return {name: plan.place(kind_of_type(each), name) for name, each in event_types(TRANSITIONS[kind]).items()}


class _Building:
    """All functions of one site."""

    def __init__(self, memory: Memory, sources: Sources) -> None:
        self.memory, self.sources = memory, sources
        self.module = ir.Module("heisoku")
        self.module.triple = llvm.get_default_triple()
        self.asked_when: dict[str, Mapping[str, int]] = {}
        apply = self._apply()
        steps, beyond, whys = {}, {}, {}
        for kind, transition in enumerate(TRANSITIONS):
            steps[kind] = self._step(kind, transition, f"step_{kind}", None)
            beyond[kind] = self._step(kind, transition, f"beyond_{kind}", _Assuming())
            if transition.__name__ in REFUSALS:
                whys[kind] = self._why(kind, REFUSALS[transition.__name__])
        self._dispatch("step", steps, apply, 0)
        self._dispatch("step_beyond", beyond, apply, 0)
        self._dispatch("why", whys, None, -1)
        self._judge({name: self._holds(at, name) for at, name in enumerate(INVARIANTS)})

    def _arguments(self, reader: Reader, kind: int) -> dict[str, Value]:
        event = {name: content(place, ()) for name, place in event_places(self.memory, kind).items()}
        return {"site": reader.site(), "system": reader.system(), **event}

    def _step(self, kind: int, transition: Code, name: str, assuming: _Assuming | None) -> ir.Function:
        e = Emitter(self.module, name, self.memory)
        asked = frozenset(ASSUMPTIONS) if assuming else frozenset()
        reader = Reader(self.memory, self.sources, assuming, asked)
        write(e, self.memory.state, (), reader.call(transition, self._arguments(reader, kind)))
        e.finish(I64(0))
        return e.function

    def _why(self, kind: int, asked: Code) -> ir.Function:
        e = Emitter(self.module, f"why_{kind}", self.memory)
        reader = Reader(self.memory, self.sources)
        found = reader.call(asked, self._arguments(reader, kind))
        number = word_if(is_none(found), constant(-1), flat(some(found))[0])
        e.finish(number.emit(e))
        return e.function

    def _holds(self, at: int, name: str) -> ir.Function:
        e = Emitter(self.module, f"holds_{at}", self.memory)
        reader = Reader(self.memory)
        value = truth_of(reader.call(INVARIANTS[name], {"site": reader.site(), "system": reader.system()}))
        holds, false = e.block(), e.block()
        value.jump(e, holds, false)
        for block, word in ((holds, 1), (false, 0)):
            e.enter(block)
            e.build.ret(I64(word))
        e.begin()
        self.asked_when[name] = e.asked_when
        return e.function

    def _apply(self) -> ir.Function:
        """Write the log: each word that differs changes the hash and is noted.

        A set may be cleared and filled with what it had, so whether anything changed is told by the hash.
        """
        e = Emitter(self.module, "apply", self.memory)
        b = e.build
        changed = {way: e.variable() for way in WAYS}
        before = b.load(e.pointer(I64(STATE_HASH)))

        def entry(index: ir.Value) -> None:
            begin = b.add(b.mul(index, I64(ENTRY_WORDS)), I64(self.memory.log))
            address, does, word = (b.load(e.pointer(b.add(begin, I64(offset)))) for offset in range(ENTRY_WORDS))
            place = e.pointer(address)
            old = b.load(place)
            what = b.and_(does, I64(3))
            others = b.select(e.equal(what, I64(OR)), b.or_(old, word), b.and_(old, b.not_(word)))
            new = b.select(e.equal(what, I64(STORE)), word, others)
            differs, after = e.block(), e.block()
            b.cbranch(e.equal(new, old), after, differs)
            e.enter(differs)
            b.store(new, place)
            part = b.shl(I64(1), b.ashr(does, I64(2)))
            for way, contrary in WAYS.items():
                did = b.select(e.equal(what, I64(contrary)), I64(0), part)
                b.store(b.or_(b.load(changed[way]), did), changed[way])
            state_hash = e.pointer(I64(STATE_HASH))
            b.store(b.add(b.load(state_hash), b.sub(_mixed(e, address, new), _mixed(e, address, old))), state_hash)
            b.branch(after)
            e.enter(after)

        e.loop_to(b.load(e.pointer(I64(LOG_COUNT))), entry)
        for way in WAYS:
            noted = e.pointer(I64(HEADER.index(way)))
            b.store(b.or_(b.load(noted), b.load(changed[way])), noted)
        result = b.zext(b.icmp_signed("!=", b.load(e.pointer(I64(STATE_HASH))), before), I64)
        accepted = e.pointer(I64(ACCEPTED))
        b.store(b.add(b.load(accepted), result), accepted)
        e.finish(result)
        return e.function

    def _dispatch(self, name: str, cases: Mapping[int, ir.Function], then: ir.Function | None, other: int) -> None:
        """One function that calls another by number."""
        function = ir.Function(self.module, TWO, name)
        words, kind = function.args
        b = ir.IRBuilder(function.append_basic_block())
        b.store(I64(0), b.gep(words, [I64(HEADER.index("broken"))]))
        default = function.append_basic_block()
        switch = b.switch(kind, default)
        b.position_at_end(default)
        b.ret(I64(other))
        for number, case in cases.items():
            block = function.append_basic_block()
            switch.add_case(I64(number), block)
            b.position_at_end(block)
            found = b.call(case, [words])
            b.ret(found if then is None else b.call(then, [words]))

    def _judge(self, cases: Mapping[str, ir.Function]) -> None:
        """Ask the invariants that what has changed may have made false."""
        function = ir.Function(self.module, FUNCTION, "judge")
        (words,) = function.args
        b = ir.IRBuilder(function.append_basic_block())
        changed = {}
        for way in WAYS:
            place = b.gep(words, [I64(HEADER.index(way))])
            changed[way] = b.load(place)
            b.store(I64(0), place)
        for at, (name, case) in enumerate(cases.items()):
            asked, false, after = (function.append_basic_block() for _ in range(3))
            touched = (b.and_(changed[way], I64(self.asked_when[name][way])) for way in WAYS)
            b.cbranch(b.icmp_signed("!=", b.or_(*touched), I64(0)), asked, after)
            b.position_at_end(asked)
            b.cbranch(b.icmp_signed("==", b.call(case, [words]), I64(0)), false, after)
            b.position_at_end(false)
            b.ret(I64(at))
            b.position_at_end(after)
        b.ret(I64(-1))


class _Assuming:
    """Takes every assumption about nature for true, and notes those that are not."""

    def __call__(self, function: Code, value: Truth) -> Truth:
        return _Noted(ASSUMPTIONS[function], value)


class _Noted(Truth):
    def __init__(self, number: int, value: Truth) -> None:
        self.number, self.value = number, value

    def jump(self, e: Emitter, yes: ir.Block, no: ir.Block) -> None:
        if isinstance(self.value, Fixed):
            self.value.jump(e, yes, no)
            return
        broken = e.block()
        self.value.jump(e, yes, broken)
        e.enter(broken)
        e.note_broken(self.number)
        e.build.branch(yes)


def _mixed(e: Emitter, address: ir.Value, word: ir.Value) -> ir.Value:
    """What a word adds to the hash: as :func:`fuzz.compiled.memory.mixed`, nothing for zero."""
    b, (first, second, third) = e.build, (I64(int(key)) for key in KEYS)
    value = b.add(b.mul(word, first), b.mul(address, second))
    value = b.mul(b.xor(value, b.lshr(value, I64(FIRST_SHIFT))), third)
    value = b.xor(value, b.lshr(value, I64(I32_SHIFT)))
    return b.select(e.equal(word, I64(0)), I64(0), value)


def _machine() -> Any:
    llvm.initialize_native_target()
    llvm.initialize_native_asmprinter()
    return llvm.Target.from_default_triple().create_target_machine(opt=SPEED_LEVEL)


def _engine(text: str) -> Any:
    """Compile a module; the functions live as long as what is returned."""
    machine = _machine()
    module = llvm.parse_assembly(text)
    options = llvm.create_pipeline_tuning_options(speed_level=SPEED_LEVEL)
    options.inlining_threshold = 50
    passes = llvm.create_pass_builder(machine, options)
    passes.getModulePassManager().run(module, passes)
    engine = llvm.create_mcjit_compiler(
        module, llvm.Target.from_default_triple().create_target_machine(opt=SPEED_LEVEL)
    )
    engine.finalize_object()
    return engine
