"""What the machines send.  Sending only adds to what may arrive; nothing is ever taken back (T11).

Every output is a function of its machine's state, so a message that got lost is sent again
without any code for it.
"""

from __future__ import annotations

from dataclasses import replace

from kernel import cancellation, first_loop, recovery, relay, route_setting, standing, tail_evidence
from kernel.authority import tells_stopped
from kernel.names import Block, Epoch, Point, Position, Read, Run, TagList, TerminalLife, Train
from kernel.terminal import confirms
from models.world.assumptions import detection_is_true
from models.world.state import Site, System


def send_order(site: Site, system: System, run: Run, point: Point, life: TerminalLife) -> System:
    """Centre to train: have ``point`` laid and locked for ``run`` (T10)."""
    if not route_setting.orders_point(site.layout, system.centre, run, point, life):
        return system
    radio = replace(system.radio, orders=system.radio.orders | {(run, point, life)})
    return replace(system, radio=radio)


def relay_order(site: Site, system: System, run: Run, point: Point, life: TerminalLife) -> System:
    """Train to terminal: the order that came, unless it would throw the point below (T10).

    The order names the position that the route needs.
    """
    if (run, point, life) not in system.radio.orders or run.train not in system.units:
        return system
    if run.route not in site.layout.needs or point not in site.layout.needs[run.route]:
        return system
    if not relay.relays_order(
        site.plan, site.lists, system.units[run.train], run, point, site.layout.needs[run.route][point]
    ):
        return system
    radio = replace(system.radio, relayed_orders=system.radio.relayed_orders | {(run, point, life)})
    return replace(system, radio=radio)


def send_enquiry(site: Site, system: System, run: Run, point: Point, life: TerminalLife) -> System:
    """Centre to train: ask how the point under it lies (T8, T10)."""
    if not recovery.asks_how_it_lies(site.layout, system.centre, run, point, life):
        return system
    radio = replace(system.radio, enquiries=system.radio.enquiries | {(run, point, life)})
    return replace(system, radio=radio)


def relay_enquiry(site: Site, system: System, run: Run, point: Point, life: TerminalLife) -> System:
    """Train to terminal: the enquiry that came (T10)."""
    if (run, point, life) not in system.radio.enquiries:
        return system
    radio = replace(system.radio, relayed_enquiries=system.radio.relayed_enquiries | {(run, point, life)})
    return replace(system, radio=radio)


def send_confirmation(
    site: Site, system: System, run: Run, point: Point, position: Position, detected: Position, is_detected: bool
) -> System:
    """Terminal to train: the point is locked for ``run`` and lies so (T10)."""
    if point not in system.terminals or (is_detected and not detection_is_true(system, point, detected)):
        return system
    if not confirms(system.terminals[point], run, position, detected, is_detected):
        return system
    radio = replace(system.radio, confirmed=system.radio.confirmed | {(run, point, position)})
    return replace(system, radio=radio)


def relay_confirmation(site: Site, system: System, run: Run, point: Point, position: Position) -> System:
    """Train to centre: the confirmation that came (T10)."""
    if (run, point, position) not in system.radio.confirmed:
        return system
    radio = replace(system.radio, confirmations=system.radio.confirmations | {(run, point, position)})
    return replace(system, radio=radio)


def send_offer(site: Site, system: System, run: Run) -> System:
    """Centre to train: the tags of the route (first loop; T4)."""
    if not route_setting.offers(system.centre, run):
        return system
    return replace(system, radio=replace(system.radio, offers=system.radio.offers | {run}))


def send_echo(site: Site, system: System, run: Run, tag_list: TagList) -> System:
    """Train to centre: the list that it keeps (first loop; T4)."""
    if run.train not in system.units or not first_loop.echoes(system.units[run.train], run, tag_list):
        return system
    return replace(system, radio=replace(system.radio, echoes=system.radio.echoes | {run: tag_list}))


def send_permit(site: Site, system: System, run: Run) -> System:
    """Centre to train: the route is complete, enter (T4)."""
    if not route_setting.permits(system.centre, run):
        return system
    return replace(system, radio=replace(system.radio, permits=system.radio.permits | {run}))


def send_recall(site: Site, system: System, run: Run) -> System:
    """Centre to train: give the run back (T9)."""
    if not cancellation.asks_back(system.centre, run):
        return system
    return replace(system, radio=replace(system.radio, recalls=system.radio.recalls | {run}))


def send_return(site: Site, system: System, run: Run) -> System:
    """Train to centre: given back, not to be entered (T9)."""
    if run.train not in system.units or not first_loop.acknowledges_back(system.units[run.train], run):
        return system
    return replace(system, radio=replace(system.radio, returns=system.radio.returns | {run}))


def send_tail_report(site: Site, system: System, run: Run, block: Block, left: Read, entered: Read) -> System:
    """Train to centre: the tail has left ``block``, and read this (third loop; T6, T7)."""
    if run.train not in system.units:
        return system
    if not tail_evidence.reports_left(site.lists, system.units[run.train], run, block, left, entered):
        return system
    radio = replace(system.radio, tail_reports=system.radio.tail_reports | {(run, block, left, entered)})
    return replace(system, radio=radio)


def send_stop(site: Site, system: System, run: Run) -> System:
    """Train to centre: it stands in the destination (T9)."""
    if run.train not in system.units or not tells_stopped(system.units[run.train], run):
        return system
    return replace(system, radio=replace(system.radio, stops=system.radio.stops | {run}))


def send_challenge(site: Site, system: System, epoch: Epoch) -> System:
    """Centre to all: where does each of you stand (T8)."""
    if not recovery.challenges(system.centre, epoch):
        return system
    return replace(system, radio=replace(system.radio, challenges=system.radio.challenges | {epoch}))


def send_standing(site: Site, system: System, train: Train, epoch: Epoch) -> System:
    """Train to centre: where it stands, as answered at the beginning of this life (T8)."""
    if train not in system.units or not standing.tells_standing(system.units[train], epoch):
        return system
    unit = system.units[train]
    said = system.radio.standings | {(train, unit.life, epoch): unit.standing_in}
    return replace(system, radio=replace(system.radio, standings=said))


def send_standing_run(site: Site, system: System, run: Run) -> System:
    """Centre to train: under which run it stands (T8)."""
    if not recovery.acknowledges_standing(system.centre, run):
        return system
    return replace(system, radio=replace(system.radio, standing_runs=system.radio.standing_runs | {run}))


def send_terminal_life(site: Site, system: System, point: Point) -> System:
    """Terminal to centre, by way of any train: the life it is in (T10)."""
    if point not in system.terminals:
        return system
    said = system.radio.terminal_lives | {(point, system.terminals[point].life)}
    return replace(system, radio=replace(system.radio, terminal_lives=said))
