"""Lemmas on what can be in the air: which message was sent only after which, in which life."""

from __future__ import annotations

from kernel.names import Stage
from models.world.state import Site, System
from proofs.invariants.vocabulary import at_stage


def a_message_follows_its_stage(site: Site, system: System) -> bool:
    """Lists go out after the points are proved, permits after the echo; a standing run is never offered (T4)."""
    return (
        all(
            run.route in site.layout.routes and not at_stage(system, run, Stage.RESERVED) for run in system.radio.offers
        )
        and all(
            run.route in site.layout.routes
            and not at_stage(system, run, Stage.RESERVED)
            and not at_stage(system, run, Stage.OFFERED)
            for run in system.radio.permits
        )
        and all(run.route not in site.layout.routes for run in system.radio.standing_runs)
        and all(
            run.route in site.layout.routes and point in site.layout.needs[run.route]
            for run, point, _life in system.radio.orders
        )
        and all(run.route not in site.layout.routes for run, _point, _life in system.radio.enquiries)
    )


def an_answer_follows_its_question(site: Site, system: System) -> bool:
    """Echo after list, permit after echo, acknowledgement after echo; relays pass on only what was sent (T4, T10)."""
    return (
        all(run in system.radio.offers for run in system.radio.echoes)
        and all(run in system.radio.offers and run in system.radio.echoes for run in system.radio.permits)
        and all(run in system.radio.offers for run in system.radio.returns)
        and all(run in system.radio.permits for run in system.radio.stops)
        and all(order in system.radio.orders for order in system.radio.relayed_orders)
        and all(enquiry in system.radio.enquiries for enquiry in system.radio.relayed_enquiries)
        and all(word in system.radio.confirmed for word in system.radio.confirmations)
    )


def a_set_run_was_offered(site: Site, system: System) -> bool:
    """A run is set only after its list was sent, and the very same came back (T4)."""
    return all(
        grant.stage != Stage.SET
        or (
            run in system.radio.offers
            and run in system.radio.echoes
            and run.route in site.layout.tag_list
            and system.radio.echoes[run] == site.layout.tag_list[run.route]
        )
        for run, grant in system.centre.runs.items()
    )


def a_permitted_run_was_compared(site: Site, system: System) -> bool:
    """A run is permitted only after the list that the train keeps was found to be the centre's (T4)."""
    return all(
        run in system.radio.echoes
        and run.route in site.layout.tag_list
        and system.radio.echoes[run] == site.layout.tag_list[run.route]
        for run in system.radio.permits
    )


def a_unit_goes_by_the_centres_list(site: Site, system: System) -> bool:
    """What a unit keeps of a route that it may enter is what the centre has sent (T4)."""
    return all(
        run not in system.radio.permits
        or (run.route in site.layout.tag_list and order.tag_list == site.layout.tag_list[run.route])
        for train in system.units
        for run, order in system.units[train].orders.items()
    )


def a_unit_knows_only_what_was_sent(site: Site, system: System) -> bool:
    """A unit's orders are of its train and life, offered to it, permitted by permit, recalled by recall (T4, T9)."""
    return all(
        run.train == train
        and run.life == system.units[train].life
        and (
            (run in system.radio.offers and order.tag_list is not None)
            or (run in system.radio.standing_runs and order.given_back and order.begun and order.tag_list is None)
        )
        and (not order.permitted or run in system.radio.permits)
        and (not order.recalled or run in system.radio.recalls)
        and (not order.stopped or order.given_back or run in system.radio.permits)
        for train in system.units
        for run, order in system.units[train].orders.items()
    )


def an_echo_is_of_a_known_run(site: Site, system: System) -> bool:
    """A unit forgets no run in the life in which it has echoed its tags, nor what it echoed (T4)."""
    return all(
        run.train in system.units
        and (
            run.life != system.units[run.train].life
            or (
                run in system.units[run.train].orders
                and system.units[run.train].orders[run].tag_list == system.radio.echoes[run]
            )
        )
        for run in system.radio.echoes
    )


def only_a_permitted_run_leaves_blocks(site: Site, system: System) -> bool:
    """A run begins only once permitted, or it stands; a tail leaves blocks only under a run that began (T4, T6)."""
    return all(
        (not order.begun or run in system.radio.permits or run in system.radio.standing_runs)
        and (order.begun or all(False for _block in order.left))
        for train in system.units
        for run, order in system.units[train].orders.items()
    ) and all(
        run in system.radio.permits or run in system.radio.standing_runs
        for run, _block, _left, _entered in system.radio.tail_reports
    )


def no_life_is_named_before_it_begins(site: Site, system: System) -> bool:
    """Every life in the books or in the air has begun (T8)."""
    return (
        all(run.train in system.units and run.life <= system.units[run.train].life for run in system.radio.offers)
        and all(
            run.train in system.units and run.life <= system.units[run.train].life for run in system.radio.standing_runs
        )
        and all(
            train in system.units and system.centre.accounted[train] <= system.units[train].life
            for train in system.centre.accounted
        )
        and all(
            train in system.units and life <= system.units[train].life for train, life, _epoch in system.radio.standings
        )
        and all(
            train in system.units and life <= system.units[train].life
            for train, life, _epoch in system.radio.statements
        )
        and all(key in system.radio.statements for key in system.radio.confirmed_statements)
        and all(
            point in system.terminals and life <= system.terminals[point].life
            for point, life in system.radio.terminal_lives
        )
        and all(
            point in system.terminals and system.centre.terminal_life[point] <= system.terminals[point].life
            for point in system.centre.terminal_life
        )
        and all(
            point in system.terminals and life <= system.terminals[point].life
            for _run, point, life in system.radio.orders
        )
    )


def no_epoch_is_named_before_it_begins(site: Site, system: System) -> bool:
    """Every epoch in the air has begun (T8)."""
    return (
        all(epoch <= system.centre.epoch for epoch in system.radio.challenges)
        and all(epoch <= system.centre.epoch for _train, _life, epoch in system.radio.standings)
        and all(epoch <= system.centre.epoch for _train, _life, epoch in system.radio.statements)
        and all(unit.answered is None or unit.answered <= system.centre.epoch for _train, unit in system.units.items())
    )


def what_is_given_back_is_not_entered(site: Site, system: System) -> bool:
    """Once a unit has given a run back no car is where it came under it, and the train never rolls under it (T9)."""
    return all(
        not order.given_back
        or run not in system.radio.offers
        or (
            run not in system.track.rolling
            and all(
                other != run or block not in system.track.at.get(car, frozenset())
                for car in system.track.under
                for block, other in system.track.under[car].items()
            )
        )
        for train in system.units
        for run, order in system.units[train].orders.items()
    ) and all(
        run not in system.track.rolling
        and all(
            other != run or block not in system.track.at.get(car, frozenset())
            for car in system.track.under
            for block, other in system.track.under[car].items()
        )
        and run.train in system.units
        and (
            run.life != system.units[run.train].life
            or (run in system.units[run.train].orders and system.units[run.train].orders[run].given_back)
        )
        for run in system.radio.returns
    )


def what_has_stopped_does_not_slip(site: Site, system: System) -> bool:
    """Once a train has told that it stopped it has not come into the overlap under this run, and never will (T9)."""
    return all(
        not order.stopped
        or run not in system.radio.offers
        or (
            run not in system.track.slipping
            and run in system.track.stood
            and all(
                block not in site.layout.overlap[run.route] or block not in system.track.at.get(car, frozenset())
                for car in system.track.under
                for block, other in system.track.under[car].items()
                if other == run
            )
        )
        for train in system.units
        for run, order in system.units[train].orders.items()
    ) and all(
        run not in system.track.slipping
        and run in system.track.stood
        and all(
            block not in site.layout.overlap[run.route] or block not in system.track.at.get(car, frozenset())
            for car in system.track.under
            for block, other in system.track.under[car].items()
            if other == run
        )
        and run.train in system.units
        and (
            run.life != system.units[run.train].life
            or (run in system.units[run.train].orders and system.units[run.train].orders[run].stopped)
        )
        for run in system.radio.stops
    )
