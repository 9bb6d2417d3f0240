"""A program that runs a campaign on the quick target: folder, batches, seconds a batch, and a scheduler's address."""

from __future__ import annotations

import sys
from pathlib import Path

from fuzz.campaign.problems import CampaignError
from fuzz.campaign.session import Options, go_on
from tests.fuzz.campaign.quick import Quick


def main(folder: str, batches: str, seconds: str, scheduler: str | None = None) -> int:
    """Run it, and give its exit code as `heisoku fuzz` does."""
    options = Options(Path(folder), batches=int(batches), workers=2, scheduler=scheduler)
    try:
        return go_on(options, [Quick(seconds=float(seconds), breaks=7)])
    except CampaignError as error:
        print(error, file=sys.stderr)
        return error.code


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
