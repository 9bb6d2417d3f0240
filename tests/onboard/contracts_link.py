"""Contracts on the radio link for CrossHair (`make crosshair`): leading asserts assume, later ones claim."""

from __future__ import annotations

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
    after_sending,
    is_delivered,
    is_silent,
    judge,
    meet,
    newest_sequence,
    sends,
    take,
)

ME, PEER = Party("centre"), Party("unit-7")
LIMITS = Limits(fresh_ms=2_000, silence_ms=5_000, offset_ms=50)
NEWEST = Telegram(PEER, ME, False, Life(3), Life(8), 40, 9_000, Content("00"))
LINK = Link(me=ME, peer=PEER, life=Life(8), peer_life=Life(3), sent=7, newest=NEWEST, missed=0, clock_ms=9_500)


def telegram_of(sender_life: int, receiver_life: int, sequence: int, sent_at_ms: int, greeting: bool) -> Telegram:
    """A telegram from the peer."""
    return Telegram(PEER, ME, greeting, Life(sender_life), Life(receiver_life), sequence, sent_at_ms, Content("01"))


def genuine(telegram: Telegram) -> Arrived:
    """With the code that the key gives for it."""
    return Arrived(telegram, Code("a5"), Code("a5"))


def comes(telegram: Telegram, now_ms: int) -> bool:
    """Whether the link delivers it."""
    return is_delivered(LIMITS, LINK, genuine(telegram), now_ms)


def nothing_unauthentic_changes_more_than_the_clock(sender_life: int, sequence: int, now_ms: int) -> None:
    """Whatever a telegram without a valid code says (T11)."""
    assert isinstance(sender_life, int)
    telegram = telegram_of(sender_life, 8, sequence, now_ms, False)
    after = take(LIMITS, LINK, Arrived(telegram, Code("a5"), Code("a6")), now_ms)
    assert after.clock_ms == (now_ms if now_ms > 9_500 else 9_500)
    assert after.newest == NEWEST
    assert after.peer_life == 3
    assert after.sent == 7
    assert after.missed == 0


def what_is_delivered_is_newer_and_fresh(
    sender_life: int, receiver_life: int, sequence: int, sent_at_ms: int, now_ms: int, greeting: bool
) -> None:
    """The whole of the decision, said the other way round (T11)."""
    assert comes(telegram_of(sender_life, receiver_life, sequence, sent_at_ms, greeting), now_ms)
    age_ms = now_ms - sent_at_ms
    assert receiver_life == 8
    assert not greeting
    assert sender_life > 3 or (sender_life == 3 and sequence > 40)
    assert sequence >= 1
    assert now_ms >= 9_500
    assert -100 <= age_ms <= 2_000


def what_is_delivered_is_not_delivered_again(
    sender_life: int, sequence: int, sent_at_ms: int, now_ms: int, later_ms: int
) -> None:
    """Repeated at any moment (T11)."""
    assert comes(telegram_of(sender_life, 8, sequence, sent_at_ms, False), now_ms)
    telegram = telegram_of(sender_life, 8, sequence, sent_at_ms, False)
    after = take(LIMITS, LINK, genuine(telegram), now_ms)
    assert after.newest == telegram
    assert judge(LIMITS, after, genuine(telegram), later_ms) == Outcome.REPEATED


def a_gap_is_counted(sequence: int, now_ms: int) -> None:
    """As many as were passed over (T11)."""
    assert 41 <= sequence <= LAST_SEQUENCE
    assert 9_500 <= now_ms <= 11_000
    after = take(LIMITS, LINK, genuine(telegram_of(3, 8, sequence, 9_400, False)), now_ms)
    assert after.missed == sequence - 41
    assert newest_sequence(after) == sequence


def a_link_that_is_not_silent_heard_something_fresh(now_ms: int) -> None:
    """By its own clock, which has not gone back (T8, T11)."""
    assert not is_silent(LIMITS, LINK, now_ms)
    assert 9_500 <= now_ms <= 14_000


def a_life_never_goes_back(life: int) -> None:
    """A newer life begins a session, and only a newer one (T11)."""
    assert isinstance(life, int)
    after = meet(LINK, Life(life))
    assert after.peer_life == (life if life > 3 else 3)
    assert (after.newest is None) == (life > 3)
    assert after.sent == (0 if life > 3 else 7)


def numbers_go_up_by_one_and_stop(sent: int, sequence: int, sent_at_ms: int) -> None:
    """What a link sends has the next number, and never one beyond the last (T11)."""
    assert sent >= 0
    link = Link(me=PEER, peer=ME, life=Life(3), peer_life=Life(8), sent=sent, newest=None, missed=0, clock_ms=0)
    telegram = telegram_of(3, 8, sequence, sent_at_ms, False)
    assert sends(link, telegram) == (sequence == sent + 1 and sequence <= LAST_SEQUENCE)
    assert not sends(after_sending(link), telegram) or sequence == sent + 2
