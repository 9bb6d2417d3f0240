"""One end of a radio link (T11): what it sends, and whether it believes what arrives.

Machine of the centre, of units and of terminals alike.  A session is a life of the sender and a
life of the receiver; lives only grow, so a session that is over never returns, and within one the
numbers only grow.  The paper asks for numbers, an error-correcting code and repeated transmission
(000, 3.5.3); sender, lives, freshness and authentication are ours.

What arrives comes with the code that stood in it and the code that the own key gives for the same
bytes.  Whether they are equal is asked here and nowhere else, so that no host can hand in the answer.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import Enum
from typing import NamedTuple, NewType

Party = NewType("Party", str)
"""The address of a machine on the radio: the centre, a unit, a terminal; T11."""
Life = NewType("Life", int)
"""The time of a machine from one restart to the next, counted in lasting memory; T8, T11."""
Content = NewType("Content", str)
"""What a telegram says: its kind and payload, as ``kernel.telegram`` writes them; T11."""
Code = NewType("Code", str)
"""A code of authentication, hexadecimal, as ``kernel.telegram`` makes it; T11."""

LAST_SEQUENCE = 2**32 - 1
"""The greatest number of a telegram in a session; a link at it sends no more until a restart (T11, ours)."""


class Telegram(NamedTuple):
    """A telegram, as it is sent and as it is read (T11).

    ``greeting``: the sender does not know the receiver's life; tells its own, and is never delivered.
    ``receiver_life``: the life of the receiver that the sender knows; says nothing in a greeting.
    ``sequence``: counted from 1 in each session.  ``sent_at_ms``: by the sender's clock.
    """

    sender: Party
    receiver: Party
    greeting: bool
    sender_life: Life
    receiver_life: Life
    sequence: int
    sent_at_ms: int
    content: Content


@dataclass(frozen=True)
class Arrived:
    """A telegram as it arrived (T11).

    ``code``: its code of authentication, as it came.  ``expected``: what the key of this pair gives for
    the very bytes that it came in.
    """

    telegram: Telegram
    code: Code
    expected: Code


class Outcome(Enum):
    """What becomes of a telegram that arrives (T11)."""

    DELIVERED = "delivered"
    NOT_AUTHENTIC = "no valid code of authentication"
    OTHER_SENDER = "not sent by the peer of this link"
    OTHER_RECEIVER = "sent to another machine"
    OTHER_SESSION = "of a life that is over, or a greeting"
    REPEATED = "not newer than what was delivered before"
    CLOCK_WENT_BACK = "the receiver's clock shows less than before"
    TOO_OLD = "older than is permitted"
    FROM_THE_FUTURE = "sent later than clocks can differ"


@dataclass(frozen=True)
class Limits:
    """The times of a link in ms (T11, ours).

    ``fresh_ms``: how old a telegram may be, by both clocks, when it arrives.
    ``silence_ms``: how old the newest may become before the link counts as silent.
    ``offset_ms``: how far a healthy clock may be from the true time; two differ by twice that.
    """

    fresh_ms: int
    silence_ms: int
    offset_ms: int


@dataclass(frozen=True)
class Link:
    """All that one end of a link decides from; only ``life`` survives a restart (T8, T11).

    ``peer_life``: the newest life that the peer was heard in, none since the restart.
    ``sent``: the number given last in this session.
    ``newest``: the telegram delivered last in this session.
    ``missed``: a monitor, how many numbers were passed over since the restart.
    ``clock_ms``: the highest reading of the own clock since the restart.
    """

    me: Party
    peer: Party
    life: Life
    peer_life: Life | None
    sent: int
    newest: Telegram | None
    missed: int
    clock_ms: int


def begin(me: Party, peer: Party, life: Life, now_ms: int) -> Link:
    """Begin a life of a machine at this end: nobody was heard, nothing is believed (T8, T11)."""
    return Link(me=me, peer=peer, life=life, peer_life=None, sent=0, newest=None, missed=0, clock_ms=now_ms)


def note_time(link: Link, now_ms: int) -> Link:
    """Note a reading of the own clock; one that is less than before is not kept (T11, ours)."""
    if now_ms < link.clock_ms:
        return link
    return replace(link, clock_ms=now_ms)


def meet(link: Link, life: Life) -> Link:
    """Note the life that an authentic telegram of the peer tells; a newer one begins a new session (T11, ours).

    Numbers begin anew both ways, and the link is silent until something of the new session is
    delivered.  An older life is over and changes nothing.
    """
    if link.peer_life is not None and life <= link.peer_life:
        return link
    return replace(link, peer_life=life, sent=0, newest=None)


def newest_sequence(link: Link) -> int:
    """Give the number delivered last in this session, 0 before the first (T11)."""
    return 0 if link.newest is None else link.newest.sequence


def is_of_the_session(link: Link, telegram: Telegram) -> bool:
    """Tell whether a telegram names this life of the receiver and no life of the peer that is over (T8, T11; ours)."""
    return (
        not telegram.greeting
        and telegram.receiver_life == link.life
        and (link.peer_life is None or not telegram.sender_life < link.peer_life)
    )


def is_authentic(arrived: Arrived) -> bool:
    """Tell whether what arrived bears the code that the own key gives for it (T11, ours)."""
    return arrived.code == arrived.expected


def judge(limits: Limits, link: Link, arrived: Arrived, now_ms: int) -> Outcome:
    """Say what becomes of a telegram that arrives when the own clock shows ``now_ms`` (T11).

    Only what is DELIVERED may be acted on.
    """
    telegram = arrived.telegram
    if not is_authentic(arrived):
        return Outcome.NOT_AUTHENTIC
    if telegram.sender != link.peer:
        return Outcome.OTHER_SENDER
    if telegram.receiver != link.me:
        return Outcome.OTHER_RECEIVER
    if not is_of_the_session(link, telegram):
        return Outcome.OTHER_SESSION
    if telegram.sequence <= newest_sequence(meet(link, telegram.sender_life)):
        return Outcome.REPEATED
    if now_ms < link.clock_ms:
        return Outcome.CLOCK_WENT_BACK
    if now_ms - telegram.sent_at_ms > limits.fresh_ms:
        return Outcome.TOO_OLD
    if telegram.sent_at_ms - now_ms > 2 * limits.offset_ms:
        return Outcome.FROM_THE_FUTURE
    return Outcome.DELIVERED


def is_delivered(limits: Limits, link: Link, arrived: Arrived, now_ms: int) -> bool:
    """Tell whether a telegram that arrives is to be acted on (T11)."""
    return judge(limits, link, arrived, now_ms) == Outcome.DELIVERED


def take(limits: Limits, link: Link, arrived: Arrived, now_ms: int) -> Link:
    """Note a telegram that arrives (T11).

    What is not delivered still tells the life of the peer, if it is authentic: that is how two
    machines that have restarted find each other (ours).
    """
    telegram, noted = arrived.telegram, note_time(link, now_ms)
    if not is_authentic(arrived) or telegram.sender != link.peer or telegram.receiver != link.me:
        return noted
    met = meet(noted, telegram.sender_life)
    if not is_delivered(limits, link, arrived, now_ms):
        return met
    return replace(met, newest=telegram, missed=met.missed + telegram.sequence - newest_sequence(met) - 1)


def is_silent(limits: Limits, link: Link, now_ms: int) -> bool:
    """Tell whether the peer counts as silent: the side of occupied, braking, warning (T8, T11, T14).

    Silent is a link whose newest telegram is too old, or is not there, and one whose clock goes back.
    """
    return link.newest is None or now_ms < link.clock_ms or now_ms - link.newest.sent_at_ms > limits.silence_ms


def sends(link: Link, telegram: Telegram) -> bool:
    """Tell whether this is the next telegram of a link, whatever it says and its clock shows (T11).

    After the last number there is none: a number never returns.
    """
    return (
        telegram.sender == link.me
        and telegram.receiver == link.peer
        and telegram.sender_life == link.life
        and telegram.greeting == (link.peer_life is None)
        and (link.peer_life is None or telegram.receiver_life == link.peer_life)
        and link.sent < LAST_SEQUENCE
        and telegram.sequence == link.sent + 1
    )


def after_sending(link: Link) -> Link:
    """Count a telegram that was sent; repeated transmissions of it are the same telegram (T11)."""
    return replace(link, sent=link.sent + 1)
