"""Two campaigns with the same identity become one."""

from __future__ import annotations

import json
from collections.abc import Sequence
from contextlib import ExitStack
from pathlib import Path

from fuzz.campaign.files import DATABASE
from fuzz.campaign.problems import CampaignError
from fuzz.campaign.sought import Sought
from fuzz.campaign.store import Store


def merge(into: Path, folders: Sequence[Path]) -> int:
    """Put campaigns together in a new folder; the same batch of the same seed counts once.  Gives the batches' number.

    Raises:
        CampaignError: a folder holds no campaign, or they follow from different things; nothing is made then.
    """
    for folder in folders:
        if not (folder / DATABASE).is_file():
            raise CampaignError(f"{folder}: holds no campaign; name folders that heisoku fuzz --out made")
    if (into / DATABASE).exists():
        raise CampaignError(f"{into}: holds a campaign already; name a new folder with --out")
    with ExitStack() as stack:
        sources = [stack.enter_context(Store(folder, alone=False)) for folder in folders]
        identity = sources[0].identity()
        for each in sources[1:]:
            each.agree(identity)
        result = stack.enter_context(Store(into))
        result.agree(identity)
        added = 0
        for each in sources:
            result.keep_layouts(sorted((each.folder / "layouts").glob("*")))
            for start in each.starts():
                when, begun_with = str(start.pop("at")), int(str(start.pop("seed")))
                result.note_start(when, begun_with, start)
            for seed in each.seeds():
                result.note_canaries(seed, worse(result.canaries(seed), each.canaries(seed)))
            for seed, target, number, weights in each.ask("SELECT seed, target, round, weights FROM rounds"):
                result.note_round(seed, target, number, json.loads(weights))
            added += sum(result.add_row(row, failures) for row, failures in each.rows())
        result.write_traces()
    return added


def worse(one: Sequence[Sought], other: Sequence[Sought]) -> list[Sought]:
    """What became of a seed's canaries in two campaigns: each was found only if both found it."""
    missed = {each.kind: each for each in one if not each.target}
    return [missed.get(each.kind, each) for each in other]
