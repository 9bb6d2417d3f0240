"""What two campaigns must have in common to be held for equal, and how far one is."""

from __future__ import annotations

import time
from dataclasses import replace
from pathlib import Path

from fuzz.campaign.files import DATABASE
from fuzz.campaign.problems import CampaignError
from fuzz.campaign.store import Store

TABLES = {
    "batches": "seed, target, number, status, weights, traces, steps, counts, covered, pairs, sketch, digest",
    "rounds": "*",
    "counts": "*",
    "covered": "*",
    "pairs": "*",
    "sketches": "*",
    "failures": "*",
}


def everything(folder: Path) -> dict[str, object]:
    """All that a campaign's results are: every table but times, the totals, and the traces' files."""
    with Store(folder) as store:
        found: dict[str, object] = {
            table: sorted(store.ask(f"SELECT {columns} FROM {table}")) for table, columns in TABLES.items()
        }
        found["totals"] = {target: replace(one, seconds=0.0) for target, one in store.totals().items()}
    found["traces"] = {path.name: path.read_text("utf-8") for path in (folder / "traces").glob("*")}
    return found


def batches_in(folder: Path) -> int:
    """So many are in the store; none in one that is only being begun."""
    if not (folder / DATABASE).exists():
        return 0
    try:
        with Store(folder, alone=False) as store:
            return sum(one.batches for one in store.totals().values())
    except CampaignError as error:
        if "holds no campaign yet" not in str(error):
            raise
        return 0


def wait_for_batches(folder: Path, batches: int = 1) -> None:
    """Wait until so many are in the store."""
    until = time.monotonic() + 60
    while batches_in(folder) < batches:
        assert time.monotonic() < until
        time.sleep(0.05)
