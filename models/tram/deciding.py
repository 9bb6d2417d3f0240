"""What the centre knows and decides in a simulated day, and what becomes of its orders (G3 to G6).

The kernel's own functions, compiled; what is looked up in maps there is looked up in arrays here, and
``tests/tram`` holds the one to the other.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from kernel.tram import dispatching
from models.compiled import compiled, packed
from models.tram import tally
from models.tram.given import (
    ANY_WORD_ENDS,
    IGNORES_CONTRADICTION,
    LIMITS,
    NEVER_PRESENT,
    NEVER_STALE,
    NOT_ADDRESSED,
    TAKES_THE_FUTURE,
    Given,
)
from models.tram.machines import MADE
from models.tram.radio import CYCLE_S, SLOTS
from models.tram.state import (
    BOX,
    FREE,
    G_BEHIND,
    G_MADE,
    G_MARK,
    G_TOLD,
    K_ELSEWHERE,
    K_IS,
    K_SINCE,
    LATE_MS,
    NEVER_MS,
    O_DUE,
    O_HOLDS,
    O_MADE,
    O_RECOVERS,
    O_STOP,
    O_STRAY,
    O_TRAM,
    O_TRULY,
    ON,
    R_BY,
    R_DUE,
    R_LEAVES,
    R_LEFT,
    R_MADE,
    R_STANDS,
    R_STOP,
    U_ASTRAY,
    Traffic,
)
from models.tram.telling import (
    LATEST_S,
    contradicts,
    display_of,
    is_in_reach,
    is_lost,
    keep_display,
    keep_known,
    known_of,
    number_told,
    send,
    slower_ms,
)
from models.tram.watching import judge

HOLD, LIFT = 1, 3
"""Members of ``Hand`` in compiled code."""
Report, Order, View = MADE.dispatching.Report, MADE.dispatching.Order, MADE.dispatching.View
mark, counts, reported = MADE.dispatching.mark, MADE.dispatching.counts, MADE.dispatching.reported
begins, begun = MADE.dispatching.begins, MADE.dispatching.begun
stop_left, tells_a_departure = MADE.dispatching.stop_left, MADE.dispatching.tells_a_departure
has_passed, is_seen_in_the_way = MADE.dispatching.has_passed, MADE.dispatching.is_seen_in_the_way
may_recover_over, is_known_since = MADE.dispatching.may_recover_over, MADE.dispatching.is_known_since
is_beyond_its_destination = MADE.dispatching.is_beyond_its_destination
coming, is_before_who_comes = MADE.dispatching.coming, MADE.dispatching.is_before_who_comes
clears = MADE.dispatching.clears
was_beyond, is_cleared, is_off = MADE.dispatching.was_beyond, MADE.dispatching.is_cleared, MADE.dispatching.is_off
decided, ordered, is_ahead = MADE.dispatching.decided, MADE.dispatching.ordered, MADE.dispatching.is_ahead
taken, Display = MADE.display.taken, MADE.display.Display
NOTHING_CLEARED = dispatching.NOTHING_CLEARED
REQUEST_MS = SLOTS.request_ms
NEVER_STALE_LIMITS = packed(replace(LIMITS, fresh_ms=10**9))


@compiled
def may_take_up(traffic: Traffic, tram: int, stop: int) -> bool:
    """As :func:`kernel.tram.centre.may_come`."""
    if traffic.trams[tram, K_IS] == 1 or traffic.trams[tram, K_ELSEWHERE] == NEVER_MS or stop < 0:
        return False
    if stop == 0:
        return True
    for other in range(len(traffic.trams)):
        body = traffic.trams[other]
        if body[K_IS] == 1 and may_recover_over(known_of(body), stop):
            return False
    return bool(traffic.known[1] > mark(stop, True))


@compiled
def confirm(traffic: Traffic, tram: int, stop: int, leaves_at: int, now_ms: int) -> bool:
    """As :func:`kernel.tram.centre.note_coming`; whether it was taken up."""
    if not may_take_up(traffic, tram, stop):
        return False
    for other in range(len(traffic.trams)):
        body = traffic.trams[other]
        if body[K_IS] == 1 and is_before_who_comes(known_of(body), stop):
            traffic.shown[other, tram] = 1
    keep_known(traffic.trams[tram], coming(now_ms, stop, leaves_at))
    return True


@compiled
def forget(traffic: Traffic, tram: int, made_ms: int) -> None:
    """As :func:`kernel.tram.centre.without`."""
    traffic.shown[tram, :] = 0
    traffic.shown[:, tram] = 0
    traffic.trams[tram, K_IS], traffic.trams[tram, K_ELSEWHERE] = 0, made_ms


@compiled
def hear_elsewhere(traffic: Traffic, tram: int, is_away: bool, made_ms: int, now_ms: int) -> None:
    """As :func:`kernel.tram.centre.note_elsewhere`."""
    body = traffic.trams[tram]
    if is_away and traffic.known[0] < made_ms <= now_ms and (body[K_IS] == 0 or is_off(known_of(body), made_ms)):
        forget(traffic, tram, made_ms)


@compiled
def take_off_by_hand(traffic: Traffic, tram: int, now_ms: int) -> None:
    """As :func:`kernel.tram.centre.note_taken_off`."""
    if traffic.known[0] < now_ms:
        forget(traffic, tram, now_ms)
        traffic.row[tally.TAKEN_OFF_THERE] += traffic.trams[tram, ON]


@compiled
def restart_centre(limits: Any, traffic: Traffic, now_ms: int) -> None:
    """As :func:`kernel.tram.centre.restarted`."""
    traffic.trams[:, K_IS] = 0
    traffic.trams[:, K_ELSEWHERE] = NEVER_MS
    traffic.left_ms[:] = NEVER_MS
    traffic.shown[:] = 0
    traffic.known[0], traffic.known[1] = now_ms + limits.coming_ms, NOTHING_CLEARED


@compiled
def hear_report(traffic: Traffic, tram: int, report: Any, now_ms: int) -> None:
    """As :func:`kernel.tram.centre.note_report`."""
    body = traffic.trams[tram]
    known = known_of(body)
    if body[K_IS] == 0 or not counts(now_ms, known, report):
        traffic.row[tally.REPORTS_REFUSED] += 1
        if body[K_IS] == 1 and begins(now_ms, known, report):
            keep_known(body, begun(known, report))
        return
    if tells_a_departure(known, report):
        traffic.left_ms[tram, stop_left(report)] = report.made_ms
    for other in range(len(traffic.trams)):
        ahead = traffic.trams[other]
        if ahead[K_IS] == 1 and was_beyond(known_of(ahead), report):
            traffic.row[tally.CONTRADICTED] += traffic.shown[other, tram] == 0 and traffic.shown[tram, other] == 1
            traffic.shown[other, tram] = 1
    if report.left and clears(known):
        traffic.known[1] = max(traffic.known[1], mark(report.stop, True))
    keep_known(body, reported(known, report))
    traffic.row[tally.BEYOND_DESTINATION] += is_beyond_its_destination(known_of(body))


@compiled
def view_of(limits: Any, traffic: Traffic, tram: int, own: Any, now_ms: int) -> Any:
    """As :func:`kernel.tram.centre.view`."""
    clear, present, near, recent = is_cleared(own, traffic.known[1]), False, False, False
    behind, behind_near = False, False
    for other in range(len(traffic.trams)):
        if traffic.trams[other, K_IS] == 0:
            continue
        known = known_of(traffic.trams[other])
        if other != tram:
            is_out = has_passed(own, known) or traffic.shown[tram, other] == 1
            clear = clear and is_out and not contradicts(traffic, tram, other)
            present = present or is_seen_in_the_way(limits, now_ms, own, known)
        left_ms = traffic.left_ms[other, own.stop]
        if left_ms != NEVER_MS and is_known_since(known, left_ms):
            near = near or now_ms - left_ms < limits.ahead_hold_ms
            recent = recent or now_ms - left_ms < limits.recovery_ms
        if not is_ahead(own, known):
            behind = True
            passed_ms = traffic.left_ms[tram, known.stop + 1]
            is_far = (
                passed_ms != NEVER_MS and is_known_since(own, passed_ms) and now_ms - passed_ms > limits.behind_hold_ms
            )
            behind_near = behind_near or not is_far
    return View(clear, present, not recent, near, behind and not behind_near)


@compiled
def is_clear_whoever_contradicts(traffic: Traffic, tram: int, own: Any) -> bool:
    """As :func:`kernel.tram.centre.is_clear`, but two trams that were shown in either order are each behind."""
    clear = bool(is_cleared(own, traffic.known[1]))
    for other in range(len(traffic.trams)):
        if other != tram and traffic.trams[other, K_IS] == 1 and traffic.shown[tram, other] == 0:
            clear = clear and has_passed(own, known_of(traffic.trams[other]))
    return clear


@compiled
def decide(day: Given, traffic: Traffic, tram: int, now_ms: int, rng: np.random.Generator) -> None:
    """Let the centre make an order for a tram that has told, and send it with the station's next request."""
    body = traffic.trams[tram]
    if body[K_IS] == 0:
        return
    own = known_of(body)
    view = view_of(day.limits, traffic, tram, own, now_ms)
    if day.plant == NEVER_PRESENT:
        view = View(True, False, view.ahead_is_far, view.ahead_is_near, view.behind_is_far)
    elif day.plant == IGNORES_CONTRADICTION:
        clear = is_clear_whoever_contradicts(traffic, tram, own)
        view = View(clear, view.is_present, view.ahead_is_far, view.ahead_is_near, view.behind_is_far)
    hand = HOLD + int(LIFT * rng.random()) if rng.random() < day.by_hand else 0
    limits = NEVER_STALE_LIMITS if day.plant == NEVER_STALE else day.limits
    order = decided(limits, now_ms, own, view, hand)
    keep_known(body, ordered(own, order))
    body[G_BEHIND] = view.behind_is_far or hand == HOLD
    judge(day, traffic, tram, own, order, now_ms)
    asks_s = now_ms // 1_000 + 2
    asks_s += (own.stop - asks_s) % CYCLE_S
    due_ms = 1_000 * asks_s + REQUEST_MS + slower_ms(day, now_ms // 1_000)
    holds, recovers = 1 if order.holds else 0, 1 if order.recovers else 0
    made_ms = order.made_ms + (day.ahead_ms if order.stop == day.where.ahead_station else 0)
    traffic.row[tally.FRAME_BROKEN] += made_ms != order.made_ms
    told = (tram, order.stop, holds, recovers, made_ms)
    send(traffic.orders[tram], traffic.due_ms[1], tram, due_ms, (*told, 0, order.made_ms))
    if rng.random() < day.repeats:
        to = int(len(traffic.trams) * rng.random()) if rng.random() < 0.5 else tram
        stray_ms = due_ms + int(1_000 * LATEST_S * rng.random())
        send(traffic.orders[to], traffic.due_ms[1], to, stray_ms, (*told, 1, order.made_ms))


# ---- what arrives


@compiled
def first_due_ms(box: Any) -> int:
    """When the first of the messages that are on their way is due."""
    first = LATE_MS
    for place in range(BOX):
        if box[place, 0] != FREE:
            first = min(first, box[place, 0])
    return int(first)


@compiled
def hear_of_the_other_way(day: Given, there: Traffic, tram: int, left: bool, made_ms: int, now_ms: int) -> None:
    """Let what a tram told of one way end its run on the other one, if that was before (G5)."""
    hear_elsewhere(there, tram, left, made_ms, now_ms)
    if day.plant == ANY_WORD_ENDS and there.trams[tram, K_IS] == 1:
        forget(there, tram, made_ms)


@compiled
def deliver_reports(
    day: Given, traffic: Traffic, there: Traffic, tram: int, now_ms: int, rng: np.random.Generator
) -> None:
    """Let the reports of a tram that are due come to the centre, which answers each with an order.

    ``there``: the other way.
    """
    box = traffic.reports[tram]
    for place in range(BOX):
        message = box[place]
        if message[R_DUE] == FREE or message[R_DUE] > now_ms:
            continue
        report = Report(
            message[R_STOP], message[R_LEFT] == 1, message[R_STANDS] == 1, message[R_LEAVES], message[R_MADE]
        )
        message[R_DUE] = FREE
        hear_report(traffic, tram, report, now_ms)
        hear_of_the_other_way(day, there, tram, report.left, report.made_ms, now_ms)
        by = traffic.trams[message[R_BY]]
        if by[K_IS] == 1 and report.made_ms > by[K_SINCE]:
            by[G_MARK] = max(by[G_MARK], mark(report.stop, report.left))
            if report.stands:
                by[G_TOLD] = max(by[G_TOLD], report.made_ms)
        decide(day, traffic, tram, now_ms, rng)
    traffic.due_ms[0, tram] = first_due_ms(box)


@compiled
def taken_now(day: Given, display: Any, order: Any) -> Any:
    """As :func:`kernel.tram.display.taken`; with a fault planted one of the future is taken too."""
    is_newer = order.made_ms > max(display.now_ms, display.made_ms)
    if day.plant == TAKES_THE_FUTURE and display.stands and order.stop == display.stop and is_newer:
        return Display(display.now_ms, True, display.stop, True, order.holds, order.recovers, order.made_ms)
    return taken(day.limits, display, order)


@compiled
def hear_order(day: Given, traffic: Traffic, tram: int, message: Any, now_s: int, rng: np.random.Generator) -> None:
    """Let a tram hear an order, for it or for another one; as :func:`kernel.tram.centre.received`.

    A unit takes what is for the number that it tells; one that is set to the other way hears nothing of this one.
    """
    body = traffic.trams[tram]
    if body[ON] == 0 or body[U_ASTRAY] == 1 or is_lost(day, tram, message[O_STOP], now_s, rng):
        return
    number = number_told(day, traffic, tram, now_s)
    before = display_of(body)
    order = Order(message[O_STOP], message[O_HOLDS] == 1, message[O_RECOVERS] == 1, message[O_MADE])
    if message[O_TRAM] == number or day.plant == NOT_ADDRESSED:
        after = taken_now(day, before, order)
        is_of_the_future = message[O_TRAM] == number and order.made_ms > before.now_ms
        traffic.row[tally.OF_THE_FUTURE] += is_of_the_future and after.made_ms == before.made_ms
        traffic.row[tally.WRONG_TRAM] += message[O_TRAM] != tram and after.made_ms != before.made_ms
        if after.made_ms != before.made_ms:
            body[G_MADE] = message[O_TRULY]
        keep_display(body, after)


@compiled
def deliver_orders(day: Given, traffic: Traffic, tram: int, now_s: int, rng: np.random.Generator) -> None:
    """Let the orders that are due be sent: all trams in reach of that stop hear them, a stray one anyhow."""
    box = traffic.orders[tram]
    for place in range(BOX):
        message = box[place]
        if message[O_DUE] == FREE or message[O_DUE] > 1_000 * now_s:
            continue
        message[O_DUE] = FREE
        if message[O_STRAY] == 1:
            hear_order(day, traffic, tram, message, now_s, rng)
            continue
        for place_in_line in range(traffic.size[0]):
            other = traffic.line[place_in_line]
            if is_in_reach(day, traffic, other, message[O_STOP]):
                hear_order(day, traffic, other, message, now_s, rng)
    traffic.due_ms[1, tram] = first_due_ms(box)
