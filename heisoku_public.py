"""What other programs call, by ``from heisoku import load, check, prove, simulate``; the examples run as tests.

Each gives back what the command of its name prints, as data.  Nothing is written anywhere, and nothing ends the
program: what cannot be used raises :class:`BadInput`, or ``ValueError`` where an argument is meant.
"""

from __future__ import annotations

from collections.abc import Mapping
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from models.layouts.results import BadInput

if TYPE_CHECKING:
    from models.layouts.results import CheckResult, Imported
    from models.simulation.faults import Setting
    from models.simulation.outcome import Outcome
    from proofs.records import Report

__all__ = ["BadInput", "check", "load", "prove", "simulate"]


def load(path: str | PathLike[str]) -> Imported:
    """Read a layout file of any format; its track, its routes, and what was noticed on the way.

    >>> station = load("layouts/passing_station.toml")
    >>> station.kind, len(station.layout.blocks), station.longest_route
    ('native', 10, 'E to 2')

    Raises:
        BadInput: it cannot be read as a layout; one line names file and place.
    """
    from models.layouts import load as read

    return read(Path(path))


def check(layout: Imported, *, clearance_mm: int | None = None, strict: bool = False) -> CheckResult:
    """Check a layout against what the proof assumes of it.

    >>> found = check(load("layouts/passing_station.toml"))
    >>> found.verdict, found.violations
    ('holds', ())

    Args:
        layout: As it was read.
        clearance_mm: A boundary nearer to a point is foul, where the file does not say; as the command takes it
            if it is left out.
        strict: Nothing may rest on what the file does not say.

    Raises:
        ValueError: a clearance that is no whole number of millimetres, or less than none.
    """
    from models.layouts import check as checked
    from models.layouts.measures import CLEARANCE_MM

    least_mm = CLEARANCE_MM if clearance_mm is None else clearance_mm
    if type(least_mm) is not int or least_mm < 0:
        raise ValueError(f"clearance_mm={clearance_mm!r}: whole millimetres, none or more")
    return checked(layout, clearance_mm=least_mm, strict=strict)


def prove(
    only: str | None = None, *, solver: Literal["z3", "cvc5", "both"] = "z3", seeds: int = 1, jobs: int = 1
) -> Report:
    """Prove that every transition keeps every invariant, on every layout.

    >>> report = prove("^split.init split_is_latched$")
    >>> report.verdict, [(each["solver"], each["verdict"]) for each in report.obligations]
    ('proved', [('z3', 'proved')])

    Args:
        only: Only obligations, as "row column", that match this pattern; all of them take minutes.
        solver: Which one is asked, or both.
        seeds: So often each question is asked, with another seed each time.
        jobs: Processes to use.  With more than one, the program that calls is read again by each of them, so
            what it does stands under ``if __name__ == "__main__":``.

    Raises:
        ValueError: that is no pattern, or nothing matches it.
    """
    import re

    from proofs.run import prove_all

    try:
        re.compile(only or "")
    except re.error as error:
        raise ValueError(f"only={only!r}: not a pattern ({error})") from error
    if solver not in ("z3", "cvc5", "both") or seeds < 1 or jobs < 1:
        raise ValueError(f"solver={solver!r}, seeds={seeds}, jobs={jobs}: z3, cvc5 or both, and 1 or more of each")
    report = prove_all(solver=solver, jobs=jobs, seeds=seeds, only=only)
    if not report.obligations:
        raise ValueError(f"only={only!r}: no transition and no invariant is named so")
    return report


def simulate(
    layout: Imported,
    *,
    trains: int | None = None,
    cars: int = 3,
    hours: float = 1.0,
    trips: int | None = None,
    seed: int = 1,
    faults: Mapping[str, Setting] | None = None,
) -> Outcome:
    """Run trains on a layout in simulated time, with faults, and judge them second by second.

    >>> found = simulate(load("layouts/passing_station.toml"), trains=1, hours=0.02)
    >>> found.holds, found.broken, found.sim.now_s
    (True, (), 72)

    Args:
        layout: As it was read; its file has to tell of its track.
        trains: How many; half of what has room if that is left out, eight at most.
        cars: How many cars of 20 m each of them has.
        hours: Simulated, at most.
        trips: So many a train, as a timetable that must come to its end; without it random trips.
        seed: What everything is drawn from: a seed gives the same outcome.
        faults: Which come, and how often; every one if that is left out.

    Raises:
        BadInput: there is no track, or no room for so many trains.
        ValueError: a number that is none or less, or a fault of another name.
    """
    from fuzz.simulation.judging import judged
    from models.simulation.beginning import Plan, usual_trains
    from models.simulation.bounds import LEAST_HOURS, MOST_HOURS
    from models.simulation.faults import EVERY_FAULT

    if min(cars - 1, 1 if trains is None else trains, 1 if trips is None else trips) <= 0:
        raise ValueError(f"trains={trains}, cars={cars}, trips={trips}: more than none, and two cars")
    if not LEAST_HOURS <= hours <= MOST_HOURS:
        raise ValueError(f"hours={hours}: {LEAST_HOURS} to {MOST_HOURS}")
    unknown = sorted(set(faults or ()) - set(EVERY_FAULT))
    if unknown:
        raise ValueError(f"faults: there is no {', '.join(map(repr, unknown))}; these are: {', '.join(EVERY_FAULT)}")
    many = usual_trains(layout, cars) if trains is None else trains
    return judged(Plan(layout, seed, many, hours, EVERY_FAULT if faults is None else faults, trips, cars=cars))
