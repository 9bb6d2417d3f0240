"""Begins the program: finds that its packages are its own, and ends with 3 where it cannot be loaded."""

from __future__ import annotations

import os
import sys
from contextlib import suppress
from importlib import import_module
from importlib.metadata import PackageNotFoundError, distribution
from importlib.util import find_spec
from pathlib import Path

HERE = Path(__file__).resolve().parent
PACKAGES = ("kernel", "models", "proofs", "fuzz", "evidence")
SOLVERS = {"z3": "z3-solver", "cvc5": "cvc5"}
"""Module -> the package that brings it."""
UNDECIDED = 3
"""As in models/exit_codes.py, which cannot be read before it is known whose ``models`` that is."""


def stranger() -> str | None:
    """Name a package that somebody else's stands before on the path, or that is not there; none if all are right.

    Of the solvers the module has to be the one of the package whose hashes stand in every record.
    """
    wanted = {name: HERE / name for name in PACKAGES}
    for name, package in SOLVERS.items():
        with suppress(PackageNotFoundError):
            wanted[name] = Path(str(distribution(package).locate_file(name))).resolve()
    for name, room in wanted.items():
        found = find_spec(name)
        places = [Path(place).resolve() for place in (found and found.submodule_search_locations) or ()]
        if places != [room]:
            where = found.origin if found and found.origin else places[0] if places else "nowhere"
            return (
                f"the package {name} of heisoku, {room}, is hidden by another of that name ({where});"
                " take that off the path (PYTHONPATH), or install heisoku into an environment of its own"
            )
    return None


def open_what_is_closed() -> bool:
    """Put the null device in the place of each standard stream that is closed; False if standard output was.

    Python has none in its place, and the next file that is opened would get its number and all that is printed.
    """
    told = sys.stdout is not None
    for number, name in enumerate(("stdin", "stdout", "stderr")):
        if getattr(sys, name) is None:
            nowhere = os.open(os.devnull, os.O_RDWR)
            if nowhere != number:
                os.dup2(nowhere, number)
                os.close(nowhere)
            setattr(sys, name, os.fdopen(number, "w" if number else "r"))
    return told


def loaded() -> str | None:
    """Load the program; what is wrong if it cannot be, in words."""
    if sys.flags.optimize:
        return "Python leaves assertions out (-O, PYTHONOPTIMIZE), and with them what witnesses say; run it without"
    try:
        line = stranger()
        if line is None:
            import_module("heisoku")
    except KeyboardInterrupt:
        return "interrupted; nothing is decided"
    except (Exception, SystemExit) as fault:
        return f"cannot be loaded, {type(fault).__name__}: {fault}; install it again with what it requires"
    return line


def main() -> None:
    """Run the command line of ``heisoku.py``; what cannot be loaded decides nothing: one line, and exit code 3."""
    is_told = open_what_is_closed()
    line = loaded()
    if line is None:
        try:
            sys.modules["heisoku"].main()
        except SystemExit:
            if is_told:
                raise
        line = "standard output is closed: what was found is not told"
    print(f"heisoku: {' '.join(line.split())}", file=sys.stderr)
    sys.exit(UNDECIDED)


if __name__ == "__main__":
    main()
