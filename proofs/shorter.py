"""Questions of which is left what speaks of nothing but the goal's own symbols.

A step of the one train has some dozens of conditions, and a conjunct of a claim may follow from two of its own numbers:
that u² <= 2 b s holds a cycle later asks nothing of what the train was told.  A solver that takes such conditions for
cases loses its way among them.  A question with fewer hypotheses is weaker, so what it proves is proved; nothing else
that is answered of it is an answer.
"""

from __future__ import annotations

from proofs.smtlib import symbols_of
from proofs.workbench import Part


def shorter(part: Part) -> Part | None:
    """Give the shorter question; none where nothing would be left out."""
    own, count = symbols_of(part.goal), len(part.given) + sum(map(len, part.hypotheses.values()))
    hypotheses = {
        name: left
        for name, formulas in part.hypotheses.items()
        if (left := [each for each in formulas if symbols_of(each) <= own])
    }
    given = [each for each in part.given if symbols_of(each) <= own]
    has_fewer = len(given) + sum(map(len, hypotheses.values())) < count
    return Part(hypotheses, given, part.goal) if has_fewer else None
