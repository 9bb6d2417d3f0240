"""A driver's display with orders of the past, the present and the future (G3, G6)."""

from __future__ import annotations

from kernel.tram import display as machine
from kernel.tram.dispatching import Order
from models.tram.display import Cab, Shown
from proofs.onboard.witnesses.play import Play
from proofs.tram.display import THEORY
from proofs.tram.witnesses.line import HELD, LIMITS, NEITHER, RECOVERS

NOW_MS = 1_000_000


class Driver(Play[Cab, Shown]):
    """A tram that stands at stop 3."""

    def __init__(self) -> None:
        """Begin."""
        super().__init__(THEORY, Cab(LIMITS), Shown(NOW_MS, machine.begun(NOW_MS), 0))
        self.step("take_place", is_located=True, told_stop=3, stands=True)
        assert (self.system.display.stop, self.system.display.stands) == (3, True)

    def wait(self, elapsed_ms: int) -> tuple[bool, bool]:
        """Let time pass; what is shown then."""
        before_ms = self.system.now_ms
        self.step("pass_time", elapsed_ms=elapsed_ms)
        assert self.system.now_ms == before_ms + elapsed_ms
        return self.system.display.holds, self.system.display.recovers

    def hear(self, made_ms: int, *, holds: bool = True, stop: int = 3) -> tuple[bool, bool]:
        """An order comes, to hold or else to recover; what is shown then."""
        before = self.system
        self.step("hear", order=Order(stop, holds, not holds, made_ms))
        takes = self.system.display != before.display
        assert self.system.taken_ms == (self.system.now_ms if takes else before.taken_ms)
        return self.system.display.holds, self.system.display.recovers


def an_order_of_the_future_is_not_taken() -> None:
    """From a centre whose clock is an hour ahead; it would be shown for an hour, and block every correct one (G6)."""
    driver = Driver()
    driver.wait(1)
    assert driver.hear(driver.system.now_ms + 3_600_000) == NEITHER
    assert driver.hear(driver.system.now_ms + 1) == NEITHER
    assert driver.hear(driver.system.now_ms, stop=4) == NEITHER
    assert driver.hear(driver.system.now_ms) == HELD
    driver.wait(1_000)
    assert driver.hear(driver.system.now_ms + 1, holds=False) == HELD
    assert driver.hear(driver.system.now_ms - 1, holds=False) == RECOVERS


def an_order_of_the_past_counts_as_long_as_it_does() -> None:
    """11 s here, and not a millisecond more, however late it came (G3)."""
    driver = Driver()
    driver.wait(20_000)
    assert driver.hear(driver.system.now_ms - 11_001) == NEITHER
    assert driver.hear(driver.system.now_ms - 11_000) == HELD
    assert driver.wait(0) == HELD
    assert driver.wait(1) == NEITHER
    assert driver.hear(driver.system.now_ms) == HELD
    assert driver.wait(11_000) == HELD
    assert driver.wait(1) == NEITHER


def a_unit_that_starts_anew_shows_nothing() -> None:
    """It takes only what is made after that (G6)."""
    driver = Driver()
    driver.wait(5)
    made_ms = driver.system.now_ms
    assert driver.hear(made_ms) == HELD
    driver.wait(1)
    driver.step("restart")
    assert driver.system.display == machine.begun(made_ms + 1)
    assert driver.system.display.stop == 0
    driver.step("take_place", is_located=True, told_stop=3, stands=True)
    assert driver.hear(made_ms) == NEITHER
    driver.wait(1)
    assert driver.hear(made_ms + 2) == HELD


def where_it_runs_on_a_hold_ends() -> None:
    """It moves, or loses its place; and time does not run back (G4, G6)."""
    for is_located in (True, False):
        driver = Driver()
        driver.wait(1)
        assert driver.hear(driver.system.now_ms) == HELD
        driver.step("take_place", is_located=is_located, told_stop=3, stands=not is_located)
        assert not driver.system.display.holds
        before = driver.system
        assert driver.step("pass_time", elapsed_ms=-1) == before


WITNESSES = (
    an_order_of_the_future_is_not_taken,
    an_order_of_the_past_counts_as_long_as_it_does,
    a_unit_that_starts_anew_shows_nothing,
    where_it_runs_on_a_hold_ends,
)
