"""What is assumed and claimed rests on no function or number of the kernel, but for a list that only shrinks."""

from __future__ import annotations

import importlib.util
import io
import sys
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from types import ModuleType

import pytest
from lxml import etree
from rich.console import Console

from proofs import lints_apart
from proofs.junit import junit_xml
from proofs.lints_apart import (
    DECISIONS,
    READINGS,
    TOLD,
    UNITS,
    judgements,
    kernel_in_assumptions,
    kernel_in_guards,
    kernel_numbers_in_claims,
    listed,
    mended,
    noted_in_assumptions,
    offences,
    told_by_simulation,
    truth_into_kernel,
    unlisted,
)
from proofs.matrix import print_matrix
from proofs.mutants import constants
from proofs.onboard import odometry
from proofs.records import Report
from proofs.theories import THEORIES
from tests.test_records import obligation

ODOMETRY = odometry.THEORY
CACHES = (constants.imported, constants.bindings, constants.reckoned_from, lints_apart.numbers)

HEAD = """
from __future__ import annotations
from dataclasses import replace
from kernel.alarm.tone import CAUTION_MM
from kernel.onboard import odometry
from kernel.onboard.arithmetic import CYCLE_MS, magnitude
from models.onboard.odometry import Line, Running

LIMIT_MM = CAUTION_MM // 2
OWN_MM = 3_000_000
"""


# ---- the whole tree


def test_nothing_offends_that_is_not_listed() -> None:
    assert unlisted(offences(), listed()) == []


def test_what_no_longer_offends_is_struck_from_the_list() -> None:
    assert mended(offences(), listed()) == [], "strike these lines from proofs/lints_apart.toml"


def test_a_line_too_few_or_too_many_in_the_list_is_seen() -> None:
    found = {"claims": ["one", "two"], "guards": []}
    assert unlisted(found, {"claims": ["one"]}) == ["claims: two"]
    assert mended(found, {"claims": ["one", "two", "three"], "guards": ["four"]}) == ["claims: three", "guards: four"]


def test_an_offence_leaves_every_proof_undecided() -> None:
    assert Report([obligation()], 0.1, 0.2).exit_code == 0
    report = Report([obligation()], 0.1, 0.2, offences=["claims: one"])
    assert report.exit_code == 3
    assert report.record()["offences"] == ["claims: one"]
    text = io.StringIO()
    print_matrix(Console(file=text, width=160, color_system=None), report)
    assert "claims: one: what rests on it is not proved" in text.getvalue()
    assert etree.fromstring(junit_xml(report)).get("failures") == "1"


def test_every_exception_is_one(monkeypatch: pytest.MonkeyPatch) -> None:
    assert all(getattr(sys.modules[name.rpartition(".")[0]], name.rpartition(".")[2]) for name in UNITS)
    monkeypatch.setattr(lints_apart, "READINGS", {})
    monkeypatch.setattr(lints_apart, "DECISIONS", {"": "none"})
    handed = {line for theory in THEORIES.values() for line in judgements(theory)}
    assert set(READINGS) <= handed
    monkeypatch.setattr(lints_apart, "TOLD", {})
    handed = {line for theory in THEORIES.values() for line in truth_into_kernel(theory)}
    assert all(
        any(line.startswith(f"{theory}: ") and f"{of}.{field}" in line for line in handed for of in ("system", "site"))
        for theory, fields in TOLD.items()
        for field in fields
    )
    monkeypatch.setattr(lints_apart, "DECISIONS", {"no such": "step"})
    refused = [line.replace(": ", ".", 1) for theory in THEORIES.values() for line in kernel_in_guards(theory)]
    assert all(any(line.startswith(beginning) for line in refused) for beginning in DECISIONS)


# ---- planted


@pytest.fixture
def planted(tmp_path: Path) -> Iterator[ModuleType]:
    """A module of a world with every offence in it, and what comes near to one."""
    name = "models.planted_for_a_test"
    path = tmp_path / "planted_for_a_test.py"
    path.write_text(HEAD + SOURCE, "utf-8")
    spec = importlib.util.spec_from_file_location(name, path)
    assert spec is not None
    assert spec.loader is not None
    module = sys.modules[name] = importlib.util.module_from_spec(spec)
    for each in CACHES:
        each.cache_clear()
    try:
        spec.loader.exec_module(module)
        yield module
    finally:
        del sys.modules[name]
        for each in CACHES:
            each.cache_clear()


SOURCE = """
def decides(site: Line) -> bool:
    return helped(site)


def helped(site: Line) -> bool:
    return odometry.agrees(site.bounds, 0, 0, 0)


def reckons(site: Line) -> bool:
    return magnitude(site.jolt_mm_s2) <= odometry.way_error_mm(site.bounds, 1)


def reads(site: Line) -> bool:
    return site.length_mm <= CAUTION_MM


def reads_what_is_reckoned(site: Line) -> bool:
    return site.length_mm <= LIMIT_MM


def states_its_own(site: Line) -> bool:
    return magnitude(site.length_mm) <= CYCLE_MS * OWN_MM


def asks_what_is_noted(site: Line, system: Running, speed_um_s: int) -> bool:
    return not system.motion.trusted or speed_um_s == 0


def asks_what_is_so(site: Line, system: Running, speed_um_s: int) -> bool:
    return not system.slipped or speed_um_s == 0


def claims(site: Line, system: Running) -> bool:
    return system.front_nm <= CAUTION_MM


def claims_by_helper(site: Line, system: Running) -> bool:
    return reads_what_is_reckoned(site)


def claims_its_own(site: Line, system: Running) -> bool:
    return system.front_nm <= CYCLE_MS * OWN_MM


def slide(site: Line, system: Running) -> Running:
    if odometry.is_located(system.motion):
        return system
    return replace(system, slipped=True)


def run(site: Line, system: Running, least_mm: int) -> Running:
    if odometry.is_located(system.motion):
        return system
    return replace(system, motion=odometry.note_fix(system.motion, least_mm, least_mm))


def tell(site: Line, system: Running, stands: bool, slips: bool) -> Running:
    where = system.front_nm
    if slips:
        return replace(system, slipped=True)
    return replace(system, motion=odometry.note_fix(system.motion, where, 1 if stands else 0))
"""


def of(*lines: str) -> list[str]:
    return [f"odometry: {line}" for line in lines]


def test_an_assumption_that_asks_the_kernel_or_reads_its_number_is_seen(planted: ModuleType) -> None:
    names = ("decides", "reckons", "reads", "reads_what_is_reckoned", "states_its_own")
    premises = {name: vars(planted)[name] for name in names}
    found = [line for line in kernel_in_assumptions(replace(ODOMETRY, premises=premises)) if " kernel." in line]
    assert [line for line in found if line.split()[1] in names] == of(
        "decides calls kernel.onboard.odometry.agrees",
        "reckons calls kernel.onboard.odometry.way_error_mm",
        "reads reads kernel.alarm.tone.CAUTION_MM",
        "reads_what_is_reckoned reads kernel.alarm.tone.CAUTION_MM",
    )


def test_an_assumption_that_asks_what_a_machine_has_noted_is_seen(planted: ModuleType) -> None:
    premises = {name: vars(planted)[name] for name in ("asks_what_is_noted", "asks_what_is_so")}
    found = [line for line in noted_in_assumptions(replace(ODOMETRY, premises=premises)) if "asks_what" in line]
    assert found == of("asks_what_is_noted rests on system.motion.trusted")


def test_a_claim_that_takes_its_number_from_the_kernel_is_seen(planted: ModuleType) -> None:
    names = ("claims", "claims_by_helper", "claims_its_own")
    theory = replace(ODOMETRY, initial={}, invariants={name: vars(planted)[name] for name in names})
    assert kernel_numbers_in_claims(theory) == of(
        "claims reads kernel.alarm.tone.CAUTION_MM", "claims_by_helper reads kernel.alarm.tone.CAUTION_MM"
    )
    assert kernel_numbers_in_claims(replace(theory, initial=theory.invariants, invariants={})) != []


def test_a_guard_of_nature_that_asks_the_kernel_is_seen_and_a_machines_own_is_not(planted: ModuleType) -> None:
    steps = {"slide": planted.slide, "run": planted.run}
    assert kernel_in_guards(replace(ODOMETRY, steps=steps)) == of(
        "slide is refused by kernel.onboard.odometry.is_located"
    )


def test_truth_and_judgements_that_a_step_hands_to_the_kernel_are_seen(planted: ModuleType) -> None:
    theory = replace(ODOMETRY, steps={"tell": planted.tell, "run": planted.run})
    assert judgements(theory) == ["odometry.tell.stands"]
    assert truth_into_kernel(theory) == of("tell hands system.front_nm to odometry.note_fix")


@pytest.mark.parametrize(
    ("line", "offence"),
    [
        ("odometry.note_fix(self.motion, self.play.system.track.at, 0)", "hands track to odometry.note_fix"),
        ("may_proceed(self.play.system.units[self.train], run)", ""),
        ("may_proceed(site.ground, run)", "hands ground to may_proceed"),
        ("self.play.take('answer', at_rest=True, life=life)", "tells answer at_rest"),
        ("self.play.take('request', run=run)", ""),
        ("where = self.play.system.track.at[car]\n        may_proceed(where, run)", "hands track to may_proceed"),
        ("drawn = self.play.system.track.at[car]\n        self.drawing.show(drawn)", ""),
        ("Unit(self.play.system.track.at)", ""),
    ],
)
def test_what_a_simulation_tells_a_machine_is_seen(line: str, offence: str) -> None:
    source = f"""
from kernel.authority import may_proceed
from kernel.onboard import odometry
from kernel.unit import Unit


class Driver:
    def drives(self, run):
        {line}
"""
    found = told_by_simulation(source, frozenset({"answer.at_rest", "give_back.stands_short"}))
    assert found == [f"drives {offence}"] * bool(offence)
