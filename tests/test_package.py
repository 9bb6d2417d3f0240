"""The program as others install it: outside the checkout, run from ``/``, it says what it says here."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import zipfile
from collections.abc import Mapping, Sequence
from importlib import metadata
from pathlib import Path
from typing import Any

import pytest

import heisoku
import heisoku_start
from evidence.manifest.hashes import ROOMS
from fuzz.failures.trace import text_of
from proofs import scripts
from proofs.theories import ROWS
from tests.fuzz.failures.samples import LAYOUTS, failing

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


@pytest.mark.parametrize(
    ("name", "tool"),
    [
        *((name, tool) for name in ("models", "evidence") for tool in ("bin/heisoku", "heisoku.py")),
        ("z3", "bin/heisoku"),
        ("cvc5", "bin/heisoku"),
    ],
)
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


@pytest.mark.parametrize(
    "text", ["raise ImportError('two\\nlines')", "1 / 0", "import no_such_module", "raise SystemExit(0)"]
)
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


LAYOUT = "{top}/layouts/passing_station.toml"
EVERY_COMMAND: tuple[tuple[str, ...], ...] = (
    ("prove", "--only", "^braking", "--jobs", "1", "--json", "{out}/prove.json", "--junit", "{out}/prove.xml"),
    ("prove", "--only", "^display", "--solver", "both", "--jobs", "2", "--json", "{out}/both.json"),
    ("prove", "--only", "^display", "--jobs", "1", "--kept", "{out}/kept.sqlite", "--json", "{out}/again.json"),
    ("prove", "--only", "no such row"),
    ("check", LAYOUT, "--json", "{out}/check.json"),
    ("check", LAYOUT, "--clearance", "400 m", "--json", "{out}/foul.json"),
    ("draw", LAYOUT, "-o", "{out}/station.svg"),
    ("export", LAYOUT, "-o", "{out}/export"),
    ("simulate", LAYOUT, "--hours", "0.05", "--html", "{out}/line.html", "--json", "{out}/line.json"),
    ("ride", "--rides", "4", "--jobs", "1", "--json", "{out}/ride.json"),
    ("ride", "--rides", "2", "--beyond", "diameter_ppm", "--jobs", "1", "--json", "{out}/beyond.json"),
    ("days", "alarm", "--days", "1", "--jobs", "1", "--json", "{out}/days.json"),
    ("reproduce", "000", "--runs", "1", "-o", "{out}/000", "--json", "{out}/000.json"),
    ("handset", "-o", "{out}/handset.html", "--minutes", "1"),
    (
        *("fuzz", "--target", "link", "--batches", "1", "--seed", "1", "--workers", "1"),
        *("--out", "{out}/fuzz", "--json", "{out}/fuzz.json"),
    ),
    ("replay", "{out}/given/trace.json", "--json", "{out}/replay.json"),
    (
        *("certify", "--only", "^split.init split_is_latched$", "--jobs", "1"),
        *("--keep", "{out}/certificates", "--json", "{out}/certificates.json"),
    ),
    ("mutate", "--only", r"^kernel\.onboard\.split\.is_intact", "--jobs", "1", "--json", "{out}/mutate.json"),
    ("report", "--records", "{out}", "-o", "{out}/report.html"),
    ("manifest", "{out}"),
    ("verify", "{out}/export"),
)
"""Every command of the program, the last of the records of those before it."""
OWN = {
    *("commit", "command", "versions", "solvers", "platform", "made_at", "seconds", "lifting_seconds", "wall_seconds"),
    *("process", "at", "starts", "rlimit_spent", "kept"),
}
"""What a record says of the run, and not of what was asked; where it ran is taken out of all names of files."""


def same_of(told: Any, places: Mapping[str, Path]) -> Any:
    """A record without what it says of its run; ``places``: where that was, by what stands for it."""
    if isinstance(told, dict):
        return {key: same_of(each, places) for key, each in told.items() if key not in OWN}
    if isinstance(told, list):
        return [same_of(each, places) for each in told]
    for name, place in places.items():
        told = told.replace(str(place), name) if isinstance(told, str) else told
    return told


def every_command(
    program: Sequence[str], places: Mapping[str, Path], cwd: str | Path, path: str
) -> list[tuple[str, int, str]]:
    """Run every command: what was called, the exit code, and what stood on standard error where it was refused."""
    out = places["{out}"]
    (out / "given").mkdir(parents=True)
    trace = failing()
    (out / "given" / "trace.json").write_text(text_of(trace), "utf-8")
    shutil.copy(LAYOUTS["passing_station"], out / "given" / trace.layout.file)
    came = list[tuple[str, int, str]]()
    for words in EVERY_COMMAND:
        given = [word.replace("{out}", str(out)).replace("{top}", str(places["{top}"])) for word in words]
        env = {**os.environ, "PYTHONPATH": path}
        ended = subprocess.run([*program, *given], capture_output=True, text=True, cwd=cwd, env=env, check=False)
        refused = ended.stderr if ended.returncode in (2, 3) else ""
        came.append((" ".join(words), ended.returncode, same_of(refused, places)))
    return came


def test_every_command_is_among_those_that_are_compared() -> None:
    commands = heisoku.app.registered_commands
    assert {words[0] for words in EVERY_COMMAND} == {
        each.name or each.callback.__name__ for each in commands if each.callback
    }


@pytest.mark.slow
def test_every_command_says_from_the_root_what_it_says_in_the_checkout(installed: Path, tmp_path: Path) -> None:
    """The same exit codes, the same files, the same records: verdicts, and hashes of every obligation."""
    here = {"{out}": tmp_path / "here", "{top}": ROOT}
    there = {"{out}": tmp_path / "there", "{top}": installed / "models" / "shipped"}
    came = every_command([sys.executable, "heisoku_start.py"], here, ROOT, "")
    assert every_command([sys.executable, str(installed / "bin/heisoku")], there, "/", str(installed)) == came
    assert {each[1] for each in came} == {0, 1, 2}
    files, others = ({path.relative_to(out) for path in out.rglob("*") if path.is_file()} for out in (
        here["{out}"], there["{out}"]))  # fmt: skip
    assert files == others
    records = [each for each in files if each.suffix == ".json" and each.parent == Path() and each.stem != "manifest"]
    assert len(records) > 12
    for each in records:
        one, other = (same_of(json.loads((side["{out}"] / each).read_text("utf-8")), side) for side in (here, there))
        assert one == other, each
    asked = [len(proved(here["{out}"] / f"{name}.json")) for name in ("prove", "both", "again")]
    assert min(asked) > 20
