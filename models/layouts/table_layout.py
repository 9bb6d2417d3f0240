"""From the rows of an interlocking table to a :class:`Layout`, as far as its routes tell the track."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Mapping, Sequence, Set
from dataclasses import dataclass
from itertools import groupby, pairwise
from typing import TYPE_CHECKING

from kernel.layout import Layout
from kernel.names import Block, Point, Position, Route, Tag, Train
from kernel.tag_list_text import with_tag_lists
from models.ground import Ground
from models.layouts.findings import Findings
from models.layouts.numbers import number_blocks, records_for
from models.layouts.reading import escaped
from models.layouts.results import Imported, Places
from models.layouts.table_ways import compare_ways, named
from models.layouts.told import Told, Wanted
from models.layouts.track import LOW

if TYPE_CHECKING:
    from models.layouts.table import TableRoute

NEARLY_ALWAYS = 0.8
"""A piece of path belongs to no section if fewer than this share of the routes over either have both."""


def homes(routes: Sequence[TableRoute]) -> tuple[dict[str, str], dict[tuple[str, ...], list[str]]]:
    """The section that each piece of path belongs to, if it does; and the pieces that nothing tells the section of.

    A piece belongs to what comes with it most, which is a section or a point, and the track under a point belongs to
    no section.  Where several sections always come together, their pieces are theirs in running order, and those that
    no other track parts are of one section; where either leaves a choice, the pieces come second in the answer.
    """
    over, through = _listed(routes, lambda route: route.path), _listed(routes, lambda route: route.sections)
    lying = _listed(routes, lambda route: route.points)
    together: dict[tuple[str, ...], list[str]] = defaultdict(list)
    for piece, rows in over.items():
        share = {section: _share(rows, others) for section, others in through.items()}
        best, at_point = max(share.values()), max((_share(rows, others) for others in lying.values()), default=0)
        if best >= NEARLY_ALWAYS and (best == 1 or best > at_point):
            together[tuple(section for section in share if share[section] == best)].append(piece)
    found: dict[str, str] = {}
    unclear: dict[tuple[str, ...], list[str]] = {}
    for sections, pieces in together.items():
        runs = _unparted(pieces, next(route.path for route in routes if pieces[0] in route.path))
        shares = runs if len(runs) >= len(sections) else [[piece] for piece in pieces]
        found |= {piece: sections[min(at, len(sections) - 1)] for at, run in enumerate(shares) for piece in run}
        if 1 < len(sections) < len(shares):
            unclear[sections] = pieces
    return found, unclear


def _unparted(pieces: Iterable[str], path: Sequence[str]) -> list[list[str]]:
    """Pieces in running order, those together that lie side by side on a path."""
    places = [*path, *pieces]
    runs = groupby(enumerate(pieces), key=lambda numbered: places.index(numbered[1]) - numbered[0])
    return [[piece for _, piece in run] for _, run in runs]


def _listed(routes: Iterable[TableRoute], names: Callable[[TableRoute], Iterable[str]]) -> dict[str, set[str]]:
    """The routes that list each name, which come in running order where the same routes do."""
    found: dict[str, set[str]] = defaultdict(set)
    for route in routes:
        for name in names(route):
            found[name].add(route.name)
    return found


def _share(rows: set[str], others: set[str]) -> float:
    """The share of the routes in either that are in both."""
    both = len(rows & others)
    return both / (len(rows) + len(others) - both)


@dataclass
class Row:
    """One route as blocks in order: its start, then what it covers; and the blocks its points stand in."""

    route: TableRoute
    covers: list[Block]
    needs: dict[Point, Position]
    start: Block

    @property
    def chain(self) -> list[Block]:
        """Start and covered blocks in running order."""
        return [self.start, *self.covers]


def assemble_table(
    file: str,
    routes: Sequence[TableRoute],
    home: Mapping[str, str],
    fouls: Mapping[str, frozenset[str]],
    trains: Sequence[str],
    findings: Findings,
) -> Imported:
    """The layout that a table tells of.

    ``home``: the section of each piece of path.  ``fouls``: the sections and pieces that obstruct each other.
    """
    rows = [Row(route, covers, _needs(route), Block("")) for route, covers in _covered(routes, home, findings)]
    _start(rows, findings)
    stands_in = _stand(rows, findings)
    compare_ways(rows, stands_in, findings)
    track = Track(rows)
    layout = _layout(rows, stands_in, track, trains, _fouling(home, fouls))
    places = Places(
        blocks={block: (_element(block),) for block in layout.blocks},
        routes={route: (str(route),) for route in layout.routes},
        points={point: (str(point),) for point in layout.points},
        tags={tag: (_element(block),) for tag, block in layout.tag_in.items()},
    )
    groups = [*layout.claims.values(), *({block, *others} for block, others in track.neighbours.items())]
    turnouts = frozenset(stands_in.values())
    records = records_for(layout.tag_in, number_blocks(layout.blocks, groups), {}, turnouts)
    ground = track.ground(rows, layout)
    remarks, violations = tuple(findings.remarks), tuple(findings.violations)
    stated = tuple(Wanted(r.name, f"route '{r.name}'", r.source, LOW, r.destination, r.points) for r in routes)
    told = Told(file, "interlocking table", tuple(trains), stated)
    return Imported(file, told.kind, layout, ground, records, places, remarks, violations, told=told)


def _element(block: Block) -> str:
    """The element of the file that a block stands for: a section, a piece of path, or a signal."""
    return block.removeprefix("before ")


def _needs(route: TableRoute) -> dict[Point, Position]:
    return {Point(point): Position(position) for point, position in route.points.items()}


def _covered(
    routes: Sequence[TableRoute], home: Mapping[str, str], findings: Findings
) -> Iterable[tuple[TableRoute, list[Block]]]:
    """Each route with its blocks in running order, held against the sections it lists."""
    sections = set(home.values())
    for route in routes:
        run = [block for block, _ in groupby(Block(home.get(piece, piece)) for piece in route.path)]
        for block in sorted(block for block, times in Counter(run).items() if times > 1):
            text = f"route '{route.name}' leaves '{block}' and comes back into it: a train would be in it twice"
            findings.violation("a route passes a block once", (route.name, block), text)
        covers = list(dict.fromkeys(run))
        passed = [block for block in covers if block in sections]
        if passed != list(route.sections):
            text = f"route '{route.name}' lists sections {named(route.sections)} but its path runs over {named(passed)}"
            odd = sorted(set(passed) ^ set(route.sections)) or list(route.sections)
            findings.violation("sections are those of the path", (route.name, *odd), text)
        covers += [Block(section) for section in route.sections if section not in covers]
        yield route, covers


def _start(rows: Sequence[Row], findings: Findings) -> None:
    """Where each route starts: at the end of those that end at its source signal, running the same way.

    Where none ends there, it is the block that routes the other way run into over the same leg of the same point.
    """
    ends: dict[str, dict[str, Counter[Block]]] = defaultdict(lambda: defaultdict(Counter))
    for row in rows:
        ends[row.route.destination][row.route.orientation][row.covers[-1]] += 1
    told: set[str] = set()
    met, sections = _met_by_track(rows), {section for row in rows for section in row.route.sections}
    for row in rows:
        source = row.route.source
        _say_where_signals_stand(row, ends[source], findings)
        found = ends[source].get(row.route.orientation)
        if not found:
            _start_by_track(row, met[source], sections, findings, source not in told)
        else:
            row.start = min(found, key=lambda block: (-found[block], block))
            if len(found) > 1 and source not in told:
                text = f"routes to signal '{source}' end in different sections: {named(sorted(found))}"
                findings.violation("a signal stands at one section", (source, *sorted(found)), text)
        told.add(source)


def _say_where_signals_stand(row: Row, ends: Mapping[str, Iterable[Block]], findings: Findings) -> None:
    """Where routes the other way end at a route's source signal, they end in the block that it begins with."""
    source, first = row.route.source, row.covers[0]
    other = sorted({block for way, blocks in ends.items() if way != row.route.orientation for block in blocks})
    if other and first not in other:
        text = (
            f"route '{row.route.name}' runs {row.route.orientation} from signal '{source}' into '{first}'; routes the "
            f"other way end there in {named(other)}: one of them has the wrong signal, or runs the other way"
        )
        findings.violation("a signal stands at one place", (source, row.route.name, first, *other), text)


def _met_by_track(rows: Sequence[Row]) -> dict[str, set[Block]]:
    """For each source signal, the blocks that other rows have next to the first of its routes' blocks, away from them.

    A row counts if it has the route's second block on the other side, where there is one, and wants the first point of
    the route in the same position: it runs the other way, or the same way and comes from farther back.
    """
    over: dict[Block, list[tuple[Row, Block | None, Block | None]]] = defaultdict(list)
    for row in rows:
        for before, block, onward in zip([None, *row.covers], row.covers, [*row.covers[1:], None], strict=False):
            over[block].append((row, before, onward))
    found: dict[str, set[Block]] = defaultdict(set)
    for row in rows:
        for other, *sides in over[row.covers[0]]:
            beyond, back = sides if other.route.orientation != row.route.orientation else reversed(sides)
            same = all(other.needs.get(point, at) == at for point, at in list(row.needs.items())[:1])
            comes = beyond is None or row.covers[1:2] in ([], [beyond])
            if same and comes and back is not None:
                found[row.route.source] |= {back} - set(row.covers)
    return found


def _start_by_track(row: Row, met: set[Block], sections: Set[str], findings: Findings, tell: bool) -> None:
    """Start a route at whose source no route ends.

    Several blocks that may lie before it, or none where it leaves over points, are a violation: a train there would
    stand in two blocks.  Where a section is the first that it runs over, the table may begin there: a remark.
    """
    source = row.route.source
    row.start = min(met) if met else Block(f"before {source}")
    if not tell:
        return
    if len(met) == 1 or (not met and row.covers[0] in sections):
        where = f"in '{row.start}', which other routes have before them" if met else "in a block of their own"
        findings.remark((source,), f"no route ends at signal '{source}': routes from it start {where}", "derived")
        return
    found = f"{named(sorted(met))} may lie before it" if met else "no route the other way shows what lies before it"
    text = f"no route ends at signal '{source}' and {found}: it is not known where its routes start"
    findings.violation("a route starts in a known block", (source, *sorted(met)), text)


def _stand(rows: Sequence[Row], findings: Findings) -> dict[Point, Block]:
    """The block of each point: the piece of path that belongs to no section, by its place in the order.

    Points and pieces both stand in running order in the table, and most routes decide.  Of a point that no row tells
    so, all the points of a row with one such piece stand there; where no piece is ahead, it is on nobody's path.
    """
    sections = {section for row in rows for section in row.route.sections}
    in_order: dict[Point, Counter[Block]] = defaultdict(Counter)
    on_one: dict[Point, Counter[Block]] = defaultdict(Counter)
    for row in rows:
        loose = [block for block in row.covers if block not in sections]
        for point, block in zip(row.needs, loose, strict=False) if len(loose) == len(row.needs) else ():
            in_order[point][block] += 1
        for point in row.needs:
            on_one[point].update(loose if len(loose) == 1 else ())
    stands_in = {point: _ahead(in_order[point] or found) or Block(f"at {point}") for point, found in on_one.items()}
    for block in sorted({block for row in rows for block in row.covers} - set(stands_in.values()) - sections):
        over = [row.route.name for row in rows if block in row.covers]
        text = f"'{block}' belongs to no section, and no point stands there: nothing tells of a train in it"
        findings.violation("track lies in a section or at a point", (block, *over), text)
    for row in rows:
        on_path = {point for point, block in stands_in.items() if block in row.chain}
        for point in sorted(on_path - set(row.needs)):
            text = f"route '{row.route.name}' runs over point '{point}' and gives no position for it"
            findings.violation("a route is led over its points", (row.route.name, point), text)
        for point in sorted(set(row.needs) - on_path):
            text = f"route '{row.route.name}' gives a position for point '{point}', which is not on its path"
            findings.violation("a route's positions are of its points", (row.route.name, point), text)
    return stands_in


def _ahead(votes: Counter[Block]) -> Block | None:
    """The block with more votes than every other."""
    most = [block for block, count in votes.items() if count == max(votes.values())]
    return most[0] if len(most) == 1 else None


def _fouling(home: Mapping[str, str], fouls: Mapping[str, frozenset[str]]) -> dict[Block, frozenset[Block]]:
    """The blocks that foul each other: those of the sections and pieces that do; a piece lies in its section's."""
    found: dict[Block, frozenset[Block]] = {}
    for name, others in fouls.items():
        block = Block(home.get(name, name))
        beside = {Block(home.get(other, other)) for other in others} - {block}
        if beside:
            found[block] = found.get(block, frozenset()) | beside
    return found


def _layout(
    rows: Sequence[Row],
    stands_in: Mapping[Point, Block],
    track: Track,
    trains: Sequence[str],
    fouls: Mapping[Block, frozenset[Block]],
) -> Layout:
    """The relations that the kernel is told; everything is released on arrival."""
    by = {Route(row.route.name): row for row in rows}
    blocks = frozenset(block for row in rows for block in row.chain) | frozenset(stands_in.values())
    tag_in = {tag: block for pair in track.pairs for tag, block in zip(tags(*pair), pair, strict=True)}
    order = {name: [tag for pair in pairwise(row.chain) for tag in tags(*pair)] for name, row in by.items()}
    return with_tag_lists(
        Layout(
            fleet=frozenset(Train(train) for train in trains),
            blocks=blocks,
            routes=frozenset(by),
            points=frozenset(stands_in),
            start={name: row.start for name, row in by.items()},
            destination={name: row.covers[-1] for name, row in by.items()},
            covers={name: frozenset(row.covers) for name, row in by.items()},
            overlap={name: frozenset() for name in by},
            claims={name: frozenset(row.chain) for name, row in by.items()},
            way={name: dict(pairwise(row.chain)) for name, row in by.items()},
            needs={name: row.needs for name, row in by.items()},
            released_with={
                name: {p: stands_in[p] if stands_in[p] in row.chain else row.covers[-1] for p in row.needs}
                for name, row in by.items()
            },
            released_after={name: _released_after(row) for name, row in by.items()},
            fouls=fouls,
            stands_in=stands_in,
            points_in={block: frozenset(p for p in stands_in if stands_in[p] == block) for block in blocks},
            tag_in=tag_in,
            partner={tag: other for pair in track.pairs for tag, other in _both_ways(tags(*pair))},
            first_tag={name: read[0] for name, read in order.items()},
            tag_list={},
            tag_after={name: dict(pairwise(read)) for name, read in order.items()},
        )
    )


def _both_ways(pair: tuple[Tag, Tag]) -> list[tuple[Tag, Tag]]:
    return [pair, (pair[1], pair[0])]


def _released_after(row: Row) -> dict[Block, Block]:
    """All on arrival, before the destination; start and destination alone."""
    last = row.covers[-2] if len(row.covers) > 1 else row.covers[-1]
    return dict.fromkeys(row.covers, last) | {row.start: row.start, row.covers[-1]: row.covers[-1]}


def tags(first: Block, second: Block) -> tuple[Tag, Tag]:
    """The tags at the boundary of two blocks, on the side of the first and of the second."""
    low, high = (escaped(block) for block in sorted((first, second)))
    return Tag(f"{low}|{high}@{first}"), Tag(f"{low}|{high}@{second}")


class Track:
    """The track as far as routes run over it."""

    def __init__(self, rows: Sequence[Row]) -> None:
        self.pairs = sorted({(min(pair), max(pair)) for row in rows for pair in pairwise(row.chain)})
        self.neighbours: dict[Block, frozenset[Block]] = defaultdict(frozenset)
        for first, second in self.pairs:
            self.neighbours[first] |= {second}
            self.neighbours[second] |= {first}
        self.after: dict[tuple[str, Block | None, Block], set[Block]] = defaultdict(set)
        lies: dict[tuple[Block, Block], list[dict[Point, Position]]] = defaultdict(list)
        for row in rows:
            for before, block, behind in zip([None, *row.chain], row.chain, row.chain[1:], strict=False):
                self.after[row.route.orientation, before, block].add(behind)
                self.after[row.route.orientation, None, block].add(behind)
                lies[block, behind].append(row.needs)
        self.lies = lies

    def leads(self, row: Row) -> dict[Block, frozenset[Block]]:
        """For each block with a way on, all that follow it on routes which came the same way."""
        before = [None, *row.chain]
        return {
            block: frozenset(self.after[row.route.orientation, came, block])
            for came, block in zip(before, row.chain[:-1], strict=False)
        }

    def ground(self, rows: Sequence[Row], layout: Layout) -> Ground:
        """What the kernel does not see of the track."""
        opens: dict[Block, dict[Block, dict[Point, Position]]] = defaultdict(dict)
        for (block, behind), needs in self.lies.items():
            standing = [{p: at for p, at in need.items() if layout.stands_in[p] == block} for need in needs]
            opens[block][behind] = dict(set.intersection(*(set(demands.items()) for demands in standing)))
        leads = {
            Route(row.route.name): {
                block: {target: opens[block].get(target, {}) for target in targets}
                for block, targets in self.leads(row).items()
            }
            for row in rows
        }
        turnout = {Route(row.route.name): _turnouts(row, leads[Route(row.route.name)]) for row in rows}
        held: dict[Block, set[Block]] = defaultdict(set)
        for row in rows:
            for target in row.covers:
                for block in self.neighbours[target] - set(row.chain):
                    if target in opens.get(block, {}):
                        held[block].add(target)
        laid = {tag: {other: frozenset({layout.tag_in[tag]})} for tag, other in layout.partner.items()}
        flank: dict[Route, dict[Block, dict[Block, Point]]] = {route: {} for route in layout.routes}
        shut = {block: frozenset(targets) for block, targets in held.items()}
        return Ground(leads, dict(self.neighbours), dict(opens), turnout, flank, shut, dict(layout.tag_in), laid)


def _turnouts(
    row: Row, leads: Mapping[Block, Mapping[Block, Mapping[Point, Position]]]
) -> dict[Block, dict[Block, Point]]:
    """The points of a route that turn its train from where it is not to go."""
    found: dict[Block, dict[Block, Point]] = {block: {} for block in leads}
    for block, following in pairwise(row.chain):
        for target in sorted(set(leads[block]) - {following}):
            demands = leads[block][target]
            turning = [p for p in sorted(demands) if row.needs.get(p, demands[p]) != demands[p]]
            if turning:
                found[block][target] = turning[0]
    return found
