"""What machines say by telegram, as kind and payload; numbers stand for the names of the layout that both ends have.

One table: the fields of each kind, in their order, and the set of the abstract radio in which a message stands once
it was sent.  There is one way to write a message, and nothing written otherwise is read (T11).  A number does not say
what it stood for where it was written: that both ends have the same names, the key of their link sees to
(``models.simulation.links``).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence, Set
from typing import Any, NamedTuple

from kernel.machine.centre import NO_ROUTE
from kernel.names import Position, Read, Record, Run, Serial, UnitLife
from kernel.telegram import Said
from models.world.state import Radio, Site

SERIAL_BYTES, SIGNED_BYTES, NUMBER_BYTES, LENGTH_BYTES, TEXT_LENGTH_BYTES = 8, 8, 4, 1, 2


class Kind(NamedTuple):
    """A kind of message: its fields, and the set of the abstract radio that holds those that were sent."""

    fields: tuple[str, ...]
    sent_in: str


LIFE_SIGN, RANGING = "life sign", "ranging"
OF_A_POINT = ("run", "point", "life")
OF_AN_ORDER = ("run", "point", "position", "life")
OF_A_LIST = ("run", "part", "parts", "text")
KINDS: Mapping[str, Kind] = {
    LIFE_SIGN: Kind((), ""),
    RANGING: Kind(("at_ms", "way_mm", "speed_mm_s", "is_coming"), ""),
    "order": Kind(OF_AN_ORDER, "orders"),
    "relayed order": Kind(OF_AN_ORDER, "relayed_orders"),
    "enquiry": Kind(OF_A_POINT, "enquiries"),
    "relayed enquiry": Kind(OF_A_POINT, "relayed_enquiries"),
    "confirmation": Kind(("run", "point", "position"), "confirmed"),
    "relayed confirmation": Kind(("run", "point", "position"), "confirmations"),
    "terminal's life": Kind(("point", "life"), "terminal_lives"),
    "relayed life": Kind(("point", "life"), "terminal_lives"),
    "offer": Kind(OF_A_LIST, "offers"),
    "echo": Kind(OF_A_LIST, "echoes"),
    "permit": Kind(("run",), "permits"),
    "recall": Kind(("run",), "recalls"),
    "return": Kind(("run",), "returns"),
    "tail report": Kind(("run", "block", "left", "entered"), "tail_reports"),
    "stop": Kind(("run",), "stops"),
    "challenge": Kind(("epoch",), "challenges"),
    "standing": Kind(("train", "life", "epoch", "blocks"), "standings"),
    "standing run": Kind(("run",), "standing_runs"),
}
"""By name; a kind's number is its place."""
NAMES = tuple(KINDS)
NUMBER = {name: number for number, name in enumerate(NAMES)}

Fields = Mapping[str, Any]
"""What a message says, by the names that the steps of the world have for it."""


def was_sent(radio: Radio, kind: str, fields: Fields) -> bool:
    """Tell whether a message is among those that the abstract world has sent; where it has no such kind, it is.

    There an order wants the position that its route needs.
    """
    if not KINDS[kind].sent_in:
        return True
    if kind == "standing":
        key = fields["train"], fields["life"], fields["epoch"]
        return bool(radio.standings.get(key) == fields["blocks"])
    sent: Set[Any] = getattr(radio, KINDS[kind].sent_in)
    if KINDS[kind].fields == OF_A_LIST:
        return fields["run"] in sent
    names = KINDS[kind].fields
    said = tuple(fields[name] for name in (OF_A_POINT if names == OF_AN_ORDER else names))
    return (said[0] if len(said) == 1 else said) in sent


class UnreadableError(Exception):
    """A payload that no message is written as."""


class _Reader:
    """A payload, read from its beginning."""

    def __init__(self, payload: bytes) -> None:
        self.payload = payload
        self.at = 0

    def take(self, size: int) -> bytes:
        found = self.payload[self.at : self.at + size]
        self.at += size
        if len(found) != size:
            raise UnreadableError
        return found

    def number(self, size: int = NUMBER_BYTES) -> int:
        return int.from_bytes(self.take(size), "big")

    def text(self) -> bytes:
        return self.take(self.number(TEXT_LENGTH_BYTES))

    def signed(self) -> int:
        return int.from_bytes(self.take(SIGNED_BYTES), "big", signed=True)


class _Names(NamedTuple):
    """Names of one sort and their numbers, in alphabetical order."""

    by_number: Sequence[Any]
    number: Mapping[Any, int]

    def write(self, name: Any) -> bytes:
        return self.number[name].to_bytes(NUMBER_BYTES, "big")

    def read(self, reader: _Reader) -> Any:
        number = reader.number()
        if number >= len(self.by_number):
            raise UnreadableError
        return self.by_number[number]


def _names(found: Iterable[Any]) -> _Names:
    ordered = sorted(found)
    return _Names(ordered, {name: at for at, name in enumerate(ordered)})


class Wording:
    """Messages as bytes and back, by the names of one layout and its fleet."""

    def __init__(self, site: Site) -> None:
        layout = site.layout
        positions = {lies for needs in layout.needs.values() for lies in needs.values()}
        self._trains = _names(layout.fleet)
        self._routes = _names({*layout.routes, NO_ROUTE})
        self._blocks = _names(layout.blocks)
        self._tags = _names(layout.tag_in)
        points, lies = _names(layout.points), _names({*positions, Position("normal")})
        sorts = (self._trains, self._routes, self._blocks, self._tags, points, lies)
        self.numbered = tuple(tuple(names.by_number) for names in sorts)
        """What its numbers stand for, sort by sort."""
        self._ways: Mapping[str, tuple[Callable[[Any], bytes], Callable[[_Reader], Any]]] = {
            "run": (self._write_run, self._read_run),
            "train": (self._trains.write, self._trains.read),
            "point": (points.write, points.read),
            "position": (lies.write, lies.read),
            "block": (self._blocks.write, self._blocks.read),
            "blocks": (self._write_blocks, self._read_blocks),
            "left": (self._write_read, self._read_read),
            "entered": (self._write_read, self._read_read),
            "life": (_write_number, _Reader.number),
            "epoch": (_write_number, _Reader.number),
            "part": (_write_number, _Reader.number),
            "parts": (_write_number, _Reader.number),
            "text": (_write_text, _Reader.text),
            "at_ms": (_write_signed, _Reader.signed),
            "way_mm": (_write_signed, _Reader.signed),
            "speed_mm_s": (_write_signed, _Reader.signed),
            "is_coming": (lambda yes: bytes([yes]), lambda reader: reader.take(1) != b"\0"),
        }

    def written(self, kind: str, fields: Fields) -> Said:
        """Write a message; all of them fit into a payload."""
        payload = b"".join(self._ways[name][0](fields[name]) for name in KINDS[kind].fields)
        return Said(NUMBER[kind], payload)

    def read(self, said: Said) -> tuple[str, Fields] | None:
        """Read a message; None if it is not written as one."""
        if said.kind >= len(NAMES):
            return None
        kind, reader = NAMES[said.kind], _Reader(said.payload)
        try:
            fields = {name: self._ways[name][1](reader) for name in KINDS[kind].fields}
        except UnreadableError:
            return None
        return (kind, fields) if self.written(kind, fields) == said else None

    def _write_run(self, run: Run) -> bytes:
        serial = run.serial.to_bytes(SERIAL_BYTES, "big")
        return serial + self._trains.write(run.train) + _write_number(run.life) + self._routes.write(run.route)

    def _read_run(self, reader: _Reader) -> Run:
        serial, train = Serial(reader.number(SERIAL_BYTES)), self._trains.read(reader)
        return Run(serial, train, UnitLife(reader.number()), self._routes.read(reader))

    def _write_blocks(self, blocks: frozenset[Any]) -> bytes:
        return bytes([len(blocks)]) + b"".join(self._blocks.write(block) for block in sorted(blocks))

    def _read_blocks(self, reader: _Reader) -> frozenset[Any]:
        return frozenset(self._blocks.read(reader) for _ in range(reader.number(LENGTH_BYTES)))

    def _write_read(self, read: Read) -> bytes:
        record = read.record.encode()
        return self._tags.write(read.tag) + bytes([len(record)]) + record

    def _read_read(self, reader: _Reader) -> Read:
        tag, record = self._tags.read(reader), reader.take(reader.number(LENGTH_BYTES))
        try:
            return Read(tag, Record(record.decode()))
        except UnicodeDecodeError as error:
            raise UnreadableError from error


def _write_signed(number: int) -> bytes:
    return number.to_bytes(SIGNED_BYTES, "big", signed=True)


def _write_text(text: bytes) -> bytes:
    return len(text).to_bytes(TEXT_LENGTH_BYTES, "big") + text


def _write_number(number: int) -> bytes:
    return number.to_bytes(NUMBER_BYTES, "big")
