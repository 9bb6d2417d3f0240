"""Terms of logic as text: on one line where it fits, else broken as lists of ∧ or ∨ with their indentation."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

OPPOSITE = {"=": "≠", "≠": "=", "∈": "∉", "∉": "∈", "<": "≥", "≥": "<", ">": "≤", "≤": ">"}
EXCLUDING = ("≠", "∉")
"""Relations that an ``or`` begins with in order to exclude what they deny."""
STEP = 2
"""So many columns is what is within moved in."""


@dataclass(frozen=True)
class Term:
    """A term."""

    def flat(self) -> str:
        """It on one line."""
        raise NotImplementedError

    def within(self, level: int) -> str:
        """It on one line within something that binds so tightly, in brackets where it does not bind more tightly."""
        return self.flat() if level_of(self) > level else f"({self.flat()})"

    def broken(self, columns: int) -> list[str]:
        """It on several lines; what cannot be broken stays on one."""
        return [self.flat()]


@dataclass(frozen=True)
class Atom(Term):
    """A name or a constant."""

    text: str

    def flat(self) -> str:
        """The text."""
        return self.text


TRUE, FALSE = Atom("true"), Atom("false")


@dataclass(frozen=True)
class Listed(Term):
    """A tuple, or a set of members."""

    opens: str
    parts: tuple[Term, ...]
    closes: str

    def flat(self) -> str:
        """Between brackets, with commas."""
        return f"{self.opens}{', '.join(each.flat() for each in self.parts)}{self.closes}"


@dataclass(frozen=True)
class Applied(Term):
    """A word with what it is told."""

    name: str
    parts: tuple[Term, ...]

    def flat(self) -> str:
        """As a function is written."""
        return f"{self.name}({', '.join(each.flat() for each in self.parts)})"


@dataclass(frozen=True)
class Entry(Term):
    """The entry of a map at a key; of a map of maps at several."""

    owner: Term
    keys: tuple[Term, ...]

    def flat(self) -> str:
        """As a function is written."""
        return f"{self.owner.within(8)}({', '.join(each.flat() for each in self.keys)})"


@dataclass(frozen=True)
class Field(Term):
    """A field of what is no plain name."""

    owner: Term
    name: str

    def flat(self) -> str:
        """With a dot."""
        return f"{self.owner.within(8)}.{self.name}"


@dataclass(frozen=True)
class Product(Term):
    """A product, or a quotient rounded down."""

    left: Term
    sign: str
    right: Term

    def flat(self) -> str:
        """With its sign between."""
        return f"{self.left.within(6)} {self.sign} {self.right.within(7)}"


@dataclass(frozen=True)
class Sum(Term):
    """A sum; each part with its sign."""

    parts: tuple[tuple[str, Term], ...]

    def flat(self) -> str:
        """Without the sign of the first where that is +."""
        (sign, first), *rest = self.parts
        begun = first.within(6) if sign == "+" else f"{sign}{first.within(7)}"
        return " ".join([begun, *(f"{sign} {each.within(6)}" for sign, each in rest)])

    def broken(self, columns: int) -> list[str]:
        """A line for each part."""
        (sign, first), *rest = self.parts
        begun = first.within(6) if sign == "+" else f"{sign}{first.within(7)}"
        return [begun, *(f"{sign} {each.within(6)}" for sign, each in rest)]


@dataclass(frozen=True)
class Related(Term):
    """A comparison, or a chain of them."""

    parts: tuple[Term, ...]
    signs: tuple[str, ...]

    def flat(self) -> str:
        """With the signs between."""
        rest = (f"{sign} {each.within(5)}" for sign, each in zip(self.signs, self.parts[1:], strict=True))
        return " ".join([self.parts[0].within(5), *rest])

    def broken(self, columns: int) -> list[str]:
        """A line for each side, or as many as it needs."""
        found = self._side(self.parts[0], columns)
        for sign, each in zip(self.signs, self.parts[1:], strict=True):
            found += led(f"{sign} ", self._side(each, columns - STEP))
        return found

    @staticmethod
    def _side(term: Term, columns: int) -> list[str]:
        """A side, in brackets where it binds less tightly than a relation."""
        if level_of(term) > LEVELS[Related]:
            return lines(term, columns)
        *first, last = led("(", lines(term, columns - STEP))
        return [*first, f"{last})"]


@dataclass(frozen=True)
class Negated(Term):
    """Not."""

    part: Term

    def flat(self) -> str:
        """With its sign."""
        return f"¬{self.part.within(8)}"

    def broken(self, columns: int) -> list[str]:
        """The sign before the first line."""
        return led("¬ ", lines(self.part, columns - STEP))


@dataclass(frozen=True)
class Joined(Term):
    """And, or or."""

    sign: str
    parts: tuple[Term, ...]

    def flat(self) -> str:
        """With the sign between."""
        return f" {self.sign} ".join(each.within(3) for each in self.parts)

    def broken(self, columns: int) -> list[str]:
        """A list, each part with the sign before it."""
        return [line for each in self.parts for line in led(f"{self.sign} ", lines(each, columns - STEP))]


@dataclass(frozen=True)
class Implied(Term):
    """What is given, and what then holds."""

    given: Term
    then: Term

    def flat(self) -> str:
        """With an arrow between."""
        return f"{self.given.within(1)} → {self.then.within(1)}"

    def broken(self, columns: int) -> list[str]:
        """What is given moved in, then the arrow."""
        given = lines(self.given, columns - STEP)
        return [*(f"  {line}" for line in given), *led("→ ", lines(self.then, columns - STEP))]


@dataclass(frozen=True)
class Quantified(Term):
    """For all, or there is one; over ranges, each with the name that a member of it has."""

    sign: str
    ranges: tuple[tuple[str, Term], ...]
    said: Term

    def _ranges(self) -> list[str]:
        return [f"{name} ∈ {over.within(5)}" for name, over in self.ranges]

    def flat(self) -> str:
        """Ranges, a colon, and what is said."""
        return f"{self.sign} {', '.join(self._ranges())}: {self.said.flat()}"

    def broken(self, columns: int) -> list[str]:
        """The ranges above, what is said moved in."""
        ranges = self._ranges()
        above = f"{self.sign} {', '.join(ranges)}:"
        heads = (
            [above]
            if len(above) <= columns
            else led(f"{self.sign} ", [*(f"{r}," for r in ranges[:-1]), f"{ranges[-1]}:"])
        )
        return [*heads, *(f"  {line}" for line in lines(self.said, columns - STEP))]


@dataclass(frozen=True)
class Chosen(Term):
    """One of two, by a condition."""

    condition: Term
    then: Term
    other: Term

    def flat(self) -> str:
        """In words."""
        return f"if {self.condition.flat()} then {self.then.within(0)} else {self.other.within(0)}"

    def broken(self, columns: int) -> list[str]:
        """A line for each."""
        parts = (("if ", self.condition), ("then ", self.then), ("else ", self.other))
        return [line for word, each in parts for line in led(word, lines(each, columns - len(word)))]


@dataclass(frozen=True)
class Let(Term):
    """A name for a value, in what follows."""

    name: str
    value: Term
    said: Term

    def flat(self) -> str:
        """In words."""
        return f"let {self.name} = {self.value.within(0)} in {self.said.flat()}"

    def broken(self, columns: int) -> list[str]:
        """The name above, what follows below it."""
        return [*led(f"let {self.name} = ", lines(self.value, columns - STEP)), *lines(self.said, columns)]


LEVELS: Mapping[type[Term], int] = {
    Quantified: 0,
    Chosen: 0,
    Let: 0,
    Implied: 1,
    Negated: 4,
    Related: 5,
    Sum: 6,
    Product: 7,
}
"""How tightly terms bind; or binds by 2 and and by 3, and what is not listed most tightly."""


def level_of(term: Term) -> int:
    """How tightly a term binds."""
    if isinstance(term, Joined):
        return 3 if term.sign == "∧" else 2
    return LEVELS.get(type(term), 9)


def lines(term: Term, columns: int) -> list[str]:
    """A term on one line where it fits, else broken; a name is given on a line of its own."""
    one = term.flat()
    return [one] if len(one) <= columns and not isinstance(term, Let) else term.broken(columns)


def led(sign: str, rest: Sequence[str]) -> list[str]:
    """Lines with a sign before the first, and the others below what follows it."""
    return [sign + rest[0], *(" " * len(sign) + line for line in rest[1:])]


# ---- joining


def conjoined(parts: Sequence[Term]) -> Term:
    """All of these; what is a conjunction itself is taken apart."""
    apart: list[Term] = []
    for each in parts:
        apart += each.parts if isinstance(each, Joined) and each.sign == "∧" else (each,)
    return apart[0] if len(apart) == 1 else Joined("∧", tuple(apart))


def disjoined(parts: Sequence[Term]) -> Term:
    """One of these; what the first of them deny is what the rest is said under."""
    given = 0
    while given < len(parts) - 1 and denies(parts[given]):
        given += 1
    rest = parts[given] if given == len(parts) - 1 else Joined("∨", tuple(parts[given:]))
    return implied(conjoined([negated(each) for each in parts[:given]]), rest) if given else rest


def denies(term: Term) -> bool:
    """Whether a term is the denial of something."""
    match term:
        case Related(_, (sign,)):
            return sign in EXCLUDING
        case Joined("∧", parts):
            return all(map(denies, parts))
    return isinstance(term, Negated)


def implied(given: Term, then: Term) -> Term:
    """What holds under something; two conditions, one within the other, are both given."""
    if isinstance(then, Implied):
        return Implied(conjoined([given, then.given]), then.then)
    return Implied(given, then)


def negated(term: Term) -> Term:
    """The opposite of a term, with the sign moved in where that is plain."""
    match term:
        case Negated(part):
            return part
        case Related(parts, (sign,)):
            return Related(parts, (OPPOSITE[sign],))
        case Joined(sign, parts):
            return Joined("∨" if sign == "∧" else "∧", tuple(negated(each) for each in parts))
    return Negated(term)
