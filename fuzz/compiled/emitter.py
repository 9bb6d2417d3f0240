"""Machine code for one function on a memory: words are read, conditions jump, what is to be written goes to a log.

All reading sees the state before the step; the log is written when all is known.  So a step means what the
functional text means, whatever it updates and in whatever order.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager

from llvmlite import ir

from fuzz.compiled.memory import HEADER, Memory
from fuzz.compiled.places import Array

I64, I1 = ir.IntType(64), ir.IntType(1)
FUNCTION = ir.FunctionType(I64, [I64.as_pointer()])
STORE, OR, AND_NOT = 0, 1, 2
"""What an entry of the log does to its word."""
GROWN, SHRUNK = "grown", "shrunk"
GROWS, EITHER_WAY, SHRINKS = 1, 0, -1
"""What is asked becomes truer as a set grows, may change either way, or becomes truer as it shrinks."""
ENTRY_WORDS = 3
LOG_COUNT, BROKEN = HEADER.index("log_count"), HEADER.index("broken")
UNROLLED = 4
"""Axes of up to so many entries are not worth a loop."""


class Emitter:
    """Builds one function ``(memory) -> int64``."""

    def __init__(self, module: ir.Module, name: str, memory: Memory) -> None:
        self.memory = memory
        self.function = ir.Function(module, FUNCTION, name)
        self.function.args[0].add_attribute("noalias")
        self.function.args[0].attributes.dereferenceable = 8 * memory.words
        self.words = self.function.args[0]
        self.entry = self.function.append_basic_block("entry")
        self.build = ir.IRBuilder(self.function.append_basic_block("body"))
        self.first = self.build.block
        self.sense = GROWS
        self.asked_when: dict[str, int] = {GROWN: 0, SHRUNK: 0}
        self.entries = self.variable()

    def variable(self, value: int = 0) -> ir.AllocaInstr:
        """A local variable."""
        with self.build.goto_block(self.entry):
            made = self.build.alloca(I64)
            self.build.store(I64(value), made)
        return made

    def finish(self, result: ir.Value) -> None:
        """Write down how many entries the log has, and return."""
        self.build.store(self.build.load(self.entries), self.pointer(I64(LOG_COUNT)))
        self.build.ret(result)
        self.begin()

    def begin(self) -> None:
        """All local variables are declared."""
        with self.build.goto_block(self.entry):
            self.build.branch(self.first)

    def block(self) -> ir.Block:
        """A new block, not yet entered."""
        return self.function.append_basic_block()

    def enter(self, block: ir.Block) -> None:
        """Go on in a block."""
        self.build.position_at_end(block)

    def pointer(self, address: ir.Value) -> ir.Value:
        """Where a word is."""
        return self.build.gep(self.words, [address])

    def address(self, array: Array, at: Sequence[ir.Value]) -> ir.Value:
        """The number of a word of an array."""
        at = at or [I64(0)]
        assert len(at) == len(array.shape), f"{array.name} has {len(array.shape)} axes"
        stride, terms = 1, []
        for size, index in zip(reversed(array.shape), reversed(at), strict=True):
            terms.append(index if stride == 1 else self.build.mul(index, I64(stride)))
            stride *= size
        total = terms[0]
        for term in terms[1:]:
            total = self.build.add(total, term)
        return self.build.add(total, I64(array.base))

    def load(self, array: Array, at: Sequence[ir.Value]) -> ir.Value:
        """Read a word."""
        self._note_read(array, EITHER_WAY)
        return self.build.load(self.pointer(self.address(array, at)))

    def load_members(self, array: Array, at: Sequence[ir.Value]) -> ir.Value:
        """Read a word of a set's bits, for nothing but whether there is something."""
        self._note_read(array, self.sense)
        return self.build.load(self.pointer(self.address(array, at)))

    def _note_read(self, array: Array, sense: int) -> None:
        if array.part >= 0:
            self.asked_when[GROWN] |= (sense != GROWS) << array.part
            self.asked_when[SHRUNK] |= (sense != SHRINKS) << array.part

    @contextmanager
    def in_sense(self, sense: int) -> Iterator[None]:
        """Emit a condition of which what is asked grows truer, or less true, or changes either way, as sets grow."""
        before, self.sense = self.sense, sense
        yield
        self.sense = before

    def write(self, array: Array, at: Sequence[ir.Value], does: int, word: ir.Value) -> None:
        """Put an entry in the log."""
        entry = self.build.load(self.entries)
        begin = self.build.add(self.build.mul(entry, I64(ENTRY_WORDS)), I64(self.memory.log))
        values = (self.address(array, at), I64(4 * array.part + does), word)
        for offset, value in enumerate(values):
            self.build.store(value, self.pointer(self.build.add(begin, I64(offset))))
        self.build.store(self.build.add(entry, I64(1)), self.entries)

    def note_broken(self, number: int) -> None:
        """Note that an assumption is broken."""
        place = self.pointer(I64(BROKEN))
        self.build.store(self.build.or_(self.build.load(place), I64(1 << number)), place)

    def equal(self, one: ir.Value, other: ir.Value) -> ir.Value:
        """Compare two words."""
        return self.build.icmp_signed("==", one, other)

    def loop(self, count: int, body: Callable[[ir.Value], None]) -> None:
        """Do something for 0, 1, ... below ``count``."""
        if count <= UNROLLED:
            for number in range(count):
                body(I64(number))
            return
        self.loop_to(I64(count), body)

    def loop_to(self, count: ir.Value, body: Callable[[ir.Value], None]) -> None:
        """Do something for 0, 1, ... below a count known when it runs."""
        index, head, inside, after = self.variable(), self.block(), self.block(), self.block()
        self.build.store(I64(0), index)
        self.build.branch(head)
        self.enter(head)
        now = self.build.load(index)
        self.build.cbranch(self.build.icmp_signed("<", now, count), inside, after)
        self.enter(inside)
        body(now)
        self.build.store(self.build.add(now, I64(1)), index)
        self.build.branch(head)
        self.enter(after)

    def each_bit(self, word: ir.Value, body: Callable[[ir.Value], None]) -> None:
        """Do something for the number of each bit in a word."""
        left, head, inside, after = self.variable(), self.block(), self.block(), self.block()
        self.build.store(word, left)
        self.build.branch(head)
        self.enter(head)
        now = self.build.load(left)
        self.build.cbranch(self.equal(now, I64(0)), after, inside)
        self.enter(inside)
        self.build.store(self.build.and_(now, self.build.sub(now, I64(1))), left)
        body(self.build.cttz(now, I1(1)))
        self.build.branch(head)
        self.enter(after)

    def has_bit(self, word: ir.Value, number: ir.Value) -> ir.Value:
        """Whether a word has a bit."""
        shifted = self.build.lshr(word, self.build.and_(number, I64(63)))
        return self.equal(self.build.and_(shifted, I64(1)), I64(1))

    def bit(self, number: ir.Value) -> ir.Value:
        """The word with this bit."""
        return self.build.shl(I64(1), self.build.and_(number, I64(63)))
