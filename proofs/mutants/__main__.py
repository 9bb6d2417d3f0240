"""``python -m proofs.mutants [--only PATTERN] [--sample N]``: try every mutant, and check the class of each survivor.

Exit code 0 if each is killed or stands in the table with its class checked, 1 if there is a hole.
"""

from __future__ import annotations

import argparse
import random
import re
import sys
import time
from collections import Counter
from concurrent.futures import ProcessPoolExecutor, as_completed
from typing import Any

from proofs.mutants.classes import SERVICE, objection, table
from proofs.mutants.record import Trials
from proofs.mutants.targets import mutants, of_interlocking, theories_of, transitions_of
from proofs.mutants.trial import tried


def trial(name: str) -> tuple[str, dict[str, Any]]:
    """Try one mutant."""
    return name, tried(mutants()[name]).record()


def killed(name: str, outcome: str) -> bool:
    """Tell whether a mutant needs no class.

    In the interlocking what only a witness kills stands in the table, with what is lost; beside it a
    witness is enough, since its docstring says so.
    """
    function = mutants()[name].function
    return outcome == "counterexample" or (
        outcome == "witness" and not any(map(of_interlocking, transitions_of(function)))
    )


def judged(name: str, is_killed: bool) -> tuple[str, str, str]:
    """The class of a mutant, and what is wrong with it if anything is."""
    entry = table().get(name)
    if is_killed:
        idle = entry is not None and entry.kind != SERVICE
        return name, "", "killed: it needs no class" if idle else ""
    return (name, entry.kind, objection(entry)) if entry else (name, "", "stands in no class")


def chosen(only: str, sample: int | None) -> list[str]:
    """The mutants to try."""
    names = [name for name in mutants() if re.search(only, name)]
    if sample is not None and sample < len(names):
        names = sorted(random.Random(sample).sample(names, sample), key=names.index)
    return names


def main() -> int:
    """Try the mutants chosen that have no verdict yet, and give the sum."""
    parser = argparse.ArgumentParser(prog="python -m proofs.mutants", description=__doc__)
    parser.add_argument("--only", default="", metavar="PATTERN", help="a regular expression on the names of mutants")
    parser.add_argument("--sample", type=int, metavar="N", help="try N of them, always the same")
    parser.add_argument("--jobs", type=int, default=2, metavar="N", help="processes")
    given = parser.parse_args()
    names = chosen(given.only, given.sample)
    trials = Trials()
    began, todo = time.perf_counter(), [name for name in names if name not in trials.verdicts]
    with ProcessPoolExecutor(given.jobs) as pool:
        for done, future in enumerate(as_completed([pool.submit(trial, name) for name in todo]), 1):
            name, verdict = future.result()
            trials.note(name, [theory.name for theory in theories_of(mutants()[name].function)], verdict)
            print(f"{done}/{len(todo)} {line(name, verdict)}", file=sys.stderr, flush=True)
        dead = [killed(name, trials.verdicts[name]["outcome"]) for name in names]
        for name, kind, wrong in pool.map(judged, names, dead):
            trials.verdicts[name] |= {"class": kind, "objection": wrong}
    trials.keep()
    return told({name: trials.verdicts[name] for name in names}, time.perf_counter() - began)


def line(name: str, verdict: dict[str, Any]) -> str:
    """One verdict on one line."""
    return f"{verdict['outcome']:14} {name[:110]} | {verdict['finding'][:90]}"


def told(verdicts: dict[str, dict[str, Any]], seconds: float) -> int:
    """Print the sum and the holes."""
    count = Counter(verdict["outcome"] for verdict in verdicts.values())
    classes = Counter(verdict["class"] for verdict in verdicts.values() if verdict.get("class"))
    holes = {name: verdict for name, verdict in verdicts.items() if verdict.get("objection")}
    for name, verdict in holes.items():
        print(f"hole: {name}\n      {verdict['objection']}")
    print(f"{len(verdicts)} mutants in {seconds:.0f} s: {dict(count)}; classes {dict(classes)}; {len(holes)} holes")
    return 1 if holes else 0


if __name__ == "__main__":
    raise SystemExit(main())
