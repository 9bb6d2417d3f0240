"""What a campaign is: everything that its results follow from, but its seed."""

from __future__ import annotations

import platform
from collections.abc import Mapping, Sequence
from importlib import metadata

from fuzz.campaign.problems import CampaignError
from fuzz.targets.target import Target, digest_of_sources

FORMAT = "heisoku campaign 1"
BATCHES_A_ROUND = 16
"""Fixed, so that weights follow from the same results however many processes there are."""
COMPUTING = ("numpy", "numba", "llvmlite")
"""Packages whose version may change what is computed."""

Identity = Mapping[str, str]


def identity_of(targets: Sequence[Target]) -> dict[str, str]:
    """Tell what results follow from, each thing by a name; a target's are ``target/thing``.

    Raises:
        CampaignError: a file that a target is made from cannot be read.
    """
    found = {
        "format": FORMAT,
        "batches a round": str(BATCHES_A_ROUND),
        "python": platform.python_version(),
        **{name: version_of(name) for name in COMPUTING},
        "guidance": digest_of_sources("fuzz/campaign/guidance.py"),
    }
    for target in targets:
        found |= {f"{target.name}/{thing}": value for thing, value in of_target(target).items()}
    return found


def of_target(target: Target) -> dict[str, str]:
    """Tell what a target's results follow from.

    Raises:
        CampaignError: a file that it is made from cannot be read.
    """
    try:
        return {"families": ", ".join(target.families()), **target.identity()}
    except OSError as error:
        line = f"{error.filename}: cannot be read any more ({error.strerror}); put it back as it was and start again"
        raise CampaignError(line) from error


def version_of(package: str) -> str:
    """The version of a package, or that it is not installed."""
    try:
        return metadata.version(package)
    except metadata.PackageNotFoundError:
        return "not installed"


def difference(before: Identity, now: Identity) -> str | None:
    """Say in words what differs, the first thing only; None if nothing does."""
    for thing in [*before, *(each for each in now if each not in before)]:
        one, other = before.get(thing), now.get(thing)
        if one != other:
            return f"{thing} was {shortened(one)} and is {shortened(other)}"
    return None


def shortened(value: str | None) -> str:
    """A value as it is said in one line: digests and long texts by their beginning."""
    if value is None:
        return "not there"
    return value if len(value) <= 40 else f"{value[:12]}…"
