"""Networks drawn, the way along the track by networkx: no mild tone with a train that near by any way (A1, A3).

Nothing of the models and proofs is used here: a worker stands on a line of a network that branches, ends, loops and
has breaks of kilometrage; a train stands anywhere, told where it was some seconds ago in the figures of that place.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from random import Random

import networkx as nx
import pytest

from kernel.alarm import tone as machine
from kernel.alarm.distance import NO_TRAIN_FIX, AlarmBounds, Direction, TrainFix, WorkerFix
from kernel.alarm.tone import Display, Freshness, Handset, Known, Listing, Opening, Register, Tone, Train

KM = 1_000_000
LINE_MM = 12 * KM
SPEED_MM_S, ERROR_MM, LENGTH_MM = 30_000, 20_000, 80_000
REGISTER = Register(
    AlarmBounds(SPEED_MM_S, 2_000, LENGTH_MM, ERROR_MM, 15_000, 30_000),
    Freshness(fix_ms=10_000, display_ms=12_000, server_ms=8_000, worker_ms=5_000),
    display_error_mm=10_000,
    tolerance_mm=50_000,
    sections={},
    stabled=frozenset(),
    openings={},
)


READ = Listing(life_ms=0, taken=0, count=0, is_whole=True, named={})
"""A list that is whole, and has been read."""


class Network:
    """Nodes: the joints of the worker's line, numbered from its lower end, then those beyond.  Edges: tracks in mm."""

    def __init__(self, chance: Random) -> None:
        """Draw a line of 12 km, where tracks leave it, and tracks beyond, each with figures of its own."""
        self.joints_mm = sorted(chance.sample(range(0, LINE_MM, 10_000), chance.randrange(4)))
        self.graph: nx.Graph[int | str] = nx.Graph()
        joints = range(len(self.joints_mm))
        beyond = range(len(self.joints_mm), len(self.joints_mm) + 5)
        for one in (*joints, *beyond):
            for other in chance.sample(beyond, 1 if one in joints else chance.randrange(3)):
                if one != other:
                    self.graph.add_edge(one, other, mm=chance.randrange(1_000, 6 * KM))
        self.origins_mm = {track: chance.randrange(-20 * KM, 20 * KM) for track in sorted(self.graph.edges)}

    def place(self, chance: Random) -> tuple[tuple[int, int] | None, int]:
        """Draw where a train is: on the line, or how far along which track."""
        if not self.origins_mm or chance.random() < 0.3:
            return None, chance.randrange(LINE_MM)
        track = chance.choice(sorted(self.origins_mm))
        return track, chance.randrange(1, self.graph.edges[track]["mm"])

    def way_mm(self, worker_mm: int, track: tuple[int, int] | None, train_mm: int) -> int:
        """Give the least way along any tracks from the worker to a train; more than the line where there is none."""
        cut = self.graph.copy()
        on_line = [(place_mm, node) for node, place_mm in enumerate(self.joints_mm)] + [(worker_mm, "worker")]
        if track is None:
            on_line.append((train_mm, "train"))
        else:
            cut.add_edge(track[0], "train", mm=train_mm)
            cut.add_edge("train", track[1], mm=self.graph.edges[track]["mm"] - train_mm)
        on_line.sort(key=lambda stop: stop[0])
        for (from_mm, one), (to_mm, other) in pairwise(on_line):
            cut.add_edge(one, other, mm=min(to_mm - from_mm, cut.get_edge_data(one, other, {"mm": LINE_MM})["mm"]))
        reached = nx.single_source_dijkstra_path_length(cut, "worker", weight="mm") if "worker" in cut else {}
        return int(reached.get("train", 9 * LINE_MM))


def told(chance: Random, figure_mm: int, age_ms: int) -> Known:
    """What both sources say, in whatever figures."""
    fix = TrainFix(figure_mm + chance.randrange(-ERROR_MM, ERROR_MM + 1), age_ms, Direction.UNKNOWN, is_running=False)
    return Known(fix, Display(figure_mm - KM, figure_mm + KM, age_ms), jumped=False, newest=NO_TRAIN_FIX)


def heard(seed: int, with_openings: bool = True) -> tuple[Tone, float]:
    """Draw a network, a worker and a train, and give the tone and the train's distance along the track.

    The train was told some seconds ago, where it was then; it has run since, by the line's speed, to where it is now.
    """
    chance = Random(seed)
    network = Network(chance)
    worker_mm = chance.randrange(LINE_MM)
    track, was_mm = network.place(chance)
    age_ms = chance.choice((0, chance.randrange(10_001), 10_000))
    figure_mm = was_mm + (0 if track is None else network.origins_mm[track])
    ran_mm = chance.random() * SPEED_MM_S * age_ms / 1_000 + chance.randrange(LENGTH_MM + 1)
    now_mm = network.way_mm(worker_mm, track, was_mm) - ran_mm
    known = {Train("1"): told(chance, figure_mm, age_ms)} if track is None or chance.random() < 0.7 else {}
    joints_mm = network.joints_mm if with_openings else []
    openings = {Opening(f"{number}"): place_mm for number, place_mm in enumerate(joints_mm)}
    handset = Handset(WorkerFix(worker_mm, 0), 0, servers_well=True, battery_well=True, listing=READ, trains=known)
    return machine.tone(replace(REGISTER, openings=openings), handset), now_mm


def breaches(seeds: range, with_openings: bool = True) -> int:
    """Count worlds in which a tone is milder than where the train is; each other tone must have been heard."""
    drawn = [heard(seed, with_openings=with_openings) for seed in seeds]
    assert {Tone.ALARM, Tone.CAUTION, Tone.NORMAL} <= {each for each, _mm in drawn}
    limits = {Tone.NORMAL: 3 * KM, Tone.CAUTION: 3 * KM // 2}
    return sum(each in limits and mm <= limits[each] for each, mm in drawn)


def test_no_tone_is_mild_with_a_train_near_by_any_way() -> None:
    assert breaches(range(300)) == 0


def test_without_openings_on_the_register_it_is() -> None:
    """Else the test above would show nothing."""
    assert breaches(range(300), with_openings=False) > 10


@pytest.mark.slow
def test_no_tone_is_mild_in_many_networks() -> None:
    assert breaches(range(1_000, 21_000)) == 0
