"""State machines of the theories beside the interlocking: nothing breaks in the sound kernel, a planted fault does."""

from __future__ import annotations

from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from random import Random

import pytest

from fuzz.machines.beside import BESIDE, Beside, integers, shaken, walk
from fuzz.machines.theories import hunted, machine_of, with_fault
from proofs.theories import THEORIES

EXAMPLES = 15
MANY = 2_000
"""What Hypothesis draws depends on which modules are imported: it takes numbers from their source."""
FAULTS = {
    "kernel.onboard.braking.reach_nm: term 1": "braking",
    "kernel.link.judge: guard if telegram.sent_at_ms - now_ms > 2 * limits.offset_ms: Outcome.FROM_THE_FUTURE": "link",
}


def test_every_theory_but_the_interlocking_has_a_machine() -> None:
    assert {*BESIDE, "interlocking"} == set(THEORIES)


@pytest.mark.sampled(3)
@pytest.mark.parametrize("theory", BESIDE)
def test_the_sound_kernel_breaks_no_claim(theory: str) -> None:
    machine = machine_of(theory)
    assert hunted(machine, EXAMPLES) is None
    assert machine.counted["rules"] >= EXAMPLES
    assert machine.counted["changed"] >= EXAMPLES / 2


def found_with(fault: str) -> tuple[tuple[str, ...], int] | None:
    """What a machine with a fault in it breaks, and in how many steps."""
    broken = hunted(with_fault(machine_of(FAULTS[fault]), fault), MANY)
    return None if broken is None else (broken.violated, len(broken.taken))


@pytest.mark.sampled(2)
@pytest.mark.parametrize("fault", FAULTS)
def test_a_planted_fault_is_found_and_shrunk(fault: str) -> None:
    """In a process of its own: what a hunt begins from does not depend on the tests before it."""
    with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as pool:
        broken = pool.submit(found_with, fault).result()
    assert broken is not None
    violated, steps = broken
    assert set(violated) <= set(THEORIES[FAULTS[fault]].invariants)
    assert steps <= 6


@pytest.mark.parametrize("theory", BESIDE)
def test_a_jolt_leads_only_where_all_that_is_claimed_holds(theory: str) -> None:
    landed = 0
    for seed in range(80):
        if seed >= 40 and landed:
            break
        run = Beside(theory, {}, seed)
        landed += run.jolt(Random(seed))
        assert run.false(run.site, run.system) == ()
        assert all(claim(run.site) for claim in run.theory.premises.values())
    assert landed >= 1


def test_a_walk_is_the_same_for_the_same_number() -> None:
    assert walk("link", {}, Random(5)).taken == walk("link", {}, Random(5)).taken
    assert walk("link", {}, Random(5)).taken != walk("link", {}, Random(6)).taken


def test_what_is_shaken_keeps_its_form() -> None:
    value = {"a": (1, True, "word"), "b": {"c": 7}}
    found = [shaken(value, Random(seed), (99,)) for seed in range(50)]
    assert all(list(each) == ["a", "b"] and each["a"][2] == "word" and type(each["a"][1]) is bool for each in found)
    assert len({tuple(integers(each)) for each in found}) > 5
