"""The display's server on a day: the numbers it is told of, its restarts, and what comes of its list (A1, A2).

The server is the kernel's own, compiled.  A person enters each number before its train is let onto the line, and all of
them again, after a restart, before he confirms the list.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from models.alarm.columns import NUMBER
from models.alarm.compiled import MADE
from models.alarm.faults import KIND
from models.alarm.line import REGISTER, SHUNTER, TRAINS
from models.alarm.moving import COMES_AFTER_S, NAMED_AFTER_S, noise
from models.alarm.network import ANOTHER
from models.alarm.windows import is_of, is_on
from models.compiled import compiled

KERNEL = MADE.train_list
started, older_server, enter, confirm = KERNEL.started, KERNEL.older_server, KERNEL.enter, KERNEL.confirm
note_left, strike_off = KERNEL.note_left, KERNEL.strike_off
RESTARTS, CUT, RENUMBERED, UNLISTED = (KIND[name] for name in ("server_restarts", "list_cut", "renumbered", "unlisted"))
DISPLAY_OUT, TRAIN_SILENT = KIND["display_out"], KIND["train_silent"]
LEFT_BROKEN, LIST_BROKEN = NUMBER["left_broken"], NUMBER["list_broken"]
HOUR_MS = 3_600_000
LEAD_S = REGISTER.fresh.server_ms // 1_000 + 1
"""A number is entered so long before its train is let on, or takes it: by more than a list stays fresh (A2)."""


class Numbers(NamedTuple):
    """Which number each train has: its own, or, taken on its way, that and ``TRAINS``.

    ``entered_s``: when the first was entered; -1 before.  ``changes_s``: when it takes the other one; -1 where that
    was not entered.
    """

    now: Any
    entered_s: Any
    changes_s: Any


@compiled
def at_first() -> Numbers:
    """Give each train its own number, entered nowhere yet."""
    return Numbers(np.arange(TRAINS), np.full(TRAINS, -1), np.full(TRAINS, -1))


@compiled
def confirmed_empty() -> Any:
    """Give the server of the morning: no train is on the line, and a person has said so (A1)."""
    return confirm(started(0), 0)


@compiled(forceinline=True)
def is_there(trains: Any, train: int, second: int) -> bool:
    """Tell whether a train is on the line."""
    return bool(trains.came_s[train] <= second < trains.left_s[train])


@compiled(forceinline=True)
def is_pending(numbers: Numbers, train: int, number: int, second: int) -> bool:
    """Tell whether a number was entered that its train is yet to take."""
    return bool(number >= TRAINS and numbers.changes_s[train] > second)


@compiled(forceinline=True)
def enter_a_train(day: Any, trains: Any, numbers: Numbers, train: int, server: Any, second: int) -> Any:
    """A person enters what is to come, or to change its number, and lets it on no sooner than he may (A2)."""
    if numbers.entered_s[train] < 0:
        if second < trains.came_s[train] - COMES_AFTER_S + NAMED_AFTER_S:
            return server
        numbers.entered_s[train] = second
        trains.came_s[train] = max(trains.came_s[train], second + LEAD_S)
        return enter(server, numbers.now[train])
    if numbers.changes_s[train] < 0 and is_of(day, RENUMBERED, train, second) and is_there(trains, train, second):
        numbers.changes_s[train] = second + LEAD_S
        return enter(server, train + TRAINS)
    return server


@compiled(forceinline=True)
def hear_of(day: Any, sent: Any, train: int, server: Any, second: int) -> Any:
    """What the unit and the display send of a train reaches the server (A1, A2)."""
    now = second % sent.number.shape[1]
    if is_of(day, UNLISTED, train, second):
        return server
    if (second + train) % 2 == 0 and sent.has_fix[train, now] and not is_of(day, TRAIN_SILENT, train, second):
        server = enter(server, sent.number[train, now])
    if (second + train) % 3 == 0 and train != SHUNTER and not is_on(day, DISPLAY_OUT, second):
        server = enter(server, sent.number[train, now])
    return server


@compiled(forceinline=True)
def look_who_has_left(day: Any, trains: Any, numbers: Numbers, server: Any, second: int, out: Any) -> Any:
    """The interlocking reports who has left, and which numbers are used no more, until the server has it (A2)."""
    for number, listed in server.trains:
        train = number % TRAINS
        is_used = number == numbers.now[train]
        has_left = second >= trains.left_s[train] or not (is_used or is_pending(numbers, train, number, second))
        if (has_left or is_of(day, UNLISTED, train, second)) and listed.left_ms > HOUR_MS:
            server = note_left(server, number)
        before = server.count
        server = strike_off(server, number)
        if server.count > before and is_used and is_there(trains, train, second):
            out[LEFT_BROKEN] += 1
    return server


@compiled(forceinline=True)
def enter_all_and_confirm(trains: Any, numbers: Numbers, server: Any, second: int) -> Any:
    """A person enters every train that is on the line, or let onto it, and confirms the list (A2)."""
    for index in range(trains.switched_on[TRAINS]):
        train = trains.switched_on[index]
        if numbers.entered_s[train] >= 0 and second < trains.left_s[train]:
            server = enter(server, numbers.now[train])
            if numbers.changes_s[train] > second:
                server = enter(server, train + TRAINS)
    return confirm(server, server.life_ms)


@compiled(forceinline=True)
def has_number(server: Any, number: int) -> bool:
    """Tell whether the server's list has a number."""
    for listed, _of in server.trains:  # noqa: SIM110
        if listed == number:
            return True
    return False


@compiled(forceinline=True)
def change_numbers(day: Any, trains: Any, numbers: Numbers, second: int) -> None:
    """A train takes its new number; one that nobody can enter waits before the line (A2)."""
    is_down = is_on(day, RESTARTS, second)
    for index in range(trains.switched_on[TRAINS]):
        train = trains.switched_on[index]
        if numbers.changes_s[train] == second:
            numbers.now[train] = train + TRAINS
        named_s = trains.came_s[train] - COMES_AFTER_S + NAMED_AFTER_S
        if is_down and numbers.entered_s[train] < 0 and second >= named_s:
            trains.came_s[train] += 1


@compiled
def serve(day: Any, trains: Any, sent: Any, numbers: Numbers, server: Any, second: int, out: Any) -> Any:
    """A second passes for the server; while it restarts it does nothing, and then it knows nothing (A1, A2)."""
    if is_on(day, RESTARTS, second):
        return server
    restarts = day.begin_s[RESTARTS] >= 0
    if restarts and second == day.end_s[RESTARTS]:
        server = started(1_000 * second)
    server = older_server(server, 1_000)
    for index in range(trains.switched_on[TRAINS]):
        train = trains.switched_on[index]
        server = enter_a_train(day, trains, numbers, train, server, second)
        server = hear_of(day, sent, train, server, second)
    server = look_who_has_left(day, trains, numbers, server, second, out)
    if restarts and second == day.end_s[RESTARTS] + abs(day.size[RESTARTS]):
        server = enter_all_and_confirm(trains, numbers, server, second)
    if server.is_whole:
        for index in range(trains.switched_on[TRAINS]):
            train = trains.switched_on[index]
            out[LIST_BROKEN] += is_there(trains, train, second) and not has_number(server, numbers.now[train])
    return server


@compiled(forceinline=True)
def entries_that_come(day: Any, sent_s: int, taken: int, count: int) -> int:
    """Give how many entries of a list the handset has when it has come; one that was cut on its way has fewer (A1)."""
    if count <= taken or not is_on(day, CUT, sent_s):
        return count
    return int(taken + noise(day.key, sent_s, 5_000 + ANOTHER * day.handset) % (count - taken + 1))
