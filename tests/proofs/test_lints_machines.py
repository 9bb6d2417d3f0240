"""What holds centre, unit and terminal to proved steps, tried on wrong ones before it is believed of the right ones."""

from __future__ import annotations

import importlib.util
import inspect
from pathlib import Path
from types import ModuleType

import pytest

from kernel.machine import centre, point_terminal, unit
from proofs.lints_machines import callers, every_step, named, never_taken, offences, offences_of, proved, rows_taken

WRONG: list[tuple[ModuleType, str, str]] = [
    (centre, "case TailReport(run, block, left, entered)", "case TailReport(run, block, entered, left)"),
    (centre, "return route_setting.note_echo(layout, centre, run, tag_list)", "return release.retire(centre, run)"),
    (centre, "cancellation.note_given_back(layout, centre, run)", "release.release_overlap(layout, centre, run)"),
    (centre, "return recovery.adopt_point(layout, centre, run, point, position)", "return centre"),
    (centre, "return route_setting.note_confirmation(layout, centre, run, point, position)", "return centre"),
    (centre, "run = next_run(centre, train, life, NO_ROUTE)", "run = Run(centre.newest, train, life, NO_ROUTE)"),
    (centre, "return recovery.note_terminal_life(centre, point, terminal_life)", "return replace(centre, runs={})"),
    (
        centre,
        "return route_setting.request(layout, centre, run, base)",
        "return route_setting.request(layout, centre, run, run)",
    ),
    (
        centre,
        "        centre = release.retire(centre, run)",
        "        centre = cancellation.withdraw(layout, centre, run)",
    ),
    (centre, "    for run in now.over:\n        centre = release.retire(centre, run)\n", ""),
    (centre, "Epoch(written.epoch + 1)", "written.epoch"),
    (centre, "return supervision.note_statement(centre, train, life, epoch, blocks)", "return centre"),
    (
        centre,
        "return supervision.note_statement_confirmed(",
        "centre = asked(layout, centre, told)\n            return supervision.note_statement_confirmed(",
    ),
    (
        unit,
        "case Recall(run):\n            return first_loop.recall",
        "case Recall(run):\n            return first_loop.take_permit",
    ),
    (
        unit,
        "return standing.answer(unit, epoch, next_life(unit)",
        "return standing.answer(unit, epoch, unit.life",
    ),
    (unit, "UnitLife(written + 1)", "written"),
    (unit, "return first_loop.take_standing(unit, run)", "return unit"),
    (point_terminal, "return steps.relabel(terminal, run, life)", "return steps.relabel(terminal, run, terminal.life)"),
    (
        point_terminal,
        "position, life, contacts.position, contacts.is_made)",
        "position, life, position, contacts.is_made)",
    ),
    (point_terminal, "TerminalLife(written.life + 1)", "written.life"),
    (
        point_terminal,
        "steps.lock(terminal, contacts.position, contacts.is_made)",
        "steps.lock(terminal, contacts.position, True)",
    ),
]
"""A machine, and a change of how it is put together."""


def changed(module: ModuleType, old: str, new: str, folder: Path) -> ModuleType:
    """The machine with a change of its text."""
    text = inspect.getsource(module)
    assert old in text
    path = folder / f"{module.__name__}.py"
    path.write_text(text.replace(old, new, 1), "utf-8")
    spec = importlib.util.spec_from_file_location(module.__name__, path)
    assert spec is not None
    assert spec.loader is not None
    made = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(made)
    return made


@pytest.mark.parametrize("module", [centre, unit, point_terminal])
def test_a_machine_is_put_together_of_proved_steps(module: ModuleType) -> None:
    assert offences_of(module) == []


@pytest.mark.parametrize(("module", "old", "new"), WRONG)
def test_a_machine_that_is_put_together_otherwise_is_noticed(
    module: ModuleType, old: str, new: str, tmp_path: Path
) -> None:
    assert offences_of(changed(module, old, new, tmp_path))


def test_a_step_that_no_input_is_is_noticed(tmp_path: Path) -> None:
    without = changed(centre, "    for point in now.points:\n", "    for point in ():\n", tmp_path)
    assert never_taken((without, unit, point_terminal)) == []
    assert never_taken((unit, point_terminal)) != []


def test_steps_are_known_by_what_they_give() -> None:
    known = {named(each) for each in every_step()}
    assert {"kernel.recovery.account_for", "kernel.claims.end_run", "kernel.release.release"} <= known
    assert {named(each) for each in proved()} <= known
    assert "kernel.route_setting.request_refusal" not in known


@pytest.mark.parametrize(
    "source",
    [
        "from kernel.release import release\n",
        "from kernel import recovery\n\nrecovery.recover_block(layout, centre, block)\n",
        "from kernel import terminal as machine\n\nstep = machine.obey\n",
        "from kernel.recovery import account_for as hold\n",
    ],
)
def test_another_caller_of_a_step_is_found(source: str) -> None:
    assert callers(source, "fuzz/somewhere.py")
    assert callers(source, "models/world/somewhere.py") == []


def test_asking_why_something_is_refused_is_no_step() -> None:
    assert callers("from kernel.route_setting import request_refusal\n", "models/somewhere.py") == []


@pytest.mark.parametrize("source", ["play.take('request', run=run)", "self.play.take('lock' if x else 'drift')"])
def test_a_host_that_takes_a_machines_step_by_name_is_found(source: str) -> None:
    assert rows_taken(source, "models/simulation/somewhere.py")
    assert rows_taken(source, "models/simulator/machines.py") == []


def test_what_nature_does_a_host_may_bring_about() -> None:
    assert rows_taken("play.take('car_moves', run=run)", "models/simulation/somewhere.py") == []


def test_nobody_else_calls_a_step() -> None:
    assert offences() == []
