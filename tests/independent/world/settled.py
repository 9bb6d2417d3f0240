"""Whatever stands still can go again: a world left in any state is settled by lawful steps alone.

Nothing fails any more from here on, every message arrives, and nobody restarts a machine.  Each train tells anew
where it stands; then nothing is held but for the blocks that it named, nothing is lost, and it runs by any route
that the centre does not refuse.
"""

from __future__ import annotations

from dataclasses import dataclass

from kernel.names import Route, Run, Stage, Train
from tests.independent.world.kernel_calls import Message
from tests.independent.world.schedule import Schedule
from tests.independent.world.trains import ODOMETER_MM, OnRails
from tests.independent.world.world import World

CYCLES = 40
"""So long a train is watched after its route is set: it starts in the first of them."""
MOST_STOPPING_MOVES = 60


@dataclass
class Settled:
    """What came of it.

    ``held_before``: runs that held something beside the trains' own blocks when the world was left.
    ``ran``: trains that ran by a new route afterwards.
    """

    held_before: int = 0
    ran: int = 0


def settle(world: World, settled: Settled) -> None:
    """Bring every train to rest and let it tell anew; say by assertion what is not as it must be."""
    world.missed_of_100, world.detection_holds = 0, True
    world.air.clear()
    for train in world.trains.values():
        for number in range(MOST_STOPPING_MOVES):
            if train.at_rest:
                break
            world.happen(("move", train.name, 30, None, number))
        world.happen(("reconnect", train.name))
        assert train.at_rest, f"{train.name} does not come to rest"
    settled.held_before += sum(
        1
        for run in world.calls.runs(world.centre)
        if set(world.calls.held_for(world.centre, run)) - _blocks(world, run)
    )
    for train in world.trains.values():
        _tells_anew(world, train)
    _finds_again(world)
    for train in world.trains.values():
        held = {block for run in _runs(world, train.name) for block in world.calls.held_for(world.centre, run)}
        assert held == train.blocks, f"{train.name} is in {sorted(train.blocks)}, and {sorted(held)} are held for it"
        stages = [world.calls.stage(world.centre, run) for run in _runs(world, train.name)]
        assert stages == [Stage.STANDING], f"{train.name} stands under one run, and these are left: {stages}"
    assert not world.centre.lost_blocks, f"{sorted(world.centre.lost_blocks)} stay lost"
    assert not world.centre.lost_points, f"{sorted(world.centre.lost_points)} stay lost"
    for train in world.trains.values():
        _runs_on(world, train, settled)


def _blocks(world: World, run: Run) -> frozenset[str]:
    return frozenset(world.trains[run.train].blocks)


def _runs(world: World, train: Train) -> list[Run]:
    return [run for run in world.calls.runs(world.centre) if run.train == train]


def _at_once(world: World, *event: object) -> None:
    """A message is sent, arrives, and so does what it is answered with."""
    world.happen(event)
    while world.air:
        message: Message = world.air[0]
        world.happen(("deliver", message, False))


def _tells_anew(world: World, train: OnRails) -> None:
    """A train at rest is asked, answers in a new life, is taken at its word and told so."""
    world.happen(("ask_anew", train.name))
    _at_once(world, "centre_challenges", train.name)
    _at_once(world, "train_says", train.name, "answered", None)
    for run in _runs(world, train.name):
        if world.calls.stage(world.centre, run) == Stage.OVER or not world.calls.held_for(world.centre, run):
            assert world.happen(("retire", run)), f"{run} is over and cannot be forgotten"
    for run in _runs(world, train.name):
        _at_once(world, "centre_says", run)


def _finds_again(world: World) -> None:
    """Once every train has told, blocks and points are found; of a point below one its terminal says how it lies."""
    for point in world.terminals:
        _at_once(world, "point_says", point, "life")
    blocks, points = world.calls.recoverable(world.centre)
    for block in blocks:
        world.happen(("recover_block", block))
    for point in points:
        world.happen(("recover_point", point))
    for run in world.calls.runs(world.centre):
        for point in world.calls.points_below(world.centre, run):
            _at_once(world, "centre_enquires", run, point)
            _at_once(world, "point_says", point, "confirms")


def _runs_on(world: World, train: OnRails, settled: Settled) -> None:
    """A route that leads on from where a front is, and that the centre does not refuse, is set, and the train runs."""
    calls, (base,) = world.calls, _runs(world, train.name)
    for _ in range(2):
        for route in world.routes_from[train.front_block]:
            if _is_surely_in_the_start(train, route) and not calls.is_refused(world.centre, train.name, route, base):
                world.happen(("request", train.name, route, base))
                run = max(_runs(world, train.name))
                _sets(world, run)
                assert world.happen(("move", train.name, CYCLES, 0, 1)), f"{run} is permitted, and it does not run"
                settled.ran += 1
                return
        world.happen(("turn", train.name, 1))


def _is_surely_in_the_start(train: OnRails, route: Route) -> bool:
    """Whether a route leads on from where the train is, which knows by its odometry that it is in the start."""
    found = train.ends_mm(route)
    return found is not None and found[0] < train.place - ODOMETER_MM


def _sets(world: World, run: Run) -> None:
    """Every point is laid, locked and proved; the first loop is closed."""
    for point in world.calls.missing_points(world.centre, run):
        _at_once(world, "centre_orders", run, point)
        machine = world.terminals[point]
        wanted = world.calls.wanted(machine)
        if world.calls.is_unlocked(machine) and wanted is not None:
            world.happen(("throw", point, wanted))
            world.happen(("lock", point))
        _at_once(world, "point_says", point, "confirms")
    assert world.happen(("open_first_loop", run)), f"the points of {run} are not proved"
    _at_once(world, "centre_says", run)
    _at_once(world, "train_says", run.train, "echo", run)
    _at_once(world, "centre_says", run)
    board = world.trains[run.train].board
    assert world.calls.may_proceed(board, run), f"{run} is not permitted"


def left_whole(world: World, steps: int, seed: int) -> bool:
    """Whether a world, run at random, is left with every train whole."""
    schedule = Schedule(world, seed)
    for _ in range(steps):
        world.happen(schedule.next())
    return all(train.whole for train in world.trains.values())
