"""Days at a road with everything at once, in mm and ms: a world of its own; no models and no proofs in it (X1 to X5).

Trains follow one another on two tracks, with radio and without; they stop far before the road, near it and on it, and
the last of a track runs to and fro, out over its start point and in again, or comes back from a starting signal beyond
the road.  Some promise ceilings.  Power fails, twice and for any time, with trains anywhere; so does that of terminals,
and their radio.  Decisions are taken a little early or late.  Rangings are late, wrong within their bounds, or do not
come, for minutes of one train; reads of a start point's tag are late or lost.  People release what has left, and
account for tracks that they see empty; their words and those of tails come late, and again.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from math import isqrt
from random import Random

from kernel.crossing import arrival
from kernel.crossing import crossing as machine
from kernel.crossing.arrival import ArrivalBounds, Followed, Ranging
from kernel.crossing.crossing import Crossing, CrossingTrack, Due, Signal, Signals, Standing, Train
from kernel.crossing.promise import Promise
from kernel.restarts import restart_crossing
from tests.crossing import ceilings
from tests.crossing.bodies import (
    BRAKES_MM_S2,
    GAIN_MM_S2,
    JITTER_MS,
    LENGTH_MM,
    LINE_MM_S,
    LONGEST_MS,
    OUT_MM,
    START_MM,
    Body,
    drawn,
    drive,
    hurried,
)
from tests.crossing.road import DOWN, SETTINGS, UP, restarted
from tests.crossing.terminals import NOBODY, TAG_MM, Terminal

OFF_MM, OFF_MM_S, LATEST_S = 5_000, 400, 2
BOUNDS = ArrivalBounds(
    LINE_MM_S * LONGEST_MS,
    GAIN_MM_S2 * LONGEST_MS,
    SETTINGS.cycle_ms,
    SETTINGS.warning_cycles,
    3,
    4 * OFF_MM,
    4 * OFF_MM_S + GAIN_MM_S2 + BRAKES_MM_S2,
)
LOOKS_S, LATE_S, WHOLE_S = 60, 30, 1_500
"""For so long people look, and so late their word may come; longer than that no day lasts."""
BEYOND = Signal("beyond the road, before it for who comes back")
SIGNALS = Signals(frozenset({BEYOND}))


@dataclass
class Found:
    """At each arrival, for how long the warning had lasted and the arms been lowered, in ms; and other counts.

    ``opened_on``: the road opened on a train that had asked for the warning; ``open_under``: on one across the road.
    ``beyond_ceiling``: a train was faster than the crossing held it to be.
    """

    warned_ms: list[int] = field(default_factory=list)
    lowered_ms: list[int] = field(default_factory=list)
    opened_on: int = 0
    open_under: int = 0
    beyond_ceiling: int = 0
    open_s: int = 0
    let_go: int = 0
    let_go_inside: int = 0
    failed_inside: int = 0
    counts: Counter[str] = field(default_factory=Counter)


@dataclass
class Day:
    """A road, its trains, and the time at which the last decision was taken.

    ``alone``: one train that promises, and no other; so nobody else closes the road.  ``hurries``: so does one alone,
    that runs slowly up to the road and asks to go faster only shortly before it.
    ``more``: what comes beside rangings is drawn from; ``past``: what becomes of asks past the road.
    ``dark``: the seconds without power.
    ``asked``: who has asked for the warning and is not out yet.
    ``air``: words of tails and people under way: when they come, of which train or track, and its number.
    """

    number: int
    alone: bool = False
    hurries: bool = False
    bodies: list[Body] = field(default_factory=list)
    found: Found = field(default_factory=Found)
    now_s: int = 0
    now_ms: int = 0
    warned_from_ms: int = -1
    lowered_from_ms: int = -1
    asked: set[Train] = field(default_factory=set)
    seen_s: dict[CrossingTrack, int] = field(default_factory=dict)
    air: list[tuple[int, str, Train | CrossingTrack, int]] = field(default_factory=list)
    crossing: Crossing = field(default_factory=restarted)
    dark: set[int] = field(default_factory=set)
    terminals: dict[CrossingTrack, Terminal] = field(default_factory=dict)
    owner: dict[Train, Body] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.chance, self.more = Random(f"any day {self.number}"), Random(f"more of any day {self.number}")
        self.past = Random(f"past the road on any day {self.number}")
        self.bodies = drawn(self.chance, self.more)
        if self.alone:
            self.bodies = [self.more.choice(self.bodies)]
            self.bodies[0].promises = self.bodies[0].has_radio = True
        if self.hurries:
            self.bodies = [hurried(Random(f"hurries on any day {self.number}"))]
        self.owner = {body.name: body for body in self.bodies}
        first_s = self.chance.randint(20, 500)
        fails = (first_s, first_s + self.chance.randint(30, 400))
        self.dark = {fail_s + second for fail_s in fails for second in range(self.chance.randint(1, 30))}
        if self.alone or self.hurries or self.more.random() < 0.4:
            self.dark = set()
        elif self.more.random() < 0.7:
            self.dark.add(self.more.randint(20, 90))
            self.dark.add(max(self.dark) + self.more.randint(LOOKS_S, LOOKS_S + 2 * LATE_S))
        for track in (UP, DOWN):
            self.crossing = machine.note_empty(self.crossing, track, machine.look_of(self.crossing, track))
            silent, dark = self.out(track, (0, 0, 10, 100)), self.out(track, (0, 0, 1, 30))
            if self.hurries:
                silent = dark = range(0)
            self.terminals[track] = Terminal(track, silent, dark)

    def out(self, track: CrossingTrack, lasts_s: tuple[int, ...]) -> range:
        """Some seconds about the time at which one of a track's trains may strike, without radio if there is one."""
        bodies = [body for body in self.bodies if body.track == track] or self.bodies
        body = self.more.choice([body for body in bodies if not body.has_radio] or bodies)
        out_s = max(5, (body.way_mm - START_MM) // LINE_MM_S - self.more.randint(0, 10))
        return range(out_s, out_s + self.more.choice(lasts_s))

    # ---- trains

    def run(self, lasts_ms: int) -> None:
        ahead: dict[CrossingTrack, Body] = {}
        for body in self.bodies:
            was_mm = body.way_mm
            self.judge_ceiling(body)
            drive(self.chance, body, ahead.get(body.track), self.now_s, lasts_ms)
            self.judge_ceiling(body)
            ahead[body.track] = body
            self.pass_start_point(body, was_mm)
            if was_mm > 0 >= body.way_mm and not body.met:
                body.met = True
                self.found.warned_ms.append(self.now_ms - self.warned_from_ms if self.crossing.warns else 0)
                self.found.lowered_ms.append(self.now_ms - self.lowered_from_ms if self.lowered_from_ms >= 0 else 0)
                self.found.counts["came back"] += body.comes_back
            if body.met and was_mm > -OUT_MM >= body.way_mm:
                self.tell_rear(body)
            self.found.open_under += body.is_across_the_road and not self.crossing.warns
            self.found.counts["stood on the road"] += body.is_across_the_road and body.speed_mm_s == 0
            self.found.counts["stood near the road"] += 0 < body.way_mm < 100_000 and body.speed_mm_s == 0
            if body.is_at_its_signal:
                body.turn(isqrt(2 * (-body.way_mm - LENGTH_MM) // GAIN_MM_S2))

    def judge_ceiling(self, body: Body) -> None:
        if body.followed is not None and body.promises:
            left_mm_s = body.noted.ceiling_mm_s - body.speed_mm_s
            self.found.beyond_ceiling += left_mm_s < 0
            self.found.counts["near a promised ceiling"] += left_mm_s < 3_000 and body.noted.ceiling_mm_s < LINE_MM_S

    def pass_start_point(self, body: Body, was_mm: int) -> None:
        """Read the tag before the detector of its start point, and strike that, on the way in."""
        terminal, counts = self.terminals[body.track], self.found.counts
        if not body.met and not body.comes_back and not body.stands_at_signal:
            if was_mm > START_MM + TAG_MM >= body.way_mm and body.has_radio:
                terminal.read(self.more, body.name, self.now_s)
            if was_mm > START_MM >= body.way_mm:
                name = terminal.strike(self.now_s)
                counts["missed"] += name == NOBODY
                counts["silent"] += self.now_s in terminal.silent
                if name != NOBODY:
                    counts["own"] += name == body.name
                    counts["not told"] += name != body.name and body.has_radio
                    body.names.add(name)
                    self.owner.setdefault(name, body)
        body.inside = body.comes_back or body.way_mm <= START_MM

    # ---- what the crossing is told

    def hear_terminals(self) -> None:
        for terminal in self.terminals.values():
            terminal.second(self.more, self.now_s)
            if self.now_s in self.dark:
                terminal.lose(self.now_s)
            else:
                self.crossing = terminal.hear(self.crossing, self.now_s)

    def follow(self) -> dict[Train, Due]:
        dues = dict[Train, Due]()
        for body in self.bodies:
            told = self.ranging(body)
            if body.promises:
                ceilings.promise_and_ask(self.more, body, self.now_s, self.found.counts)
            if body.promises and body.met:
                ceilings.ask_past_the_road(self.past, body, self.now_s)
            if not body.has_radio or body.met or body.stands_at_signal:
                continue
            now, heard = self.taken(body, told)
            if now is None:
                continue
            if self.is_let_go(body, now, told):
                continue
            under_way = len(body.heard)
            now = ceilings.acknowledge(self.more, BOUNDS, body, now, heard, self.now_s)
            if len(body.heard) > under_way and self.more.random() < 0.2:
                self.dark.add(self.now_s + self.more.randint(1, 30))
            body.followed = arrival.aged(BOUNDS, now)
            dues[body.name] = machine.due(BOUNDS, now, SETTINGS.reopening_cycles)
        return dues

    def taken(self, body: Body, told: Ranging) -> tuple[Followed | None, Promise | None]:
        """What is known of a train by its ranging, and what it was heard to hold to; contact may begin."""
        begins = body.followed is None
        if begins:
            if not arrival.begins_contact(BOUNDS, told) or told.way_mm <= 0:
                return None, None
            self.crossing = machine.note_contact(self.crossing, body.name)
            ceilings.begin_contact(body)
        if body.promises:
            ceilings.tell(body, self.now_s)
        known, heard = ceilings.note(self.more, BOUNDS, body, body.followed or arrival.nothing_known(BOUNDS))
        return (arrival.taken if begins else arrival.follow)(BOUNDS, known, told), heard

    def is_let_go(self, body: Body, now: Followed, told: Ranging) -> bool:
        if body.followed is None or not arrival.has_turned_back(BOUNDS, now, told, START_MM):
            return False
        self.found.let_go += 1
        self.found.let_go_inside += body.way_mm <= START_MM
        self.over(body.name, machine.number_of(self.crossing, body.name))
        return True

    def ranging(self, body: Body) -> Ranging:
        """Wrong by less than its bounds, which are taken off; late, or nothing."""
        way_mm = body.way_mm + self.chance.randint(-OFF_MM, OFF_MM) - OFF_MM
        speed_mm_s = body.speed_mm_s + self.chance.randint(-OFF_MM_S, OFF_MM_S) + OFF_MM_S
        body.said = ((self.now_s, way_mm, speed_mm_s), *body.said[:LATEST_S])
        taken_s, way_mm, speed_mm_s = self.chance.choice(body.said)
        is_heard = self.chance.random() > 0.05 and self.now_s not in body.unheard
        return Ranging(is_heard, way_mm, speed_mm_s, self.now_s - taken_s)

    # ---- who stands at the signal beyond the road

    def stand(self, body: Body) -> None:
        """Promise to stand, then ask to start, again and again, until it is let go."""
        if not body.stands_at_signal:
            return
        body.asks_s -= 1
        body.asks_to_start = body.asks_s < 0
        if not body.let_go and self.more.random() < 0.8:
            self.say("asks" if body.asks_to_start else "stands", body.name, 0, 3)
        if machine.may_start(SETTINGS, self.crossing, body.name):
            body.let_go = True
            self.say("go", body.name, 0, 3)

    def say(self, what: str, of: Train | CrossingTrack, number: int, latest_s: int) -> None:
        self.air.append((self.now_s + self.more.randint(0, latest_s), what, of, number))

    # ---- tails and people

    def tell_rear(self, body: Body) -> None:
        """A rear past the road is told, late and again: by tags of a train with radio, of any other by the detector."""
        for name in [body.name] if body.has_radio else sorted(body.names):
            number = machine.number_of(self.crossing, name)
            for latest_s in (5, 200):
                self.say("gone", name, number, latest_s)

    def over(self, name: Train, number: int) -> bool:
        """It is told gone, or released, by its number; if that is taken it is not followed any more."""
        known = name in self.crossing.numbers
        self.crossing = machine.note_gone(self.crossing, name, number, True)
        if not known or name in self.crossing.numbers:
            return False
        body = self.owner[name]
        if not body.is_in_the_approach:
            self.asked.discard(name)
        if name == body.name:
            body.followed, body.out_s = None, 0
        return True

    def hear_words(self) -> None:
        come = [word for word in self.air if word[0] <= self.now_s]
        self.air = [word for word in self.air if word[0] > self.now_s]
        for _, what, of, number in come:
            if what == "go":
                body = self.owner[Train(of)]
                if body.stands_at_signal:
                    body.start()
            elif self.now_s not in self.dark:
                self.hear_word(what, of, number)

    def hear_word(self, what: str, of: Train | CrossingTrack, number: int) -> None:
        if what == "empty":
            self.crossing = machine.note_empty(self.crossing, CrossingTrack(of), number)
            return
        body = self.owner[Train(of)]
        if what == "stands":
            self.crossing = machine.note_standing(SIGNALS, self.crossing, body.name, Standing(BEYOND, True))
        elif what == "asks" and not body.let_go:
            self.crossing = machine.note_start(self.crossing, body.name, body.run_cycles)
        elif what == "gone":
            self.found.counts["gone again"] += machine.number_of(self.crossing, Train(of)) not in (machine.NONE, number)
            if self.over(Train(of), number) and body.met:
                ceilings.end(self.past, body, self.now_s)

    def look(self) -> None:
        """Whom nothing else has told gone a person releases who sees it out; and he sees tracks empty."""
        for body in self.bodies:
            names = [name for name in sorted(body.names) if name != body.name or not body.stands_at_signal]
            is_out = not body.is_in_the_approach and (body.met or body.speed_mm_s <= 0)
            body.out_s = body.out_s + 1 if is_out and any(self.asks(name) for name in names) else 0
            if body.out_s > LOOKS_S:
                for name in names:
                    self.over(name, machine.number_of(self.crossing, name))
                body.out_s = 0
        for track in (UP, DOWN):
            empty = not any(body.is_in_the_way for body in self.bodies if body.track == track)
            closed = track in self.crossing.unaccounted and self.crossing.unaccounted[track]
            self.seen_s[track] = self.seen_s.get(track, 0) + 1 if closed and empty else 0
            if self.seen_s[track] > LOOKS_S:
                self.say("empty", track, machine.look_of(self.crossing, track), LATE_S)
                self.asked = {name for name in self.asked if self.owner[name].track != track or self.asks(name)}

    def asks(self, name: Train) -> bool:
        """Whether the crossing has it that this train has asked for the warning."""
        return name in self.crossing.asks and self.crossing.asks[name]

    # ---- a cycle

    def fail(self) -> None:
        """Without power it begins anew in each cycle, and nobody is followed."""
        self.found.failed_inside += any(body.is_in_the_approach for body in self.bodies)
        self.crossing = restart_crossing(SETTINGS, frozenset((UP, DOWN)), self.crossing.number + 1)
        for body in self.bodies:
            body.followed = None
        self.asked = {name for name in self.asked if self.owner[name].is_in_the_approach}

    def cycle(self) -> None:
        self.hear_terminals()
        self.hear_words()
        for body in self.bodies:
            self.stand(body)
        dues = self.follow()
        self.look()
        if self.now_s in self.dark:
            self.fail()
            dues = {}
        self.crossing = machine.decide(SETTINGS, self.crossing, dues)
        self.note_decision()
        self.crossing = machine.aged(self.crossing)
        next_ms = 1_000 * (self.now_s + 1) + self.chance.randint(-JITTER_MS, JITTER_MS)
        self.run(next_ms - self.now_ms)
        self.now_s, self.now_ms = self.now_s + 1, next_ms

    def note_decision(self) -> None:
        if not self.crossing.warns:
            self.warned_from_ms = -1
            self.found.opened_on += any(self.owner[name].is_in_the_approach for name in self.asked)
        elif self.warned_from_ms < 0:
            self.warned_from_ms = self.now_ms
        if not machine.arms_are_to_be_down(SETTINGS, self.crossing):
            self.lowered_from_ms = -1
        elif self.lowered_from_ms < 0:
            self.lowered_from_ms = self.now_ms
        self.asked |= {train for train, asks in self.crossing.asks.items() if asks}
        self.found.open_s += not self.crossing.warns


def played(number: int, alone: bool = False, hurries: bool = False) -> Found:
    day = Day(number, alone, hurries)
    while day.now_s < WHOLE_S and not all(body.is_done for body in day.bodies):
        day.cycle()
    day.found.counts["arrived"] += sum(body.met or body.comes_back for body in day.bodies)
    return day.found


def judge(number: int, alone: bool = False, hurries: bool = False) -> Found:
    """Full warning and arms down before each arrival, and nobody faster than the crossing holds it to be."""
    found = played(number, alone, hurries)
    assert alone or found.warned_ms
    assert min(found.warned_ms, default=10**6) >= SETTINGS.cycle_ms * SETTINGS.warning_cycles
    assert min(found.lowered_ms, default=10**6) >= SETTINGS.cycle_ms * (
        SETTINGS.lowering_cycles + SETTINGS.least_down_cycles
    )
    assert found.opened_on == found.open_under == found.let_go_inside == found.beyond_ceiling == 0
    return found
