"""`heisoku manifest` and `heisoku verify`: bind a folder of records to its commit, and see whether it still is."""

from __future__ import annotations

import secrets
from collections.abc import Iterator
from pathlib import Path
from typing import Annotated

import typer

from models.commands import refuse, tell
from models.exit_codes import DOES_NOT_HOLD, HOLDS, WORDS
from proofs.records import write_whole

SAMPLE = 30

Folder = Annotated[Path, typer.Argument(metavar="DIR", help="The folder of records.", show_default=False)]


def manifest(folder: Folder) -> None:
    """Write the hashes of all records in a folder, of the sources and their commit, to manifest.json there.

    Examples:
    * `heisoku manifest out`
    """
    from evidence.manifest.hashes import ALWAYS, NAME, made

    _there(folder)
    found = made(folder)
    missing = [name for name in ALWAYS if name not in found.records]
    if missing:
        refuse(f"{folder}: has no {missing[0]}; make assure makes it")
    write_whole(folder / NAME, found.text().encode())
    tell(f"{folder / NAME}: {len(found.records):,} files of commit {found.commit or 'unknown'}")


def verify(
    folder: Folder,
    sample: Annotated[int, typer.Option(metavar="N", min=0, help="So many figures to make again.")] = SAMPLE,
    seed: Annotated[
        int | None,
        typer.Option(metavar="S", min=0, max=2**31 - 1, help="What they are drawn from.", show_default="a new one"),
    ] = None,
) -> None:
    """Compare a folder of records with its manifest, and make a random sample of what they say again.

    What is changed, missing, foreign, or of another commit is named (1).

    Examples:
    * `heisoku verify out --sample 30`
    """
    from evidence.manifest.comparing import compared
    from evidence.manifest.hashes import ManifestError, read_manifest

    _there(folder)
    try:
        known = read_manifest(folder)
    except ManifestError as error:
        refuse(str(error))
    findings = [each.line for each in compared(folder, known)]
    for line in findings:
        tell(line)
    tell(f"{len(known.records):,} files of commit {known.commit or 'unknown'}: {len(findings)} findings")
    chosen = secrets.randbelow(2**31) if seed is None else seed
    again = list(_again(folder, chosen, sample)) if sample else []
    wrong = len(findings) + sum(not same for same in again)
    tell(f"{len(again)} figures made again with seed {chosen}, {again.count(False)} otherwise than recorded")
    verdict = DOES_NOT_HOLD if wrong else HOLDS
    tell(WORDS[verdict])
    raise typer.Exit(verdict)


def _again(folder: Path, seed: int, sample: int) -> Iterator[bool]:
    """Make a sample of figures again, once the solvers have noticed their canaries; tell of each."""
    from evidence.catalogue import catalogue
    from evidence.manifest.again import drawn, figures, made_again
    from evidence.records.reading import read
    from proofs.canaries import seen

    for each in seen(("z3", "cvc5")):
        if not each["noticed"]:
            tell(f"solver: {each['solver']} answers {each['answer']} to what does not hold, {each['canary']}")
            yield False
    records = read(folder, frozenset(each.record for each in catalogue().values()))
    for figure in drawn(list(figures(folder, records)), seed, sample):
        result = made_again(figure)
        tell(f"{'again' if result.same else 'DIFFERS'}: {figure.kind}: {figure.what}: {result.says}")
        yield result.same


def _there(folder: Path) -> None:
    if not folder.is_dir():
        refuse(f"{folder}: is no folder; name that of the records, out")
