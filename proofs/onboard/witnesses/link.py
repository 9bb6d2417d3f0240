"""Runs of the radio link: every transition, and how each of the seven threats to it ends (T11).

``centre`` and ``unit 7`` talk; ``unit 8`` talks to the centre as well.  A telegram is at most 2 s old
when it is delivered, a link is silent when the newest is older than 5 s, clocks err by up to 50 ms.
"""

from __future__ import annotations

from dataclasses import replace

from kernel.link import (
    LAST_SEQUENCE,
    Arrived,
    Code,
    Content,
    Life,
    Limits,
    Link,
    Outcome,
    Party,
    Telegram,
    begin,
    is_silent,
    judge,
    sends,
)
from models.link import End, Site, System
from proofs.onboard.link import THEORY
from proofs.onboard.witnesses.play import Play

CENTRE, UNIT, OTHER = Party("centre"), Party("unit-7"), Party("unit-8")
LIMITS = Limits(fresh_ms=2_000, silence_ms=5_000, offset_ms=50)
START_MS = 10_000
FIRST, SECOND, THIRD = Life(1), Life(2), Life(3)
OF_THE_KEY, OTHER_CODE = Code("5a"), Code("a5")
HELLO, GO, STOP = Content("00"), Content("01"), Content("02")


def genuine(telegram: Telegram) -> Arrived:
    """A telegram with the code that the key gives for it."""
    return Arrived(telegram, OF_THE_KEY, OF_THE_KEY)


def forged(telegram: Telegram) -> Arrived:
    """A telegram with another code."""
    return Arrived(telegram, OTHER_CODE, OF_THE_KEY)


class Radio:
    """A run, told in words of the radio."""

    def __init__(self) -> None:
        """Begin with four ends, each in its first life; nobody knows anybody."""
        pairs = ((CENTRE, UNIT), (UNIT, CENTRE), (CENTRE, OTHER), (OTHER, CENTRE))
        ends = {(me, peer): End(begin(me, peer, FIRST, START_MS), START_MS) for me, peer in pairs}
        self.play = Play(THEORY, Site(LIMITS), System(START_MS, ends, {}, {}, 0, {}))

    def link(self, me: Party, peer: Party) -> Link:
        """What an end remembers."""
        return self.play.system.ends[me, peer].link

    def wait(self, ms: int) -> None:
        """Let true time go on."""
        now_ms = self.play.system.now_ms + ms
        self.play.step("pass_time", now_ms=now_ms)
        assert self.play.system.now_ms == now_ms

    def send(self, me: Party, peer: Party, content: Content, fast_ms: int = 0) -> Telegram:
        """Send what comes next; the sender's clock is fast by so much."""
        link, system = self.link(me, peer), self.play.system
        knows = link.peer_life is not None
        telegram = Telegram(
            sender=me,
            receiver=peer,
            greeting=not knows,
            sender_life=link.life,
            receiver_life=link.peer_life if link.peer_life is not None else FIRST,
            sequence=link.sent + 1,
            sent_at_ms=system.now_ms + fast_ms,
            content=content,
        )
        self.play.step("send", me=me, peer=peer, telegram=telegram)
        assert self.play.system.sent[telegram] == system.now_ms
        assert self.link(me, peer).sent == link.sent + 1
        return telegram

    def arrive(self, me: Party, peer: Party, telegram: Telegram, fast_ms: int = 0) -> Outcome:
        """Let a telegram arrive as it was sent, at an end whose clock is fast by so much; say what becomes of it."""
        return self.comes(me, peer, genuine(telegram), fast_ms)

    def comes(self, me: Party, peer: Party, arrived: Arrived, fast_ms: int = 0) -> Outcome:
        """Let anything arrive, and say what becomes of it."""
        before, telegram = self.play.system, arrived.telegram
        reading_ms = before.now_ms + fast_ms
        outcome = judge(LIMITS, self.link(me, peer), arrived, reading_ms)
        self.play.step("arrive", me=me, peer=peer, arrived=arrived, reading_ms=reading_ms)
        after = self.play.system
        assert after.ends[me, peer].highest_ms >= reading_ms
        if outcome == Outcome.DELIVERED:
            assert after.turns == before.turns + 1
            assert after.delivered[telegram].at_ms == before.now_ms
            assert self.link(me, peer).newest == telegram
        else:
            assert after.delivered == before.delivered
        return outcome

    def trusts(self, me: Party, peer: Party, fast_ms: int = 0) -> bool:
        """Ask an end whether its peer is there; True if it does not count as silent."""
        before = self.play.system
        reading_ms = before.now_ms + fast_ms
        silent = is_silent(LIMITS, self.link(me, peer), reading_ms)
        self.play.step("look", me=me, peer=peer, reading_ms=reading_ms)
        trust = self.play.system.trusted.get((me, peer))
        assert silent or (trust is not None and trust.at_ms == before.now_ms)
        assert self.play.system.ends[me, peer].highest_ms >= reading_ms
        return not silent

    def restart(self, me: Party, peer: Party, life: Life) -> None:
        """Restart the machine at an end."""
        self.play.step("restart", me=me, peer=peer, life=life, reading_ms=self.play.system.now_ms)
        link = self.link(me, peer)
        assert (link.life, link.peer_life, link.sent, link.newest) == (life, None, 0, None)


def acquainted() -> Radio:
    """A run in which centre and unit 7 have heard each other, and each has had one telegram."""
    radio = Radio()
    hello = radio.send(CENTRE, UNIT, HELLO)
    assert hello.greeting
    assert radio.arrive(UNIT, CENTRE, hello) == Outcome.OTHER_SESSION
    assert radio.link(UNIT, CENTRE).peer_life == FIRST
    answer = radio.send(UNIT, CENTRE, HELLO)
    assert not answer.greeting
    assert answer.sequence == 1
    assert radio.arrive(CENTRE, UNIT, answer) == Outcome.DELIVERED
    order = radio.send(CENTRE, UNIT, GO)
    assert order.sequence == 1
    assert radio.arrive(UNIT, CENTRE, order) == Outcome.DELIVERED
    return radio


def two_machines_find_each_other() -> None:
    """A greeting tells a life and is not delivered; from then on telegrams are."""
    radio = acquainted()
    assert radio.play.system.turns == 2
    assert radio.link(UNIT, CENTRE).missed == 0
    assert radio.link(CENTRE, UNIT).missed == 0


def repetition_ends_in_refusal() -> None:
    """A telegram is transmitted several times, and delivered once."""
    radio = acquainted()
    order = radio.send(CENTRE, UNIT, GO)
    assert radio.arrive(UNIT, CENTRE, order) == Outcome.DELIVERED
    assert radio.arrive(UNIT, CENTRE, order) == Outcome.REPEATED
    radio.wait(1_000)
    assert radio.arrive(UNIT, CENTRE, order) == Outcome.REPEATED


def deletion_is_counted_and_silence_noticed() -> None:
    """One lost telegram shows at the next; if none comes, the link is silent."""
    radio = acquainted()
    radio.send(CENTRE, UNIT, STOP)
    radio.send(CENTRE, UNIT, STOP)
    order = radio.send(CENTRE, UNIT, GO)
    assert radio.arrive(UNIT, CENTRE, order) == Outcome.DELIVERED
    assert radio.link(UNIT, CENTRE).missed == 2
    radio.send(CENTRE, UNIT, STOP)
    assert radio.arrive(UNIT, CENTRE, radio.send(CENTRE, UNIT, GO)) == Outcome.DELIVERED
    assert radio.link(UNIT, CENTRE).missed == 3
    radio.wait(5_000)
    assert radio.trusts(UNIT, CENTRE)
    assert radio.trusts(CENTRE, UNIT)
    assert set(radio.play.system.trusted) == {(UNIT, CENTRE), (CENTRE, UNIT)}
    radio.wait(1)
    assert not radio.trusts(UNIT, CENTRE)


def insertion_ends_in_refusal() -> None:
    """A genuine telegram for another machine is refused, and tells nothing here."""
    radio = acquainted()
    radio.restart(CENTRE, OTHER, THIRD)
    radio.arrive(CENTRE, OTHER, radio.send(OTHER, CENTRE, HELLO))
    order = radio.send(CENTRE, OTHER, GO)
    assert radio.arrive(UNIT, CENTRE, order) == Outcome.OTHER_RECEIVER
    assert radio.link(UNIT, CENTRE).peer_life == FIRST
    assert radio.arrive(OTHER, CENTRE, order) == Outcome.DELIVERED


def resequencing_ends_in_refusal() -> None:
    """Of two telegrams that change places the one sent first is refused."""
    radio = acquainted()
    stop = radio.send(CENTRE, UNIT, STOP)
    go = radio.send(CENTRE, UNIT, GO)
    assert radio.arrive(UNIT, CENTRE, go) == Outcome.DELIVERED
    assert radio.arrive(UNIT, CENTRE, stop) == Outcome.REPEATED


def corruption_ends_in_refusal() -> None:
    """Another content has no valid code; what the error-correcting code mends is the telegram that was sent."""
    radio = acquainted()
    order = radio.send(CENTRE, UNIT, STOP)
    before = radio.play.system
    changed = order._replace(content=GO)
    radio.play.step("arrive", me=UNIT, peer=CENTRE, arrived=genuine(changed), reading_ms=before.now_ms)
    assert radio.play.system == before
    assert radio.comes(UNIT, CENTRE, forged(changed)) == Outcome.NOT_AUTHENTIC


def delay_ends_in_refusal() -> None:
    """A telegram is delivered when it is exactly as old as is permitted, and not a millisecond later."""
    radio = acquainted()
    order = radio.send(CENTRE, UNIT, GO)
    later = radio.send(CENTRE, UNIT, GO)
    radio.wait(2_000)
    assert radio.arrive(UNIT, CENTRE, order) == Outcome.DELIVERED
    radio.wait(1)
    assert radio.arrive(UNIT, CENTRE, later) == Outcome.TOO_OLD


def masquerade_ends_in_refusal() -> None:
    """A forged telegram, another machine's, and the own one thrown back are refused."""
    radio = acquainted()
    another = radio.send(CENTRE, UNIT, GO)._replace(sequence=99, sender_life=THIRD)
    radio.wait(1)
    before = radio.link(UNIT, CENTRE)
    assert radio.comes(UNIT, CENTRE, forged(another)) == Outcome.NOT_AUTHENTIC
    assert radio.link(UNIT, CENTRE) == replace(before, clock_ms=before.clock_ms + 1)
    own = radio.send(UNIT, CENTRE, HELLO)
    assert radio.arrive(UNIT, CENTRE, own) == Outcome.OTHER_SENDER
    radio.restart(OTHER, CENTRE, THIRD)
    assert radio.arrive(CENTRE, UNIT, radio.send(OTHER, CENTRE, HELLO)) == Outcome.OTHER_SENDER
    assert radio.link(CENTRE, UNIT).peer_life == FIRST


def a_restarted_receiver_believes_nothing_old() -> None:
    """What was sent to the life before is refused, fresh and undelivered as it is; then both go on."""
    radio = acquainted()
    order = radio.send(CENTRE, UNIT, GO)
    radio.restart(UNIT, CENTRE, SECOND)
    assert not radio.trusts(UNIT, CENTRE)
    assert radio.arrive(UNIT, CENTRE, order) == Outcome.OTHER_SESSION
    assert radio.link(UNIT, CENTRE).peer_life == FIRST
    assert radio.arrive(CENTRE, UNIT, radio.send(UNIT, CENTRE, HELLO)) == Outcome.DELIVERED
    assert radio.arrive(UNIT, CENTRE, radio.send(CENTRE, UNIT, GO)) == Outcome.DELIVERED
    assert radio.link(UNIT, CENTRE).missed == 0


def a_restarted_sender_ends_its_old_session() -> None:
    """After a telegram of the peer's new life one of its old life is refused, and the link was silent between."""
    radio = acquainted()
    order = radio.send(CENTRE, UNIT, GO)
    radio.restart(CENTRE, UNIT, SECOND)
    hello = radio.send(CENTRE, UNIT, HELLO)
    assert radio.trusts(UNIT, CENTRE)
    assert radio.arrive(UNIT, CENTRE, hello) == Outcome.OTHER_SESSION
    assert not radio.trusts(UNIT, CENTRE)
    assert radio.arrive(UNIT, CENTRE, order) == Outcome.OTHER_SESSION
    assert radio.link(UNIT, CENTRE).peer_life == SECOND
    assert radio.arrive(CENTRE, UNIT, radio.send(UNIT, CENTRE, HELLO)) == Outcome.DELIVERED
    first = radio.send(CENTRE, UNIT, GO)
    assert radio.arrive(UNIT, CENTRE, radio.send(CENTRE, UNIT, STOP)) == Outcome.DELIVERED
    assert radio.link(UNIT, CENTRE).missed == 1
    assert radio.arrive(UNIT, CENTRE, first) == Outcome.REPEATED
    assert radio.trusts(UNIT, CENTRE)


def a_life_does_not_come_again() -> None:
    """A machine that would restart in its own life, or an earlier one, does not begin: the world has no such step."""
    radio = acquainted()
    before = radio.play.system
    radio.play.step("restart", me=UNIT, peer=CENTRE, life=FIRST, reading_ms=before.now_ms)
    assert radio.play.system == before


def a_fast_senders_clock_is_found_out() -> None:
    """A stamp as far ahead as healthy clocks can be is believed; one further ahead is refused."""
    radio = acquainted()
    assert radio.arrive(UNIT, CENTRE, radio.send(CENTRE, UNIT, GO, fast_ms=100)) == Outcome.DELIVERED
    assert radio.arrive(UNIT, CENTRE, radio.send(CENTRE, UNIT, GO, fast_ms=101)) == Outcome.FROM_THE_FUTURE


def a_clock_that_goes_back_is_not_believed() -> None:
    """While the receiver's clock shows less than before, nothing is delivered and the link is silent."""
    radio = acquainted()
    assert radio.trusts(UNIT, CENTRE, fast_ms=50)
    order = radio.send(CENTRE, UNIT, GO)
    assert radio.arrive(UNIT, CENTRE, order, fast_ms=-50) == Outcome.CLOCK_WENT_BACK
    assert not radio.trusts(UNIT, CENTRE, fast_ms=-50)
    radio.wait(50)
    assert radio.arrive(UNIT, CENTRE, order) == Outcome.DELIVERED


def a_telegram_held_back_is_refused() -> None:
    """A telegram that is older than the bound and the clocks permit, by true time."""
    radio = acquainted()
    order = radio.send(CENTRE, UNIT, GO)
    radio.wait(2_101)
    assert radio.arrive(UNIT, CENTRE, order) == Outcome.TOO_OLD


def silence_of_minutes_is_noticed() -> None:
    """A link that has been quiet for two minutes counts as silent."""
    radio = acquainted()
    radio.wait(120_000)
    assert not radio.trusts(UNIT, CENTRE)


def a_fast_senders_clock_does_not_hide_silence() -> None:
    """A stamp a minute ahead, believed, would keep a link from counting as silent for that minute."""
    radio = acquainted()
    order = radio.send(CENTRE, UNIT, GO, fast_ms=60_000)
    before = radio.play.system.now_ms
    radio.play.step("arrive", me=UNIT, peer=CENTRE, arrived=genuine(order), reading_ms=before)
    radio.wait(5_201)
    assert not radio.trusts(UNIT, CENTRE)


def what_was_too_old_stays_so() -> None:
    """A telegram too old by one reading is not fresh by a later, lower one."""
    radio = acquainted()
    order = radio.send(CENTRE, UNIT, GO)
    radio.wait(2_000)
    assert radio.arrive(UNIT, CENTRE, order, fast_ms=1) == Outcome.TOO_OLD
    assert radio.arrive(UNIT, CENTRE, order) == Outcome.CLOCK_WENT_BACK


def clocks_may_err_by_their_whole_bound() -> None:
    """A fast sender and a slow receiver, and the other way round: what is in time is delivered."""
    radio = acquainted()
    radio.wait(100)
    order = radio.send(CENTRE, UNIT, GO, fast_ms=50)
    assert radio.arrive(UNIT, CENTRE, order, fast_ms=-50) == Outcome.DELIVERED
    assert radio.link(UNIT, CENTRE).clock_ms == radio.play.system.now_ms - 50
    order = radio.send(CENTRE, UNIT, GO, fast_ms=-50)
    radio.wait(1_900)
    assert radio.arrive(UNIT, CENTRE, order, fast_ms=50) == Outcome.DELIVERED
    assert radio.link(UNIT, CENTRE).clock_ms == radio.play.system.now_ms + 50


def the_last_number_is_the_last() -> None:
    """A link that has given its last number sends no more."""
    assert LAST_SEQUENCE == 4_294_967_295
    radio = acquainted()
    link = replace(radio.link(CENTRE, UNIT), sent=LAST_SEQUENCE - 1)
    last = radio.send(CENTRE, UNIT, GO)._replace(sequence=LAST_SEQUENCE)
    assert sends(link, last)
    assert not sends(replace(link, sent=LAST_SEQUENCE), last._replace(sequence=LAST_SEQUENCE + 1))
    assert not sends(replace(link, sent=LAST_SEQUENCE), last._replace(sequence=1))


WITNESSES = (
    two_machines_find_each_other,
    repetition_ends_in_refusal,
    deletion_is_counted_and_silence_noticed,
    insertion_ends_in_refusal,
    resequencing_ends_in_refusal,
    corruption_ends_in_refusal,
    delay_ends_in_refusal,
    masquerade_ends_in_refusal,
    a_restarted_receiver_believes_nothing_old,
    a_restarted_sender_ends_its_old_session,
    a_life_does_not_come_again,
    a_fast_senders_clock_is_found_out,
    a_clock_that_goes_back_is_not_believed,
    a_telegram_held_back_is_refused,
    silence_of_minutes_is_noticed,
    a_fast_senders_clock_does_not_hide_silence,
    what_was_too_old_stays_so,
    clocks_may_err_by_their_whole_bound,
    the_last_number_is_the_last,
)
