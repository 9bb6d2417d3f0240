"""A test that is sampled loses no case: what `make test` leaves out is among what `make slow` runs."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SAMPLED = """
import pytest

@pytest.mark.sampled(3)
@pytest.mark.parametrize("case", [0, 1, pytest.param(2, marks=pytest.mark.slow), 3, 4, 5])
def test_many(case):
    pass

@pytest.mark.sampled(3)
@pytest.mark.parametrize("case", [0])
def test_one(case):
    pass

@pytest.mark.parametrize("case", range(4))
def test_whole(case):
    pass
"""


def collected(folder: Path, marked: str) -> set[str]:
    """The cases that a run with this mark has."""
    words = (sys.executable, "-m", "pytest", "--collect-only", "-q", "-n0", "-m", marked, "-p", "no:cacheprovider")
    (folder / "conftest.py").write_bytes((ROOT / "tests" / "conftest.py").read_bytes())
    (folder / "test_drawn.py").write_text(SAMPLED, "utf-8")
    said = subprocess.run(
        [*words, "-c", str(ROOT / "pyproject.toml"), f"--rootdir={folder}", str(folder)],
        capture_output=True,
        text=True,
        cwd=ROOT,
        check=True,
    )
    return {line.partition("::")[2] for line in said.stdout.splitlines() if "::" in line}


def test_what_is_left_out_of_the_tests_is_among_the_slow_ones(tmp_path: Path) -> None:
    among, slow = collected(tmp_path, "not slow"), collected(tmp_path, "slow")
    assert among == {"test_many[0]", "test_many[4]", "test_one[0]", *(f"test_whole[{case}]" for case in range(4))}
    assert slow == {f"test_many[{case}]" for case in (1, 2, 3, 5)}
