"""The long witness: two trains, conflicting routes, a cancellation, a restart of the centre, and everything free."""

from __future__ import annotations

from kernel.names import Run, Stage
from kernel.refusal import Refusal
from models.simulator.senses import AT_REST
from proofs.witnesses.restarts import restart_centre_now
from proofs.witnesses.running import (
    everything_is_free,
    pass_boundary,
    report,
    rest,
    roll,
    run_through,
    stands_in,
    stop,
)
from proofs.witnesses.scenario import Scenario, Steps
from proofs.witnesses.setting import at_stage, holds, locks, recall, retire, return_it, set_route
from proofs.witnesses.stations import (
    A1,
    A2,
    B1,
    EAST,
    EAST_TO_TWO,
    ONE,
    ONE_TO_EAST,
    OUTLET,
    P1,
    P2,
    REVERSE,
    T1,
    T2,
    THROAT,
    TWO,
    TWO_TO_WEST,
    TWO_TO_WEST_ON,
    WEST,
    WEST_TO_ONE,
)
from proofs.witnesses.telling import adopt, hear_terminals, next_run, recover, recovered, tell


def two_trains_pass(steps: Steps) -> Scenario:
    """Two trains meet at the passing place, from the first request until everything is free (T4 to T10).

    The second's route conflicts with the overlap of the first, is refused, and granted when the
    first stands.  A run is cancelled while its train stands short of it, after it was asked for
    in vain while the train was rolling.  The centre restarts with a train over the points, and
    every block and point is found again.  At the end nothing is held but where the trains stand.
    """
    scenario, runs = recovered(
        steps, {A1: frozenset({WEST}), A2: frozenset({WEST}), B1: frozenset({EAST})}, {P1: REVERSE}
    )
    first = _the_first_arrives(scenario, runs[T1], runs[T2])
    second = _the_second_arrives(scenario, runs[T2])
    _a_run_is_cancelled(scenario, second)
    leaving = set_route(scenario, T2, TWO_TO_WEST, second)
    roll(scenario, leaving)
    pass_boundary(scenario, leaving, TWO, THROAT)
    restart_centre_now(scenario)
    rest(scenario, leaving)
    stands = _everything_is_found_again(scenario)
    _both_go_on(scenario, stands[0], stands[1])
    retire(scenario, *stands)
    everything_is_free(scenario)
    scenario.must(first not in scenario.system.centre.runs, "the runs from before the restart are forgotten")
    return scenario


def _the_first_arrives(scenario: Scenario, stood: Run, other_stood: Run) -> Run:
    """The first train runs in, released in parts; the second is refused while the overlap is held."""
    run = set_route(scenario, T1, WEST_TO_ONE, stood)
    wanted = next_run(scenario, T2, EAST_TO_TWO)
    scenario.refuses("request", Refusal.BLOCK_HELD_FOR_ANOTHER, run=wanted, base=other_stood)
    roll(scenario, run)
    pass_boundary(scenario, run, WEST, THROAT)
    report(scenario, run, WEST, THROAT)
    report(scenario, stood, WEST, THROAT)
    holds(scenario, WEST)
    pass_boundary(scenario, run, THROAT, ONE)
    report(scenario, run, THROAT, ONE)
    locks(scenario, P1)
    rest(scenario, run)
    scenario.refuses("request", Refusal.BLOCK_HELD_FOR_ANOTHER, run=wanted, base=other_stood)
    stop(scenario, run)
    holds(scenario, OUTLET)
    retire(scenario, stood)
    return run


def _the_second_arrives(scenario: Scenario, stood: Run) -> Run:
    """Its route granted now, the second train runs in from the east."""
    run = set_route(scenario, T2, EAST_TO_TWO, stood)
    wanted = next_run(scenario, T1, ONE_TO_EAST)
    first = next(other for other, _ in scenario.system.centre.runs.items() if other.train == T1)
    scenario.refuses("request", Refusal.BLOCK_HELD_FOR_ANOTHER, run=wanted, base=first)
    run_through(scenario, run, EAST, OUTLET, TWO)
    for old in (stood, run):
        report(scenario, old, EAST, OUTLET)
    report(scenario, run, OUTLET, TWO)
    retire(scenario, stood)
    at_stage(scenario, run, Stage.SET)
    return run


def _a_run_is_cancelled(scenario: Scenario, second: Run) -> None:
    """A departure is asked back while the train rolls, in vain; it comes to rest short of it and gives it back."""
    run = set_route(scenario, T2, TWO_TO_WEST, second)
    roll(scenario, run)
    recall(scenario, run)
    scenario.refuses("give_back", run=run, at=AT_REST, held_end_mm=0, start_end_mm=0)
    scenario.refuses("send_permit", run=next_run(scenario, T2, TWO_TO_WEST))
    rest(scenario, run)
    holds(scenario, THROAT, run)
    return_it(scenario, run)
    holds(scenario, THROAT)
    retire(scenario, run)


def _everything_is_found_again(scenario: Scenario) -> tuple[Run, Run]:
    """Every train tells where it stands, every block and point is found again, the one below a train adopted."""
    scenario.refuses("recover_block", block=ONE)
    first = tell(scenario, T1)
    scenario.refuses("recover_block", block=ONE)
    second = tell(scenario, T2)
    hear_terminals(scenario)
    recover(scenario)
    scenario.must(scenario.system.centre.lost_points == {P1}, "only the point below the train is still lost")
    adopt(scenario, second, P1)
    scenario.must(not scenario.system.centre.lost_points, "and that one is found now")
    holds(scenario, ONE, first)
    holds(scenario, THROAT, second)
    return first, second


def _both_go_on(scenario: Scenario, first: Run, second: Run) -> None:
    """The first leaves for the east, the second, over the points, takes the rest of its route west."""
    east = set_route(scenario, T1, ONE_TO_EAST, first)
    run_through(scenario, east, ONE, OUTLET, EAST)
    for old in (first, east):
        report(scenario, old, ONE, OUTLET)
    report(scenario, east, OUTLET, EAST)
    west = set_route(scenario, T2, TWO_TO_WEST_ON, second)
    run_through(scenario, west, THROAT, WEST)
    for old in (second, west):
        report(scenario, old, THROAT, WEST)
    stands_in(scenario, T1, EAST)
    stands_in(scenario, T2, WEST)
    for point in (P1, P2):
        locks(scenario, point)
