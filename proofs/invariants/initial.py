"""The states in which the system may start: a restart of everything, trains and points as they are (T8)."""

from __future__ import annotations

from models.world.state import Site, System
from proofs.invariants.safety import no_two_trains_in_a_block, no_two_trains_in_fouling_blocks


def everything_has_just_restarted(site: Site, system: System) -> bool:
    """The centre knows nothing but its counters, units and terminals hold nothing, the air is empty (T8)."""
    return (
        not any(True for _ in system.centre.accounted)
        and not any(True for _ in system.centre.runs)
        and not any(True for block in system.centre.claimed for _ in system.centre.claimed[block])
        and not any(True for point in system.centre.locked for _ in system.centre.locked[point])
        and not any(True for _ in system.centre.terminal_life)
        and not any(True for _ in system.centre.supervised)
        and not any(True for _ in system.centre.statements)
        and all(block in system.centre.lost_blocks for block in site.layout.blocks)
        and all(point in system.centre.lost_points for point in site.layout.points)
        and all(
            unit.answered is None
            and unit.isolated_in is None
            and unit.leading is None
            and unit.head_tag is None
            and unit.tail_read is None
            and not any(True for _ in unit.orders)
            for _, unit in system.units.items()
        )
        and all(terminal.holds is None and terminal.wanted is None for _, terminal in system.terminals.items())
    )


def nothing_was_ever_sent(site: Site, system: System) -> bool:
    """The air is empty: nobody has sent anything in the lives that have begun (T8)."""
    radio = system.radio
    return (
        not any(True for _ in radio.orders)
        and not any(True for _ in radio.relayed_orders)
        and not any(True for _ in radio.enquiries)
        and not any(True for _ in radio.relayed_enquiries)
        and not any(True for _ in radio.confirmed)
        and not any(True for _ in radio.confirmations)
        and not any(True for _ in radio.offers)
        and not any(True for _ in radio.echoes)
        and not any(True for _ in radio.permits)
        and not any(True for _ in radio.recalls)
        and not any(True for _ in radio.returns)
        and not any(True for _ in radio.tail_reports)
        and not any(True for _ in radio.stops)
        and not any(True for _ in radio.challenges)
        and not any(True for _ in radio.standings)
        and not any(True for _ in radio.standing_runs)
        and not any(True for _ in radio.terminal_lives)
        and not any(True for _ in radio.statements)
        and not any(True for _ in radio.confirmed_statements)
    )


def trains_stand_apart_on_locked_points(site: Site, system: System) -> bool:
    """Trains stand anywhere, no two in one block or in fouling blocks, none on an unlocked point (T8)."""
    return (
        no_two_trains_in_a_block(site, system)
        and no_two_trains_in_fouling_blocks(site, system)
        and all(
            point in system.terminals and not system.terminals[point].unlocked
            for car in system.track.at
            for block in system.track.at[car]
            for point in site.layout.points_in.get(block, frozenset())
        )
        and not any(True for _ in system.track.rolling)
        and not any(True for _ in system.track.slipping)
        and not any(True for _ in system.track.stood)
        and not any(True for _ in system.track.first_erred)
        and not any(True for _ in system.track.second_erred)
        and not any(True for _ in system.track.run_into)
        and not any(True for _ in system.track.begun)
        and not any(True for _ in system.track.entered)
        and not any(True for _ in system.track.gone)
        and not any(True for _ in system.track.behind)
        and not any(True for _ in system.track.leavable)
        and not any(True for _ in system.track.last_read)
        and not any(True for _ in system.track.passed)
        and not any(True for _ in system.track.unread)
        and not any(True for _ in system.track.astray)
        and not any(True for car in system.track.under for _ in system.track.under[car])
        and all(
            car in site.formation.train_of and site.formation.train_of[car] in site.layout.fleet
            for car in system.track.at
        )
        and all(block in site.layout.blocks for car in system.track.at for block in system.track.at[car])
        and all(train in system.units for train in site.layout.fleet)
        and all(point in system.terminals for point in site.layout.points)
    )
