"""`heisoku manifest` and `heisoku verify`: bind a folder of records to its commit, and see whether it still is."""

from __future__ import annotations

import secrets
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from models.commands import EVERY_CORE, Jobs, progress, refuse, tell
from models.exit_codes import DOES_NOT_HOLD, HOLDS, UNDECIDED, WORDS
from models.streams import write_whole

if TYPE_CHECKING:
    from evidence.manifest.finding import Finding
    from evidence.manifest.hashes import Manifest
    from evidence.records.reading import Records

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
    jobs: Jobs = EVERY_CORE,
) -> None:
    """Compare a folder of records with its manifest and with the sources, and make some of it again.

    Without a solver: every obligation is laid out anew and its hash compared, every witness is played, and what each
    record must name by the sources is there, no less and no more.  Then Z3 is asked every obligation once, which
    shows each that is said to be proved and is not; and of everything else a sample is made again, drawn from the seed.
    What is not as it should be is named (1); without a record of proofs or layouts nothing is shown (3); what is of
    a part, or compared with nothing, is told.  --sample 0 makes nothing again.

    Examples:
    * `heisoku verify out --sample 30`
    """
    from evidence.manifest.comparing import compared
    from evidence.manifest.expected import NAMES, bare
    from evidence.manifest.finding import lines
    from evidence.manifest.hashes import ManifestError, read_manifest
    from evidence.records.reading import read

    _there(folder)
    try:
        known = read_manifest(folder)
    except ManifestError as error:
        refuse(str(error))
    findings, records = list(compared(folder, known)), read(folder, NAMES)
    findings += _against_the_sources(folder, records, known, jobs)
    for line in lines(findings):
        tell(line)
    tell(f"{len(known.records):,} files of commit {known.commit or 'unknown'}: {len(findings)} findings")
    chosen = secrets.randbelow(2**31) if seed is None else seed
    again = list(_again(folder, chosen, sample, jobs)) if sample else []
    wrong = len(findings) + sum(not same for same in again)
    tell(f"{len(again):,} figures made again with seed {chosen}, {again.count(False)} otherwise than recorded")
    missing = bare(records)
    if missing:
        tell(f"nothing is shown without {' and '.join(missing)}; make assure makes all records")
    verdict = DOES_NOT_HOLD if wrong else UNDECIDED if missing else HOLDS
    tell(WORDS[verdict])
    raise typer.Exit(verdict)


def _against_the_sources(folder: Path, records: Records, known: Manifest, jobs: int) -> list[Finding]:
    """Compare the records with all that the sources say of them; tell what is not there, and what is of a part."""
    from evidence.manifest import expected, expected_pages
    from evidence.manifest.laying_out import all_laid_out

    with progress("laid out") as step:
        laid_out = all_laid_out(jobs, step)
    played = list(expected.played(jobs))
    found = [
        *expected.told(records, known.commit, known.made_at),
        *expected.by_proofs(records, laid_out),
        *expected.by_runs(records),
        *expected_pages.written(folder, records, known),
    ]
    for line in (*expected.lacking(records), *expected_pages.beside(folder, records)):
        tell(f"not shown: {line}")
    tell(f"{len(laid_out):,} obligations laid out anew, {len(expected.plays()):,} witnesses played, no solver asked")
    return [*found, *played]


def _again(folder: Path, seed: int, sample: int, jobs: int) -> Iterator[bool]:
    """Put every obligation to Z3, and make a sample of figures again, once the solvers have noticed their canaries."""
    from evidence.catalogue import catalogue
    from evidence.manifest.again import asked_again, drawn, figures, made_again, never, rarely
    from evidence.records.reading import read
    from proofs.canaries import seen

    for each in seen(("z3", "cvc5")):
        if not each["noticed"]:
            tell(f"solver: {each['solver']} answers {each['answer']} to what does not hold, {each['canary']}")
            yield False
    records = read(folder, frozenset(each.record for each in catalogue().values()))
    with progress("asked again") as step:
        for result in asked_again(records, jobs, step):
            if not result.same:
                tell(f"DIFFERS: obligation: {result.says}")
            yield result.same
    pool = list(figures(folder, records))
    chosen = drawn(pool, seed, sample)
    rare = rarely(pool, chosen)
    if rare:
        tell(f"drawn with seed {seed}: {rare}; one that is made up is shown by luck alone")
    for line in never(folder, records):
        tell(f"too large to be made again, so not shown to be true: {line}")
    for figure in chosen:
        result = made_again(figure)
        tell(f"{'again' if result.same else 'DIFFERS'}: {figure.kind}: {figure.what}: {result.says}")
        yield result.same


def _there(folder: Path) -> None:
    if not folder.is_dir():
        refuse(f"{folder}: is no folder; name that of the records, out")
