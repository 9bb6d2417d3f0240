"""``heisoku replay``: a trace again, in plain CPython, as a table and as a page."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.table import Table
from rich.text import Text

from fuzz.failures.batches import Again, run_again
from fuzz.failures.lines import Simulated, simulate_again
from fuzz.failures.links import Played, play_again
from fuzz.failures.replaying import Outcome, Replay, replay
from fuzz.failures.rides import Ridden, ride_again, unknown_faults
from fuzz.failures.trace import (
    TRAFFIC,
    BatchTrace,
    LineTrace,
    LinkTrace,
    RideTrace,
    Trace,
    event_as_json,
    layout_of,
    load_trace,
)
from fuzz.failures.words import claim, comes_to, otherwise, told, verdict
from models.exit_codes import DOES_NOT_HOLD, HOLDS
from models.layouts import BadInput
from models.streams import write_whole
from proofs.catalogue import INVARIANTS
from proofs.records import about, write_json

Progress = Callable[[int, int, str], object]


@dataclass(frozen=True)
class Replayed:
    """A trace of traffic, replayed."""

    path: Path
    found: Replay

    def report(self, out: Console, html: Path | None, json: Path | None) -> int:
        """Print it, write the page and the record where they are wanted, and give the exit code."""
        print_replay(out, self.found)
        if html is not None:
            from fuzz.failures.page.writing import page_of

            write_whole(html, page_of(self.found, self.path.name).encode())
            _line(out, f"{html}: the page; its keys are ← → Home End, and f for the failure")
        if json is not None:
            write_json(json, {**record(self.path, self.found), **about()})
        _line(out, verdict(self.found))
        return DOES_NOT_HOLD if self.found.reproduced else HOLDS


@dataclass(frozen=True)
class Reridden:
    """A trace of a ride, ridden again."""

    path: Path
    found: Ridden

    def report(self, out: Console, html: Path | None, json: Path | None) -> int:
        """Print it, write the record where it is wanted, and give the exit code; a ride has no page."""
        assert html is None
        print_ride(out, self.found)
        if json is not None:
            write_json(json, {**ride_record(self.path, self.found), **about()})
        _line(out, self.found.verdict)
        return DOES_NOT_HOLD if self.found.violated else HOLDS


@dataclass(frozen=True)
class Relinked:
    """A run of the radio link, played again."""

    path: Path
    found: Played

    def report(self, out: Console, html: Path | None, json: Path | None) -> int:
        """Print it, write the record where it is wanted, and give the exit code; such a run has no page."""
        assert html is None
        print_link(out, self.found)
        if json is not None:
            write_json(json, {**link_record(self.path, self.found), **about()})
        _line(out, self.found.verdict)
        return DOES_NOT_HOLD if self.found.violated else HOLDS


@dataclass(frozen=True)
class Rerun:
    """A walk or a batch, run again."""

    path: Path
    found: Again

    def report(self, out: Console, html: Path | None, json: Path | None) -> int:
        """Print it, write the record where it is wanted, and give the exit code; there is no page of it."""
        assert html is None
        trace = self.found.trace
        if json is not None:
            told = {"trace": str(self.path), "target": trace.target, "violated": list(self.found.violated)}
            write_json(json, {**told, "steps": self.found.steps, **about()})
        _line(out, self.found.verdict)
        if self.found.violated and self.found.violated != trace.violated:
            _line(out, f"the trace says: {', '.join(trace.violated)} violated")
        return DOES_NOT_HOLD if self.found.violated else HOLDS


@dataclass(frozen=True)
class Resimulated:
    """A simulated line, simulated again."""

    path: Path
    found: Simulated

    def report(self, out: Console, html: Path | None, json: Path | None) -> int:
        """Print what happened, write the page and the record where they are wanted, and give the exit code."""
        print_line_again(out, self.found)
        if html is not None:
            from models.simulation.page.writing import page_of

            write_whole(html, page_of(self.found.outcome).encode())
            _line(out, f"{html}: the page")
        if json is not None:
            write_json(json, {**line_record(self.path, self.found), **about()})
        _line(out, self.found.verdict)
        return DOES_NOT_HOLD if self.found.came.violated else HOLDS


def replay_file(path: Path, page: bool, progress: Progress) -> Replayed | Reridden | Relinked | Rerun | Resimulated:
    """Replay the trace of a file; ``page``: whether a page of it is wanted.

    Raises:
        BadInput: the file, its layout or what they name cannot be used.
    """
    trace = load_trace(path)
    if isinstance(trace, LineTrace):
        return Resimulated(path, simulate_again(trace, path))
    if page and not isinstance(trace, Trace):
        target = _target_of(trace)
        raise BadInput(str(path), "target", f"is {target}, of which there is no page", "leave out --html")
    if isinstance(trace, BatchTrace):
        return Rerun(path, run_again(trace, path))
    if isinstance(trace, LinkTrace):
        return Relinked(path, play_again(trace))
    if isinstance(trace, RideTrace):
        for name in unknown_faults(trace):
            what = f"there is no fault '{name}'"
            raise BadInput(str(path), "beyond", what, "replay it with the version that found it")
        return Reridden(path, ride_again(trace))
    return Replayed(path, replay(trace, layout_of(trace, path), progress))


def _target_of(trace: RideTrace | LinkTrace | BatchTrace) -> str:
    if isinstance(trace, BatchTrace):
        return trace.target
    return "rides" if isinstance(trace, RideTrace) else "link"


# ---- traffic


def print_replay(out: Console, found: Replay) -> None:
    """Print every step and what it came to, and what is violated."""
    rows = Table(box=None, pad_edge=False, show_edge=False)
    rows.add_column("step", justify="right")
    rows.add_column("by")
    rows.add_column("event", overflow="fold")
    rows.add_column("comes to", overflow="fold")
    for outcome in found.outcomes:
        rows.add_row(*_row(outcome))
    out.print(rows)
    for name in found.violated:
        _line(out, f"{name}: {claim(name)}")
    if found.broken:
        _line(out, f"assumptions about nature that were broken: {', '.join(found.broken)}")
    if otherwise(found):
        _line(out, otherwise(found))
    print_counts(out, found)


def print_counts(out: Console, found: Replay) -> None:
    """Say how much was replayed and judged."""
    judged = found.changed + 1
    planted = "" if found.trace.planted is None else f", with the planted fault '{found.trace.planted}'"
    _line(
        out,
        f"{len(found.outcomes):,} of {len(found.trace.events):,} steps replayed, {found.changed:,} changed something;"
        f" {len(INVARIANTS)} invariants judged in {judged:,} states{planted}",
    )


def _row(outcome: Outcome) -> tuple[Text, ...]:
    """A step as a row; the violating one is marked, in red and by a sign."""
    event = outcome.event
    style = "bold red" if outcome.violated else "" if outcome.changed else "dim"
    number = f"▶ {outcome.number}" if outcome.violated else str(outcome.number)
    by = "" if event.by == TRAFFIC else event.by
    texts = (number, by, f"{event.step} {told(event.event)}", comes_to(outcome))
    return tuple(Text(_printable(text), style=style) for text in texts)


def record(path: Path, found: Replay) -> dict[str, Any]:
    """A replay as plain data."""
    return {
        "verdict": "does not hold" if found.reproduced else "holds",
        "reproduced": found.reproduced,
        "as_told": not otherwise(found),
        "trace": str(path),
        "target": "interlocking",
        "planted": found.trace.planted,
        "violated": list(found.violated),
        "at_step": found.at_step,
        "broken_assumptions": list(found.broken),
        "invariants": len(INVARIANTS),
        "steps": [_step_as_json(outcome) for outcome in found.outcomes],
    }


def _step_as_json(outcome: Outcome) -> dict[str, Any]:
    return {
        "number": outcome.number,
        **event_as_json(outcome.event),
        "changed": outcome.changed,
        "refusal": None if outcome.refusal is None else outcome.refusal.value,
        "raised": outcome.raised or None,
        "broken_assumptions": list(outcome.broken),
        "violated": list(outcome.violated),
    }


# ---- rides


def print_ride(out: Console, found: Ridden) -> None:
    """Print a ride's tally."""
    rows = Table(box=None, pad_edge=False, show_edge=False)
    rows.add_column("what")
    rows.add_column("count", justify="right")
    for name, what in {**found.violated, **found.broken, **found.noticed, **found.counts}.items():
        style = "bold red" if name in found.violated else ""
        rows.add_row(Text(f"{what} ({name})", style=style), Text(f"{found.values[name]:,}", style=style))
    out.print(rows)
    if found.trace.violated and tuple(found.violated) != found.trace.violated:
        _line(out, f"the trace says: {', '.join(found.trace.violated)} violated")


def ride_record(path: Path, found: Ridden) -> dict[str, Any]:
    """A ride as plain data."""
    return {
        "verdict": "does not hold" if found.violated else "holds",
        "reproduced": bool(found.violated),
        "as_told": tuple(found.violated) == found.trace.violated,
        "trace": str(path),
        "target": "rides",
        "violated": list(found.violated),
        "broken_assumptions": list(found.broken),
        "tally": found.values,
    }


# ---- the radio link


def print_link(out: Console, found: Played) -> None:
    """Print every step of a run of the link; what it ends with is violated."""
    rows = Table(box=None, pad_edge=False, show_edge=False)
    rows.add_column("step", justify="right")
    rows.add_column("event", overflow="fold")
    rows.add_column("comes to", overflow="fold")
    for number, (step, event) in enumerate(found.events, 1):
        last = bool(found.violated) and number == len(found.events)
        texts = (
            f"▶ {number}" if last else str(number),
            f"{step} {told(event)}",
            f"VIOLATED {', '.join(found.violated)}" if last else "",
        )
        rows.add_row(*(Text(_printable(text), style="bold red" if last else "") for text in texts))
    out.print(rows)
    if not found.as_told:
        _line(out, f"the trace says: {', '.join(found.trace.violated)} violated after step {found.trace.at_step}")
    planted = "" if found.trace.planted is None else f", with the planted fault '{found.trace.planted}'"
    _line(out, f"{len(found.events):,} steps played, {found.changed:,} changed something{planted}")


def link_record(path: Path, found: Played) -> dict[str, Any]:
    """A run of the link as plain data."""
    return {
        "verdict": "does not hold" if found.violated else "holds",
        "reproduced": bool(found.violated),
        "as_told": found.as_told,
        "trace": str(path),
        "target": "link",
        "planted": found.trace.planted,
        "violated": list(found.violated),
        "at_step": len(found.events) if found.violated else None,
        "steps": [f"{step} {told(event)}" for step, event in found.events],
    }


# ---- simulated lines


def print_line_again(out: Console, found: Simulated) -> None:
    """Print what happened, and what is violated by it."""
    rows = Table(box=None, pad_edge=False, show_edge=False)
    rows.add_column("s", justify="right")
    for heading in ("kind", "who", "what"):
        rows.add_column(heading, overflow="fold")
    for event in found.came.sim.diary.events:
        texts = (f"{event.at_ms / 1_000:.0f}", event.kind, event.who, event.text)
        rows.add_row(*(Text(_printable(text)) for text in texts))
    out.print(rows)
    for each in found.came.sim.oracles.found:
        _line(out, f"{each.oracle}, after {each.at_ms / 1_000:.0f} s: {each.text}")
    if not found.as_told:
        _line(out, f"the trace says: {', '.join(found.trace.violated)} violated in second {found.trace.at_s}")
    line = found.came.line
    planted = "" if line.planted is None else f", with the planted fault '{line.planted}'"
    goes = line.trains - len(line.still)
    _line(out, f"{goes} of {line.trains} trains go anywhere, {len(found.came.drawn)} faults come at some time{planted}")


def line_record(path: Path, found: Simulated) -> dict[str, Any]:
    """A simulated line as plain data."""
    return {
        "verdict": "does not hold" if found.came.violated else "holds",
        "reproduced": bool(found.came.violated),
        "as_told": found.as_told,
        "trace": str(path),
        "target": "lines",
        "planted": found.came.line.planted,
        "violated": list(found.came.violated),
        "at_s": found.came.sim.now_s,
        "line": found.outcome.record(),
    }


def _line(out: Console, line: str) -> None:
    out.print(_printable(line), markup=False, highlight=False, soft_wrap=True)


def _printable(text: str) -> str:
    return "".join(char if char.isprintable() else " " for char in text)
