"""A hand-made site: a passing track between two ends, small enough to think about.

West W (point pw facing P and Q), platforms P and Q, east E (point pe facing P and Q westward).
"""

from __future__ import annotations

from kernel.layout import Layout, TagRecords
from kernel.maps import Map
from kernel.names import Block, Cab, Car, Point, Position, Record, Route, Run, Serial, Tag, Train, UnitLife
from kernel.tag_list_text import with_tag_lists
from models.ground import Ground
from models.world.formations import cabs
from models.world.start import site_as_told, start
from models.world.state import Formation, Site, System

N, R = Position("normal"), Position("reverse")
W, P, Q, E = Block("W"), Block("P"), Block("Q"), Block("E")
PW, PE = Point("pw"), Point("pe")
T1, T2 = Train("T1"), Train("T2")


def tag(boundary: str, block: Block) -> Tag:
    return Tag(f"{boundary}@{block}")


def hand_made_layout() -> tuple[Layout, TagRecords, Ground]:
    """Eight routes; covers one block each; positions: P normal, Q reverse at both points."""
    ends = {(W, P): "wp", (W, Q): "wq", (P, E): "pe", (Q, E): "qe"}
    boundary = {**ends, **{(b, a): name for (a, b), name in ends.items()}}
    lies = {P: N, Q: R}
    point_of = {W: PW, E: PE}
    routes = {Route(f"{a}-{b}"): (a, b) for a, b in boundary}
    needs, released_with, leads, turnout = {}, {}, {}, {}
    for route, (a, b) in routes.items():
        end, platform = (a, b) if a in point_of else (b, a)
        needs[route] = {point_of[end]: lies[platform]}
        released_with[route] = {point_of[end]: end}
        others = {P, Q} - {platform}
        leads[route] = {a: {p: {point_of[end]: lies[p]} for p in (P, Q)} if a == end else {end: {}}}
        turnout[route] = {a: dict.fromkeys(others, point_of[end])} if a == end else {a: {}}
    tags = [tag(name, block) for (a, b), name in ends.items() for block in (a, b)]
    partner = {}
    tag_in = {}
    for (a, b), name in ends.items():
        partner[tag(name, a)], partner[tag(name, b)] = tag(name, b), tag(name, a)
        tag_in[tag(name, a)], tag_in[tag(name, b)] = a, b
    layout = Layout(
        fleet=frozenset({T1, T2}),
        blocks=frozenset({W, P, Q, E}),
        routes=frozenset(routes),
        points=frozenset({PW, PE}),
        start={r: a for r, (a, b) in routes.items()},
        destination={r: b for r, (a, b) in routes.items()},
        covers={r: frozenset({b}) for r, (a, b) in routes.items()},
        overlap={r: frozenset() for r in routes},
        claims={r: frozenset({a, b}) for r, (a, b) in routes.items()},
        way={r: {a: b} for r, (a, b) in routes.items()},
        needs=needs,
        released_with=released_with,
        released_after={r: {a: a, b: b} for r, (a, b) in routes.items()},
        fouls={},
        stands_in={PW: W, PE: E},
        points_in={W: frozenset({PW}), E: frozenset({PE})},
        tag_in=tag_in,
        partner=partner,
        first_tag={r: tag(boundary[a, b], a) for r, (a, b) in routes.items()},
        tag_after={r: {tag(boundary[a, b], a): tag(boundary[a, b], b)} for r, (a, b) in routes.items()},
        tag_list={},
    )
    ground = Ground(
        leads=leads,
        neighbours={W: frozenset({P, Q}), E: frozenset({P, Q}), P: frozenset({W, E}), Q: frozenset({W, E})},
        opens={
            W: {P: {PW: N}, Q: {PW: R}},
            E: {P: {PE: N}, Q: {PE: R}},
            P: {W: {}, E: {}},
            Q: {W: {}, E: {}},
        },
        turnout=turnout,
        flank_point={},
        held_by_authority={W: frozenset({P, Q}), E: frozenset({P, Q}), P: frozenset({W, E}), Q: frozenset({W, E})},
        laid_in=tag_in,
        laid_leaves={t: {partner[t]: frozenset({tag_in[t]})} for t in tags},
    )
    return with_tag_lists(layout), TagRecords(record={t: Record(f"r:{t}") for t in tags}), ground


def small_site(serials: int = 8, lives: int = 4) -> Site:
    layout, records, ground = hand_made_layout()
    train_of = {Car("a1"): T1, Car("a2"): T1, Car("b1"): T2}
    runs = [
        Run(Serial(s), t, UnitLife(k), r)
        for s in range(1, serials)
        for t in sorted(layout.fleet)
        for k in range(1, lives)
        for r in [*sorted(layout.routes), Route("standing")]
    ]
    front: dict[Run, Cab] = {}
    last: dict[Run, Car] = {}
    ahead: dict[Run, Map[Car, frozenset[Car]]] = {}
    for run in runs:
        cars = [c for c, t in train_of.items() if t == run.train]
        order = cars if run.route.endswith("W") or run.route[0] == "E" else list(reversed(cars))
        front[run] = Cab(f"cab of {order[0]}")
        last[run] = order[-1]
        ahead[run] = {c: frozenset(order[:i]) for i, c in enumerate(order)}
    return site_as_told(
        layout=layout,
        records=records,
        ground=ground,
        formation=Formation(train_of=train_of, front=front, last=last, ahead=ahead, **cabs([[c] for c in train_of])),
    )


def small_start(site: Site) -> System:
    return start(
        site,
        {Car("a1"): frozenset({W}), Car("a2"): frozenset({W}), Car("b1"): frozenset({Q})},
        {PW: N, PE: N},
    )
