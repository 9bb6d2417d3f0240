"""What trams tell of a way while they are not on it, and what of that still counts when they are (G2, ours)."""

from __future__ import annotations

from kernel.tram.centre import Tram
from kernel.tram.dispatching import Known, Report
from models.tram.dispatching import Traffic, Way, mark


def is_under_way(known: Known) -> bool:
    """Tell whether a tram has told that it left a stop since it was confirmed (G2)."""
    return mark(known.stop, known.left) > mark(known.comes_at, False)


def is_of_this_run(system: Traffic, tram: Tram, made_ms: int) -> bool:
    """Tell whether a tram is known, and was taken up before that."""
    return tram in system.centre.trams and made_ms > system.centre.trams[tram].since_ms


def beside_the_way_no_stop_was_left(site: Way, system: Traffic) -> bool:
    """Nobody has told beside the way that he has left a stop of it (G2)."""
    return all(not report.left for _tram, report in system.told_beside)


def what_was_told_beside_is_older(site: Way, system: Traffic) -> bool:
    """Who is on the way has told beside it no later than on it (G2, ours)."""
    return all(
        tram not in system.centre.trams
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


def was_beyond(place: int, told_ms: int, report: Report) -> bool:
    """Tell whether one that told of a place was beyond the stop of a report before that was made (G2)."""
    return place > mark(report.stop, False) and told_ms < report.made_ms


def is_behind(system: Traffic, behind: Tram, ahead: Tram) -> bool:
    """Tell whether one runs behind another, if both are on the way (G2)."""
    bodies = system.bodies
    return ahead not in bodies or behind not in bodies or bodies[ahead].rank < bodies[behind].rank


def who_told_from_beyond_is_ahead_of_who_told_beside(site: Way, system: Traffic) -> bool:
    """So is who told that of one that told beside the way that it stood at the stop where it then came (G2, ours)."""
    return all(
        not was_beyond(mark(beyond.stop, beyond.left), beyond.made_ms, report)
        or not (is_of_this_run(system, ahead, beyond.made_ms) and is_of_this_run(system, behind, report.made_ms))
        or report.stop < system.centre.trams[behind].comes_at
        or is_behind(system, behind, ahead)
        for ahead, beyond in system.told
        for behind, report in system.told_beside
    )


def who_was_heard_beyond_is_ahead_of_who_told_beside(site: Way, system: Traffic) -> bool:
    """And so is one that was heard from beyond before that (G2, ours)."""
    return all(
        not is_of_this_run(system, behind, report.made_ms)
        or report.stop < system.centre.trams[behind].comes_at
        or not is_under_way(known)
        or not was_beyond(mark(known.stop, known.left), known.told_ms, report)
        or is_behind(system, behind, ahead)
        for ahead, known in system.centre.trams.items()
        for behind, report in system.told_beside
    )
