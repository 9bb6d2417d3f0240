"""The handset's page in a real browser at the size of a phone: what it shows is what the kernel says (A7)."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from kernel.alarm import tone as machine
from kernel.alarm.distance import GREATEST_PLACE_MM
from kernel.alarm.tone import NO_DISPLAY, Display, Tone
from models.alarm.columns import COLUMNS
from models.alarm.draws import drawn
from models.alarm.faults import KIND
from models.alarm.figures import joins
from models.alarm.line import KM, LENGTH_MM, REGISTER, SHUNTER, STABLED, TRAINS, YARD_MM
from models.alarm.page import scene as data
from models.alarm.page.scene import OF_ANOTHER_LINE, Shown, handset, moment, shown
from models.alarm.page.writing import FIRST_S, LENGTH_S, LINE, WORKER_M, page_of, write
from models.alarm.watch import ALARM_TONE, NOTHING, REGISTERED, trace, watch
from models.compiled import packed
from tests.fuzz.failures.browser import CHROMIUM, Browser, browser

needs_chromium = pytest.mark.skipif(CHROMIUM is None, reason="there is no Chromium: apt-get install chromium")
PHONE = (360, 640)
COLOURS = {"alarm": "rgb(192, 39, 29)", "caution": "rgb(242, 194, 48)", "fault": "rgb(59, 71, 84)"}


@pytest.fixture(scope="module")
def scene() -> Shown:
    return shown(1, 0, WORKER_M, FIRST_S, LENGTH_S)


@pytest.fixture(scope="module")
def moments(scene: Shown) -> list[dict[str, Any]]:
    return [moment(scene, row) for row in range(LENGTH_S)]


@pytest.fixture(scope="module")
def page(scene: Shown, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("page") / "handset.html"
    path.write_text(page_of(scene), "utf-8")
    return path


@pytest.fixture(scope="module")
def tab() -> Iterator[Browser]:
    with browser() as opened:
        opened.size(*PHONE)
        yield opened


def first(moments: list[dict[str, Any]], tone: str) -> int:
    return next(second for second, each in enumerate(moments) if each["tone"] == tone)


def text(tab: Browser, selector: str) -> str:
    found: str = tab.value(f"document.querySelector({selector!r}).textContent")
    return found


def test_cpython_gives_the_tones_that_the_compiled_day_gave(scene: Shown, moments: list[dict[str, Any]]) -> None:
    for row in range(LENGTH_S):
        tone = machine.tone(REGISTER, handset(scene.kept, row))
        assert packed(tone) == scene.kept.seconds[FIRST_S + row, 0]
        assert moments[row]["tone"] == tone.name.lower()
    assert set(Counter(each["tone"] for each in moments)) == {tone.name.lower() for tone in Tone}


@pytest.mark.parametrize("kind", OF_ANOTHER_LINE)
def test_a_page_of_a_day_with_another_line_has_the_pages_line(kind: str) -> None:
    """Every figure that the handset was told is one of the page's line (A7)."""
    days = ((day, drawn(1, day)) for day in range(400))
    day = next(day for day, began in days if began.begin_s[KIND[kind]] >= 0 and (kind == "joined" or joins(began)))
    seconds = 6 * 3_600
    scene = shown(1, day, WORKER_M, FIRST_S, seconds)
    told = scene.kept.told[scene.kept.told[:, :, 0] == 1]
    places_mm = told[told[:, 1] <= GREATEST_PLACE_MM, 1]
    assert len(places_mm) > seconds
    assert places_mm.max() <= LENGTH_MM + KM
    if kind != "joined":
        began = drawn(1, day, worker_m=WORKER_M)
        elsewhere = trace(places=True, first_s=FIRST_S, told_s=seconds)
        watch(began, REGISTERED, REGISTERED, ALARM_TONE, NOTHING, np.zeros(len(COLUMNS), np.int64), elsewhere)
        beyond_mm = elsewhere.told[:, :, 1]
        assert ((beyond_mm > LENGTH_MM + KM) & (beyond_mm <= GREATEST_PLACE_MM)).any(), "else nothing is shown"


def test_a_train_is_shown_with_all_that_the_paper_names(moments: list[dict[str, Any]]) -> None:
    (train,) = moments[first(moments, "caution")]["trains"][:1]
    assert set(train) >= {"number", "section", "late_min", "speed_km_h", "distance_m", "way"}
    near = [each for each in moments if each["tone"] == "alarm" and not each["notices"]]
    assert all(any(train["tone"] == "alarm" for train in each["trains"]) for each in near)
    lost = [train for each in moments for train in each["trains"] if "tunnel" in "".join(each["notices"])]
    ends_m = {at for kind, *ends in data.line_data()["sections"] if kind == "tunnel" for at in ends}
    assert {train["at_m"] for train in lost if not train["is_placed"]} <= ends_m
    assert {train["at_m"] for train in lost if not train["is_placed"]}
    for each in moments:
        if each["tone"] == "fault":
            assert each["problems"]
        if each["tone"] in ("normal", "caution"):
            assert not each["problems"]


def test_words_for_what_is_not_known(scene: Shown) -> None:
    told = replace(handset(scene.kept, LENGTH_S - 1), trains={})
    assert data.problems(told) == []
    assert data.problems(replace(told, battery_well=False)) == ["Battery low"]
    assert data.problems(replace(told, servers_well=False)) == ["Servers not well"]
    assert data.problems(replace(told, server_age_ms=60_000)) == ["No list from the server"]
    assert data.problems(replace(told, worker=replace(told.worker, age_ms=60_000)))[0] == "No GPS here"
    in_yard = replace(told.worker, place_mm=YARD_MM[0])
    assert data.problems(replace(told, worker=in_yard)) == ["Not to be used in this section"]
    one: Any = 0
    lost = replace(told, trains={one: machine.NOTHING_KNOWN})
    assert data.problems(lost) == ["Train 201D not known"]
    assert data.place_name(NO_DISPLAY) == "–"
    assert data.place_name(Display(-300_000, 300_000, 0)) == "Asano"
    assert data.place_name(Display(300_000, 4_300_000, 0)) == "Asano – Kuroi"
    assert data.kilometrage(15_002_999) == "15k002m"
    assert data.clock(3_661) == "06:01:01"
    assert len({data.number(train) for train in range(TRAINS)}) == TRAINS


def test_shunting_and_stabled_trains_are_told_of() -> None:
    """No fault tone, but a word of them (A5, A6)."""
    words: set[str] = set()
    for train, place in ((SHUNTER, 23_000.0), (STABLED, 33_000.0)):
        probe = shown(1, 0, place, 0, 1, sound=True)
        at_s = int(probe.day.departs_s[train]) + 60
        there = moment(shown(1, 0, place, at_s, 1, sound=True), 0)
        assert there["tone"] != "fault"
        words |= set(there["notices"])
    assert {"S1 shunting", "9D stabled"} <= words


@needs_chromium
def test_it_fits_a_phone_and_shows_each_tone_in_its_colour(
    tab: Browser, page: Path, moments: list[dict[str, Any]]
) -> None:
    for tone in ("fault", "normal", "caution", "alarm"):
        second = first(moments, tone)
        tab.open(page, f"#t={second}")
        assert tab.complaints == []
        assert tab.value("[document.documentElement.scrollWidth, document.documentElement.scrollHeight]") == [*PHONE]
        assert tab.value("document.getElementById('tone').className") == tone
        colour = tab.value("getComputedStyle(document.getElementById('tone')).backgroundColor")
        assert colour == COLOURS.get(tone, "rgb(233, 241, 234)")
        marked = [way for way in ("up", "down") if tab.value(f"document.getElementById('{way}').className") == tone]
        assert bool(marked) == (tone in ("caution", "alarm"))
        for way in marked:
            box = tab.value(f"getComputedStyle(document.getElementById('{way}')).backgroundColor")
            assert box == COLOURS[tone]
    assert [address for address in tab.asked if not address.startswith(("file:", "data:"))] == []


@needs_chromium
def test_it_shows_the_states_the_line_and_the_train(tab: Browser, page: Path, moments: list[dict[str, Any]]) -> None:
    second = first(moments, "caution")
    tab.open(page, f"#t={second}")
    each = moments[second]
    assert text(tab, "#battery") == f"{each['battery']} %"
    assert [text(tab, f"#{name}") for name in ("network", "gps", "unit")] == ["LTE", "fix", "works"]
    assert [text(tab, f"#{name}") for name in ("line", "own", "clock")] == [LINE, each["own"], each["clock"]]
    (train,) = [train for train in each["trains"] if train["tone"] == "caution"]
    box = f"#{train['way']}"
    assert text(tab, f"{box} .number") == train["number"]
    assert text(tab, f"{box} .section") == train["section"]
    assert f"{train['speed_km_h']} km/h" in text(tab, f"{box} .small")
    assert text(tab, f"{box} .distance") == f"{train['distance_m']} m"
    assert tab.value("document.querySelectorAll('#near .worker').length") == 1
    assert tab.value("document.querySelectorAll('#near .train.caution').length") == 1
    assert tab.value("document.querySelectorAll('#wide .station').length") == 9


@needs_chromium
def test_keys_and_buttons_step_and_play(tab: Browser, page: Path) -> None:
    tab.open(page, "#t=100")
    at = "Number(document.getElementById('slider').value)"
    for key, second in (
        ("ArrowRight", 101),
        ("ArrowLeft", 100),
        ("PageDown", 160),
        ("PageUp", 100),
        ("Home", 0),
        ("ArrowLeft", 0),
        ("End", LENGTH_S - 1),
        ("ArrowRight", LENGTH_S - 1),
    ):
        tab.press(key)
        assert tab.value(at) == second
    tab.click("#back")
    assert tab.value(at) == LENGTH_S - 2
    tab.click("#on")
    assert tab.value(at) == LENGTH_S - 1
    tab.press("Home")
    tab.press(" ")
    assert text(tab, "#play") == "pause"
    for _ in range(3_000):
        if tab.value(at) > 2:
            break
    assert tab.value(at) > 2
    tab.press(" ")
    assert text(tab, "#play") == "play"
    assert tab.complaints == []


def test_it_is_written_to_a_file(tmp_path: Path) -> None:
    write(tmp_path / "page.html", 2, first_s=0, length_s=5)
    assert (tmp_path / "page.html").read_text("utf-8").startswith("<!DOCTYPE html>")
    with pytest.raises(OSError, match="page"):
        write(tmp_path / "page.html" / "page.html", 2, first_s=0, length_s=5)
