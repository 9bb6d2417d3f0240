"""The page of a trace in a real browser: keys step it, the failure is marked, it loads nothing and fits its window."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest

from fuzz.failures.page.moments import changes, moment
from fuzz.failures.page.ordering import along, rows
from fuzz.failures.page.writing import page_of
from fuzz.failures.replaying import Replay, replay
from kernel.names import Block
from tests.fuzz.failures.browser import CHROMIUM, Browser, browser
from tests.fuzz.failures.samples import LAYOUTS, failing, imported, traffic

needs_chromium = pytest.mark.skipif(CHROMIUM is None, reason="there is no Chromium: apt-get install chromium")
PLACE = "passing_station"
CLOSES = {"ring": 1, "figure_of_eight": 2}
"""How often a train on a loop comes from the last row to an earlier one: where it closes, and over the diamond."""
SIZES = ((1280, 900), (390, 780))


@pytest.fixture(scope="module")
def replayed() -> Replay:
    return replay(failing(), imported(PLACE))


@pytest.fixture(scope="module")
def page(replayed: Replay, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("page") / "trace.html"
    path.write_text(page_of(replayed, "trace.json"), "utf-8")
    return path


@pytest.fixture(scope="module")
def tab() -> Iterator[Browser]:
    with browser() as opened:
        yield opened


def step_shown(tab: Browser) -> int:
    """The step that list, cursor, slider and title agree on."""
    marked = tab.value("[...document.querySelectorAll('#steps .now')].map((item) => item.dataset.step)")
    assert len(marked) == 1
    number = int(marked[0])
    assert tab.value("document.getElementById('slider').value") == str(number)
    assert tab.value("document.getElementById('where').textContent").startswith(f"step {number} of ")
    title = tab.value("document.getElementById('title').textContent")
    assert title.startswith(f"{number} ") or (number == 0 and title == "at the start")
    x, left, column = tab.value(
        "(() => { const c = document.getElementById('cursor'); const row = document.querySelector('.rows rect');"
        " return [c, row].map((r) => Number(r.getAttribute('x'))).concat(Number(c.getAttribute('width'))); })()"
    )
    assert x == pytest.approx(left + number * column, abs=0.01)
    return number


def cells(tab: Browser, table: str) -> list[list[str]]:
    """The text of every cell."""
    found: list[list[str]] = tab.value(
        f"[...document.querySelectorAll('#{table} tbody tr')].map((row) => [...row.cells].map((c) => c.textContent))"
    )
    return found


@needs_chromium
def test_keys_step_through_the_run(tab: Browser, page: Path, replayed: Replay) -> None:
    last = len(replayed.outcomes)
    tab.size(*SIZES[0])
    tab.open(page, "#step=12")
    assert step_shown(tab) == 12
    for key, step in (
        ("ArrowRight", 13),
        ("ArrowLeft", 12),
        ("ArrowLeft", 11),
        ("Home", 0),
        ("ArrowLeft", 0),
        ("ArrowRight", 1),
        ("End", last),
        ("ArrowRight", last),
        ("Home", 0),
        ("f", replayed.at_step),
    ):
        tab.press(key)
        assert step_shown(tab) == step
        assert tab.value("location.hash") in (f"#step={step}", "#step=12")
    assert tab.complaints == []


@needs_chromium
def test_it_opens_at_the_failure_which_is_marked(tab: Browser, page: Path, replayed: Replay) -> None:
    tab.size(*SIZES[0])
    tab.open(page)
    assert replayed.at_step is not None
    assert step_shown(tab) == replayed.at_step
    red = "rgb(192, 39, 29)"
    assert tab.value("getComputedStyle(document.querySelector('#steps .violation b')).color") == red
    assert tab.value("document.querySelectorAll('#steps .violation').length") == 1
    assert tab.value("getComputedStyle(document.querySelector('rect.failure')).fill") == red
    assert tab.value("document.querySelector('rect.failure').getAttribute('x')") == tab.value(
        "document.getElementById('cursor').getAttribute('x')"
    )
    assert replayed.violated[0] in tab.value("document.querySelector('#outcome').textContent")


@needs_chromium
def test_buttons_list_and_slider_do_what_keys_do(tab: Browser, page: Path, replayed: Replay) -> None:
    tab.size(*SIZES[0])
    tab.open(page, "#step=5")
    for selector, step in (
        ("#on", 6),
        ("#back", 5),
        ("#to-end", len(replayed.outcomes)),
        ("#to-start", 0),
        ("#to-failure", replayed.at_step),
        ("#steps li[data-step='3'] b", 3),
    ):
        tab.click(selector)
        assert step_shown(tab) == step
    tab.value(
        "(() => { const s = document.getElementById('slider'); s.value = 9; s.dispatchEvent(new Event('input')); })()"
    )
    assert step_shown(tab) == 9


@needs_chromium
def test_tables_show_the_state_of_the_replay(tab: Browser, page: Path, replayed: Replay) -> None:
    tab.size(*SIZES[0])
    for number in (0, 20, len(replayed.outcomes)):
        tab.open(page, f"#step={number}")
        system = replayed.start if number == 0 else replayed.outcomes[number - 1].after
        shown = moment(replayed.site, system)
        points = {row[0]: row for row in cells(tab, "points")}
        assert {name: row[1] for name, row in points.items()} == {
            name: point["lies"] for name, point in shown["points"].items()
        }
        assert all(("unlocked" in row[2]) is not shown["points"][name]["locked"] for name, row in points.items())
        runs = [row for row in cells(tab, "runs") if row[0].startswith("#")]
        assert [row[1].startswith(run["stage"]) for row, run in zip(runs, shown["runs"].values(), strict=True)] == [
            True
        ] * len(runs)
        lit = tab.value("document.querySelectorAll('#runs .lit').length")
        assert lit == sum(sum(run["first"]) for run in shown["runs"].values())
        assert [row[0].split("life")[0] for row in cells(tab, "trains")] == sorted(replayed.trace.trains)


@needs_chromium
@pytest.mark.parametrize("size", SIZES, ids=str)
def test_it_fits_its_window_and_loads_nothing(tab: Browser, page: Path, size: tuple[int, int]) -> None:
    tab.size(*size)
    tab.open(page)
    assert tab.value("document.documentElement.scrollWidth") <= size[0]
    assert tab.value("document.querySelector('nav').getBoundingClientRect().right") <= size[0]
    assert tab.asked == [page.resolve().as_uri()]
    assert tab.complaints == []


@needs_chromium
def test_names_from_a_file_are_text_and_not_markup(tab: Browser, replayed: Replay, tmp_path: Path) -> None:
    wicked = "</script><img src=x onerror=document.title='taken'>"
    trace = replace(replayed.trace, faults=(wicked,))
    trace = replace(trace, events=tuple(replace(event, by=wicked) for event in trace.events))
    path = tmp_path / "wicked.html"
    path.write_text(page_of(replay(trace, imported(PLACE)), wicked), "utf-8")
    tab.size(*SIZES[0])
    tab.open(path, "#step=4")
    assert step_shown(tab) == 4
    assert tab.value("document.images.length") == 0
    assert wicked in tab.value("document.getElementById('title').textContent")


def test_the_page_names_no_other_address(page: Path) -> None:
    text = page.read_text("utf-8")
    assert re.findall(r"""(?:src|href|action)\s*=\s*["']?(?!data:,)[^"'\s>]+|@import|url\((?!#)""", text) == []
    assert "http" not in text


def test_changes_add_up_to_every_moment(replayed: Replay) -> None:
    state: dict[str, dict[str, Any]] = {"trains": {}, "points": {}, "runs": {}, "lost": {}}
    systems = [replayed.start, *(outcome.after for outcome in replayed.outcomes)]
    for system, changed in zip(systems, json.loads(json.dumps(changes(replayed))), strict=True):
        for room, entries in changed.items():
            state[room] = {name: value for name, value in (state[room] | entries).items() if value is not None}
        assert state == json.loads(json.dumps(moment(replayed.site, system)))


@pytest.mark.parametrize("place", LAYOUTS)
def test_a_train_that_runs_goes_steadily_along_the_rows(place: str) -> None:
    site = replay(traffic(place, 1, seconds=5), imported(place)).site
    rank = along(site)
    assert rows(site, ()) == sorted(site.layout.blocks, key=lambda block: (*rank[block], block))
    for route in site.layout.routes:
        block: Block | None = site.layout.start[route]
        way: list[int] = []
        while block is not None:
            way.append(rank[block][1])
            block = site.layout.way[route].get(block)
        falls = sum(before > after for before, after in pairwise(way))
        assert min(falls, len(way) - 1 - falls) <= CLOSES.get(place, 0), way
        assert len(set(way)) == len(way)
