"""The exit codes of every command."""

from __future__ import annotations

HOLDS, DOES_NOT_HOLD, BAD_INPUT, UNDECIDED = 0, 1, 2, 3

WORDS = {HOLDS: "holds", DOES_NOT_HOLD: "does not hold", BAD_INPUT: "bad input", UNDECIDED: "undecided"}
"""What a command says in its last line."""
