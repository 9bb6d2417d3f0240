"""What the theorem rests on is followed down to nature, and said to be what it is."""

from __future__ import annotations

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
    assert guaranteeing > {"odometry", "train", "joint", "tag_reader", "link"}


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


def test_the_whole_is_not_asked_of_a_part() -> None:
    result = CliRunner().invoke(app, ["prove", "--whole", "--only", "^train"])
    assert result.exit_code == 2
    assert "--whole" in result.output
