"""Begins the program: finds that its packages are its own, and ends with 3 where it cannot be loaded."""

from __future__ import annotations

import sys
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path

HERE = Path(__file__).resolve().parent
PACKAGES = ("kernel", "models", "proofs", "fuzz", "evidence")
UNDECIDED = 3
"""As in models/exit_codes.py, which cannot be read before it is known whose ``models`` that is."""


def stranger() -> str | None:
    """Name a package that somebody else's stands before on the path, or that is not there; none if all are ours."""
    for name in PACKAGES:
        found = find_spec(name)
        places = [Path(place).resolve() for place in (found and found.submodule_search_locations) or ()]
        if places != [HERE / name]:
            where = found.origin if found and found.origin else places[0] if places else "nowhere"
            return (
                f"the package {name} of heisoku, {HERE / name}, is hidden by another of that name ({where});"
                " take that off the path (PYTHONPATH), or install heisoku into an environment of its own"
            )
    return None


def main() -> None:
    """Run the command line of ``heisoku.py``; what cannot be loaded decides nothing: one line, and exit code 3."""
    try:
        line = stranger()
        if line is None:
            import_module("heisoku")
    except KeyboardInterrupt:
        line = "interrupted; nothing is decided"
    except Exception as fault:
        line = f"cannot be loaded, {type(fault).__name__}: {fault}; install it again with what it requires"
    if line is not None:
        print(f"heisoku: {' '.join(line.split())}", file=sys.stderr)
        sys.exit(UNDECIDED)
    sys.modules["heisoku"].main()


if __name__ == "__main__":
    main()
