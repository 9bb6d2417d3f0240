"""``python -m proofs.mutants [--only PATTERN] [--sample N]``: try every mutant, and check the class of each survivor.

Exit code 0 if each is killed or stands in the table with its class checked, 1 if there is a hole.
``heisoku mutate`` does the same, and writes a record of it.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections import Counter
from typing import Any

from proofs.mutants.record import Trials
from proofs.mutants.trying import chosen, try_all


def main() -> int:
    """Try the mutants chosen that have no verdict yet, and give the sum."""
    parser = argparse.ArgumentParser(prog="python -m proofs.mutants", description=__doc__)
    parser.add_argument("--only", default="", metavar="PATTERN", help="a regular expression on the names of mutants")
    parser.add_argument("--sample", type=int, metavar="N", help="try N of them, always the same")
    parser.add_argument("--jobs", type=int, default=2, metavar="N", help="processes")
    given = parser.parse_args()
    began = time.perf_counter()
    verdicts = try_all(chosen(given.only, given.sample), given.jobs, Trials(), tell)
    return told(verdicts, time.perf_counter() - began)


def tell(done: int, of: int, name: str, verdict: dict[str, Any]) -> None:
    """Tell of one trial."""
    print(f"{done}/{of} {line(name, verdict)}", file=sys.stderr, flush=True)


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
