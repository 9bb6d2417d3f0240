"""What is claimed of the tone: the normal one means that no train approaches within 3000 m (A2 to A6, A8)."""

from __future__ import annotations

from kernel.alarm.distance import worker_off_um
from kernel.alarm.tone import Tone
from models.alarm import alarm_tone as world
from models.alarm import lists as lists_of_trains
from models.alarm import tone_assumptions as assumed
from models.alarm.along import far_um, is_along
from models.alarm.tone_assumptions import (
    a_wrong_fix_is_contradicted,
    no_train_is_longer_than_written,
    no_train_turns_sooner,
    what_a_fix_says_is_along_the_register,
    what_has_passed_a_join_was_shown_so,
    what_has_passed_a_join_was_told_so,
    what_the_display_says_is_along_the_register,
)
from models.alarm.worksite import (
    NOTHING_LISTED,
    NOWHERE_NEAR,
    Railway,
    Worksite,
    has_another_part,
    is_in_a_stretch,
    is_of_the_register,
    is_report,
    is_told_alike,
)
from models.measures import UM_A_MM, apart
from proofs.alarm import train_list
from proofs.theory import Theory, by_name

# ---- the start


def nothing_was_told(site: Railway, system: Worksite) -> bool:
    """At the start the handset has heard nothing; trains are wherever they are (A8)."""
    return (
        system.heard.tone == Tone.FAULT
        and system.heard.matched_within_1500 == NOWHERE_NEAR
        and not system.heard.beyond_a_tunnel
        and all(False for _train in system.handset.trains)
        and not system.heard.astray
        and not system.heard.jumped_within_1500
        and all(False for _train in system.told.trains)
        and system.handset.server_age_ms > 3_600_000
        and system.handset.worker.age_ms > 3_600_000
        and system.told.list_age_ms == system.handset.server_age_ms
        and system.told.worker == system.handset.worker
        and system.told.servers_well == system.handset.servers_well
        and system.told.battery_well == system.handset.battery_well
        and system.told.listing == NOTHING_LISTED
        and not system.handset.listing.is_whole
        and system.handset.listing.life_ms == -1
        and system.handset.listing.taken == 0
        and system.handset.listing.count == 0
        and all(False for _train in system.handset.listing.named)
        and train_list.nothing_was_sent(site, system)
        and all(body.fix_is_right and body.came_ms > 3_600_000 for _train, body in system.bodies.items())
        and all(no_train_is_longer_than_written(site, body) for _train, body in system.bodies.items())
    )


# ---- safety


def the_normal_tone_means_no_train_within_3000_m(site: Railway, system: Worksite) -> bool:
    """While the normal tone sounds each train is farther than 3000 m, or of the line and has departed (A3).

    Of any network: also a train on a line that joins, beyond a break of kilometrage, or where the register ends.
    """
    is_normal, near = system.heard.tone == Tone.NORMAL, system.heard.within_3000
    return (
        not (is_normal and near.along_his_line)
        and not (is_normal and near.over_other_lines)
        and not (is_normal and near.by_an_opening)
    )


def caution_means_no_train_within_1500_m(site: Railway, system: Worksite) -> bool:
    """While neither alarm nor fault sounds each train is farther than 1500 m, of the line or not, or departed (A3)."""
    is_mild, near = system.heard.tone not in (Tone.ALARM, Tone.FAULT), system.heard.within_1500
    return (
        not (is_mild and near.along_his_line)
        and not (is_mild and near.over_other_lines)
        and not (is_mild and near.by_an_opening)
    )


def unknown_is_never_normal(site: Railway, system: Worksite) -> bool:
    """Without fault tone or alarm each train of the line is on the list, and known as it should be (A2, A8)."""
    return system.heard.tone in (Tone.ALARM, Tone.FAULT) or not system.heard.unknown


def a_stale_or_jumping_fix_sounds_the_fault_tone(site: Railway, system: Worksite) -> bool:
    """A fix too old, or out of reach of the one before, is heard as a fault, unless the alarm sounds (A1, A2).

    A stale one is no fault where it is registered that the display alone is enough.
    """
    return system.heard.tone in (Tone.ALARM, Tone.FAULT) or not system.heard.astray


def a_fix_that_jumps_near_sounds_the_alarm(site: Railway, system: Worksite) -> bool:
    """A fix out of reach of the one before that puts a train within 1500 m is obeyed, right or not (A1, A2)."""
    return system.heard.tone == Tone.ALARM or not system.heard.jumped_within_1500


def a_departing_train_never_masks_an_approaching_one(site: Railway, system: Worksite) -> bool:
    """If a matched train is within 1500 m and has not departed, the alarm sounds, whatever the others do (A3)."""
    is_other, near = system.heard.tone != Tone.ALARM, system.heard.matched_within_1500
    return not (is_other and near.along_his_line) and not (is_other and near.over_other_lines)


def a_train_in_a_tunnel_counts_at_its_outer_end(site: Railway, system: Worksite) -> bool:
    """If a train is on its way through a section, who is within 1500 m of its outer end hears the alarm (A4)."""
    return system.heard.tone == Tone.ALARM or not system.heard.beyond_a_tunnel


def in_a_section_not_to_be_used_no_tone_is_normal(site: Railway, system: Worksite) -> bool:
    """A worker who has a fix, and is in such a section, hears the fault tone or the alarm (A4, A5, A6)."""
    return system.heard.tone in (Tone.ALARM, Tone.FAULT) or not system.heard.not_to_be_used


def agreement_is_worth_the_stretch(site: Railway, system: Worksite) -> bool:
    """A fix that the display agrees with is off by the stretch shown at the most, whatever GPS did (A2).

    By its length, and what may be outside of it: the tolerance, the display's error and the way since.  That is
    kilometres where a stretch is; no more is claimed of a fix that nothing else contradicts.  Off along the track, of a
    train on the worker's line, and of a stretch that is told in one part.
    """
    register, trains = site.register, system.told.trains
    return all(
        is_along(
            register,
            trains[train].fix.place_mm,
            trains[train].fix.place_mm,
            body.antenna_um,
            UM_A_MM * (trains[train].display.to_mm - trains[train].display.from_mm)
            + UM_A_MM * (register.tolerance_mm + register.display_error_mm)
            + register.bounds.train_mm_s * trains[train].display.age_ms,
        )
        for train, body in system.bodies.items()
        if train in trains
        and body.is_on
        and not has_another_part(trains[train].display)
        and is_told_alike(site, trains[train])
        and is_of_the_register(body, trains[train].display.age_ms)
    )


# ---- what it rests on


def the_handset_has_what_was_told(site: Railway, system: Worksite) -> bool:
    """The handset has of the servers, of itself and of each train on the list what was told, as old as it is (A1)."""
    handset, told = system.handset, system.told
    return (
        told.worker == handset.worker
        and told.list_age_ms == handset.server_age_ms
        and told.servers_well == handset.servers_well
        and told.battery_well == handset.battery_well
        and told.listing.life_ms == handset.listing.life_ms
        and told.listing.taken == handset.listing.taken
        and told.listing.count == handset.listing.count
        and told.listing.is_whole == handset.listing.is_whole
        and told.listing.named == handset.listing.named
        and all(train in told.trains for train in handset.trains)
        and all(
            train in handset.trains
            and handset.trains[train].fix == of.fix
            and handset.trains[train].display == of.display
            and handset.trains[train].jumped == of.jumped
            and handset.trains[train].newest == of.newest
            for train, of in told.trains.items()
        )
    )


def the_worker_is_within_reach_of_his_fix(site: Railway, system: Worksite) -> bool:
    """The worker has got no farther from his fix than error and age allow (A1)."""
    worker = system.handset.worker
    return not is_report(worker.place_mm, worker.age_ms) or (
        apart(system.worker_um, UM_A_MM * worker.place_mm) <= worker_off_um(site.register.bounds, worker)
    )


def trains_are_within_reach_of_right_fixes(site: Railway, system: Worksite) -> bool:
    """No antenna has got farther from where it was told than error and age allow, by figures or over a join (A1)."""
    bounds, trains = site.register.bounds, system.handset.trains
    return all(
        (
            trains[train].fix.age_ms < body.passed_ms
            and apart(body.antenna_um, UM_A_MM * trains[train].fix.place_mm)
            <= UM_A_MM * bounds.train_error_mm + bounds.train_mm_s * trains[train].fix.age_ms
        )
        or what_has_passed_a_join_was_told_so(site, body, trains[train].fix)
        for train, body in system.bodies.items()
        if train in trains
        and body.is_on
        and body.fix_is_right
        and is_report(trains[train].fix.place_mm, trains[train].fix.age_ms)
    )


def trains_are_no_nearer_by_other_lines_than_right_fixes(site: Railway, system: Worksite) -> bool:
    """Nor has it got nearer over other lines than the register's ways from there, but by error and age (A1)."""
    trains = system.handset.trains
    return all(
        what_a_fix_says_is_along_the_register(site, body, trains[train].fix)
        for train, body in system.bodies.items()
        if train in trains and body.fix_is_right and is_report(trains[train].fix.place_mm, trains[train].fix.age_ms)
    )


def trains_are_within_reach_of_the_display(site: Railway, system: Worksite) -> bool:
    """No antenna has got farther from the stretch that the display shows, by figures or over a join (A1, A2)."""
    trains = system.handset.trains
    return all(
        what_has_passed_a_join_was_shown_so(site, body, trains[train].display)
        for train, body in system.bodies.items()
        if train in trains
        and body.is_on
        and is_in_a_stretch(trains[train].display)
        and is_of_the_register(body, trains[train].display.age_ms)
    )


def trains_are_no_nearer_by_other_lines_than_the_display(site: Railway, system: Worksite) -> bool:
    """Nor has it got nearer over other lines than the register's ways from there (A1, A2)."""
    trains = system.handset.trains
    return all(
        what_the_display_says_is_along_the_register(site, body, trains[train].display)
        for train, body in system.bodies.items()
        if train in trains
        and is_in_a_stretch(trains[train].display)
        and is_of_the_register(body, trains[train].display.age_ms)
    )


def a_train_is_near_the_opening_that_it_came_by(site: Railway, system: Worksite) -> bool:
    """A train that came by an opening this hour has got no farther from it than the line's speed lets it (A1)."""
    register = site.register
    return all(
        body.came_by in register.openings
        and body.came_ms >= 0
        and (
            not body.is_on
            or register.bounds.train_mm_s * body.came_ms > far_um(register)
            or is_along(
                register,
                register.openings[body.came_by],
                register.openings[body.came_by],
                body.antenna_um,
                register.bounds.train_mm_s * body.came_ms,
            )
        )
        for _train, body in system.bodies.items()
        if body.came_ms <= 3_600_000
    )


def a_train_is_no_nearer_by_other_lines_than_its_opening(site: Railway, system: Worksite) -> bool:
    """Nor has it got nearer over other lines than the register's ways from there (A1)."""
    register = site.register
    return all(
        way_um + register.bounds.train_mm_s * body.came_ms > far_um(register)
        or is_along(
            register,
            register.openings[body.came_by],
            register.openings[body.came_by],
            UM_A_MM * register.ways[way].to_mm,
            way_um + register.bounds.train_mm_s * body.came_ms,
        )
        for _train, body in system.bodies.items()
        for way, way_um in body.ways_um.items()
        if body.came_ms <= 3_600_000 and body.came_by in register.openings and way in register.ways
    )


def wrong_fixes_are_contradicted(site: Railway, system: Worksite) -> bool:
    """A fix that is wrong is one that the display contradicts, but of a train that has just come (A2)."""
    return all(
        a_wrong_fix_is_contradicted(site, system.told.trains[train], body, body.fix_is_right)
        for train, body in system.bodies.items()
        if train in system.told.trains
    )


def told_directions_still_hold(site: Railway, system: Worksite) -> bool:
    """While it counts, no direction told is against that of the train, but of one that has just come (A3)."""
    return all(
        no_train_turns_sooner(site, system.told.trains[train], body)
        for train, body in system.bodies.items()
        if train in system.told.trains
    )


def no_train_of_the_line_is_longer(site: Railway, system: Worksite) -> bool:
    """Trains are as long as written, or shorter (A1)."""
    return all(no_train_is_longer_than_written(site, body) for _train, body in system.bodies.items())


INITIAL = (nothing_was_told,)
SAFETY = (
    the_normal_tone_means_no_train_within_3000_m,
    caution_means_no_train_within_1500_m,
    unknown_is_never_normal,
    a_stale_or_jumping_fix_sounds_the_fault_tone,
    a_fix_that_jumps_near_sounds_the_alarm,
    a_departing_train_never_masks_an_approaching_one,
    a_train_in_a_tunnel_counts_at_its_outer_end,
    in_a_section_not_to_be_used_no_tone_is_normal,
    agreement_is_worth_the_stretch,
    *train_list.SAFETY,
)
INVARIANTS = (
    *SAFETY,
    the_handset_has_what_was_told,
    the_worker_is_within_reach_of_his_fix,
    trains_are_within_reach_of_right_fixes,
    trains_are_no_nearer_by_other_lines_than_right_fixes,
    trains_are_within_reach_of_the_display,
    trains_are_no_nearer_by_other_lines_than_the_display,
    a_train_is_near_the_opening_that_it_came_by,
    a_train_is_no_nearer_by_other_lines_than_its_opening,
    wrong_fixes_are_contradicted,
    told_directions_still_hold,
    no_train_of_the_line_is_longer,
    *train_list.INVARIANTS,
)
PREMISES = (
    assumed.the_alarm_limit_is_within_an_hour,
    assumed.the_error_is_not_negative,
    assumed.speed_and_freshness_are_not_negative,
)
STEPS = (
    world.come,
    world.come_by,
    world.pass_out,
    world.pass_in,
    world.leave,
    world.intend,
    world.pass_time,
    world.renumber,
    world.couple_or_part,
    lists_of_trains.start_server,
    lists_of_trains.enter,
    lists_of_trains.hear_of,
    lists_of_trains.report_left,
    lists_of_trains.strike_off,
    lists_of_trains.withdraw,
    lists_of_trains.confirm_the_list,
    lists_of_trains.hear_confirmation,
    lists_of_trains.send_entry,
    lists_of_trains.send_summary,
    lists_of_trains.hear_entry,
    lists_of_trains.hear_summary,
    lists_of_trains.restart_handset,
    world.take_fix,
    world.take_display,
    world.take_fix_of_another_edition,
    world.take_display_of_another_edition,
    world.take_worker_fix,
    world.look_at_the_battery,
    world.listen,
    world.listen_for_one_that_came,
    world.listen_for_one_with_a_fix,
    world.listen_for_one_without_a_fix,
)

THEORY = Theory(
    "alarm_tone",
    Railway,
    Worksite,
    by_name(STEPS),
    by_name(INITIAL),
    by_name(INVARIANTS),
    by_name(SAFETY),
    by_name(PREMISES),
    quantified=True,
)
