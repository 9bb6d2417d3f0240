"""A counterexample is replayed in CPython before anyone sees it, and drawn so that it can be followed."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any

import pytest

from kernel import route_setting
from kernel.centre import Centre
from kernel.layout import Layout
from kernel.names import Run
from kernel.refusal import Refusal
from proofs import counterexample, drawing
from proofs.catalogue import INVARIANTS
from proofs.counterexample import Unfaithful, search, stepped, unmet
from proofs.finite import SMALL, World
from proofs.lift.sources import definition_of
from proofs.mutated import running
from proofs.transitions import TRANSITIONS


def no_conflict(layout: Layout, centre: Centre, run: Run) -> Refusal | None:
    """Nothing stands against any run."""
    return None


NO_CONFLICT = {route_setting.conflict: definition_of(no_conflict)}


@cache
def world() -> World:
    return World(SMALL)


@cache
def conflicting() -> counterexample.Counterexample:
    found = search(world(), "request", NO_CONFLICT).found
    assert found is not None
    return found


@pytest.mark.sampled(8)
@pytest.mark.parametrize("transition", [step.__name__ for step in TRANSITIONS])
def test_no_transition_of_the_kernel_has_a_counterexample(transition: str) -> None:
    assert search(world(), transition).verdict == "none"


def test_counterexample_holds_before_and_not_after_in_cpython() -> None:
    found = conflicting()
    assert unmet(found.site, found.before) == []
    assert found.after is not None
    false = [name for name, claim in INVARIANTS.items() if not claim(found.site, found.after)]
    assert false == [broken.invariant for broken in found.broken]
    assert false


def test_the_kernel_itself_refuses_the_step_of_the_counterexample() -> None:
    found = conflicting()
    again = stepped(found.transition, found.site, found.before, found.event, {})
    assert again.after == found.before


def test_replacement_ends_with_its_block() -> None:
    found = conflicting()
    given = (found.site.layout, found.before.centre, found.event["run"])
    with running(NO_CONFLICT):
        assert route_setting.conflict(*given) is None
    assert route_setting.conflict(*given) is not None


def test_what_cpython_does_not_confirm_is_an_error_and_not_shown(monkeypatch: pytest.MonkeyPatch) -> None:
    def otherwise(*given: Any) -> counterexample.Counterexample:
        return replace(stepped(*given), broken=())

    monkeypatch.setattr(counterexample, "stepped", otherwise)
    with pytest.raises(Unfaithful, match="every invariant holds after the step"):
        search(world(), "request", NO_CONFLICT)


def test_drawing_names_the_claim_where_it_stands_and_what_changed() -> None:
    found = conflicting()
    text, page = drawing.as_text(found), drawing.as_html(found)
    for shown in (text, page):
        assert "counterexample to induction" in shown.lower()
        assert "perhaps unreachable" in shown.lower()
        for broken in found.broken:
            assert f"{broken.file}:{broken.line}" in shown
            assert broken.invariant in shown
        assert "centre › newest" in shown
    assert page.count("<svg") == 2
