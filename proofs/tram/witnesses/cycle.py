"""A tram in the second slot: it answers, is damaged, late, silent, or somebody else answers (G3, G6)."""

from __future__ import annotations

from kernel.tram.cycle import CYCLE_MS, STALE_MS, Answer, CycleLimits, is_fresh, nothing_heard, slot_begins_ms
from models.tram.cycle import Air, Station
from proofs.onboard.witnesses.play import Play
from proofs.tram.cycle import THEORY

LIMITS = CycleLimits(request_ms=1_200, slot_ms=700, answer_ms=600)
SITE = Station(LIMITS)
SLOT = 1
AT_MS = slot_begins_ms(LIMITS, SLOT)


class Polling(Play[Station, Air]):
    """A station that asks, cycle by cycle."""

    def __init__(self) -> None:
        """Begin: nothing was heard."""
        super().__init__(THEORY, SITE, Air(nothing_heard(SLOT), SLOT, 0, False, False))

    def answer(
        self,
        age_ms: int = 0,
        true_age_ms: int = 0,
        *,
        at_ms: int = AT_MS,
        is_sound: bool = True,
        is_asked: bool = True,
    ) -> bool:
        """Something is received; whether the tram is known afterwards."""
        answer = Answer(is_sound, is_asked, at_ms, age_ms)
        self.step("receive", answer=answer, true_age_ms=true_age_ms)
        return is_fresh(self.system.heard)

    def cycle(self, elapsed_ms: int = CYCLE_MS) -> bool:
        """The rest of a cycle; whether the tram is known afterwards."""
        self.step("pass_time", elapsed_ms=elapsed_ms)
        before = self.system
        self.step("end_cycle")
        assert (self.system.answered, self.system.answered_last) == (False, before.answered)
        return is_fresh(self.system.heard)


def one_cycle_without_an_answer_is_too_many() -> None:
    """Known through the next cycle, and no longer (G3)."""
    polling = Polling()
    assert not polling.cycle()
    assert polling.answer()
    assert (polling.system.answered, polling.system.age_ms) == (True, 0)
    assert polling.cycle()
    assert polling.system.age_ms == polling.system.heard.age_ms == CYCLE_MS
    assert not polling.cycle(1)
    assert polling.answer()
    assert polling.cycle()
    assert polling.answer()
    assert polling.cycle()


def eleven_seconds_are_too_old() -> None:
    """Data that came with a delay are as old as they are (table 1; G3)."""
    polling = Polling()
    assert polling.answer(4_000, 4_000)
    assert (polling.system.age_ms, polling.system.heard.age_ms) == (4_000, 4_000)
    assert polling.cycle()
    polling.step("pass_time", elapsed_ms=1)
    assert not is_fresh(polling.system.heard)
    assert polling.answer(STALE_MS)
    assert not polling.answer(STALE_MS + 1)


def what_is_no_answer_makes_nothing_known() -> None:
    """Damaged, of another tram, before its slot or so late that it runs into the next one (G6)."""
    polling = Polling()
    assert not polling.answer(is_sound=False)
    assert not polling.answer(is_asked=False)
    assert not polling.answer(at_ms=AT_MS - 1)
    assert not polling.answer(at_ms=AT_MS + 101)
    assert not polling.system.answered
    assert polling.answer(at_ms=AT_MS + 100)
    assert not Polling().answer(is_asked=False)


def a_station_that_starts_anew_has_heard_nothing() -> None:
    """The tram has answered it before; it asks again (G3)."""
    polling = Polling()
    assert polling.answer(9, 9)
    assert polling.cycle()
    assert polling.answer(9, 9)
    polling.step("restart")
    assert polling.system == Air(nothing_heard(SLOT), SLOT, 9, False, False)
    assert nothing_heard(SLOT).slot == SLOT
    assert nothing_heard(SLOT).age_ms == 0
    assert not is_fresh(polling.system.heard)


def slots_follow_one_another() -> None:
    """Four of them in the 4 s with the trams, none into the next (002, figure 2; G3)."""
    begins = [slot_begins_ms(LIMITS, slot) for slot in range(4)]
    assert begins == [1_200, 1_900, 2_600, 3_300]
    assert begins[-1] + LIMITS.slot_ms == 4_000


def what_nature_does_not_do() -> None:
    """Time does not run back, and no delay is told too short (G3)."""
    polling = Polling()
    before = polling.system
    assert polling.step("pass_time", elapsed_ms=-1) == before
    assert polling.step("receive", answer=Answer(True, True, AT_MS, 9), true_age_ms=10) == before


WITNESSES = (
    one_cycle_without_an_answer_is_too_many,
    eleven_seconds_are_too_old,
    what_is_no_answer_makes_nothing_known,
    a_station_that_starts_anew_has_heard_nothing,
    slots_follow_one_another,
    what_nature_does_not_do,
)
