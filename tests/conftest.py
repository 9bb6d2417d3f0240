"""What all tests share: Hypothesis without time limits, and with the same examples on every run."""

import json
import os

import pytest
from _pytest.junitxml import xml_key
from hypothesis import settings

from evidence.records.reading import ABOUT
from proofs.records import about

settings.register_profile("repeatable", deadline=None, derandomize=True, print_blob=True)
settings.register_profile("explore", deadline=None, derandomize=False, print_blob=True)
settings.load_profile(os.environ.get("HEISOKU_EXAMPLES", "repeatable"))


def pytest_configure(config: pytest.Config) -> None:
    """Have a record of tests say how it was made, as every record does."""
    record = config.stash.get(xml_key, None)
    if record is not None:
        record.add_global_property(ABOUT, json.dumps(about()))
