"""State machines of the interlocking: the sound kernel breaks nothing, a planted fault is found and shrunk."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from pathlib import Path
from random import Random

import pytest

from fuzz.failures.replaying import replay
from fuzz.failures.trace import Trace, parse, text_of
from fuzz.machines import service
from fuzz.machines.interlocking import STEPS, Interlocking, hunted, with_fault
from fuzz.machines.jolts import is_legal, jolted_walk
from fuzz.machines.moves import MOVES, Moves, numbered
from fuzz.machines.places import TINY, place_on
from fuzz.machines.plausible import MESSAGES, SOURCES, plausible
from fuzz.machines.strange import almost
from fuzz.machines.watched import Broken, judged
from fuzz.planted.draw import planted
from fuzz.planted.reachable import LAYOUTS
from models.layouts import load
from proofs import catalogue
from proofs.mutated import Sources
from tests.layouts.stations import SAMPLES

EXAMPLES = 25
PLACES = (TINY, *SAMPLES)


class AtTheTinyStation(Interlocking):
    places = tuple(place_on(TINY, seed=seed) for seed in range(5))


def machine_at(file: Path) -> type[Interlocking]:
    return type(f"At_{file.stem}", (Interlocking,), {"places": tuple(place_on(file, seed=seed) for seed in range(5))})


@pytest.fixture(scope="module")
def counted() -> dict[str, Counter[str]]:
    """Every machine run with the sound kernel, which breaks nothing; what was done in it."""
    found = {}
    for file in PLACES:
        machine = machine_at(file)
        assert hunted(machine, EXAMPLES) is None
        found[file.stem] = machine.counted
    return found


@pytest.mark.parametrize("file", PLACES, ids=lambda file: file.stem)
def test_routes_are_set_and_run_and_released(file: Path, counted: dict[str, Counter[str]]) -> None:
    done = counted[file.stem]
    assert done["rules"] >= EXAMPLES * STEPS / 2
    assert done["changed"] >= done["rules"] / 4
    for step in ("request", "take_permit", "car_moves", "tail_reads", "release_block", "restart_unit"):
        assert done[step] >= 1, step


def test_a_journey_takes_no_more_rules_than_a_run_has() -> None:
    """Service alone brings a train from its first request to the release of the block it left."""
    going = Moves(place_on(TINY), {})
    going.start_service()
    for _ in range(STEPS):
        going.goes_on(lambda many: 0)
    assert going.play.accepted["release_block"] >= 1
    assert going.counted["goes_on"] == STEPS


def test_every_transition_has_plausible_events() -> None:
    assert {*SOURCES, *MESSAGES} == set(catalogue.STEPS)
    assert not set(SOURCES) & set(MESSAGES)
    assert set(service.IN_ORDER) | set(service.ORDINARY) <= set(catalogue.STEPS)


@pytest.mark.slow
def test_walks_take_every_transition() -> None:
    """Some of them are rare: a point that is adopted, a part that is left behind and follows."""
    accepted: Counter[str] = Counter()
    moves = 0
    for number in range(40):
        going = numbered(number, {}, LAYOUTS)
        accepted += going.play.accepted
        moves += going.counted.total()
    assert moves == 40 * MOVES
    assert [step for step in catalogue.STEPS if not accepted[step]] == []


def test_a_walk_is_the_same_for_the_same_number() -> None:
    assert numbered(7, {}, LAYOUTS).play.taken == numbered(7, {}, LAYOUTS).play.taken
    assert numbered(7, {}, LAYOUTS).play.taken != numbered(11, {}, LAYOUTS).play.taken


def test_plausible_events_come_in_an_order_of_their_own() -> None:
    one, other = (numbered(9, {}, LAYOUTS).play for _ in range(2))
    for step in catalogue.STEPS:
        assert plausible(one.site, one.system, step) == plausible(other.site, other.system, step)


def test_nothing_strange_makes_the_sound_kernel_raise() -> None:
    """Unknown blocks, points, trains and cars, runs of no route: every step is defined of them."""
    play = numbered(3, {}, LAYOUTS).play
    for step in catalogue.STEPS:
        for seed in range(20):
            play.take(step, **almost(play.site, play.system, step, Random(seed).randrange))
    assert play.tried.total() >= 20 * len(catalogue.STEPS)


QUICK = 10
FAULTS = {
    "kernel.first_loop.take_standing: update begun=True": ("a_unit_knows_only_what_was_sent", 10),
    "kernel.restarts.restart_centre: update claimed={}": ("a_holder_is_an_open_run", 20),
    "kernel.claims.end_claims: union centre.claimed": ("physical_occupancy_is_recorded", 70),
}
"""For each fault the claim that it breaks, and how many steps its counterexample has at the most."""


@pytest.mark.slow
@pytest.mark.parametrize("fault", FAULTS)
def test_a_planted_fault_is_found_and_shrunk(fault: str) -> None:
    trace = hunted(with_fault(AtTheTinyStation, fault))
    assert trace is not None
    claim, most = FAULTS[fault]
    print(f"{fault}: {len(trace.events)} steps")
    assert claim in trace.violated
    assert len(trace.events) <= most
    assert trace.planted == fault
    assert reproduced(trace) == trace.violated
    if len(trace.events) <= QUICK:
        assert hunted(with_fault(AtTheTinyStation, fault)) == trace, "the same each time"


def reproduced(trace: Trace) -> tuple[str, ...]:
    """What a trace comes to when it is written, read and replayed; the sound kernel breaks nothing on it."""
    again = parse("a trace", text_of(trace))
    assert again == trace
    assert isinstance(again, Trace)
    imported = load(TINY)
    assert not replay(replace(again, planted=None), imported).reproduced
    return replay(again, imported).violated


def test_jolts_land_only_where_all_that_is_claimed_holds_and_break_nothing() -> None:
    """From any state in which everything is claimed rightly, on a legal layout, the sound kernel breaks nothing."""
    landed = changed = 0
    for seed in range(6):
        going = jolted_walk(place_on(LAYOUTS[seed % len(LAYOUTS)], seed=seed), {}, Random(seed))
        assert is_legal(going.play.site)
        assert judged(going.play.site, going.play.system) == ()
        landed += going.landed
        changed += going.play.accepted.total()
    assert landed >= 100
    assert changed >= 100


def test_jolts_find_what_no_short_run_leads_to() -> None:
    """A unit that says it has stopped though it has not: the message that would show it is not sent otherwise.

    Of walks from drawn seeds about one in twenty comes upon it.
    """
    sources = planted("kernel.authority.tells_stopped: and-operand order.stopped")
    with pytest.raises(Broken, match="what_has_stopped_does_not_slip"):
        jolted_walks(60, sources)


def jolted_walks(walks: int, sources: Sources) -> None:
    for seed in range(walks):
        jolted_walk(place_on(LAYOUTS[seed % len(LAYOUTS)], seed=seed), sources, Random(seed))
