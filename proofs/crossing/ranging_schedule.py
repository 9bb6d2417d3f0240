"""What is claimed of the slots of a radio channel: one ranging at a time, and everybody's turn comes (X1)."""

from __future__ import annotations

from models.crossing import ranging_schedule as world
from models.crossing.ranging_schedule import Channel, Ranging
from proofs.crossing import ranging_service
from proofs.promise import by_goal
from proofs.theory import Theory, by_name


def nobody_is_registered(site: Channel, system: Ranging) -> bool:
    """At the start nothing was ever ordered, and the channel is taken for a slot (X1)."""
    return (
        all(False for _pair in system.schedule.turns)
        and all(False for _pair in system.waits)
        and all(False for _number in system.sent)
        and all(False for _number in system.under_way)
        and all(False for _number in system.taken)
        and system.schedule.pairs == 0
        and system.registered == 0
        and system.schedule.number == 0
        and system.schedule.taken_ms == site.settings.slot_ms
        and 0 <= system.phase_ms <= site.bounds.cycle_ms
        and system.told.pair == system.told.of
        and system.told.age_cycles == system.told.since_cycles
    )


# ---- safety


def no_two_rangings_at_once(site: Channel, system: Ranging) -> bool:
    """On the channel there is one ranging at the most, whatever was lost and whoever has restarted (X1)."""
    return all(one == other for one in system.under_way for other in system.under_way)


def each_pair_is_ranged_in_turn(site: Channel, system: Ranging) -> bool:
    """No registered pair waits for more slots than there were pairs since its last, each a tick longer than written."""
    return all(
        wait.waited_ms <= wait.most * (site.settings.slot_ms + site.settings.tick_ms)
        for _pair, wait in system.waits.items()
    )


def no_more_pairs_than_written(site: Channel, system: Ranging) -> bool:
    """Who waits has no more before it, through coming and going of others, than is written for the channel (X1)."""
    return all(wait.most <= site.settings.most_pairs for _pair, wait in system.waits.items())


def a_ranging_counts_until_the_next_is_answered(site: Channel, system: Ranging) -> bool:
    """While answers come, no crossing loses a registered train for want of a slot (X1, X3)."""
    return all(wait.held_cycles <= site.bounds.silence_cycles for _pair, wait in system.waits.items())


def an_answer_counts_for_who_was_ranged(site: Channel, system: Ranging) -> bool:
    """What a crossing is told of a train is of a ranging of that train, and for that crossing, however late (X1)."""
    return system.told.pair == system.told.of


def a_ranging_is_no_older_than_it_says(site: Channel, system: Ranging) -> bool:
    """The age that a crossing is told of a ranging is not less than the time since it was taken (X1)."""
    return system.told.age_cycles >= system.told.since_cycles


# ---- what it rests on


def who_waits_is_registered(site: Channel, system: Ranging) -> bool:
    """The ground unit has those on its list who have registered and not left, and counts them (X1)."""
    return (
        all(pair in system.schedule.turns for pair in system.waits)
        and all(pair in system.waits for pair in system.schedule.turns)
        and system.schedule.pairs == system.registered
    )


def settings_are_checked(site: Channel, system: Ranging) -> bool:
    """Who is registered is so on a channel with settings that leave time for all (X1)."""
    slot_ms, tick_ms, cycle_ms = site.settings.slot_ms, site.settings.tick_ms, site.bounds.cycle_ms
    return all(
        tick_ms > 0
        and slot_ms > 0
        and site.settings.most_pairs * (slot_ms + tick_ms) + slot_ms + cycle_ms <= site.bounds.silence_cycles * cycle_ms
        for _pair in system.schedule.turns
    )


def each_pair_has_a_place_of_its_own(site: Channel, system: Ranging) -> bool:
    """Places are counted from none, and no two pairs have one, nor one slot (X1)."""
    turns = system.schedule.turns
    return all(0 <= turn.place < system.schedule.pairs for _pair, turn in turns.items()) and all(
        one == other or (turns[one].place != turns[other].place) for one in turns for other in turns
    )


def each_slot_is_of_one_pair(site: Channel, system: Ranging) -> bool:
    """No two pairs have had one slot as their last, and none has had one that was not (X1)."""
    turns = system.schedule.turns
    return (
        system.schedule.number >= 0
        and all(-1 <= turn.number <= system.schedule.number and turn.age_cycles >= 0 for _pair, turn in turns.items())
        and all(
            one == other or turns[one].number == -1 or turns[one].number != turns[other].number
            for one in turns
            for other in turns
        )
    )


def the_pairs_fit_the_places(site: Channel, system: Ranging) -> bool:
    """There are no more than written, and not fewer than none (X1)."""
    return system.schedule.pairs >= 0 and all(
        system.schedule.pairs <= wait.most <= site.settings.most_pairs for _pair, wait in system.waits.items()
    )


def orders_are_of_slots_that_were(site: Channel, system: Ranging) -> bool:
    """No order has a number beyond the newest, and radios range by what was ordered alone (X1)."""
    return (
        all(0 <= number <= system.schedule.number and sent.since_ms >= 0 for number, sent in system.sent.items())
        and all(number in system.sent for number in system.under_way)
        and all(number in system.sent for number in system.taken)
    )


def the_channel_is_taken_until_a_slot_after_each_order(site: Channel, system: Ranging) -> bool:
    """Through a restart as well (X1)."""
    taken_ms, slot_ms = system.schedule.taken_ms, site.settings.slot_ms
    return (taken_ms == slot_ms or 0 <= taken_ms <= slot_ms) and all(
        sent.since_ms + taken_ms >= slot_ms for _number, sent in system.sent.items()
    )


def while_a_slot_lasts_no_other_order_is_fresh(site: Channel, system: Ranging) -> bool:
    """Whoever has the newest slot, the orders of all others are a slot old (X1)."""
    return all(
        sent.since_ms >= site.settings.slot_ms
        for _pair, turn in system.schedule.turns.items()
        if turn.number == system.schedule.number
        for number, sent in system.sent.items()
        if number != system.schedule.number
    )


def no_two_orders_are_fresh(site: Channel, system: Ranging) -> bool:
    """Of two orders one is a slot old (X1)."""
    return all(
        one == other
        or system.sent[one].since_ms >= site.settings.slot_ms
        or system.sent[other].since_ms >= site.settings.slot_ms
        for one in system.sent
        for other in system.sent
    )


def a_ranging_under_way_is_by_a_fresh_order(site: Channel, system: Ranging) -> bool:
    """It was ordered less long ago than rangings take at the most (X1)."""
    return all(system.sent[number].since_ms < site.over_ms for number in system.under_way if number in system.sent)


def an_order_is_for_the_pair_of_its_slot(site: Channel, system: Ranging) -> bool:
    """The number that a pair has is that of an order for it, if one was sent (X1)."""
    return all(
        system.sent[turn.number].pair == pair
        for pair, turn in system.schedule.turns.items()
        if turn.number in system.sent
    )


def a_turn_is_as_old_as_its_ranging(site: Channel, system: Ranging) -> bool:
    """A slot has not begun later than the ranging in it (X1)."""
    return all(
        system.taken[turn.number] <= turn.age_cycles
        for _pair, turn in system.schedule.turns.items()
        if turn.number in system.taken
    )


def who_waits_comes_nearer(site: Channel, system: Ranging) -> bool:
    """What it has waited and what is still before it make no more than a slot for each pair (X1)."""
    settings = site.settings
    return all(
        system.waits[pair].waited_ms >= 0
        and system.waits[pair].waited_ms + system.schedule.taken_ms + turn.place * (settings.slot_ms + settings.tick_ms)
        <= (system.waits[pair].most - 1) * (settings.slot_ms + settings.tick_ms) + settings.slot_ms
        for pair, turn in system.schedule.turns.items()
        if pair in system.waits
    )


def who_was_ordered_has_its_slot(site: Channel, system: Ranging) -> bool:
    """Until it is over nobody else's begins (X1)."""
    return all(
        system.waits[pair].waited_ms + system.schedule.taken_ms >= site.settings.slot_ms
        for pair, turn in system.schedule.turns.items()
        if pair in system.waits and turn.number != -1
    )


def what_is_held_is_a_round_old_at_most(site: Channel, system: Ranging) -> bool:
    """And its own slot more; once that is over it is as old as the pair has waited (X1)."""
    settings = site.settings
    return all(
        wait.held_ms >= 0
        and (
            wait.held_ms == wait.waited_ms
            if wait.waited_ms >= settings.slot_ms
            else wait.held_ms <= settings.most_pairs * (settings.slot_ms + settings.tick_ms) + wait.waited_ms
        )
        for _pair, wait in system.waits.items()
    ) and all(
        system.waits[pair].held_ms == system.waits[pair].waited_ms
        for pair, turn in system.schedule.turns.items()
        if pair in system.waits and turn.number == -1
    )


def an_age_is_at_most_a_cycle_more_than_the_time(site: Channel, system: Ranging) -> bool:
    """Of a turn, and of what is held; and it is the same once its slot is over (X1)."""
    cycle_ms = site.bounds.cycle_ms
    return 0 <= system.phase_ms <= cycle_ms and all(
        turn.age_cycles * cycle_ms + system.phase_ms <= system.waits[pair].waited_ms + cycle_ms
        and system.waits[pair].held_cycles * cycle_ms + system.phase_ms <= system.waits[pair].held_ms + cycle_ms
        for pair, turn in system.schedule.turns.items()
        if pair in system.waits
    )


INITIAL = (nobody_is_registered,)
SAFETY = (
    no_two_rangings_at_once,
    each_pair_is_ranged_in_turn,
    no_more_pairs_than_written,
    a_ranging_counts_until_the_next_is_answered,
    an_answer_counts_for_who_was_ranged,
    a_ranging_is_no_older_than_it_says,
)
INVARIANTS = (
    *SAFETY,
    who_waits_is_registered,
    settings_are_checked,
    each_pair_has_a_place_of_its_own,
    each_slot_is_of_one_pair,
    the_pairs_fit_the_places,
    orders_are_of_slots_that_were,
    the_channel_is_taken_until_a_slot_after_each_order,
    while_a_slot_lasts_no_other_order_is_fresh,
    no_two_orders_are_fresh,
    a_ranging_under_way_is_by_a_fresh_order,
    an_order_is_for_the_pair_of_its_slot,
    a_turn_is_as_old_as_its_ranging,
    who_waits_comes_nearer,
    who_was_ordered_has_its_slot,
    what_is_held_is_a_round_old_at_most,
    an_age_is_at_most_a_cycle_more_than_the_time,
)
PREMISES = (world.a_slot_is_written_as_long_as_a_ranging_takes, world.decisions_take_time)
STEPS = (
    world.register,
    world.leave,
    world.tick,
    world.decide,
    world.send_order,
    world.begin_ranging,
    world.end_ranging,
    world.hear_answer,
    world.restart,
)

THEORY = Theory(
    "ranging_schedule",
    Channel,
    Ranging,
    by_name(STEPS),
    by_name(INITIAL),
    by_name(INVARIANTS),
    by_name(SAFETY),
    by_name(PREMISES),
    promises=by_goal(ranging_service.PROMISES),
    quantified=True,
)
