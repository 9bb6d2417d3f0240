"""A train that runs over features, or over something like them, and the machine that looks for one (P2, P3).

Places are in µm; the train may be anywhere and turn in any manner.  History is kept in runs: a straight,
a curve, a straight, each as long as readings say alike, by the feature as registered.  It knows nothing of
the machine: neither its stages nor what it makes of readings.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.onboard import feature as machine
from kernel.onboard.feature import Band, Detection, Feature, Progress, Readings, TurnAxis
from kernel.onboard.odometry import SensorBounds

UM_A_MM = 1_000
NM_A_UM = 1_000
NM_A_MM = 1_000_000
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
    ``from_mm``, ``from_um``: the wheel's way and the true front where it began; ``from_least_mm``: the least place
    of the front by odometry there.  ``way_mm``: the wheel's way now.
    ``before_mm``: the length of the run before; ``first_mm``: of the one before that.
    ``in_band``: every cycle of the last curve was in the band of its part.
    ``met_second``: a cycle of it was in that part; ``met_third``: the newest of it was in that one.
    """

    usable: bool
    straight: bool
    from_mm: int
    from_um: int
    from_least_mm: int
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
    from_least_mm=0,
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


# ---- readings, by the feature as registered


def rate_urad_s(site: Registered, readings: Readings) -> int:
    """Give the angular rate about the axis that the feature turns the train about."""
    return readings.yaw_urad_s if site.feature.axis == TurnAxis.YAW else readings.pitch_urad_s


def is_of_use(site: Registered, readings: Readings) -> bool:
    """Tell whether a cycle shows a curvature: after the begin of detection, rolling, fast enough, all in range.

    Ranges: speeds to 200 m/s, ways to 10⁹ mm, rates to 1000 rad/s.
    """
    valid = readings.yaw_valid if site.feature.axis == TurnAxis.YAW else readings.pitch_valid
    return (
        valid
        and readings.rolling
        and readings.front_least_mm >= site.feature.begin_mm
        and site.feature.speed_least_mm_s <= readings.speed_mm_s <= 200_000
        and 0 <= readings.way_mm <= 1_000_000_000_000
        and -1_000_000_000 <= rate_urad_s(site, readings) <= 1_000_000_000
    )


def curves_within(site: Registered, band: Band, readings: Readings) -> bool:
    """Tell whether the curvature κ = ω / v (paper 001, 2.2.2), in 1/10⁶ m, is in a band."""
    turned = 1_000 * rate_urad_s(site, readings)
    return band.least * readings.speed_mm_s <= turned and turned <= band.most * readings.speed_mm_s


def curves_as_part(site: Registered, since_mm: int, readings: Readings) -> bool:
    """Tell whether the curvature is in the band of the part of the curve, so far from its beginning."""
    feature = site.feature
    if since_mm < feature.second_from_mm:
        return curves_within(site, feature.first, readings)
    return curves_within(site, feature.second if since_mm < feature.third_from_mm else feature.third, readings)


# ---- history


def runs_after(site: Registered, runs: Runs, front_um: int, readings: Readings) -> Runs:
    """Write the history on by one cycle; what is of no use breaks it off, a wheel that turns back begins it anew."""
    if not is_of_use(site, readings):
        return NO_RUNS
    straight = curves_within(site, site.feature.straight, readings)
    goes_on = runs.usable and readings.way_mm >= runs.way_mm
    if goes_on and straight == runs.straight:
        return with_part(site, replace(runs, way_mm=readings.way_mm), readings)
    begun = replace(
        runs,
        usable=True,
        straight=straight,
        from_mm=readings.way_mm,
        from_um=front_um,
        from_least_mm=readings.front_least_mm,
        way_mm=readings.way_mm,
        before_mm=readings.way_mm - runs.from_mm if goes_on else NONE_MM,
        first_mm=runs.before_mm if goes_on else NONE_MM,
        in_band=runs.in_band and goes_on,
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
    since_mm = readings.way_mm - runs.from_mm
    in_third = since_mm >= site.feature.second_from_mm and since_mm >= site.feature.third_from_mm
    return replace(
        runs,
        in_band=runs.in_band and curves_as_part(site, since_mm, readings),
        met_second=runs.met_second or (since_mm >= site.feature.second_from_mm and not in_third),
        met_third=in_third,
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

    Features are surveyed, and chosen such that nothing else from their begin to their end looks like them,
    whichever way the train may go there.  Of what comes where the odometry shows the train beyond the end
    nothing is said.
    """
    off_um, error_um = runs.from_um - UM_A_MM * site.feature.end_mm, UM_A_MM * site.feature.end_error_mm
    beyond = runs.from_least_mm > site.feature.end_mm + site.feature.end_error_mm
    return not all_stages_match(site, runs) or beyond or -error_um <= off_um <= error_um


def a_rolling_wheel_counts_the_way(site: Registered, system: Looking, front_um: int, runs: Runs) -> bool:
    """Over an exit straight, the wheel's way is the train's within creep and diameter error, and one pulse (P1).

    The error is that of the greatest length of the exit straight; slips are told by odometry.
    """
    since_mm = runs.way_mm - runs.from_mm
    off_um = front_um - runs.from_um - UM_A_MM * since_mm
    error_nm = site.feature.exit_most_mm * site.bounds.scale_ppm + NM_A_MM * site.bounds.pulse_mm
    return not runs.usable or since_mm > site.feature.exit_most_mm or -error_nm <= NM_A_UM * off_um <= error_nm


# ---- what happens


def run_a_cycle(site: Registered, system: Looking, front_um: int, readings: Readings) -> Looking:
    """A cycle passes; the front is anywhere then, and readings are any that the assumptions allow (P2, P3)."""
    runs = runs_after(site, system.runs, front_um, readings)
    if not what_matches_in_every_stage_is_the_feature(site, system, runs):
        return system
    if not a_rolling_wheel_counts_the_way(site, system, front_um, runs):
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
