"""Whatever happens to a command, it says nothing that it did not find; ``make interruptions`` does it 500 times."""

from __future__ import annotations

import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from models.exit_codes import UNDECIDED
from tests.interruptions import COMMANDS, ROOT, Disturbance, begun, closed, drawn, ended, interrupted, unheeded, wrong

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


@pytest.mark.parametrize("seconds", [0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.8])
def test_while_it_is_loaded_an_interruption_ends_it_without_a_word(seconds: float, tmp_path: Path) -> None:
    process = begun(CHECK, tmp_path, Disturbance("SIGINT", interrupted))
    time.sleep(seconds)
    interrupted(process)
    _, said = process.communicate(timeout=60)
    assert process.returncode in (-signal.SIGINT, UNDECIDED, 0), said
    assert b"Traceback" not in said
    assert len(said.splitlines()) <= 1


def test_an_interruption_is_heard_where_python_would_drop_it() -> None:
    given = "import os, time, heisoku_start\nheisoku_start.hear_interruptions(True)\n"
    falls = "class Held:\n    def __del__(self):\n        os.kill(os.getpid(), 2)\n        len(' ')\n"
    ended_by = "try:\n    del held\n    time.sleep(30)\nexcept KeyboardInterrupt:\n    print('heard')\n"
    program = subprocess.run(
        [sys.executable, "-c", f"{given}{falls}held = Held()\n{ended_by}"],
        cwd=ROOT,
        text=True,
        capture_output=True,
        check=False,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )
    assert (program.stdout, program.stderr) == ("heard\n", "")


@pytest.mark.parametrize(
    ("code", "seconds", "heeded"),
    [(0, 60.0, False), (1, 60.0, False), (0, 2.0, True), (UNDECIDED, 60.0, True), (-signal.SIGINT, 60.0, True)],
)
def test_a_verdict_long_after_an_interruption_is_wrong(code: int, seconds: float, heeded: bool) -> None:
    assert (unheeded(code, seconds) == []) == heeded
