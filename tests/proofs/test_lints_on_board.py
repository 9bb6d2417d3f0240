"""The lints of the theories beside the interlocking hold, and each of them catches a planted fault."""

from __future__ import annotations

import inspect
from dataclasses import replace
from pathlib import Path

import pytest

from proofs import lints, usage
from proofs.lints_on_board import (
    NO_MACHINES,
    NOTED,
    OTHERS,
    TOLD,
    Open,
    beside_without_a_reason,
    machine_fields,
    open_to,
    run_beside_the_computer,
    steps_on_board,
    told_the_truth,
    unlisted,
    unregistered,
    world,
)
from proofs.onboard import odometry
from proofs.theories import THEORIES
from proofs.theory import Theory, by_name

ROOT = Path(__file__).resolve().parent.parent.parent
ODOMETRY = odometry.THEORY
MAY = open_to(ODOMETRY)

theories = pytest.mark.parametrize("theory", OTHERS.values(), ids=OTHERS)


# ---- no truth by fiat


@theories
def test_no_machine_on_board_is_told_what_is_really_there(theory: Theory) -> None:
    for module in world(theory):
        assert told_the_truth(inspect.getsource(module), open_to(theory)) == []


@theories
def test_every_theory_has_a_machine_in_its_state(theory: Theory) -> None:
    assert machine_fields(theory.system)


def test_what_a_machine_may_be_told_besides_is_a_field_of_its_theory() -> None:
    for name, fields in [*TOLD.items(), *NOTED.items()]:
        assert set(fields) <= {
            *inspect.get_annotations(OTHERS[name].site),
            *inspect.get_annotations(OTHERS[name].system),
        }


CYCLE = "odometry.note_cycle(site.bounds, system.motion, readings)"
NARROWED = "motion=odometry.note_fix(system.motion, least_mm, most_mm)"
NOT_THERE = "if not the_train_stands_where_it_is_said_to(system, least_mm, most_mm):"


@pytest.mark.parametrize(
    ("old", "new", "offence"),
    [
        (CYCLE, "odometry.note_cycle(site.bounds, system.motion, seen(system.front_nm))", "writes system.front_nm"),
        (CYCLE, "odometry.note_cycle(made(site), system.motion, readings)", "writes site into"),
        (CYCLE, "odometry.note_cycle(site.bounds, system.motion, replace(readings, way_mm=to_nm))", "to_nm as true"),
        (CYCLE, f"{CYCLE} if system.slips else system.motion", "writes system.slips into motion"),
        (NARROWED, "motion=odometry.note_fix(system.motion, system.front_nm, most_mm)", "writes system.front_nm"),
        (NARROWED, "motion=at(system)", "writes system into motion"),
        (NARROWED, "motion=getattr(system, 'motion')", "uses getattr"),
        (NOT_THERE, "if system.slips:", "decides by system.slips"),
        (NOT_THERE, "if least_mm > most_mm:", "refuses events by `least_mm > most_mm`"),
        (NOT_THERE, NOT_THERE.replace("if ", "if most_mm < 0 or "), "refuses events by `most_mm < 0`"),
        (NOT_THERE, "if site.length_mm > most_mm:", "decides by site.length_mm"),
        (
            NOT_THERE,
            f"slid = system.slips\n    if slid:\n        return system\n    {NOT_THERE}",
            "decides by system.sl",
        ),
        (
            f"{NOT_THERE}\n        return system",
            f"{NOT_THERE}\n        return again(site, system)",
            "does more on an assu",
        ),
    ],
)
def test_a_machine_on_board_that_is_told_the_truth_is_seen(old: str, new: str, offence: str) -> None:
    source = inspect.getsource(world(ODOMETRY)[0])
    assert source.count(old) >= 1, f"the odometry no longer has {old!r}"
    found = told_the_truth(source.replace(old, new, 1), MAY)
    assert any(offence in line for line in found), found


def test_a_branch_of_nature_is_no_offence_where_it_ends_in_the_truth() -> None:
    source = """
def run(site: Site, system: System, event: int) -> System:
    moved = system.true + event if system.apart else event
    return replace(system, true=moved, machine=step(system.machine, event))
"""
    may = Open(frozenset({"machine"}), frozenset(), frozenset(), frozenset(), "System")
    assert told_the_truth(source, may) == []
    assert told_the_truth(source.replace("machine, event)", "machine, moved)"), may) != []


# ---- what is proved, and what for


@theories
def test_every_invariant_is_a_claim_or_serves_one(theory: Theory) -> None:
    assert set(theory.safety) <= set(theory.invariants)
    assert theory.safety
    assert lints.idle_invariants(usage.book(theory), theory.invariants, theory.safety) == []


@theories
def test_every_premise_is_used(theory: Theory) -> None:
    assert lints.idle_axioms(usage.book(theory), theory.premises, {}, theory.safety) == []


def test_an_invariant_or_premise_that_serves_nothing_is_seen() -> None:
    book = {**usage.book(ODOMETRY), ("odometry.take_fix", "idle"): ["idle"]}
    safety = ODOMETRY.safety
    assert len(lints.idle_invariants(book, ["idle"], safety)) == 1
    assert lints.idle_axioms(book, ["idle"], {}, safety) == ["idle: no proof uses it"]
    used = {**book, ("odometry.take_fix", next(iter(safety))): ["idle"]}
    assert lints.idle_invariants(used, ["idle"], safety) == []
    assert lints.idle_axioms(used, ["idle"], {}, safety) == []


# ---- what is written is listed


@theories
def test_whatever_is_written_of_a_theory_is_listed_in_it(theory: Theory) -> None:
    assert unlisted(theory) == []


def test_what_is_written_of_a_theory_and_not_listed_is_seen() -> None:
    steps = by_name(step for name, step in ODOMETRY.steps.items() if name != "take_fix")
    claims = {name: claim for name, claim in ODOMETRY.invariants.items() if name != "range_contains_train"}
    found = unlisted(replace(ODOMETRY, steps=steps, invariants=claims))
    assert [line.split(":")[0].rsplit(".", 1)[-1] for line in found] == [
        "lies_outside",
        "missed_by_nm",
        "take_fix",
        "range_contains_train",
    ]


def test_every_theory_is_registered(tmp_path: Path) -> None:
    assert [each for part in ("onboard", "crossing", "alarm") for each in unregistered(ROOT / "proofs" / part)] == []
    (tmp_path / "forgotten.py").write_text("THEORY = Theory()")
    assert unregistered(tmp_path) == ["forgotten.py: no theory of this name is registered"]
    assert all(name == theory.name for name, theory in THEORIES.items())


# ---- one computer decides on board


def test_who_runs_a_machine_beside_the_computer_says_why() -> None:
    assert beside_without_a_reason(ROOT) == []


def test_a_reader_that_a_host_runs_beside_the_computer_is_no_longer_on_the_list(tmp_path: Path) -> None:
    """Nor is a machine that no host runs so any more."""
    ride = tmp_path / "models" / "rides" / "ride.py"
    ride.parent.mkdir(parents=True)
    (tmp_path / "heisoku.py").touch()
    ride.write_text("note, taken = MADE.tag_reader.note_frame, MADE.braking.take_end")
    found = beside_without_a_reason(tmp_path)
    assert "models/rides/ride.py runs tag_reader" in found
    assert "models/rides no longer runs feature" in found
    assert not any("braking" in each for each in found if each.startswith("models/rides"))


@pytest.mark.parametrize(
    "source",
    [
        "from kernel.onboard import odometry\nm = odometry.note_cycle(bounds, m, readings)",
        "from kernel.onboard import split as machine\nm = machine.note_cycle(limits, m, readings)",
        "from kernel.onboard.braking import take_end as taken\nb = taken(bounds, b, 0, 0, 0)",
        "note = MADE.antenna_spacing.note_tail_read",
    ],
)
def test_a_machine_run_beside_the_computer_is_seen(source: str) -> None:
    assert run_beside_the_computer(source)


def test_what_runs_no_machine_is_left_alone() -> None:
    assert not run_beside_the_computer(
        "from kernel.onboard import computer, odometry\n"
        "c = computer.sense(limits, c, readings, tail)\n"
        "odometry.is_located(c.known.motion)\n"
        "note_cycle = 1"
    )


def test_every_machine_on_board_has_steps() -> None:
    """But tables and fixes, which have no state."""
    folder = ROOT / "kernel/onboard"
    without = {"__init__", "arithmetic", "frames", "limits", "tag_fix", "tag_kind", *NO_MACHINES, "authority_end"}
    assert set(steps_on_board()) == {path.stem for path in folder.glob("*.py")} - without
