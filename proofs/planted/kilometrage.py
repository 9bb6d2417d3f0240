"""Draws a step of the joint along one train's kilometrage: its lists, its head, and the end that its brake holds.

Places are drawn in their order and not to scale, each with its millimetres, since a solver's numbers are
any numbers.
"""

from __future__ import annotations

import inspect
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from html import escape

from kernel.maps import Map
from kernel.names import Block, Run, Train
from models.onboard.joint import Joint
from proofs.drawing import DANGER, page, value_in_words
from proofs.mutants.steps import Found
from proofs.sketch import in_words
from proofs.theories import theory_of

STEP, LEFT, TOP, ROW = 118, 250, 64, 58
"""Pixels: between two places, for the words at the left, above the first row, and from row to row."""


@dataclass(frozen=True)
class Bar:
    """One line of the drawing: what it is, and stretches of track with what stands in each."""

    words: tuple[str, ...]
    stretches: tuple[tuple[int, int, str], ...]


@dataclass(frozen=True)
class Strip:
    """A moment of one train: its bars, its head, the end of its authority, all in mm."""

    bars: Sequence[Bar]
    head_mm: int
    end_mm: int
    brake: str

    @property
    def places(self) -> list[int]:
        """Every place that is drawn."""
        ends = {mm for bar in self.bars for low, high, _ in bar.stretches for mm in (low, high)}
        return sorted(ends | {self.head_mm, self.end_mm})


def strip(system: Joint, train: Train) -> Strip:
    """What is drawn of a train at one moment."""
    bars = [_track(system, train), *(_list(system, run) for run in sorted(system.block_ends_mm) if run.train == train)]
    brake = system.brake[train]
    state = "applied until an end is taken" if brake.withheld else "applied" if brake.applied else "released"
    return Strip(bars, system.head_mm[train], brake.end_mm, state)


def _track(system: Joint, train: Train) -> Bar:
    """The block that the head is in, from the head on."""
    block = system.block[train]
    ahead = (system.head_mm[train], system.block_end_mm[train], str(block))
    return Bar((f"track ahead of {train}",), (ahead,))


def _list(system: Joint, run: Run) -> Bar:
    """The blocks of one run's list, in their order."""
    order = system.system.units[run.train].orders.get(run)
    words = "not on the unit"
    if order is not None:
        known = {"permitted": order.permitted, "recalled": order.recalled, "given back": order.given_back}
        words = ", ".join(name for name, so in known.items() if so) or "not permitted"
    return Bar((in_words(run), words), _stretches(system.begins_mm[run], system.block_ends_mm[run]))


def _stretches(begins_mm: int, ends_mm: Map[Block, int]) -> tuple[tuple[int, int, str], ...]:
    """A list as stretches; a solver's list may have two blocks end at one place."""
    found, low = [], begins_mm
    for block, end in sorted(ends_mm.items(), key=lambda each: (each[1], each[0])):
        found.append((low, end, str(block)))
        low = end
    return tuple(found)


def claims(found: Found) -> list[tuple[str, str]]:
    """The claims that do not hold after the step, each with what it says."""
    theory = theory_of(found.row)[0]
    says = {name: (inspect.getdoc(claim) or name).splitlines()[0] for name, claim in theory.invariants.items()}
    return [(name, says.get(name, "raised by the step")) for name in found.false]


def moments(found: Found) -> Mapping[str, Strip]:
    """Before the step and, unless it raised something, after it."""
    train = found.event["train"]
    before = {"before": strip(found.before, train)}
    return before if found.after is None else {**before, "after": strip(found.after, train)}


def event_in_words(found: Found) -> str:
    """The step and its event."""
    told = "; ".join(f"{name.replace('_', ' ')} {value_in_words(value)}" for name, value in found.event.items())
    return f"{found.row} ({told})"


def as_text(name: str, story: str, found: Found) -> str:
    """A step of the joint for a terminal."""
    parts = [name, story, "", *(f"does not hold: {claim}\n    {says}" for claim, says in claims(found))]
    parts += ["", f"step  {event_in_words(found)}"]
    for when, moment in moments(found).items():
        parts += ["", f"{when}: head at {moment.head_mm} mm, end of authority at {moment.end_mm} mm"]
        parts.append(f"  brake {moment.brake}")
        for bar in moment.bars:
            parts.append(f"  {', '.join(bar.words)}")
            parts += [f"    {low:>14} to {high:>14} mm  {text}" for low, high, text in bar.stretches]
    return "\n".join(parts) + "\n"


def as_html(name: str, story: str, found: Found) -> str:
    """A step of the joint as a page."""
    body = [f"<p>{escape(story)}</p>"]
    body += [f"<div class=claim><b>{escape(c)}</b> does not hold<br>{escape(says)}</div>" for c, says in claims(found)]
    body.append(f"<h2>Step</h2><p>{escape(event_in_words(found))}</p>")
    shown = moments(found)
    places = sorted({mm for moment in shown.values() for mm in moment.places})
    for when, moment in shown.items():
        body += [f"<h2>{when.capitalize()}: brake {escape(moment.brake)}</h2>", as_svg(moment, places)]
    return page(name, body)


def as_svg(moment: Strip, places: Sequence[int]) -> str:
    """One moment, places from left to right in their order."""
    x = {mm: LEFT + STEP // 2 + at * STEP for at, mm in enumerate(places)}
    width, height = LEFT + STEP * len(places), TOP + ROW * len(moment.bars) + 40
    below = height - 34
    parts = [f'<svg viewBox="0 0 {width} {height}" width="{width}" height="{height}" font-family="sans-serif">']
    parts += [_line(x[mm], below, "#ddd", 1) for mm in places]
    words = [_words(x[mm], height - 18, f"{mm} mm", "#666", "middle") for mm in places]
    for row, bar in enumerate(moment.bars):
        y = TOP + row * ROW
        words += [_words(8, y + 15 + 16 * line, each, "#222", "start") for line, each in enumerate(bar.words)]
        for low, high, text in bar.stretches:
            parts.append(_box(x[low], x[high], y))
            words.append(_name(x[low], x[high], y, text))
    for mm, text, colour, y in (
        (moment.head_mm, "head", "#1f77b4", TOP - 40),
        (moment.end_mm, "end of authority", DANGER, TOP - 20),
    ):
        parts.append(_line(x[mm], below, colour, 2.5))
        words.append(_words(x[mm], y, text, colour, "middle"))
    return "".join([*parts, *words]) + "</svg>"


def _box(low: int, high: int, y: int) -> str:
    """A stretch of track."""
    return f'<rect x="{low}" y="{y}" width="{max(high - low, 2)}" height="34" fill="#f3f6fa" stroke="#888"/>'


def _name(low: int, high: int, y: int, text: str) -> str:
    """The name of a block in its stretch, cut to the room there, or beside a stretch of no length."""
    if high <= low:
        return _words(low + 6, y + 22, f"{text} (0 mm)", "#222", "start")
    room = max(4, (high - low) // 8)
    return _words((low + high) / 2, y + 22, text if len(text) <= room else f"{text[: room - 1]}…", "#222", "middle")


def _line(x: int, below: int, colour: str, width: float) -> str:
    """A place, through all rows."""
    return f'<line x1="{x}" x2="{x}" y1="{TOP - 12}" y2="{below}" stroke="{colour}" stroke-width="{width}"/>'


def _words(x: float, y: float, text: str, colour: str, anchor: str) -> str:
    """Some words, in front of lines."""
    halo = 'paint-order="stroke" stroke="#fff" stroke-width="4"'
    return f'<text x="{x}" y="{y}" font-size="13" fill="{colour}" {halo} text-anchor="{anchor}">{escape(text)}</text>'
