"""Which event happens next: at random, but so that most change something.

What a schedule looks at to choose only makes an event more likely; none is ever ruled out for good.
"""

from __future__ import annotations

from collections.abc import Callable
from random import Random

from kernel.names import Run, Stage, Train
from tests.independent.world.rails import BETWEEN
from tests.independent.world.told import TAG_MM
from tests.independent.world.trains import LONG_CYCLES, OnRails
from tests.independent.world.world import Event, World

SAYS = ("echo", "given back", "stopped", "tail report")
SHUTTLES_SHORT_MM = 100
"""So near to the place that he runs to does a driver stop who is soon to turn."""
NEAR_MM = 40_000
"""Farther than this he runs over no boundary before he turns."""
MIXED_UP = 0.03
"""Of lists that arrive so many are mixed up with another by the unit, where things go wrong."""
TRIES = 6
"""So often another actor is asked before an event that may change nothing is taken."""


Habit = dict[str, tuple[float, ...]]
ANYTHING: Habit = {
    "missed_of_100": (0, 0, 0, 3, 20),
    "turns": (0.01, 0.05, 0.2),
    "halts": (0.02, 0.1, 0.3),
    "repeats": (0.0, 0.05, 0.2),
    "losses": (0.0, 0.05, 0.2),
    "shuttles": (0.0, 0.0, 0.6),
    "short_mm": (0, 8_000, 8_000),
    "hesitates": (0.0, 0.0, 0.8),
    "draws_up": (0.0, 0.0, 0.1),
    "long_routes": (0.0, 0.8, 0.8),
    "most_pending": (0, 0, 1, 4),
    "recalls": (0.0, 0.3, 3.0),
    "restarts": (0.0, 0.05, 0.3),
    "trouble": (0.0, 0.3, 1.0),
}
"""What a seed draws from: reads missed, how often drivers turn, halt, stop astride and wait, how far off the end they
keep, how long and how many routes are asked for, and what goes wrong."""
QUIET: Habit = {"missed_of_100": (0,), "repeats": (0.0,), "losses": (0.0,), "restarts": (0.0,), "trouble": (0.0,)}
HABITS: dict[str, Habit] = {
    "anything": {},
    "anything as well": {},
    "laps": QUIET
    | {"turns": (0.01,), "halts": (0.02,), "shuttles": (0.0,), "short_mm": (8_000,), "hesitates": (0.0,)}
    | {"long_routes": (0.9,), "most_pending": (0,), "recalls": (0.0,)},
    "to and fro": QUIET
    | {"turns": (0.4,), "halts": (0.05,), "shuttles": (0.8,), "short_mm": (8_000,), "hesitates": (0.0,)}
    | {"long_routes": (0.0,), "most_pending": (1,), "recalls": (0.0,)},
    "recalls": QUIET
    | {"turns": (0.05,), "shuttles": (0.0,), "short_mm": (0,), "hesitates": (0.8,)}
    | {"most_pending": (1,), "recalls": (3.0,)},
    "draws up": QUIET | {"turns": (0.01,), "short_mm": (0,), "draws_up": (0.5,), "most_pending": (1,)},
}
"""Ways to run a line that wear at one place: round and round, to and fro over a boundary, routes taken back, stops
just short of a block by the driver's hand, who has yet to put the brake on."""


class Schedule:
    """A biased random choice of events; each seed has faults of its own, and habits unless one is named."""

    def __init__(self, world: World, seed: int, habit_named: str | None = None) -> None:
        self.world = world
        self.random = Random(seed ^ 0x5EED)
        habit = self.random.choice(list(HABITS.values()) if habit_named is None else [HABITS[habit_named]])
        of = {name: self.random.choice(values) for name, values in (ANYTHING | habit).items()}
        world.missed_of_100 = int(of["missed_of_100"])
        self.turns = of["turns"]
        self.halting = dict.fromkeys(world.trains, False)
        self.halts = of["halts"]
        self.repeats = of["repeats"]
        self.mixed_up = MIXED_UP * of["trouble"]
        self.losses = of["losses"]
        self.shuttles = of["shuttles"]
        self.short_mm = int(of["short_mm"])
        self.hesitates = of["hesitates"]
        self.draws_up = of["draws_up"]
        self.long_routes = of["long_routes"]
        self.most_pending = of["most_pending"]
        self.actors: list[tuple[Callable[[], Event | None], float]] = [
            (self.a_train, 34.0),
            (self.the_air, 34.0),
            (self.the_centre, 16.0),
            (self.a_point, 8.0),
            (self.the_signaller, 6.0),
            (self.recalls, of["recalls"]),
            (self.a_reading, 0.3),
            (self.a_restart, of["restarts"]),
            (self.two_persons, 0.3 * of["trouble"]),
            (self.a_fault, 0.01 * of["trouble"]),
        ]
        self.weights = [weight for _, weight in self.actors]

    def next(self) -> Event:
        """Choose an event."""
        for _ in range(TRIES):
            ((actor, _),) = self.random.choices(self.actors, self.weights)
            event = actor()
            if event is not None:
                return event
        return self.the_air() or ("centre_challenges", self.random.choice(list(self.world.trains)))

    # ---- actors: each gives an event that is likely to change something, or none

    def the_air(self) -> Event | None:
        air, chance = self.world.air, self.random
        if not air:
            return None
        message = air[-1] if chance.random() < 0.5 else chance.choice(air)
        recalls = [each for each in air if each[0] == "recall"]
        if recalls and chance.random() < 0.3:
            message = recalls[-1]
        if chance.random() < self.losses:
            return "lose", message
        if message[0] == "offer" and chance.random() < self.mixed_up:
            return "keep_another", message, chance.getrandbits(63)
        return "deliver", message, chance.random() < self.repeats

    def a_train(self) -> Event | None:
        chance = self.random
        train = chance.choice(list(self.world.trains.values()))
        if train.isolated:
            return self._on_the_spot(train)
        if train.braked_cycles == 0 and chance.random() < self.draws_up:
            return self._by_hand(train)
        front_most = train.place + train.errors_mm[1]
        if train.at_rest and (not self.world.calls.could_start(train.board, front_most, train.demanded)):
            return self._stands(train)
        if train.at_rest and chance.random() < (self.shuttles if len(train.blocks) > 1 else 0.2):
            return self._stands(train)
        if train.at_rest and chance.random() < self.hesitates:
            return self._says(train)
        halts = self.shuttles if len(train.blocks) > 1 else self.halts
        if train.at_rest or chance.random() < halts:
            self.halting[train.name] = not train.at_rest
        pull = not self.halting[train.name]
        if not train.at_rest and chance.random() < 0.1:
            return self._says(train)
        cycles = chance.randrange(2, 15) if chance.random() < 0.3 else chance.randrange(15, 60)
        if (
            pull
            and self.short_mm
            and train.at_rest
            and self.world.calls.end_mm(train.board) - train.place < self.short_mm
        ):
            return self._stands(train)
        bits = chance.getrandbits(63)
        if train.at_rest and self.short_mm and len(train.blocks) > 1 and chance.random() < self.shuttles:
            return "move", train.name, LONG_CYCLES, SHUTTLES_SHORT_MM, bits, self._to_and_fro_mm(train)
        return "move", train.name, cycles, self.short_mm if pull else None, bits

    def _to_and_fro_mm(self, train: OnRails) -> int:
        """How far a driver runs who is soon to turn: until front or rear is just over the next boundary."""
        over = [at - train.place for at, _, kind, _ in train.happenings if kind in ("front", "rear")]
        return min([NEAR_MM, *over]) + self.random.randrange(TAG_MM, 3 * TAG_MM)

    def _by_hand(self, train: OnRails) -> Event | None:
        """A driver draws up to the next block, is located anew there, and pulls while his brake has yet to respond."""
        name, bits = train.name, self.random.getrandbits(63)
        if not train.at_rest:
            ahead_mm = train.front_block_end_mm - train.place
            return "move", name, LONG_CYCLES, self.random.randrange(20, 300), bits, ahead_mm
        if train.board.asks_anew:
            return self._unless_said(("centre_challenges", name))
        if self.world.calls.could_start(train.board, train.place + train.errors_mm[1], train.demanded):
            return "ask_anew", name
        return "move", name, LONG_CYCLES, 0, bits

    def _stands(self, train: OnRails) -> Event | None:
        """A train at rest: its driver changes ends, or it says what there is to say."""
        calls, chance = self.world.calls, self.random
        may_go = any(calls.may_proceed(train.board, run) for run in calls.orders(train.board)[-3:])
        if not train.isolated and train.whole and chance.random() < (max(0.3, self.turns) if may_go else self.turns):
            return "turn", train.name, chance.getrandbits(63)
        if train.demanded and chance.random() < 0.1:
            return self.random.choice(("restart_board", "ask_anew")), train.name
        return self._says(train)

    def _says(self, train: OnRails) -> Event | None:
        calls, centre, chance = self.world.calls, self.world.centre, self.random
        orders = calls.orders(train.board)
        if not calls.is_accounted(centre, train.board, train.name):
            return self._unless_said(("train_says", train.name, "answered", None))
        if not orders:
            return None
        if chance.random() < 0.03:
            return "train_says", train.name, chance.choice(SAYS), chance.choice(orders)
        for run in reversed(orders):
            if calls.unreported(train.board, centre, run):
                return self._unless_said(("train_says", train.name, "tail report", run))
        run = orders[-1] if chance.random() < 0.5 else chance.choice(orders)
        stage = calls.stage(centre, run) if run in centre.runs else None
        if stage == Stage.OFFERED:
            return self._unless_said(("train_says", train.name, "echo", run))
        if calls.given_back(train.board, run) and stage == Stage.SET:
            return self._unless_said(("train_says", train.name, "given back", run))
        if stage == Stage.SET and self.world.told.layout.overlap[run.route] and train.at_rest:
            if calls.stopped(train.board, run) is not None:
                return self._unless_said(("train_says", train.name, "stopped", run))
            begun = not calls.is_ahead(centre, train.board, run)
            if begun and train.front_block == self.world.told.layout.destination[run.route]:
                return "note_stopped", train.name, run
        return None

    def _unless_said(self, event: Event) -> Event | None:
        """Say it, unless it is in the air; then it had better arrive."""
        said = self.world.says(event)
        if not said:
            return None
        in_air = [message for message in said if message in self.world.air]
        if in_air:
            return "deliver", in_air[0], self.random.random() < self.repeats
        return event

    def the_centre(self) -> Event | None:
        calls, centre, chance = self.world.calls, self.world.centre, self.random
        trains = self.world.trains.values()
        deaf = [
            t.name
            for t in trains
            if t.at_rest and t.whole and not t.isolated
            if t.board.asks_anew or not calls.is_accounted(centre, t.board, t.name)
        ]
        if deaf and chance.random() < 0.5:
            name = chance.choice(deaf)
            answer = (
                None
                if self.world.trains[name].board.asks_anew
                else self._unless_said(("train_says", name, "answered", None))
            )
            return answer or self._unless_said(("centre_challenges", name))
        blocks, points = calls.recoverable(centre)
        if blocks and chance.random() < 0.6:
            return "recover_block", chance.choice(blocks)
        unheard = calls.unheard(centre)
        if unheard and chance.random() < 0.3:
            return self._unless_said(("point_says", chance.choice(unheard), "life"))
        if points and chance.random() < 0.3:
            return "recover_point", chance.choice(points)
        runs = calls.runs(centre)
        for _ in range(min(6, len(runs))):
            run = runs[-1 - chance.randrange(min(4, len(runs)))] if chance.random() < 0.3 else chance.choice(runs)
            event = self._of(run)
            if event is not None:
                return event
        return None

    def _of(self, run: Run) -> Event | None:
        """What the centre does next about a run."""
        calls, centre, chance = self.world.calls, self.world.centre, self.random
        stage = calls.stage(centre, run)
        if stage == Stage.STANDING and not calls.held_for(centre, run):
            return "retire", run
        if stage == Stage.RESERVED:
            missing = calls.missing_points(centre, run)
            if missing:
                return self._unless_said(("centre_orders", run, chance.choice(missing)))
            return "open_first_loop", run
        if stage == Stage.OVER:
            return "retire", run
        board = self.world.trains[run.train].board
        if stage == Stage.STANDING and (below := calls.points_below(centre, run)) and chance.random() < 0.5:
            return self._unless_said(("centre_enquires", run, chance.choice(below)))
        if calls.word_is_known(centre, board, run) and chance.random() < 0.98:
            return None
        return self._unless_said(("centre_says", run))

    def a_point(self) -> Event | None:
        world, chance = self.world, self.random
        if not world.lies:
            return None
        point = chance.choice(list(world.lies))
        machine = world.terminals[point]
        wanted = world.calls.wanted(machine)
        if world.calls.is_unlocked(machine):
            if wanted is not None and world.lies[point] == wanted and chance.random() < 0.8:
                return "lock", point
            if wanted is not None and chance.random() < 0.7:
                return "throw", point, BETWEEN if world.lies[point] != BETWEEN and chance.random() < 0.5 else wanted
            return "throw", point, chance.choice([BETWEEN, *sorted(world.told.network.junctions[point].joins)])
        if world.calls.confirms(machine, point, world.lies[point]) is not None:
            if chance.random() < 0.9 and world.calls.is_proved(world.centre, machine, point):
                return None
            return self._unless_said(("point_says", point, "confirms"))
        return None

    def the_signaller(self) -> Event | None:
        """A route for a train, from where it stands or will."""
        world, chance, centre = self.world, self.random, self.world.centre
        train = chance.choice(list(world.trains.values()))
        life = world.calls.life(train.board)
        bases = [
            run
            for run in world.calls.runs(centre)
            if run.train == train.name
            and run.life == life
            and world.calls.stage(centre, run) in (Stage.SET, Stage.STANDING)
        ]
        wanted = [
            run
            for run in world.calls.runs(centre)
            if run.train == train.name and world.calls.is_ahead(centre, train.board, run)
        ]
        if not bases or not world.calls.orders(train.board) or len(wanted) > self.most_pending:
            return None
        base = bases[-1] if chance.random() < 0.7 else chance.choice(bases)
        starts = world.starts(centre, base)
        if chance.random() < 0.8:
            starts = [block for block in starts if block in train.blocks] or starts
        if chance.random() < 0.4:
            starts = [block for block in starts if block == train.front_block] or starts
        routes = [route for block in starts for route in world.routes_from[block]]
        pending = {run.route for run in wanted}
        if not routes:
            return None
        covers = world.told.layout.covers
        most = max(len(covers[route]) for route in routes)
        if chance.random() < self.long_routes:
            routes = [route for route in routes if len(covers[route]) == most]
        for _ in range(4):
            route = chance.choice(routes)
            if route not in pending and not world.calls.is_refused(centre, train.name, route, base):
                return "request", train.name, route, base
        return None if chance.random() < 0.98 else ("request", train.name, chance.choice(routes), base)

    def recalls(self) -> Event | None:
        calls, centre, chance = self.world.calls, self.world.centre, self.random
        runs = [run for run in calls.runs(centre) if calls.stage(centre, run) not in (Stage.STANDING, Stage.OVER)]
        if not runs:
            return None
        run = runs[-1] if chance.random() < 0.4 else chance.choice(runs)
        for each in runs:
            train = self.world.trains[each.train]
            if train.at_rest and calls.may_proceed(train.board, each) and chance.random() < 0.5:
                run = each
        return ("withdraw" if calls.stage(centre, run) == Stage.RESERVED else "cancel"), run

    def a_reading(self) -> Event | None:
        chance = self.random
        train = chance.choice(list(self.world.trains.values()))
        at_head = chance.random() < 0.3
        if chance.random() < 0.02:
            return "read_foreign", train.name, at_head, chance.choice(sorted(self.world.told.layout.tag_in))
        return ("read_again", train.name, at_head) if self.world.reads_below(train, at_head) else None

    def a_restart(self) -> Event | None:
        world, chance = self.world, self.random
        what = chance.random()
        if what < 0.2:
            return ("restart_centre",)
        if what < 0.7 or not world.terminals:
            return "restart_board", chance.choice(list(world.trains))
        return "restart_terminal", chance.choice(list(world.terminals))

    def two_persons(self) -> Event | None:
        world, chance = self.world, self.random
        name: Train = chance.choice(list(world.trains))
        train = world.trains[name]
        if train.isolated:
            return self._on_the_spot(train)
        return ("isolate", name) if train.at_rest else None

    def _on_the_spot(self, train: OnRails) -> Event | None:
        """What two persons do about a train whose unit is isolated; the first may err, and correct himself."""
        world, chance, name = self.world, self.random, train.name
        what = chance.random()
        if self.world.calls.is_accounted(world.centre, train.board, name):
            return None if what < 0.9 else ("reconnect", name)
        if train.board.unit.isolated_in != world.centre.epoch:
            return "isolate", name
        if what < 0.4 and name in world.statements:
            return "confirm", name
        if what < 0.45:
            return "reconnect", name
        blocks = train.blocks
        if chance.random() < 0.3:
            blocks = frozenset([chance.choice(sorted(world.told.layout.blocks))])
        return "state", name, blocks

    def a_fault(self) -> Event | None:
        chance = self.random
        train = chance.choice(list(self.world.trains.values()))
        return ("part", train.name, chance.randrange(1, len(train.cars_mm))) if train.whole else None
