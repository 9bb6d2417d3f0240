"""The list of a line's trains: how the display's server keeps it, and how a handset takes it (A1, A2; ours).

The server writes a train register: each entry says that a train number is on the list, or has left it, and bears the
server's life (GPS time at its start) and a number of its own.  Entries are never changed, so those that come late,
twice or in another order are of the same list; a handset takes the next one only, and of one life only.  It goes over
to a later life and never back: what a server still says after a spare one has taken over is let go.  A summary says
how many entries there are, and whether the list is whole.  Whoever has fewer has a short list, and knows no trains by
it that are not there.

After a start the list is empty and not whole.  It becomes whole when a person confirms, for this life of the server,
that every train on the line, or let onto it, has been entered.

A number comes onto the list when it is entered, or when GPS or the traffic display tells of a train by it.  It leaves
the list when it was reported to have left and since that report neither has told of it for some time; what is told of
after the report makes that void.  So one report alone takes no train off, and a train that changes its number leaves
its old one on the list until that is accounted for.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.alarm.distance import GREATEST_AGE_MS, older_ms
from kernel.alarm.tone import NOTHING_KNOWN, Handset, Listing, Train, has_whole_list
from kernel.maps import Map

QUIET_MS = 6_000
"""A train reported to have left is off the list after neither source has told of it for so long since (ours).

GPS tells every 2 s and the display every 3 s (004, 3.1, 3.2), so that three and two in a row are missing then.
"""
NOT_REPORTED_MS = GREATEST_AGE_MS + 1
"""In the place of an age: no report that a train has left, or one of more than an hour ago."""


@dataclass(frozen=True)
class Entry:
    """An entry of the train register: a train is on the list, or ``has_left`` it (A2).

    ``life_ms``: of the server that wrote it.  ``number``: from 1, without gaps.
    """

    life_ms: int
    number: int
    train: Train
    has_left: bool


@dataclass(frozen=True)
class Summary:
    """What the server says of its list: so many entries, and whether it is whole, ``age_ms`` ago (A1)."""

    life_ms: int
    count: int
    is_whole: bool
    age_ms: int


@dataclass(frozen=True)
class Listed:
    """A train on the server's list (A2).

    ``number``: of its entry.  ``left_ms``: how long ago it was reported to have left, if it has not been entered and
    neither source has told of it since.
    """

    number: int
    left_ms: int


@dataclass(frozen=True)
class Server:
    """The display's server in one of its lives: nothing of it outlives a restart (A1).

    ``life_ms``: GPS time at its start.  ``count``: entries written.  ``is_whole``: a person has confirmed the list.
    """

    life_ms: int
    count: int
    is_whole: bool
    trains: Map[Train, Listed]
    entries: Map[int, Entry]


# ---- the server


def started(now_ms: int) -> Server:
    """Give a server that has just started: it knows of no train, and says so (A1)."""
    return Server(life_ms=now_ms, count=0, is_whole=False, trains={}, entries={})


def older_server(server: Server, elapsed_ms: int) -> Server:
    """Let time pass for the server (A1)."""
    return replace(
        server,
        trains={
            train: replace(listed, left_ms=older_ms(listed.left_ms, elapsed_ms))
            for train, listed in server.trains.items()
        },
    )


def with_entry(server: Server, train: Train, has_left: bool) -> Server:
    """Write the next entry (A2)."""
    number = server.count + 1
    entry = Entry(life_ms=server.life_ms, number=number, train=train, has_left=has_left)
    return replace(server, count=number, entries=server.entries | {number: entry})


def enter(server: Server, train: Train) -> Server:
    """Take a train onto the list that a person enters, or that GPS or the traffic display tells of (A2).

    A report that it has left was of an earlier run then, or wrong, and is void.
    """
    number = server.trains[train].number if train in server.trains else server.count + 1
    listed = Listed(number=number, left_ms=NOT_REPORTED_MS)
    entered = server if train in server.trains else with_entry(server, train, has_left=False)
    return replace(entered, trains=server.trains | {train: listed})


def note_left(server: Server, train: Train) -> Server:
    """Note a report that a train has left the line, or its number is used no more (A2).

    One that is made again counts from the first.
    """
    if train not in server.trains or server.trains[train].left_ms <= GREATEST_AGE_MS:
        return server
    return replace(server, trains=server.trains | {train: replace(server.trains[train], left_ms=0)})


def is_accounted_for(listed: Listed) -> bool:
    """Tell whether a train was reported to have left, and neither source has told of it for some time since (A2)."""
    return QUIET_MS <= listed.left_ms <= GREATEST_AGE_MS


def strike_off(server: Server, gone: Train) -> Server:
    """Take a train off the list, if it is accounted for (A2)."""
    if gone not in server.trains or not is_accounted_for(server.trains[gone]):
        return server
    trains = {train: listed for train, listed in server.trains.items() if train != gone}
    return replace(with_entry(server, gone, has_left=True), trains=trains)


def confirm(server: Server, life_ms: int) -> Server:
    """Take a person's word that the list is whole; one given to an earlier life of the server is none (A1)."""
    return replace(server, is_whole=True) if life_ms == server.life_ms else server


def summary(server: Server) -> Summary:
    """Say how many entries there are, and whether the list is whole (A1)."""
    return Summary(life_ms=server.life_ms, count=server.count, is_whole=server.is_whole, age_ms=0)


# ---- the handset


def note_entry(handset: Handset, entry: Entry) -> Handset:
    """Take an entry into the handset's list, if it is the next of the server's life that it reads (A1, A2).

    What was told of a train in an earlier life of the server stays with it.
    """
    listing = handset.listing
    if entry.life_ms != listing.life_ms or entry.number != listing.taken + 1:
        return handset
    if entry.has_left:
        named = {train: number for train, number in listing.named.items() if train != entry.train}
        trains = {train: known for train, known in handset.trains.items() if train != entry.train}
        return replace(handset, trains=trains, listing=replace(listing, taken=entry.number, named=named))
    listing = replace(listing, taken=entry.number, named=listing.named | {entry.train: entry.number})
    if entry.train in handset.trains:
        return replace(handset, listing=listing)
    return replace(handset, trains=handset.trains | {entry.train: NOTHING_KNOWN}, listing=listing)


def note_summary(handset: Handset, told: Summary, servers_well: bool) -> Handset:
    """Note what the server says of its list, and the monitoring server of both; what is older is let go (A1).

    So is what a server says from a life before the one that is read, however new: another has taken over from it.

    In a new life of the server the list is read anew.  The trains known from before stay until it has been read and is
    whole, so that who hears the alarm goes on hearing it.
    """
    read = handset.listing
    if not 0 <= told.age_ms <= handset.server_age_ms or told.life_ms < read.life_ms:
        return handset
    goes_on = told.life_ms == read.life_ms
    listing = Listing(
        life_ms=told.life_ms,
        taken=read.taken if goes_on else 0,
        count=told.count,
        is_whole=told.is_whole,
        named={train: number for train, number in read.named.items() if goes_on},
    )
    trains = {
        train: known for train, known in handset.trains.items() if train in listing.named or not has_whole_list(listing)
    }
    return replace(handset, server_age_ms=told.age_ms, servers_well=servers_well, listing=listing, trains=trains)
