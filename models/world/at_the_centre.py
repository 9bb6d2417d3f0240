"""What happens at the centre: a request, or a message that was once sent arrives."""

from __future__ import annotations

from dataclasses import replace

from kernel import cancellation, recovery, release, route_setting, supervision
from kernel.names import Block, Epoch, Point, Position, Read, Run, TerminalLife, Train, UnitLife
from kernel.restarts import restart_centre as restarted_centre
from models.world.state import Site, System, Track


def request(site: Site, system: System, run: Run, base: Run) -> System:
    """A signaller or timetable asks for a route (T9)."""
    return replace(system, centre=route_setting.request(site.layout, system.centre, run, base))


def note_confirmation(site: Site, system: System, run: Run, point: Point, position: Position) -> System:
    """A point's confirmation arrives (T10)."""
    if (run, point, position) not in system.radio.confirmations:
        return system
    return replace(system, centre=route_setting.note_confirmation(site.layout, system.centre, run, point, position))


def open_first_loop(site: Site, system: System, run: Run) -> System:
    """The centre finds every point proved (T4)."""
    return replace(system, centre=route_setting.open_first_loop(site.layout, system.centre, run))


def note_echo(site: Site, system: System, run: Run) -> System:
    """An echo arrives (T4)."""
    tag_list = system.radio.echoes.get(run)
    if tag_list is None:
        return system
    return replace(system, centre=route_setting.note_echo(site.layout, system.centre, run, tag_list))


def release_block(site: Site, system: System, run: Run, block: Block, left: Read, entered: Read) -> System:
    """A tail report arrives (T6, T7)."""
    if (run, block, left, entered) not in system.radio.tail_reports:
        return system
    return replace(system, centre=release.release(site.layout, site.records, system.centre, run, block, left, entered))


def release_overlap(site: Site, system: System, run: Run) -> System:
    """The word that a train stands in its destination arrives (T9)."""
    if run not in system.radio.stops:
        return system
    return replace(system, centre=release.release_overlap(site.layout, system.centre, run))


def retire(site: Site, system: System, run: Run) -> System:
    """The centre forgets a run that holds nothing (T8)."""
    return replace(system, centre=release.retire(system.centre, run))


def withdraw(site: Site, system: System, run: Run) -> System:
    """The signaller takes a run back before the train was told (T9)."""
    return replace(system, centre=cancellation.withdraw(site.layout, system.centre, run))


def cancel(site: Site, system: System, run: Run) -> System:
    """The signaller wants a run back (T9)."""
    return replace(system, centre=cancellation.cancel(site.layout, system.centre, run))


def note_given_back(site: Site, system: System, run: Run) -> System:
    """A train's acknowledgement arrives (T9)."""
    if run not in system.radio.returns:
        return system
    return replace(system, centre=cancellation.note_given_back(site.layout, system.centre, run))


def restart_centre(site: Site, system: System, epoch: Epoch) -> System:
    """The centre restarts and has forgotten all but its counters (T8)."""
    if epoch <= system.centre.epoch:
        return system
    return replace(system, centre=restarted_centre(site.layout, system.centre, epoch))


def note_standing(site: Site, system: System, train: Train, life: UnitLife, epoch: Epoch, run: Run) -> System:
    """A train's answer to the challenge arrives (T8)."""
    blocks = system.radio.standings.get((train, life, epoch))
    if blocks is None:
        return system
    centre = recovery.note_standing(site.layout, system.centre, train, life, epoch, blocks, run)
    if centre.newest == system.centre.newest:
        return replace(system, centre=centre)
    return replace(system, centre=centre, track=accounted_for(site, system, run))


def recover_block(site: Site, system: System, block: Block) -> System:
    """The centre finds a lost block again (T8)."""
    return replace(system, centre=recovery.recover_block(site.layout, system.centre, block))


def recover_point(site: Site, system: System, point: Point) -> System:
    """The centre finds a lost point again (T8)."""
    return replace(system, centre=recovery.recover_point(site.layout, system.centre, point))


def note_terminal_life(site: Site, system: System, point: Point, life: TerminalLife) -> System:
    """A terminal's word which life it is in arrives (T10)."""
    if (point, life) not in system.radio.terminal_lives:
        return system
    return replace(system, centre=recovery.note_terminal_life(system.centre, point, life))


def adopt_point(site: Site, system: System, run: Run, point: Point, position: Position) -> System:
    """How the point under a standing train lies arrives (T8, T10)."""
    if (run, point, position) not in system.radio.confirmations:
        return system
    return replace(system, centre=recovery.adopt_point(site.layout, system.centre, run, point, position))


def open_procedure(site: Site, system: System, train: Train) -> System:
    """The signaller opens the supervised procedure (T8)."""
    return replace(system, centre=supervision.open_procedure(site.layout, system.centre, train))


def note_statement(site: Site, system: System, train: Train, life: UnitLife, epoch: Epoch) -> System:
    """The first person's statement arrives (T8)."""
    blocks = system.radio.statements.get((train, life, epoch))
    if blocks is None:
        return system
    return replace(system, centre=supervision.note_statement(system.centre, train, life, epoch, blocks))


def note_statement_confirmed(
    site: Site, system: System, train: Train, life: UnitLife, epoch: Epoch, run: Run
) -> System:
    """The second person's confirmation arrives (T8)."""
    blocks = system.radio.confirmed_statements.get((train, life, epoch))
    if blocks is None:
        return system
    centre = supervision.note_statement_confirmed(site.layout, system.centre, train, life, epoch, blocks, run)
    if centre.newest == system.centre.newest:
        return replace(system, centre=centre)
    return replace(system, centre=centre, track=accounted_for(site, system, run))


def accounted_for(site: Site, system: System, run: Run) -> Track:
    """Write the history on: the cars of a train accounted for stand under the run that stands for it.

    History only; nothing that decides reads it.
    """
    under = system.track.under | {
        car: {block: run for block in system.track.at[car]}
        for car in system.track.at
        if site.formation.train_of.get(car) == run.train
    }
    return replace(system.track, under=under)
