"""What is promised of the slots of a radio channel: whoever is registered is ranged again at last (X1).

That it is so within a time is claimed beside this: `each_pair_is_ranged_in_turn`.
"""

from __future__ import annotations

from kernel.crossing.ranging_schedule import Pair
from models.crossing import ranging_schedule as world
from models.crossing.ranging_schedule import Channel, Ranging
from proofs.promise import Link, Promise


def a_registered_pair_is_ranged_again(site: Channel, system: Ranging, pair: Pair, number: int) -> bool:
    """A pair has a slot after the one of that number, or is registered no more (X1)."""
    return pair not in system.schedule.turns or system.schedule.turns[pair].number > number


def it_waits_for_its_turn(site: Channel, system: Ranging, pair: Pair, number: int) -> bool:
    """A pair is registered, and its last slot is no newer than the channel's of that number."""
    return pair in system.schedule.turns and system.schedule.turns[pair].number <= number <= system.schedule.number


def the_time_until_its_turn(site: Channel, system: Ranging, pair: Pair, number: int) -> int:
    """For how long the channel is still taken, and the slots of those before it, each a tick longer than written."""
    if pair not in system.schedule.turns:
        return 0
    each_ms = site.settings.slot_ms + site.settings.tick_ms
    return system.schedule.taken_ms + system.schedule.turns[pair].place * each_ms


def time_passes(site: Channel, system: Ranging, passed_ms: int) -> bool:
    """What is under way ends in its time, and the tick is in time."""
    return world.ticks_come_in_time(site, passed_ms) and world.rangings_under_way_end_in_time(site, system, passed_ms)


PROMISES = (
    Promise(
        links=(Link(it_waits_for_its_turn, world.tick, time_passes, the_time_until_its_turn),),
        goal=a_registered_pair_is_ranged_again,
    ),
)
