"""One run of `heisoku fuzz`, from its options to its exit code."""

from __future__ import annotations

import signal
import sys
import threading
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import closing, contextmanager
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from types import FrameType

from rich.console import Console

from fuzz.campaign import summary
from fuzz.campaign.campaign import Plan, run
from fuzz.campaign.dask import Scheduled
from fuzz.campaign.files import said
from fuzz.campaign.identity import identity_of
from fuzz.campaign.merging import merge
from fuzz.campaign.pool import Pool, Workers
from fuzz.campaign.problems import CampaignError
from fuzz.campaign.sought import seek, unsought
from fuzz.campaign.store import Store
from fuzz.campaign.view import View
from fuzz.campaign.worker import work_on
from fuzz.targets.days import Days
from fuzz.targets.interlocking import Interlocking
from fuzz.targets.jolted import Jolted
from fuzz.targets.lines import Lines, runs_on
from fuzz.targets.link import LinkRuns
from fuzz.targets.rides import Rides
from fuzz.targets.target import Target
from fuzz.targets.walks import Walks
from models.commands import console
from models.days.systems import NAMES
from models.exit_codes import UNDECIDED
from models.layouts import BadInput
from proofs.records import about, write_json

SECONDS_AN_HOUR = 3600
FIRST_SEED = 1


@dataclass(frozen=True)
class Options:
    """What `heisoku fuzz` was given; ``targets``: by name, none for all; ``seed``: None for the folder's, or 1."""

    folder: Path
    layouts: tuple[Path, ...] = ()
    targets: tuple[str, ...] = ()
    seed: int | None = None
    batches: int | None = None
    hours: float | None = None
    workers: int = 1
    scheduler: str | None = None
    batch_seconds: float = 600.0
    json: Path | None = None


Making = Callable[[Sequence[Path]], Sequence[Target]]

OFFERED: Mapping[str, Making] = {
    "interlocking": lambda layouts: [Interlocking(path) for path in layouts],
    "jolted": lambda layouts: [Jolted(path) for path in layouts],
    "lines": lambda layouts: [Lines(path) for path in layouts if runs_on(path)],
    "walks": lambda layouts: [Walks()],
    "link": lambda layouts: [LinkRuns()],
    "rides": lambda layouts: [Rides()],
    "days": lambda layouts: [Days(name) for name in NAMES],
}
"""What --target names: each gives the targets that it stands for.  Those that need layouts stand in ON_LAYOUTS too."""
ON_LAYOUTS: frozenset[str] = frozenset({"interlocking", "jolted", "lines"})


def chosen(names: Sequence[str], layouts: Sequence[Path]) -> list[Target]:
    """Give the targets of some names; of none, all that can run.

    Raises:
        CampaignError: there is no such target, it needs a layout, or a layout is given that nothing runs on.
    """
    unknown = [name for name in names if name not in OFFERED]
    if unknown:
        raise CampaignError(f"--target {unknown[0]}: there is no such target; one of {', '.join(OFFERED)}")
    asked = names or [name for name in OFFERED if layouts or name not in ON_LAYOUTS]
    if layouts and not ON_LAYOUTS & set(asked):
        raise CampaignError(f"{layouts[0]}: {', '.join(asked)} runs on no layout; leave it out")
    if not layouts and ON_LAYOUTS & set(asked):
        raise CampaignError(f"--target {min(ON_LAYOUTS & set(asked))}: runs on layouts; name a layout file")
    try:
        without = [path for path in layouts if "lines" in names and not runs_on(path)]
        found = [target for name in dict.fromkeys(asked) for target in OFFERED[name](layouts)]
    except BadInput as bad:
        raise CampaignError(str(bad)) from bad
    if without:
        raise CampaignError(f"{without[0]}: has no track with room for a train; leave it out, or --target lines")
    return found


def go_on(options: Options, targets: Sequence[Target] | None = None) -> int:
    """Begin a campaign or go on with one, show it, and give the exit code; ``targets``: instead of those named.

    Raises:
        CampaignError: the options do not go together, or it cannot go on; what was finished is kept.
    """
    out, aside = console(sys.stdout), console(sys.stderr)
    if options.batches is None and options.hours is None:
        raise CampaignError("how long is not said; give --hours H, or --batches N")
    if options.hours is not None and not options.hours > 0:
        raise CampaignError(f"--hours {options.hours:g}: is no time; give more than 0")
    run_on = list(targets) if targets is not None else chosen(options.targets, options.layouts)
    twice = [each.name for each in run_on if [other.name for other in run_on].count(each.name) > 1]
    if twice:
        raise CampaignError(f"{twice[0]}: is to be run twice; name each layout once, under a name of its own")
    identity = identity_of(run_on)
    with Store(options.folder) as store, _stopping() as stopped:
        store.agree(identity)
        plan = plan_of(options, store)
        store.keep_layouts(options.layouts)
        store.note_start(datetime.now(UTC).isoformat(), plan.seed, about())
        if not store.canaries(plan.seed):
            store.note_canaries(plan.seed, unsought(run_on, plan.seed))
        store.write_traces()
        with View(store, out, aside, plan.seconds) as view:
            with closing(workers_of(options, run_on, identity, view.say)) as workers:
                run(store, run_on, plan, workers, view.update, stopped.is_set)
            rates = view.rates()
        if not stopped.is_set() and any(not each.batches for each in store.canaries(plan.seed)):
            came_to = seek(run_on, plan.seed, options.workers)
            store.note_canaries(plan.seed, [] if stopped.is_set() else came_to)
        code = UNDECIDED if stopped.is_set() else summary.verdict(store)
        finish(out, store, rates, code, options.json)
    if stopped.is_set():
        raise CampaignError(
            f"{options.folder}: interrupted, what was finished is kept; the same command goes on with it", UNDECIDED
        )
    return code


def put_together(folder: Path, folders: Sequence[Path], json: Path | None) -> int:
    """Merge campaigns into a new folder, show what they come to, and give the exit code.

    Raises:
        CampaignError: they cannot be merged.
    """
    if len(folders) < 2:
        raise CampaignError("--merge needs two folders of campaigns or more, and a new one with --out")
    merge(folder, folders)
    with Store(folder) as store:
        code = summary.verdict(store)
        finish(console(sys.stdout), store, {}, code, json)
    return code


def finish(out: Console, store: Store, rates: Mapping[str, float], code: int, json: Path | None) -> None:
    """Show what a campaign came to, and write its record."""
    summary.show(out, store, rates, code)
    if json:
        with said(json):
            write_json(json, summary.record(store, code))


def plan_of(options: Options, store: Store) -> Plan:
    """Tell the seed and how long.

    Raises:
        CampaignError: the folder's campaign has another seed.
    """
    seeds = store.seeds()
    seed = options.seed
    if seed is None:
        if len(seeds) > 1:
            raise CampaignError(f"{options.folder}: has seeds {', '.join(map(str, seeds))}; say with --seed which")
        seed = seeds[0] if seeds else FIRST_SEED
    if seeds and seed not in seeds:
        line = f"--seed {seed}: {options.folder} has seed {', '.join(map(str, seeds))}; leave it out, or name another"
        raise CampaignError(f"{line} folder and --merge them")
    return Plan(seed, options.batches, options.hours * SECONDS_AN_HOUR if options.hours is not None else None)


def workers_of(
    options: Options, targets: Sequence[Target], identity: Mapping[str, str], say: Callable[[str], object]
) -> Workers:
    """Start processes here, or reach those of a scheduler."""
    work = work_on(targets, identity)
    if options.scheduler is not None:
        return Scheduled(work, options.scheduler, options.batch_seconds, say)
    return Pool(work, options.workers, options.batch_seconds, say)


@contextmanager
def _stopping() -> Iterator[threading.Event]:
    """An interruption, or a request to end, is noted, and ends nothing in the middle; a second one does."""
    asked = threading.Event()

    def note(number: int, frame: FrameType | None) -> None:
        if asked.is_set():
            raise KeyboardInterrupt
        asked.set()

    before = {number: signal.signal(number, note) for number in (signal.SIGINT, signal.SIGTERM)}
    try:
        yield asked
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
