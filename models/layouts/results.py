"""What importing and checking a layout give back: the layout, and what was found in it.

Two kinds of fault are told apart.  :class:`BadInput` ends the work: the file cannot be read as
a layout at all (exit code 2).  A :class:`Violation` is a finding about a layout that could be
read (exit code 1); all of them are reported, never only the first.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

from kernel.layout import Layout, TagRecords
from kernel.names import Block, Point, Route, Tag
from models.ground import Ground
from models.layouts.measures import CLEARANCE_MM
from models.layouts.told import Told
from models.layouts.track import Station

Verdict = Literal["holds", "does not hold"]


class BadInput(Exception):
    """The input cannot be read as a layout: which file, where in it, what is wrong, what to do."""

    def __init__(self, file: str, place: str, what: str, what_to_do: str) -> None:
        self.file = one_line(file)
        self.place = one_line(place)
        self.what = one_line(what)
        self.what_to_do = one_line(what_to_do)
        super().__init__(f"{self.file}: {self.place}: {self.what}; {self.what_to_do}")


def one_line(text: str, limit: int = 400) -> str:
    """The text on one line of printable characters, cut at ``limit`` characters."""
    flat = "".join(char if char.isprintable() else " " for char in text)
    return flat if len(flat) <= limit else flat[: limit - 1] + "…"


@dataclass(frozen=True)
class Violation:
    """One way in which a layout fails: the axiom or import rule, the file's elements, a sentence."""

    axiom: str
    elements: tuple[str, ...]
    text: str


@dataclass(frozen=True)
class Remark:
    """Something worth telling that makes no layout wrong; ``rests``: a verdict rests on it, and as what."""

    elements: tuple[str, ...]
    text: str
    rests: RestKind | None = None


RestKind = Literal[
    "authority", "clearance", "start", "loop", "joint", "end", "position", "derived", "unread", "left out"
]
"""What a verdict can rest on that no axiom says: :mod:`models.layouts.rests` has each in words."""


@dataclass(frozen=True)
class Rest:
    """One kind of thing that a verdict rests on, instance by instance with the file's elements.

    ``declared``: the file says so itself; otherwise it is what was taken where the file says nothing.
    """

    kind: RestKind
    declared: bool
    instances: tuple[tuple[str, ...], ...]
    text: str


@dataclass(frozen=True)
class Leg:
    """A leg of a point or crossing on which a train may stand beside another one that runs over it.

    ``boundary``: the nearest behind which a train stands that keeps nobody off the point, and ``at_mm`` from it;
    none where there is no such.  ``clear_mm``: from the point to where the leg is clear of the other, as far as told.
    ``passed``: the boundaries nearer than that one, by distance, each with the block behind it: the point's own block
    or one that this fouls.
    """

    point: str
    leg: str
    boundary: str | None
    at_mm: int
    clear_mm: int | None
    passed: tuple[tuple[int, str, Block], ...] = ()


@dataclass(frozen=True)
class Loop:
    """The shortest way on which a train comes back to its rear, or foul of it, that no point bars.

    ``blocks``: those that the rear stands in, all if there are several of one length.  Without one it was looked for
    up to ``long_mm``, and not found.  ``not_told``: the points and legs between which it leads of which no clearance is
    told, so that the usual one was taken.
    """

    long_mm: int
    blocks: tuple[Block, ...]
    not_told: tuple[tuple[str, str], ...] = ()


Span = tuple[str, int, int]
"""A stretch of one track: its name, from and to in mm."""


@dataclass(frozen=True)
class Places:
    """Where everything in a layout came from: ids of the input file, and the track of each block.

    ``spans`` is empty for a format that has no track (an interlocking table).
    """

    blocks: Mapping[Block, tuple[str, ...]]
    routes: Mapping[Route, tuple[str, ...]]
    points: Mapping[Point, tuple[str, ...]]
    tags: Mapping[Tag, tuple[str, ...]]
    spans: Mapping[Block, tuple[Span, ...]] = field(default_factory=dict)


BesidePath = Literal["trap", "spare"]
"""What a point beside the path is to a route: a trap opens a way onto the path in another position, a spare one not."""


@dataclass(frozen=True)
class Imported:
    """A layout file, read: what the kernel is told, how the track is, and what was noticed.

    ``kind`` names the format; ``station`` is the track graph for formats that have one;
    ``told``: what the file tells beside it.  ``beside``: for a route, the points beside its path in its blocks.
    ``legs``: those of points and crossings, with their clearance.  ``loop``: the shortest that no point bars, if any.
    ``sha256``: of the text that was read, in UTF-8, so that a record says which layout it is of.
    """

    name: str
    kind: str
    layout: Layout
    ground: Ground
    records: TagRecords
    places: Places
    remarks: tuple[Remark, ...]
    violations: tuple[Violation, ...]
    station: Station | None = None
    told: Told | None = None
    beside: Mapping[Route, Mapping[Point, BesidePath]] = field(default_factory=dict)
    legs: tuple[Leg, ...] = ()
    loop: Loop | None = None
    sha256: str = field(default="", compare=False)

    @property
    def longest_route(self) -> Route | None:
        """The route that claims most blocks, of these the first by name; none if every route was left out."""
        claims = self.layout.claims
        return min(self.layout.routes, key=lambda route: (-len(claims[route]), route), default=None)


@dataclass(frozen=True)
class CheckResult:
    """The verdict on one layout; ``checked`` counts the instances of each axiom that were evaluated.

    ``rests``: what it rests on beside the axioms.  ``clearance_mm``: what a leg must have where no clearance is told.
    ``strict``: nothing may rest on what the file does not say.
    """

    name: str
    verdict: Verdict
    violations: tuple[Violation, ...]
    remarks: tuple[Remark, ...]
    checked: Mapping[str, int]
    rests: tuple[Rest, ...] = ()
    clearance_mm: int = CLEARANCE_MM
    strict: bool = False

    @property
    def defaults(self) -> int:
        """On how many things the verdict rests that the file does not say."""
        return sum(len(rest.instances) for rest in self.rests if not rest.declared)

    @property
    def exit_code(self) -> int:
        """0 if the layout lies inside the proof's assumptions, 1 if not."""
        return 0 if self.verdict == "holds" else 1
