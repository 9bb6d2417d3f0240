"""The links of a simulated line: only what was sent is delivered, whatever the air and a stranger do.

The planted faults leave a check of the kernel's link out, or spoil a message; an oracle must see each of them.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from kernel import link as kernel_link
from kernel.link import Arrived, Life, Limits, Link, Outcome, Party, Telegram
from kernel.machine.centre import NO_ROUTE
from kernel.names import Block, Point, Position, Read, Route, Run, Serial, Tag, Train, UnitLife
from kernel.telegram import KEY_BYTES, Rejection, Said, content_of, decode, encode
from models.simulation import links as ends
from models.simulation.faults import BY_NAME, NO_FAULT, Chosen, Setting
from models.simulation.links import CENTRE, LIFE_SIGN_S, LIMITS, Addresses, Links, edition_of, key_by
from models.simulation.posted import ONLY_WHAT_WAS_SENT, SILENCE
from models.simulation.simulation import Simulation
from models.simulation.wording import Fields, Wording, was_sent
from tests.simulation.lines import plan

RADIO = ("loss", "delay", "repetition", "corruption", "forgery", "replay")
OFTEN: Chosen = {
    f"radio_{name}": Setting(0.1, BY_NAME[f"radio_{name}"].least, BY_NAME[f"radio_{name}"].most) for name in RADIO
}
REFUSED = {
    Rejection.NOT_CORRECTABLE.value,
    Outcome.NOT_AUTHENTIC.value,
    Outcome.OTHER_SENDER.value,
    Outcome.OTHER_SESSION.value,
    Outcome.REPEATED.value,
    Outcome.TOO_OLD.value,
}


def line(chosen: Chosen, seed: int = 1, hours: float = 0.15) -> Simulation:
    """Two trains and all their links."""
    return Simulation(plan("passing_station", seed=seed, trains=2, hours=hours, chosen=chosen))


def broken(sim: Simulation) -> set[str]:
    return {each.oracle for each in sim.oracles.found}


# ---- what is delivered


@settings(max_examples=8, deadline=None)
@given(seed=st.integers(0, 2**31 - 1), rates=st.fixed_dictionaries({name: st.floats(0, 0.3) for name in OFTEN}))
def test_only_what_was_sent_is_delivered_and_acted_on(seed: int, rates: Mapping[str, float]) -> None:
    chosen = {name: replace(setting, rate=rates[name]) for name, setting in OFTEN.items()}
    restarts = {"unit_restart": Setting(0, 0, 0, (90.0, 200.0)), "terminal_restart": Setting(0, 0, 0, (91.0, 202.0))}
    sim = line({**chosen, **restarts, "centre_restart": Setting(0, 0, 0, (300.0,))}, seed)
    act, acted = sim.links.acts, list[str]()

    def acts(me: Party, peer: Party, kind: str, fields: Fields) -> None:
        assert was_sent(sim.play.system.radio, kind, fields)
        acted.append(kind)
        act(me, peer, kind, fields)

    sim.links.acts = acts
    sim.run()
    assert not sim.oracles.found
    assert len(acted) > 10
    assert sim.oracles.checked[ONLY_WHAT_WAS_SENT] == sim.links.outcomes[Outcome.DELIVERED.value] > 100
    assert sim.oracles.checked[SILENCE] > 100


def test_every_threat_comes_and_is_refused_for_what_it_is() -> None:
    sim = line({**OFTEN, "unit_restart": Setting(0, 0, 0, (90.0, 200.0))}, hours=0.3)
    sim.run()
    assert not sim.oracles.found
    assert set(sim.links.outcomes) >= REFUSED
    assert sim.links.mended > 10
    assert all(sim.air.seen[name] > 10 for name in OFTEN)
    told = [event.text for event in sim.diary.events if event.kind == "radio"]
    for trick in ("made with another key", "thrown back", "taken to another machine", "from the past"):
        assert any(trick in text for text in told)


def test_without_faults_all_is_delivered_but_greetings() -> None:
    sim = line(NO_FAULT)
    sim.run()
    assert set(sim.links.outcomes) == {Outcome.DELIVERED.value, Outcome.OTHER_SESSION.value}
    pairs = {frozenset(pair) for pair in sim.links._ends}
    assert sim.links.outcomes[Outcome.OTHER_SESSION.value] <= 2 * len(pairs)
    assert sum(sim.links.outcomes.values()) >= sim.air.sent - 2 * len(pairs)
    assert max(sim.links.unheard_s.values()) <= 2 * LIFE_SIGN_S
    assert any(party.startswith("point") for pair in pairs for party in pair)


@pytest.mark.parametrize("fault", ["unit_restart", "centre_restart", "terminal_restart"])
def test_a_restart_begins_a_new_life_of_the_links(fault: str) -> None:
    sim = line({fault: Setting(0, 0, 0, (200.0, 320.0))}, hours=0.12)
    lives: dict[tuple[Party, Party], list[int]] = {}
    restarted: list[Party] = []

    def look(now: Simulation) -> None:
        for pair, link in now.links._ends.items():
            if link.life not in lives.setdefault(pair, []):
                lives[pair].append(link.life)

    def watch(step: str, event: Mapping[str, Any], system: Any) -> None:
        party = sim.addresses.restarted(step, event)
        restarted.extend([] if party is None else [party])

    sim.watchers.append(watch)
    sim.run(look)
    assert not sim.oracles.found
    assert sim.diary.faults[fault] == 2
    for (me, _), seen in lives.items():
        assert seen == sorted(seen)
        assert seen[-1] <= 1 + restarted.count(me)
    for party in restarted:
        units = [seen for (me, peer), seen in lives.items() if me == party and CENTRE in (me, peer)]
        assert all(seen[-1] == 1 + restarted.count(party) for seen in units)
    assert sum(each.phase.name != "LOST" for each in sim.services.values()) > 0


def test_an_outage_is_told_as_silence_and_ends() -> None:
    sim = line({"radio_outage": Setting(0, 60, 60, (120.0,))})
    sim.run()
    assert not sim.oracles.found
    told = [(event.at_ms, event.text) for event in sim.diary.events if event.kind == "radio"]
    assert [text for _, text in told] == ["is not heard by the centre", "is heard by the centre again"]
    assert 120_000 + LIMITS.silence_ms - 1_000 * LIFE_SIGN_S <= told[0][0] <= 160_000
    assert told[1][0] <= 200_000
    assert 30 <= max(sim.links.unheard_s.values()) <= 60


# ---- names: numbers stand for others after works


def test_what_is_said_with_other_names_is_not_authentic() -> None:
    """Works make one block more, and a number that a machine with the plan of before tells stands for another one."""
    site = line(NO_FAULT).play.site
    layout = site.layout
    trains, points, roads = sorted(layout.fleet), sorted(layout.points), ["Mill Road"]
    more = replace(site, layout=replace(layout, blocks=layout.blocks | {Block("a siding")}))
    before, now = Wording(site), Wording(more)
    block = {"run": Run(Serial(1), trains[0], UnitLife(1), NO_ROUTE), "block": max(layout.blocks)}
    read = Read(*min(site.records.record.items()))
    said = before.written("tail report", {**block, "left": read, "entered": read})
    told = now.read(said)
    assert told is not None
    assert told[1]["block"] != block["block"]
    addresses, key = Addresses(trains, points, roads), bytes(KEY_BYTES)
    ours, theirs = (key_by(edition_of(addresses, wording), key) for wording in (now, before))
    content = content_of(said)
    assert isinstance(content, str)
    raw = encode(theirs, Telegram(addresses.unit[trains[0]], CENTRE, False, Life(1), Life(1), 1, 0, content))
    assert isinstance(raw, bytes)
    arrived = [decode(each, raw) for each in (theirs, ours)]
    assert [each.code == each.expected for each in arrived if isinstance(each, Arrived)] == [True, False]


def test_every_sort_of_name_has_its_part_in_the_edition() -> None:
    site = line(NO_FAULT).play.site
    layout = site.layout
    trains, points, roads = sorted(layout.fleet), sorted(layout.points), ["Mill Road"]
    point = Point("a trap")
    route = Route("a way to a siding")
    another = [
        replace(layout, fleet=layout.fleet | {Train("a train")}),
        replace(layout, routes=layout.routes | {route}),
        replace(layout, blocks=layout.blocks | {Block("a siding")}),
        replace(layout, tag_in=dict(layout.tag_in.items()) | {Tag("a tag"): min(layout.blocks)}),
        replace(layout, points=layout.points | {point}),
        replace(layout, needs=dict(layout.needs.items()) | {route: {min(layout.points): Position("a1-b1")}}),
    ]
    wordings = [Wording(site), *(Wording(replace(site, layout=each)) for each in another)]
    addresses = [
        Addresses([*trains, Train("a train")], points, roads),
        Addresses(trains, [*points, point], roads),
        Addresses(trains, points, []),
    ]
    ours = Addresses(trains, points, roads)
    editions = [*(edition_of(ours, each) for each in wordings), *(edition_of(each, wordings[0]) for each in addresses)]
    assert len(set(editions)) == len(editions) == 1 + len(another) + len(addresses)
    assert edition_of(Addresses(trains[::-1], points[::-1], roads), Wording(site)) == editions[0]


# ---- planted faults: an oracle sees each


def lax(dropped: Outcome) -> Any:
    """A judge that delivers what it should refuse for one reason."""

    def judge(limits: Limits, link: Link, arrived: Arrived, now_ms: int) -> Outcome:
        found = kernel_link.judge(limits, link, arrived, now_ms)
        return Outcome.DELIVERED if found is dropped else found

    return judge


@pytest.mark.parametrize(
    ("dropped", "fault"),
    [
        (Outcome.REPEATED, {"radio_repetition": Setting(0.3, 1, 1.5)}),
        (Outcome.TOO_OLD, {"radio_delay": Setting(0.3, 3, 4)}),
        (Outcome.OTHER_SENDER, {"radio_forgery": Setting(0.3, 0, 0)}),
        (
            Outcome.OTHER_SESSION,
            {"radio_repetition": Setting(1.0, 1, 1.5), "unit_restart": Setting(0, 0, 0, tuple(range(50, 500, 10)))},
        ),
    ],
)
def test_a_check_that_is_left_out_is_noticed(monkeypatch: pytest.MonkeyPatch, dropped: Outcome, fault: Chosen) -> None:
    monkeypatch.setattr(ends, "judge", lax(dropped))
    sim = line(fault)
    sim.run()
    assert broken(sim) == {ONLY_WHAT_WAS_SENT}


def test_a_code_of_authentication_that_is_not_looked_at_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("kernel.link.is_authentic", lambda _arrived: True)
    sim = line({"radio_forgery": Setting(0.3, 0, 0)})
    sim.run()
    assert broken(sim) == {ONLY_WHAT_WAS_SENT}


def test_a_restart_that_begins_no_new_life_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    def after(links: Links, step: str, event: Mapping[str, Any], system: Any) -> None:
        party = links.addresses.restarted(step, event)
        links._ends = {pair: link for pair, link in links._ends.items() if pair[0] != party}

    monkeypatch.setattr(Links, "after", after)
    again = {"radio_repetition": Setting(1.0, 1, 1.5), "unit_restart": Setting(0, 0, 0, tuple(range(50, 500, 10)))}
    sim = line(again)
    sim.run()
    assert broken(sim) == {ONLY_WHAT_WAS_SENT}


def test_a_message_that_is_read_wrongly_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    read = Wording.read

    def wrongly(wording: Wording, said: Said) -> tuple[str, Fields] | None:
        found = read(wording, said)
        if found is None or "epoch" not in found[1]:
            return found
        return found[0], {**found[1], "epoch": found[1]["epoch"] + 1}

    monkeypatch.setattr(Wording, "read", wrongly)
    sim = line(NO_FAULT)
    sim.run()
    assert broken(sim) == {ONLY_WHAT_WAS_SENT}


def test_a_message_that_is_written_wrongly_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    written = Wording.written
    monkeypatch.setattr(
        Wording,
        "written",
        lambda wording, kind, fields: written(wording, "permit" if kind == "offer" else kind, fields),
    )
    sim = line(NO_FAULT)
    sim.run()
    assert broken(sim) == {ONLY_WHAT_WAS_SENT}


def test_a_silence_that_is_not_noticed_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(ends, "is_silent", lambda _limits, _link, _now_ms: False)
    sim = line({"radio_outage": Setting(0, 60, 60, (120.0,))})
    sim.run()
    assert broken(sim) == {SILENCE}


# ---- bits turned round


def test_a_damaged_telegram_is_mended_or_refused_and_never_another() -> None:
    sim = line({"radio_corruption": Setting(1.0, 1, 1)})
    sim.run()
    assert not sim.oracles.found
    assert sim.links.mended == sum(sim.links.outcomes.values()) > 100
    sim = line({"radio_corruption": Setting(1.0, 200, 200)})
    sim.run()
    assert not sim.links.mended
    assert set(sim.links.outcomes) <= {Rejection.NOT_CORRECTABLE.value, Rejection.CRC_WRONG.value}
    assert {each.phase.name for each in sim.services.values()} == {"LOST"}
