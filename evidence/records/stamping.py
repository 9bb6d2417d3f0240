"""Prints the first line of CrossHair's record: how it was made.  ``python -m evidence.records.stamping COMMAND``."""

from __future__ import annotations

import json
import shlex
import sys

from evidence.records.reading import HEADING
from proofs.records import about


def main(*command: str) -> str:
    """Give the line; the command is the one given, not this one."""
    return HEADING + json.dumps({**about(), "command": shlex.join(command)})


if __name__ == "__main__":
    print(main(*sys.argv[1:]))
