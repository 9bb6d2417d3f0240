"""The display's server, the dispatcher who keeps its list, and the network between it and a handset, for each world.

Only the kernel's own functions are called.  The dispatcher does his duty as docs/assumptions.md says it, unless a world
is told to neglect one.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import dataclass, replace
from random import Random

from kernel.alarm import distance, tone, train_list
from kernel.alarm.distance import TrainFix
from kernel.alarm.tone import Display, Handset, Register, Train
from kernel.alarm.train_list import Entry, Server, Summary

FRESH_MS, QUIET_MS, LONGEST_STEP_MS = 8_000, 6_000, 1_500
ENTERS, CONFIRMS, REPORTS, CUTS_OFF, NEW_NUMBERS = (
    "enters first",
    "confirms when all are entered",
    "reports who has left",
    "cuts off the server before",
    "gives no number twice",
)
"""Duties of the dispatcher."""


@dataclass(frozen=True)
class Told:
    """What a source tells of a train, at that moment.

    ``off_m``: how far the fix is off beyond a receiver's error, which nobody is told.
    """

    number: Train
    fix: TrainFix | None
    display: Display | None
    off_m: float = 0.0


Word = Entry | Summary | Told


class Office:
    """The server, in one life after another, and who enters, confirms and reports.

    ``entered_ms``: when each number was entered first, and shown.  ``gone``: numbers that are used no more, and since
    when.  ``told_ms``: when the server heard of each last, by either source.
    """

    def __init__(self, chance: Random, broken: str, restarts_a_s: float, resends: float) -> None:
        """Begin with an empty line, confirmed; ``broken``: a duty that the dispatcher neglects."""
        self.chance, self.broken = chance, broken
        self.restarts_a_s, self.resends = restarts_a_s, resends
        self.server: Server | None = train_list.confirm(train_list.started(0), 0)
        self.run_on: list[Server] = []
        self.comes_up_ms, self.confirms_ms, self.confirmation_ms, self.served_ms = 0, 0, -1, 0
        self.entered_ms: dict[Train, int] = {}
        self.gone: dict[Train, int] = {}
        self.told_ms: dict[Train, int] = {}
        self.numbers = self.restarts = 0

    # ---- people

    def new_number(self, now_ms: int) -> Train:
        """Give a number that no train has had; where that is neglected, one that was given up just now."""
        for number in self.just_gone(now_ms) if self.broken == NEW_NUMBERS else []:
            del self.gone[number]
            return number
        self.numbers += 1
        return Train(f"{self.numbers}")

    def just_gone(self, now_ms: int) -> list[Train]:
        """Give the numbers that were given up as lately as a list is fresh."""
        return [number for number, gone_ms in self.gone.items() if now_ms - gone_ms < FRESH_MS]

    def enter(self, now_ms: int, number: Train) -> None:
        """Enter a number, if the server shows it; else it waits until it is asked for again."""
        if self.server is None or self.broken == ENTERS:
            return
        self.server = train_list.enter(self.server, number)
        self.entered_ms.setdefault(number, now_ms)

    def may(self, now_ms: int, number: Train) -> bool:
        """Tell whether a train may run under a number; until it was entered it is entered now."""
        if self.broken == ENTERS:
            return True
        if number not in self.entered_ms:
            self.enter(now_ms, number)
        return number in self.entered_ms and now_ms > self.entered_ms[number] + FRESH_MS

    def give_up(self, now_ms: int, number: Train) -> None:
        """Note that a number is used no more."""
        self.gone[number] = now_ms

    def confirm(self, now_ms: int, used: Iterable[Train]) -> None:
        """Confirm the list when it is time, for the life that is shown then; the word takes its time to the server."""
        if self.server is not None and now_ms >= self.confirms_ms > self.server.life_ms:
            for number in () if self.broken == CONFIRMS else used:
                self.server = train_list.enter(self.server, number)
                self.entered_ms.setdefault(number, now_ms)
            self.confirmation_ms, self.confirms_ms = self.server.life_ms, 0
        if self.server is not None and self.confirmation_ms >= 0 and self.chance.random() < 0.3:
            self.server = train_list.confirm(self.server, self.confirmation_ms)

    # ---- the server

    def serve(self, now_ms: int, telling: Collection[Train], reported: Collection[Train]) -> list[Word]:
        """Let the server hear of trains, take off who is accounted for, and restart at any moment; give what it sends.

        ``telling``: of whom a source tells now.  ``reported``: who is reported to have left, beside those that have.
        """
        sent: list[Word] = [train_list.summary(other) for other in self.run_on]
        elapsed_ms, self.served_ms = now_ms - self.served_ms, now_ms
        if self.server is None:
            if now_ms < self.comes_up_ms:
                return sent
            self.server = train_list.started(now_ms)
            self.confirms_ms = now_ms + 1_000 * self.chance.choice((1, 2, self.chance.randrange(1, 60)))
        server = train_list.older_server(self.server, elapsed_ms)
        for number in telling:
            if self.chance.random() < 0.1 or now_ms >= self.told_ms.get(number, 0) + QUIET_MS - LONGEST_STEP_MS:
                server, self.told_ms[number] = train_list.enter(server, number), now_ms
        for number in [each for each in server.trains if each in self.gone or each in reported]:
            if server.trains[number].left_ms > 3_600_000:
                server = train_list.note_left(server, number)
        for number in list(server.trains):
            server = train_list.strike_off(server, number)
        sent.append(train_list.summary(server))
        sent += [server.entries[each] for each in range(1, server.count + 1) if self.chance.random() < self.resends]
        self.server = server
        if self.chance.random() < self.restarts_a_s * elapsed_ms / 1_000:
            self.run_on += [server] if self.broken == CUTS_OFF else []
            self.server, self.comes_up_ms = None, now_ms + 1_000 * self.chance.randrange(30)
            self.restarts += 1
        return sent


class Air:
    """The mobile network to one handset: whatever is sent is lost, late, or comes twice, as it happens."""

    def __init__(self, chance: Random, late: float) -> None:
        """Begin with nothing on its way; ``late``: how many words are late by as much as 20 s."""
        self.chance, self.late = chance, late
        self.on_its_way: list[tuple[int, int, Word]] = []

    def send(self, now_ms: int, word: Word) -> None:
        """Send something."""
        for _ in range(self.chance.choice((0, 1, 1, 1, 2))):
            is_late = self.chance.random() < self.late
            late_s = self.chance.randrange(20) if is_late else self.chance.choice((0, 0, 0, 1, 2))
            self.on_its_way.append((now_ms + 1_000 * late_s, now_ms, word))

    def come(self, now_ms: int) -> list[tuple[Word, int]]:
        """Give what has come, in any order, and how long ago each was sent."""
        come = [(word, now_ms - sent_ms) for at_ms, sent_ms, word in self.on_its_way if at_ms <= now_ms]
        self.on_its_way = [each for each in self.on_its_way if each[0] > now_ms]
        self.chance.shuffle(come)
        return come


def take(register: Register, handset: Handset, word: Word, age_ms: int) -> Handset:
    """Give the handset after a word that is so old."""
    if isinstance(word, Entry):
        return train_list.note_entry(handset, word)
    if isinstance(word, Summary):
        return train_list.note_summary(handset, replace(word, age_ms=word.age_ms + age_ms), servers_well=True)
    if word.fix is not None:
        handset = tone.note_fix(
            register, handset, word.number, distance.older_train(word.fix, age_ms), register.edition
        )
    if word.display is not None:
        display = replace(word.display, age_ms=word.display.age_ms + age_ms)
        handset = tone.note_display(register, handset, word.number, display, register.edition)
    return handset
