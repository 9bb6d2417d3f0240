"""Whatever happens to a command, it says nothing that it did not find; ``make interruptions`` does it 500 times."""

from __future__ import annotations

import signal

import pytest

from models.exit_codes import UNDECIDED
from tests.interruptions import COMMANDS, Disturbance, closed, drawn, ended, interrupted, wrong

CHECK, PROVE = COMMANDS[0], COMMANDS[4]


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    ("words", "how", "moment"),
    [
        (PROVE, Disturbance("SIGINT", interrupted), 0.7),
        (PROVE, Disturbance("SIGTERM", ended), 0.8),
        (CHECK, Disturbance("closed pipe", closed), 0.5),
        (CHECK, Disturbance("failing write", limit=100), 0.0),
    ],
    ids=lambda given: given.name if isinstance(given, Disturbance) else "",
)
def test_a_disturbed_command_says_nothing_that_it_did_not_find(
    words: tuple[str, ...], how: Disturbance, moment: float
) -> None:
    assert wrong(words, how, moment)[1] == []


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(4))
def test_commands_disturbed_at_random_say_nothing_that_they_did_not_find(seed: int) -> None:
    assert [(*each, found) for each in drawn(seed, len(COMMANDS)) if (found := wrong(*each)[1])] == []


def test_an_interruption_is_heard_though_a_shell_began_the_tests_in_the_background() -> None:
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        code, found = wrong(PROVE, Disturbance("SIGINT", interrupted), 0.5)
    finally:
        signal.signal(signal.SIGINT, before)
    assert (code, found) == (UNDECIDED, [])
