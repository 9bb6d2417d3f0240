"""What is claimed of the radio link: the seven threats end in a refusal, or are noticed (T11).

Times are true ones; ``2 * offset`` is how far two healthy clocks can differ.
"""

from __future__ import annotations

from kernel.link import Link
from models.link import (
    Site,
    System,
    arrive,
    clocks_agree_within_the_bound,
    look,
    pass_time,
    restart,
    send,
)
from proofs.theory import Theory, by_name

# ---- the start


def nothing_was_sent_or_believed(site: Site, system: System) -> bool:
    """At the start the air is empty."""
    return (
        all(False for _telegram in system.sent)
        and all(False for _telegram in system.delivered)
        and all(False for _me, _peer in system.trusted)
    )


def every_link_is_new(site: Site, system: System) -> bool:
    """At the start every end has just begun a life."""
    return all(
        end.link.me == me
        and end.link.peer == peer
        and end.link.peer_life is None
        and end.link.sent == 0
        and end.link.newest is None
        and end.link.missed == 0
        and end.link.clock_ms == end.highest_ms
        for (me, peer), end in system.ends.items()
    )


# ---- the claims


def heard(link: Link) -> int:
    """Give the number of the newest telegram that a link was given in its session, 0 before the first."""
    return 0 if link.newest is None else link.newest.sequence


def delivered_was_sent_by_that_sender_in_this_session(site: Site, system: System) -> bool:
    """What is delivered was sent, so, by the peer, to this machine, to this life of it (insertion, masquerade)."""
    return all(
        telegram in system.sent
        and telegram.sender == delivery.peer
        and telegram.receiver == delivery.me
        and not telegram.greeting
        and telegram.receiver_life == delivery.life
        for telegram, delivery in system.delivered.items()
    )


def delivered_is_not_too_old(site: Site, system: System) -> bool:
    """At most ``fresh + 2 * offset`` have passed since a right clock stamped it (delay)."""
    return all(
        not clocks_agree_within_the_bound(site, telegram.sent_at_ms, system.sent[telegram])
        or delivery.at_ms - system.sent[telegram] <= site.limits.fresh_ms + 2 * site.limits.offset_ms
        for telegram, delivery in system.delivered.items()
        if telegram in system.sent
    )


def delivered_in_order(site: Site, system: System) -> bool:
    """Of two telegrams delivered to one life the later is of a later life of the peer, or has the greater number."""
    return all(
        system.delivered[one].turn >= system.delivered[other].turn
        or system.delivered[one].me != system.delivered[other].me
        or system.delivered[one].peer != system.delivered[other].peer
        or system.delivered[one].life != system.delivered[other].life
        or one.sender_life < other.sender_life
        or (one.sender_life == other.sender_life and one.sequence < other.sequence)
        for one in system.delivered
        for other in system.delivered
    )


def delivered_never_twice(site: Site, system: System) -> bool:
    """Nothing is delivered twice, not even to two lives (repetition)."""
    return all(delivery.times == 1 for _telegram, delivery in system.delivered.items())


def deletion_is_noticed(site: Site, system: System) -> bool:
    """While no number is missed, all that was sent in the session up to the newest was delivered."""
    return all(
        end.link.missed > 0
        or telegram.sender != peer
        or telegram.receiver != me
        or telegram.greeting
        or telegram.sender_life != end.link.peer_life
        or telegram.receiver_life != end.link.life
        or telegram.sequence > heard(end.link)
        or telegram in system.delivered
        for (me, peer), end in system.ends.items()
        for telegram in system.sent
    )


def silence_is_noticed(site: Site, system: System) -> bool:
    """A link that does not count as silent has been given a telegram within ``silence + 4 * offset``.

    Whatever the sender's clock; if that was right, it was sent within ``silence + 2 * offset``.
    """
    return all(
        trust.newest is not None
        and trust.newest in system.sent
        and trust.newest in system.delivered
        and system.delivered[trust.newest].me == me
        and system.delivered[trust.newest].peer == peer
        and trust.at_ms - system.delivered[trust.newest].at_ms <= site.limits.silence_ms + 4 * site.limits.offset_ms
        and (
            not clocks_agree_within_the_bound(site, trust.newest.sent_at_ms, system.sent[trust.newest])
            or trust.at_ms - system.sent[trust.newest] <= site.limits.silence_ms + 2 * site.limits.offset_ms
        )
        for (me, peer), trust in system.trusted.items()
    )


def a_clock_set_back_makes_nothing_fresh(site: Site, system: System) -> bool:
    """What was too old, or silent, by one reading of the receiver's clock stays so in this life (delay)."""
    return all(
        delivery.highest_ms - telegram.sent_at_ms <= site.limits.fresh_ms
        for telegram, delivery in system.delivered.items()
    ) and all(
        trust.newest is None or trust.highest_ms - trust.newest.sent_at_ms <= site.limits.silence_ms
        for _ends, trust in system.trusted.items()
    )


def a_number_never_wraps(site: Site, system: System) -> bool:
    """Numbers run from 1 to 4,294,967,295, which four bytes hold (ours), and then no more is sent."""
    return all(1 <= telegram.sequence <= 4_294_967_295 for telegram in system.sent)


def only_the_peer_tells_its_life(site: Site, system: System) -> bool:
    """The life that a link takes for the peer's stands in a telegram that the peer has sent to it (masquerade).

    So no stranger ends a session, nor makes a link silent, by a life that never was.
    """
    return all(
        end.link.peer_life is None
        or any(
            telegram.sender == peer and telegram.receiver == me and telegram.sender_life == end.link.peer_life
            for telegram in system.sent
        )
        for (me, peer), end in system.ends.items()
    )


# ---- what they rest on


def an_end_bears_its_names(site: Site, system: System) -> bool:
    """An end is listed under its own and its peer's name, and counts from 0."""
    return all(
        end.link.me == me and end.link.peer == peer and end.link.sent >= 0 and end.link.missed >= 0
        for (me, peer), end in system.ends.items()
    )


def the_clock_kept_is_the_highest(site: Site, system: System) -> bool:
    """A link keeps the highest reading of its clock."""
    return all(end.link.clock_ms == end.highest_ms for _ends, end in system.ends.items())


def a_sender_has_counted_what_it_sent(site: Site, system: System) -> bool:
    """What was sent is of the sender's life or an earlier one, of its session or an earlier one, and counted in it."""
    return all(
        (telegram.sender, telegram.receiver) in system.ends
        and telegram.sender_life <= system.ends[telegram.sender, telegram.receiver].link.life
        for telegram in system.sent
    ) and all(
        telegram.greeting
        or telegram.sender != me
        or telegram.receiver != peer
        or telegram.sender_life != end.link.life
        or (
            end.link.peer_life is not None
            and telegram.receiver_life <= end.link.peer_life
            and (telegram.receiver_life != end.link.peer_life or telegram.sequence <= end.link.sent)
        )
        for telegram in system.sent
        for (me, peer), end in system.ends.items()
    )


def no_two_telegrams_share_a_number(site: Site, system: System) -> bool:
    """Two telegrams from one machine to another, in one session, have different numbers."""
    return all(
        one == other
        or one.greeting
        or other.greeting
        or one.sender != other.sender
        or one.receiver != other.receiver
        or one.sender_life != other.sender_life
        or one.receiver_life != other.receiver_life
        or one.sequence != other.sequence
        for one in system.sent
        for other in system.sent
    )


def the_newest_was_delivered(site: Site, system: System) -> bool:
    """The newest telegram of a link was delivered to it in this life, from the peer's newest life."""
    return all(
        end.link.newest is None
        or (
            end.link.newest in system.delivered
            and system.delivered[end.link.newest].me == me
            and system.delivered[end.link.newest].peer == peer
            and system.delivered[end.link.newest].life == end.link.life
            and end.link.newest.sender_life == end.link.peer_life
        )
        for (me, peer), end in system.ends.items()
    )


def the_newest_is_the_greatest(site: Site, system: System) -> bool:
    """All that was delivered is of an earlier life, at either end, or has no greater number than the newest."""
    return all(
        delivery.me != me
        or delivery.peer != peer
        or delivery.life < end.link.life
        or (
            delivery.life == end.link.life
            and end.link.peer_life is not None
            and (
                telegram.sender_life < end.link.peer_life
                or (telegram.sender_life == end.link.peer_life and telegram.sequence <= heard(end.link))
            )
        )
        for telegram, delivery in system.delivered.items()
        for (me, peer), end in system.ends.items()
    )


def a_turn_comes_once(site: Site, system: System) -> bool:
    """Every delivery had its turn before the next one."""
    return all(delivery.turn < system.turns for _telegram, delivery in system.delivered.items())


def the_newest_came_in_time(site: Site, system: System) -> bool:
    """What a link rests on when asked was stamped no later than clocks can differ from its arrival."""
    return all(
        telegram.sent_at_ms <= delivery.at_ms + 3 * site.limits.offset_ms
        for telegram, delivery in system.delivered.items()
    )


INITIAL = (nothing_was_sent_or_believed, every_link_is_new)
SAFETY = (
    delivered_was_sent_by_that_sender_in_this_session,
    delivered_is_not_too_old,
    delivered_in_order,
    delivered_never_twice,
    deletion_is_noticed,
    silence_is_noticed,
    a_clock_set_back_makes_nothing_fresh,
    a_number_never_wraps,
    only_the_peer_tells_its_life,
)
INVARIANTS = (
    *SAFETY,
    an_end_bears_its_names,
    the_clock_kept_is_the_highest,
    a_sender_has_counted_what_it_sent,
    no_two_telegrams_share_a_number,
    the_newest_was_delivered,
    the_newest_is_the_greatest,
    a_turn_comes_once,
    the_newest_came_in_time,
)

THEORY = Theory(
    "link",
    Site,
    System,
    by_name((pass_time, send, arrive, look, restart)),
    by_name(INITIAL),
    by_name(INVARIANTS),
    by_name(SAFETY),
)
