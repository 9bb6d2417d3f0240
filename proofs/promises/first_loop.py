"""The first loop closes at last: a run whose points are proved becomes the train's permit (T4)."""

from __future__ import annotations

from kernel.names import Run, Stage, TagList
from models.world import at_the_centre, on_board, radio
from models.world.state import Site, System
from proofs.invariants.vocabulary import at_stage
from proofs.promise import Link, Promise
from proofs.promises.vocabulary import can_be_told, lives, order_of


def a_proved_run_is_permitted(site: Site, system: System, run: Run) -> bool:
    """The train may enter a run whose points are proved.

    Or the run is taken back meanwhile, or the unit restarts, or it keeps another list than it was sent (T4).
    """
    order = order_of(system, run)
    return (
        (order is not None and (order.permitted or order.given_back or not keeps_the_centres_list(site, system, run)))
        or not lives(system, run.train, run.life)
        or not is_wanted(system, run)
    )


def is_wanted(system: System, run: Run) -> bool:
    """The centre has the run, not over, and has not asked for it back."""
    grant = system.centre.runs.get(run)
    return grant is not None and grant.stage != Stage.OVER and not grant.cancelling


def keeps_the_centres_list(site: Site, system: System, run: Run) -> bool:
    """What the unit keeps of the route is what the centre has sent."""
    order = order_of(system, run)
    return order is not None and run.route in site.layout.tag_list and order.tag_list == site.layout.tag_list[run.route]


def its_points_are_proved(site: Site, system: System, run: Run) -> bool:
    """Each point that the run needs was confirmed, and the unit knows under which run it stands."""
    grant = system.centre.runs.get(run)
    return (
        can_be_told(system, run)
        and grant is not None
        and grant.stage == Stage.RESERVED
        and run.route in site.layout.routes
        and all(point in grant.proved for point in site.layout.needs[run.route])
    )


def it_is_offered(site: Site, system: System, run: Run) -> bool:
    """The centre sends the tag list."""
    return can_be_told(system, run) and at_stage(system, run, Stage.OFFERED)


def its_tags_are_in_the_air(site: Site, system: System, run: Run) -> bool:
    """The tag list was sent."""
    return it_is_offered(site, system, run) and run in system.radio.offers


def its_tags_are_on_board(site: Site, system: System, run: Run) -> bool:
    """The unit has the tag list, and echoes it."""
    return it_is_offered(site, system, run) and keeps_the_centres_list(site, system, run)


def it_is_the_list_on_board(site: Site, system: System, run: Run, tag_list: TagList) -> bool:
    """What the unit sends back is what it keeps."""
    order = order_of(system, run)
    return order is not None and order.tag_list == tag_list


def its_echo_is_in_the_air(site: Site, system: System, run: Run) -> bool:
    """The echo was sent."""
    return its_tags_are_on_board(site, system, run) and run in system.radio.echoes


def its_loop_is_closed(site: Site, system: System, run: Run) -> bool:
    """The echo has come, and the centre sends the permit."""
    return order_of(system, run) is not None and at_stage(system, run, Stage.SET)


def its_permit_is_in_the_air(site: Site, system: System, run: Run) -> bool:
    """The permit was sent."""
    return its_loop_is_closed(site, system, run) and run in system.radio.permits


def a_train_learns_under_which_run_it_stands(site: Site, system: System, run: Run) -> bool:
    """The unit knows the run that stands for it; or it restarts, or stands for it no more (T8)."""
    return (
        order_of(system, run) is not None
        or not lives(system, run.train, run.life)
        or not at_stage(system, run, Stage.STANDING)
    )


def it_stands(site: Site, system: System, run: Run) -> bool:
    """The run stands for a train where it told that it is."""
    return at_stage(system, run, Stage.STANDING)


def its_run_is_in_the_air(site: Site, system: System, run: Run) -> bool:
    """The word of it was sent."""
    return run in system.radio.standing_runs


PROMISES = (
    Promise(
        (
            Link(it_stands, radio.send_standing_run),
            Link(its_run_is_in_the_air, on_board.take_standing),
        ),
        a_train_learns_under_which_run_it_stands,
    ),
    Promise(
        (
            Link(its_points_are_proved, at_the_centre.open_first_loop),
            Link(it_is_offered, radio.send_offer),
            Link(its_tags_are_in_the_air, on_board.take_offer),
            Link(its_tags_are_on_board, radio.send_echo, it_is_the_list_on_board),
            Link(its_echo_is_in_the_air, at_the_centre.note_echo),
            Link(its_loop_is_closed, radio.send_permit),
            Link(its_permit_is_in_the_air, on_board.take_permit),
        ),
        a_proved_run_is_permitted,
    ),
)
"""In the order in which a train comes to them."""
