"""The world of the radio link: everything ever sent, by anyone, and clocks that are nearly right (T11).

Any telegram may arrive anywhere, any number of times, at any moment, or never, and with any code of
authentication.  So may telegrams that nobody sent; only, nobody without the key hits the code that it
gives for them.  One key for all machines would do here: that a key belongs to one pair is not used.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.link import (
    Arrived,
    Life,
    Limits,
    Link,
    Party,
    Telegram,
    after_sending,
    begin,
    is_delivered,
    is_silent,
    note_time,
    sends,
    take,
)
from kernel.maps import Map


@dataclass(frozen=True)
class Site:
    """What does not change."""

    limits: Limits


@dataclass(frozen=True)
class End:
    """One end of a link; ``highest_ms``: a history, the highest reading of its clock in this life."""

    link: Link
    highest_ms: int


@dataclass(frozen=True)
class Delivery:
    """A history: who took a telegram for whose, in which life, as which in turn, how many times, and when.

    ``at_ms``: by the true time.  ``highest_ms``: by the highest reading of the receiver's clock so far.
    """

    me: Party
    peer: Party
    life: Life
    turn: int
    times: int
    at_ms: int
    highest_ms: int


@dataclass(frozen=True)
class Trust:
    """A history: a link was asked, and did not count as silent, because of ``newest``."""

    newest: Telegram | None
    at_ms: int
    highest_ms: int


@dataclass(frozen=True)
class System:
    """The state: the true time, both ends of every link, and what happened.

    ``ends``: by own and peer's name.  ``sent``: every telegram sent, with the true time.
    ``delivered``: the last delivery of each; ``turns``: how many deliveries there were.
    ``trusted``: the last time that a link was asked and did not count as silent.
    """

    now_ms: int
    ends: Map[tuple[Party, Party], End]
    sent: Map[Telegram, int]
    delivered: Map[Telegram, Delivery]
    turns: int
    trusted: Map[tuple[Party, Party], Trust]


# ---- what is assumed


def only_the_holder_of_the_key_makes_a_valid_mac(site: Site, system: System, arrived: Arrived) -> bool:
    """The code that the key gives for a text stands in it only if a machine that has the key has sent that text.

    Keys stay within the machines, and HMAC-SHA-256, 16 bytes of it, is not forged.  What the receiver
    makes of the two codes is its own matter.
    """
    return arrived.code != arrived.expected or arrived.telegram in system.sent


def clocks_agree_within_the_bound(site: Site, reading_ms: int, true_ms: int) -> bool:
    """A healthy clock is no further from the true time than the bound: it is synchronised and monitored."""
    return reading_ms - true_ms <= site.limits.offset_ms and true_ms - reading_ms <= site.limits.offset_ms


# ---- what can happen


def pass_time(site: Site, system: System, now_ms: int) -> System:
    """Time passes; nothing that is claimed rests on its not going back."""
    return replace(system, now_ms=now_ms)


def send(site: Site, system: System, me: Party, peer: Party, telegram: Telegram) -> System:
    """A machine sends its next telegram; its clock may show anything (T11)."""
    if (me, peer) not in system.ends or not sends(system.ends[me, peer].link, telegram):
        return system
    end = system.ends[me, peer]
    return replace(
        system,
        ends=system.ends | {(me, peer): replace(end, link=after_sending(end.link))},
        sent=system.sent | {telegram: system.now_ms},
    )


def arrive(site: Site, system: System, me: Party, peer: Party, arrived: Arrived, reading_ms: int) -> System:
    """Something arrives at an end of a link: sent, repeated, late, for another, damaged or forged (T11)."""
    if (me, peer) not in system.ends:
        return system
    if not only_the_holder_of_the_key_makes_a_valid_mac(site, system, arrived):
        return system
    if not clocks_agree_within_the_bound(site, reading_ms, system.now_ms):
        return system
    end = system.ends[me, peer]
    highest_ms = reading_ms if reading_ms > end.highest_ms else end.highest_ms
    link = take(site.limits, end.link, arrived, reading_ms)
    noted = replace(system, ends=system.ends | {(me, peer): End(link=link, highest_ms=highest_ms)})
    if not is_delivered(site.limits, end.link, arrived, reading_ms):
        return noted
    telegram = arrived.telegram
    delivery = Delivery(
        me=me,
        peer=peer,
        life=end.link.life,
        turn=system.turns,
        times=system.delivered[telegram].times + 1 if telegram in system.delivered else 1,
        at_ms=system.now_ms,
        highest_ms=highest_ms,
    )
    return replace(
        noted,
        delivered=system.delivered | {telegram: delivery},
        turns=system.turns + 1,
    )


def look(site: Site, system: System, me: Party, peer: Party, reading_ms: int) -> System:
    """A machine asks whether its peer is silent (T8, T11)."""
    if (me, peer) not in system.ends or not clocks_agree_within_the_bound(site, reading_ms, system.now_ms):
        return system
    end = system.ends[me, peer]
    highest_ms = reading_ms if reading_ms > end.highest_ms else end.highest_ms
    noted = replace(
        system,
        ends=system.ends | {(me, peer): End(link=note_time(end.link, reading_ms), highest_ms=highest_ms)},
    )
    if is_silent(site.limits, end.link, reading_ms):
        return noted
    trust = Trust(newest=end.link.newest, at_ms=system.now_ms, highest_ms=highest_ms)
    return replace(noted, trusted=system.trusted | {(me, peer): trust})


def restart(site: Site, system: System, me: Party, peer: Party, life: Life, reading_ms: int) -> System:
    """A machine restarts at one end and has forgotten all but the count of its lives (T8, T11)."""
    if (me, peer) not in system.ends or life <= system.ends[me, peer].link.life:
        return system
    end = End(link=begin(me, peer, life, reading_ms), highest_ms=reading_ms)
    return replace(system, ends=system.ends | {(me, peer): end})
