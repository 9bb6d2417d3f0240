"""Ordinary service, step by step: what a train, the centre and the terminals would do next if nothing went wrong.

It knows nothing of a timetable.  Of all steps that change something it takes the first in an order that
finishes what is begun: messages before motion, motion before a new route.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any

from fuzz.machines.plausible import Event, plausible, stands_in
from kernel.names import Block, Run, Train
from models.world.state import Site, System

BEGINNING = (
    "send_challenge",
    "answer",
    "send_standing",
    "note_standing",
    "send_standing_run",
    "take_standing",
    "send_terminal_life",
    "note_terminal_life",
    "send_enquiry",
    "relay_enquiry",
    "answer_enquiry",
    "send_confirmation",
    "relay_confirmation",
    "adopt_point",
    "recover_block",
    "recover_point",
    "take_over",
    "note_statement",
    "confirm_statement",
    "note_statement_confirmed",
)
"""What brings the system into service after a restart."""
RUNNING = (
    "send_recall",
    "recall",
    "give_back",
    "send_return",
    "note_given_back",
    "note_confirmation",
    "send_tail_report",
    "release_block",
    "note_stopped",
    "send_stop",
    "release_overlap",
    "retire",
    "tail_reads",
    "window_passes",
    "car_follows",
    "car_leaves",
    "head_reads",
    "car_moves",
    "come_to_rest",
    "restart_unit",
    "change_ends",
    "start_rolling",
    "lock",
    "drift",
    "send_order",
    "relay_order",
    "obey_order",
    "open_first_loop",
    "send_offer",
    "take_offer",
    "send_echo",
    "note_echo",
    "send_permit",
    "take_permit",
    "request",
)
"""What a train, once it has told where it stands, is about."""
IN_ORDER = (*BEGINNING, *RUNNING)


def concerns(site: Site, event: Event, train: Train) -> bool:
    """Whether an event is of this train, or of none."""
    if "run" in event:
        return bool(event["run"].train == train)
    if "car" in event:
        return site.formation.train_of.get(event["car"]) == train
    return bool(event.get("train", train) == train)


def next_steps(site: Site, system: System, train: Train, steps: Mapping[str, Any]) -> Iterator[tuple[str, list[Event]]]:
    """The steps of a train's ordinary service that would change something now, each with its events."""
    for step in IN_ORDER:
        allowed = ORDINARY.get(step, _always)
        events: list[Event] = [
            event
            for event in plausible(site, system, step)
            if concerns(site, event, train)
            and allowed(site, system, event)
            and steps[step](site, system, **event) != system
        ]
        if events:
            yield step, events


# ---- what is ordinary, where more than that is plausible


def _always(site: Site, system: System, event: Event) -> bool:
    return True


def _has_not_told(site: Site, system: System, event: Event) -> bool:
    unit = system.units[event["train"]]
    return bool(event["epoch"] == system.centre.epoch) and unit.answered != system.centre.epoch


def _is_news(site: Site, system: System, event: Event) -> bool:
    return bool(system.centre.accounted.get(event["train"]) != event["life"])


def _is_supervised(site: Site, system: System, event: Event) -> bool:
    """The procedure is open for the train, and its unit has not been isolated for it yet."""
    train = event["train"]
    return train in system.centre.supervised and train not in system.centre.statements


def _front_is_there(site: Site, system: System, event: Event) -> bool:
    """The expected tag, read by the front car in the block that it lies in."""
    tag, unit = event["tag"], system.units[event["train"]]
    return any(
        order.expected == tag
        and run in system.track.rolling
        and event["cab"] == site.formation.cab[_front(site, run)]
        and site.layout.tag_in[tag] in system.track.at[_front(site, run)]
        for run, order in unit.orders.items()
    )


def _front(site: Site, run: Run) -> Any:
    ahead = site.formation.ahead[run]
    return min(ahead, key=lambda car: len(ahead[car]))


def _goes_its_way(site: Site, system: System, event: Event) -> bool:
    """The front car along the way, not into the overlap; the others follow it."""
    run, target, layout = event["run"], event["target"], site.layout
    if layout.way[run.route].get(event["block"]) != target or target in layout.overlap[run.route]:
        return False
    if event["car"] != _front(site, run):
        return False
    unit = system.units[run.train]
    expected = unit.orders[run].expected if run in unit.orders else None
    return expected is None or layout.tag_in[expected] != event["block"]


def _is_behind(site: Site, system: System, event: Event) -> bool:
    """A block whose next one on a rolling run's way the car is in as well; no car behind is further back."""
    car, block = event["car"], event["block"]
    train, at = site.formation.train_of[car], system.track.at
    return any(
        site.layout.way.get(run.route, {}).get(block) in at[car]
        and all(at[car] & at[other] for other, ahead in site.formation.ahead[run].items() if car in ahead)
        for run in system.track.rolling
        if run.train == train
    )


def _is_next_to(site: Site, system: System, event: Event) -> bool:
    """The block after one that the car is in, on a rolling run's way."""
    car, target = event["car"], event["target"]
    train = site.formation.train_of[car]
    return any(
        site.layout.way.get(run.route, {}).get(block) == target
        for run in system.track.rolling
        if run.train == train
        for block in system.track.at[car]
    )


def _faces_its_way(site: Site, system: System, event: Event) -> bool:
    """The cab in front of the newest run that the train is permitted."""
    unit = system.units[event["train"]]
    permitted = [run for run, order in unit.orders.items() if order.permitted and not order.given_back]
    return bool(permitted) and site.formation.front[max(permitted)] == event["cab"]


def _is_overdue(site: Site, system: System, event: Event) -> bool:
    return any(train == event["train"] for train, _ in system.track.unread)


def _tail_is_past(site: Site, system: System, event: Event) -> bool:
    """The two tags between a block that the train has left and the next on its way, in order and after the head."""
    run, tag, layout = event["run"], event["read"].tag, site.layout
    unit, order = system.units[run.train], system.units[run.train].orders[run]
    if run not in system.track.rolling or unit.loop_open:
        return False
    before = unit.tail_read
    second = before is not None and layout.partner.get(before.tag) == tag
    left, entered = (layout.partner[tag], tag) if second else (tag, layout.partner[tag])
    block, beyond = layout.tag_in[left], layout.tag_in[entered]
    return (
        order.begun
        and beyond in unit.occupied
        and block not in order.left
        and layout.way.get(run.route, {}).get(block) == beyond
        and not _up_to(site, run, block) & stands_in(site, system, run.train)
    )


def _up_to(site: Site, run: Run, block: Block) -> frozenset[Block]:
    """The blocks on a run's way up to this one."""
    found = [site.layout.start[run.route]]
    while found[-1] != block and (onward := site.layout.way[run.route].get(found[-1])) is not None:
        found.append(onward)
    return frozenset(found)


def _is_of(site: Site, car: Any, run: Run) -> bool:
    return site.formation.train_of[car] == run.train


def _has_arrived(site: Site, system: System, event: Event) -> bool:
    run = event["run"]
    destination = site.layout.destination.get(run.route)
    return all(blocks == {destination} for car, blocks in system.track.at.items() if _is_of(site, car, run))


def _has_to_stop(site: Site, system: System, event: Event) -> bool:
    """It has arrived, or its second loop is open."""
    return system.units[event["run"].train].loop_open or _has_arrived(site, system, event)


def _has_no_way_on(site: Site, system: System, event: Event) -> bool:
    """A unit brakes for the rest of its life, and its train is at rest: so it begins another one."""
    train = event["train"]
    return system.units[train].loop_open and all(run.train != train for run in system.track.rolling)


def _arrived_at_rest(site: Site, system: System, event: Event) -> bool:
    return event["run"] not in system.track.rolling and _has_arrived(site, system, event)


def _has_not_run(site: Site, system: System, event: Event) -> bool:
    return event["run"] not in system.track.run_into


def _is_wanted(site: Site, system: System, event: Event) -> bool:
    return bool(system.terminals[event["point"]].wanted == event["position"])


def _stands(site: Site, system: System, event: Event) -> bool:
    """The train is at rest and no other route is set for it."""
    train = event["run"].train
    return all(run.train != train for run in system.track.rolling) and all(
        run.train != train or run == event["base"] or not _is_open(system, run) for run in system.centre.runs
    )


def _is_open(system: System, run: Run) -> bool:
    return any(run in holders for _, holders in system.centre.claimed.items())


ORDINARY: Mapping[str, Callable[[Site, System, Event], bool]] = {
    "answer": _has_not_told,
    "note_standing": _is_news,
    "take_over": _is_supervised,
    "note_statement_confirmed": _is_news,
    "head_reads": _front_is_there,
    "window_passes": _is_overdue,
    "change_ends": _faces_its_way,
    "car_moves": _goes_its_way,
    "car_follows": _is_next_to,
    "car_leaves": _is_behind,
    "tail_reads": _tail_is_past,
    "come_to_rest": _has_to_stop,
    "restart_unit": _has_no_way_on,
    "note_stopped": _arrived_at_rest,
    "start_rolling": _has_not_run,
    "drift": _is_wanted,
    "request": _stands,
}
"""For some steps, which of their plausible events are ordinary."""
