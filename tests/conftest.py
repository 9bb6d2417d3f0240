"""What all tests share: Hypothesis without time limits, and with the same examples on every run."""

import os

from hypothesis import settings

settings.register_profile("repeatable", deadline=None, derandomize=True, print_blob=True)
settings.register_profile("explore", deadline=None, derandomize=False, print_blob=True)
settings.load_profile(os.environ.get("HEISOKU_EXAMPLES", "repeatable"))
