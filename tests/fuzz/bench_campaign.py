"""Campaigns: steps a second with every fault and every invariant on, compiled, in plain CPython, and by Hypothesis.

Each on one core.

Compiled code and CPython take the same events and must end in the same state, told by its hash.  CPython takes only
those that changed something, and is charged nothing for drawing them; the compiled traffic draws its own.
"""

from __future__ import annotations

import os
import time
from collections.abc import Iterator
from pathlib import Path

from fuzz.failures.trace import Trace
from fuzz.machines.interlocking import Interlocking, hunted
from fuzz.machines.places import place_on
from fuzz.targets.interlocking import TRAINS, traffic_of
from fuzz.traffic.runs import Traffic
from models.world.start import start
from models.world.state import System
from proofs.catalogue import INVARIANTS
from proofs.transitions import TRANSITIONS
from tests.bench import Figure

ROOT = Path(__file__).resolve().parents[2]
SHARED = Path(os.environ.get("HEISOKU_LAYOUTS", ROOT.parent / "shared" / "layouts"))
STEPS = {transition.__name__: transition for transition in TRANSITIONS}
SEED, BATCH = 7, 0
COMPILED_TRACES = 192
REPLAYED_TRACES = 2
EXAMPLES = 4


def layout() -> Path:
    """The network of eight trains, or where it is absent a station of ours."""
    path = SHARED / "osrd-small_infra.json"
    return path if path.exists() else ROOT / "layouts" / "passing_station.toml"


def bench_steps_a_second() -> Iterator[Figure]:
    """Compiled and in CPython, with invariants and without; then Hypothesis."""
    path = layout()
    traffic = traffic_of(path, TRAINS)
    traffic.run(SEED, BATCH, 0, beyond=False)
    compiled, tried = rates_of_compiled(traffic)
    yield Figure(f"compiled, {path.name}, faults and invariants on", compiled, compiled, "steps/s", COMPILED_TRACES)
    taken, asked, plain = replayed(traffic)
    yield Figure("CPython, the same events, invariants on", asked, asked, "steps/s", taken)
    yield Figure("compiled to CPython, invariants on", compiled / asked, compiled / asked, "times", taken)
    quick = Traffic(traffic.native, oracles=False, why=False)
    bare, _ = rates_of_compiled(quick)
    yield Figure("compiled, without invariants", bare, bare, "steps/s", COMPILED_TRACES)
    yield Figure("CPython, the same, without", plain, plain, "steps/s", taken)
    yield Figure("compiled to CPython, without", bare / plain, bare / plain, "times", taken)
    rules, hypothesis = rate_of_hypothesis(path)
    yield Figure("Hypothesis, rules, invariants on", hypothesis, hypothesis, "rules/s", rules)
    yield Figure("compiled, refused steps too", tried, tried, "steps/s", COMPILED_TRACES)
    yield Figure("compiled to Hypothesis, refused steps too", tried / hypothesis, tried / hypothesis, "times", rules)


def rates_of_compiled(traffic: Traffic) -> tuple[float, float]:
    """Steps a second that changed something; and all of them, as Hypothesis counts rules that change nothing too."""
    begin = time.perf_counter()
    outcomes = [traffic.run(SEED, BATCH, number, beyond=False) for number in range(COMPILED_TRACES)]
    spent = time.perf_counter() - begin
    return sum(each.accepted for each in outcomes) / spent, sum(each.steps for each in outcomes) / spent


def replayed(traffic: Traffic) -> tuple[int, float, float]:
    """Steps, and their rates with every invariant asked and with none, over some of the same traces."""
    taken, asked_s, plain_s = 0, 0.0, 0.0
    for number in range(REPLAYED_TRACES):
        outcome = traffic.run(SEED, BATCH, number, beyond=False)
        trace = traffic.trace(SEED, BATCH, number, outcome)
        runs = traffic.native.memory.runs_in(traffic.memory)
        spent, after = played(traffic, trace, judged=True)
        asked_s += spent
        plain_s += played(traffic, trace, judged=False)[0]
        taken += len(trace.events)
        packed = traffic.native.memory.new()
        traffic.native.memory.pack(packed, after, runs)
        final = traffic.native.memory.final_hash
        assert final(packed) == final(traffic.memory), f"trace {number} ends in another state"
    return taken, taken / asked_s, taken / plain_s


def played(traffic: Traffic, trace: Trace, judged: bool) -> tuple[float, System]:
    """Take a trace's events in plain CPython; how long it took, and the state after."""
    site = traffic.native.memory.site
    system = start(site, trace.at, trace.lies)
    begin = time.perf_counter()
    for event in trace.events:
        system = STEPS[event.step](site, system, **event.event)
        if judged:
            assert all(holds(site, system) for holds in INVARIANTS.values())
    return time.perf_counter() - begin, system


def rate_of_hypothesis(path: Path) -> tuple[int, float]:
    """Rules executed a second."""
    machine = type("OnTheNetwork", (Interlocking,), {"places": (place_on(path, TRAINS),)})
    begin = time.perf_counter()
    assert hunted(machine, EXAMPLES) is None
    rules: int = machine.counted["rules"]  # type: ignore[attr-defined]
    return rules, rules / (time.perf_counter() - begin)
