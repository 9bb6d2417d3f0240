"""The pages written from the sources are complete, and are what the sources say today."""

from __future__ import annotations

import ast
import inspect
import tomllib
from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

from kernel import link, persistence
from kernel.alarm import tone, train_list
from kernel.centre import Centre
from kernel.crossing import arrival
from kernel.onboard import antenna_spacing, brake_watch, split, tag_reader
from kernel.onboard.split import SplitLimits
from kernel.terminal import Terminal
from kernel.tram import centre as tram_centre
from kernel.tram import cycle, stopping
from kernel.tram import display as tram_display
from kernel.unit import Unit
from models.world import truth
from proofs import assumptions, lints, pages, usage
from proofs.catalogue import AXIOMS, PREMISES, STEPS
from proofs.lints_on_board import own
from proofs.theory import START

ROOT = Path(__file__).resolve().parent.parent.parent
BUILT = [
    *(f"T{number}" for number in (1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 16)),
    *(f"P{number}" for number in (1, 2, 3, 4, 5, 6, 7, 8)),
]
"""The requirements that this kernel serves."""


@pytest.mark.parametrize(("path", "page"), pages.PAGES.items(), ids=lambda one: getattr(one, "stem", None))
def test_a_page_is_what_its_sources_say(path: Path, page: Callable[[], str]) -> None:
    assert path.read_text("utf-8") == page(), "run: python -m proofs.pages"


def test_no_page_names_this_machine() -> None:
    texts = [page() for page in pages.PAGES.values()]
    assert not [text for text in texts if str(ROOT) in text or str(Path.home()) in text]


# ---- assumptions


def test_every_assumption_is_described_and_every_description_is_of_one() -> None:
    described = {kind: [one.name for one in assumptions.read() if one.kind == kind] for kind in assumptions.KINDS}
    for kind, predicates in assumptions.predicates().items():
        assert sorted(described[kind]) == sorted(predicates)
    assert len(described["world"]) >= 10
    assert len(described["built_in"]) >= 5


def test_a_description_is_whole_and_says_what_it_says_in_one_sentence() -> None:
    for one in assumptions.read():
        assert one.says.endswith(".")
        assert ". " not in one.says
        assert one.monitor.endswith(".")
        assert one.duty.endswith(".")
        assert (one.kind == "built_in") == bool(one.stands_in)
        assert set(one.stands_in) <= {*STEPS, START}


def test_the_use_of_an_axiom_is_found_and_not_written() -> None:
    using = usage.users(usage.book())
    for one in assumptions.read():
        if one.kind in ("axiom", "premise"):
            assert bool(assumptions.proofs_naming(one.name)) is (one.name not in lints.KEPT)
            assert set(assumptions.proofs_naming(one.name)) <= set(using.get(one.name, ()))


def test_every_assumption_of_nature_is_asked_by_a_transition() -> None:
    asked = {one.name: assumptions.asking(one.name) for one in assumptions.read() if one.kind == "world"}
    assert [name for name, steps in asked.items() if not steps] == []
    assert asked["two_persons_do_not_both_err"] == ["correct_statement", "confirm_statement"]


def test_the_assumptions_named_are_those_of_the_proof() -> None:
    names = {one.name for one in assumptions.read()}
    assert {*AXIOMS, *PREMISES} <= names
    assert {name for asked in lints.ASKED.values() for name in asked} <= names | set(own(truth))


# ---- persistence


@pytest.mark.parametrize("state", [Centre, Unit, Terminal])
def test_every_variable_that_a_restart_meets_is_described(state: type) -> None:
    assert set(pages.described(state)) == set(inspect.get_annotations(state))
    assert all(words.strip() for words in pages.described(state).values())


STARTS: dict[str, Callable[..., Any]] = {
    "LINK": link.begin,
    "TRAIN_IN_CONTACT": arrival.nothing_known,
    "TRAM_CENTRE": tram_centre.restarted,
    "TRAM_ANSWER": cycle.nothing_heard,
    "TRAM_STOPPING": stopping.begun,
    "TRAM_DISPLAY": tram_display.begun,
    "ALARM_SERVER": train_list.started,
    "ALARM_HANDSET": tone.switched_on,
}
"""Of whose tables no restart function is written: what they start by."""


@pytest.mark.parametrize("name", STARTS)
def test_what_a_start_leaves_is_what_its_table_says(name: str) -> None:
    """Field by field, as it is written; what survives is handed over by its own name (T8)."""
    made = [
        node.value
        for node in ast.walk(ast.parse(inspect.getsource(STARTS[name])))
        if isinstance(node, ast.Return) and isinstance(node.value, ast.Call)
    ]
    assert len(made) == 1
    told = {each.arg: ast.unparse(each.value).removeprefix("machine.") for each in made[0].keywords}
    table = getattr(persistence, name)
    assert told == {field: value or field for field, (_memory, value) in table.items()}
    assert f"`{STARTS[name].__module__}.{STARTS[name].__name__}`" in (ROOT / "kernel" / "persistence.py").read_text(
        "utf-8"
    )


SPLIT_LIMITS = SplitLimits(500, 3_000, 500, 600, 1_000, 10_000)
ON_BOARD: dict[str, tuple[ModuleType, object]] = {
    "TAG_READER": (tag_reader, tag_reader.restarted()),
    "SPLIT": (split, split.restarted(SPLIT_LIMITS)),
    "BRAKE_WATCH": (brake_watch, brake_watch.restarted()),
    "SPACING": (antenna_spacing, antenna_spacing.restarted()),
}
"""Machines on board that begin as another state with something found: what they begin with."""


@pytest.mark.parametrize("name", ON_BOARD)
def test_what_a_start_on_board_leaves_is_what_its_table_says(name: str) -> None:
    """Field by field, by value (T8)."""
    module, begun = ON_BOARD[name]
    names = {**vars(module), "limits": SPLIT_LIMITS}
    table = getattr(persistence, name)
    assert vars(begun) == {field: eval(value, names) for field, (_memory, value) in table.items()}


# ---- the world


def test_of_every_transition_it_is_said_why_nature_does_no_more() -> None:
    why = tomllib.loads(pages.WHY.read_text("utf-8"))
    places = {place.__name__.rsplit(".", 1)[-1] for place in pages.PLACES}
    assert set(why) == places
    said = {step: words for entries in why.values() for step, words in entries.items() if step != "about"}
    assert set(said) == set(STEPS)
    assert all(len(words.split()) >= 5 and words.endswith(".") for words in said.values())
    for step, function in STEPS.items():
        assert step in why[function.__module__.rsplit(".", 1)[-1]]


# ---- traceability


def labels_of_tests() -> dict[str, set[str]]:
    """The requirements that test files name, in their own docstring or in a test's."""
    found: dict[str, set[str]] = {}
    for path in sorted((ROOT / "tests").rglob("test_*.py")):
        tree = ast.parse(path.read_text("utf-8"))
        for node in ast.walk(tree):
            if isinstance(node, ast.Module | ast.FunctionDef):
                for label in lints.requirements_in(ast.get_docstring(node)):
                    found.setdefault(label, set()).add(path.name)
    return found


@pytest.mark.parametrize("label", BUILT)
def test_a_requirement_that_is_built_leads_to_kernel_code_and_to_a_proof_or_a_test(label: str) -> None:
    named = pages.trace()[label]
    assert named["kernel functions"]
    assert named["invariants"] or labels_of_tests().get(label)


def test_every_label_that_is_named_is_explained() -> None:
    known = lints.known_requirements((ROOT / "docs" / "requirements.md").read_text("utf-8"))
    assert set(pages.trace()) <= known
    assert set(labels_of_tests()) <= known
