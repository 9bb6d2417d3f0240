"""What trains promise, tell and hear, and what a crossing notes of it and acknowledges: late, again, or never (X2)."""

from __future__ import annotations

from collections import Counter
from random import Random

from kernel.crossing import arrival, promise
from kernel.crossing import crossing as machine
from kernel.crossing.arrival import ArrivalBounds, Followed
from kernel.crossing.promise import Promise, nothing_promised
from tests.crossing.bodies import FAR_MM, LEAST_MM_S, LINE_MM_S, LONGEST_MS, ODOMETRY_MM_S, RESPONDS_MM_S, Body
from tests.crossing.road import SETTINGS


def promise_and_ask(chance: Random, body: Body, now_s: int, counts: Counter[str]) -> None:
    """Take the acknowledgements that have come; promise less, whatever the speed is, or ask for more.

    One that stands far before the road promises to stand, with its brake on already, and asks to run when its time
    there is over.
    """
    body.upper_mm_s = max(0, body.speed_mm_s) + chance.randint(0, ODOMETRY_MM_S)
    if now_s in body.off:
        counts["off below the line's"] += body.held.ceiling_mm_s < LINE_MM_S
        return
    was = body.held
    for _, number in [heard for heard in body.heard if heard[0] <= now_s]:
        body.held = promise.note_acknowledged(body.held, number)
    body.heard = [heard for heard in body.heard if heard[0] > now_s]
    counts["let go faster"] += body.held.ceiling_mm_s > was.ceiling_mm_s
    if body.held.ceiling_mm_s == 0:
        if body.stands_s == 0 and body.held.asked_mm_s == 0:
            body.held = promise.ask(LINE_MM_S, body.held, LINE_MM_S)
    elif body.speed_mm_s == 0 and body.stands_s in range(3, 20) and body.way_mm > FAR_MM - 100_000:
        body.held, body.brakes = promise.lower(body.held, 0, 0), True
        counts["promised to stand"] += 1
    elif not body.hurries and chance.random() < (0.04 if body.held.asked_mm_s == body.held.ceiling_mm_s else 0.01):
        lower_mm_s = chance.randint(LEAST_MM_S, max(LEAST_MM_S, body.held.ceiling_mm_s))
        body.held = promise.lower(body.held, lower_mm_s, body.upper_mm_s + RESPONDS_MM_S)
        counts["lowered"] += body.held.number > was.number
    elif asks_now(chance, body):
        least_mm_s = LINE_MM_S * 9 // 10 if body.hurries else LEAST_MM_S
        body.held = promise.ask(LINE_MM_S, body.held, chance.randint(least_mm_s, LINE_MM_S))
        counts["asked"] += body.held.number > was.number


def asks_now(chance: Random, body: Body) -> bool:
    """Tell whether it asks to go faster in this second: near enough, and with no ask that stands."""
    nears = body.way_mm < body.asks_mm and chance.random() < (0.5 if body.hurries else 0.06)
    return nears and body.held.asked_mm_s == body.held.ceiling_mm_s


def tell(body: Body, now_s: int) -> None:
    """Tell what it holds to, in answer to an order of this contact; whether that is heard is another matter."""
    if now_s not in body.off:
        body.told.append(body.held)


def begin_contact(body: Body) -> None:
    """In a new contact nothing is noted, and what was told before is not heard."""
    body.noted, body.told = nothing_promised(LINE_MM_S), []


def note(chance: Random, bounds: ArrivalBounds, body: Body, known: Followed) -> tuple[Followed, Promise | None]:
    """Hear something that was told, mostly of the last seconds, and reckon with what is noted."""
    heard = None
    if body.told and chance.random() < 0.6:
        heard = chance.choice(body.told[-3:] if chance.random() < 0.8 else body.told)
        body.noted = promise.note(body.noted, heard)
    return arrival.held_to(bounds, known, LONGEST_MS * body.noted.ceiling_mm_s), heard


def acknowledge(
    chance: Random, bounds: ArrivalBounds, body: Body, known: Followed, heard: Promise | None, now_s: int
) -> Followed:
    """Acknowledge what is asked for, if it is for it to be; that comes once, twice, a minute late, or never."""
    if heard is None or heard.asked_mm_s <= heard.ceiling_mm_s or heard.number != body.noted.number:
        return known
    asked_um = LONGEST_MS * body.noted.asked_mm_s
    if not machine.may_go_faster(bounds, known, asked_um, SETTINGS.reopening_cycles):
        return known
    body.noted = promise.acknowledged(body.noted)
    for _ in range(chance.choice((0, 1, 1, 2))):
        body.heard.append((now_s + chance.choice((1, 1, 5, 30, 60)), body.noted.number))
    return arrival.held_to(bounds, known, asked_um)


def ask_past_the_road(chance: Random, body: Body, now_s: int) -> None:
    """Ask for the line's speed once the head is past the road, and tell so until the rear is proved past."""
    if now_s in body.off or body.followed is None:
        return
    if body.held.asked_mm_s == body.held.ceiling_mm_s:
        body.held = promise.ask(LINE_MM_S, body.held, LINE_MM_S)
    body.told.append(body.held)
    if chance.random() < 0.6:
        body.noted = promise.note(body.noted, chance.choice(body.told[-3:]))


def end(chance: Random, body: Body, now_s: int) -> None:
    """Its rear is past, and nobody reckons by its ceiling any more: its ask is acknowledged, late and again."""
    body.noted = promise.acknowledged(body.noted)
    for _ in range(chance.choice((1, 2))):
        body.heard.append((now_s + chance.choice((1, 1, 5, 60, 200)), body.noted.number))
