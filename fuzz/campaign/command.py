"""`heisoku fuzz`: run a campaign, go on with one, or put several together."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from fuzz.campaign.problems import CampaignError
from models.commands import EVERY_CORE, Jobs, Json, Scheduler, complain, writable

BATCH_SECONDS = 600.0
"""Far more than any batch takes, compilation of its target included."""


Places = Annotated[
    list[Path] | None,
    typer.Argument(metavar="LAYOUT", help="Layout files; with --merge the folders of campaigns.", show_default=False),
]
Folder = Annotated[Path | None, typer.Option(metavar="DIR", help="The campaign's folder.", show_default=False)]
Hours = Annotated[float | None, typer.Option(metavar="H", help="So long at most.", show_default=False)]
Batches = Annotated[
    int | None, typer.Option(metavar="N", min=1, help="So many batches of each target.", show_default=False)
]
Seed = Annotated[
    int | None,
    typer.Option(
        metavar="S", min=0, max=2**31 - 1, help="What everything is drawn from.", show_default="1, or the folder's"
    ),
]
Targets = Annotated[
    list[str] | None, typer.Option(metavar="T", help="What to run; may be repeated.", show_default="all")
]
BatchSeconds = Annotated[float, typer.Option(metavar="S", min=0.1, help="A batch that takes longer hangs.")]
Merge = Annotated[bool, typer.Option("--merge", help="Put campaigns together in a new folder.")]


def fuzz(
    places: Places = None,
    out: Folder = None,
    hours: Hours = None,
    batches: Batches = None,
    workers: Jobs = EVERY_CORE,
    seed: Seed = None,
    target: Targets = None,
    scheduler: Scheduler = None,
    batch_seconds: BatchSeconds = BATCH_SECONDS,
    merge: Merge = False,
    json: Json = None,
) -> None:
    """Run a campaign: batches of faulty traffic through the kernel, its claims as oracles, finished work kept.

    The same command goes on with a campaign that was ended, however it was; --batches N ends it after the same
    batches, whatever happened in between.  `heisoku fuzz --merge DIR DIR --out DIR` puts campaigns together.
    A failure is 1, and so is a batch that hangs; an interruption is 3.

    Examples:
    * `heisoku fuzz --target link --batches 2 --out out/fuzz`
    """
    from fuzz.campaign.session import Options, go_on, put_together

    writable(json, given=places or ())
    try:
        if out is None:
            raise CampaignError("--out is missing; name the campaign's folder")
        if merge:
            code = put_together(out, places or [], json)
        else:
            code = go_on(
                Options(
                    folder=out,
                    layouts=tuple(places or ()),
                    targets=tuple(target or ()),
                    seed=seed,
                    batches=batches,
                    hours=hours,
                    workers=workers,
                    scheduler=scheduler,
                    batch_seconds=batch_seconds,
                    json=json,
                )
            )
    except CampaignError as error:
        complain(str(error))
        code = error.code
    raise typer.Exit(code)
