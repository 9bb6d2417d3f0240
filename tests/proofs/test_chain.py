"""What the theorem rests on is followed down to nature, and said to be what it is."""

from __future__ import annotations

from typing import Any

from rich.console import Console
from typer.testing import CliRunner

from heisoku import app
from proofs import assumptions
from proofs.chain import THEOREM, chain, counted, print_chain
from proofs.joints import BY_NAME, discharged
from proofs.records import Report
from proofs.theories import THEORIES


def test_every_theory_that_guarantees_something_in_the_chain_stands_in_it() -> None:
    found = chain()
    guaranteeing = {
        claim.partition(".")[0] for links in found.links.values() for link in links for claim in link.guaranteed
    }
    assert guaranteeing | set(THEOREM) == set(found.links)
    assert guaranteeing > {"train", "joint", "link"}
    assert "tag_reader" not in found.links, "what it guarantees is claimed of the one train's antennas"


def test_what_is_left_to_nature_is_described_and_discharged_by_nothing() -> None:
    described = {
        f"interlocking.{each.name}"
        if each.kind in ("world", "premise", "axiom", "built_in")
        else f"{each.kind}.{each.name}"
        for each in assumptions.read()
    }
    nature = chain().nature
    assert len(nature) > 50
    assert [name for name in nature if name not in described] == []
    assert not set(nature) & set(discharged())


def test_nothing_of_the_composed_train_is_discharged_by_name() -> None:
    """It assumes of nature alone."""
    assert [link for link in chain().links["train"] if link.guaranteed] == []
    assert {link.assumption.partition(".")[0] for link in chain().tied("train")} <= set(THEORIES["train"].parts)


def test_the_tree_says_what_was_proved_and_how_its_links_are_tied() -> None:
    console = Console(record=True, width=400, file=None, force_terminal=False)
    print_chain(console, Report((), 0.0, 0.0))
    text = console.export_text()
    assert "interlocking: not asked" in text
    for name in chain().links:
        assert name in text
    for line in counted(chain()):
        assert line in text
    assert f"{len(chain().tied(BY_NAME))} discharged: tied by name alone" in text


def core(row: str, invariant: str, *guards: str, parts_open: int = 0) -> dict[str, Any]:
    return {"transition": row, "invariant": invariant, "guards": [*guards], "open": parts_open}


def cores_of(theory: str, *guards: str, parts_open: int = 0) -> list[dict[str, Any]]:
    """A record in which every proof of a theory rests on these."""
    whole = THEORIES[theory]
    return [
        core(f"{theory}.{step}", name, *guards, parts_open=parts_open)
        for step in whole.steps
        for name in whole.invariants
    ]


def test_by_recorded_cores_what_no_proof_of_the_chain_uses_is_told_apart() -> None:
    nothing, told = chain(()), chain(cores_of("link", "models.link.clocks_agree_within_the_bound: a <= b"))
    name = "link.only_the_holder_of_the_key_makes_a_valid_mac"
    assert name in nothing.nature
    assert name in told.idle
    assert name not in told.nature
    assert "link.clocks_agree_within_the_bound" in told.nature
    assert (list(nothing.by_cores), list(told.by_cores)) == ([], ["link"])
    assert "told by the unsat cores on record in 1 theories" in counted(told)[-1]


def test_a_core_that_asks_an_assumption_by_name_uses_it() -> None:
    asked = "models.link.arrive: only_the_holder_of_the_key_makes_a_valid_mac(site, system, arrived)"
    assert "link.only_the_holder_of_the_key_makes_a_valid_mac" in chain(cores_of("link", asked)).nature


def test_cores_that_are_not_whole_leave_all_that_steps_ask_in_the_chain() -> None:
    assert chain(cores_of("link", parts_open=1)).idle == chain(()).idle
    assert chain(cores_of("link")[1:]).by_cores == []


def test_what_a_site_is_assumed_to_be_and_no_claim_asked_for_rests_on_is_idle() -> None:
    found = chain(())
    assert "interlocking.a_flank_is_closed_or_held" in found.idle
    assert not set(found.idle) & set(found.nature)


def test_the_whole_is_not_asked_of_a_part() -> None:
    result = CliRunner().invoke(app, ["prove", "--whole", "--only", "^train"])
    assert result.exit_code == 2
    assert "--whole" in result.output
