"""A train that runs over features, or over something like them, and the machine that looks for one (P2, P3).

Places are in µm; the train may be anywhere and turn in any manner.  History is kept in runs: a straight,
a curve, a straight, each as long as usable readings say alike; it knows nothing of the machine's stages.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.onboard import feature as machine
from kernel.onboard.arithmetic import magnitude
from kernel.onboard.feature import Detection, Feature, Progress, Readings
from kernel.onboard.odometry import SensorBounds, way_error_mm

UM_A_MM = 1_000
NONE_MM = -1
"""The length of a run that was not seen."""


@dataclass(frozen=True)
class Registered:
    """What does not change: the feature as registered, and the bounds on the wheel (P3)."""

    bounds: SensorBounds
    feature: Feature


@dataclass(frozen=True)
class Runs:
    """What the readings have shown, without a break, up to this cycle.

    ``usable``: the newest could be used.  ``straight``: the present run is one, else it is a curve.
    ``from_mm``, ``from_um``: the wheel's way and the true front where it began.  ``way_mm``: the wheel's way now.
    ``before_mm``: the length of the run before; ``first_mm``: of the one before that.
    ``in_band``: every cycle of the last curve was in the band of its part.
    ``met_second``: a cycle of it was in that part; ``met_third``: the newest of it was in that one.
    """

    usable: bool
    straight: bool
    from_mm: int
    from_um: int
    way_mm: int
    before_mm: int
    first_mm: int
    in_band: bool
    met_second: bool
    met_third: bool


@dataclass(frozen=True)
class Order:
    """In which cycle the machine was last in each stage."""

    entry: int
    first: int
    second: int
    third: int
    leaving: int


@dataclass(frozen=True)
class Looking:
    """One moment of a train that awaits a feature.

    ``front_um``: where its front is.  ``state``: what the machine knows.
    ``runs``, ``order``, ``cycle``: history.  ``fixes``: how many were given since it is awaited.
    """

    front_um: int
    state: Detection
    runs: Runs
    order: Order
    cycle: int
    fixes: int


NO_RUNS = Runs(
    usable=False,
    straight=False,
    from_mm=0,
    from_um=0,
    way_mm=0,
    before_mm=NONE_MM,
    first_mm=NONE_MM,
    in_band=False,
    met_second=False,
    met_third=False,
)


# ---- premises


def parts_follow_one_another(site: Registered) -> bool:
    """The second part begins after the first has (P3)."""
    return site.feature.second_from_mm > 0


# ---- history


def runs_after(site: Registered, runs: Runs, front_um: int, readings: Readings) -> Runs:
    """Write the history on by one cycle; what cannot be used breaks it off."""
    if not machine.is_usable(site.feature, readings):
        return NO_RUNS
    straight = machine.is_straight(site.feature, readings)
    if runs.usable and straight == runs.straight:
        return with_part(site, replace(runs, way_mm=readings.way_mm), readings)
    begun = replace(
        runs,
        usable=True,
        straight=straight,
        from_mm=readings.way_mm,
        from_um=front_um,
        way_mm=readings.way_mm,
        before_mm=readings.way_mm - runs.from_mm if runs.usable else NONE_MM,
        first_mm=runs.before_mm,
    )
    if straight:
        return begun
    return with_part(site, replace(begun, in_band=True, met_second=False), readings)


def with_part(site: Registered, runs: Runs, readings: Readings) -> Runs:
    """Note in which part of a curve this cycle is, and whether its curvature is in that part's band.

    Its first cycle is in the first part; and since ways only grow, it stays in the third.
    """
    if runs.straight:
        return runs
    part = machine.part_at(site.feature, readings.way_mm - runs.from_mm)
    return replace(
        runs,
        in_band=runs.in_band and machine.matches(site.feature, part, readings),
        met_second=runs.met_second or part == Progress.SECOND_PART,
        met_third=part == Progress.THIRD_PART,
    )


def curve_matches(site: Registered, runs: Runs) -> bool:
    """Tell whether the last curve was in band in every cycle, and met in each of its parts."""
    return runs.in_band and runs.met_second and runs.met_third


def all_stages_match(site: Registered, runs: Runs) -> bool:
    """Tell whether straight, curve and straight match the feature, the last of them up to now.

    Where history was broken off, no curve is in band.
    """
    return (
        runs.straight
        and runs.first_mm >= site.feature.entry_least_mm
        and curve_matches(site, runs)
        and site.feature.length_least_mm <= runs.before_mm <= site.feature.length_most_mm
        and runs.way_mm - runs.from_mm >= site.feature.exit_least_mm
    )


# ---- assumptions


def what_matches_in_every_stage_is_the_feature(site: Registered, system: Looking, runs: Runs) -> bool:
    """Where every stage matched, the curve's end was found within its error of the registered place (P3).

    Features are surveyed, and chosen such that nothing else after their begin looks like them, whichever
    way the train may go there.
    """
    return not all_stages_match(site, runs) or (
        magnitude(runs.from_um - UM_A_MM * site.feature.end_mm) <= UM_A_MM * site.feature.end_error_mm
    )


def a_rolling_wheel_counts_the_way(site: Registered, system: Looking, front_um: int, runs: Runs) -> bool:
    """Over an exit straight, the wheel's way is the train's within the odometer's error of its greatest length (P1).

    The error grows with the way, and slips are told by odometry.
    """
    since_mm = runs.way_mm - runs.from_mm
    off_um = front_um - runs.from_um - UM_A_MM * since_mm
    return (
        not runs.usable
        or since_mm > site.feature.exit_most_mm
        or magnitude(off_um) <= UM_A_MM * way_error_mm(site.bounds, site.feature.exit_most_mm)
    )


def a_rolling_wheels_way_only_grows(site: Registered, system: Looking, readings: Readings) -> bool:
    """Odometry does not trust a wheel whose way has gone back: it is not rolling then (P1)."""
    return not system.runs.usable or not readings.rolling or readings.way_mm >= system.runs.way_mm


# ---- what happens


def run_a_cycle(site: Registered, system: Looking, front_um: int, readings: Readings) -> Looking:
    """A cycle passes; the front is anywhere then, and readings are any that the assumptions allow (P2, P3)."""
    runs = runs_after(site, system.runs, front_um, readings)
    if not what_matches_in_every_stage_is_the_feature(site, system, runs):
        return system
    if not a_rolling_wheel_counts_the_way(site, system, front_um, runs):
        return system
    if not a_rolling_wheels_way_only_grows(site, system, readings):
        return system
    state = machine.note_cycle(site.bounds, site.feature, system.state, readings)
    cycle = system.cycle + 1
    return Looking(
        front_um=front_um,
        state=state,
        runs=runs,
        order=Order(
            entry=cycle if state.stage == Progress.ENTRY_STRAIGHT else system.order.entry,
            first=cycle if state.stage == Progress.FIRST_PART else system.order.first,
            second=cycle if state.stage == Progress.SECOND_PART else system.order.second,
            third=cycle if state.stage == Progress.THIRD_PART else system.order.third,
            leaving=cycle if state.stage == Progress.EXIT_STRAIGHT else system.order.leaving,
        ),
        cycle=cycle,
        fixes=system.fixes + 1 if machine.has_fix(state) else system.fixes,
    )


def await_feature(site: Registered, system: Looking) -> Looking:
    """The unit awaits the feature, anew or for the first time; at any moment (P3)."""
    return replace(system, state=machine.AWAITED, fixes=0)
