"""Trains on their way to a road, in mm and ms: how they run, stop, turn back, and keep what they have promised.

Nothing of models or proofs is in it but the kernel's public functions.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from random import Random

from kernel.crossing.arrival import Followed
from kernel.crossing.crossing import CrossingTrack, Train
from kernel.crossing.promise import Promise, lower, nothing_promised
from tests.crossing.road import DOWN, SETTINGS, UP

LINE_MM_S, GAIN_MM_S2, BRAKES_MM_S2, LENGTH_MM, APART_MM = 28_000, 950, 800, 120_000, 400_000
JITTER_MS = 20
"""A decision is taken so much early or late, and the next one by itself: a cycle lasts 40 ms more or less at most."""
LONGEST_MS = 1_000 + 2 * JITTER_MS
START_MM = LINE_MM_S * LONGEST_MS * (SETTINGS.start_cycles + 1) // 1_000
CLOSE_MM = 80_000
"""Some trains without radio are so close behind another one."""
OUT_MM = LENGTH_MM + 15_000
"""With its head so far beyond the road a train has left it."""
FAR_MM = 1_900_000
"""Trains that stand so far from the road may promise to stand, and are let go again."""
ODOMETRY_MM_S = 300
"""The upper end of a train's range of its speed is no farther off."""
RESPONDS_MM_S = 2 * GAIN_MM_S2 * LONGEST_MS // 1_000 + 1
"""What a train gains at the most from a decision to brake until the brake answers, a cycle later."""
LEAST_MM_S = 5_000
"""A train that runs promises no less."""
RUNS_OUT_S = 25


@dataclass
class Body:
    """A train: of its head ``way_mm`` to the road, and what the ground unit and people have of it.

    ``stops_mm``: shortly before it stands for ``stands_s``.  ``to_and_fro_s``: until then it runs in and out, if so.
    ``unheard``: the seconds in which its radio is out, if it has one.  ``off``: those in which its computer is.
    ``signal_mm``: so far beyond the road it turns back at a starting signal, if not 0; after ``asks_s`` there it asks.
    ``promises``: it promises ceilings; it holds to ``held``, and the crossing has ``noted`` something of it.
    ``told``: what it has told in this contact.  ``heard``: the acknowledgements under way to it, and when they come.
    ``heeds``: its driver heeds the ceiling; any other meets the brake.
    ``means_mm_s``: as fast as it means to run until it is ``asks_mm`` before the road; from there on it asks for more.
    ``hurries``: it asks at once then, for nearly all that the line allows, and does not promise less again.
    ``names``: by which the crossing may know it.
    ``out_s``: for how long it has been out of the approach, though the crossing knows it.
    """

    name: Train
    track: CrossingTrack
    way_mm: int
    has_radio: bool
    stops_mm: int
    stands_s: int
    to_and_fro_s: int
    unheard: range
    signal_mm: int = 0
    asks_s: int = 0
    promises: bool = False
    heeds: bool = True
    asks_mm: int = 0
    hurries: bool = False
    means_mm_s: int = LINE_MM_S
    off: range = range(0)
    speed_mm_s: int = 15_000
    aims_mm_s: int = 15_000
    inside: bool = False
    met: bool = False
    stands_at_signal: bool = False
    asks_to_start: bool = False
    let_go: bool = False
    comes_back: bool = False
    run_cycles: int = 0
    out_s: int = 0
    upper_mm_s: int = 0
    brakes: bool = False
    followed: Followed | None = None
    said: tuple[tuple[int, int, int], ...] = ()
    held: Promise = field(default_factory=lambda: nothing_promised(LINE_MM_S))
    noted: Promise = field(default_factory=lambda: nothing_promised(LINE_MM_S))
    told: list[Promise] = field(default_factory=list)
    heard: list[tuple[int, int]] = field(default_factory=list)
    names: set[Train] = field(default_factory=set)

    @property
    def is_in_the_approach(self) -> bool:
        """It may arrive without passing its start point, or stands on the road."""
        if self.stands_at_signal:
            return self.let_go
        return self.inside and self.way_mm > -OUT_MM

    @property
    def is_in_the_way(self) -> bool:
        """Whoever looks along the track sees it, and not before a signal at danger."""
        runs_to_signal = self.signal_mm > 0 and self.met and not self.stands_at_signal and not self.comes_back
        return self.is_in_the_approach or runs_to_signal

    @property
    def is_across_the_road(self) -> bool:
        return self.met and -LENGTH_MM < self.way_mm < 0

    @property
    def is_done(self) -> bool:
        return self.way_mm < -2 * LENGTH_MM and (self.signal_mm == 0 or self.comes_back)

    @property
    def is_at_its_signal(self) -> bool:
        """It has stopped beyond the road, clear of it, to come back."""
        beyond = self.signal_mm > 0 and self.met and not self.comes_back
        return beyond and self.speed_mm_s == 0 and self.way_mm < -LENGTH_MM - 20_000

    def turn(self, run_cycles: int) -> None:
        """Stand at the starting signal, facing the road."""
        self.way_mm = -self.way_mm - LENGTH_MM
        self.run_cycles = run_cycles
        self.stands_at_signal, self.met, self.followed, self.said = True, False, None, ()

    def start(self) -> None:
        self.stands_at_signal, self.comes_back, self.inside = False, True, True


def stopping_mm_s(way_mm: int) -> int:
    """From so fast a train stops within a way, 30 m sooner."""
    return int((2 * 700 * max(0, way_mm - 30_000)) ** 0.5)


def aims_mm_s(chance: Random, body: Body, ahead: Body | None, now_s: int) -> int:
    """As fast as its driver means to run, but for the train ahead of it.

    Who runs to and fro runs out as its radio fails, if it did not before.
    """
    if body.stands_at_signal:
        return 0
    aims = LINE_MM_S
    if now_s < body.to_and_fro_s:
        if chance.random() < 0.04:
            body.aims_mm_s = chance.choice((-6_000, -6_000, 0, 3_000, 6_000))
        aims = body.aims_mm_s if body.way_mm < START_MM + 400_000 else 6_000
        if body.way_mm < 700_000 or body.unheard.start - RUNS_OUT_S <= now_s:
            aims = -6_000
    elif body.stands_s > 0 and body.way_mm > body.stops_mm and not body.comes_back:
        aims = min(LINE_MM_S, stopping_mm_s(body.way_mm - body.stops_mm))
        body.stands_s -= body.speed_mm_s == 0
    elif body.signal_mm > 0 and not body.comes_back:
        aims = min(LINE_MM_S, stopping_mm_s(body.way_mm + LENGTH_MM + body.signal_mm))
    if ahead is not None and not body.comes_back:
        aims = min(aims, stopping_mm_s(body.way_mm - ahead.way_mm - LENGTH_MM - 50_000))
    return aims


def supervised_mm_s(body: Body, aims: int, now_s: int) -> int:
    """What the computer on board lets through: it brakes a cycle after it has seen that the ceiling is near."""
    if body.way_mm > body.asks_mm:
        aims = min(aims, body.means_mm_s)
    if body.heeds:
        aims = min(aims, max(0, body.held.ceiling_mm_s - 2 * RESPONDS_MM_S))
    if body.brakes or now_s in body.off:
        aims = min(aims, 0)
    body.brakes = body.promises and body.upper_mm_s + RESPONDS_MM_S > body.held.ceiling_mm_s
    return aims


def drive(chance: Random, body: Body, ahead: Body | None, now_s: int, lasts_ms: int) -> None:
    """Run for a while; after a stop its brakes are put on again at once."""
    before_mm_s = body.speed_mm_s
    aims = aims_mm_s(chance, body, ahead, now_s)
    if body.promises:
        aims = supervised_mm_s(body, aims, now_s)
    faster_mm_s = min(before_mm_s + GAIN_MM_S2 * lasts_ms // 1_000, aims)
    body.speed_mm_s = max(faster_mm_s, before_mm_s - BRAKES_MM_S2 * lasts_ms // 1_000)
    body.way_mm -= (before_mm_s + body.speed_mm_s) * lasts_ms // 2_000


def drawn(chance: Random, more: Random) -> list[Body]:
    """One to three trains on each track; the last of a track may run to and fro, or turn back beyond the road.

    ``more``: what stops, turns and promises are drawn from, beside the rest.
    """
    bodies = []
    for track in (UP, DOWN):
        way_mm = START_MM + 300_000
        for place in range(count := chance.randint(1, 3)):
            is_last = place == count - 1
            to_and_fro_s = chance.randint(200, 700) if is_last and chance.random() < 0.6 else 0
            unheard_s = max(0, to_and_fro_s - chance.randint(0, 15)) or chance.randint(0, 400)
            body = Body(
                name=Train(f"{track} {place}"),
                track=track,
                way_mm=way_mm + chance.randint(0, 500_000),
                has_radio=chance.random() < 0.7,
                stops_mm=chance.randint(100_000, START_MM + 200_000),
                stands_s=chance.choice((0, 20, 120)),
                to_and_fro_s=to_and_fro_s,
                unheard=range(unheard_s, unheard_s + chance.choice((0, 20, 200))),
            )
            draw_more(more, body, is_last)
            if place > 0 and more.random() < 0.4:
                body.way_mm, body.has_radio, body.promises = way_mm - APART_MM + CLOSE_MM, False, False
            bodies.append(body)
            way_mm = body.way_mm + LENGTH_MM + APART_MM
    return bodies


def draw_more(more: Random, body: Body, is_last: bool) -> None:
    """Stops near the road, on it and far from it, a change of ends beyond it, and promises."""
    body.names.add(body.name)
    place = more.random()
    if place < 0.3:
        body.stops_mm, body.stands_s = more.randint(-LENGTH_MM - 20_000, 70_000), more.choice((20, 120))
    if is_last and more.random() < 0.5:
        body.signal_mm, body.asks_s = more.randint(60_000, 700_000), more.choice((5, 40, 150))
    body.promises = body.has_radio and more.random() < 0.6
    if body.promises and more.random() < 0.7:
        body.unheard = range(0)
    body.heeds = more.random() < 0.5
    body.means_mm_s = more.randint(LEAST_MM_S, LINE_MM_S)
    body.asks_mm = more.choice((10**9, more.randint(300_000, 900_000), more.randint(1_500_000, 2_500_000)))
    if body.promises and place > 0.8:
        body.way_mm += 1_000_000
        body.stops_mm, body.stands_s = FAR_MM, 40
    if body.promises and more.random() < 0.5:
        off_s = more.randint(10, 300)
        body.off = range(off_s, off_s + more.randint(1, 20))


def hurried(chance: Random) -> Body:
    """One that has promised to run slowly, and asks to go faster where it may already be too late for that."""
    means_mm_s = chance.randint(LEAST_MM_S, LEAST_MM_S * 3 // 2)
    ceiling_mm_s = means_mm_s + ODOMETRY_MM_S + RESPONDS_MM_S
    return Body(
        name=Train("hurries"),
        track=UP,
        way_mm=START_MM + chance.randint(300_000, 800_000),
        has_radio=True,
        stops_mm=0,
        stands_s=0,
        to_and_fro_s=0,
        unheard=range(0),
        promises=True,
        heeds=chance.random() < 0.5,
        asks_mm=chance.randint(400_000, 800_000),
        hurries=True,
        means_mm_s=means_mm_s,
        speed_mm_s=means_mm_s,
        held=lower(nothing_promised(LINE_MM_S), ceiling_mm_s, means_mm_s),
        names={Train("hurries")},
    )
