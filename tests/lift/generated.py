"""Functions of the subset made by chance: nested as no hand would, in every type that a state may have.

A writer grows expressions from the type wanted, over the variables at hand; where it wants a variable that is not
there, the function gets one more parameter.  What it writes is meant to be accepted; that it means the same in logic
is for ``test_generated.py`` to say.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from random import Random

from tests.lift.generated_types import (
    BERTH,
    BOOL,
    DEFAULTS,
    FIELDS,
    FLAG,
    INT,
    KEYS,
    PAIR,
    RECORDS,
    TIDE,
    TYPES,
    Type,
    annotation,
    inner,
    map_of,
    opt,
    parts,
    set_of,
)


class Writer:
    """Writes one function."""

    def __init__(self, random: Random, depth: int = 3) -> None:
        self.random, self.depth = random, depth
        self.parameters: dict[str, Type] = {}
        self.known: dict[str, Type] = {}
        self.declared: dict[str, Type] = {}
        self.bound: list[str] = []

    # Choices ---------------------------------------------------------------------------------

    def chance(self, probability: float) -> bool:
        """Whether something of this probability comes."""
        return self.random.random() < probability

    @contextmanager
    def knowing(self, **names: Type) -> Iterator[None]:
        """Write where these variables have these types as well."""
        before = self.known
        self.known = {**before, **names}
        try:
            yield
        finally:
            self.known = before

    def variable(self, type_: Type) -> str:
        """Return a variable of a type: one at hand, a field of one, or a new parameter."""
        found = [name for name, known in self.known.items() if known == type_]
        found += [
            f"{name}.{field}"
            for name, known in self.known.items()
            for field, of in FIELDS.get(known, {}).items()
            if of == type_
        ]
        if found and not (len(found) < 3 and len(self.parameters) < 12 and self.chance(0.3)):
            return self.random.choice(found)
        name = f"p{len(self.parameters)}"
        self.parameters[name] = self.declared[name] = type_
        self.known[name] = type_
        return name

    def new_name(self) -> str:
        """Return a name for a variable: often one that is used already, sometimes a constant's."""
        taken = [*self.known, "MOST", "x", "y", "z", "w"]
        return self.random.choice([name for name in taken if name not in self.bound])

    # Expressions -----------------------------------------------------------------------------

    def of(self, type_: Type, depth: int) -> str:
        """Write an expression of a type."""
        if depth <= 0 or self.chance(0.15):
            return self.leaf(type_)
        general = [self._conditional, self._looked_up, self._narrowed, self._item]
        makers: dict[str, Callable[[Type, int], str]] = {
            "bool": self._bool,
            "int": self._int,
            "opt": self._opt,
            "set": self._set,
            "map": self._map,
            "tuple": self._tuple,
            **{str(record[0]): self._record for record in RECORDS},
        }
        maker = makers.get(str(type_[0]))
        if maker is None or self.chance(0.2):
            return self.random.choice(general)(type_, depth - 1)
        return maker(type_, depth - 1)

    def leaf(self, type_: Type) -> str:
        """Write the shortest expression of a type."""
        if type_ == BOOL and self.chance(0.3):
            return self.random.choice(("True", "False"))
        if type_ == INT and self.chance(0.5):
            return self.random.choice(("0", "1", "2", "3", "-1", "MOST" if "MOST" not in self.known else "5"))
        if type_ == FLAG and self.chance(0.5):
            return self.random.choice(("Flag.RED", "Flag.GREEN", "Flag.WHITE"))
        if type_[0] == "opt" and self.chance(0.3):
            return "None"
        if type_[0] == "map" and self.chance(0.15):
            return "{}"
        if type_[0] == "set" and self.chance(0.2):
            return "BRIGHT" if type_ == set_of(FLAG) and self.chance(0.5) else "frozenset()"
        return self.variable(type_)

    def _conditional(self, type_: Type, depth: int) -> str:
        return f"({self.of(type_, depth)} if {self.of(BOOL, depth)} else {self.of(type_, depth)})"

    def _looked_up(self, type_: Type, depth: int) -> str:
        maps = [each for each in TYPES if each[0] == "map" and inner(each, 2) == type_]
        if not maps:
            return self._narrowed(type_, depth)
        whole = self.random.choice(maps)
        table = self.of(whole, depth - 1) if self.chance(0.4) else self.variable(whole)
        key = self.of(inner(whole), depth - 1)
        kind = self.random.random()
        if kind < 0.1:
            return f"{table}[{key}]"
        if kind < 0.5:
            return f"({table}[{key}] if {key} in {table} else {self.of(type_, depth)})"
        return f"{table}.get({key}, {self.of(type_, depth)})"

    def _narrowed(self, type_: Type, depth: int) -> str:
        if opt(type_) not in TYPES:
            return self.leaf(type_)
        names = [name for name, known in self.known.items() if known == opt(type_)]
        if not names:
            return self._conditional(type_, depth)
        name = self.random.choice(names)
        with self.knowing(**{name: type_}):
            found = self.of(type_, depth)
        if self.chance(0.5):
            return f"({found} if {name} is not None else {self.of(type_, depth)})"
        return f"({self.of(type_, depth)} if {name} is None else {found})"

    def _item(self, type_: Type, depth: int) -> str:
        wholes = [each for each in TYPES if each[0] == "tuple" and type_ in parts(each)]
        if not wholes:
            return self._looked_up(type_, depth)
        whole = self.random.choice(wholes)
        return f"{self.of(whole, depth)}[{parts(whole).index(type_)}]"

    # Truths ----------------------------------------------------------------------------------

    def _bool(self, type_: Type, depth: int) -> str:
        makers = (
            *(self._logic, self._logic, self._guarded, self._equality, self._order, self._membership),
            *(self._none, self._identity, self._loop, self._loop, self._call, self._inclusion),
        )
        return self.random.choice(makers)(depth)

    def _logic(self, depth: int) -> str:
        if self.chance(0.2):
            return f"(not {self.of(BOOL, depth)})"
        word = self.random.choice((" and ", " or "))
        return f"({word.join(self.of(BOOL, depth) for _ in range(self.random.choice((2, 2, 3))))})"

    def _guarded(self, depth: int) -> str:
        names = [name for name, known in self.known.items() if known[0] == "opt"]
        if not names:
            return self._membership(depth)
        name = self.random.choice(names)
        with self.knowing(**{name: inner(self.known[name])}):
            found = self.of(BOOL, depth)
        return f"({name} is not None and {found})" if self.chance(0.5) else f"({name} is None or {found})"

    def _equality(self, depth: int) -> str:
        type_ = self.random.choice(TYPES)
        sign = self.random.choice(("==", "!="))
        left, right = self.of(type_, depth), self.of(type_, depth)
        if type_[0] != "opt" and opt(type_) in TYPES and self.chance(0.3):
            right = self.of(opt(type_), depth)
        more = f" {self.random.choice(('==', '!='))} {self.of(type_, depth - 1)}" if self.chance(0.15) else ""
        return f"({left} {sign} {right}{more})"

    def _order(self, depth: int) -> str:
        type_ = self.random.choice((INT, INT, TIDE))
        text = self.of(type_, depth)
        for _ in range(self.random.choice((1, 1, 2, 3))):
            text += f" {self.random.choice(('<', '<=', '>', '>=', '==', '!='))} {self.of(type_, depth - 1)}"
        return f"({text})"

    def _membership(self, depth: int) -> str:
        key = self.random.choice(KEYS)
        item = self.of(opt(key) if opt(key) in TYPES and self.chance(0.3) else key, depth)
        sign = self.random.choice(("in", "not in"))
        kind = self.random.random()
        if kind < 0.2:
            return f"({self.of(INT, depth)} {sign} {{{self.of(INT, depth)}, {self.of(INT, depth)}}})"
        if kind < 0.4:
            return f"({item} {sign} ({self.of(key, depth)}, {self.of(key, depth)}))"
        maps = [each for each in TYPES if each[0] == "map" and inner(each) == key]
        if kind < 0.6 and maps:
            return f"({item} {sign} {self.of(self.random.choice(maps), depth)})"
        return f"({item} {sign} {self.of(set_of(key), depth)})"

    def _none(self, depth: int) -> str:
        type_ = self.random.choice([each for each in TYPES if each[0] == "opt"])
        return f"({self.of(type_, depth)} is {self.random.choice(('', 'not '))}None)"

    def _identity(self, depth: int) -> str:
        return (
            f"({self.of(FLAG, depth)} is {self.random.choice(('', 'not '))}Flag.{self.random.choice(('RED', 'GREEN'))})"
        )

    def _inclusion(self, depth: int) -> str:
        type_ = set_of(self.random.choice(KEYS))
        return f"({self.of(type_, depth)} {self.random.choice(('<=', '>='))} {self.of(type_, depth)})"

    def _call(self, depth: int) -> str:
        one, other = self.of(INT, depth), self.of(INT, depth)
        forms = (f"{one}", f"{one}, {other}", f"other={one}, one={other}", f"{one}, strict={self.of(BOOL, depth)}")
        return f"falls({self.random.choice(forms)})"

    def _loop(self, depth: int) -> str:
        with self.clauses(depth) as text:
            return f"{self.random.choice(('any', 'all'))}({self.of(BOOL, depth)} {text})"

    # Loops -----------------------------------------------------------------------------------

    @contextmanager
    def clauses(self, depth: int) -> Iterator[str]:
        """Write ``for`` and ``if``; within, their variables are known."""
        before, bound = dict(self.known), len(self.bound)
        fresh = len(self.parameters)
        texts = [self._clause(depth, index) for index in range(self.random.choice((1, 1, 1, 2)))]
        try:
            yield " ".join(texts)
        finally:
            added = {name: self.parameters[name] for name in list(self.parameters)[fresh:]}
            self.known = {**before, **{name: type_ for name, type_ in added.items() if name not in before}}
            del self.bound[bound:]

    def _clause(self, depth: int, index: int) -> str:
        key = self.random.choice(KEYS)
        maps = [each for each in TYPES if each[0] == "map" and inner(each) == key]
        kind = self.random.random()
        if kind < 0.35 and maps:
            whole = self.random.choice(maps)
            ranged = self.of(whole, depth - 1)
            if self.chance(0.5):
                targets = [self._bind(index), self._bind(index)]
                types = [key, inner(whole, 2)]
                text = f"for {targets[0]}, {targets[1]} in {ranged}.items()"
            elif self.chance(0.5):
                targets, types = [self._bind(index)], [inner(whole, 2)]
                text = f"for {targets[0]} in {ranged}.values()"
            else:
                targets, types = [self._bind(index)], [key]
                text = f"for {targets[0]} in {ranged}{self.random.choice(('', '.keys()'))}"
        elif kind < 0.5:
            ranged = f"({self.of(key, depth)}, {self.of(key, depth)})"
            targets, types = [self._bind(index)], [key]
            text = f"for {targets[0]} in {ranged}"
        else:
            ranged = self.of(set_of(key), depth)
            if key == PAIR and self.chance(0.6):
                targets, types = [self._bind(index), self._bind(index)], parts(PAIR)
                text = f"for {targets[0]}, {targets[1]} in {ranged}"
            else:
                targets, types = [self._bind(index)], [key]
                text = f"for {targets[0]} in {ranged}"
        own = dict(zip(targets, types, strict=True))
        self.known = {**self.known, **own}
        for _ in range(self.random.choice((0, 0, 1, 2))):
            text += f" if {self.of(BOOL, depth - 1)}"
        return text

    def _bind(self, index: int = 0) -> str:
        """Return a loop variable's name: in a later clause a new one, since ranges before it would mean that."""
        name = f"v{len(self.bound)}" if index else self.new_name()
        self.bound.append(name)
        return name

    # Values ----------------------------------------------------------------------------------

    def _int(self, type_: Type, depth: int) -> str:
        left, right = self.of(INT, depth), self.of(INT, depth)
        kind = self.random.random()
        if kind < 0.5:
            return f"({left} {self.random.choice('+-*')} {right})"
        if kind < 0.6:
            return f"(-{left})"
        sign = self.random.choice(("//", "%"))
        if kind < 0.65:
            return f"({left} {sign} {right})"
        if kind < 0.8:
            return f"({left} {sign} {self.random.choice(('2', '3', '-2', '-3'))})"
        return f"({left} {sign} {right} if {right} != 0 else {self.of(INT, depth)})"

    def _opt(self, type_: Type, depth: int) -> str:
        if type_ == opt(FLAG) and self.chance(0.3):
            return f"marked({self.of(map_of(BERTH, FLAG), depth)}, {self.of(BERTH, depth)})"
        maps = [each for each in TYPES if each[0] == "map" and inner(each, 2) in (type_, inner(type_))]
        if maps and self.chance(0.4):
            whole = self.random.choice(maps)
            return f"{self.of(whole, depth - 1)}.get({self.of(inner(whole), depth)})"
        return self._conditional(type_, depth) if self.chance(0.5) else self.of(inner(type_), depth)

    def _tuple(self, type_: Type, depth: int) -> str:
        return f"({', '.join(self.of(part, depth) for part in parts(type_))})"

    def _record(self, type_: Type, depth: int) -> str:
        fields = FIELDS[type_]
        if self.chance(0.5):
            changed = self.random.sample(list(fields), self.random.choice((1, 1, 2)))
            changes = ", ".join(f"{name}={self.of(fields[name], depth)}" for name in changed)
            return f"replace({self.of(type_, depth - 1)}, {changes})"
        by_place = self.random.randint(0, len(fields))
        names = list(fields)
        late = names[by_place:]
        self.random.shuffle(late)
        given = [self.of(fields[name], depth - 1) for name in names[:by_place]]
        given += [
            f"{name}={self.of(fields[name], depth - 1)}"
            for name in late
            if name not in DEFAULTS.get(type_, ()) or self.chance(0.5)
        ]
        return f"{type_[0]}({', '.join(given)})"

    def _set(self, type_: Type, depth: int) -> str:
        key = inner(type_)
        kind = self.random.random()
        if self.chance(0.15):
            return self._or_empty(type_, depth, "frozenset()")
        if kind < 0.25:
            return f"{{{', '.join(self.of(key, depth) for _ in range(self.random.choice((1, 2, 3))))}}}"
        if kind < 0.5:
            return f"({self.of(type_, depth)} {self.random.choice('|&-')} {self.of(type_, depth)})"
        if kind < 0.6:
            maps = [each for each in TYPES if each[0] == "map" and inner(each) == key]
            return f"frozenset({self.of(self.random.choice(maps), depth) if maps else self.of(type_, depth)})"
        with self.clauses(depth) as text:
            found = f"{self.of(key, depth)} {text}"
        return f"frozenset({found})" if self.chance(0.5) else f"{{{found}}}"

    def _or_empty(self, type_: Type, depth: int, empty: str) -> str:
        """Look up a set or a map in a map, empty where there is none."""
        maps = [each for each in TYPES if each[0] == "map" and inner(each, 2) == type_]
        if not maps:
            return self.leaf(type_)
        whole = self.random.choice(maps)
        return f"{self.of(whole, depth + 1)}.get({self.of(inner(whole), 0)}, {empty})"

    def _map(self, type_: Type, depth: int) -> str:
        key, value = inner(type_), inner(type_, 2)
        kind = self.random.random()
        if self.chance(0.15):
            return self._or_empty(type_, depth, "{}")
        if kind < 0.2:
            entries = (f"{self.of(key, depth)}: {self.of(value, depth)}" for _ in range(self.random.choice((1, 2))))
            return f"{{{', '.join(entries)}}}"
        if kind < 0.35:
            return f"({self.of(type_, depth)} | {self.of(type_, depth)})"
        if kind < 0.55:
            rows = [f"{self.of(key, depth)}: {self.of(value, depth)}", f"**{self.of(type_, depth)}"]
            self.random.shuffle(rows)
            return f"{{{', '.join(rows)}}}"
        return self._entries(type_, depth)

    def _entries(self, type_: Type, depth: int) -> str:
        """Write a comprehension: its key is its variable, or of a listed tuple anything."""
        key, value = inner(type_), inner(type_, 2)
        before, bound, fresh = dict(self.known), len(self.bound), len(self.parameters)
        kind = self.random.random()
        if kind < 0.25:
            listed = f"({self.of(key, depth)}, {self.of(key, depth)}, {self.of(key, depth)})"
            name = self._bind()
            ranged, names, types = listed, [name], [key]
        elif kind < 0.6:
            table = self.of(type_, depth)
            names, types = [self._bind(), self._bind()], [key, value]
            ranged = f"{table}.items()"
        else:
            ranged = self.of(set_of(key), depth)
            names = [self._bind(), self._bind()] if key == PAIR else [self._bind()]
            types = parts(PAIR) if key == PAIR else [key]
        self.known = {**self.known, **dict(zip(names, types, strict=True))}
        given = f"({names[0]}, {names[1]})" if types == parts(PAIR) else names[0]
        found = self.of(value, depth)
        test = f" if {self.of(BOOL, depth - 1)}" if self.chance(0.5) else ""
        added = {name: self.parameters[name] for name in list(self.parameters)[fresh:]}
        self.known = {**before, **{name: of for name, of in added.items() if name not in before}}
        del self.bound[bound:]
        return f"{{{given}: {found} for {', '.join(names)} in {ranged}{test}}}"

    # Statements ------------------------------------------------------------------------------

    def body(self, result: Type, lines: int, depth: int, indent: str) -> list[str]:
        """Write statements that end in a return on every path."""
        found: list[str] = []
        for _ in range(lines):
            found += self._statement(result, depth, indent)
        return [*found, f"{indent}return {self.of(result, depth)}"]

    def _statement(self, result: Type, depth: int, indent: str) -> list[str]:
        kind = self.random.random()
        options = [name for name, known in self.known.items() if known[0] == "opt"]
        if kind < 0.3:
            return [self._assignment(depth, indent)]
        if kind < 0.4 and options:
            name = self.random.choice(options)
            lines = [f"{indent}if {name} is None:", f"{indent}    return {self.of(result, depth - 1)}"]
            self.known[name] = inner(self.known[name])
            return lines
        if kind < 0.6:
            return [f"{indent}if {self.of(BOOL, depth)}:", f"{indent}    return {self.of(result, depth - 1)}"]
        if kind < 0.64:
            return [f"{indent}assert {self.of(BOOL, depth)}"]
        return self._branches(result, depth, indent)

    def _assignment(self, depth: int, indent: str, type_: Type | None = None, name: str = "") -> str:
        kind = self.random.random()
        if kind < 0.2 and type_ is None:
            whole: Type = self.random.choice((PAIR, ("tuple", INT, opt(FLAG))))
            value = self.of(whole, depth)
            names = [self._target(part) for part in parts(whole)]
            return f"{indent}{names[0]}, {names[1]} = {value}"
        type_ = type_ or self.random.choice(TYPES)
        value, name = self.of(type_, depth), name or self._target(type_)
        self.known[name] = type_
        return f"{indent}{name}: {annotation(type_)} = {value}" if kind < 0.3 else f"{indent}{name} = {value}"

    def _target(self, type_: Type) -> str:
        """Return a local's name, which keeps its type; never ``MOST``, which would be local everywhere."""
        names = [name for name, of in self.declared.items() if of in (type_, opt(type_))]
        names += [f"{letter}{len(self.declared)}" for letter in "xyz"]
        name = self.random.choice(names)
        self.declared.setdefault(name, type_)
        self.known[name] = type_
        return name

    def _branches(self, result: Type, depth: int, indent: str) -> list[str]:
        type_ = result if self.chance(0.5) else self.random.choice(TYPES)
        name = self._target(type_)
        del self.known[name]
        before = dict(self.known)
        arms, ends = [], []
        for head in self.random.choice((("if", "elif", "else"), ("if", "elif"), ("if", "else"), ("if", "else"))):
            self.known = {**before, **{name: of for name, of in self.parameters.items() if name not in before}}
            test = "" if head == "else" else f" {self.of(BOOL, depth - 1)}"
            arm = [f"{indent}{head}{test}:"]
            if self.chance(0.4):
                arm.append(self._assignment(depth - 1, f"{indent}    "))
            if self.chance(0.9):
                arm.append(self._assignment(depth - 1, f"{indent}    ", type_, name))
            if len(arm) == 1:
                arm.append(self._assignment(depth - 1, f"{indent}    "))
            if self.chance(0.2):
                arm.append(f"{indent}    return {self.of(result, depth - 1)}")
            else:
                ends.append(dict(self.known))
            arms += arm
            if head == "else":
                break
        if not arms[-1].strip().startswith("else") and not any(line.startswith(f"{indent}else") for line in arms):
            ends.append(before)
        ends = ends or [before]
        fresh = {name: of for name, of in self.parameters.items() if name not in before}
        self.known = {
            name: of for name, of in ends[0].items() if all(end.get(name, fresh.get(name)) == of for end in ends)
        }
        return arms


def function(random: Random, name: str) -> str:
    """Write a function."""
    writer = Writer(random, depth=random.choice((2, 3, 3, 4)))
    result = random.choice((BOOL, BOOL, BOOL, *TYPES))
    for _ in range(random.choice((1, 2, 3))):
        writer.variable(random.choice(TYPES))
    lines = writer.body(result, random.choice((0, 1, 1, 2, 3)), writer.depth, "    ")
    signature = ", ".join(f"{each}: {annotation(of)}" for each, of in writer.parameters.items())
    return "\n".join([f"def {name}({signature}) -> {annotation(result)}:", *lines, ""])
