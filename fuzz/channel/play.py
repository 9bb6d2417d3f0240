"""One run of the channel: machines talk, threats strike, and after each step every claim on the link is asked (T11)."""

from __future__ import annotations

import hashlib
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field
from random import Random
from typing import Any

from fuzz.channel.threats import Rates
from kernel.link import LAST_SEQUENCE, Arrived, Code, Content, Life, Limits, Outcome, Party, Telegram, begin, judge
from models.link import End, Site, System
from proofs.onboard.link import THEORY

PARTIES = (Party("centre"), Party("unit 7"), Party("unit 8"))
PAIRS = tuple((me, peer) for me in PARTIES for peer in PARTIES if PARTIES[0] in (me, peer) and me != peer)
LIMITS = Limits(fresh_ms=2_000, silence_ms=5_000, offset_ms=50)
"""As the unit's: two seconds fresh, five seconds of silence, clocks within 50 ms."""
SITE = Site(LIMITS)
START_MS = 10_000
CONTENTS = tuple(Content(f"{number:02x}") for number in range(4))
STEPS = 120
"""A run: claims look at every pair of telegrams, so that a longer one costs by the square."""
LONG_WAIT_MS = 20_000
WRONG_MS = 10_000
KINDS = tuple(THEORY.steps)
NO_OUTCOME = len(Outcome)
OUTCOMES = tuple(Outcome)


@dataclass
class Run:
    """What a run came to."""

    steps: int = 0
    changed: int = 0
    struck: Counter[str] = field(default_factory=Counter)
    covered: Counter[int] = field(default_factory=Counter)
    pairs: Counter[int] = field(default_factory=Counter)
    events: list[tuple[str, Mapping[str, Any]]] = field(default_factory=list)
    violated: tuple[str, ...] = ()
    states: set[int] = field(default_factory=set)


class Channel:
    """Four ends of two links; everything sent is kept, as the air would."""

    def __init__(self, random: Random, rates: Rates) -> None:
        self.random, self.rates, self.run = random, rates, Run()
        ends = {pair: End(begin(*pair, Life(1), START_MS), START_MS) for pair in PAIRS}
        self.system = System(START_MS, ends, {}, {}, 0, {})
        self.before = -1

    def played(self) -> Run:
        """Play until a claim is false, or the run is over."""
        while len(self.run.events) < STEPS and not self.run.violated:
            self._something()
        return self.run

    def take(self, step: str, **event: Any) -> None:
        """Take a step, and ask every claim."""
        if self.run.violated:
            return
        outcome = self._outcome(step, event)
        after = THEORY.steps[step](SITE, self.system, **event)
        changed = after != self.system
        self.system = after
        self.run.events.append((step, event))
        self.run.steps += 1
        self.run.changed += changed
        number = tuple_id(KINDS.index(step), outcome, changed)
        self.run.covered[number] += 1
        if self.before >= 0:
            self.run.pairs[self.before * TUPLES + number] += 1
        self.before = number
        if changed:
            self.run.states.add(state_hash(after))
            self.run.violated = tuple(
                name for name, holds in THEORY.invariants.items() if not _told(holds, self.system)
            )[:1]

    def _outcome(self, step: str, event: Mapping[str, Any]) -> int:
        if step != "arrive" or (event["me"], event["peer"]) not in self.system.ends:
            return NO_OUTCOME
        link = self.system.ends[event["me"], event["peer"]].link
        found = judge(LIMITS, link, event["arrived"], event["reading_ms"])
        return OUTCOMES.index(found)

    def _strikes(self, threat: str) -> bool:
        struck = self.rates.strikes(threat, self.random)
        self.run.struck[threat] += struck
        return struck

    def _something(self) -> None:
        """A telegram's way; between, what machines, clocks and strangers do."""
        random = self.random
        me, peer = random.choice(PAIRS)
        if self._strikes("restart"):
            life = Life(self.system.ends[me, peer].link.life + random.choice((0, 1, 1, 2)))
            self.take("restart", me=me, peer=peer, life=life, reading_ms=self._reading())
        if self._strikes("insertion"):
            self._arrives(self._forged(me, peer), me, peer, authentic=False)
        if random.random() < 0.7:
            self._sends(me, peer)
        if random.random() < 0.4:
            self.take("look", me=me, peer=peer, reading_ms=self._reading())
        self.take("pass_time", now_ms=self.system.now_ms + self._wait_ms())

    def _wait_ms(self) -> int:
        if self._strikes("delay"):
            return self.random.choice((LIMITS.fresh_ms, LIMITS.silence_ms, self.random.randint(0, LONG_WAIT_MS)))
        return self.random.randint(0, 400)

    def _reading(self) -> int:
        """A clock's reading, within its bound."""
        off = self.random.randint(-LIMITS.offset_ms, LIMITS.offset_ms) if self._strikes("receiver's clock") else 0
        return self.system.now_ms + off

    def _stamp(self) -> int:
        """What the sender's clock shows."""
        off = self.random.randint(-WRONG_MS, WRONG_MS) if self._strikes("sender's clock") else 0
        return self._reading() + off

    def _sends(self, me: Party, peer: Party) -> None:
        """The next telegram, and its way to the other end, if it arrives."""
        link = self.system.ends[me, peer].link
        knows = link.peer_life is not None
        telegram = Telegram(
            sender=me,
            receiver=peer,
            greeting=not knows,
            sender_life=link.life,
            receiver_life=link.peer_life if link.peer_life is not None else Life(0),
            sequence=link.sent + 1,
            sent_at_ms=self._stamp(),
            content=self.random.choice(CONTENTS),
        )
        self.take("send", me=me, peer=peer, telegram=telegram)
        if self._strikes("deletion"):
            return
        if self._strikes("delay"):
            self.take("pass_time", now_ms=self.system.now_ms + self._wait_ms())
        self._on_the_way(telegram, peer, me)

    def _on_the_way(self, telegram: Telegram, me: Party, peer: Party) -> None:
        random, sent = self.random, sorted(self.system.sent)
        if self._strikes("resequencing") and sent:
            self._arrives(random.choice(sent), me, peer)
        if self._strikes("stale session") and sent:
            oldest = min(each.sender_life for each in sent)
            self._arrives(random.choice([each for each in sent if each.sender_life == oldest]), me, peer)
        if self._strikes("masquerade"):
            self._arrives(telegram, *random.choice(PAIRS))
        if self._strikes("corruption"):
            self._arrives(self._changed(telegram), me, peer, authentic=False)
        else:
            self._arrives(telegram, me, peer)
        if self._strikes("repetition"):
            self._arrives(telegram, me, peer)

    def _arrives(self, telegram: Telegram, me: Party, peer: Party, authentic: bool = True) -> None:
        reading_ms = self._reading()
        arrived = Arrived(telegram, Code("5a" if authentic else "a5"), Code("5a"))
        self.take("arrive", me=me, peer=peer, arrived=arrived, reading_ms=reading_ms)

    def _changed(self, telegram: Telegram) -> Telegram:
        """One field arrives changed."""
        random = self.random
        change: dict[str, Any] = random.choice(
            (
                {"sender": random.choice(PARTIES)},
                {"receiver": random.choice(PARTIES)},
                {"greeting": not telegram.greeting},
                {"sender_life": Life(telegram.sender_life + random.choice((-1, 1)))},
                {"receiver_life": Life(telegram.receiver_life + random.choice((-1, 1)))},
                {"sequence": random.choice((0, telegram.sequence + 1, LAST_SEQUENCE))},
                {"sent_at_ms": self.system.now_ms + random.randint(-9_000, 9_000)},
                {"content": random.choice(CONTENTS)},
            )
        )
        return telegram._replace(**change)

    def _forged(self, me: Party, peer: Party) -> Telegram:
        """What a stranger would like to be believed: as if the peer had sent it, next in turn."""
        link = self.system.ends[me, peer].link
        life = link.peer_life if link.peer_life is not None else Life(1)
        number = link.newest.sequence if link.newest is not None else 0
        return Telegram(peer, me, False, life, link.life, number + 1, self.system.now_ms, self.random.choice(CONTENTS))


TUPLES = len(KINDS) * (len(Outcome) + 1) * 2


def tuple_id(kind: int, outcome: int, changed: bool) -> int:
    """The number of a tuple: the step, what became of the telegram, and whether anything changed."""
    return (kind * (len(Outcome) + 1) + outcome) * 2 + changed


def described(number: int) -> str:
    """A tuple in words."""
    rest, changed = divmod(number, 2)
    kind, outcome = divmod(rest, len(Outcome) + 1)
    became = "" if outcome == NO_OUTCOME else f", {OUTCOMES[outcome].value}"
    return f"{KINDS[kind]}{became}: {'changed' if changed else 'nothing changed'}"


def state_hash(system: System) -> int:
    """A number of 64 bits for a state, the same in every process."""
    return int.from_bytes(hashlib.blake2b(repr(system).encode(), digest_size=8).digest(), "big")


def _told(holds: Any, system: System) -> bool:
    """What a claim says of a state; a lookup that fails is a claim that does."""
    try:
        return bool(holds(SITE, system))
    except KeyError:
        return False
