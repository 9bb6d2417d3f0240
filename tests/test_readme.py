"""What the README and the help texts promise: their examples run, their links lead somewhere."""

from __future__ import annotations

import re
import shlex
import shutil
from pathlib import Path

import pytest

import heisoku
from fuzz.failures.trace import text_of
from models.exit_codes import BAD_INPUT, DOES_NOT_HOLD, HOLDS, UNDECIDED
from proofs import usage
from proofs.theories import THEORIES
from tests.fuzz.failures.samples import LAYOUTS, failing

ROOT = Path(__file__).resolve().parent.parent
PAGES = sorted(path for path in [*ROOT.glob("*.md"), *ROOT.glob("docs/*.md"), *ROOT.glob("proofs/*.md")])
TEXT = (ROOT / "README.md").read_text("utf-8")
HELP = "\n".join(command.callback.__doc__ or "" for command in heisoku.app.registered_commands if command.callback)
EXAMPLES = sorted(
    {line.strip().split("  #")[0].strip() for line in TEXT.splitlines() if re.match(r"    heisoku \w", line)}
    | set(re.findall(r"\* `(heisoku [^`]+)`", HELP))
)


NEEDING_RECORDS = {"manifest", "verify", "report", "mutate"}
"""They read what other commands have written, or take minutes; tests/evidence and tests/proofs run them."""


def test_there_are_examples_of_every_command() -> None:
    shown = {shlex.split(example)[1] for example in EXAMPLES}
    commands = heisoku.app.registered_commands
    assert shown == {each.name or each.callback.__name__ for each in commands if each.callback}
    assert len(EXAMPLES) > len(shown)


@pytest.mark.parametrize("example", EXAMPLES)
def test_an_example_works(example: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Checks, drawings and replays are made; of a proof, which would take minutes, the pattern must match something."""
    (tmp_path / "layouts").symlink_to(ROOT / "layouts")
    monkeypatch.chdir(tmp_path)
    words = shlex.split(example)[1:]
    if words[0] == "prove":
        pattern = re.compile(words[words.index("--only") + 1] if "--only" in words else "")
        matched = [
            cell for theory in THEORIES.values() for cell in usage.cells(theory) if pattern.search(" ".join(cell))
        ]
        assert matched
        assert heisoku.run([*words, "--help"]) == HOLDS
    elif words[0] in NEEDING_RECORDS:
        assert heisoku.run([*words, "--help"]) == HOLDS
    elif words[0] == "replay":
        trace = Path(words[1])
        trace.parent.mkdir(parents=True, exist_ok=True)
        trace.write_text(text_of(failing()), "utf-8")
        shutil.copy(LAYOUTS["passing_station"], trace.parent / failing().layout.file)
        assert heisoku.run(words) == DOES_NOT_HOLD
    else:
        spread = [str(path) for word in words for path in (sorted(Path().glob(word)) if "*" in word else [word])]
        assert heisoku.run(spread) == HOLDS


def test_the_exit_codes_are_those_of_the_table() -> None:
    table = {int(code): words for code, words in re.findall(r"^\| (\d) \| ([^|]+) \|$", TEXT, re.MULTILINE)}
    assert sorted(table) == [HOLDS, DOES_NOT_HOLD, BAD_INPUT, UNDECIDED]
    assert table[HOLDS] == "it holds"
    assert "undecided" in table[UNDECIDED]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_links_lead_somewhere(page: Path) -> None:
    links = re.findall(r"\]\(([^)#]+)\)", page.read_text("utf-8"))
    assert [link for link in links if "://" not in link and not (page.parent / link).exists()] == []


def test_the_map_names_the_folders_there_are() -> None:
    named = set(re.findall(r"^\| `(\w+)/` \|", TEXT, re.MULTILINE))
    assert {"kernel", "models", "proofs", "layouts", "tests", "docs"} <= named
    assert all((ROOT / folder).is_dir() for folder in named)


def test_the_targets_of_make_are_there() -> None:
    targets = set(re.findall(r"^(\w+):", (ROOT / "Makefile").read_text("utf-8"), re.MULTILINE))
    named = set(re.findall(r"`?make (\w+)", TEXT)) - {"PYTHON"}
    assert {"assure", "test", "bench"} <= named <= targets
