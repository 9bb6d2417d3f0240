"""The radio link: its witnesses, its edges, and drawn worlds on bytes against a list kept by hand (T11)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, invariant, precondition, rule

from kernel.link import (
    LAST_SEQUENCE,
    Arrived,
    Content,
    Life,
    Limits,
    Link,
    Outcome,
    Party,
    Telegram,
    after_sending,
    begin,
    is_delivered,
    is_silent,
    judge,
    meet,
    note_time,
    take,
)
from kernel.telegram import Rejection, decode, encode, next_telegram
from models.link import End, Site, System
from proofs.onboard.link import THEORY
from proofs.onboard.witnesses import link as witnesses
from proofs.onboard.witnesses.link import forged, genuine
from proofs.onboard.witnesses.play import Play

CENTRE, UNIT, OTHER = Party("centre"), Party("unit-7"), Party("unit-8")
LIMITS = Limits(fresh_ms=400, silence_ms=1_000, offset_ms=30)
PAIRS = ((CENTRE, UNIT), (UNIT, CENTRE), (CENTRE, OTHER), (OTHER, CENTRE), (UNIT, OTHER), (OTHER, UNIT))
SAMPLE = Telegram(UNIT, CENTRE, False, Life(3), Life(8), 5, 10_000, Content("00"))
LINK = replace(begin(CENTRE, UNIT, Life(8), 9_990), peer_life=Life(3), newest=SAMPLE._replace(sequence=4))
HUGE = 2**70
SENT = "delivered_was_sent_by_that_sender_in_this_session"


@pytest.mark.parametrize("witness", witnesses.WITNESSES, ids=lambda witness: witness.__name__)
def test_a_witness_fires_what_it_is_there_for(monkeypatch: pytest.MonkeyPatch, witness: Callable[[], None]) -> None:
    assert "send" in fired(monkeypatch, witness)


def test_the_witnesses_fire_every_transition(monkeypatch: pytest.MonkeyPatch) -> None:
    assert {name for witness in witnesses.WITNESSES for name in fired(monkeypatch, witness)} == set(THEORY.steps)


def fired(monkeypatch: pytest.MonkeyPatch, witness: Callable[[], None]) -> set[str]:
    """Play a witness, and give the transitions that changed its state."""
    found: set[str] = set()
    step = Play.step

    def watched(play: Play[Site, System], name: str, **event: Any) -> System:
        before = play.system
        if step(play, name, **event) != before:
            found.add(name)
        return play.system

    with monkeypatch.context() as patched:
        patched.setattr(Play, "step", watched)
        witness()
    return found


# ---- at the edges


@pytest.mark.parametrize(
    ("change", "now_ms", "outcome"),
    [
        ({}, 10_000, Outcome.DELIVERED),
        ({}, 10_400, Outcome.DELIVERED),
        ({}, 10_401, Outcome.TOO_OLD),
        ({}, HUGE, Outcome.TOO_OLD),
        ({}, 9_990, Outcome.DELIVERED),
        ({}, 9_989, Outcome.CLOCK_WENT_BACK),
        ({}, -HUGE, Outcome.CLOCK_WENT_BACK),
        ({"sent_at_ms": 10_060}, 10_000, Outcome.DELIVERED),
        ({"sent_at_ms": 10_061}, 10_000, Outcome.FROM_THE_FUTURE),
        ({"sent_at_ms": HUGE}, 10_000, Outcome.FROM_THE_FUTURE),
        ({"sent_at_ms": -HUGE}, 10_000, Outcome.TOO_OLD),
        ({"sequence": 4}, 10_000, Outcome.REPEATED),
        ({"sequence": 0}, 10_000, Outcome.REPEATED),
        ({"sequence": -HUGE}, 10_000, Outcome.REPEATED),
        ({"sequence": LAST_SEQUENCE}, 10_000, Outcome.DELIVERED),
        ({"sender_life": Life(2)}, 10_000, Outcome.OTHER_SESSION),
        ({"sender_life": Life(4)}, 10_000, Outcome.DELIVERED),
        ({"sender_life": Life(4), "sequence": 1}, 10_000, Outcome.DELIVERED),
        ({"sender_life": Life(4), "sequence": 0}, 10_000, Outcome.REPEATED),
        ({"receiver_life": Life(7)}, 10_000, Outcome.OTHER_SESSION),
        ({"receiver_life": Life(9)}, 10_000, Outcome.OTHER_SESSION),
        ({"greeting": True}, 10_000, Outcome.OTHER_SESSION),
        ({"sender": OTHER}, 10_000, Outcome.OTHER_SENDER),
        ({"sender": CENTRE}, 10_000, Outcome.OTHER_SENDER),
        ({"receiver": OTHER}, 10_000, Outcome.OTHER_RECEIVER),
    ],
)
def test_what_becomes_of_a_telegram(change: dict[str, object], now_ms: int, outcome: Outcome) -> None:
    telegram = Telegram(**{**SAMPLE._asdict(), **change})
    assert judge(LIMITS, LINK, genuine(telegram), now_ms) == outcome
    assert judge(LIMITS, LINK, forged(telegram), now_ms) == Outcome.NOT_AUTHENTIC


def test_silence_begins_a_millisecond_after_its_limit() -> None:
    link = take(LIMITS, LINK, genuine(SAMPLE), 10_000)
    assert not is_silent(LIMITS, link, 11_000)
    assert is_silent(LIMITS, link, 11_001)
    assert is_silent(LIMITS, link, 9_999)
    assert is_silent(LIMITS, begin(CENTRE, UNIT, Life(9), 0), 0)
    assert is_silent(LIMITS, meet(link, Life(4)), 10_000)


def test_an_older_life_changes_nothing() -> None:
    assert meet(LINK, Life(3)) == LINK
    assert meet(LINK, Life(2)) == LINK


# ---- without a guard, a claim falls


def only_look_at(monkeypatch: pytest.MonkeyPatch, claim: str) -> None:
    """Let the witnesses look at one claim of the safety case alone."""
    monkeypatch.setattr(witnesses, "THEORY", replace(THEORY, invariants={claim: THEORY.safety[claim]}))


@pytest.mark.parametrize(
    ("dropped", "witness", "claim"),
    [
        (Outcome.REPEATED, witnesses.repetition_ends_in_refusal, "delivered_never_twice"),
        (Outcome.REPEATED, witnesses.resequencing_ends_in_refusal, "delivered_in_order"),
        (Outcome.OTHER_RECEIVER, witnesses.insertion_ends_in_refusal, SENT),
        (Outcome.OTHER_SENDER, witnesses.masquerade_ends_in_refusal, SENT),
        (Outcome.NOT_AUTHENTIC, witnesses.corruption_ends_in_refusal, SENT),
        (Outcome.OTHER_SESSION, witnesses.two_machines_find_each_other, SENT),
        (Outcome.OTHER_SESSION, witnesses.a_restarted_receiver_believes_nothing_old, SENT),
        (Outcome.TOO_OLD, witnesses.a_telegram_held_back_is_refused, "delivered_is_not_too_old"),
        (Outcome.CLOCK_WENT_BACK, witnesses.what_was_too_old_stays_so, "a_clock_set_back_makes_nothing_fresh"),
        (Outcome.FROM_THE_FUTURE, witnesses.a_fast_senders_clock_does_not_hide_silence, "silence_is_noticed"),
    ],
)
def test_a_claim_falls_without_the_guard(
    monkeypatch: pytest.MonkeyPatch, dropped: Outcome, witness: Callable[[], None], claim: str
) -> None:
    """Deliver what the guard would refuse, in the run that shows the refusal."""

    def lax(limits: Limits, link: Link, arrived: Arrived, now_ms: int) -> bool:
        return judge(limits, link, arrived, now_ms) in (Outcome.DELIVERED, dropped)

    only_look_at(monkeypatch, claim)
    monkeypatch.setattr("kernel.link.is_delivered", lax)
    monkeypatch.setattr("models.link.is_delivered", lax)
    with pytest.raises(AssertionError, match=f"link: {claim} does not hold"):
        witness()


def test_a_silence_that_is_not_noticed_is_a_broken_claim(monkeypatch: pytest.MonkeyPatch) -> None:
    only_look_at(monkeypatch, "silence_is_noticed")
    monkeypatch.setattr("models.link.is_silent", lambda _limits, _link, _now_ms: False)
    with pytest.raises(AssertionError, match="link: silence_is_noticed does not hold"):
        witnesses.silence_of_minutes_is_noticed()


def test_a_deletion_that_is_not_counted_is_a_broken_claim(monkeypatch: pytest.MonkeyPatch) -> None:
    def uncounted(limits: Limits, link: Link, arrived: Arrived, now_ms: int) -> Link:
        return replace(take(limits, link, arrived, now_ms), missed=0)

    only_look_at(monkeypatch, "deletion_is_noticed")
    monkeypatch.setattr("models.link.take", uncounted)
    with pytest.raises(AssertionError, match="link: deletion_is_noticed does not hold"):
        witnesses.deletion_is_counted_and_silence_noticed()


# ---- drawn worlds of the proof, in CPython

STAMPS = st.integers(-90, 90) | st.sampled_from((10_000, -10_000))
EVENTS = st.tuples(
    st.sampled_from(("send", "send", "arrive", "arrive", "arrive", "arrive", "look", "wait", "restart")),
    st.integers(0, 3),
    st.integers(0, 40),
    STAMPS,
    st.integers(0, 9),
)


@settings(max_examples=150, deadline=None)
@given(st.lists(EVENTS, min_size=5, max_size=60))
def test_every_claim_holds_in_drawn_worlds(events: list[tuple[str, int, int, int, int]]) -> None:
    ends = {pair: End(begin(*pair, Life(1), 0), 0) for pair in PAIRS[:4]}
    play = Play(THEORY, Site(LIMITS), System(0, ends, {}, {}, 0, {}))
    air: list[Telegram] = []
    for what, which, pick, off_ms, change in events:
        me, peer = PAIRS[which]
        now_ms, link = play.system.now_ms, play.system.ends[me, peer].link
        if what == "wait":
            play.step("pass_time", now_ms=now_ms + 7 * pick)
        elif what == "restart":
            life = Life(link.life + pick % 3)
            play.step("restart", me=me, peer=peer, life=life, reading_ms=now_ms + off_ms)
        elif what == "look":
            play.step("look", me=me, peer=peer, reading_ms=now_ms + off_ms)
        elif what == "send":
            telegram = next_telegram(link, now_ms + off_ms, Content("00"))
            assert telegram is not None
            air.append(telegram)
            play.step("send", me=me, peer=peer, telegram=telegram)
        elif air:
            telegram = air[-1 - pick % len(air)]
            telegram = telegram._replace(sequence=telegram.sequence + 1) if change == 0 else telegram
            reading_ms = now_ms + off_ms % 30
            arrived = forged(telegram) if change == 1 else genuine(telegram)
            play.step("arrive", me=me, peer=peer, arrived=arrived, reading_ms=reading_ms)


# ---- drawn channels on bytes


@dataclass
class Posted:
    """A telegram that was really sent: by whom to whom, in which lives, when, and who has had it."""

    raw: bytes
    me: Party
    peer: Party
    lives: tuple[int, int | None]
    at_ms: int
    clock_ms: int
    had: bool = False


@dataclass
class Machine:
    """What one end is known to be, beside its link: its life, and how far its clock is off."""

    life: int
    off_ms: int
    had: list[int] = field(default_factory=list)
    had_at_ms: int | None = None


def key_of(one: Party, other: Party) -> bytes:
    """The key of a pair of machines, the same at both ends."""
    return "+".join(sorted((one, other))).encode().ljust(16, b".")


class Channel(RuleBasedStateMachine):
    """Machines that talk over a channel with all seven threats, and a list of what was really posted.

    The list decides by itself what is lawful: sent by the peer, to this life, not had before, none
    sent later had before, not too old by true time.
    """

    def __init__(self) -> None:
        super().__init__()
        self.now_ms = 1_000_000
        self.post: list[Posted] = []
        self.links: dict[tuple[Party, Party], Link] = {}
        self.machines: dict[tuple[Party, Party], Machine] = {}

    @initialize(offs=st.lists(st.integers(-30, 30), min_size=len(PAIRS), max_size=len(PAIRS)))
    def begin(self, offs: list[int]) -> None:
        for pair, off_ms in zip(PAIRS, offs, strict=True):
            self.machines[pair] = Machine(life=1, off_ms=off_ms)
            self.links[pair] = begin(*pair, Life(1), self.clock_ms(pair))

    def clock_ms(self, pair: tuple[Party, Party]) -> int:
        return self.now_ms + self.machines[pair].off_ms

    @rule(pair=st.sampled_from(PAIRS[:4]), said=st.binary(min_size=1, max_size=4))
    def send(self, pair: tuple[Party, Party], said: bytes) -> None:
        link = self.links[pair]
        telegram = next_telegram(link, self.clock_ms(pair), Content(said.hex()))
        assert telegram is not None
        raw = encode(key_of(*pair), telegram)
        assert isinstance(raw, bytes)
        self.links[pair] = after_sending(link)
        lives = (link.life, None if link.peer_life is None else int(link.peer_life))
        self.post.append(Posted(raw, *pair, lives, self.now_ms, self.clock_ms(pair)))

    @rule(ms=st.sampled_from((1, 10, 60, 200, 341, 500, 1_100)))
    def wait(self, ms: int) -> None:
        self.now_ms += ms

    @rule(pair=st.sampled_from(PAIRS[:4]), off_ms=st.integers(-30, 30))
    def set_clock(self, pair: tuple[Party, Party], off_ms: int) -> None:
        self.machines[pair].off_ms = off_ms

    @rule(pair=st.sampled_from(PAIRS[:4]))
    def restart(self, pair: tuple[Party, Party]) -> None:
        machine = Machine(self.machines[pair].life + 1, self.machines[pair].off_ms)
        self.machines[pair] = machine
        self.links[pair] = begin(*pair, Life(machine.life), self.clock_ms(pair))

    @precondition(lambda self: self.post)
    @rule(drawn=st.data())
    def arrive(self, drawn: st.DataObject) -> None:
        """Late, repeated, out of order; mostly where it was sent to, now and then elsewhere or thrown back."""
        index = len(self.post) - 1 - drawn.draw(st.integers(0, min(5, len(self.post) - 1)))
        posted = self.post[index]
        elsewhere = drawn.draw(st.sampled_from((False, False, False, True)))
        pair = drawn.draw(st.sampled_from(PAIRS)) if elsewhere else (posted.peer, posted.me)
        raw = bytearray(posted.raw)
        for _ in range(drawn.draw(st.sampled_from((0, 0, 0, 1)))):
            raw[drawn.draw(st.integers(0, len(raw) - 1))] ^= drawn.draw(st.integers(1, 255))
        self.receive(pair, bytes(raw), index)

    @precondition(lambda self: self.post)
    @rule(drawn=st.data())
    def corrupt(self, drawn: st.DataObject) -> None:
        """So many errors that they are mended, found out, or taken for something else."""
        index = drawn.draw(st.integers(0, len(self.post) - 1))
        raw = bytearray(self.post[index].raw)
        for _ in range(drawn.draw(st.integers(2, 30))):
            raw[drawn.draw(st.integers(0, len(raw) - 1))] ^= drawn.draw(st.integers(1, 255))
        self.receive((self.post[index].peer, self.post[index].me), bytes(raw), index)

    @rule(pair=st.sampled_from(PAIRS), forger=st.sampled_from((b"no key of any pair", key_of(CENTRE, OTHER))))
    def forge(self, pair: tuple[Party, Party], forger: bytes) -> None:
        """The very telegram that would be believed, made with another key."""
        if forger == key_of(*pair):
            return
        link = self.links[pair]
        telegram = Telegram(link.peer, link.me, False, Life(99), link.life, LAST_SEQUENCE, link.clock_ms, Content("ff"))
        assert is_delivered(LIMITS, link, genuine(telegram), link.clock_ms)
        raw = encode(forger, telegram)
        assert isinstance(raw, bytes)
        self.receive(pair, raw, None)

    def receive(self, pair: tuple[Party, Party], raw: bytes, index: int | None) -> None:
        """Decode and take what comes, and compare with the list."""
        link, machine, clock_ms = self.links[pair], self.machines[pair], self.clock_ms(pair)
        arrived = decode(key_of(*pair), raw)
        if isinstance(arrived, Rejection) or judge(LIMITS, link, arrived, clock_ms) == Outcome.NOT_AUTHENTIC:
            self.links[pair] = note_time(link, clock_ms)
            assert isinstance(arrived, Rejection) or take(LIMITS, link, arrived, clock_ms) == self.links[pair]
            genuine = index is not None and {*pair} == {self.post[index].me, self.post[index].peer}
            assert not genuine or index is None or raw != self.post[index].raw
            return
        assert index is not None, "a forged telegram was taken for authentic"
        posted = self.post[index]
        assert encode(key_of(*pair), arrived.telegram) == posted.raw
        delivered = is_delivered(LIMITS, link, arrived, clock_ms)
        self.links[pair] = take(LIMITS, link, arrived, clock_ms)
        lawful = (
            pair == (posted.peer, posted.me)
            and posted.lives[1] == machine.life
            and not posted.had
            and all(earlier < index for earlier in machine.had)
        )
        if delivered:
            assert lawful
            assert self.now_ms - posted.at_ms <= LIMITS.fresh_ms + 2 * LIMITS.offset_ms
            posted.had = True
            machine.had.append(index)
            machine.had_at_ms = self.now_ms
        else:
            due = lawful and clock_ms >= link.clock_ms and clock_ms - posted.clock_ms <= LIMITS.fresh_ms
            newer = link.peer_life is not None and posted.lives[0] < link.peer_life
            assert not due or newer, "what was in order was refused"

    @invariant()
    def what_is_not_silent_was_heard_of_late(self) -> None:
        for pair, link in self.links.items():
            if not is_silent(LIMITS, link, self.clock_ms(pair)):
                had_at_ms = self.machines[pair].had_at_ms
                assert had_at_ms is not None
                assert self.now_ms - had_at_ms <= LIMITS.silence_ms + 4 * LIMITS.offset_ms


TestChannel = Channel.TestCase
TestChannel.settings = settings(max_examples=120, stateful_step_count=60, deadline=None)
