"""Paper 004: where caution and alarm begin and end, and what the three special treatments are for (A3 to A6).

The paper gives no measurements: its figures are the distances of section 3.3, and what section 4 says of tunnels,
shunting and stabled trains.  Ours are those of the kernel's own tone over days of traffic (``models/alarm``).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from kernel.alarm.sections import Reason
from kernel.alarm.tone import Register, Tone
from models.alarm.columns import COLUMNS, NUMBER
from models.alarm.days import SYSTEM, one_day
from models.alarm.draws import HOURS, SECONDS, drawn
from models.alarm.line import BOUNDS, LENGTH_MM, PARAMETERS, REGISTER, REGULAR, TRAINS, TUNNELS_MM, ZONE_MM
from models.alarm.watch import ALARM_TONE, NOTHING, REGISTERED, trace, watch
from models.compiled import packed
from models.reproduce.tables import Picture, Reproduction, Row, Sensitivity, share

TITLE = "train approach alarm by GPS"
ALARM, FAULT, CAUTION, NORMAL = (packed(each) for each in (Tone.ALARM, Tone.FAULT, Tone.CAUTION, Tone.NORMAL))
OPEN_M = 6_500.0
"""A worker 4.7 km from every section."""
BEYOND_M = TUNNELS_MM[0][1] / 1_000 + ZONE_MM / 1_000 + 1_000.0
"""A worker 1 km beyond the outer end of the long tunnel's section."""
ENTRY_M = TUNNELS_MM[0][0] / 1_000 - ZONE_MM / 1_000
"""Where zone A begins for trains towards him."""
ALONE_M = 4_000.0
"""A passing counts where no other train was so near meanwhile, and the worker heard none but this one."""
OFF_M = (BOUNDS.length_mm + BOUNDS.train_error_mm + BOUNDS.worker_error_mm) / 1_000
LATE_S = 6
"""A report is no older on a day without faults: 2 s of sending, 3 s of network, and the second of the tone."""
MOST_M = OFF_M + (LATE_S + 1) * BOUNDS.train_mm_s / 1_000
"""So much earlier a tone may begin: the deductions, and the way in the seconds before; both receivers err the other way
by as much again as is deducted for them."""
ERRORS_M = (BOUNDS.train_error_mm + BOUNDS.worker_error_mm) / 1_000
MILDER = "a tone milder than the truth, or an assumption broken, on days with faults"
TREATMENTS = {"tunnels": Reason.WITHOUT_GPS, "shunting": Reason.SHUNTING, "stabled trains": Reason.STABLING}


@dataclass(frozen=True)
class Watched:
    """A day: its row, the tone at each second, and every train's place in m, NaN while it is not on the line.

    ``behind_m``: how far each train reaches behind its antenna.
    """

    worker_m: float
    behind_m: Any
    row: Any
    tones: Any
    places: Any


@dataclass(frozen=True)
class Passing:
    """One train that passed a worker alone; ways in m, NaN where nothing of it was heard.

    ``caution_m``, ``alarm_m``: its antenna's distance when they began.  ``end_m``: that of its rear when they ended.
    ``again_s``: seconds of alarm after that, until it was 6 km away.
    """

    down: bool
    caution_m: float
    alarm_m: float
    end_m: float
    again_s: int


def watched(seed: int, day: int, worker_m: float, register: Register = REGISTER) -> Watched:
    """Let a day without faults pass."""
    kept, row = trace(places=True), np.zeros(len(COLUMNS), int)
    began = drawn(seed, day, worker_m=worker_m, sound=True)
    watch(began, REGISTERED, packed(register), ALARM_TONE, NOTHING, row, kept)
    behind_m = np.where(began.heading > 0, began.below_m, began.above_m)
    return Watched(worker_m, behind_m, row, kept.seconds[:, 0], kept.places)


def passings(day: Watched) -> Iterator[Passing]:
    """Give every train that passed the worker alone."""
    apart_m = np.abs(day.places - day.worker_m)
    for train in range(REGULAR):
        near = np.flatnonzero(apart_m[:, train] <= 6_000.0)
        if near.size == 0 or near[-1] - near[0] > 3_600:
            continue
        window = slice(max(0, near[0] - 60), near[-1] + 1)
        others = np.delete(apart_m[window], train, axis=1)
        if (others <= ALONE_M).any() or (day.tones[window] == FAULT).any():
            continue
        yield passing(day.tones[window], day.places[window, train] - day.worker_m, day.behind_m[train])


def passing(tones: Any, ahead_m: Any, behind_m: float) -> Passing:
    """Measure one of them."""
    down = bool(ahead_m[-1] > ahead_m[0])
    to_m = ahead_m if down else -ahead_m
    passed = int(np.argmax(to_m > 0))
    before, after = tones[:passed], tones[passed:]
    warned, alarmed = np.isin(before, (CAUTION, ALARM)), before == ALARM
    ended = int(np.argmax(after == NORMAL)) if (after == NORMAL).any() else -1
    return Passing(
        down,
        caution_m=float(-to_m[np.argmax(warned)]) if warned.any() else float("nan"),
        alarm_m=float(-to_m[np.argmax(alarmed)]) if alarmed.any() else float("nan"),
        end_m=float(to_m[passed + ended]) - behind_m if ended >= 0 else float("nan"),
        again_s=int((after[ended:] == ALARM).sum()) if ended >= 0 else -1,
    )


def reproduce(seed: int, runs: int, progress: Callable[[int, int, str], None]) -> Reproduction:
    """Reproduce the paper over ``runs`` days of each kind."""
    kinds: list[list[Watched]] = []
    for number, (what, worker_m) in enumerate((("open line", OPEN_M), ("beyond a tunnel", BEYOND_M))):
        days = []
        for day in range(runs):
            days.append(watched(seed, day, worker_m))
            progress(number * runs + day + 1, 4 * runs, what)
        kinds.append(days)
    treated: dict[str, Any] = {}
    less = max(1, runs // 4)
    for number, (what, register) in enumerate(registers().items()):
        treated[what] = sum(watched(seed, day, OPEN_M, register).row for day in range(less))
        progress(2 * runs + runs * (number + 1) // 5, 4 * runs, "treatments")
    faulty = []
    for day in range(runs):
        faulty.append(one_day(seed, day))
        progress(3 * runs + day + 1, 4 * runs, "days with faults")
    there = [each for day in kinds[0] for each in passings(day)]
    beyond = [each for day in kinds[1] for each in passings(day)]
    rows = (*on_the_open_line(there), *beside_a_tunnel(beyond), *treatments(treated, less), *whole_days(faulty))
    return Reproduction(
        "004", TITLE, seed, rows, sensitivities(seed, max(1, runs // 4)), (an_hour(kinds), a_day(faulty_day(seed)),
        beginnings(there)), parameters(), {"days of each kind": runs, "passings": len(there) + len(beyond)},
    )  # fmt: skip


def registers() -> dict[str, Register]:
    """The line's register, without one treatment, and without any."""
    found = {"all three": REGISTER}
    for what, reason in TREATMENTS.items():
        rest = {name: each for name, each in REGISTER.sections.items() if each.reason != reason}
        found[f"without that for {what}"] = replace(REGISTER, sections=rest)
    return {**found, "none": replace(REGISTER, sections={}, stabled=frozenset())}


# ---- rows


def spread(ways_m: Sequence[float]) -> str:
    """Least, mean and most."""
    known = [way for way in ways_m if not np.isnan(way)]
    if not known:
        return "never"
    return f"{min(known):.0f} to {max(known):.0f} m, mean {np.mean(known):.0f} m, {len(known)} trains"


def begins(what: str, paper_m: float, ways_m: Sequence[float]) -> Row:
    """Caution or alarm begins."""
    known = np.array([way for way in ways_m if not np.isnan(way)])
    agrees = bool(known.size and (known >= paper_m).all() and (known <= paper_m + MOST_M + ERRORS_M).all())
    return Row(what, "3.3", f"{paper_m:.0f} m", spread(ways_m), agrees,
               f"never later; earlier by no more than {MOST_M + ERRORS_M:.0f} m of deductions and errors")  # fmt: skip


def on_the_open_line(found: Sequence[Passing]) -> tuple[Row, ...]:
    """The three distances, and how much of it is age times speed."""
    cautions, alarms, ends = ([getattr(each, name) for each in found] for name in ("caution_m", "alarm_m", "end_m"))
    known = np.array([end for end in ends if not np.isnan(end)])
    earlier = np.nanmean(cautions) - 3_000 if cautions else float("nan")
    return (
        begins("caution begins at", 3_000, cautions),
        begins("alarm begins at", 1_500, alarms),
        Row("alarm ends past", "3.3", "100 m", spread(ends),
            bool(known.size and (known >= 100).all() and (known <= 100 + MOST_M + ERRORS_M).all()),
            f"never sooner, by the rear; later by no more than {MOST_M + ERRORS_M:.0f} m of deductions and errors"),
        Row("caution earlier than the paper's", "-", "0 m (from fix to fix)",
            f"{earlier:.0f} m: {OFF_M:.0f} m length and errors, {earlier - OFF_M:.0f} m age × greatest speed, less what"
            " the train ran in that time", None, "none: the deductions are ours (A1)"),
    )  # fmt: skip


def beside_a_tunnel(found: Sequence[Passing]) -> tuple[Row, ...]:
    """The alarm of a train that comes through, and of one that has passed into the tunnel."""
    through_m = BEYOND_M - ENTRY_M
    down = [each.alarm_m for each in found if each.down]
    known = np.array([way for way in down if not np.isnan(way)])
    agrees = bool(known.size and (np.abs(known - through_m) <= LATE_S * BOUNDS.train_mm_s / 1_000).all())
    again = [each.again_s for each in found if not each.down and each.again_s >= 0]
    mean_s = f"{np.mean(again):.0f} s a train, {len(again)} trains" if again else "no train"
    return (
        Row("alarm of a train that comes through a tunnel, 1 km beyond it", "4.1",
            f"from zone A on: {through_m:.0f} m", spread(down), agrees, f"within {LATE_S} s of entering zone A"),
        Row("alarm again after a train has passed into the tunnel", "4.1", "0 s (put at the other end)", mean_s, None,
            "none: ours counts from its last fix, and by the display, since it may stop and turn in there"),
    )  # fmt: skip


def treatments(found: dict[str, Any], days: int) -> tuple[Row, ...]:
    """What the handset sounds with and without the special treatments, 4.7 km from all of it."""
    hours = days * HOURS

    def of(what: str) -> tuple[float, float]:
        return found[what][NUMBER["fault_tones"]] / hours, found[what][NUMBER["fault_s"]] / found[what][
            NUMBER["seconds"]
        ]

    rows = []
    tones, part = of("all three")
    rows.append(Row("fault tone, all three treatments", "4", "no fault of these", f"{tones:.2f} an hour, {part:.2%}",
                    bool(part < 0.001), "less than 0.1 % of the time on days without faults"))  # fmt: skip
    for what in (*(f"without that for {what}" for what in TREATMENTS), "none"):
        tones, part = of(what)
        rows.append(Row(f"fault tone, {what}", "4", "a fault each time", f"{tones:.2f} an hour, {part:.1%}",
                        bool(part > 0.01), "more than 1 % of the time"))  # fmt: skip
    return tuple(rows)


def whole_days(rows: Sequence[Any]) -> tuple[Row, ...]:
    """Days with faults, the worker anywhere."""
    total = np.array(rows).sum(axis=0)
    hours, of = total[NUMBER["seconds"]] / 3_600, {name: int(total[number]) for name, number in NUMBER.items()}
    broken = sum(of[name] for name in (*SYSTEM.claims, *SYSTEM.assumptions))
    no_use = sum(each.to_mm - each.from_mm for _name, each in REGISTER.sections.items()) / LENGTH_MM
    usable = of["seconds"] - of["fault_s"]
    return (
        Row(MILDER, "3.3", "none", f"{broken} in {hours:.0f} h", broken == 0,
            "none: normal means no train within 3000 m, caution none within 1500 m"),
        Row("fault tones, days with faults", "-", "-", f"{of['fault_tones'] / hours:.2f} an hour", None, "none"),
        Row("time without fault tone, days with faults", "-", "-", share(usable, of["seconds"]), None, "none"),
        Row("alarm with no train within 1500 m", "-", "-", share(of["needless_alarm_s"], of["alarm_s"]), None, "none"),
        Row("line not to be used", "4", "sections", f"{no_use:.1%} of {LENGTH_MM // 10**6} km", None, "none"),
        Row("time in sections not to be used", "4", "-", share(of["no_use_s"], of["seconds"]), None, "none"),
    )  # fmt: skip


# ---- what decides


def sensitivities(seed: int, days: int) -> tuple[Sensitivity, ...]:
    """The same days with one parameter of the register changed."""

    def cautions(**change: int) -> str:
        register = replace(REGISTER, bounds=replace(BOUNDS, **change))
        found = [each.caution_m for day in range(days) for each in passings(watched(seed, day, OPEN_M, register))]
        return f"{np.nanmean(found):.0f} m" if found else "never"

    def faults(**change: int) -> str:
        register = packed(replace(REGISTER, fresh=replace(REGISTER.fresh, **change)))
        total = np.array([one_day(seed, day, register=register) for day in range(days)]).sum(axis=0)
        return f"{total[NUMBER['fault_tones']] / days / HOURS:.2f} an hour"

    made = []
    for result, of, owner, names in (
        ("caution begins at", cautions, BOUNDS, ("train_mm_s", "length_mm", "train_error_mm", "worker_error_mm")),
        ("fault tones, days with faults", faults, REGISTER.fresh, ("fix_ms", "display_ms", "server_ms")),
    ):
        for name in names:
            value = getattr(owner, name)
            less, base, more = (of(**{name: int(by * value)}) for by in (0.8, 1.0, 1.2))
            made.append(Sensitivity(result, name, str(value), less, base, more))
    return tuple(made)


def parameters() -> dict[str, str]:
    """What decides, and why."""
    return {
        **PARAMETERS,
        "bounds": f"97 km/h, {BOUNDS.length_mm // 1_000} m, errors {BOUNDS.train_error_mm // 1_000} and"
        f" {BOUNDS.worker_error_mm // 1_000} m, turning {BOUNDS.turning_ms // 1_000} s (ours; the paper names none)",
        "fresh": "fixes 10 s, display 12 s, list 8 s, worker 5 s: four or five periods (ours)",
        "workers": f"at {OPEN_M / 1_000} km, and 1 km beyond the long tunnel; on days with faults anywhere",
        "calibrated": "nothing",
    }


# ---- pictures


AROUND_KM = 7.0
"""So much of the line to either side of the worker is drawn."""


def an_hour(kinds: Sequence[Sequence[Watched]]) -> Picture:
    """Distance and time of trains, and the tone of the worker beyond the tunnel."""
    day = kinds[1][0]
    first = 3 * 3_600
    span = slice(first, first + 3_600)
    minutes = np.arange(3_600) / 60
    lines = {}
    for train in range(TRAINS):
        places = day.places[span, train] / 1_000
        places = np.where(np.abs(places - day.worker_m / 1_000) <= AROUND_KM, places, np.nan)
        if not np.isnan(places).all():
            lines[f"train {train + 1}"] = (minutes.tolist(), places.tolist())
    points = {}
    for name, tone in (("caution", CAUTION), ("alarm", ALARM), ("fault tone", FAULT)):
        at = minutes[day.tones[span] == tone][::10].tolist()
        if at:
            points[name] = (at, [day.worker_m / 1_000] * len(at))
    tunnel = [place / 1_000_000 for place in TUNNELS_MM[0]]
    return Picture(
        "004_hour", "Trains, and what a worker hears 1 km beyond a tunnel", "time, min", "kilometrage, km",
        lines=lines, points=points,
        levels={"tunnel": tunnel, "zones A and B": [tunnel[0] - ZONE_MM / 1e6, tunnel[1] + ZONE_MM / 1e6]},
    )  # fmt: skip


def faulty_day(seed: int) -> Any:
    """The tones of one day with faults, at the worker in the open."""
    kept, row = trace(), np.zeros(len(COLUMNS), int)
    watch(drawn(seed, 0, worker_m=OPEN_M), REGISTERED, REGISTERED, ALARM_TONE, NOTHING, row, kept)
    return kept.seconds[:, 0]


def a_day(tones: Any) -> Picture:
    """How long each tone sounded, hour by hour."""
    hours = np.arange(SECONDS) / 3_600
    names = {"alarm": ALARM, "caution": CAUTION, "fault tone": FAULT}
    return Picture(
        "004_day", "Tones of a day with faults, on the open line, but for the normal one", "hours of traffic",
        "seconds of each hour",
        bars={name: hours[tones == tone].tolist() for name, tone in names.items()}, edges=list(range(HOURS + 1)),
    )  # fmt: skip


def beginnings(found: Sequence[Passing]) -> Picture:
    """Where caution and alarm began, on the open line."""
    ways = {"alarm begins": [each.alarm_m for each in found], "caution begins": [each.caution_m for each in found]}
    return Picture(
        "004_distances", "Where caution and alarm began, open line, no faults", "distance of the train, m", "trains",
        bars={name: [way for way in values if not np.isnan(way)] for name, values in ways.items()},
        edges=list(range(1_400, 3_401, 20)), places={"1500 m, paper": 1_500.0, "3000 m, paper": 3_000.0},
    )  # fmt: skip
