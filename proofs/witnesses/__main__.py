"""Lists and replays every witness: ``python -m proofs.witnesses``."""

from __future__ import annotations

import inspect
import sys
import time

from rich.console import Console
from rich.table import Table

from kernel.refusal import Refusal
from proofs.catalogue import INVARIANTS, STEPS
from proofs.witnesses.registry import WITNESSES, refused_by, shown_by
from proofs.witnesses.scenario import STEPS as ALL_STEPS
from proofs.witnesses.scenario import Scenario, WitnessFailed


def main() -> int:
    """Replay all, print one line each, and what they show together; 1 if any fails."""
    table = Table(title="witnesses", show_lines=False)
    for column in ("witness", "accepted", "refused", "shows"):
        table.add_column(column, justify="right" if column in {"accepted", "refused"} else "left")
    played: dict[str, Scenario] = {}
    began, failed = time.perf_counter(), 0
    for name, witness in WITNESSES.items():
        says = inspect.getdoc(witness) or ""
        try:
            played[name] = witness(ALL_STEPS)
        except WitnessFailed as failure:
            failed += 1
            table.add_row(name, "failed", "", str(failure))
            continue
        accepted = sum(taken.accepted for taken in played[name].taken)
        table.add_row(name, str(accepted), str(len(played[name].taken) - accepted), says.splitlines()[0])
    out = Console(width=None if sys.stdout.isatty() else 160)
    out.print(table)
    steps = sum(len(scenario.taken) for scenario in played.values())
    shown, given = frozenset(shown_by(played)) & frozenset(STEPS), refused_by(played)
    out.print(
        f"{len(played)} witnesses, {failed} failed; {steps} steps with {len(INVARIANTS)} invariants after each; "
        f"{len(shown)} of {len(STEPS)} transitions shown with their effect; "
        f"{len(given)} of {len(Refusal)} refusals given; {time.perf_counter() - began:.1f} s"
    )
    for missing in [*sorted(frozenset(STEPS) - shown), *(why.name for why in Refusal if why not in given)]:
        out.print(f"not shown: {missing}")
    return 1 if failed or len(shown) < len(STEPS) or len(given) < len(Refusal) else 0


if __name__ == "__main__":
    sys.exit(main())
