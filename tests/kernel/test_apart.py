"""What is on board, at the centre and at a point have data of their own: none imports what another remembers (T4)."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

KERNEL = Path(__file__).parents[2] / "kernel"
CENTRE = ("cancellation", "centre", "claims", "recovery", "release", "route_setting", "supervision")
ON_BOARD = (
    "authority",
    "change_of_ends",
    "first_loop",
    "relay",
    "second_loop",
    "standing",
    "standstill",
    "tail_evidence",
    "unit",
)
AT_A_POINT = ("terminal",)
THEIRS = {
    CENTRE: {"kernel.unit", "kernel.tag_list", "kernel.terminal"},
    ON_BOARD: {"kernel.centre", "kernel.layout", "kernel.terminal", "kernel.tag_list_text"},
    AT_A_POINT: {"kernel.centre", "kernel.layout", "kernel.unit", "kernel.tag_list"},
}
"""By machine: what of the others' it may not see."""
BOTH = {"kernel.restarts", "kernel.persistence", "kernel.tag_list_text"}
"""What speaks of more than one: the table of what survives, and how a list is written at one and read at another."""
ELSEWHERE = ("__init__", "layout", "maps", "names", "refusal", "tag_list")
OF_THE_RADIO = ("error_correction", "link", "tags", "telegram")


def imported(path: Path) -> set[str]:
    """The modules of the kernel that a file imports."""
    found = set[str]()
    for node in ast.walk(ast.parse(path.read_text("utf-8"))):
        if isinstance(node, ast.ImportFrom) and node.module == "kernel":
            found |= {f"kernel.{alias.name}" for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module:
            found.add(node.module)
        elif isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
    return {name for name in found if name.startswith("kernel")}


def reached(path: Path) -> set[str]:
    """The same, with what those import in their turn."""
    found, fresh = set[str](), imported(path)
    while fresh:
        found |= fresh
        files = [KERNEL.parent / f"{name.replace('.', '/')}.py" for name in fresh]
        fresh = {name for file in files if file.is_file() for name in imported(file)} - found
    return found


@pytest.mark.parametrize("machines", THEIRS, ids=lambda machines: machines[0])
def test_a_machine_sees_nothing_of_anothers(machines: tuple[str, ...]) -> None:
    paths = [KERNEL / f"{name}.py" for name in machines]
    if machines == ON_BOARD:
        paths += sorted((KERNEL / "onboard").glob("*.py"))
    seen = {path.name: reached(path) & THEIRS[machines] for path in paths}
    assert {name: those for name, those in seen.items() if those} == {}


def test_every_file_beside_the_other_systems_is_some_machines() -> None:
    known = {
        *CENTRE,
        *ON_BOARD,
        *AT_A_POINT,
        *ELSEWHERE,
        *OF_THE_RADIO,
        *(name.removeprefix("kernel.") for name in BOTH),
    }
    assert {path.stem for path in KERNEL.glob("*.py")} == known


def test_a_unit_that_looked_a_route_up_would_be_seen(tmp_path: Path) -> None:
    path = tmp_path / "looks.py"
    path.write_text("from kernel.route_setting import conflict\n", "utf-8")
    assert reached(path) & THEIRS[ON_BOARD] == {"kernel.centre", "kernel.layout"}
