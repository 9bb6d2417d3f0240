"""Witnesses of running: second loop, tail evidence, release, overlap, length, parting, reversal (T2, T5 to T9)."""

from __future__ import annotations

from kernel.names import Read, Record, Run, Stage, Tag
from kernel.refusal import Refusal
from models.simulator.senses import BROKEN, INSIDE, ON_THE_WAY
from proofs.witnesses.changes import came
from proofs.witnesses.running import (
    crosses,
    enters,
    everything_is_free,
    follows,
    genuine,
    head_cab,
    head_passes,
    leaves,
    pair,
    pass_boundary,
    pass_through,
    report,
    reported,
    rest,
    roll,
    run_through,
    stands_in,
    stop,
    tail_passes,
    tail_read,
    tail_reads_first,
)
from proofs.witnesses.scenario import Scenario, Steps
from proofs.witnesses.setting import at_stage, holds, locks, retire, set_route
from proofs.witnesses.stations import (
    A1,
    A2,
    ARRIVE_1,
    B1,
    DEPART_1,
    EAST,
    EAST_TO_TWO,
    FACING_EAST,
    LINE,
    ONE,
    ONE_TO_EAST,
    OUTLET,
    P1,
    P2,
    PLATFORM_1,
    REVERSE,
    T1,
    T2,
    TERMINUS,
    THROAT,
    WEST,
    WEST_TO_EAST,
    WEST_TO_ONE,
    K,
)
from proofs.witnesses.telling import next_run, recovered

ON_THE_LINE = {A1: frozenset({LINE}), A2: frozenset({LINE})}


def a_run_is_released_and_retired(steps: Steps) -> Scenario:
    """A run that was driven, and whose messages came in the end, is released, and so is what stood before it (T6)."""
    scenario, runs = recovered(steps, FACING_EAST)
    run = set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    run_through(scenario, run, WEST, THROAT, ONE)
    report(scenario, run, WEST, THROAT)
    scenario.refuses("release_block", Refusal.NOT_CLAIMED, **reported(scenario, run, WEST, THROAT))
    report(scenario, run, THROAT, ONE)
    locks(scenario, P1)
    stop(scenario, run)
    locks(scenario, P2)
    report(scenario, runs[T1], WEST, THROAT)
    scenario.refuses("retire", Refusal.STILL_CLAIMED, run=run)
    retire(scenario, runs[T1])
    onward = set_route(scenario, T1, ONE_TO_EAST, run)
    run_through(scenario, onward, ONE, OUTLET, EAST)
    for old in (run, onward):
        report(scenario, old, ONE, OUTLET)
    report(scenario, onward, OUTLET, EAST)
    retire(scenario, run)
    everything_is_free(scenario)
    return scenario


def the_home_track_is_released_first(steps: Steps) -> Scenario:
    """The block a train departs from is free once its tail has left it, before the train arrives anywhere (T7)."""
    scenario, runs = recovered(steps, FACING_EAST)
    run = set_route(scenario, T1, WEST_TO_EAST, runs[T1])
    roll(scenario, run)
    pass_boundary(scenario, run, WEST, THROAT)
    report(scenario, run, WEST, THROAT)
    report(scenario, runs[T1], WEST, THROAT)
    holds(scenario, WEST)
    holds(scenario, THROAT, run)
    return scenario


def a_part_is_reported_as_a_whole(steps: Steps) -> Scenario:
    """Blocks released together are reported once the tail has left the last of them (T7)."""
    scenario, runs = recovered(steps, FACING_EAST)
    run = set_route(scenario, T1, WEST_TO_EAST, runs[T1])
    roll(scenario, run)
    pass_through(scenario, run, WEST, THROAT, ONE)
    scenario.refuses("send_tail_report", **reported(scenario, run, THROAT, ONE))
    holds(scenario, THROAT, run)
    pass_through(scenario, run, ONE, OUTLET, EAST)
    for block, target in ((THROAT, ONE), (ONE, OUTLET), (OUTLET, EAST)):
        report(scenario, run, block, target)
        holds(scenario, block)
    holds(scenario, EAST, run)
    return scenario


def the_train_stands_over_three_blocks(steps: Steps) -> Scenario:
    """A train longer than a block: its head in the third, its tail in the first, all three stay held (T2, T3)."""
    scenario, runs = recovered(steps, FACING_EAST)
    run = set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    roll(scenario, run)
    for block, target in ((WEST, THROAT), (THROAT, ONE)):
        head_passes(scenario, run, block, target)
        enters(scenario, run, A1, block, target)
    leaves(scenario, A1, WEST)
    enters(scenario, run, A2, WEST, THROAT)
    stands_in(scenario, T1, WEST, THROAT, ONE)
    for block, target in ((WEST, THROAT), (THROAT, ONE)):
        scenario.refuses("send_tail_report", **reported(scenario, run, block, target))
    scenario.refuses("tail_reads", **tail_read(scenario, run, genuine(scenario, _behind(scenario)).tag) | {"car": A1})
    leaves(scenario, A2, WEST)
    tail_passes(scenario, run, WEST, THROAT)
    report(scenario, run, WEST, THROAT)
    holds(scenario, THROAT, run)
    return scenario


def _behind(scenario: Scenario) -> Tag:
    """The second tag behind the first block."""
    return pair(scenario.site.layout, WEST, THROAT)[1]


def the_tail_cuts_the_corner(steps: Steps) -> Scenario:
    """The last car is drawn after the first by whatever rails lead there, by the run of the first (T2)."""
    scenario, runs = recovered(steps, FACING_EAST)
    run = set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    roll(scenario, run)
    head_passes(scenario, run, WEST, THROAT)
    enters(scenario, run, A1, WEST, THROAT)
    scenario.refuses("car_follows", car=A1, other=A2, target=ONE)
    follows(scenario, A2, A1, THROAT)
    scenario.must(scenario.system.track.under[A2][THROAT] == run, "it came under the run of the car ahead")
    return scenario


def the_overlap_is_freed_at_a_standstill(steps: Steps) -> Scenario:
    """Once a train tells that it stands in its destination, its overlap is free for another, closed to it (T9)."""
    scenario, runs = recovered(steps, {**FACING_EAST, B1: frozenset({EAST})})
    run = set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    scenario.refuses("note_stopped", run=run, **ON_THE_WAY)
    run_through(scenario, run, WEST, THROAT, ONE)
    scenario.refuses("release_overlap", run=run)
    scenario.refuses("send_stop", run=run)
    stop(scenario, run)
    holds(scenario, OUTLET)
    scenario.refuses("overrun", run=run)
    scenario.refuses("start_rolling", run=run)
    scenario.refuses("car_moves", run=run, car=A1, block=ONE, target=OUTLET)
    over = set_route(scenario, T2, EAST_TO_TWO, runs[T2])
    holds(scenario, OUTLET, over)
    return scenario


def a_train_slips_into_its_overlap(steps: Steps) -> Scenario:
    """Braking late a train slips into the overlap, which is still its own and is not freed while it is there (T9)."""
    scenario, runs = recovered(steps, FACING_EAST)
    run = set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    roll(scenario, run)
    pass_through(scenario, run, WEST, THROAT, ONE)
    effect = {"track": {"slipping": came(run), "leavable": came((run, ONE))}}
    scenario.does("overrun", effect, run=run)
    enters(scenario, run, A1, ONE, OUTLET)
    scenario.refuses("note_stopped", run=run, **INSIDE)
    rest(scenario, run)
    scenario.refuses("note_stopped", run=run, **INSIDE)
    scenario.refuses("send_stop", run=run)
    holds(scenario, OUTLET, run)
    return scenario


def a_foreign_tag_opens_the_loop(steps: Steps) -> Scenario:
    """A tag that is not the next one takes the authority away; the train comes to rest inside what it held (T5, T8)."""
    scenario, runs = recovered(steps, FACING_EAST)
    run = set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    roll(scenario, run)
    cab, wrong = head_cab(scenario, run), {"train": T1, "in_window": True, "tag": Tag("from elsewhere")}
    scenario.does("head_reads", _loop_opened(scenario, Tag("from elsewhere")), cab=cab, **wrong)
    _rolls_on_without_authority(scenario, run)
    return scenario


def _rolls_on_without_authority(scenario: Scenario, run: Run) -> None:
    """A train whose loop opened while it rolled comes to rest in its own blocks, and cannot start again."""
    crosses(scenario, run, A1, WEST, THROAT)
    tail_reads_first(scenario, run, pair(scenario.site.layout, WEST, THROAT)[0])
    rest(scenario, run)
    scenario.refuses("start_rolling", run=run)
    scenario.refuses("car_moves", run=run, car=A1, block=THROAT, target=ONE)
    scenario.refuses("note_stopped", run=run, **INSIDE)
    for block in (THROAT, ONE, OUTLET):
        holds(scenario, block, run)


def a_tag_read_early_opens_the_loop(steps: Steps) -> Scenario:
    """The right tag outside its window takes the authority away; read twice by one cab it is one reading (T5)."""
    scenario, runs = recovered(steps, FACING_EAST)
    run = set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    roll(scenario, run)
    head_passes(scenario, run, WEST, THROAT)
    again = {"train": T1, "cab": head_cab(scenario, run), "tag": pair(scenario.site.layout, WEST, THROAT)[1]}
    scenario.refuses("head_reads", **again, in_window=False)
    tag = pair(scenario.site.layout, THROAT, ONE)[0]
    scenario.does("head_reads", _loop_opened(scenario, tag), **again | {"tag": tag}, in_window=False)
    crosses(scenario, run, A1, WEST, THROAT)
    rest(scenario, run)
    scenario.refuses("start_rolling", run=run)
    return scenario


def an_overdue_tag_opens_the_loop(steps: Steps) -> Scenario:
    """A tag that does not come in time takes the authority away (T5)."""
    scenario, runs = recovered(steps, FACING_EAST)
    run = set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    roll(scenario, run)
    scenario.does("window_passes", _loop_opened(scenario), train=T1)
    _rolls_on_without_authority(scenario, run)
    return scenario


def _loop_opened(scenario: Scenario, tag: Tag | None = None) -> dict[str, object]:
    """The first train's second loop is open for the rest of this life, perhaps for the tag that its head has read."""
    track: dict[str, object] = {"astray": came((T1, scenario.system.units[T1].life))}
    if tag is not None:
        track["last_read"] = {T1: tag}
    return {"units": {T1: {"loop_open": True}}, "track": track}


def a_parted_train_releases_nothing(steps: Steps) -> Scenario:
    """Cars left behind break the through line: what the front part reads counts for nothing (T2, T3)."""
    scenario, runs = recovered(steps, FACING_EAST)
    run = set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    roll(scenario, run)
    head_passes(scenario, run, WEST, THROAT)
    for car in (A1, A2):
        enters(scenario, run, car, WEST, THROAT)
    leaves(scenario, A1, WEST)
    first, second = pair(scenario.site.layout, WEST, THROAT)
    scenario.does("part", {"track": {"parted": came(T1)}}, train=T1)
    front = {**tail_read(scenario, run, first), "car": A1, "cab": scenario.site.formation.cab[A1]}
    scenario.refuses("tail_reads", **front)
    for tag in (first, second):
        scenario.refuses("tail_reads", **front | {"line": BROKEN, "read": genuine(scenario, tag)})
    head_passes(scenario, run, THROAT, ONE)
    crosses(scenario, run, A1, THROAT, ONE)
    rest(scenario, run)
    scenario.refuses("send_tail_report", **reported(scenario, run, WEST, THROAT))
    holds(scenario, WEST, runs[T1], run)
    holds(scenario, THROAT, run)
    return scenario


def half_a_pair_proves_nothing(steps: Steps) -> Scenario:
    """One tag missed, the line broken between both, the order reversed, the head's antenna: nothing is left (T2)."""
    scenario, runs = recovered(steps, FACING_EAST)
    run = set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    roll(scenario, run)
    head_passes(scenario, run, WEST, THROAT)
    for car in (A1, A2):
        crosses(scenario, run, car, WEST, THROAT)
    first, second = pair(scenario.site.layout, WEST, THROAT)
    ahead = {"car": A1, "cab": head_cab(scenario, run)}
    scenario.refuses("tail_reads", **tail_read(scenario, run, first) | ahead)
    tail_reads_first(scenario, run, first)
    gone = {"gone": came((run, WEST)), "passed": came((T1, second))}
    forgotten = {"units": {T1: {"tail_read": None}}, "track": gone}
    scenario.does("tail_reads", forgotten, **tail_read(scenario, run, second) | {"line": BROKEN})
    tail_reads_first(scenario, run, second)
    scenario.refuses("send_tail_report", **reported(scenario, run, WEST, THROAT))
    scenario.must(not scenario.system.track.behind, "nothing counts as left")
    return scenario


def what_was_not_read_does_not_release(steps: Steps) -> Scenario:
    """A report with the right tags and a wrong record, as from a list alone, is refused (T6)."""
    scenario, runs = recovered(steps, FACING_EAST)
    run = set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    roll(scenario, run)
    head_passes(scenario, run, WEST, THROAT)
    for car in (A1, A2):
        crosses(scenario, run, car, WEST, THROAT)
    first, second = pair(scenario.site.layout, WEST, THROAT)
    forged = Read(second, Record("guessed"))
    tail_reads_first(scenario, run, first)
    scenario.does("tail_reads", **tail_read(scenario, run, second) | {"read": forged})
    word = {"run": run, "block": WEST, "left": genuine(scenario, first), "entered": forged}
    scenario.does("send_tail_report", **word)
    scenario.refuses("release_block", Refusal.RECORD_DIFFERS, **word)
    other = {**word, "block": THROAT}
    scenario.refuses("release_block", Refusal.NOT_THE_TAGS_OF_THE_BLOCK, **other)
    holds(scenario, WEST, runs[T1], run)
    return scenario


def a_train_reverses_at_the_terminus(steps: Steps) -> Scenario:
    """In and out again: the other cab leads, the other car is last, and every block is released again (T2, T7)."""
    scenario, runs = recovered(steps, ON_THE_LINE, station=TERMINUS)
    run = set_route(scenario, T1, ARRIVE_1, runs[T1])
    run_through(scenario, run, LINE, THROAT, PLATFORM_1)
    for old in (runs[T1], run):
        report(scenario, old, LINE, THROAT)
    report(scenario, run, THROAT, PLATFORM_1)
    back = set_route(scenario, T1, DEPART_1, run)
    run_through(scenario, back, PLATFORM_1, THROAT, LINE)
    for old in (run, back):
        report(scenario, old, PLATFORM_1, THROAT)
    report(scenario, back, THROAT, LINE)
    retire(scenario, runs[T1], run)
    at_stage(scenario, back, Stage.SET)
    everything_is_free(scenario)
    return scenario


def no_train_is_led_back_over_what_its_tail_has_not_left(steps: Steps) -> Scenario:
    """The tail has read one tag of a pair and missed the other: until it restarts the train has no way back (T2, T9).

    Its cars may have parted, and then it would be led into those that it has lost.
    """
    scenario, runs = recovered(steps, ON_THE_LINE, station=TERMINUS)
    run = set_route(scenario, T1, ARRIVE_1, runs[T1])
    roll(scenario, run)
    pass_boundary(scenario, run, LINE, THROAT)
    head_passes(scenario, run, THROAT, PLATFORM_1)
    for car in (A1, A2):
        crosses(scenario, run, car, THROAT, PLATFORM_1)
    tail_reads_first(scenario, run, pair(scenario.site.layout, THROAT, PLATFORM_1)[0])
    rest(scenario, run)
    back = next_run(scenario, T1, DEPART_1)
    scenario.refuses("request", Refusal.NOT_CLEAR_OF_ITS_OWN_TRAIN, run=back, base=run)
    holds(scenario, THROAT, run)
    locks(scenario, K, run)
    return scenario


def silence_keeps_everything_held(steps: Steps) -> Scenario:
    """No report arrives: whatever else happens, nothing is released, and no other train is let in (T8)."""
    scenario, runs = recovered(steps, {**FACING_EAST, B1: frozenset({EAST})}, {P2: REVERSE})
    run = set_route(scenario, T1, WEST_TO_ONE, runs[T1])
    run_through(scenario, run, WEST, THROAT, ONE)
    scenario.does("send_tail_report", **reported(scenario, run, WEST, THROAT))
    for block, target in ((THROAT, ONE), (ONE, OUTLET)):
        scenario.refuses("release_block", **reported(scenario, run, block, target))
    scenario.refuses("release_overlap", run=run)
    scenario.refuses("note_given_back", run=run)
    for block in (WEST, THROAT, ONE, OUTLET):
        scenario.must(run in scenario.system.centre.claimed[block], f"{block} stays held")
    scenario.refuses("retire", Refusal.STILL_CLAIMED, run=run)
    return scenario
