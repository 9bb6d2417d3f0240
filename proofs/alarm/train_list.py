"""What is claimed of the list of trains: a handset that has read a whole, fresh one knows every train (A1, A2)."""

from __future__ import annotations

from kernel.alarm.train_list import Entry
from models.alarm.worksite import Lists, Railway, Worksite, is_list_fresh

# ---- the start


def nothing_was_sent(site: Railway, system: Worksite) -> bool:
    """At the start the server has just started, and trains are on the line, let on long before (A1)."""
    server, lists = system.server, system.lists
    return (
        server.life_ms == system.newest_ms
        and server.count == 0
        and not server.is_whole
        and all(False for _train in server.trains)
        and all(False for _number in server.entries)
        and all(False for _train in lists.reported)
        and all(False for _key in lists.entries)
        and all(False for _key in lists.summaries)
        and all(False for _key in lists.open_since)
        and all(False for _life in lists.confirmed)
        and all(not of.is_entered and of.age_ms >= 0 for _train, of in lists.let_on.items())
        and all(
            train in lists.let_on and lists.let_on[train].age_ms > site.register.fresh.server_ms
            for train in system.bodies
        )
    )


# ---- safety


def a_train_that_is_told_of_is_on_the_list(site: Railway, system: Worksite) -> bool:
    """Whoever was entered, or told of by either source, is on the server's list until it is accounted for (A2).

    So it is until it was reported to have left, and neither source has told of it for 6 s since.
    """
    trains = system.server.trains
    return all(
        train in trains and trains[train].left_ms == left_ms for train, left_ms in system.lists.reported.items()
    ) and all(train in system.lists.reported for train in trains)


def a_list_is_whole_by_a_persons_word_alone(site: Railway, system: Worksite) -> bool:
    """The server calls its list whole only if a person has confirmed it in this life of the server (A1)."""
    return not system.server.is_whole or system.server.life_ms in system.lists.confirmed


# ---- what it rests on


def trains_of_the_line_were_let_on(site: Railway, system: Worksite) -> bool:
    """Each was entered, under its number of now, longer ago than a list stays fresh (A2)."""
    let_on = system.lists.let_on
    return all(of.age_ms >= 0 for _train, of in let_on.items()) and all(
        train in let_on and let_on[train].age_ms > site.register.fresh.server_ms for train in system.bodies
    )


def what_was_entered_is_on_the_list(site: Railway, system: Worksite) -> bool:
    """Who was entered since the server's start, and is on the line or let onto it, is on its list (A2)."""
    return all(train in system.server.trains for train, of in system.lists.let_on.items() if of.is_entered)


def a_confirmed_list_has_all_that_were_let_on(site: Railway, system: Worksite) -> bool:
    """Once a person has confirmed this life of the server, all that are let on were entered in it (A2)."""
    return system.newest_ms not in system.lists.confirmed or all(
        of.is_entered for _train, of in system.lists.let_on.items()
    )


def no_life_is_of_the_future(site: Railway, system: Worksite) -> bool:
    """What was sent, listed and confirmed is of lives so far, the server's being the newest (A1)."""
    lists = system.lists
    return (
        system.server.life_ms == system.newest_ms
        and all(life_ms <= system.newest_ms for life_ms, _number in lists.entries)
        and all(life_ms <= system.newest_ms for life_ms, _count in lists.summaries)
        and all(life_ms <= system.newest_ms for life_ms, _train in lists.open_since)
        and all(life_ms <= system.newest_ms for life_ms in lists.confirmed)
    )


def trains_of_the_list_have_entries(site: Railway, system: Worksite) -> bool:
    """Each train on the server's list is there by an entry that it has written, and no other is (A2)."""
    lists, server = system.lists, system.server
    return (
        server.count >= 0
        and all(
            (system.newest_ms, train) in lists.open_since
            and lists.open_since[(system.newest_ms, train)] == listed.number
            and 1 <= listed.number <= server.count
            for train, listed in server.trains.items()
        )
        and all(train in server.trains for life_ms, train in lists.open_since if life_ms == system.newest_ms)
    )


def says_the_last_of_its_train(lists: Lists, life_ms: int, number: int, entry: Entry) -> bool:
    """Tell whether an entry is by its life and number, and contradicts nothing of who is on that life's list (A2)."""
    return (
        entry.life_ms == life_ms
        and entry.number == number
        and number >= 1
        and (
            not entry.has_left
            or (life_ms, entry.train) not in lists.open_since
            or lists.open_since[(life_ms, entry.train)] > number
        )
    )


def entries_of_the_server_are_true(site: Railway, system: Worksite) -> bool:
    """An entry that a train has left has none after it only if the train is off the list (A2)."""
    lists, server = system.lists, system.server
    return all(
        number <= server.count and says_the_last_of_its_train(lists, system.newest_ms, number, entry)
        for number, entry in server.entries.items()
    ) and all(
        server.entries[number].train == train and not server.entries[number].has_left
        for (life_ms, train), number in lists.open_since.items()
        if life_ms == system.newest_ms and number in server.entries
    )


def entries_sent_are_true(site: Railway, system: Worksite) -> bool:
    """So it is of each that was sent, in any life (A2)."""
    lists = system.lists
    return all(
        (life_ms != system.newest_ms or number <= system.server.count)
        and says_the_last_of_its_train(lists, life_ms, number, entry)
        for (life_ms, number), entry in lists.entries.items()
    ) and all(
        lists.entries[(life_ms, number)].train == train and not lists.entries[(life_ms, number)].has_left
        for (life_ms, train), number in lists.open_since.items()
        if (life_ms, number) in lists.entries
    )


def trains_on_a_list_have_a_number(site: Railway, system: Worksite) -> bool:
    """Entries are numbered from 1 (A2)."""
    return all(number >= 1 for _key, number in system.lists.open_since.items())


def whole_lists_are_sent_by_whole_servers(site: Railway, system: Worksite) -> bool:
    """What the server has said of its list in this life, it stands by (A1)."""
    return all(
        age_ms >= 0 and (life_ms != system.newest_ms or system.server.is_whole)
        for (life_ms, _count), age_ms in system.lists.summaries.items()
    )


def whole_lists_have_all_that_were_let_on_before(site: Railway, system: Worksite) -> bool:
    """A list that was said to be whole has every train that was let on before, by one of its entries (A1, A2)."""
    lists = system.lists
    return all(
        (life_ms, train) in lists.open_since and lists.open_since[(life_ms, train)] <= count
        for (life_ms, count), age_ms in lists.summaries.items()
        for train, of in lists.let_on.items()
        if age_ms <= 3_600_000 and of.age_ms > age_ms
    )


def the_handset_has_what_it_has_read(site: Railway, system: Worksite) -> bool:
    """Who is on a life's list by an entry that the handset has read is on the handset's (A2)."""
    listing = system.told.listing
    return all(
        train in listing.named and train in system.told.trains
        for (life_ms, train), number in system.lists.open_since.items()
        if life_ms == listing.life_ms and number <= listing.taken
    )


def the_handset_has_read_what_was_sent(site: Railway, system: Worksite) -> bool:
    """And it has read no entry but those that were sent (A1)."""
    listing = system.told.listing
    return listing.taken == 0 or (listing.life_ms, listing.taken) in system.lists.entries


def the_handset_was_told_of_a_list_that_was_sent(site: Railway, system: Worksite) -> bool:
    """If it was told that the list is whole, the server has said so, no longer ago than it was told with (A1)."""
    listing, sent, age_ms = system.told.listing, system.lists.summaries, system.told.list_age_ms
    return (
        not listing.is_whole
        or not 0 <= age_ms <= 3_600_000
        or ((listing.life_ms, listing.count) in sent and sent[(listing.life_ms, listing.count)] <= age_ms)
    )


def a_fresh_list_has_every_train(site: Railway, system: Worksite) -> bool:
    """While the list is whole and fresh, every train of the line is on it (A1)."""
    return not is_list_fresh(site, system.told) or all(train in system.told.trains for train in system.bodies)


SAFETY = (a_train_that_is_told_of_is_on_the_list, a_list_is_whole_by_a_persons_word_alone)
INVARIANTS = (
    trains_of_the_line_were_let_on,
    what_was_entered_is_on_the_list,
    a_confirmed_list_has_all_that_were_let_on,
    no_life_is_of_the_future,
    trains_of_the_list_have_entries,
    entries_of_the_server_are_true,
    entries_sent_are_true,
    trains_on_a_list_have_a_number,
    whole_lists_are_sent_by_whole_servers,
    whole_lists_have_all_that_were_let_on_before,
    the_handset_has_what_it_has_read,
    the_handset_has_read_what_was_sent,
    the_handset_was_told_of_a_list_that_was_sent,
    a_fresh_list_has_every_train,
)
