"""A campaign as it goes on: a table that stays in its place on a terminal, a line every ten seconds elsewhere."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Mapping
from types import TracebackType

from rich.console import Console
from rich.live import Live
from rich.table import Table

from fuzz.campaign.store import Store, Totals

LINE_EVERY_S = 10.0
RATE_OVER_S = 60.0
COLUMNS = ("target", "batches", "traces", "steps", "steps/s", "states", "tuples", "pairs", "failures")


class View:
    """The view of one run of a campaign; ``until_s``: seconds that it may take, if that is what ends it.

    The table goes to ``out``, if that is a terminal; lines, and what goes wrong, to ``aside``.
    """

    def __init__(self, store: Store, out: Console, aside: Console, until_s: float | None) -> None:
        self._store, self._aside, self._until_s = store, aside, until_s
        self._began = self._line_at = time.monotonic()
        self._before = store.totals()
        self._rates: deque[tuple[float, Mapping[str, int]]] = deque()
        self._live = Live(console=out, refresh_per_second=4, transient=True) if out.is_terminal else None

    def __enter__(self) -> View:
        if self._live:
            self._live.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._live:
            self._live.stop()

    def say(self, line: str) -> None:
        """Say what went wrong, above the table."""
        out = self._live.console if self._live else self._aside
        out.print(line, markup=False, highlight=False, soft_wrap=True)

    def update(self) -> None:
        """Show how it stands."""
        now = time.monotonic()
        if self._live is None and now - self._line_at < LINE_EVERY_S:
            return
        totals = self._store.totals()
        rates = self._rates_of(now, totals)
        if self._live:
            self._live.update(table_of(totals, rates, f"{clock(now - self._began)}{self._of()}"))
        else:
            self._line_at = now
            if not totals:
                self.say(f"{clock(now - self._began)}{self._of()} no batch is over yet")
            for target, one in totals.items():
                self.say(f"{clock(now - self._began)}{self._of()} {line_of(target, one, rates.get(target, 0.0))}")

    def seconds(self) -> float:
        """So long it has been going on."""
        return time.monotonic() - self._began

    def rates(self) -> dict[str, float]:
        """Steps a second of the whole run, by target."""
        return {
            target: (one.steps - self._before.get(target, Totals()).steps) / self.seconds()
            for target, one in self._store.totals().items()
        }

    def _of(self) -> str:
        return "" if self._until_s is None else f" of {clock(self._until_s)}"

    def _rates_of(self, now: float, totals: Mapping[str, Totals]) -> dict[str, float]:
        """Steps a second over the last minute."""
        self._rates.append((now, {target: one.steps for target, one in totals.items()}))
        while len(self._rates) > 2 and self._rates[1][0] < now - RATE_OVER_S:
            self._rates.popleft()
        then, steps = self._rates[0]
        if len(self._rates) == 1:
            then, steps = self._began, {target: one.steps for target, one in self._before.items()}
        return {target: (one.steps - steps.get(target, 0)) / max(now - then, 1e-9) for target, one in totals.items()}


def table_of(totals: Mapping[str, Totals], rates: Mapping[str, float], title: str) -> Table:
    """A table of what each target came to; without rates where none are given."""
    shown = Table(title=title, title_justify="left")
    columns = [name for name in COLUMNS if rates or name != "steps/s"]
    for name in columns:
        shown.add_column(name, justify="left" if name == "target" else "right")
    for target, one in totals.items():
        cells = {
            "target": target,
            "batches": f"{one.batches:,}",
            "traces": f"{one.traces:,}",
            "steps": f"{one.steps:,}",
            "steps/s": f"{rates.get(target, 0.0):,.0f}",
            "states": f"{one.states:,}" if one.states else "",
            "tuples": f"{one.tuples:,}",
            "pairs": f"{one.pairs:,}",
            "failures": f"{one.failures:,}",
        }
        shown.add_row(*(cells[name] for name in columns))
    return shown


def line_of(target: str, one: Totals, rate: float) -> str:
    """One line on what a target came to."""
    states = f"{one.states:,} distinct states, " if one.states else ""
    return (
        f"{target}: {one.batches:,} batches, {one.traces:,} traces, {one.steps:,} steps, {rate:,.0f} steps/s,"
        f" {states}{one.tuples:,} tuples, {one.failures:,} failures"
    )


def clock(seconds: float) -> str:
    """Hours, minutes and seconds."""
    whole = int(seconds)
    return f"{whole // 3600}:{whole // 60 % 60:02}:{whole % 60:02}"
