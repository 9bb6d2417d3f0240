"""Weakenings of the protocol, each with the one-line story of what goes wrong."""

from __future__ import annotations

from kernel import (
    authority,
    first_loop,
    recovery,
    release,
    restarts,
    route_setting,
    supervision,
    tail_evidence,
)
from proofs.planted import weakened
from proofs.planted.fault import Fault

READ_FORGOTTEN = "kernel.change_of_ends.change_ends: update tail_read=None"
STILL_GOOD = (
    "kernel.second_loop.tail_read_still_good: guard if before is None or before.tag == tag or "
    "plan.partner.get(before.tag) == tag: None"
)
"""The guard by which the head, passing a boundary, makes what the tail read there before worth nothing."""
HAS_LEFT = (
    "kernel.tail_evidence.has_left: condition has_been_in(lists, order, block) and (order.tag_list is None "
    "or backs_out(lists, unit, order, block) or has_gone_on(lists, unit, run, block, over))"
)
"""The guard by which a tail leaves a block only for the runs under which the head was there and has gone on."""
OVER_IT = (
    "kernel.tail_evidence.has_gone_on: and-operand "
    "lists.tag_after.get(order.tag_list, NO_TAGS).get(over.left.tag) == over.entered.tag"
)
"""The guard by which a head has gone on only over the boundary that the tail gets over, and in that direction."""
OVER_ITSELF = (
    "kernel.route_setting.request_refusal: guard if against is None and meets_its_own_train(layout, centre, run): "
    "Refusal.NOT_CLEAR_OF_ITS_OWN_TRAIN"
)
"""The guard by which no run is set over a block that its own train has not been told to have left."""

TURNED_ASTRIDE = Fault(
    "the tail's last read is good after two changes of ends",
    "The train turns twice astride a boundary, and what its tail read before pairs with what it reads after.",
    "change_ends",
    dropped=(READ_FORGOTTEN, STILL_GOOD, HAS_LEFT),
)
"""Three guards: the head passes that boundary between the changes of ends, and has not gone on as it leads now.

Each of them alone stops the attack.
"""
LAP_BEFORE = Fault(
    "a pair of reads may be of two passages",
    "On a ring the head passes the boundary again between the two reads, so the train is in the block once more.",
    "head_reads",
    {
        route_setting.is_run_through: weakened.no_run_is_in_the_way,
        route_setting.meets_its_own_train: weakened.no_run_is_in_the_way,
    },
    dropped=(STILL_GOOD, OVER_IT),
)
"""Four guards: such a pair is also of a way back over the boundary, and no head went on that way; no second lap is set
before the tail has left the first, and no way home over what it has not left."""
BLOCK_AHEAD = Fault(
    "a block ahead counts as left",
    "On a ring the tail leaves a block at the start of a run that has yet to come to it, and it is freed.",
    "tail_reads",
    dropped=(HAS_LEFT, OVER_ITSELF),
)
"""Two guards: a run that ends where its own train stands is not set."""
GIVEN_BACK_TOO_EARLY = Fault(
    "a run is given back that the brake lets the train into",
    "The centre frees it, and the train, which cannot stop before it any more, comes into it.",
    "give_back",
    dropped=("kernel.first_loop.give_back: or-operand held_end_mm > start_end_mm",),
)
NOTHING_COMPARED = Fault(
    "the first loop compares nothing",
    "The unit keeps the tags of another route and sends those back; the run is set all the same.",
    "note_echo",
    dropped=(
        "kernel.route_setting.echo_refusal: guard if layout.tag_list.get(run.route) != tag_list: Refusal.LISTS_DIFFER",
    ),
)
LIFE_CONFIRMED = Fault(
    "two persons confirm a life, not a place",
    "The centre holds what the first has stated; the second has seen the train somewhere else.",
    "note_statement_confirmed",
    {supervision.note_statement_confirmed: weakened.confirms_a_life},
)

WEAKENINGS: tuple[Fault, ...] = (
    Fault(
        "the centre forgets the run counter",
        "After a restart a number is granted a second time, and old messages speak for the new run.",
        "request",
        {route_setting.request_refusal: weakened.request_by_runs_known},
    ),
    Fault(
        "a terminal keeps its life over a restart",
        "It has forgotten which run it held, and an old order that comes late is still addressed to it.",
        "restart_terminal",
        {restarts.restart_terminal: weakened.terminal_keeps_its_life},
    ),
    Fault(
        "a unit keeps its life over a restart",
        "It has forgotten what it gave back and what its tail left; the old permit comes again.",
        "restart_unit",
        {restarts.restart_unit: weakened.unit_keeps_its_life},
    ),
    Fault(
        "a tag list is taken in any life",
        "A unit that has restarted takes up a run of its former life, which the centre may have ended.",
        "take_offer",
        {first_loop.take_offer: weakened.offer_to_any_life},
    ),
    Fault(
        "no approach locking",
        "The train says that a run is given back while its brake lets it in, and comes into what is another's by then.",
        "send_return",
        {first_loop.acknowledges_back: weakened.acknowledges_at_once},
    ),
    Fault(
        "an antenna on any car counts",
        "The head antenna reads the pair, and the block is reported left with the rest of the train in it.",
        "tail_reads",
        {tail_evidence.note_tail_read: weakened.any_antenna},
    ),
    Fault(
        "blocks come back unoccupied after a restart",
        "Trains stand where the restarted centre sees free track.",
        "restart_centre",
        {restarts.restart_centre: weakened.all_free_again},
    ),
    Fault(
        "a block is found again before every train has answered",
        "The train that did not answer stands in it.",
        "recover_block",
        {recovery.train_missing: weakened.nobody_is_missing},
    ),
    Fault(
        "the whole route is released on the evidence of one block",
        "The tail has left the first block, and the blocks the train is in are freed as well.",
        "release_block",
        {release.release: weakened.all_at_the_first_report},
    ),
    Fault(
        "a facing point on the way need not be held",
        "Where track leads off the way no point turns the train back to it, so it runs into a block not its own.",
        "car_moves",
        without=frozenset({"track_leads_along_the_way_or_is_turned"}),
    ),
    Fault(
        "a point on the way need not be needed",
        "A point in a block of the route is not locked for it, and drifts under the train.",
        "car_moves",
        without=frozenset({"every_point_in_a_route_is_needed"}),
    ),
    Fault(
        "the overlap is freed while the train can still slip",
        "The train tells that it stands while it slips, and comes into an overlap that is another's by then.",
        "note_stopped",
        {authority.note_stopped: weakened.stopped_wherever_it_is},
    ),
    Fault(
        "fouling blocks are not looked at",
        "Two trains are sent into blocks whose loading gauges touch.",
        "request",
        {route_setting.conflict: weakened.conflict_without_fouling},
    ),
    Fault(
        "a pair of reads may be two cabs' reads",
        "The train goes back between the two reads, and once more: the tail's last read is kept at a change of ends.",
        "change_ends",
        dropped=(READ_FORGOTTEN,),
    ),
    LAP_BEFORE,
    BLOCK_AHEAD,
    GIVEN_BACK_TOO_EARLY,
    NOTHING_COMPARED,
    LIFE_CONFIRMED,
)
