"""Begins the program: finds that its packages are its own, and ends with 3 where it cannot be loaded.

Until it is loaded, and once it has a verdict, an interruption ends it at once and without a word.  So nothing is
imported here before that is settled but what settles it: not even how annotations are read.
"""

import _signal  # type: ignore[import-not-found]  # built in: the rest of signal takes longer to load
import sys

TYPE_CHECKING = False  # as typing has it, which takes as long to load
if TYPE_CHECKING:
    from types import FrameType

PACKAGES = ("kernel", "models", "proofs", "fuzz", "evidence")
SOLVERS = {"z3": "z3-solver", "cvc5": "cvc5"}
"""Module -> the package that brings it."""
AGAIN_AFTER_S = 0.05
UNDECIDED = 3
"""As in models/exit_codes.py, which cannot be read before it is known whose ``models`` that is."""


def stranger() -> str | None:
    """Name a package that somebody else's stands before on the path, or that is not there; none if all are right.

    Of the solvers the module has to be the one of the package whose hashes stand in every record.
    """
    from contextlib import suppress
    from importlib.metadata import PackageNotFoundError, distribution
    from importlib.util import find_spec
    from pathlib import Path

    wanted = {name: Path(__file__).resolve().parent / name for name in PACKAGES}
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
    import os

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
    from importlib import import_module

    if sys.flags.inspect:
        return "Python goes on when the program ends (-i, PYTHONINSPECT), and its exit code is lost; run it without"
    if sys.flags.optimize:
        return "Python leaves assertions out (-O, PYTHONOPTIMIZE), and with them what witnesses say; run it without"
    try:
        line = stranger()
        if line is None:
            import_module("heisoku")
    except (Exception, SystemExit) as fault:
        return f"cannot be loaded, {type(fault).__name__}: {fault}; install it again with what it requires"
    return line


def interrupt(number: int, frame: "FrameType | None") -> None:
    """Interrupt the program; a moment later where Python would print the exception and go on, as finalisers do.

    So do callbacks of the compiler's library (llvmlite).  Its objects and Z3's complain if they are let go half made.
    """
    is_dropped = frame is not None and frame.f_code.co_filename.startswith("<frozen importlib")
    while frame is not None and not is_dropped:
        made = frame.f_code.co_name == "__init__" and frame.f_globals.get("__name__") == "z3.z3"
        is_dropped = made or frame.f_code.co_name == "__del__" or "llvmlite" in frame.f_code.co_filename
        frame = frame.f_back
    if not is_dropped:
        raise KeyboardInterrupt
    import os
    import threading

    threading.Timer(AGAIN_AFTER_S, os.kill, (os.getpid(), number)).start()


def hear_interruptions(heard: bool) -> None:
    """Let an interruption be heard by the program, or end it at once; where a shell has it ignored it stays so."""
    if _signal.getsignal(_signal.SIGINT) != _signal.SIG_IGN:
        _signal.signal(_signal.SIGINT, interrupt if heard else _signal.SIG_DFL)


def main() -> None:
    """Run the command line of ``heisoku.py``; what cannot be loaded decides nothing: one line, and exit code 3."""
    hear_interruptions(False)
    is_told = open_what_is_closed()
    line = loaded()
    if line is None:
        line = "standard output is closed: what was found is not told"
        try:
            hear_interruptions(True)
            try:
                sys.modules["heisoku"].main()
            finally:
                hear_interruptions(False)
        except SystemExit:
            if is_told:
                raise
        except KeyboardInterrupt:
            line = "interrupted; nothing is decided"
    print(f"heisoku: {' '.join(line.split())}", file=sys.stderr)
    if sys.flags.inspect:
        end_at_once()
    sys.exit(UNDECIDED)


def end_at_once() -> None:
    """End undecided, whatever Python would still do."""
    import os

    sys.stderr.flush()
    os._exit(UNDECIDED)


if __name__ == "__main__":
    main()
