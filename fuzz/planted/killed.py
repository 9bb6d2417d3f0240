"""The drops in the kernel that a counterexample kills, kept beside the code: ``python -m fuzz.planted.killed``.

Which they are takes the trials of all mutants (``heisoku mutate``, half an hour), so their
names are kept in ``killed.toml``, each with the row that its counterexample was found in.
"""

from __future__ import annotations

import argparse
import json
import sys
import tomllib
from collections.abc import Iterable, Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import Any

from models.exit_codes import BAD_INPUT, HOLDS

FILE = Path(__file__).with_name("killed.toml")
TRIALS = Path("out/mutate.json")
HEAD = """# Drops in the kernel that a counterexample kills, each with the row it was found in.
# Written by `python -m fuzz.planted.killed` from the record of `heisoku mutate`.
"""


@cache
def killed(file: Path = FILE) -> Mapping[str, Mapping[str, str]]:
    """For each module of the kernel the drops killed by a counterexample, by name, with the row that shows it."""
    return tomllib.loads(file.read_text(encoding="utf-8"))


def rows() -> Mapping[str, str]:
    """Every drop killed by a counterexample, with the row that shows it."""
    return {name: row for drops in killed().values() for name, row in drops.items()}


def module_of(name: str) -> str:
    """The module that a mutant is of, from its name."""
    return name.partition(": ")[0].rpartition(".")[0]


def text_of(trials: Sequence[Mapping[str, Any]]) -> str:
    """The file's text, from the outcome of every trial.

    Left out are the world's mutants, and constants of modules: they are in no function that a fault is planted in.
    """
    found: dict[str, dict[str, str]] = {}
    for verdict in trials:
        name = verdict["mutant"]
        if verdict["outcome"] == "counterexample" and name.startswith("kernel.") and ": value " not in name:
            found.setdefault(module_of(name), {})[name] = verdict["by"]
    return HEAD + "".join(_table(module, found[module]) for module in sorted(found))


def _table(module: str, drops: Mapping[str, str]) -> str:
    lines = [f"{json.dumps(name)} = {json.dumps(row)}" for name, row in sorted(drops.items())]
    return "\n".join(["", f"[{json.dumps(module)}]", *lines, ""])


def main(given: Iterable[str] | None = None) -> int:
    """Write the file anew from the record of the trials."""
    parser = argparse.ArgumentParser(prog="python -m fuzz.planted.killed", description=__doc__)
    parser.add_argument("trials", nargs="?", type=Path, default=TRIALS, help=f"the record of trials; {TRIALS}")
    parser.add_argument("--out", type=Path, default=FILE, help="the file to write; the one beside the code")
    asked = parser.parse_args(None if given is None else list(given))
    try:
        trials = json.loads(asked.trials.read_text(encoding="utf-8"))["mutants"]
        text = text_of(trials)
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
        print(f"{asked.trials}: no record of trials ({error}); make one with heisoku mutate --json", file=sys.stderr)
        return BAD_INPUT
    asked.out.write_text(text, encoding="utf-8")
    kept = tomllib.loads(text)
    print(f"{asked.out}: {sum(map(len, kept.values()))} drops of {len(kept)} machines, from {len(trials)} trials")
    return HOLDS


if __name__ == "__main__":
    raise SystemExit(main())
