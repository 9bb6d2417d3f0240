"""The program as others install it: outside the checkout, run from ``/``, it says what it says here."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import zipfile
from importlib import metadata
from pathlib import Path

import pytest

import heisoku_start
from evidence.manifest.hashes import ROOMS
from proofs import scripts
from proofs.theories import ROWS

ROOT = Path(__file__).resolve().parent.parent
MADE = shutil.ignore_patterns(".*", "out", "build", "*.egg-info", "__pycache__", "tests")
PIP = (sys.executable, "-m", "pip", "--disable-pip-version-check")


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The wheel, built of a copy of the sources, without network."""
    folder = tmp_path_factory.mktemp("wheel")
    shutil.copytree(ROOT, folder / "sources", ignore=MADE)
    words = ("wheel", "--quiet", "--no-deps", "--no-index", "--no-build-isolation", "--wheel-dir", str(folder))
    subprocess.run([*PIP, *words, str(folder / "sources")], check=True, cwd=folder)
    return next(folder.glob("*.whl"))


@pytest.fixture(scope="module")
def installed(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder of its own that the wheel is installed into; what it requires comes from this environment."""
    folder = tmp_path_factory.mktemp("installed")
    words = ("install", "--quiet", "--no-deps", "--no-index", "--target", str(folder))
    subprocess.run([*PIP, *words, str(wheel)], check=True, cwd=folder)
    return folder


def run(
    installed: Path, *words: str, before: str = "", cwd: str | Path = "/", tool: str = "bin/heisoku"
) -> subprocess.CompletedProcess[str]:
    """Run the installed program; ``before``: a folder that stands before it on the path."""
    path = os.pathsep.join(filter(None, (before, str(installed))))
    given = {**os.environ, "PYTHONPATH": path}
    called = [sys.executable, str(installed / tool), *words]
    return subprocess.run(called, capture_output=True, text=True, cwd=cwd, env=given, check=False)


def test_every_file_beside_code_is_in_the_wheel(wheel: Path) -> None:
    there = set(zipfile.ZipFile(wheel).namelist())
    beside = {
        path.relative_to(ROOT).as_posix()
        for room in ROOMS
        for path in (ROOT / room).rglob("*")
        if path.is_file() and path.suffix not in {".pyc", ".md"}
    }
    assert len(beside) > 600
    assert beside - there == set()
    assert {f"{room}/py.typed" for room in ROOMS} <= there
    kept = {f"models/shipped/{path.relative_to(ROOT).as_posix()}" for path in (ROOT / "layouts").glob("*.toml")}
    assert kept | {"models/shipped/SAFETY_CASE.md", "models/shipped/docs/requirements.md"} <= there
    assert {name.split("/")[0] for name in there if ".dist-info" not in name} == {
        *ROOMS,
        "heisoku.py",
        "heisoku_public.py",
        "heisoku_start.py",
    }


def test_the_installed_program_says_its_version_and_checks_what_it_ships(installed: Path) -> None:
    told = run(installed, "--version")
    assert (told.returncode, told.stdout.split()) == (0, ["heisoku", metadata.version("heisoku")])
    layout = installed / "models" / "shipped" / "layouts" / "passing_station.toml"
    checked = run(installed, "check", str(layout))
    assert checked.returncode == 0, checked.stderr
    assert checked.stdout.splitlines()[-1].startswith("1 layouts, ")


@pytest.mark.parametrize("tool", ["bin/heisoku", "heisoku.py"])
@pytest.mark.parametrize("name", ["models", "evidence"])
def test_another_package_of_the_same_name_is_refused_by_name(
    name: str, tool: str, installed: Path, tmp_path: Path
) -> None:
    (tmp_path / name).mkdir()
    (tmp_path / name / "__init__.py").touch()
    # Where a file is run itself its own folder stands first, and nothing can hide what lies beside it.
    told = run(installed, "--version", before=str(tmp_path), tool=tool)
    if tool == "heisoku.py":
        assert told.returncode == 0
        return
    assert (told.returncode, told.stdout) == (3, "")
    assert len(told.stderr.splitlines()) == 1
    assert str(tmp_path / name) in told.stderr


def test_a_folder_called_tests_or_models_without_code_is_no_matter(installed: Path, tmp_path: Path) -> None:
    (tmp_path / "tests").mkdir()
    (tmp_path / "tests" / "__init__.py").touch()
    (tmp_path / "models").mkdir()
    assert run(installed, "--version", before=str(tmp_path), cwd=tmp_path).returncode == 0


@pytest.mark.parametrize("text", ["raise ImportError('two\\nlines')", "1 / 0", "import no_such_module"])
def test_what_cannot_be_imported_decides_nothing(text: str, installed: Path, tmp_path: Path) -> None:
    (tmp_path / "rich").mkdir()
    (tmp_path / "rich" / "__init__.py").write_text(text, "utf-8")
    told = run(installed, "check", "x.toml", before=str(tmp_path))
    assert (told.returncode, told.stdout) == (3, "")
    assert len(told.stderr.splitlines()) == 1
    assert "cannot be loaded" in told.stderr


def test_the_packages_of_the_checkout_are_its_own() -> None:
    assert heisoku_start.stranger() is None
    assert set(heisoku_start.PACKAGES) == set(ROOMS)


def test_every_row_has_a_script_and_a_missing_one_is_no_empty_list(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert [row for row in ROWS if not scripts.file_of(row).is_file()] == []
    monkeypatch.setattr(scripts, "FOLDER", tmp_path)
    scripts.script.cache_clear()
    try:
        with pytest.raises(FileNotFoundError, match="no proof script of"):
            scripts.hypotheses("braking.init", "anything")
    finally:
        scripts.script.cache_clear()


def test_a_lost_script_is_undecided_in_one_line(wheel: Path, tmp_path: Path) -> None:
    """As when data files are left out of what is installed: not one obligation may come out refuted."""
    zipfile.ZipFile(wheel).extractall(tmp_path)
    (tmp_path / "proofs" / "scripts" / "braking" / "init.toml").unlink()
    told = run(tmp_path, "prove", "--jobs", "1", "--only", "^braking.init", tool="heisoku_start.py")
    assert (told.returncode, told.stdout) == (3, "")
    assert len(told.stderr.splitlines()) == 1
    assert "braking/init.toml" in told.stderr


def proved(record: Path) -> list[tuple[object, ...]]:
    """What was asked and what came of it, obligation by obligation."""
    found = json.loads(record.read_text("utf-8"))["obligations"]
    return [
        (each["transition"], each["invariant"], each["verdict"], each["smt2_sha256"], each["source"]["file"])
        for each in found
    ]


@pytest.mark.slow
def test_the_installed_program_proves_the_same_texts(installed: Path, tmp_path: Path) -> None:
    words = ("prove", "--only", "^braking", "--jobs", "1", "--json")
    told = run(installed, *words, str(tmp_path / "there.json"))
    assert told.returncode == 0, told.stderr
    here = [sys.executable, "heisoku_start.py", *words, str(tmp_path / "here.json")]
    assert subprocess.run(here, cwd=ROOT, capture_output=True, check=False).returncode == 0
    assert len(proved(tmp_path / "there.json")) > 20
    assert proved(tmp_path / "there.json") == proved(tmp_path / "here.json")


@pytest.mark.slow
def test_the_installed_program_simulates_and_exports(installed: Path, tmp_path: Path) -> None:
    layout = str(installed / "models" / "shipped" / "layouts" / "passing_station.toml")
    page = tmp_path / "line.html"
    for words in (
        ("simulate", layout, "--hours", "0.01", "--html", str(page)),
        ("export", layout, "-o", str(tmp_path / "export")),
        ("report", "--help"),
    ):
        told = run(installed, *words)
        assert told.returncode == 0, told.stderr
    assert page.stat().st_size > 10_000
    assert len(list((tmp_path / "export").iterdir())) == 9
