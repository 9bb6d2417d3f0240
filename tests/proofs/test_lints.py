"""The lints hold, and each of them catches a planted fault."""

from __future__ import annotations

import tomllib
from pathlib import Path

import pytest

from kernel import persistence
from proofs import lints, restarts, scripts, usage
from proofs.catalogue import AXIOMS, INITIAL, INTERLOCKING, INVARIANTS, PREMISES, STEPS
from proofs.scripts import FOLDER
from proofs.theories import ROWS, THEORIES, theory_of
from proofs.theories import columns as columns_of
from proofs.theory import READING, START

ROOT = Path(__file__).resolve().parent.parent.parent
KERNEL = sorted((ROOT / "kernel").rglob("*.py"))
WORLD = sorted((ROOT / "models" / "world").glob("*.py"))
INVARIANT_FILES = [path for path in sorted((ROOT / "proofs" / "invariants").glob("*.py")) if path.stem != "vocabulary"]
REQUIREMENTS = (ROOT / "docs" / "requirements.md").read_text("utf-8")


def text(path: str | Path) -> str:
    return (ROOT / path).read_text("utf-8")


def planted(path: str, old: str, new: str) -> str:
    """The file with a fault in it."""
    source = text(path)
    assert source.count(old) >= 1, f"{path} no longer has {old!r}"
    return source.replace(old, new, 1)


def seen(path: str, source: str) -> list[str]:
    return lints.truth_by_fiat(source, lints.LEAVES[path], lints.ASKED[path])


CENTRE, BOARD = "models/world/at_the_centre.py", "models/world/on_board.py"
POINT, RADIO = "models/world/at_a_point.py", "models/world/radio.py"

# ---- no truth by fiat


@pytest.mark.parametrize("path", lints.LEAVES)
def test_no_machine_of_the_world_is_told_what_is_really_there(path: str) -> None:
    assert seen(path, text(path)) == []


def test_every_file_of_the_world_is_one_that_may_see_or_one_that_is_watched() -> None:
    files = {str(path.relative_to(ROOT)) for path in WORLD if path.stem != "__init__"}
    assert files == set(lints.LEAVES) | set(lints.MAY_SEE)
    assert set(lints.LEAVES) == set(lints.ASKED)


@pytest.mark.parametrize("path", KERNEL, ids=lambda path: path.stem)
def test_the_kernel_knows_nothing_of_the_world(path: Path) -> None:
    assert lints.knows_the_world(path.read_text("utf-8")) == []


ASSUMED = "from models.world.assumptions import"
BEHIND = "            behind=behind,\n"
HISTORY = f"track=replace(\n            system.track,\n{BEHIND}"
IF_GONE = "    if gone:\n        return system\n"
ECHO = "    if run not in system.radio.stops:\n        return system\n"


@pytest.mark.parametrize(
    ("path", "old", "new", "offence"),
    [
        (CENTRE, ECHO, "    if run not in system.track.rolling:\n        return system\n", "reads track.rolling"),
        (CENTRE, ECHO, "    what = system.track\n    if what.rolling:\n        return system\n", "reads track"),
        (CENTRE, ECHO, "    if getattr(system, 'tr' + 'ack'):\n        return system\n", "uses getattr"),
        (CENTRE, ECHO, "    if site.ground.opens:\n        return system\n", "reads ground.opens"),
        (CENTRE, "    under = system", "    if system.track.at:\n        return None\n    under = system", "decides"),
        (CENTRE, "(system.track, under=under)", "(system.track, under=under, at={})", "writes more"),
        (CENTRE, "from kernel import", f"{ASSUMED} rails_lead\nfrom kernel import", "asks rails_lead"),
        (CENTRE, "def accounted_for", "def written_down", "has leave and is not there"),
        (BOARD, BEHIND, "            at={},\n", "writes track"),
        (BOARD, HISTORY, f"track=made(\n{BEHIND}", "writes track"),
        (BOARD, "    unit = tail", f"    gone = system.track.behind\n{IF_GONE}    unit = tail", "decides"),
        (POINT, "track=replace(system.track, lies=", "track=replace(system.track, at=", "writes track"),
        (POINT, f"{ASSUMED} detection_is_true", f"{ASSUMED} detection_is_true, rails_lead", "asks rails_lead"),
        (RADIO, "if not route_setting.offers(system.centre, run):", "if not system.track.at:", "reads track.at"),
        (RADIO, "from dataclasses import replace", "NOW = here.track.at", "module reads"),
    ],
)
def test_a_machine_that_is_told_the_truth_is_seen(path: str, old: str, new: str, offence: str) -> None:
    found = seen(path, planted(path, old, new))
    assert any(offence in line for line in found), found


@pytest.mark.parametrize(
    "line",
    [
        "from models.world.state import System",
        "import models.ground",
        "from proofs import catalogue",
        "def where(system: System) -> bool: ...",
        "def where(system):\n    return system.track",
        "def where(site):\n    return site.ground.opens",
    ],
)
def test_a_kernel_that_knows_the_world_is_seen(line: str) -> None:
    assert lints.knows_the_world(line) != []


# ---- what is proved, and what for


def test_every_invariant_is_proved_and_serves_a_claim() -> None:
    assert lints.idle_invariants(usage.book(), INVARIANTS, INTERLOCKING.claimed) == []


def test_an_invariant_that_nobody_proves_is_seen() -> None:
    without = {cell: names for cell, names in usage.book().items() if cell[1] != "locks_agree"}
    found = lints.idle_invariants(without, ["locks_agree"], INTERLOCKING.claimed)
    assert found == ["locks_agree: no obligation proves it"]


def test_an_invariant_that_serves_nothing_is_seen_even_if_another_such_uses_it() -> None:
    book = {**usage.book(), ("request", "idle_one"): ["idle_one", "idle_two"], ("request", "idle_two"): ["idle_one"]}
    assert len(lints.idle_invariants(book, ["idle_one", "idle_two"], INTERLOCKING.claimed)) == 2
    claims = {**book, ("request", "no_open_flank"): ["idle_one"]}
    assert lints.idle_invariants(claims, ["idle_one", "idle_two"], INTERLOCKING.claimed) == []


def test_every_axiom_and_premise_is_used_or_kept_for_a_reason() -> None:
    assert lints.idle_axioms(usage.book(), [*AXIOMS, *PREMISES], lints.KEPT) == []


def test_an_idle_axiom_is_seen_and_so_is_a_stale_reason() -> None:
    book = usage.book()
    assert lints.idle_axioms(book, ["another"], {}) == ["another: no proof uses it"]
    assert lints.idle_axioms(book, AXIOMS, {**lints.KEPT, "fouling_is_mutual": "why not"}) != []
    assert lints.idle_axioms(book, AXIOMS, {**lints.KEPT, "gone": "it was there once"}) != []


def test_whatever_is_written_as_invariant_axiom_or_transition_is_in_its_list() -> None:
    invariants = [path.read_text("utf-8") for path in INVARIANT_FILES]
    assert lints.left_out(invariants, {*INVARIANTS, *INITIAL}, "bool") == []
    assert lints.left_out([text("models/axioms.py")], AXIOMS, "bool") == []
    assert lints.left_out([text("models/world/premises.py")], PREMISES, "bool") == []
    assert lints.left_out([path.read_text("utf-8") for path in WORLD], STEPS, "System") == []


def test_what_is_written_and_not_listed_is_seen() -> None:
    assert lints.left_out(["def f(site: Site, system: System) -> bool: ..."], {"g"}, "bool") != []
    assert lints.left_out(["def f(site: Site, system: System, run: Run) -> System: ..."], {"g"}, "System") != []
    assert lints.left_out(["def f(site: Site, system: System, run: Run) -> System: ..."], {"f"}, "System") == []


# ---- scripts


def faults(files: dict[str, dict[str, list[str]]]) -> list[str]:
    columns = {row: columns_of(row) for row in ROWS}
    cells = [cell for theory in THEORIES.values() for cell in usage.cells(theory)]
    return lints.script_faults(files, columns, {cell: available(*cell) for cell in cells})


def available(row: str, column: str) -> set[str]:
    """What an obligation may name."""
    theory, name = theory_of(row)
    assumed = {*theory.axioms, *theory.premises}
    if name == START:
        return assumed | set(theory.initial)
    return assumed | set(theory.invariants) if name in theory.steps or column in theory.invariants else assumed


def row_in(path: Path) -> str:
    """The row that a script is of."""
    return ".".join(path.relative_to(FOLDER).with_suffix("").parts)


def test_the_scripts_name_what_there_is() -> None:
    paths = [path for path in sorted(FOLDER.rglob("*")) if not path.is_dir()]
    files = {row_in(path): tomllib.loads(path.read_text("utf-8")) for path in paths}
    assert len(files) > len(STEPS) // 2
    assert faults(files) == []
    assert all(dict(scripts.script(row)) == entries for row, entries in files.items())


@pytest.mark.parametrize(
    ("row", "column", "names"),
    [
        ("gone", "locks_agree", ["locks_agree"]),
        ("request", "gone", ["locks_agree"]),
        ("request", "locks_agree", ["gone"]),
        ("request", "locks_agree", ["locks_agree", "locks_agree"]),
        ("request", "locks_agree", ["nothing_was_ever_sent"]),
        (START, "locks_agree", ["locks_agree"]),
        (READING, "fouling_is_mutual", ["locks_agree"]),
        ("odometry.gone", "range_contains_train", []),
        ("odometry.take_fix", "range_contains_train", ["locks_agree"]),
        ("odometry.init", "range_contains_train", ["range_contains_train"]),
        ("gone.take_fix", "range_contains_train", []),
    ],
)
def test_a_script_that_names_what_is_not_there_is_seen(row: str, column: str, names: list[str]) -> None:
    assert len(faults({row: {column: names}})) == 1


# ---- what is written by machine, and what is traced


def test_the_restarts_are_what_the_persistence_table_says() -> None:
    assert text("kernel/restarts.py") == restarts.source()
    assert text("kernel/restarts.py").replace("newest=centre.newest", "newest=0") != restarts.source()


def test_a_state_and_its_persistence_table_have_the_same_variables(monkeypatch: pytest.MonkeyPatch) -> None:
    table = {name: entry for name, entry in persistence.UNIT.items() if name != "occupied"}
    monkeypatch.setattr(persistence, "UNIT", table)
    with pytest.raises(ValueError, match="occupied"):
        restarts.source()


@pytest.mark.parametrize("path", KERNEL, ids=lambda path: path.stem)
def test_every_function_of_the_kernel_says_which_requirement_it_serves(path: Path) -> None:
    known = lints.known_requirements(REQUIREMENTS)
    assert {"T1", "T16", "P8", "X6", "G7", "A8"} <= known
    assert lints.unlabelled(path.read_text("utf-8"), known) == []


def test_a_function_that_serves_no_requirement_is_seen() -> None:
    known = lints.known_requirements(REQUIREMENTS)
    assert lints.unlabelled('def f() -> int:\n    """Do it."""', known) == ["line 1: f names no requirement"]
    assert lints.unlabelled("def f() -> int: ...", known) == ["line 1: f names no requirement"]
    assert lints.unlabelled('def f() -> int:\n    """Do it (T4, T99)."""', known) == ["line 1: f names T99"]
    assert lints.unlabelled('def _f() -> int:\n    """Do it."""', known) == []
