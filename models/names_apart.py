"""Names of compiled code that are those of no other process."""

from __future__ import annotations

import itertools
import os
import secrets
from typing import Any

from numba.core import bytecode

identity: Any = bytecode.FunctionIdentity


def name_apart() -> None:
    """Let numba number functions from anywhere on; to be called where code is kept for other processes.

    It names them by module, name, types, and a number that begins with 1 in every process: code that was kept by
    one would have names that another function has here, and the linker would take one for the other.
    """
    identity._unique_ids = itertools.count(secrets.randbits(60))


os.register_at_fork(after_in_child=name_apart)
