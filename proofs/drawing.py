"""Draws a step, or a trace, so that a signalling engineer can follow it: on a terminal and as HTML with SVG."""

from __future__ import annotations

import inspect
import textwrap
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields, is_dataclass
from enum import Enum
from html import escape
from typing import Any

from kernel.names import Block, Read, Run, Train
from models.world.state import Site, System
from proofs.catalogue import STEPS
from proofs.counterexample import Broken, Counterexample, broken
from proofs.planted.trace import Trace
from proofs.sketch import Plan, Sign, in_words, plan, signs
from proofs.witnesses.changes import GONE, Came, Went, changes

CELL, HEIGHT, GAP = 250, 154, 34
"""Pixels: a block's width and height, and the room between two."""
COLUMNS = 34
"""Characters: a block's width on a terminal."""
COLOURS = ("#1f77b4", "#d95f02", "#2ca02c", "#9467bd")
DANGER = "#d62728"


@dataclass(frozen=True)
class Row:
    """One thing that changed: what it is, and its value before and after."""

    what: str
    before: str
    after: str


# ---- what happened, in words


def step_in_words(transition: str, event: Mapping[str, Any]) -> str:
    """A transition and its event."""
    return f"{transition} ({'; '.join(f'{_plain(name)} {value_in_words(value)}' for name, value in event.items())})"


def meaning_of(transition: str) -> str:
    """What a transition is, in a sentence."""
    return (inspect.getdoc(STEPS[transition]) or transition).splitlines()[0]


def run_of(event: Mapping[str, Any]) -> Run | None:
    """The run that an event speaks of."""
    return next((value for value in event.values() if isinstance(value, Run)), None)


def _plain(name: str) -> str:
    return name.replace("_", " ")


def value_in_words(value: Any) -> str:
    """A value of the state as it is read aloud."""
    if isinstance(value, Run):
        return in_words(value)
    if isinstance(value, Read):
        return f"tag {value.tag} with “{value.record}”"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, Enum):
        return str(value.value)
    if value is None or value is GONE:
        return "–"
    if isinstance(value, frozenset | set):
        return ", ".join(sorted(map(value_in_words, value))) or "none"
    if isinstance(value, tuple):
        return "(" + ", ".join(map(value_in_words, value)) + ")"
    if isinstance(value, Mapping):
        return "; ".join(f"{value_in_words(key)}: {value_in_words(item)}" for key, item in value.items()) or "none"
    if is_dataclass(value):
        parts = [(field.name, getattr(value, field.name)) for field in fields(value)]
        return ", ".join(f"{_plain(name)} {value_in_words(item)}" for name, item in parts)
    return str(value)


def rows(before: Any, after: Any, path: str = "") -> list[Row]:
    """Everything that differs, down to fields and keys."""
    found = []
    for name, change in changes(before, after).items():
        here = f"{path} › {value_in_words(name)}" if path else value_in_words(name)
        old, new = _at(before, name), _at(after, name)
        if isinstance(change, Came):
            found.append(Row(here, "", f"+ {value_in_words(change.members)}"))
        elif isinstance(change, Went):
            found.append(Row(here, value_in_words(change.members), "gone"))
        elif isinstance(change, Mapping) and old is not GONE and new is not GONE:
            found += rows(old, new, here)
        else:
            found.append(Row(here, value_in_words(old), value_in_words(new)))
    return found


def _at(state: Any, name: Any) -> Any:
    return getattr(state, name) if is_dataclass(state) else state.get(name, GONE)


# ---- on a terminal


def as_text(counterexample: Counterexample) -> str:
    """A counterexample for a terminal."""
    parts = [counterexample.label.upper(), "", *_claims(counterexample.broken, counterexample.raised), ""]
    run = run_of(counterexample.event)
    parts += _wrapped("step", step_in_words(counterexample.transition, counterexample.event))
    parts += [f"      {meaning_of(counterexample.transition)}"]
    parts += ["", "before", *diagram(counterexample.site, counterexample.before, run)]
    if counterexample.after is not None:
        parts += ["", "after", *diagram(counterexample.site, counterexample.after, run)]
        parts += ["", *table(rows(counterexample.before, counterexample.after))]
    return "\n".join(parts) + "\n"


def trace_as_text(title: str, story: str, trace: Trace) -> str:
    """A trace for a terminal: every step with what it changed, and the track at the end."""
    parts, run = [trace.label.upper(), "", title, *textwrap.wrap(story, 110), ""], main_run(trace)
    if trace.moves:
        parts += ["at the start", *diagram(trace.site, trace.moves[0].before, run), ""]
    for number, move in enumerate(trace.moves, 1):
        parts += _wrapped(f"{number:3}", step_in_words(move.transition, move.event))
    if trace.moves:
        last = trace.moves[-1]
        parts += ["", "before the last step", *diagram(trace.site, last.before, run)]
        parts += ["", "after it", *diagram(trace.site, last.after, run), "", *table(rows(last.before, last.after))]
        parts += ["", *_claims([broken(name) for name in last.broken], "")]
    if trace.stopped is not None:
        parts += ["", f"stopped at {trace.stopped}"]
    return "\n".join(parts) + "\n"


def main_run(trace: Trace) -> Run | None:
    """The first run of a route in a trace."""
    runs = (run_of(move.event) for move in trace.moves)
    return next((run for run in runs if run is not None and run.route in trace.site.layout.routes), None)


def _claims(claims: Sequence[Broken], raised: str) -> list[str]:
    found = [f"raises: {raised}"] if raised else []
    for claim in claims:
        found += [f"does not hold: {claim.invariant} ({claim.file}:{claim.line})", f"    {claim.meaning}"]
    return found


def _wrapped(label: str, text: str) -> list[str]:
    return textwrap.wrap(text, 110, initial_indent=f"{label}  ", subsequent_indent=" " * (len(label) + 2))


def diagram(site: Site, system: System, run: Run | None = None) -> list[str]:
    """The track as boxes, column by column along the line."""
    shown = signs(site, system)
    placed = plan(site, shown, run)
    by_place = {place: shown[block] for block, place in placed.at.items()}
    found: list[str] = []
    for lane in range(placed.lanes):
        boxes = [_box(by_place.get((column, lane)), placed) for column in range(placed.columns)]
        height = max(map(len, boxes))
        filled = [[*box, *[""] * (height - len(box))] for box in boxes]
        found += ["".join(line.ljust(COLUMNS) for line in lines).rstrip() for lines in zip(*filled, strict=True)]
    return found


def _box(sign: Sign | None, placed: Plan) -> list[str]:
    """A block's box; its neighbours are named, since lanes may lie apart."""
    if sign is None:
        return []
    width = COLUMNS - 4
    near = [other if one == sign.block else one for one, other in placed.joined if sign.block in (one, other)]
    lines = [line for text in sign.lines() for line in textwrap.wrap(text, width - 2)]
    lines += textwrap.wrap(f"adjoins {', '.join(near)}", width - 2) if near else []
    edge = "#" if sign.in_danger else "|"
    return [
        f"+{'=' * width}+" if sign.trains else f"+{'-' * width}+",
        *(f"{edge} {line.ljust(width - 2)} {edge}" for line in lines),
        f"+{'-' * width}+",
    ]


def table(changed: Sequence[Row]) -> list[str]:
    """What changed, in three columns."""
    wide = max([len(row.what) for row in changed] + [7])
    found = [f"{'changed'.ljust(wide)}  before → after"]
    for row in changed:
        text = f"{row.before or '–'} → {row.after}"
        found += textwrap.wrap(
            text, 110, initial_indent=row.what.ljust(wide) + "  ", subsequent_indent=" " * (wide + 2)
        )
    return found


# ---- as HTML


STYLE = """
body{font:14px/1.45 sans-serif;color:#222;max-width:1180px;margin:24px auto;padding:0 16px}
h1{font-size:20px}h2{font-size:15px;margin:22px 0 6px}.label{color:#666}
.claim{border-left:4px solid #d62728;padding:4px 10px;margin:8px 0;background:#fdf1f1}
table{border-collapse:collapse;width:100%}td,th{border-bottom:1px solid #ddd;padding:3px 8px;text-align:left;
vertical-align:top}code{font:12px monospace}svg{max-width:100%;height:auto}ol li{margin:1px 0}
"""


def as_html(counterexample: Counterexample) -> str:
    """A counterexample as a page."""
    body = [f"<p class=label>{escape(counterexample.label)}</p>"]
    body += [_claim_html(claim) for claim in counterexample.broken]
    body += [f"<div class=claim>raises {escape(counterexample.raised)}</div>"] if counterexample.raised else []
    step, run = step_in_words(counterexample.transition, counterexample.event), run_of(counterexample.event)
    body.append(f"<h2>Step</h2><p>{escape(meaning_of(counterexample.transition))}<br>{escape(step)}</p>")
    body += _moment("Before", counterexample.site, counterexample.before, run)
    if counterexample.after is not None:
        body += _moment("After", counterexample.site, counterexample.after, run)
        body.append(_table_html(rows(counterexample.before, counterexample.after)))
    return page(f"{counterexample.transition}: {counterexample.finding}", body)


def trace_as_html(title: str, story: str, trace: Trace) -> str:
    """A trace as a page: the start, every step, the last step drawn."""
    body = [f"<p>{escape(story)}</p><p class=label>{escape(trace.label)}</p>"]
    run = main_run(trace)
    if trace.moves:
        last = trace.moves[-1]
        body += [_claim_html(broken(name)) for name in last.broken]
        body += _moment("At the start", trace.site, trace.moves[0].before, run)
        steps = "".join(f"<li>{escape(step_in_words(move.transition, move.event))}</li>" for move in trace.moves)
        body += [f"<h2>Steps</h2><ol>{steps}</ol>", *_moment("Before the last step", trace.site, last.before, run)]
        body += [*_moment("After it", trace.site, last.after, run), _table_html(rows(last.before, last.after))]
    if trace.stopped is not None:
        body.append(f"<p><b>Stopped at {escape(str(trace.stopped))}</b></p>")
    return page(title, body)


def page(title: str, body: Sequence[str]) -> str:
    """A whole page."""
    head = f"<meta charset=utf-8><title>{escape(title)}</title><style>{STYLE}</style>"
    return (
        f"<!doctype html><html lang=en><head>{head}</head><body><h1>{escape(title)}</h1>{''.join(body)}</body></html>\n"
    )


def _claim_html(claim: Broken) -> str:
    place = f"<code>{escape(claim.file)}:{claim.line}</code>"
    return f"<div class=claim><b>{escape(claim.invariant)}</b> does not hold ({place})<br>{escape(claim.meaning)}</div>"


def _moment(title: str, site: Site, system: System, run: Run | None) -> list[str]:
    return [f"<h2>{escape(title)}</h2>", as_svg(site, system, run)]


def _table_html(changed: Sequence[Row]) -> str:
    cells = "".join(
        f"<tr><td>{escape(row.what)}<td>{escape(row.before)}<td>{escape(row.after)}</tr>" for row in changed
    )
    return f"<h2>What changed</h2><table><tr><th>component<th>before<th>after</tr>{cells}</table>"


# ---- as SVG


def as_svg(site: Site, system: System, run: Run | None = None) -> str:
    """The track at one moment; ``run`` goes to the right."""
    shown = signs(site, system)
    placed = plan(site, shown, run)
    trains = sorted(site.layout.fleet)
    colours = {train: COLOURS[index % len(COLOURS)] for index, train in enumerate(trains)}
    parts = [_join_svg(placed, one, other) for one, other in placed.joined]
    parts += [_block_svg(sign, placed, colours) for sign in shown.values()]
    width, height = placed.columns * (CELL + GAP) + GAP, placed.lanes * (HEIGHT + GAP) + GAP
    size = f'width="{width}" height="{height}" viewBox="0 0 {width} {height}"'
    style = "<style>text{font:12px sans-serif;fill:#222}.name{font-weight:bold}.bad{fill:#d62728}</style>"
    ground = '<rect width="100%" height="100%" fill="#fff"/>'
    return f'<svg xmlns="http://www.w3.org/2000/svg" {size}>{style}{ground}{"".join(parts)}</svg>'


def _corner(placed: Plan, block: Block) -> tuple[int, int]:
    column, lane = placed.at[block]
    return GAP + column * (CELL + GAP), GAP + lane * (HEIGHT + GAP)


def _join_svg(placed: Plan, one: Block, other: Block) -> str:
    """Track from one block to the next."""
    (x, y), (to_x, to_y) = sorted((_corner(placed, one), _corner(placed, other)))
    below = (x + CELL / 2, y + HEIGHT, to_x + CELL / 2, to_y)
    ends = below if x == to_x else (x + CELL, y + 30, to_x, to_y + 30)
    return '<line x1="{}" y1="{}" x2="{}" y2="{}" stroke="#555" stroke-width="4"/>'.format(*ends)


def _block_svg(sign: Sign, placed: Plan, colours: Mapping[Train, str]) -> str:
    """A block: the rail, cars on it, and below it who holds it and how its points lie."""
    x, y = _corner(placed, sign.block)
    edge = DANGER if sign.in_danger else "#999"
    dash = ' stroke-dasharray="6 4"' if sign.lost else ""
    box = f'<rect x="{x}" y="{y}" width="{CELL}" height="{HEIGHT}" rx="4" fill="#fafafa" stroke="{edge}"'
    parts = [
        f'{box} stroke-width="{3 if sign.in_danger else 1}"{dash}/>',
        f'<line x1="{x}" y1="{y + 30}" x2="{x + CELL}" y2="{y + 30}" stroke="#555" stroke-width="4"/>',
        _text(x + 6, y + 15, str(sign.block), "name"),
    ]
    for index, car in enumerate(sign.cars.split(", ") if sign.cars else []):
        colour = colours.get(Train(car.split(" of ")[-1]), "#777")
        at = x + CELL - 62 - 62 * index
        parts.append(f'<rect x="{at}" y="{y + 20}" width="56" height="19" rx="3" fill="{colour}"/>')
        parts.append(f'<text x="{at + 28}" y="{y + 34}" text-anchor="middle" style="fill:#fff">{escape(car)}</text>')
    for index, line in enumerate(fitting(sign.notes)):
        kind = "bad" if "UNLOCKED" in line or (sign.in_danger and line == "held for nobody") else "note"
        parts.append(_text(x + 6, y + 56 + 15 * index, line if len(line) < 44 else line[:43] + "…", kind))
    return "".join(parts)


def fitting(notes: Sequence[str], most: int = 7) -> list[str]:
    """The notes that a box has room for; the last line says how many more there are."""
    shown = list(notes[:most])
    return shown if len(notes) <= most else [*shown[:-1], f"and {len(notes) - most + 1} more"]


def _text(x: float, y: float, text: str, kind: str) -> str:
    return f'<text x="{x}" y="{y}" class="{kind}">{escape(text)}</text>'
