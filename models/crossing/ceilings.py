"""Trains that promise a ceiling on their way to the road, ask to go faster, and are let or not (X2).

A promise is told with a train's place, so it is lost, late and repeated as rangings are; acknowledgements are lost as
often, come a second later, and sometimes come again.
"""

from __future__ import annotations

from typing import Any

from models.compiled import compiled
from models.crossing.columns import NUMBER
from models.crossing.made import MADE
from models.crossing.radio import KEPT, STRIDE
from models.crossing.sites import SETTINGS
from models.crossing.traffic import NEVER, POOL

Promise = MADE.promise.Promise
lower, ask, note_acknowledged = MADE.promise.lower, MADE.promise.ask, MADE.promise.note_acknowledged
note, acknowledged, nothing_promised = MADE.promise.note, MADE.promise.acknowledged, MADE.promise.nothing_promised
may_go_faster, held_to = MADE.crossing.may_go_faster, MADE.arrival.held_to
PROMISED, ASKED, LET, BEYOND_CEILING = (
    NUMBER[name] for name in ("promised", "asked_faster", "let_faster", "beyond_ceiling")
)
CYCLE_MS, REOPENING_CYCLES = SETTINGS.cycle_ms, SETTINGS.reopening_cycles
AGAIN = 0.02
"""So often an acknowledgement of before comes again (ours)."""


@compiled
def held_by(run: Any, train: int) -> Any:
    """Give what a train holds to."""
    return Promise(run[train].held_number, run[train].held_mm_s, run[train].held_asked_mm_s)


@compiled
def hold(run: Any, train: int, held: Any) -> None:
    """Let a train hold to something."""
    run[train].held_number, run[train].held_mm_s, run[train].held_asked_mm_s = (
        held.number, held.ceiling_mm_s, held.asked_mm_s
    )  # fmt: skip


@compiled
def noted_of(run: Any, train: int) -> Any:
    """Give what the crossing has noted of a train."""
    return Promise(run[train].noted_number, run[train].noted_mm_s, run[train].noted_asked_mm_s)


@compiled
def keep(run: Any, train: int, noted: Any) -> None:
    """Let the crossing note something."""
    run[train].noted_number, run[train].noted_mm_s, run[train].noted_asked_mm_s = (
        noted.number, noted.ceiling_mm_s, noted.asked_mm_s
    )  # fmt: skip


@compiled
def forget_promise(run: Any, line: Any, train: int, kind: Any) -> None:
    """Let the crossing forget, as it does of a new contact and at a restart."""
    keep(run, train, nothing_promised(-(-line.line_um[kind] // CYCLE_MS)))


@compiled
def promises(day: Any, run: Any, line: Any, train: int, now: int, out: Any) -> None:
    """Let a train in reach promise, or ask, and take an acknowledgement that is under way; then tell what it holds to.

    It promises the speed that its driver means to keep, and what the speed supervision lets through.
    """
    kind, held = day.trains[train].local, held_by(run, train)
    speed_most_mm_s = run[train].pace_um // CYCLE_MS + 1 + int(1e3 * line.own_speed_error_m_s)
    before = held.number
    if held.number == 0:
        ceiling_m_s = line.limit_m_s[kind] * day.trains[train].share + line.ceiling_over_m_s
        held = lower(held, min(held.ceiling_mm_s, 1 + int(1e3 * ceiling_m_s)), speed_most_mm_s)
        out[PROMISED] += held.number > before
    elif run[train].asks == 0 and 0 < run[train].way_um <= day.trains[train].asks_um:
        run[train].asks = 1
        held = ask(line.line_um[kind] // CYCLE_MS, held, line.line_um[kind] // CYCLE_MS)
        out[ASKED] += held.number > before
    chance = day.uniform[(train * STRIDE + 5 * now + 1) % POOL]
    if run[train].sent_number != NEVER and chance >= line.loss:
        run[train].last_number, run[train].sent_number = run[train].sent_number, NEVER
        held = hear(run, train, held, run[train].last_number, out)
    elif run[train].last_number != NEVER and chance < AGAIN:
        held = hear(run, train, held, run[train].last_number, out)
    hold(run, train, held)
    run[train].hurries = run[train].asks == 1 and held.ceiling_mm_s == held.asked_mm_s
    place = now % KEPT
    run[train].told_number[place], run[train].told_ceiling_mm_s[place] = held.number, held.ceiling_mm_s
    run[train].told_asked_mm_s[place] = held.asked_mm_s


@compiled
def hear(run: Any, train: int, held: Any, number: int, out: Any) -> Any:
    """Let a train hear an acknowledgement."""
    after = note_acknowledged(held, number)
    out[LET] += after.ceiling_mm_s > held.ceiling_mm_s
    return after


@compiled
def told_at(run: Any, train: int, place: Any) -> Any:
    """Give what a train told at one of the moments that are kept."""
    return Promise(
        run[train].told_number[place], run[train].told_ceiling_mm_s[place], run[train].told_asked_mm_s[place]
    )


@compiled
def take_promise(bounds: Any, run: Any, train: int, followed: Any, told: Any) -> Any:
    """Let the crossing note what came with a ranging that counts, and reckon with it."""
    run[train].heard_asking = 0
    if told.valid:
        heard = told_at(run, train, run[train].brought_place)
        keep(run, train, note(noted_of(run, train), heard))
        run[train].heard_asking = heard.asked_mm_s > heard.ceiling_mm_s and heard.number == run[train].noted_number
    return held_to(bounds, followed, CYCLE_MS * run[train].noted_mm_s)


@compiled
def answer_ask(bounds: Any, run: Any, train: int, known: Any) -> Any:
    """Acknowledge what a train asks for, if it is for it to be."""
    noted = noted_of(run, train)
    if run[train].heard_asking == 0:
        return known
    if not may_go_faster(bounds, known, CYCLE_MS * noted.asked_mm_s, REOPENING_CYCLES):
        return known
    keep(run, train, acknowledged(noted))
    run[train].sent_number = noted.number
    return held_to(bounds, known, CYCLE_MS * noted.asked_mm_s)


@compiled
def judge_ceiling(run: Any, train: int, out: Any) -> None:
    """Hold a train's pace against what the crossing holds it to be capable of."""
    holds = run[train].contact == 1
    out[BEYOND_CEILING] += holds and run[train].pace_um > CYCLE_MS * run[train].noted_mm_s
