"""Planted faults are found: in a small world as a counterexample, and the five protocols as a run from a restart."""

from __future__ import annotations

from functools import cache

import pytest

from proofs import drawing
from proofs.catalogue import SAFETY
from proofs.counterexample import Answer, search
from proofs.finite import SMALL, World
from proofs.planted.fault import Fault
from proofs.planted.protocols import PROTOCOLS, Protocol
from proofs.planted.weakenings import TURNED_ASTRIDE, WEAKENINGS

FAULTS = [*WEAKENINGS, TURNED_ASTRIDE, *(protocol.fault for protocol in PROTOCOLS)]


@cache
def world(without: frozenset[str]) -> World:
    return World(SMALL, without)


@cache
def control(transition: str) -> Answer:
    return search(world(frozenset()), transition)


def named(fault: Fault | Protocol) -> str:
    return fault.name if isinstance(fault, Fault) else fault.fault.name


@pytest.mark.sampled(6)
@pytest.mark.parametrize("fault", FAULTS, ids=named)
def test_fault_is_refuted_in_a_small_world_where_the_kernel_is_not(fault: Fault) -> None:
    answer = search(world(fault.without), fault.transition, fault.sources)
    assert answer.found is not None
    assert answer.found.broken or answer.found.raised
    assert control(fault.transition).verdict == "none"


@pytest.mark.parametrize("protocol", PROTOCOLS, ids=named)
def test_protocol_breaks_a_safety_claim_on_a_run_from_a_restart(protocol: Protocol) -> None:
    trace = protocol.trace(protocol.fault.instead)
    assert protocol.broken in SAFETY
    assert trace.stopped is None
    assert protocol.broken in trace.broken
    assert all(protocol.broken not in move.broken for move in trace.moves[:-1])


@pytest.mark.parametrize("protocol", PROTOCOLS, ids=named)
def test_kernel_stops_the_same_run_at_the_step_named(protocol: Protocol) -> None:
    trace = protocol.trace({})
    assert trace.stopped is not None
    assert trace.stopped.transition == protocol.stopped_at
    assert not any(move.broken for move in trace.moves)


@pytest.mark.parametrize("protocol", [protocol for protocol in PROTOCOLS if protocol.half], ids=named)
def test_half_a_fault_is_stopped_by_the_other_half_of_the_kernel(protocol: Protocol) -> None:
    trace = protocol.trace(protocol.half)
    assert trace.stopped is not None
    assert trace.stopped.transition == protocol.half_stopped_at
    assert not any(move.broken for move in trace.moves)


@pytest.mark.parametrize("protocol", PROTOCOLS, ids=named)
def test_drawing_shows_the_claim_its_place_and_the_last_step(protocol: Protocol) -> None:
    trace = protocol.trace(protocol.fault.instead)
    text = drawing.trace_as_text(protocol.fault.name, protocol.fault.story, trace)
    page = drawing.trace_as_html(protocol.fault.name, protocol.fault.story, trace)
    for shown in (text, page):
        assert protocol.broken in shown
        assert "proofs/invariants/safety.py:" in shown
        assert trace.moves[-1].transition in shown
        assert f"reachable trace of {len(trace.moves)} steps" in shown.lower()
    assert page.count("<svg") == 3


def test_there_are_nineteen_weakenings_and_five_protocols() -> None:
    assert (len(WEAKENINGS), len(PROTOCOLS)) == (19, 5)
    assert len({fault.name for fault in FAULTS}) == len(FAULTS)
