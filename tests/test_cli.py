"""The command line: its exit codes, one line for bad input, and never a traceback."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

import heisoku
from proofs.records import Obligation, Report, Verdict

ROOT = Path(__file__).resolve().parent.parent
SAMPLES = sorted((ROOT / "layouts").glob("*.toml"))
PASSING_STATION = (ROOT / "layouts" / "passing_station.toml").read_text("utf-8")


def answer(verdict: Verdict) -> Obligation:
    """An answer that no solver was asked for."""
    return {
        "transition": "reserve",
        "invariant": "no_conflicting_routes",
        "hypotheses": [],
        "axioms": [],
        "verdict": verdict,
        "solver": "z3",
        "solver_version": "5.4.0",
        "seed": 0,
        "rlimit": 1000,
        "rlimit_spent": 10,
        "seconds": 0.1,
        "smt2_sha256": "0" * 64,
        "source": {"file": "proofs/centre.py", "lines": (1, 2)},
    }


@pytest.fixture
def prover(monkeypatch: pytest.MonkeyPatch) -> dict[str, Any]:
    """Stand in for the prover: what it is to answer, and what it was asked."""
    memory: dict[str, Any] = {"answers": [answer("proved")]}

    def prove_all(**asked: Any) -> Report:
        memory["asked"] = asked
        if isinstance(memory["answers"], BaseException):
            raise memory["answers"]
        asked["progress"](1, 1, "reserve")
        return Report(memory["answers"], 0.1, 0.2)

    module = ModuleType("proofs.run")
    module.prove_all = prove_all  # type: ignore[attr-defined]
    monkeypatch.setitem(sys.modules, "proofs.run", module)
    return memory


def in_one_line(text: str) -> bool:
    return len(text.splitlines()) == 1 and "Traceback" not in text


@pytest.mark.parametrize(("verdict", "code"), [("proved", 0), ("refuted", 1), ("undecided", 3)])
def test_prove_ends_with_the_code_of_its_verdict(
    verdict: Verdict, code: int, prover: dict[str, Any], capsys: pytest.CaptureFixture[str]
) -> None:
    prover["answers"] = [answer("proved"), answer(verdict)]
    assert heisoku.run(["prove"]) == code
    assert "1 rows × 1 columns: 1 obligations" in capsys.readouterr().out


def test_prove_passes_its_options_on(prover: dict[str, Any]) -> None:
    assert heisoku.run(["prove", "--solver", "both", "--jobs", "2", "--seeds", "3", "--only", "reserve*"]) == 0
    del prover["asked"]["progress"]
    assert prover["asked"] == {
        "solver": "both",
        "jobs": 2,
        "seeds": 3,
        "only": "reserve*",
        "keep": None,
        "answers": None,
    }


def test_prove_writes_both_records(prover: dict[str, Any], tmp_path: Path) -> None:
    record, junit = tmp_path / "new" / "prove.json", tmp_path / "new" / "prove.xml"
    prover["answers"] = [answer("refuted")]
    assert heisoku.run(["prove", "--json", str(record), "--junit", str(junit)]) == 1
    assert json.loads(record.read_text("utf-8"))["verdict"] == "refuted"
    assert b'failures="1"' in junit.read_bytes()


def test_prove_of_a_name_that_does_not_exist_is_bad_usage(
    prover: dict[str, Any], capsys: pytest.CaptureFixture[str]
) -> None:
    prover["answers"] = []
    assert heisoku.run(["prove", "--only", "nonsense"]) == 2
    error = capsys.readouterr().err
    assert in_one_line(error)
    assert "nonsense" in error


@pytest.mark.parametrize("fault", [RuntimeError("two\nlines"), RecursionError(), KeyboardInterrupt()])
def test_a_fault_or_an_interruption_decides_nothing(
    fault: BaseException, prover: dict[str, Any], capsys: pytest.CaptureFixture[str]
) -> None:
    prover["answers"] = fault
    assert heisoku.run(["prove"]) == 3
    assert in_one_line(capsys.readouterr().err)


def test_nothing_is_proved_before_it_is_known_that_the_record_can_be_written(
    prover: dict[str, Any], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "file").write_text("", "utf-8")
    for target in (tmp_path, tmp_path / "file" / "prove.json"):
        assert heisoku.run(["prove", "--json", str(target)]) == 2
        error = capsys.readouterr().err
        assert in_one_line(error)
        assert str(target) in error
    assert "asked" not in prover


@pytest.mark.parametrize(
    "words",
    [
        ("check", "{layout}", "--json", "{layout}"),
        ("check", "layouts/terminus.toml", "{layout}", "--json", "{link}"),
        ("draw", "{layout}", "-o", "{layout}"),
        ("export", "{layout}", "-o", "{folder}"),
        ("simulate", "{layout}", "--html", "{layout}"),
        ("fuzz", "{layout}", "--target", "lines", "--batches", "1", "--out", "{folder}/fuzz", "--json", "{layout}"),
        ("replay", "{layout}", "--json", "{layout}"),
        ("prove", "--only", "^display", "--json", "{folder}/a.xml", "--junit", "{folder}/a.xml"),
        ("prove", "--only", "^display", "--json", "{folder}/a", "--keep", "{folder}/a"),
        ("certify", "--only", "^display", "--json", "{folder}/a", "--keep", "{folder}/a"),
        ("reproduce", "000", "--runs", "1", "-o", "{folder}/a", "--json", "{folder}/a/000_tables.txt"),
        ("reproduce", "000", "--runs", "1", "-o", "{folder}/a", "--json", "{folder}/a/any.png"),
    ],
    ids=" ".join,
)
def test_no_file_that_is_read_is_written_over_and_none_is_written_twice(
    words: tuple[str, ...], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    layout, link = tmp_path / "layout.toml", tmp_path / "link.toml"
    layout.write_text(PASSING_STATION, "utf-8")
    link.symlink_to(layout)
    given = {"layout": layout, "link": link, "folder": tmp_path}
    assert heisoku.run([word.format(**given) for word in words]) == 2
    said = capsys.readouterr()
    assert said.out == ""
    assert in_one_line(said.err)
    assert layout.read_text("utf-8") == PASSING_STATION
    assert sorted(tmp_path.iterdir()) == [layout, link]


@pytest.mark.parametrize("words", [("check", "{bad}"), ("check", "layouts/ring.toml", "--json", "{bad}")])
@pytest.mark.parametrize("bad", ["loop", "n" * 300])
def test_a_path_that_leads_nowhere_is_bad_input_before_the_work(
    bad: str, words: tuple[str, ...], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "loop").symlink_to(tmp_path / "loop")
    assert heisoku.run([word.format(bad=tmp_path / bad) for word in words]) == 2
    said = capsys.readouterr()
    assert (said.out, in_one_line(said.err)) == ("", True)


@pytest.mark.parametrize(
    "arguments",
    [
        [],
        ["nonsense"],
        ["prove", "--nonsense"],
        ["prove", "--solver", "yices"],
        ["prove", "--jobs", "0"],
        ["prove", "--seeds", "many"],
        ["check"],
        ["draw"],
        ["draw", "layout.toml"],
    ],
)
def test_bad_usage_is_one_line_and_code_2(arguments: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert heisoku.run(arguments) == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert in_one_line(captured.err)
    assert "--help" in captured.err


@pytest.mark.parametrize("command", ["prove", "check", "draw"])
def test_help_has_examples(command: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert heisoku.run([command, "--help"]) == 0
    captured = capsys.readouterr().out
    assert "Examples:" in captured
    assert f"heisoku {command}" in captured.split("Examples:")[1]


BAD_FILES = {
    "absent.toml": None,
    "empty.toml": b"",
    "truncated.toml": b'[station]\nname = "A',
    "encoding.toml": b'name = "\xff\xfe"\n',
    "truncated.json": b'{"version": "3.4.12", "routes": [{"id": ',
    "nested.json": b"[" * 100_000,
    "infinite.json": b'{"version": "3.4.12", "track_sections": [{"id": "T", "length": 1e999}]}',
    "zeros.json": bytes(4096),
    "aliases.yml": b"a: &a [x, x]\n"
    + b"".join(b"%c: &%c [*%c, *%c, *%c]\n" % (c + 1, c + 1, c, c, c) for c in range(ord("a"), ord("z"))),
    "unknown.xyz": b"hello",
    "new\nline.toml": b"",
}


@pytest.mark.parametrize("name", BAD_FILES)
@pytest.mark.parametrize("command", ["check", "draw"])
def test_bad_input_is_one_line_naming_the_file_and_code_2(
    command: str, name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / name
    content = BAD_FILES[name]
    if content is not None:
        path.write_bytes(content)
    options = ["-o", str(tmp_path / "out.svg")] if command == "draw" else []
    assert heisoku.run([command, str(path), *options]) == 2
    error = capsys.readouterr().err
    assert in_one_line(error)
    assert name.rsplit("\n", maxsplit=1)[-1] in error
    assert not (tmp_path / "out.svg").exists()


def test_a_folder_is_bad_input(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert heisoku.run(["check", str(tmp_path)]) == 2
    assert in_one_line(capsys.readouterr().err)


def test_bad_input_does_not_keep_the_other_layouts_from_being_checked(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    record = tmp_path / "check.json"
    absent = tmp_path / "absent.toml"
    assert heisoku.run(["check", str(absent), *map(str, SAMPLES), "--json", str(record)]) == 2
    captured = capsys.readouterr()
    assert in_one_line(captured.err)
    assert captured.out.splitlines()[-1].endswith("checked, 1 not read: bad input")
    written = json.loads(record.read_text("utf-8"))
    assert written["verdict"] == "bad input"
    assert [entry["verdict"] for entry in written["layouts"]] == ["bad input"] + ["holds"] * len(SAMPLES)


def test_the_samples_hold_and_it_is_said_how_much_was_checked(capsys: pytest.CaptureFixture[str]) -> None:
    assert len(SAMPLES) >= 3
    assert heisoku.run(["check", *map(str, SAMPLES)]) == 0
    last = capsys.readouterr().out.splitlines()[-1]
    assert last.startswith(f"{len(SAMPLES)} layouts, ")
    assert int(last.split()[2]) > 0


def test_a_sample_is_drawn(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    drawing = tmp_path / "new" / "station.svg"
    assert heisoku.run(["draw", str(SAMPLES[0]), "-o", str(drawing)]) == 0
    assert b"<svg" in drawing.read_bytes()
    said = capsys.readouterr().out
    assert " 0 blocks" not in said
    longest = said.partition("longest route '")[2].partition("'")[0]
    assert f"route {longest}<".encode() in drawing.read_bytes()


def test_the_route_of_the_help_example_is_there(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    drawing = tmp_path / "station.svg"
    station = next(path for path in SAMPLES if path.stem == "passing_station")
    assert heisoku.run(["draw", str(station), "-o", str(drawing), "--route", "W to 1"]) == 0
    assert "route 'W to 1' highlighted" in capsys.readouterr().out
    assert b"route W to 1<" in drawing.read_bytes()


def test_a_route_that_is_not_there_cannot_be_drawn(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    drawing = tmp_path / "station.svg"
    assert heisoku.run(["draw", str(SAMPLES[0]), "-o", str(drawing), "--route", "nonsense"]) == 2
    error = capsys.readouterr().err
    assert in_one_line(error)
    assert "nonsense" in error
    assert not drawing.exists()


@pytest.mark.parametrize("encoding", ["ascii", "utf-8"])
def test_the_program_itself_ends_with_the_code(encoding: str, tmp_path: Path) -> None:
    """Through the operating system, and where the output has no place for Japanese."""
    ended = subprocess.run(
        [sys.executable, str(ROOT / "heisoku.py"), "check", str(tmp_path / "駅.toml")],
        capture_output=True,
        env={"PYTHONIOENCODING": encoding, "PATH": ""},
        cwd=ROOT,
        check=False,
    )
    assert ended.returncode == 2
    assert in_one_line(ended.stderr.decode(encoding))
