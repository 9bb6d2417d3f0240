"""Both ends of every radio link: machines that write, send, judge and read telegrams as the kernel says (T8, T11).

Centre and units talk, units and point terminals, and units and crossings.  Each pair has its key, each machine its
clock and its life.  Whoever is greeted, or hears of a session that is over, answers with a life sign, so that the peer
knows its life.
"""

from __future__ import annotations

import hashlib
import hmac
import json
from collections import Counter
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import lru_cache
from random import Random
from typing import Any

from kernel.link import (
    Content,
    Life,
    Limits,
    Link,
    Outcome,
    Party,
    after_sending,
    begin,
    is_silent,
    judge,
    note_time,
    take,
)
from kernel.names import Point, Train
from kernel.telegram import KEY_BYTES, Rejection, content_of, decode, encode, next_telegram, said_in
from models.simulation.air import Air, Packet
from models.simulation.diary import RADIO, Diary
from models.simulation.posted import Post
from models.simulation.stranger import Stranger
from models.simulation.wording import LIFE_SIGN, Fields, Wording
from models.world.state import System

LIMITS = Limits(fresh_ms=2_000, silence_ms=20_000, offset_ms=50)
"""Two seconds fresh, so that what is held up is not believed; two life signs in a row may be lost."""
LIFE_SIGN_S = 5
"""So often centre and unit ask whether the other is silent, and say that they are there."""
SYNCHRONISED_MS = 60_000
"""A clock is set that often, to within the links' bound."""
REMEMBERED = 1_000
"""So many contents are remembered with what they say: life signs, and what is said until it is heard."""
CENTRE = Party("centre")

Acts = Callable[[Party, Party, str, Fields], object]
"""What a machine does with what its link has delivered: itself, who said it, and what."""


class Addresses:
    """The addresses of units, terminals and crossings, by number; names of a layout may be too long for them."""

    def __init__(self, trains: Iterable[Train], points: Iterable[Point], roads: Iterable[str]) -> None:
        self.unit: Mapping[Train, Party] = {
            train: Party(f"unit-{number:03}") for number, train in enumerate(sorted(trains), start=1)
        }
        self.terminal: Mapping[Point, Party] = {
            point: Party(f"point-{number:05}") for number, point in enumerate(sorted(points), start=1)
        }
        self.road: Mapping[str, Party] = {
            road: Party(f"crossing-{number:02}") for number, road in enumerate(sorted(roads), start=1)
        }
        self.numbered = tuple(self.unit), tuple(self.terminal), tuple(self.road)
        """What its numbers stand for, in their order: trains, points and roads."""
        self.train = {party: train for train, party in self.unit.items()}
        self.point = {party: point for point, party in self.terminal.items()}
        self._name_of_road = {party: road for road, party in self.road.items()}

    def name(self, party: Party) -> str:
        """The train, the point or the road behind an address, or the centre."""
        return self.train.get(party) or self.point.get(party) or self._name_of_road.get(party) or party

    def restarted(self, step: str, event: Mapping[str, Any]) -> Party | None:
        """The machine that restarts in a step of the world, if one does."""
        if step == "restart_unit":
            return self.unit[event["train"]]
        if step == "restart_terminal":
            return self.terminal[event["point"]]
        return CENTRE if step == "restart_centre" else None


def edition_of(addresses: Addresses, wording: Wording) -> bytes:
    """Tell one set of names from every other: what each number stands for that is an address or is said (T11)."""
    return hashlib.sha256(json.dumps([addresses.numbered, wording.numbered]).encode()).digest()


def key_by(edition: bytes, key: bytes) -> bytes:
    """The key of a pair of machines for an edition of names: with another one nothing is authentic (T11).

    Works change names, and with them numbers, while some machine still has the plan of before: a block, a point or a
    position that it tells would be taken for another.
    """
    return hmac.digest(key, edition, "sha256")


@dataclass
class Machine:
    """A machine at the radio: its life, from lasting memory, and its clock, which is set again and again."""

    random: Random
    life: int = 1
    off_ms: int = 0
    set_at_ms: int = -SYNCHRONISED_MS

    def clock_ms(self, now_ms: int) -> int:
        """What its clock shows; it began long before."""
        if now_ms - self.set_at_ms >= SYNCHRONISED_MS:
            self.set_at_ms = now_ms
            self.off_ms = self.random.randint(-LIMITS.offset_ms, LIMITS.offset_ms)
        return SYNCHRONISED_MS + now_ms + self.off_ms


class Links:
    """The ends of all links; ``outcomes`` counts what became of what arrived, ``mended`` what was damaged and is whole.

    ``acts``: told what is delivered.  ``unheard_s``: for how long who heard nothing of whom, of centre and units.
    """

    def __init__(self, air: Air, addresses: Addresses, wording: Wording, post: Post, diary: Diary, seed: int) -> None:
        self.air = air
        self.addresses = addresses
        self.wording = wording
        self.post = post
        self.diary = diary
        self.seed = seed
        self.edition = edition_of(addresses, wording)
        self.stranger = Stranger(air, Random(f"{seed} stranger"))
        self.acts: Acts = lambda me, peer, kind, fields: None
        self.outcomes: Counter[str] = Counter()
        self.mended = 0
        self.unheard_s: Counter[tuple[Party, Party]] = Counter()
        self._read = lru_cache(REMEMBERED)(self._message)
        self._ends: dict[tuple[Party, Party], Link] = {}
        self._machines: dict[Party, Machine] = {}
        self._keys: dict[tuple[Party, Party], bytes] = {}
        self._silent: set[tuple[Party, Party]] = set()

    # ---- machines

    def after(self, step: str, event: Mapping[str, Any], system: System) -> None:
        """A machine that restarts forgets all its links, and begins a new life of each."""
        party = self.addresses.restarted(step, event)
        if party is None:
            return
        machine = self._machine(party)
        machine.life += 1
        machine.set_at_ms = self._now_ms - SYNCHRONISED_MS
        self._ends = {pair: link for pair, link in self._ends.items() if pair[0] != party}
        self._silent = {pair for pair in self._silent if pair[0] != party}

    @property
    def _now_ms(self) -> int:
        return self.air.agenda.now_ms

    def _machine(self, party: Party) -> Machine:
        if party not in self._machines:
            self._machines[party] = Machine(Random(f"{self.seed} clock of {party}"))
        return self._machines[party]

    def clock_ms(self, party: Party) -> int:
        """What a machine's clock shows now."""
        return self._machine(party).clock_ms(self._now_ms)

    def _end(self, me: Party, peer: Party) -> Link:
        """A link as it is; one that was not used in this life has just begun."""
        if (me, peer) not in self._ends:
            self._ends[me, peer] = begin(me, peer, Life(self._machine(me).life), self.clock_ms(me))
        return self._ends[me, peer]

    def _key(self, me: Party, peer: Party) -> bytes:
        """The key of a pair of machines, the same at both ends if both have the same names."""
        if (me, peer) not in self._keys:
            drawn = Random(f"{self.seed} key of {sorted((me, peer))}").randbytes(KEY_BYTES)
            self._keys[me, peer] = self._keys[peer, me] = key_by(self.edition, drawn)
        return self._keys[me, peer]

    # ---- sending

    def say(self, me: Party, peer: Party, kind: str, **fields: Any) -> None:
        """Write a message and send it, as the next telegram of this link."""
        clock_ms = self.clock_ms(me)
        link = note_time(self._end(me, peer), clock_ms)
        content = content_of(self.wording.written(kind, fields))
        assert not isinstance(content, Rejection), content
        telegram = next_telegram(link, clock_ms, content)
        if telegram is None:
            return
        raw = encode(self._key(me, peer), telegram)
        assert not isinstance(raw, Rejection), raw
        self._ends[me, peer] = after_sending(link)
        packet = Packet(me, peer, raw, self.post.posted(me, peer, self._now_ms, kind, fields))
        self.air.carry(packet, self.arrives)
        for other in self.stranger.hears(packet):
            self.air.bring(other, self.arrives)

    # ---- what arrives

    def arrives(self, packet: Packet) -> None:
        """Bytes arrive: believe them or not, and act on what is delivered."""
        me, peer = packet.receiver, packet.sender
        clock_ms, link = self.clock_ms(me), self._end(me, peer)
        arrived = decode(self._key(me, peer), packet.raw)
        if isinstance(arrived, Rejection):
            self._ends[me, peer] = note_time(link, clock_ms)
            self._refused(packet, arrived.value)
            return
        self.mended += packet.damaged
        outcome = judge(LIMITS, link, arrived, clock_ms)
        self._ends[me, peer] = take(LIMITS, link, arrived, clock_ms)
        if outcome is not Outcome.DELIVERED:
            self._refused(packet, outcome.value)
            if outcome is Outcome.OTHER_SESSION:
                self.say(me, peer, LIFE_SIGN)
            return
        self.outcomes[outcome.value] += 1
        message = self._read(arrived.telegram.content)
        self.post.delivered(me, peer, self._now_ms, packet.origin, message)
        if message is not None and message[0] != LIFE_SIGN:
            self.acts(me, peer, *message)

    def _message(self, content: Content) -> tuple[str, Fields] | None:
        """What a content says; None if it is not written as any."""
        said = said_in(content)
        return None if isinstance(said, Rejection) else self.wording.read(said)

    def _refused(self, packet: Packet, why: str) -> None:
        self.outcomes[why] += 1
        if packet.trick:
            who = self.addresses.name(packet.receiver)
            self.diary.note(RADIO, who, f"refuses a telegram {packet.trick}: {why}")

    # ---- silence

    def look(self, train: Train) -> None:
        """Let centre and unit of a train ask whether the other is silent, and say that they are there.

        Silence is told and nothing is decided by it: the interlocking stays safe over any silence (T8).
        """
        unit = self.addresses.unit[train]
        for me, peer in ((CENTRE, unit), (unit, CENTRE)):
            clock_ms = self.clock_ms(me)
            link = self._end(me, peer)
            silent = is_silent(LIMITS, link, clock_ms)
            self.post.heard(me, peer, self._now_ms, silent)
            self.unheard_s[me, peer] += LIFE_SIGN_S * silent
            if me == CENTRE:
                self._tell_silence((me, peer), silent and link.newest is not None, silent)
            self.say(me, peer, LIFE_SIGN)

    def _tell_silence(self, pair: tuple[Party, Party], begins: bool, silent: bool) -> None:
        """Write down that the centre hears a unit no more, or again."""
        who = self.addresses.name(pair[1])
        if begins and pair not in self._silent:
            self._silent.add(pair)
            self.diary.note(RADIO, who, "is not heard by the centre")
        elif not silent and pair in self._silent:
            self._silent.remove(pair)
            self.diary.note(RADIO, who, "is heard by the centre again")
