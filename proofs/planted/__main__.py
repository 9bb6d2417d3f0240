"""Draw every planted fault, as text and as a page: ``python -m proofs.planted [FOLDER]``."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path

from proofs import drawing
from proofs.counterexample import search
from proofs.finite import SMALL, World
from proofs.planted import carried, kilometrage
from proofs.planted.attacked import UNGUARDED
from proofs.planted.protocols import PROTOCOLS
from proofs.planted.weakenings import WEAKENINGS

FOLDER = Path("out/planted")


def main(arguments: Sequence[str] | None = None) -> int:
    """Draw them into the folder that is named, or that one; 1 if some were not refuted."""
    parser = argparse.ArgumentParser(prog="python -m proofs.planted", description=__doc__)
    parser.add_argument("folder", nargs="?", type=Path, default=FOLDER, help="where to; out/planted if not said")
    return draw(parser.parse_args(arguments).folder)


def draw(folder: Path) -> int:
    """Draw them there; 1 if some were not refuted."""
    folder.mkdir(parents=True, exist_ok=True)
    missed = 0
    for protocol in PROTOCOLS:
        fault, trace = protocol.fault, protocol.trace(protocol.fault.instead)
        missed += protocol.broken not in trace.broken
        write(folder, fault.name, drawing.trace_as_text, drawing.trace_as_html, (fault.name, fault.story, trace))
        print(f"{fault.name}: {trace.label}, {', '.join(trace.broken) or 'not refuted'}")
    for fault in WEAKENINGS:
        found = search(World(SMALL, fault.without), fault.transition, fault.sources).found
        missed += found is None
        if found is not None:
            write(folder, fault.name, drawing.as_text, drawing.as_html, (found,))
        print(f"{fault.name}: {found.finding if found else 'not refuted'}")
    missed += draw_attacks(folder)
    return 1 if missed else 0


def draw_attacks(folder: Path) -> int:
    """Draw each attack without its guard, on every station made for it, and count those that come to nothing."""
    missed = 0
    for attack in UNGUARDED:
        for name, trace in attack.drawn().items():
            missed += attack.broken not in trace.broken
            write(folder, name, drawing.trace_as_text, drawing.trace_as_html, (name, attack.fault.story, trace))
            print(f"{name}: {trace.label}, {', '.join(trace.broken) or 'comes to nothing'}")
    in_mm = carried.drawn()
    for name, found in in_mm.items():
        write(folder, name, kilometrage.as_text, kilometrage.as_html, (name, carried.CARRIED.story, found))
        print(f"{name}: {found.finding}")
    return missed + (carried.CARRIED.name not in in_mm)


def write(folder: Path, name: str, as_text: object, as_html: object, given: tuple[object, ...]) -> None:
    """Write one drawing in both forms."""
    assert callable(as_text)
    assert callable(as_html)
    place = folder / name.replace(" ", "_")
    place.with_suffix(".txt").write_text(as_text(*given), encoding="utf-8")
    place.with_suffix(".html").write_text(as_html(*given), encoding="utf-8")


if __name__ == "__main__":
    raise SystemExit(main())
