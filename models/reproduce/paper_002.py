"""Paper 002, trams by GPS: corrections of map matching, transfers, orders under radio trouble, bunching (G1 to G7)."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from kernel.tram.dispatching import DispatchLimits
from kernel.tram.map_matching import Point, Stretch, matched
from models.reproduce.tables import Picture, Reproduction, Row, Sensitivity, share
from models.tram import line, tally
from models.tram.bunching import WATCHED, Days, days
from models.tram.given import LIMITS, UNCONTROLLED
from models.tram.gps import PLAN, REJECTED_MM, Floats, Gps, errors_m
from models.tram.map_matching import stretch_between
from models.tram.radio import BYTES_A_TRANSFER, LINK, TESTS, CentreLink, transfers_s

TITLE = "trams by GPS: map matching, radio, departure hold and recovery"
WITHIN_M, SHARE_WITHIN, PAPER_MEAN_M = 14.0, 0.9, 10.0
MEAN_M = (8.0, 12.0)
"""What we take "about 10 m" to be."""
LINK_S = (4.65, 5.08)
TEST_RIDES, RIDE_S = 12, 600
"""Rides of ten minutes: a test day's, at 1 s a fix."""
SPEED_M_S = 6.0
"""A tram's mean, with stops: the place matters little, corrections are across the track."""
BENDS = 60
STRETCH_MM = 150_000
MOST_TURN_RAD = 0.35
"""The line for map matching: stretches of 150 m, each turned from the one before by up to 20 degrees; ours."""

Progress = Callable[[int, int, str], None]


def reproduce(seed: int, runs: int, progress: Progress) -> Reproduction:
    """Set the paper's figures beside ours; ``runs``: days of a line, with hold and without."""
    progress(0, 4, "fixes")
    fixes = measured(seed, PLAN)
    tests = transferred(seed, LINK)
    progress(1, 4, "days with a centre, and without")
    held, free = days(seed, runs, LIMITS), days(seed, runs, UNCONTROLLED)
    progress(2, 4, "days with faults")
    troubled = days(seed, runs, LIMITS, None)
    progress(3, 4, "sensitivities")
    return Reproduction(
        paper="002",
        title=TITLE,
        seed=seed,
        rows=(*fix_rows(fixes), *link_rows(tests), *order_rows(troubled), *bunching_rows(held, free)),
        sensitivities=(*gps_sensitivities(seed), *link_sensitivities(seed), *hold_sensitivities(seed, runs, held)),
        pictures=(*fix_pictures(fixes), *bunching_pictures(held, free)),
        parameters=parameters(),
        counts={
            "fixes": int(fixes.corrections_m.size),
            "transfers": sum(map(len, tests)),
            "days with hold, without, and with faults": runs,
            "trams' runs with faults": troubled.sum_of("runs"),
            "orders with faults": troubled.sum_of("orders"),
        },
    )


# ---- map matching


@dataclass(frozen=True)
class Fixes:
    """What map matching made of fixes: corrections; what was left along the track and across it; how many refused.

    ``within``, ``beyond``: how many fixes were off by no more than is written, and of how many of these the tram was
    not in the range that was found.  ``widths_m``: how wide ranges were.
    """

    corrections_m: Floats
    along_m: Floats
    across_m: Floats
    refused: int
    within: int
    beyond: int
    widths_m: Floats


def bends(chance: np.random.Generator) -> tuple[Stretch, ...]:
    """Make a line of straight stretches."""
    turns = np.cumsum(chance.uniform(-MOST_TURN_RAD, MOST_TURN_RAD, BENDS))
    x = np.concatenate(([0.0], np.cumsum(STRETCH_MM * np.cos(turns))))
    y = np.concatenate(([0.0], np.cumsum(STRETCH_MM * np.sin(turns))))
    points = [Point(round(float(east)), round(float(north))) for east, north in zip(x, y, strict=True)]
    return tuple(
        stretch_between(points[number], points[number + 1], STRETCH_MM * number, STRETCH_MM * (number + 1), REJECTED_MM)
        for number in range(BENDS)
    )


def measured(seed: int, gps: Gps) -> Fixes:
    """Ride along the line, take a fix each second, and let the kernel put it onto the line (G1, G7)."""
    corrections, along, across, widths, refused, within, beyond = [], [], [], [], 0, 0, 0
    for ride in range(TEST_RIDES):
        chance = np.random.default_rng((seed, ride, 2))
        on = bends(chance)
        errors = errors_m(chance, gps, RIDE_S)
        begins_mm = float(chance.uniform(0.2, 0.4)) * STRETCH_MM * BENDS
        for second in range(RIDE_S):
            at_mm = begins_mm + 1_000 * SPEED_M_S * second
            number = int(at_mm // STRETCH_MM)
            found = matched(near(on, number), off(on[number], at_mm, errors, second))
            if is_within(errors, second):
                within += 1
                beyond += found.within is None or not found.within.from_mm <= at_mm <= found.within.to_mm
            if found.within is not None:
                widths.append((found.within.to_mm - found.within.from_mm) / 1_000)
            if found.nearest is None:
                refused += 1
                continue
            corrections.append(found.nearest.correction_mm2**0.5 / 1_000)
            along.append((found.nearest.kilometrage_mm - at_mm) / 1_000)
            across.append(across_m(on, found.nearest.point))
    figures = (np.array(corrections), np.array(along), np.array(across))
    return Fixes(*figures, refused, within, beyond, np.array(widths))


def is_within(errors: tuple[Floats, Floats], second: int) -> bool:
    """Tell whether a fix is off by no more than is written, along its stretch and across it."""
    return 1_000 * max(abs(float(errors[0][second])), abs(float(errors[1][second]))) <= REJECTED_MM - 1


def near(on: Sequence[Stretch], number: int) -> tuple[Stretch, ...]:
    """The stretches within 300 m, of which one is the nearest to any place that is not refused."""
    return tuple(on[max(0, number - 2) : number + 3])


def off(stretch: Stretch, at_mm: float, errors: tuple[Floats, Floats], second: int) -> Point:
    """Where a fix is: off by so much along the stretch and across it."""
    x, y = stretch.east_mm, stretch.north_mm
    length = float(np.hypot(x, y))
    along = at_mm - stretch.from_mm + 1_000 * float(errors[0][second])
    across = 1_000 * float(errors[1][second])
    return Point(
        round(stretch.start.x_mm + (along * x - across * y) / length),
        round(stretch.start.y_mm + (along * y + across * x) / length),
    )


def across_m(on: Sequence[Stretch], point: Point) -> float:
    """How far a point is from the line."""
    nearest = matched(tuple(on), point).nearest
    return float("inf") if nearest is None else nearest.correction_mm2**0.5 / 1_000


def fix_rows(fixes: Fixes) -> tuple[Row, ...]:
    """Figure 6 and 5.1."""
    within, count = int((fixes.corrections_m <= WITHIN_M).sum()), int(fixes.corrections_m.size)
    mean = float(np.mean(fixes.corrections_m))
    left, along = float(np.max(fixes.across_m)), float(np.percentile(np.abs(fixes.along_m), 90))
    return (
        Row("fixes of 1 s within 14 m of the line", "4.1, figure 6", "90 % and more", share(within, count),
            within >= SHARE_WITHIN * count, "90 % and more"),
        Row("mean correction", "5.1", "about 10 m", f"{mean:.1f} m", MEAN_M[0] <= mean <= MEAN_M[1],
            "8 to 12 m; the offset of the line is calibrated to it"),
        Row("fixes refused: farther than 25 m", "ours", "not given", share(fixes.refused, count + fixes.refused), None,
            "none: ours"),
        Row("what is left across the track, after the kernel", "3.1.1", "on the line", f"{1000 * left:.0f} mm at most",
            left <= 0.002, "2 mm, by rounding"),
        Row("trams outside of the range that is found, of fixes that are off by 25 m at most", "ours", "not given",
            share(fixes.beyond, fixes.within), fixes.beyond == 0 < fixes.within,
            f"none; a range is {float(np.mean(fixes.widths_m)):.0f} m wide in the mean"),
        Row("what is left along the track", "4.1", "not corrected", f"90 % within {along:.1f} m", None,
            "none: map matching cannot see it"),
    )  # fmt: skip


def fix_pictures(fixes: Fixes) -> tuple[Picture, ...]:
    """Figure 6."""
    return (
        Picture(
            "002_corrections",
            f"Corrections of {fixes.corrections_m.size} fixes by map matching (paper's figure 6)",
            "correction, m",
            "fixes",
            bars={"ours": fixes.corrections_m.tolist()},
            edges=[float(edge) for edge in range(27)],
            places={
                "paper: 90 % within 14 m": WITHIN_M,
                "paper: mean about 10 m": PAPER_MEAN_M,
                "ours: 90 % within": float(np.percentile(fixes.corrections_m, 90)),
            },
        ),
    )


def gps_sensitivities(seed: int) -> tuple[Sensitivity, ...]:
    """Mean and share within 14 m with each part of the error changed."""
    made = []
    named = {
        "survey_m": ("offset of the line (calibrated)", f"{PLAN.survey_m} m"),
        "slow_m": ("slow error", f"{PLAN.slow_m} m"),
        "multipath_m": ("multipath", f"{PLAN.multipath_m} m"),
        "reflected": ("share of reflections", f"{100 * PLAN.reflected:.0f} %"),
    }
    base = summed(measured(seed, PLAN))
    for name, (called, value) in named.items():
        less, more = (summed(measured(seed, replace(PLAN, **{name: by * getattr(PLAN, name)}))) for by in (0.8, 1.2))
        made.append(Sensitivity("mean correction, and share within 14 m", called, value, less, base, more))
    return tuple(made)


def summed(fixes: Fixes) -> str:
    """Mean and share within 14 m, as text."""
    within = 100 * float(np.mean(fixes.corrections_m <= WITHIN_M))
    return f"{float(np.mean(fixes.corrections_m)):.1f} m, {within:.1f} %"


# ---- transfers


def transferred(seed: int, link: CentreLink) -> list[Floats]:
    """The transfers of table 2, test by test."""
    return [transfers_s(np.random.default_rng((seed, number, 3)), link, count) for number, count in enumerate(TESTS)]


def link_rows(tests: Sequence[Floats]) -> tuple[Row, ...]:
    """Table 2 and 5.2."""
    count = sum(map(len, tests))
    means = [float(np.mean(each)) for each in tests]
    longest = max(float(np.max(each)) for each in tests)
    return (
        Row("transfers between station and centre", "table 2", "1,735; 263,720 bytes; none lost",
            f"{count:,}; {BYTES_A_TRANSFER * count:,} bytes; none lost", count == 1_735,
            "as many; that none is lost to us is how the link is modelled"),
        Row("mean time of a transfer, by test", "table 2", f"{LINK_S[0]} to {LINK_S[1]} s",
            f"{min(means):.2f} to {max(means):.2f} s", LINK_S[0] - 0.2 <= min(means) <= max(means) <= LINK_S[1] + 0.2,
            "within 0.2 s of the paper's range; calibrated"),
        Row("longest transfer", "5.2", "up to 7 s", f"{longest:.1f} s", longest <= LINK.most_s, "7 s at most"),
    )  # fmt: skip


def link_sensitivities(seed: int) -> tuple[Sensitivity, ...]:
    """The range of means with what is added to the least time changed."""
    texts = []
    for by in (0.8, 1.0, 1.2):
        means = [float(np.mean(each)) for each in transferred(seed, replace(LINK, more_s=by * LINK.more_s))]
        texts.append(f"{min(means):.2f} to {max(means):.2f} s")
    return (Sensitivity("mean time of a transfer", "what is added (calibrated)", f"{LINK.more_s} s", *texts),)


# ---- orders


def order_rows(troubled: Days) -> tuple[Row, ...]:
    """5.1 and 5.3: nothing wrong, whatever goes wrong."""
    wrong = sum(troubled.sum_of(name) for name in tally.CLAIMS)
    turned = troubled.sum_of("order_turned") + troubled.sum_of("wandered")
    orders = troubled.sum_of("orders_to_hold") + troubled.sum_of("orders_to_recover")
    lost = troubled.sum_of("unheard")
    not_given, due = troubled.sum_of("recoveries_not_given"), troubled.sum_of("recoveries_due")
    return (
        Row("wrong orders by the kernel, radio in trouble", "5.3", "none", f"{wrong} of {orders:,}", wrong == 0,
            "none; days with drawn faults"),
        Row("trams that change their order, or run while they stand", "5.1", "none", str(turned), turned == 0, "none"),
        Row("cycles of trams at stops without an answer", "4.2 (3)", "without line of sight: all",
            share(lost, troubled.sum_of("frames")), None, "none: by the faults drawn"),
        Row("recoveries not given, because something was not known", "ours", "not given", share(not_given, due), None,
            "the price of the safe side"),
    )  # fmt: skip


# ---- bunching


def bunching_rows(held: Days, free: Days) -> tuple[Row, ...]:
    """3.2.1: the vicious circle, with the hold and without."""
    with_it, without = held.spread(WATCHED), free.spread(WATCHED)
    each = [held.bunched(WATCHED), free.bunched(WATCHED)]
    waits = [held.waits_s(WATCHED), free.waits_s(WATCHED)]
    rides = [held.rides_s(), free.rides_s()]
    where = f"at stop {WATCHED + 1}"
    return (
        Row(f"spread of intervals {where}: without hold, with", "3.2.1", "hold widens them, no figure",
            f"{without:.2f}, {with_it:.2f}", with_it < without, "less with hold; deviation over mean"),
        Row(f"trams within a minute of another {where}: without, with", "3.2.1", "no figure",
            f"{share(*each[1])}, {share(*each[0])}", each[0][0] * each[1][1] < each[1][0] * each[0][1],
            "less with hold"),
        Row(f"mean wait of a passenger {where}: without, with", "ours", "not given",
            f"{waits[1]:.0f} s, {waits[0]:.0f} s", None, "none: ours"),
        Row(f"mean ride to stop {WATCHED + 1}: without, with", "ours", "not given",
            f"{rides[1] / 60:.1f} min, {rides[0] / 60:.1f} min", None, "the price, with what recovery gains"),
        Row("held, of it without a reason any more", "ours", "not given",
            f"{held.sum_of('held_s') / 60:.0f} min, {held.sum_of('needless_s') / 60:.0f} min", None,
            "the price of the cycle of 7 s, and of departures that are heard late"),
    )  # fmt: skip


def hold_sensitivities(seed: int, runs: int, held: Days) -> tuple[Sensitivity, ...]:
    """The spread with the limits of the hold changed, over a quarter of the days."""
    made, few = [], max(1, runs // 4)
    base = told(Days(held.rows[:few], held.logs[:few], held.stops_mm))
    named: dict[str, tuple[str, Callable[[float], DispatchLimits]]] = {
        "hold: time behind the tram ahead": (
            f"{LIMITS.ahead_hold_ms // 1000} s",
            lambda by: replace(LIMITS, ahead_hold_ms=round(by * LIMITS.ahead_hold_ms)),
        ),
        "hold: longest at a stop": (
            f"{LIMITS.longest_hold_ms // 1000} s",
            lambda by: replace(LIMITS, longest_hold_ms=round(by * LIMITS.longest_hold_ms)),
        ),
        "recovery: time behind the tram ahead": (
            f"{LIMITS.recovery_ms // 1000} s",
            lambda by: replace(LIMITS, recovery_ms=round(by * LIMITS.recovery_ms)),
        ),
    }
    for called, (value, changed) in named.items():
        less, more = (told(days(seed, few, changed(by))) for by in (0.8, 1.2))
        made.append(Sensitivity("spread, and trams within a minute of another", called, value, less, base, more))
    return tuple(made)


def told(some: Days) -> str:
    """The spread and the share that is bunched, as text."""
    part, of = some.bunched(WATCHED)
    return f"{some.spread(WATCHED):.2f}, {100 * part / max(of, 1):.1f} %"


def bunching_pictures(held: Days, free: Days) -> tuple[Picture, ...]:
    """An hour in which trams bunch, without hold and with it; and the spread along the line."""
    stops = range(1, WATCHED + 1)
    day, begins_s = worst_hour(free)
    return (
        time_and_distance("002_hour_without_hold", "without hold", free, day, begins_s),
        time_and_distance("002_hour_with_hold", "with departure hold and recovery", held, day, begins_s),
        Picture(
            "002_spread",
            f"Spread of the intervals between trams along the line, {len(free.logs)} days each",
            "stop",
            "deviation of intervals over their mean",
            lines={
                "without hold": ([float(stop + 1) for stop in stops], [free.spread(stop) for stop in stops]),
                "with hold": ([float(stop + 1) for stop in stops], [held.spread(stop) for stop in stops]),
            },
        ),
        Picture(
            "002_intervals",
            f"Intervals at stop {WATCHED + 1}, without hold and with it",
            "interval, s",
            "departures in 30 s",
            lines={
                "without hold": histogram(free.intervals_s(WATCHED)),
                "with hold": histogram(held.intervals_s(WATCHED)),
            },
            places={"peak timetable": float(line.PEAK_HEADWAY_S), "off-peak timetable": float(line.HEADWAY_S)},
        ),
    )


def histogram(
    intervals_s: Sequence[Floats], each_s: float = 30.0, most_s: float = 900.0
) -> tuple[list[float], list[float]]:
    """Count intervals: the middles of bins, and how many are in each."""
    counted, edges = np.histogram(np.concatenate(intervals_s), bins=np.arange(0.0, most_s + each_s, each_s))
    return (edges[:-1] + each_s / 2).tolist(), counted.astype(np.float64).tolist()


def worst_hour(free: Days) -> tuple[int, int]:
    """The day, and the hour, with most trams within a minute of another without hold."""
    worst, found = -1, (0, line.OPEN_S)
    for day, log in enumerate(free.logs):
        left = np.sort(log[log[:, WATCHED] >= 0, WATCHED])
        close = left[1:][np.diff(left) < 60]
        for begins_s in range(line.OPEN_S, line.CLOSE_S - 3_600, 1_800):
            count = int(((close >= begins_s) & (close < begins_s + 3_600)).sum())
            if count > worst:
                worst, found = count, (day, begins_s)
    return found


def time_and_distance(name: str, what: str, some: Days, day: int, begins_s: int) -> Picture:
    """Draw when trams left stops: one line for all, broken between them."""
    series: dict[str, tuple[list[float], list[float]]] = {"to the end": ([], []), "turns off": ([], [])}
    for log in some.logs[day]:
        left = np.flatnonzero(log >= 0)
        if left.size == 0 or log[left[-1]] < begins_s or log[left[0]] > begins_s + 3_600:
            continue
        x, y = series["turns off" if left[-1] < line.BRANCH else "to the end"]
        x.extend([(float(log[stop]) - begins_s) / 60 for stop in left] + [float("nan")])
        y.extend([float(some.stops_mm[stop]) / 1e6 for stop in left] + [float("nan")])
    hour = f"{begins_s // 3600}:{begins_s % 3600 // 60:02d}"
    return Picture(
        name,
        f"Departures from stops, the hour from {hour} of day {day}, {what}",
        "minutes",
        "kilometres",
        lines={key: values for key, values in series.items() if values[0]},
    )


def parameters() -> dict[str, str]:
    """What decides, and why."""
    return {
        "offset of the line": f"{PLAN.survey_m} m across; calibrated to the mean of 5.1: a mean of 10 m with nine in"
        " ten within 14 m cannot come of errors that scatter about the line",
        "slow error": f"{PLAN.slow_m} m, over {PLAN.slow_s:.0f} s; typical of FM-multiplex DGPS",
        "multipath": f"{PLAN.multipath_m} m, over {PLAN.multipath_s:.0f} s; typical of code receivers in streets",
        "reflections": f"{100 * PLAN.reflected:.0f} % of fixes, {PLAN.reflected_m:.0f} m in the mean; ours",
        "fixes are refused": f"beyond {REJECTED_MM // 1000} m from the line; ours",
        "transfer": f"{LINK.least_s} s and {LINK.more_s} s more in the mean, up to {LINK.busy_s} s more on a busy day;"
        " calibrated to table 2",
        "line": f"{line.STOPS} stops, 300 to 520 m apart, each third tram turns off at stop {line.BRANCH + 1}; ours",
        "timetable": f"each {line.PEAK_HEADWAY_S // 60} min at the peaks, else {line.HEADWAY_S // 60}; practice",
        "passengers": f"{line.BOARDS_A_MINUTE} a minute at a common stop, twice as many at the peaks,"
        f" {line.BOARDS_S} s each; practice",
        "signals": f"one in each section, {line.RED_S} s of {line.SIGNAL_S} red; practice",
        "hold": f"less than {LIMITS.ahead_hold_ms // 1000} s behind the tram ahead, or more than"
        f" {LIMITS.behind_hold_ms // 1000} s before the one behind, {LIMITS.longest_hold_ms // 1000} s at most; ours",
        "recovery": f"{3.6 * line.RECOVERY_MM_S / 1000:.0f} km/h, {LIMITS.recovery_ms // 1000} s behind the tram ahead;"
        " over 40 km/h by 3.2.2, the rest ours",
        "faults": "those of `models/tram/faults.py`, each day by its chance; none in the days that are compared",
    }
