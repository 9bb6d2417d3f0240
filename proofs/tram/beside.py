"""What trams tell of a way while they are not on it, and what of that still counts when they are (G2, ours)."""

from __future__ import annotations

from kernel.tram.centre import Tram
from kernel.tram.dispatching import Known, Report
from models.tram.dispatching import Traffic, Way, mark, place


def is_under_way(known: Known) -> bool:
    """Tell whether a tram has told that it left a stop since it was confirmed (G2)."""
    return mark(known.stop, known.left) > mark(known.comes_at, False)


def is_of_this_run(system: Traffic, tram: Tram, made_ms: int) -> bool:
    """Tell whether a tram is known, and was taken up before that."""
    return tram in system.centre.trams and made_ms > system.centre.trams[tram].since_ms


def who_has_turned_off_is_off_the_way(site: Way, system: Traffic) -> bool:
    """Who goes on to tell of a run that has ended is not on the way, nor about to come (G2)."""
    return all(tram not in system.bodies and tram not in system.runs for tram in system.gone_at)


def what_is_not_known_is_beyond_where_such_a_tram_turned_off(site: Way, system: Traffic) -> bool:
    """Where one that came at the first stop has turned off, trams that the centre does not know are farther on (G5)."""
    return all(
        tram not in system.centre.trams
        or system.centre.trams[tram].comes_at != 0
        or other in system.centre.trams
        or place(stranger) >= at
        for tram, at in system.gone_at.items()
        for other, stranger in system.bodies.items()
    )


# ---- what is told of a run before


def has_begun(known: Known) -> bool:
    """Tell whether anything that a tram has told since it was confirmed has come to the centre."""
    return known.told_ms > known.since_ms


def of_who_is_not_set_nothing_was_heard(site: Way, system: Traffic) -> bool:
    """As long as a unit may tell of a run before nothing of it was taken since its tram was confirmed (G2, ours)."""
    return all(tram not in system.centre.trams or not has_begun(system.centre.trams[tram]) for tram in system.unset)


def tells_that_it_is_set(system: Traffic, tram: Tram, report: Report) -> bool:
    """Tell whether a report, made since its tram was confirmed, is of a stop that was not left (G2, ours)."""
    return not report.left and is_of_this_run(system, tram, report.made_ms)


def who_is_not_set_has_told_on_the_way_of_no_stop(site: Way, system: Traffic) -> bool:
    """Nor has it told since then that it was at a stop which it had not left (G2, ours)."""
    return all(
        tram not in system.unset or not tells_that_it_is_set(system, tram, report) for tram, report in system.told
    )


def who_is_not_set_has_told_beside_it_of_no_stop(site: Way, system: Traffic) -> bool:
    """Neither on the way nor beside it (G2, ours)."""
    return all(
        tram not in system.unset or not tells_that_it_is_set(system, tram, report)
        for tram, report in system.told_beside
    )


def is_in_order(system: Traffic, tram: Tram, before: Report, report: Report) -> bool:
    """Tell whether a tram told of the run before no later than in a report by which it is set (G2, ours)."""
    return (
        not before.left
        or not is_of_this_run(system, tram, before.made_ms)
        or not tells_that_it_is_set(system, tram, report)
        or before.made_ms <= report.made_ms
    )


def of_the_run_before_it_told_before_it_began(site: Way, system: Traffic) -> bool:
    """What a unit told of the run before it told no later than that it was at a stop of this one (G2, ours)."""
    return all(
        is_in_order(system, tram, before, report)
        for tram, report in system.told
        for other, before in system.told_beside
        if other == tram
    )


def of_the_run_before_it_told_before_it_began_beside_the_way(site: Way, system: Traffic) -> bool:
    """And so if it told that beside the way (G2, ours)."""
    return all(
        is_in_order(system, tram, before, report)
        for tram, report in system.told_beside
        for other, before in system.told_beside
        if other == tram
    )


def what_was_told_of_the_run_before_counts_no_more(site: Way, system: Traffic) -> bool:
    """Once anything was taken it is newer than all that the unit has told of the run before (G2, ours)."""
    return all(
        not before.left
        or not is_of_this_run(system, tram, before.made_ms)
        or not has_begun(system.centre.trams[tram])
        or before.made_ms <= system.centre.trams[tram].told_ms
        for tram, before in system.told_beside
    )


def who_is_under_way_has_begun(site: Way, system: Traffic) -> bool:
    """That a stop was left is taken of no tram of which nothing else was (G2, ours)."""
    return all(not is_under_way(known) or has_begun(known) for _tram, known in system.centre.trams.items())


# ---- what is told beside the way


def what_was_told_beside_is_older(site: Way, system: Traffic) -> bool:
    """Who is on the way has told beside it that it is at a stop no later than on it anything (G2, ours)."""
    return all(
        beside.left
        or tram not in system.centre.trams
        or tram not in system.bodies
        or report.made_ms <= system.centre.trams[tram].since_ms
        or beside.made_ms <= report.made_ms
        for tram, report in system.told
        for other, beside in system.told_beside
        if other == tram
    )


def what_was_told_beside_is_older_than_what_counts(site: Way, system: Traffic) -> bool:
    """Of who is on the way, and under way, nothing counts any more that was told beside it (G2, ours)."""
    return all(
        tram not in system.centre.trams
        or tram not in system.bodies
        or not is_under_way(system.centre.trams[tram])
        or beside.made_ms <= system.centre.trams[tram].told_ms
        for tram, beside in system.told_beside
    )


def was_beyond(stop: int, told_ms: int, report: Report) -> bool:
    """Tell whether one had told of a stop beyond that of a report before that was made (G2)."""
    return stop > report.stop and told_ms < report.made_ms


def is_behind(system: Traffic, behind: Tram, ahead: Tram) -> bool:
    """Tell whether one runs behind another, if both are on the way (G2)."""
    bodies = system.bodies
    return ahead not in bodies or behind not in bodies or bodies[ahead].rank < bodies[behind].rank


def who_told_from_beyond_is_ahead_of_who_told_beside(site: Way, system: Traffic) -> bool:
    """So is who told that of one that told beside the way that it stood at the stop where it then came (G2, ours)."""
    return all(
        report.left
        or not was_beyond(beyond.stop, beyond.made_ms, report)
        or not (is_of_this_run(system, ahead, beyond.made_ms) and is_of_this_run(system, behind, report.made_ms))
        or report.stop < system.centre.trams[behind].comes_at
        or is_behind(system, behind, ahead)
        for ahead, beyond in system.told
        for behind, report in system.told_beside
    )


def who_was_heard_beyond_is_ahead_of_who_told_beside(site: Way, system: Traffic) -> bool:
    """And so is one that was heard from beyond before that (G2, ours)."""
    return all(
        report.left
        or not is_of_this_run(system, behind, report.made_ms)
        or report.stop < system.centre.trams[behind].comes_at
        or not is_under_way(known)
        or not was_beyond(known.stop, known.told_ms, report)
        or is_behind(system, behind, ahead)
        for ahead, known in system.centre.trams.items()
        for behind, report in system.told_beside
    )
