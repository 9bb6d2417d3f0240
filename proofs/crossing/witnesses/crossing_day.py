"""A crossing in service, played: its trains, its cycles, and a person who looks (X2 to X5)."""

from __future__ import annotations

from dataclasses import replace

from kernel.crossing import crossing as machine
from kernel.crossing.crossing import Crossing, CrossingTrack, Due, Settings, Signal, Signals, Train
from models.crossing.level import Arrived, Body, Level, Road
from proofs.crossing.crossing import THEORY
from proofs.onboard.witnesses.play import Play

UP, DOWN = CrossingTrack("up"), CrossingTrack("down")
ONE, TWO, THREE = Train("1"), Train("2"), Train("3")
SETTINGS = Settings(
    cycle_ms=1_000,
    warning_cycles=40,
    bell_cycles=5,
    lowering_cycles=10,
    least_down_cycles=20,
    lifting_cycles=6,
    reopening_cycles=20,
    silence_cycles=2,
    start_cycles=44,
)
"""A cycle of a second; 15 s to barriers down and then 25 s: the standard, and 5 s more."""
STATION, BEYOND = Signal("the station's, before the road"), Signal("before the next road")
SITE = Road(SETTINGS, frozenset({UP, DOWN}), Signals(frozenset({STATION})))


def new() -> Level:
    """A crossing that has just been built."""
    unheard = {UP: 0, DOWN: 0}
    return Level(
        in_service=False,
        bodies={},
        told={},
        starting={},
        crossing=Crossing(
            asks={},
            starts={},
            silent_cycles=unheard,
            unaccounted={},
            numbers={},
            looks={},
            number=0,
            warns=False,
            warned_cycles=0,
        ),
        accounted=frozenset(),
        asked={},
        newest=0,
        restarted=False,
        unseen=False,
        decided=False,
        warned_cycles=0,
        lowered_cycles=0,
        are_down=False,
        down_cycles=0,
        opened_cycles=0,
        unheard_cycles=unheard,
        last=Arrived(False, 0, 0, False, 0),
    )


class Day(Play[Road, Level]):
    """A crossing in service; its tracks have been seen to be empty and its road is open, if not told otherwise."""

    def __init__(self, settings: Settings = SETTINGS, *, opened: bool = True) -> None:
        """Begin."""
        super().__init__(THEORY, Road(settings, SITE.tracks, SITE.signals), new())
        self.step("put_into_service", number=1)
        assert self.system.in_service == machine.are_lawful(settings)
        if opened and self.system.in_service:
            self.account(UP, DOWN)
            self.cycle()
            for track in (UP, DOWN):
                self.step("hear_terminal", track=track, age_cycles=0)
            assert not self.warns()

    def restart(self, over: int = 1) -> Level:
        """Power fails and is back; what starts has a number that is so much over the last one."""
        return self.step("restart", number=self.system.newest + over)

    def account(self, *tracks: CrossingTrack) -> None:
        """A person has seen tracks to be empty."""
        for track in tracks:
            self.step("account", track=track, number=machine.look_of(self.system.crossing, track))
            assert self.system.crossing.unaccounted[track] is False
            assert track in self.system.accounted

    def come(self, train: Train, track: CrossingTrack = UP, *, contact: bool = True) -> None:
        """A train comes, in contact if not told otherwise."""
        number = self.system.crossing.number
        self.step("come", train=train, track=track, left_cycles=0)
        assert self.system.bodies[train] == Body(
            track, False, 0, number + 1, False, True, 0, False, False, False, False, number
        )
        if contact:
            self.step("make_contact", train=train)
            assert self.system.crossing.asks[train] is False

    def strike(self, train: Train) -> None:
        """A train passes its start point."""
        body = self.system.bodies[train]
        self.step("pass_start_point", train=train)
        left_cycles = max(body.left_cycles, self.site.settings.start_cycles)
        assert self.system.bodies[train] == replace(body, inside=True, inside_cycles=0, left_cycles=left_cycles)

    def come_without_radio(self, train: Train, track: CrossingTrack = UP) -> None:
        """A train comes and passes its start point, whose terminal tells of it."""
        self.come(train, track, contact=False)
        self.strike(train)
        self.step("hear_strike", train=train)
        assert self.system.crossing.asks[train] is True

    def cycle(
        self, *dues: tuple[Train, Due], heard: tuple[CrossingTrack, ...] = (UP, DOWN), down: bool | None = None
    ) -> None:
        """Terminals are heard, the crossing decides, and a cycle passes; arms come down in time, and rise at once."""
        for track in heard:
            self.step("hear_terminal", track=track, age_cycles=0)
            assert self.system.crossing.silent_cycles[track] == self.system.unheard_cycles[track] == 0
        assert self.step("decide", dues=dict(dues)).decided
        if down is None:
            lowers = machine.arms_are_to_be_down(self.site.settings, self.system.crossing)
            down = lowers and self.system.lowered_cycles + 1 >= self.site.settings.lowering_cycles
        run = self.step("run_a_cycle", are_down=down)
        assert (run.decided, run.are_down) == (False, down)

    def warns(self) -> bool:
        """Whether it does."""
        return self.system.crossing.warns

    def arrive(self, train: Train) -> Arrived:
        """A head is met at the crossing."""
        before, body = self.system, self.system.bodies[train]
        self.step("arrive", train=train)
        assert self.system.last == Arrived(
            True, before.warned_cycles, self.system.down_cycles, body.was_known, self.system.opened_cycles
        )
        assert self.system.bodies[train] == replace(body, is_on_road=True)
        return self.system.last

    def pass_by(self, train: Train) -> None:
        """Its rear is past, and proved so."""
        self.step("leave", gone=train)
        assert train not in self.system.bodies
        self.step("tell_gone", gone=train, number=self.number(train), is_whole=True)
        assert train not in self.system.crossing.asks

    def number(self, train: Train) -> int:
        """By which the crossing has noted a train."""
        return machine.number_of(self.system.crossing, train)

    def look(self, track: CrossingTrack) -> int:
        """By which number a person is asked to look at a track."""
        return machine.look_of(self.system.crossing, track)

    def until_it_can_arrive(self, train: Train, *dues: tuple[Train, Due]) -> int:
        """Let cycles pass until a train can be there; give how many."""
        cycles = 0
        while self.system.bodies[train].left_cycles > 0:
            self.cycle(*dues)
            cycles += 1
        return cycles
