"""The display's server in the worksite's world, and what was let onto the line, sent and told of it (A1, A2; ours).

The server may restart at any moment.  What it has sent may come at any later moment, again, in any order or never, to a
handset that may itself have restarted; so may what a person has confirmed.
"""

from __future__ import annotations

from dataclasses import replace

from kernel.alarm import tone
from kernel.alarm import train_list as machine
from kernel.alarm.tone import Train
from kernel.alarm.train_list import Entry, Summary
from models.alarm.worksite import (
    NOTHING_TOLD,
    LetOn,
    Lists,
    OfList,
    Railway,
    Told,
    Worksite,
    age_after_ms,
    is_accounted_for,
    is_list_whole,
    nothing_told_to_the_handset,
)

# ---- assumptions


def each_start_is_later(system: Worksite, now_ms: int) -> bool:
    """The server takes GPS time at its start, and no two starts are at one time (A1)."""
    return now_ms > system.newest_ms


def who_confirms_has_entered_every_train(system: Worksite) -> bool:
    """A person confirms when every train on the line, or let onto it, was entered since the server's start (A2)."""
    return all(of.is_entered for _train, of in system.lists.let_on.items())


def only_what_a_person_confirmed_is_heard(system: Worksite, life_ms: int) -> bool:
    """A confirmation that reaches the server was given by a person, for the life of the server that it bears (A1)."""
    return life_ms in system.lists.confirmed


def what_is_reported_left_and_silent_has_left(system: Worksite, train: Train) -> bool:
    """A train reported to have left, of which since then neither source has told for 6 s, is not on the line (A2)."""
    return train not in system.lists.reported or (
        not is_accounted_for(system.lists.reported[train]) or train not in system.bodies
    )


def a_list_is_no_older_than_it_says(system: Worksite, life_ms: int, count: int, age_ms: int) -> bool:
    """A summary that says that the list is whole was sent, and no longer ago than it is told with (A1).

    Of a life before the one that the handset reads anything may be said: its server may run on beside the spare one.
    """
    sent = system.lists.summaries
    return life_ms < system.told.listing.life_ms or ((life_ms, count) in sent and sent[(life_ms, count)] <= age_ms)


def a_train_comes_after_it_was_let_on(site: Railway, system: Worksite, train: Train) -> bool:
    """A train is on the line under a number that was entered longer ago than a list stays fresh (A1, A2)."""
    return train in system.lists.let_on and system.lists.let_on[train].age_ms > site.register.fresh.server_ms


# ---- the server, and who tells it


def start_server(site: Railway, system: Worksite, now_ms: int) -> Worksite:
    """The server starts, for the first time or again; all that it knew is gone (A1)."""
    if not each_start_is_later(system, now_ms):
        return system
    let_on = {train: replace(of, is_entered=False) for train, of in system.lists.let_on.items()}
    return replace(
        system,
        server=machine.started(now_ms),
        newest_ms=now_ms,
        lists=replace(system.lists, let_on=let_on, reported={}),
    )


def with_server(system: Worksite, server: machine.Server, lists: Lists, train: Train) -> Worksite:
    """Give the worksite with a train on the server's list; who was not there bears the newest entry."""
    open_since = lists.open_since | {(system.newest_ms, train): server.count}
    return replace(
        system,
        server=server,
        lists=replace(lists, open_since=lists.open_since if train in system.lists.reported else open_since),
    )


def enter(site: Railway, system: Worksite, train: Train) -> Worksite:
    """A train number is entered, and the server shows it: from now on the train may be let on (A2)."""
    lists = system.lists
    age_ms = lists.let_on[train].age_ms if train in lists.let_on else 0
    let_on = lists.let_on | {train: LetOn(age_ms=age_ms, is_entered=True)}
    noted = replace(lists, let_on=let_on, reported=lists.reported | {train: 3_600_001})
    return with_server(system, machine.enter(system.server, train), noted, train)


def hear_of(site: Railway, system: Worksite, train: Train) -> Worksite:
    """GPS or the display tells the server of a train, whatever that may be (A1, A2)."""
    noted = replace(system.lists, reported=system.lists.reported | {train: 3_600_001})
    return with_server(system, machine.enter(system.server, train), noted, train)


def report_left(site: Railway, system: Worksite, train: Train) -> Worksite:
    """The interlocking, or a person, reports that a train has left, truly or not (A2)."""
    reported = system.lists.reported
    left = {other: 0 if other == train and ms > 3_600_000 else ms for other, ms in reported.items()}
    return replace(system, server=machine.note_left(system.server, train), lists=replace(system.lists, reported=left))


def strike_off(site: Railway, system: Worksite, train: Train) -> Worksite:
    """The server looks whether a train is to come off its list; who has entered it sees it go (A2)."""
    if not what_is_reported_left_and_silent_has_left(system, train):
        return system
    lists = system.lists
    server = machine.strike_off(system.server, train)
    is_off = server.count != system.server.count
    return replace(
        system,
        server=server,
        lists=replace(
            lists,
            reported={each: ms for each, ms in lists.reported.items() if each != train or not is_accounted_for(ms)},
            let_on={each: of for each, of in lists.let_on.items() if each != train or not is_off},
            open_since={
                (life_ms, each): number
                for (life_ms, each), number in lists.open_since.items()
                if each != train or not is_off
            },
        ),
    )


def withdraw(site: Railway, system: Worksite, train: Train) -> Worksite:
    """A train that was let on, and has not come, is to come no more (A2)."""
    if train in system.bodies:
        return system
    let_on = {other: of for other, of in system.lists.let_on.items() if other != train}
    return replace(system, lists=replace(system.lists, let_on=let_on))


def confirm_the_list(site: Railway, system: Worksite) -> Worksite:
    """A person confirms to the server, in the life that it is in, that every train has been entered (A2)."""
    if not who_confirms_has_entered_every_train(system):
        return system
    confirmed = system.lists.confirmed | {system.newest_ms}
    return replace(system, lists=replace(system.lists, confirmed=confirmed))


def hear_confirmation(site: Railway, system: Worksite, life_ms: int) -> Worksite:
    """What a person has confirmed reaches the server, perhaps after it has restarted (A1)."""
    if not only_what_a_person_confirmed_is_heard(system, life_ms):
        return system
    return replace(system, server=machine.confirm(system.server, life_ms))


# ---- what is sent


def send_entry(site: Railway, system: Worksite, number: int) -> Worksite:
    """The server sends an entry, for the first time or again (A1)."""
    server = system.server
    before = system.lists.entries
    sent = before | {(server.life_ms, number): server.entries[number]} if number in server.entries else before
    return replace(system, lists=replace(system.lists, entries=sent))


def send_summary(site: Railway, system: Worksite) -> Worksite:
    """The server sends how its list is; only one that is said to be whole matters (A1)."""
    said = machine.summary(system.server)
    before = system.lists.summaries
    sent = before | {(said.life_ms, said.count): 0} if said.is_whole else before
    return replace(system, lists=replace(system.lists, summaries=sent))


# ---- what the handset is told


def told_entry(told: Told, entry: Entry) -> Told:
    """Give what was told after an entry, which counts if it is the next of its life (A1, A2)."""
    of = told.listing
    if entry.life_ms != of.life_ms or entry.number != of.taken + 1:
        return told
    named = {train: number for train, number in of.named.items() if train != entry.train}
    if entry.has_left:
        return replace(
            told,
            listing=replace(of, taken=entry.number, named=named),
            trains={train: each for train, each in told.trains.items() if train != entry.train},
        )
    of_train = told.trains.get(entry.train, NOTHING_TOLD)
    return replace(
        told,
        listing=replace(of, taken=entry.number, named=of.named | {entry.train: entry.number}),
        trains=told.trains | {entry.train: of_train},
    )


def told_summary(told: Told, life_ms: int, count: int, is_whole: bool, age_ms: int, servers_well: bool) -> Told:
    """Give what was told after a summary, which counts if it is younger than the last, and of no life before (A1)."""
    if not 0 <= age_ms <= told.list_age_ms or life_ms < told.listing.life_ms:
        return told
    of = told.listing
    read = of.taken if life_ms == of.life_ms else 0
    named = {train: number for train, number in of.named.items() if life_ms == of.life_ms}
    listing = OfList(life_ms=life_ms, taken=read, count=count, is_whole=is_whole, named=named)
    return replace(
        told,
        list_age_ms=age_ms,
        servers_well=servers_well,
        listing=listing,
        trains={train: each for train, each in told.trains.items() if train in named or not is_list_whole(listing)},
    )


def hear_entry(site: Railway, system: Worksite, life_ms: int, number: int) -> Worksite:
    """An entry that was sent reaches the handset (A1)."""
    if (life_ms, number) not in system.lists.entries:
        return system
    entry = system.lists.entries[(life_ms, number)]
    return replace(system, told=told_entry(system.told, entry), handset=machine.note_entry(system.handset, entry))


def hear_summary(
    site: Railway, system: Worksite, life_ms: int, count: int, is_whole: bool, age_ms: int, servers_well: bool
) -> Worksite:
    """A summary reaches the handset; one that says that the list is not whole may say anything else (A1)."""
    if is_whole and not a_list_is_no_older_than_it_says(system, life_ms, count, age_ms):
        return system
    said = Summary(life_ms=life_ms, count=count, is_whole=is_whole, age_ms=age_ms)
    return replace(
        system,
        told=told_summary(system.told, life_ms, count, is_whole, age_ms, servers_well),
        handset=machine.note_summary(system.handset, said, servers_well),
    )


def restart_handset(site: Railway, system: Worksite) -> Worksite:
    """The handset starts again: all that it was told is gone (A8)."""
    return replace(system, told=nothing_told_to_the_handset(), handset=tone.switched_on())


# ---- time


def lists_after(lists: Lists, elapsed_ms: int) -> Lists:
    """Give what was let on, reported and sent after some time (A1)."""
    return replace(
        lists,
        let_on={train: replace(of, age_ms=age_after_ms(of.age_ms, elapsed_ms)) for train, of in lists.let_on.items()},
        reported={train: age_after_ms(left_ms, elapsed_ms) for train, left_ms in lists.reported.items()},
        summaries={
            (life_ms, count): age_after_ms(age_ms, elapsed_ms) for (life_ms, count), age_ms in lists.summaries.items()
        },
    )
