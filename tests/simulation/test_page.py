"""The page of a simulation in a real browser: keys step it, everything is drawn, nothing is loaded or complained of."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from models.simulation.outcome import Outcome
from models.simulation.page.writing import page_of
from tests.fuzz.failures.browser import CHROMIUM, Browser, browser
from tests.simulation.lines import ROADS, plan, simulated

needs_chromium = pytest.mark.skipif(CHROMIUM is None, reason="there is no Chromium: apt-get install chromium")


@pytest.fixture(scope="module")
def found() -> Outcome:
    return simulated(plan("passing_station", hours=0.15, roads=ROADS["passing_station"]))


@pytest.fixture(scope="module")
def page(found: Outcome, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("page") / "line.html"
    path.write_text(page_of(found), "utf-8")
    return path


@pytest.fixture(scope="module")
def tab() -> Iterator[Browser]:
    with browser() as opened:
        yield opened


@needs_chromium
def test_keys_step_through_the_line(page: Path, tab: Browser, found: Outcome) -> None:
    tab.size(1280, 900)
    tab.open(page)

    def where() -> str:
        return str(tab.value("document.getElementById('where').textContent"))

    assert where() == "0:00:05"
    tab.press("ArrowRight")
    assert where() == "0:00:10"
    tab.press("ArrowLeft")
    tab.press("ArrowLeft")
    assert where() == "0:00:05"
    tab.press("End")
    assert where() == "0:09:00"
    places = tab.value("[...document.querySelectorAll('#trains td:nth-child(4)')].map((cell) => cell.textContent)")
    for account, place in zip(found.accounts, places, strict=True):
        assert place in account.blocks
    tab.press("Home")
    tab.press("n")
    assert tab.value("document.querySelectorAll('#events .now').length") == 1
    tab.click("#last")
    assert where() == "0:09:00"
    assert tab.complaints == []
    assert tab.asked == [page.resolve().as_uri()] or all(each.startswith("data:") for each in tab.asked[1:])


@needs_chromium
def test_everything_is_drawn(page: Path, tab: Browser, found: Outcome) -> None:
    tab.open(page)
    assert tab.value("document.querySelectorAll('#lines path').length") == len(found.accounts)
    assert tab.value("document.querySelectorAll('#track .rail').length") == len(found.sim.rails.segments.segments)
    there = tab.value("document.querySelectorAll('#chart .there').length")
    assert there == sum(stay.there for stay in found.history.stays)
    assert tab.value("document.querySelectorAll('#events li').length") == len(found.sim.diary.events)
    closings = [each for state in found.sim.crossings.states.values() for each in state.closures(found.sim.now_s)]
    assert tab.value("document.querySelectorAll('#lines .closed').length") == len(closings) > 0
    assert tab.value("document.querySelectorAll('#track path.road').length") == len(ROADS["passing_station"])
    lit = tab.value("document.querySelectorAll('#track .rail.there').length")
    assert lit >= len(found.accounts)


@needs_chromium
def test_a_name_from_a_layout_ends_no_script(found: Outcome) -> None:
    text = page_of(found)
    data = text.split('id="data">')[1].split("</script>")[0]
    assert "<" not in data
    assert ">" not in data
    assert "src=" not in text
    assert "@import" not in text
    assert "http" not in text.replace("http://www.w3.org/2000/svg", "")
