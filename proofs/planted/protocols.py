"""Five protocols that look right, each with the run that shows where it ends."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

from kernel import release, restarts, tail_evidence, terminal
from kernel.names import Block, Car, Epoch, Read, Record, Run, Train
from models.simulator.senses import BROKEN, INSIDE
from proofs.lift.sources import Code
from proofs.planted import plausible, weakened
from proofs.planted.fault import Fault
from proofs.planted.trace import Player, Trace, play
from proofs.witnesses import running, setting, telling
from proofs.witnesses.stations import (
    A1,
    A2,
    B1,
    CARS,
    ONE,
    P1,
    PASSING_PLACE,
    T1,
    T2,
    THROAT,
    TWO,
    TWO_TO_WEST,
    WEST,
    WEST_TO_ONE,
    WEST_TO_TWO,
    YARD_EAST,
    YARD_GATE,
    YARD_OUT,
    YARD_WEST,
    site_of,
    standing_at,
)

BETWEEN = Car("between a1 and a2")
"""A third car of T1, with a cab of its own that leads in neither direction."""


@dataclass(frozen=True)
class Protocol:
    """A planted protocol: the fault, where trains stand, the script, and how each side ends.

    ``broken``: the safety claim that the fault breaks.
    ``stopped_at``: the step at which the true kernel does not go along.
    ``half``: only a part of the fault, and the step at which the rest of the kernel still stops it.
    ``cars``: the cars of each train, in the order in which they run eastwards.
    """

    fault: Fault
    at: Mapping[Car, Block]
    script: Callable[[Player], None]
    broken: str
    stopped_at: str
    half: Mapping[Code, Code] = field(default_factory=dict)
    half_stopped_at: str = ""
    cars: Mapping[Train, Sequence[Car]] = field(default_factory=lambda: CARS)

    def trace(self, instead: Mapping[Code, Code]) -> Trace:
        """Play the script with these functions replaced."""
        site = site_of(PASSING_PLACE, self.cars)
        system = standing_at(site, {car: frozenset({block}) for car, block in self.at.items()}, {})
        sources = Fault("", "", "", instead).sources
        return play(self.script, Player(sources, self.broken, site, system))


def _ready(player: Player) -> Mapping[Train, Run]:
    """Every train tells where it stands; nothing is lost any more but points below trains."""
    runs = telling.all_tell(player)
    telling.hear_terminals(player)
    telling.recover(player)
    return runs


def _returns_the_list(player: Player) -> None:
    """T1 has its head in the throat and its rear in the west, and reports the west as left."""
    standing = _ready(player)[T1]
    run = setting.set_route(player, T1, WEST_TO_ONE, standing)
    running.roll(player, run)
    running.head_passes(player, run, WEST, THROAT)
    running.enters(player, run, A1, WEST, THROAT)
    left, entered = (Read(tag, Record("never read")) for tag in running.pair(player.site.layout, WEST, THROAT))
    for held_for in (run, standing):
        player.does("send_tail_report", run=held_for, block=WEST, left=left, entered=entered)
        player.does("release_block", run=held_for, block=WEST, left=left, entered=entered)


def _frees_on_head_evidence(player: Player) -> None:
    """T1 stands with its front in one and its rear in the west; it tells that it has stopped."""
    run = setting.set_route(player, T1, WEST_TO_ONE, _ready(player)[T1])
    running.roll(player, run)
    running.head_passes(player, run, WEST, THROAT)
    running.enters(player, run, A1, WEST, THROAT)
    running.enters(player, run, A2, WEST, THROAT)
    running.head_passes(player, run, THROAT, ONE)
    running.enters(player, run, A1, THROAT, ONE)
    running.rest(player, run)
    player.does("note_stopped", run=run, **INSIDE)
    player.does("send_stop", run=run)
    player.does("release_overlap", run=run)
    player.does("request", run=telling.next_run(player, T2, TWO_TO_WEST), base=_standing(player))


def _standing(player: Player) -> Run:
    """The run that stands for T2."""
    return next(run for run in player.system.centre.runs if run.train == T2)


def _obeys_an_older_run(player: Player) -> None:
    """An order for P1 reverse is late; the run is withdrawn, another has P1 normal, and then the order comes."""
    standing = _ready(player)[T1]
    older = setting.reserve(player, T1, WEST_TO_TWO, standing)
    setting.send_order(player, older, P1)
    player.does("withdraw", run=older)
    run = setting.set_route(player, T1, WEST_TO_ONE, standing)
    running.roll(player, run)
    running.head_passes(player, run, WEST, THROAT)
    running.enters(player, run, A1, WEST, THROAT)
    life, lies = player.system.terminals[P1].life, player.system.track.lies[P1]
    player.does("obey_order", run=older, point=P1, life=life, detected=lies, is_detected=True)


def _comes_back_unoccupied(player: Player) -> None:
    """The centre restarts; T2 answers, T1 in the yard gate does not, and T2 is sent there."""
    _ready(player)
    player.does("restart_centre", epoch=Epoch(2))
    standing = telling.tell(player, T2)
    run = setting.set_route(player, T2, YARD_OUT, standing)
    running.roll(player, run)
    running.head_passes(player, run, YARD_WEST, YARD_GATE)
    running.enters(player, run, B1, YARD_WEST, YARD_GATE)


def _reads_elsewhere_than_at_the_tail(player: Player) -> None:
    """T1 parts behind its second car, whose antenna poses as the tail; a2 is still in the west."""
    standing = _ready(player)
    run = setting.set_route(player, T1, WEST_TO_ONE, standing[T1])
    running.roll(player, run)
    player.does("part", train=T1)
    for block, target in ((WEST, THROAT), (THROAT, ONE)):
        running.head_passes(player, run, block, target)
        running.enters(player, run, A1, block, target)
        running.leaves(player, A1, block)
        running.follows(player, BETWEEN, A1, target)
        running.leaves(player, BETWEEN, block)
        tags = running.pair(player.site.layout, block, target)
        reads = [running.genuine(player, tag) for tag in tags]
        for read in reads:
            cab = player.site.formation.cab[BETWEEN]
            event = {"run": run, "car": BETWEEN, "cab": cab, "line": BROKEN, "read": read}
            player.tries("tail_reads", **event)
        for held_for in (run, standing[T1]) if block == WEST else (run,):
            report = {"run": held_for, "block": block, "left": reads[0], "entered": reads[1]}
            player.does("send_tail_report", **report)
            player.does("release_block", **report)
    other = setting.set_route(player, T2, TWO_TO_WEST, standing[T2])
    running.roll(player, other)
    for block, target in ((TWO, THROAT), (THROAT, WEST)):
        running.head_passes(player, other, block, target)
        running.crosses(player, other, B1, block, target)


PROTOCOLS: tuple[Protocol, ...] = (
    Protocol(
        Fault(
            "a unit that returns the list",
            "The unit sends the first loop's tags as its third-loop report; the centre compares UIDs only.",
            "release_block",
            {
                tail_evidence.reports_left: plausible.reports_the_list,
                release.release_refusal: plausible.compares_uids_only,
            },
        ),
        {A1: WEST, A2: WEST, B1: YARD_EAST},
        _returns_the_list,
        "physical_occupancy_is_recorded",
        "send_tail_report",
        {tail_evidence.reports_left: plausible.reports_the_list},
        "release_block",
    ),
    Protocol(
        Fault(
            "a centre that frees the start block on head evidence",
            "The front stands in the destination, so the start block is freed: the rear is still in it.",
            "release_overlap",
            {release.release_overlap: plausible.frees_the_start_as_well},
        ),
        {A1: WEST, A2: WEST, B1: TWO},
        _frees_on_head_evidence,
        "physical_occupancy_is_recorded",
        "request",
    ),
    Protocol(
        Fault(
            "a terminal that obeys an older run",
            "An order that was late throws the point below a train that came by a newer run.",
            "obey_order",
            {terminal.obey: plausible.obeys_any_run},
        ),
        {A1: WEST, A2: WEST, B1: YARD_EAST},
        _obeys_an_older_run,
        "no_point_moves_under_a_train",
        "obey_order",
    ),
    Protocol(
        Fault(
            "a restart that comes back unoccupied",
            "The restarted centre sees free track where a train stands that has not answered.",
            "restart_centre",
            {restarts.restart_centre: weakened.all_free_again},
        ),
        {A1: YARD_GATE, A2: YARD_GATE, B1: YARD_WEST},
        _comes_back_unoccupied,
        "no_two_trains_in_a_block",
        "request",
    ),
    Protocol(
        Fault(
            "evidence from an antenna that is not at the tail",
            "The train has parted; the antenna of its middle car reads on, and the last stands in the block freed.",
            "tail_reads",
            {tail_evidence.note_tail_read: weakened.tail_over_a_broken_line},
        ),
        {A1: WEST, BETWEEN: WEST, A2: WEST, B1: TWO},
        _reads_elsewhere_than_at_the_tail,
        "no_two_trains_in_a_block",
        "send_tail_report",
        cars={**CARS, T1: (A1, BETWEEN, A2)},
    ),
)
