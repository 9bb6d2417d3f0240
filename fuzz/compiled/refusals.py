"""Why the kernel refused an event of the world: the question to ask for each transition that has one."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from kernel.cancellation import cancel_refusal
from kernel.names import Block, Epoch, Point, Read, Run, Train, UnitLife
from kernel.recovery import recover_point_refusal, standing_refusal
from kernel.refusal import Refusal
from kernel.release import release_refusal, retire_refusal
from kernel.route_setting import echo_refusal, open_first_loop_refusal, request_refusal
from kernel.supervision import supervised_refusal
from models.world.state import Site, System


def request(site: Site, system: System, run: Run, base: Run) -> Refusal | None:
    """Why a route is not set (T9)."""
    return request_refusal(site.layout, system.centre, run, base)


def open_first_loop(site: Site, system: System, run: Run) -> Refusal | None:
    """Why a tag list is not sent (T4)."""
    return open_first_loop_refusal(site.layout, system.centre, run)


def note_echo(site: Site, system: System, run: Run) -> Refusal | None:
    """Why a run is not set though its echo has come, if it has (T4)."""
    tag_list = system.radio.echoes.get(run)
    if tag_list is None:
        return None
    return echo_refusal(site.layout, system.centre, run, tag_list)


def release_block(site: Site, system: System, run: Run, block: Block, left: Read, entered: Read) -> Refusal | None:
    """Why a block is not released (T6, T7)."""
    return release_refusal(site.layout, site.records, system.centre, run, block, left, entered)


def retire(site: Site, system: System, run: Run) -> Refusal | None:
    """Why a run is not forgotten (T8)."""
    return retire_refusal(system.centre, run)


def cancel(site: Site, system: System, run: Run) -> Refusal | None:
    """Why a run is not wanted back (T9)."""
    return cancel_refusal(site.layout, system.centre, run)


def note_standing(site: Site, system: System, train: Train, life: UnitLife, epoch: Epoch, run: Run) -> Refusal | None:
    """Why a train is not taken at its word, if it gave one (T8)."""
    blocks = system.radio.standings.get((train, life, epoch))
    if blocks is None:
        return None
    return standing_refusal(site.layout, system.centre, train, life, epoch, blocks, run)


def recover_point(site: Site, system: System, point: Point) -> Refusal | None:
    """Why a lost point stays lost (T8, T10)."""
    return recover_point_refusal(site.layout, system.centre, point)


def note_statement_confirmed(
    site: Site, system: System, train: Train, life: UnitLife, epoch: Epoch, run: Run
) -> Refusal | None:
    """Why a supervised train is not accounted for where the second person has seen it, if he has (T8)."""
    blocks = system.radio.confirmed_statements.get((train, life, epoch))
    if blocks is None:
        return None
    return supervised_refusal(site.layout, system.centre, train, life, epoch, blocks, run)


REFUSALS: Mapping[str, Callable[..., Refusal | None]] = {
    function.__name__: function
    for function in (
        request,
        open_first_loop,
        note_echo,
        release_block,
        retire,
        cancel,
        note_standing,
        recover_point,
        note_statement_confirmed,
    )
}
"""By the name of the transition."""
