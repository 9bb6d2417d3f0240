"""The track diagram of a layout as SVG: blocks, points, tags, one route highlighted, a legend."""

from __future__ import annotations

from collections.abc import Sequence
from xml.sax.saxutils import escape

import networkx as nx

from kernel.names import Block, Point, Route
from models.diagram_plan import Node, Plan, plan, spread
from models.layouts.results import BadInput, Imported
from models.layouts.track import Cut, Joint, Stop, cut_into_segments

COLUMN, WIDEST_COLUMN, LANE, WIDTH = 80, 190, 74, 1240
"""Pixels from one column to the next (at least, at most), from lane to lane, and across the page at least."""
LEFT, TOP = 70, 120
BLOCK_COLOURS = ("#7f8c8d", "#34495e")
START, COVERED, OVERLAP = "#1f77b4", "#d62728", "#e6a100"
STYLE = (
    "text{font:11px sans-serif;fill:#222}.title{font:bold 16px sans-serif}.block{fill:#555;font-size:10px}"
    ".point{font-weight:bold;fill:#0b5d1e}.mark{font-size:9px;fill:#444}.held{fill:#d62728;font-weight:bold}"
)


def draw_svg(imported: Imported, route: str | None = None) -> str:
    """The diagram of a layout, with a route highlighted if one is named.

    :raises BadInput: the layout has no such route.
    """
    if route is not None and route not in imported.layout.routes:
        some = ", ".join(f"'{name}'" for name in sorted(imported.layout.routes)[:5])
        raise BadInput(
            imported.name, f"route '{route}'", "there is no such route", f"name one of its routes, such as {some}"
        )
    drawing = Drawing(imported, None if route is None else Route(route))
    return drawing.of_track() if imported.station is not None else drawing.of_blocks()


class Drawing:
    """One diagram in the making: a list of SVG elements."""

    def __init__(self, imported: Imported, route: Route | None) -> None:
        self.imported = imported
        self.layout = imported.layout
        self.route = route
        self.parts: list[str] = []
        self.column = COLUMN

    # --- what belongs to the route

    def colour(self, block: Block, plain: str) -> str:
        """A block's colour by its part in the route."""
        if self.route is None:
            return plain
        if block == self.layout.start[self.route]:
            return START
        if block in self.layout.covers[self.route]:
            return COVERED
        return OVERLAP if block in self.layout.overlap[self.route] else plain

    def needed(self, point: Point) -> str | None:
        """How the route needs a point to lie."""
        return None if self.route is None else self.layout.needs[self.route].get(point)

    # --- pieces of SVG

    def line(self, points: Sequence[tuple[float, float]], colour: str, width: float, title: str = "") -> None:
        """A polyline in pixels."""
        path = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
        inner = f"<title>{escape(title)}</title>" if title else ""
        style = f'fill="none" stroke="{colour}" stroke-width="{width}" stroke-linejoin="round" stroke-linecap="round"'
        self.parts.append(f'<polyline points="{path}" {style}>{inner}</polyline>')

    def text(self, x: float, y: float, text: str, kind: str, anchor: str = "middle", turn: float = 0) -> None:
        """A label; ``turn`` in degrees."""
        turned = f' transform="rotate({turn} {x:.1f} {y:.1f})"' if turn else ""
        start = f'<text x="{x:.1f}" y="{y:.1f}" class="{kind}" text-anchor="{anchor}"{turned}>'
        self.parts.append(f"{start}{escape(text)}</text>")

    def whole(self, width: float, height: float) -> str:
        """The finished document."""
        head = f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:.0f}" height="{height:.0f}">'
        page = '<rect width="100%" height="100%" fill="white"/>'
        return f"{head}<style>{STYLE}</style>{page}{''.join(self.parts)}</svg>\n"

    def title(self) -> None:
        """The layout's name, its size, and the route."""
        name = self.imported.name.rsplit("/", 1)[-1]
        size = f"{len(self.layout.blocks)} blocks, {len(self.layout.routes)} routes, {len(self.layout.points)} points"
        self.text(LEFT - 50, 26, name, "title", "start")
        self.text(LEFT - 50, 44, f"{self.imported.kind}: {size}", "block", "start")
        if self.route is not None:
            self.text(LEFT - 50, 62, f"route {self.route}", "held", "start")

    def legend(self, x: float, y: float) -> None:
        """What the signs mean."""
        lines = [("block", BLOCK_COLOURS[0]), ("neighbouring block", BLOCK_COLOURS[1])]
        if self.route is not None:
            lines += [("start of the route", START), ("covered", COVERED), ("overlap", OVERLAP)]
        for label, colour in lines:
            self.line([(x, y), (x + 28, y)], colour, 6)
            self.text(x + 34, y + 4, label, "block", "start")
            x += 60 + 6.2 * len(label)
        self.line([(x, y - 9), (x, y + 9)], "#000", 1.5)
        self.tag(x - 6, y)
        self.tag(x + 6, y)
        self.text(x + 14, y + 4, "boundary with its two tags", "block", "start")
        x += 175
        self.circle(x, y, "#0b5d1e")
        self.text(x + 10, y + 4, "point (red: as the route needs it)", "block", "start")
        x += 205
        self.line([(x, y - 8), (x, y + 8)], "#000", 4)
        self.text(x + 10, y + 4, "buffer stop or end of track", "block", "start")

    def circle(self, x: float, y: float, colour: str) -> None:
        """A point."""
        style = f'fill="#fff" stroke="{colour}" stroke-width="2"'
        self.parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="4.5" {style}/>')

    def tag(self, x: float, y: float) -> None:
        """A tag between the rails."""
        self.parts.append(f'<rect x="{x - 2:.1f}" y="{y - 2:.1f}" width="4" height="4" fill="#fff" stroke="#000"/>')

    # --- a layout with a track plan

    def of_track(self) -> str:
        """The diagram of a station, lane by lane."""
        assert self.imported.station is not None
        placed = plan(cut_into_segments(self.imported.station))
        of = self.block_of(placed)
        self.column = min(WIDEST_COLUMN, max(COLUMN, int((WIDTH - 2 * LEFT) / max(placed.columns, 1))))
        self.title()
        self.draw_segments(placed, of)
        self.draw_marks(placed)
        self.draw_points(placed)
        self.draw_block_names(placed, of)
        width = max(LEFT * 2 + placed.columns * self.column, WIDTH)
        height = TOP + placed.lanes * LANE + 50
        self.legend(LEFT - 50, height - 22)
        return self.whole(width, height)

    def block_of(self, placed: Plan) -> dict[int, Block]:
        """The block of each segment, by its span."""
        by_span = {span: block for block, spans in self.imported.places.spans.items() for span in spans}
        pieces = enumerate(placed.segments.segments)
        return {index: by_span[piece.track, piece.from_mm, piece.to_mm] for index, piece in pieces}

    def xy(self, placed: Plan, node: Node) -> tuple[float, float]:
        """A node's place in pixels."""
        column, lane = placed.at[node]
        return LEFT + column * self.column, TOP + lane * LANE

    def draw_segments(self, placed: Plan, of: dict[int, Block]) -> None:
        """Every segment in the colour of its block; the route lies on top."""
        shade = _shades(self.imported)
        order = sorted(of, key=lambda index: self.colour(of[index], "") != "")
        for index in order:
            block = of[index]
            colour = self.colour(block, BLOCK_COLOURS[shade[block]])
            (x, y), (to_x, to_y) = (self.xy(placed, node) for node in placed.line[index])
            lane_y = TOP + placed.lane[index] * LANE
            bend = min(24, (to_x - x) / 3) if to_x > x else 24
            points = [(x, y), (x + bend, lane_y), (to_x - bend, lane_y), (to_x, to_y)]
            bends = [at for at, wanted in zip(points, (True, y != lane_y, to_y != lane_y, True), strict=True) if wanted]
            self.line(bends, colour, 6 if self.colour(block, "") else 4, block)

    def draw_marks(self, placed: Plan) -> None:
        """Boundaries with their two tags; buffer stops and ends of track."""
        for heading, end in placed.segments.at.items():
            node = next(n for n in placed.line[heading[0]] if _is_at(n, end, heading, placed))
            x, y = self.xy(placed, node)
            if isinstance(end, Stop):
                self.line([(x, y - 8), (x, y + 8)], "#000", 4)
                if end.mark:
                    self.text(x, y + 22, end.mark, "mark")
            elif isinstance(end, Cut):
                left = placed.line[heading[0]][1] == node
                self.tag(x - 6 if left else x + 6, y)
                self.line([(x, y - 9), (x, y + 9)], "#000", 1.5)
                if left:
                    self.text(x + 2, y - 12, end.mark, "mark", "start", -28)

    def draw_points(self, placed: Plan) -> None:
        """Points with their names, and how the route needs them."""
        for name, junction in placed.segments.station.junctions.items():
            x, y = self.xy(placed, ("junction", name))
            wanted = self.needed(Point(name))
            colour = "#d62728" if wanted else "#0b5d1e"
            if junction.is_point:
                self.circle(x, y, colour)
                below = self.branches_up(placed, name)
                label = f"{name} {wanted}" if wanted else name
                self.text(x, y + 28 if below else y - 9, label, "held" if wanted else "point")
            elif len(junction.ports) > 2:
                self.text(x, y + 17, name, "mark")

    def branches_up(self, placed: Plan, junction: str) -> bool:
        """Whether some track leaves a junction upwards, so that its name stands below."""
        own = placed.at["junction", junction][1]
        met = (i for i, ends in placed.line.items() if ("junction", junction) in ends)
        lanes = [placed.lane[i] for i in met]
        return min(lanes) < own

    def draw_block_names(self, placed: Plan, of: dict[int, Block]) -> None:
        """Each block's name under its longest straight stretch."""
        widest: dict[Block, tuple[float, float, float]] = {}
        for index, block in of.items():
            (x, _), (to_x, _) = (self.xy(placed, node) for node in placed.line[index])
            if to_x - x > widest.get(block, (0, 0, 0))[0]:
                widest[block] = (to_x - x, (x + to_x) / 2, TOP + placed.lane[index] * LANE)
        for block, (width, x, y) in widest.items():
            room = max(4, int(width / 6))
            name = block.removeprefix("B:")
            self.text(x, y + 14, name if len(name) <= room else name[: room - 1] + "…", "block")

    # --- a layout without one

    def of_blocks(self) -> str:
        """The diagram of an interlocking table: blocks as boxes, joined where routes run."""
        graph: nx.Graph[Block] = nx.Graph()
        neighbours = self.imported.ground.neighbours
        graph.add_edges_from((block, other) for block, near in neighbours.items() for other in near)
        graph.add_nodes_from(self.layout.blocks)
        spots = spread(graph)
        width, height = WIDTH, 760
        at = {b: (width / 2 + x * 520, 70 + height / 2 - 30 + y * 290) for b, (x, y) in spots.items()}
        self.title()
        for block, other in sorted(tuple(sorted(edge)) for edge in graph.edges):
            self.line([at[block], at[other]], "#999", 3)
        if self.route is not None:
            for block, other in self.layout.way[self.route].items():
                self.line([at[block], at[other]], COVERED, 5)
        for block, (x, y) in sorted(at.items()):
            points = sorted(self.layout.points_in.get(block, ()))
            wide = 7 * max(len(block), 6) + 16
            colour = self.colour(block, "#34495e" if points else "#7f8c8d")
            box = f'<rect x="{x - wide / 2:.1f}" y="{y - 12:.1f}" width="{wide}" height="24" rx="4"'
            self.parts.append(f'{box} fill="#fff" stroke="{colour}" stroke-width="3"/>')
            self.text(x, y + 4, block, "block")
            for below, point in enumerate(points):
                wanted = self.needed(point)
                label = f"{point} {wanted}" if wanted else point
                self.text(x, y + 25 + 12 * below, label, "held" if wanted else "point")
        self.legend(LEFT - 50, height + 50)
        return self.whole(width, height + 80)


def _is_at(node: Node, end: Cut | Joint | Stop, heading: tuple[int, int], placed: Plan) -> bool:
    """Whether a node is the one that a heading runs to."""
    if isinstance(end, Joint):
        return node == ("junction", end.junction)
    name = end.mark if end.mark is not None else f"{placed.segments.segments[heading[0]].track}/{heading[1]}"
    return node[0] in ("mark", "end") and node[1] == name


def _shades(imported: Imported) -> dict[Block, int]:
    """One of two shades for each block, so that neighbours differ where they can."""
    shade: dict[Block, int] = {}
    for start in sorted(imported.layout.blocks):
        todo = [(start, 0)]
        while todo:
            block, wanted = todo.pop()
            if block not in shade:
                shade[block] = wanted
                todo += [(other, 1 - wanted) for other in sorted(imported.ground.neighbours.get(block, frozenset()))]
    return shade
