"""Messages as bytes: each is read back as it was written, and nothing else is read."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from kernel.machine.centre import NO_ROUTE
from kernel.names import Position, Read, Run, Serial, UnitLife
from kernel.telegram import PAYLOAD_BYTES, Said, content_of, said_in
from models.simulation.faults import NO_FAULT
from models.simulation.parts import PART_BYTES
from models.simulation.simulation import Simulation
from models.simulation.wording import KINDS, NAMES, Wording, was_sent
from tests.simulation.lines import plan

SIM = Simulation(plan("junction", chosen=NO_FAULT))
SITE = SIM.play.site
WORDING = Wording(SITE)
LAYOUT = SITE.layout

LIVES = st.integers(0, 2**32 - 1)
RUNS = st.builds(
    Run,
    st.integers(0, 2**63 - 1).map(Serial),
    st.sampled_from(sorted(LAYOUT.fleet)),
    LIVES.map(UnitLife),
    st.sampled_from(sorted({*LAYOUT.routes, NO_ROUTE})),
)
READS = st.sampled_from(sorted(SITE.records.record.items())).map(lambda pair: Read(*pair))
LIES = sorted({Position("normal"), *(lies for needs in LAYOUT.needs.values() for lies in needs.values())})
FIELDS: dict[str, st.SearchStrategy[Any]] = {
    "run": RUNS,
    "train": st.sampled_from(sorted(LAYOUT.fleet)),
    "point": st.sampled_from(sorted(LAYOUT.points)),
    "position": st.sampled_from(LIES),
    "block": st.sampled_from(sorted(LAYOUT.blocks)),
    "blocks": st.frozensets(st.sampled_from(sorted(LAYOUT.blocks))),
    "left": READS,
    "entered": READS,
    "life": LIVES,
    "epoch": LIVES,
    "part": LIVES,
    "parts": LIVES,
    "text": st.binary(max_size=PART_BYTES),
    "at_ms": st.integers(0, 2**62),
    "way_mm": st.integers(-(2**40), 2**40),
    "speed_mm_s": st.integers(-100_000, 100_000),
    "is_coming": st.booleans(),
}
MESSAGES = st.sampled_from(NAMES).flatmap(
    lambda kind: st.tuples(st.just(kind), st.fixed_dictionaries({name: FIELDS[name] for name in KINDS[kind].fields}))
)


@given(MESSAGES)
def test_a_message_is_read_as_it_was_written_and_fits_into_a_telegram(message: tuple[str, Any]) -> None:
    said = WORDING.written(*message)
    assert len(said.payload) <= PAYLOAD_BYTES
    content = content_of(said)
    assert isinstance(content, str)
    assert said_in(content) == said
    assert WORDING.read(said) == message


@given(MESSAGES, MESSAGES)
def test_no_two_messages_are_written_alike(one: tuple[str, Any], other: tuple[str, Any]) -> None:
    assert (WORDING.written(*one) == WORDING.written(*other)) == (one == other)


@settings(max_examples=300)
@given(MESSAGES, st.data())
def test_what_is_changed_is_another_message_or_none(message: tuple[str, Any], data: st.DataObject) -> None:
    said = WORDING.written(*message)
    changed = data.draw(
        st.one_of(
            st.builds(Said, st.integers(0, 255), st.just(said.payload)),
            st.builds(Said, st.just(said.kind), st.binary(max_size=60)),
            st.integers(0, len(said.payload)).map(lambda at: Said(said.kind, said.payload[:at])),
            st.binary(min_size=1, max_size=3).map(lambda more: Said(said.kind, said.payload + more)),
        )
    )
    read = WORDING.read(changed)
    if changed != said:
        assert read != message
    assert read is None or WORDING.written(*read) == changed


@pytest.mark.parametrize("kind", [kind for kind in NAMES if KINDS[kind].sent_in])
def test_nothing_was_sent_at_first(kind: str) -> None:
    values = {
        "run": Run(Serial(1), min(LAYOUT.fleet), UnitLife(1), min(LAYOUT.routes)),
        "train": min(LAYOUT.fleet),
        "point": min(LAYOUT.points),
        "position": LIES[0],
        "block": min(LAYOUT.blocks),
        "blocks": frozenset({min(LAYOUT.blocks)}),
        "left": Read(*min(SITE.records.record.items())),
        "entered": Read(*max(SITE.records.record.items())),
        "life": 1,
        "epoch": 1,
        "part": 0,
        "parts": 1,
        "text": b"",
    }
    assert not was_sent(SIM.play.system.radio, kind, {name: values[name] for name in KINDS[kind].fields})
