"""Release at last: of the blocks that a tail has left, of an overlap, of a run that holds nothing (T6 to T9)."""

from __future__ import annotations

from kernel.names import Block, Read, Run
from kernel.tail_evidence import reports_left
from models.world import at_the_centre, radio
from models.world.state import Site, System
from proofs.invariants.vocabulary import genuine
from proofs.promise import Link, Promise
from proofs.promises.vocabulary import holds, lives, order_of


def a_left_block_is_freed(site: Site, system: System, run: Run, block: Block, left: Read, entered: Read) -> bool:
    """A block is free of a run once its tail has left it, by both tags, and what ends with it (T6, T7).

    Or, before the report is sent, the unit begins another life (what it held is freed when it tells where it stands),
    or its tail reads that boundary again.
    """
    order = order_of(system, run)
    return not holds(system, run, block) or (
        (run, block, left, entered) not in system.radio.tail_reports
        and (
            order is None
            or block not in order.left
            or order.left[block].left != left
            or order.left[block].entered != entered
        )
    )


def the_exit_is_on_board(site: Site, system: System, run: Run, block: Block, left: Read, entered: Read) -> bool:
    """The unit reports that its tail has left the block, and the tags it read are those of its end (T6, T7)."""
    unit = system.units.get(run.train)
    return (
        genuine(site, block, left, entered)
        and unit is not None
        and reports_left(site.lists, unit, run, block, left, entered)
    )


def the_exit_is_in_the_air(site: Site, system: System, run: Run, block: Block, left: Read, entered: Read) -> bool:
    """The report was sent (T6)."""
    return genuine(site, block, left, entered) and (run, block, left, entered) in system.radio.tail_reports


def an_overlap_is_freed(site: Site, system: System, run: Run, block: Block) -> bool:
    """The overlap is free once the train stands in its destination; or its unit restarts before it tells so (T9)."""
    return not holds(system, run, block) or (run not in system.radio.stops and not lives(system, run.train, run.life))


def it_stands_in_its_destination(site: Site, system: System, run: Run, block: Block) -> bool:
    """The unit tells that the train stands in the destination of the run (T9)."""
    order = order_of(system, run)
    return (
        run.route in site.layout.routes
        and block in site.layout.overlap[run.route]
        and order is not None
        and order.begun
        and order.stopped
        and not order.given_back
    )


def its_standstill_is_in_the_air(site: Site, system: System, run: Run, block: Block) -> bool:
    """The word of it was sent (T9)."""
    return run.route in site.layout.routes and block in site.layout.overlap[run.route] and run in system.radio.stops


def a_run_that_holds_nothing_is_forgotten(site: Site, system: System, run: Run, block: Block) -> bool:
    """The centre does not remember a run for ever; and until it is forgotten, what is free of it stays free (T8)."""
    return run not in system.centre.runs


def the_block_is_free_of_it(site: Site, system: System, run: Run, block: Block) -> bool:
    """The block is not held for the run, and never will be again."""
    return run in system.centre.runs and not holds(system, run, block)


def it_holds_nothing(site: Site, system: System, run: Run) -> bool:
    """No other block is held for it either."""
    return all(run not in holders for _block, holders in system.centre.claimed.items())


PROMISES = (
    Promise(
        (
            Link(the_exit_is_on_board, radio.send_tail_report),
            Link(the_exit_is_in_the_air, at_the_centre.release_block),
        ),
        a_left_block_is_freed,
    ),
    Promise(
        (
            Link(it_stands_in_its_destination, radio.send_stop),
            Link(its_standstill_is_in_the_air, at_the_centre.release_overlap),
        ),
        an_overlap_is_freed,
    ),
    Promise(
        (Link(the_block_is_free_of_it, at_the_centre.retire, it_holds_nothing),),
        a_run_that_holds_nothing_is_forgotten,
    ),
)
"""In the order in which a run comes to them."""
