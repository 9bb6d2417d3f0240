"""Following a route along the track: from its entry, in a direction, over points, to its exit."""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import NoReturn

from kernel.names import Block, Point, Position
from models.layouts.blocks import Blocks, opposite
from models.layouts.findings import Findings
from models.layouts.results import BadInput
from models.layouts.told import Wanted
from models.layouts.track import Cut, Heading, Joint, Stop


@dataclass
class Path:
    """A route as followed.

    ``crossed``: the detectors passed, each with the block before and behind it and the heading
    behind it, from the entry to the last before the exit; ``beyond`` the same for the overlap, from
    the exit on, ``overlap_mm`` long.  ``points``: for each block, the points passed in it and their positions.
    """

    wanted: Wanted
    blocks: list[Block]
    crossed: list[tuple[str, Heading]] = field(default_factory=list)
    beyond: list[tuple[str, Heading]] = field(default_factory=list)
    overlap: list[Block] = field(default_factory=list)
    overlap_mm: int = 0
    points: dict[Block, dict[Point, Position]] = field(default_factory=dict)
    junctions: set[str] = field(default_factory=set)
    entered: Heading = (0, 0)
    from_stop: bool = False


class Follower:
    """Follows the routes of one file and collects what is wrong with them."""

    def __init__(self, blocks: Blocks, file: str, findings: Findings) -> None:
        self.blocks = blocks
        self.file = file
        self.findings = findings

    def follow(self, wanted: Wanted) -> Path | None:
        """The path of a route; none, with a violation noted, where its point positions are wrong.

        :raises BadInput: the route runs in a circle or never reaches its exit.
        """
        away = self.blocks.segments.beside[wanted.entry]
        if wanted.side not in away:
            what = f"route '{wanted.name}' leaves the track at its entry '{wanted.entry}'"
            raise BadInput(self.file, wanted.place, what, "turn the direction of the route round")
        heading = away[wanted.side]
        path = Path(wanted, [self.blocks.of[heading[0]]], entered=heading)
        behind = self.blocks.segments.at[opposite(heading)]
        path.from_stop = isinstance(behind, Stop)
        if isinstance(behind, Cut):
            path.crossed.append((wanted.entry, heading))
            path.blocks.insert(0, self.blocks.of[behind.beyond[0]])
        last = self._run(path, heading, wanted.exit, path.blocks, path.crossed, set())
        if last is None:
            return None
        if wanted.overlap is not None and not self._run_overlap(path, last):
            return None
        return path

    def _run_overlap(self, path: Path, last: Heading) -> bool:
        """Follow on behind the exit to the end of the overlap."""
        end = self.blocks.segments.at[last]
        if not isinstance(end, Cut):
            what = f"route '{path.wanted.name}' has an overlap but ends at buffer stop '{path.wanted.exit}'"
            raise BadInput(self.file, path.wanted.place, what, "take the overlap away")
        path.beyond.append((path.wanted.exit, end.beyond))
        path.overlap.append(self.blocks.of[end.beyond[0]])
        over: set[int] = set()
        last_in = self._run(path, end.beyond, str(path.wanted.overlap), path.overlap, path.beyond, over)
        segments = self.blocks.segments.segments
        path.overlap_mm = sum(segments[index].long_mm for index in over)
        return last_in is not None

    def _run(
        self,
        path: Path,
        heading: Heading,
        goal: str,
        into: list[Block],
        crossed: list[tuple[str, Heading]],
        seen: set[int],
    ) -> Heading | None:
        """Run on to ``goal``, noting blocks, detectors and segments; the heading at it, or none after a violation."""
        start = heading
        while True:
            if heading[0] in seen:
                track = self.blocks.segments.segments[heading[0]].track
                self._lost(path, goal, f"it runs in a loop and comes to track '{track}' twice")
            seen.add(heading[0])
            end = self.blocks.segments.at[heading]
            if isinstance(end, Joint):
                onward = self._over(path, end, into[-1])
                if onward is None and not self._reaches(start, goal):
                    self.findings.violations.pop()
                    self._lost(path, goal, "track does not lead there, however the points lie")
                if onward is None:
                    return None
                heading = onward
                continue
            if end.mark == goal:
                return heading
            if isinstance(end, Stop):
                where = f"at '{end.mark}'" if end.mark else "where track ends"
                track = self.blocks.segments.segments[heading[0]].track
                self._lost(path, goal, f"it ends {where} on track '{track}'")
            assert isinstance(end, Cut)
            heading = end.beyond
            crossed.append((end.mark, heading))
            into.append(self.blocks.of[heading[0]])

    def _reaches(self, start: Heading, goal: str) -> bool:
        """Whether some position of the points leads to a mark."""
        met, todo = {start}, deque([start])
        while todo:
            end = self.blocks.segments.at[todo.popleft()]
            if not isinstance(end, Joint) and end.mark == goal:
                return True
            onward = [end.beyond] if isinstance(end, Cut) else []
            if isinstance(end, Joint):
                onward = [heading for _, _, heading in self.blocks.segments.onward(end)]
            todo += [heading for heading in onward if heading not in met]
            met.update(onward)
        return False

    def _lost(self, path: Path, goal: str, why: str) -> NoReturn:
        """The exit is never reached: the file contradicts itself.

        A position that is closed or missing is a violation only where another would lead to the exit.
        """
        passed = _listed({point: at for points in path.points.values() for point, at in points.items()})
        over = f" over {self.findings.point_word} {passed}" if passed else ""
        what = f"route '{path.wanted.name}'{over} never reaches '{goal}': {why}"
        raise BadInput(self.file, path.wanted.place, what, "correct its point positions, direction or exit")

    def _over(self, path: Path, joint: Joint, block: Block) -> Heading | None:
        """The heading behind a junction, by the position the route gives for it."""
        junction = self.blocks.segments.station.junctions[joint.junction]
        position = path.wanted.positions.get(joint.junction)
        ways = self.blocks.segments.onward(joint)
        path.junctions.add(joint.junction)
        if position is None and junction.is_point:
            self._misled(path, joint.junction, "passes it but gives no position for it")
            return None
        if position is not None and position not in junction.kind.positions:
            known = ", ".join(sorted(junction.kind.positions))
            self._wrong(path, joint.junction, f"wants it in '{position}', which it has not (it has {known})", {})
            return None
        led = [onward for _, positions, onward in ways if position is None or position in positions]
        if not led:
            self._misled(path, joint.junction, f"arrives at its port {joint.port}, closed by '{position}'")
            return None
        assert len(led) == 1, "a position joins a port to one other"
        if junction.is_point:
            assert position is not None
            self._pass(path, Point(joint.junction), Position(position), block)
        return led[0]

    def _pass(self, path: Path, point: Point, position: Position, block: Block) -> None:
        path.points.setdefault(block, {})[point] = position

    def _misled(self, path: Path, junction: str, text: str) -> None:
        """A route comes to a point that does not lead it on; the fault may lie with one that it passed before.

        It lies with those of which another position alone leads the route to its end; all if there are none such.
        """
        passed = {point: at for points in path.points.values() for point, at in points.items()}
        mending = [point for point in {**passed, Point(junction): None} if self._mends(path.wanted, point)]
        self._wrong(path, junction, text, {p: at for p, at in passed.items() if p in mending or not mending})

    def _wrong(self, path: Path, junction: str, text: str, doubted: Mapping[Point, Position]) -> None:
        """Note a wrong position, and those passed before that may be wrong in its stead."""
        name, before = path.wanted.name, [point for point in doubted if point != junction]
        over = f", having passed {_listed({p: doubted[p] for p in before})}" if before else ""
        full = f"{self.findings.point_word} '{junction}': route '{name}' {text}{over}"
        self.findings.violation("a route is led over its points", (name, junction, *before), full)

    def _mends(self, wanted: Wanted, point: str) -> bool:
        """Whether a route, which does not come to its end as its points lie, does if one of them lies otherwise."""
        positions = self.blocks.segments.station.junctions[point].kind.positions
        return any(self._arrives(wanted, {**wanted.positions, point: at}) for at in positions)

    def _arrives(self, wanted: Wanted, positions: Mapping[str, str]) -> bool:
        """Whether a route comes to its end over points in these positions."""
        at = self.blocks.segments.at
        goals = [wanted.exit, *([wanted.overlap] if wanted.overlap is not None else [])]
        heading: Heading | None = self.blocks.segments.beside[wanted.entry][wanted.side]
        seen: set[Heading] = set()
        while heading is not None and heading not in seen:
            seen.add(heading)
            end = at[heading]
            if not isinstance(end, Joint) and end.mark == goals[0]:
                seen.clear()
                del goals[0]
                if not goals:
                    return True
            heading = end.beyond if isinstance(end, Cut) else None
            if isinstance(end, Joint):
                heading = self._onward(end, positions)
        return False

    def _onward(self, joint: Joint, positions: Mapping[str, str]) -> Heading | None:
        """The heading behind a junction in these positions; none where it is closed or no position is given."""
        is_point = self.blocks.segments.station.junctions[joint.junction].is_point
        given = None if not is_point else positions.get(joint.junction, "")
        led = [onward for _, lies, onward in self.blocks.segments.onward(joint) if given is None or given in lies]
        return led[0] if led else None


def _listed(passed: Mapping[Point, Position]) -> str:
    return ", ".join(f"'{point}' {position}" for point, position in passed.items())
