"""What all tests share: Hypothesis without time limits, and with the same examples on every run."""

import json
import os
from collections import Counter

import pytest
from _pytest.junitxml import xml_key
from hypothesis import settings
from xdist.remote import Producer
from xdist.scheduler import LoadScopeScheduling

from evidence.records.reading import ABOUT
from proofs.records import about

settings.register_profile("repeatable", deadline=None, derandomize=True, print_blob=True)
settings.register_profile("explore", deadline=None, derandomize=False, print_blob=True)
settings.load_profile(os.environ.get("HEISOKU_EXAMPLES", "repeatable"))


COMPILED = "tests/fuzz/"
"""What is compiled is compiled once in each process that asks for it, and that takes longer than most tests."""
LONGEST = (COMPILED, "tests/proofs/", "tests/evidence/", "tests/test_readme.py")
"""What takes longest is begun first, so that no process is left with it at the end."""


class ByFile(LoadScopeScheduling):  # type: ignore[misc]  # xdist tells no types
    """A file's tests in one process, and of what is compiled all files."""

    def _split_scope(self, nodeid: str) -> str:
        return COMPILED if nodeid.startswith(COMPILED) else nodeid.partition("::")[0]


def pytest_xdist_make_scheduler(config: pytest.Config, log: Producer) -> ByFile | None:
    """Deal tests out by file where that is asked for."""
    return ByFile(config, log) if config.getvalue("dist") == "loadfile" else None


def _begun(item: pytest.Item) -> int:
    return next((at for at, first in enumerate(LONGEST) if item.nodeid.startswith(first)), len(LONGEST))


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Leave all but one in so many cases of a sampled test to the slow ones; of few cases the first stays."""
    cases = Counter[str]()
    for item in items:
        marker = item.get_closest_marker("sampled")
        if marker is None or item.get_closest_marker("slow") is not None:
            continue
        (one_in,) = marker.args
        of = item.nodeid.partition("[")[0]
        if cases[of] % one_in:
            item.add_marker(pytest.mark.slow)
        cases[of] += 1
    items.sort(key=_begun)


def pytest_configure(config: pytest.Config) -> None:
    """Have a record of tests say how it was made, as every record does."""
    record = config.stash.get(xml_key, None)
    if record is not None:
        record.add_global_property(ABOUT, json.dumps(about()))
