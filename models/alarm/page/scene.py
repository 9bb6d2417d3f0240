"""What a handset shows second by second, as data for its page (A7): nothing but what it was told.

Tones and distances are the kernel's own, run by CPython on what the compiled day was told.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from kernel.alarm import sections
from kernel.alarm import tone as machine
from kernel.alarm.distance import Direction, TrainFix, WorkerFix, nearest_um
from kernel.alarm.sections import Reason
from kernel.alarm.tone import ALARM_MM, CAUTION_MM, Display, Handset, Known, Listing, Register, Tone
from models.alarm.columns import COLUMNS
from models.alarm.draws import SECONDS, Drawn, drawn, scheduled_s
from models.alarm.faults import KIND
from models.alarm.line import (
    LENGTH_MM,
    REGISTER,
    REGULAR,
    SHUNTER,
    STATION_MM,
    STATIONS,
    STATIONS_MM,
    TRAINS,
    TUNNELS_MM,
    name,
)
from models.alarm.network import SLOW
from models.alarm.watch import ALARM_TONE, NOTHING, REGISTERED, Trace, trace, watch
from models.alarm.windows import is_on

FIRST_TRAIN_AT_S = 5 * 3_600
"""Traffic begins at 5 o'clock."""
CLOSE_MM = {Tone.ALARM: ALARM_MM, Tone.CAUTION: CAUTION_MM}
WAYS = {"up": Direction.UP, "down": Direction.DOWN}
BATTERY = {"full": 100, "an hour": 4, "low": 9}
"""In per cent: full at the beginning, so much less each hour, and what is shown when it does not last (ours)."""


OF_ANOTHER_LINE = ("joined", "broken", "adjoined", "branches")
"""Faults by which the day has another line than the page."""


@dataclass(frozen=True)
class Shown:
    """Some minutes of a day: ``day`` as drawn, what was told, and from which second on."""

    day: Drawn
    kept: Trace
    first_s: int


def shown(seed: int, day: int, worker_m: float | None, first_s: int, length_s: int, sound: bool = False) -> Shown:
    """Let the day pass, and keep what the handset was told for so long.

    On the page the line goes on from end to end: what joins, leaves or breaks it on a day is left out.
    """
    began = drawn(seed, day, worker_m=worker_m, sound=sound)
    began.begin_s[[KIND[name] for name in OF_ANOTHER_LINE]] = -1
    kept = trace(places=True, first_s=first_s, told_s=min(length_s, SECONDS - first_s))
    watch(began, REGISTERED, REGISTERED, ALARM_TONE, NOTHING, np.zeros(len(COLUMNS), np.int64), kept)
    return Shown(began, kept, first_s)


def handset(kept: Trace, row: int) -> Handset:
    """Give the handset of one second as the kernel has it."""
    own_mm, own_age_ms, server_age_ms, well, battery, whole = (int(each) for each in kept.own[row])
    trains = {name(train): known(kept.told[row, train]) for train in range(2 * TRAINS) if kept.told[row, train, 0]}
    listing = Listing(life_ms=0, taken=0, count=0, is_whole=bool(whole), named={})
    return Handset(WorkerFix(own_mm, own_age_ms), server_age_ms, bool(well), bool(battery), listing, trains)


def known(told: Any) -> Known:
    """Give what is known of a train."""
    _is_there, place_mm, age_ms, direction, runs, from_mm, to_mm, shown_ms, jumped, *newest = (
        int(each) for each in told
    )
    shown = Display(from_mm, to_mm, shown_ms)
    return Known(fix(place_mm, age_ms, direction, runs), shown, bool(jumped), fix(*newest))


def fix(place_mm: int, age_ms: int, direction: int, runs: int) -> TrainFix:
    """Give a fix."""
    return TrainFix(place_mm, age_ms, list(Direction)[direction], bool(runs))


# ---- what is written on the screen


def number(train: int) -> str:
    """Give a train's number as it is written: odd down, even up; one that it took on its way begins with 8."""
    if train >= TRAINS:
        return f"8{number(train - TRAINS)}"
    if train >= REGULAR:
        return "S1" if train == SHUNTER else "9D"
    return f"{2 * train + 201}D" if train % 2 == 0 else f"{2 * train + 200}D"


def place_name(display: Display) -> str:
    """Name the stretch that the display shows."""
    for station, middle_mm in zip(STATIONS, STATIONS_MM, strict=True):
        if display.from_mm == middle_mm - STATION_MM and display.to_mm == middle_mm + STATION_MM:
            return station
    ends = [each for each, at in zip(STATIONS, STATIONS_MM, strict=True) if at - STATION_MM == display.to_mm]
    begins = [each for each, at in zip(STATIONS, STATIONS_MM, strict=True) if at + STATION_MM == display.from_mm]
    return f"{begins[0]} – {ends[0]}" if begins and ends else "–"


def kilometrage(place_mm: int) -> str:
    """Write a place: kilometres and metres, as on the posts beside the track."""
    return f"{place_mm // 10**6}k{place_mm % 10**6 // 1_000:03d}m"


def clock(second: int) -> str:
    """Write the time of day."""
    at = FIRST_TRAIN_AT_S + second
    return f"{at // 3_600:02d}:{at // 60 % 60:02d}:{at % 60:02d}"


def severity(register: Register, told: Known, worker: WorkerFix) -> str:
    """Tell by which tone a train counts."""
    for tone, limit_mm in CLOSE_MM.items():
        if machine.may_be_near(register, told, worker, limit_mm):
            return tone.name.lower()
    return "normal"


def placed(told: Known, worker: WorkerFix) -> tuple[int, int | None]:
    """Give where a train is drawn, and its least distance, if it has one: lost in a tunnel at the outer end (A4)."""
    fix, shown_at = told.fix, told.display
    if machine.has_fix(REGISTER, told):
        return fix.place_mm, nearest_um(REGISTER.bounds, fix, worker)
    through = [each for _name, each in REGISTER.sections.items() if sections.is_put_forward(each, fix)]
    if through and machine.was_lost_without_gps(REGISTER, told):
        outer_mm = through[0].from_mm if sections.runs(fix, Direction.UP) else through[0].to_mm
        return outer_mm, sections.from_way_through_um(REGISTER.bounds, through[0], fix, worker)
    return (shown_at.from_mm + shown_at.to_mm) // 2, None


def train_shown(scene: Shown, second: int, train: int, told: Known, worker: WorkerFix) -> dict[str, Any]:
    """Give one train: number, section, delay, speed, distance (A7)."""
    written, train = number(train), train % TRAINS
    made_s = max(1, second - told.fix.age_ms // 1_000)
    has_fix = machine.has_fix(REGISTER, told)
    speed_m_s = abs(scene.kept.places[made_s, train] - scene.kept.places[made_s - 1, train]) if has_fix else np.nan
    at_mm, apart_um = placed(told, worker)
    late_s = scene.day.departs_s[train] - scheduled_s()[train] if train < REGULAR else 0
    return {
        "number": written,
        "way": next((way for way, direction in WAYS.items() if direction == told.fix.direction), ""),
        "section": place_name(told.display) if machine.has_display(REGISTER, told) else "not on the display",
        "late_min": int(late_s // 60),
        "speed_km_h": None if np.isnan(speed_m_s) else round(3.6 * float(speed_m_s)),
        "distance_m": None if apart_um is None else max(0, apart_um // 10**6),
        "at_m": at_mm // 1_000,
        "is_placed": has_fix,
        "departs": machine.is_matched(REGISTER, told) and machine.is_departing(REGISTER, told.fix, worker),
        "tone": severity(REGISTER, told, worker),
    }


def problems(told: Handset) -> list[str]:
    """Say why the fault tone sounds (A2, A8), and that the place is not to be used (A4 to A6)."""
    found = []
    if not told.battery_well:
        found.append("Battery low")
    if not machine.has_worker(REGISTER, told):
        found.append("No GPS here")
    if not machine.is_linked(REGISTER, told):
        found.append("No list from the server" if told.servers_well else "Servers not well")
    for train, each in told.trains.items():
        if each.jumped:
            found.append(f"Train {number(train)}: GPS has jumped")  # type: ignore[arg-type]
        elif not machine.is_matched(REGISTER, each) and not machine.is_registered(REGISTER, train, each):
            found.append(f"Train {number(train)} not known")  # type: ignore[arg-type]
    if machine.is_not_to_be_used(REGISTER, told.worker):
        found.append("Not to be used in this section")
    return found


def notices(told: Handset) -> list[str]:
    """Say which trains are known by one source, as registered (A4 to A6)."""
    words = []
    for train, each in told.trains.items():
        if machine.is_matched(REGISTER, each) or not machine.is_registered(REGISTER, train, each):
            continue
        what = "in a tunnel" if machine.was_lost_without_gps(REGISTER, each) else "stabled"
        what = "shunting" if machine.has_fix(REGISTER, each) else what
        words.append(f"{number(train)} {what}")  # type: ignore[arg-type]
    return words


def moment(scene: Shown, row: int) -> dict[str, Any]:
    """Give one second as it is shown (A7)."""
    second, told = scene.first_s + row, handset(scene.kept, row)
    linked, slow = machine.is_linked(REGISTER, told), is_on(scene.day, SLOW, second)
    trains = [train_shown(scene, second, train, each, told.worker) for train, each in told.trains.items()]  # type: ignore[arg-type]
    left = BATTERY["full"] - BATTERY["an hour"] * second // 3_600
    return {
        "clock": clock(second),
        "tone": machine.tone(REGISTER, told).name.lower(),
        "battery": left if told.battery_well else BATTERY["low"],
        "network": ("3G" if slow else "LTE") if linked else "none",
        "gps": "fix" if machine.has_worker(REGISTER, told) else "none",
        "unit": "works" if told.servers_well else "stopped",
        "own": kilometrage(told.worker.place_mm),
        "own_m": told.worker.place_mm // 1_000,
        "trains": trains,
        "problems": problems(told),
        "notices": notices(told),
    }


def line_data() -> dict[str, Any]:
    """Give the line as it is drawn: stations, tunnels, sections that are not to be used."""
    kinds = {Reason.WITHOUT_GPS: "tunnel", Reason.SHUNTING: "shunting", Reason.STABLING: "stabling"}
    return {
        "length_m": LENGTH_MM // 1_000,
        "stations": [[each, at // 1_000] for each, at in zip(STATIONS, STATIONS_MM, strict=True)],
        "tunnels": [[from_mm // 1_000, to_mm // 1_000] for from_mm, to_mm in TUNNELS_MM],
        "sections": [
            [kinds[each.reason], each.from_mm // 1_000, each.to_mm // 1_000]
            for _name, each in REGISTER.sections.items()
        ],
        "caution_m": CAUTION_MM // 1_000,
        "alarm_m": ALARM_MM // 1_000,
    }
